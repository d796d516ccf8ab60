//! The records that a page makes elements of, and what it asks to be done with them.

use egui::Event;
use egui::accesskit::{Action, ActionData, ActionRequest, NodeId, TreeId};
use serde::{Serialize, Serializer};

/// Names a record. The page hands it back.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MirrorId(pub(super) u64);

impl MirrorId {
    pub fn from_text(text: &str) -> Option<Self> {
        u64::from_str_radix(text, 16).ok().map(Self)
    }

    /// Names the container of a kind that egui does not have, around some children of this one.
    pub(super) fn around(self, role: &str) -> Self {
        Self(egui::Id::unique(("mirror", self.0, role)).value())
    }
}

impl Serialize for MirrorId {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // A number of JavaScript has 53 bits.
        serializer.collect_str(&format_args!("{:x}", self.0))
    }
}

/// One element: its role as ARIA names it (`text` for words alone), what it says, and what can be done with it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct MirrorNode {
    /// Its name for [`MirrorAction`].
    pub id: MirrorId,
    pub role: &'static str,
    pub name: String,
    pub description: Option<String>,
    /// The text in a field, or a number in words.
    pub value: Option<String>,
    /// What a field shows while it is empty.
    pub placeholder: Option<String>,
    /// The number of a slider, its least and greatest, and a step.
    pub number: Option<f64>,
    /// The least number.
    pub min: Option<f64>,
    /// The greatest number.
    pub max: Option<f64>,
    /// From one number to the next.
    pub step: Option<f64>,
    /// `true`, `false` or `mixed`, where it is on or off or chosen.
    pub on: Option<&'static str>,
    /// Whether what hangs from it is shown.
    pub expanded: Option<bool>,
    /// The role of what hangs from it.
    pub popup: Option<&'static str>,
    /// What was typed into it is refused.
    pub invalid: bool,
    /// Nothing can be done with it now.
    pub disabled: bool,
    pub modal: bool,
    pub focusable: bool,
    /// Tab comes to it. Of the items of a tree or a list box only one is a stop; arrow keys lead to the others.
    pub stop: bool,
    pub clickable: bool,
    pub folds: bool,
    pub settable: bool,
    /// Depth in a tree or of a heading, from 1.
    pub level: Option<usize>,
    /// Its place among its like, from 1.
    pub place: Option<usize>,
    /// How many of its like there are.
    pub of: Option<usize>,
    /// Left, top, width and height in points, from the corner of the element around it.
    pub bounds: [f32; 4],
    /// The one inside of it that its keys act on, while it has the focus itself.
    pub active: Option<MirrorId>,
    /// Its stable name, as a [`Control`](crate::actions::Control) or a panel has it.
    pub control: Option<String>,
    /// In reading order.
    pub children: Vec<MirrorId>,
}

/// What changed since it was asked last.
#[derive(Debug, PartialEq, Serialize)]
pub struct MirrorChanges {
    pub changed: Vec<MirrorNode>,
    pub removed: Vec<MirrorId>,
    pub children: Vec<MirrorId>,
    /// What has the keyboard focus in egui; it may be no record, as a row that is still out of view.
    pub focus: Option<MirrorId>,
    /// After what Tab goes on while nothing has the focus: what was clicked last.
    pub start: Option<MirrorId>,
    /// Nothing was told before, so that older elements are of another start.
    pub fresh: bool,
}

/// What the page asks to be done with a record.
#[derive(Clone, Debug, PartialEq)]
pub enum MirrorAction {
    Click,
    Focus,
    SetNumber(f64),
    SetText(String),
    Expand,
    Collapse,
    /// Scrolls to it.
    ScrollIntoView,
}

impl MirrorAction {
    /// Whether an input gives a widget the focus.
    pub fn is_focus(event: &Event) -> bool {
        matches!(event, Event::AccessKitActionRequest(request) if request.action == Action::Focus)
    }

    /// The widget that an input presses without a pointer or a key.
    pub fn clicked(event: &Event) -> Option<NodeId> {
        match event {
            Event::AccessKitActionRequest(request) if request.action == Action::Click => Some(request.target_node),
            _ => None,
        }
    }

    /// As input of egui.
    pub fn event(self, id: MirrorId) -> Event {
        let (action, data) = match self {
            Self::Click => (Action::Click, None),
            Self::Focus => (Action::Focus, None),
            Self::SetNumber(number) => (Action::SetValue, Some(ActionData::NumericValue(number))),
            Self::SetText(text) => (Action::SetValue, Some(ActionData::Value(text.into()))),
            Self::Expand => (Action::Expand, None),
            Self::Collapse => (Action::Collapse, None),
            Self::ScrollIntoView => (Action::ScrollIntoView, None),
        };
        Event::AccessKitActionRequest(ActionRequest {
            action,
            target_tree: TreeId::ROOT,
            target_node: NodeId(id.0),
            data,
        })
    }
}
