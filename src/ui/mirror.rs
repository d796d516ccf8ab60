//! The interface as a tree of plain records, for elements of a page that a screen reader can read and operate.
//!
//! egui says of its widgets what they are (AccessKit's tree), whole and in every pass. [`Mirror`] turns that into what ARIA knows: groups that
//! only lay things out are gone, items stand in the containers that they need, and what did not change is not told again.

use std::collections::{BTreeMap, HashMap};

use egui::accesskit::{Action, ActionData, ActionRequest, HasPopup, Node, NodeId, Role, Toggled, TreeId, TreeUpdate};
use egui::{Context, Event, FullOutput};
use serde::{Serialize, Serializer};

/// Names a record. The page hands it back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MirrorId(u64);

impl MirrorId {
    /// Reads what the page hands back.
    pub fn from_text(text: &str) -> Option<Self> {
        u64::from_str_radix(text, 16).ok().map(Self)
    }

    /// Names the container of a kind that egui does not have, around some children of this one.
    fn around(self, role: &str) -> Self {
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
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct MirrorNode {
    /// Its name for [`MirrorAction`].
    pub id: MirrorId,
    /// The role of ARIA.
    pub role: &'static str,
    /// What it is called.
    pub name: String,
    /// More words about it.
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
    /// What is behind it waits.
    pub modal: bool,
    /// It can have the keyboard focus.
    pub focusable: bool,
    /// Tab comes to it. Of the items of a tree or a list box only one is a stop; arrow keys lead to the others.
    pub stop: bool,
    /// It can be pressed.
    pub clickable: bool,
    /// It can be folded and unfolded.
    pub folds: bool,
    /// The value can be set.
    pub settable: bool,
    /// Depth in a tree or of a heading, from 1.
    pub level: Option<usize>,
    /// Its place among its like, from 1.
    pub place: Option<usize>,
    /// How many of its like there are.
    pub of: Option<usize>,
    /// Left, top, width and height in points, from the corner of the element around it.
    pub bounds: [f32; 4],
    /// In reading order.
    pub children: Vec<MirrorId>,
}

/// What changed since it was asked last.
#[derive(Debug, PartialEq, Serialize)]
pub struct MirrorChanges {
    /// New records and those that differ.
    pub changed: Vec<MirrorNode>,
    /// Records that are gone.
    pub removed: Vec<MirrorId>,
    /// The children of the whole.
    pub children: Vec<MirrorId>,
    /// What has the keyboard focus in egui; it may be no record, as a row that is still out of view.
    pub focus: Option<MirrorId>,
    /// Nothing was told before, so that older elements are of another start.
    pub fresh: bool,
}

/// What the page asks to be done with a record.
#[derive(Clone, Debug, PartialEq)]
pub enum MirrorAction {
    /// Presses it.
    Click,
    /// Gives it the keyboard.
    Focus,
    /// Sets the number of a slider.
    SetNumber(f64),
    /// Sets the text of a field.
    SetText(String),
    /// One step more.
    Increment,
    /// One step less.
    Decrement,
    /// Unfolds it.
    Expand,
    /// Folds it.
    Collapse,
    /// Scrolls to it.
    ScrollIntoView,
}

impl MirrorAction {
    /// Whether an input gives a widget the focus.
    pub fn is_focus(event: &Event) -> bool {
        matches!(
            event,
            Event::AccessKitActionRequest(ActionRequest {
                action: Action::Focus,
                ..
            })
        )
    }

    /// As input of egui.
    pub fn event(self, id: MirrorId) -> Event {
        let (action, data) = match self {
            Self::Click => (Action::Click, None),
            Self::Focus => (Action::Focus, None),
            Self::SetNumber(number) => (Action::SetValue, Some(ActionData::NumericValue(number))),
            Self::SetText(text) => (Action::SetValue, Some(ActionData::Value(text.into()))),
            Self::Increment => (Action::Increment, None),
            Self::Decrement => (Action::Decrement, None),
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

/// Watches what egui says of its widgets: a plugin of the context, which has to have AccessKit enabled.
#[derive(Debug, Default)]
pub struct Mirror {
    now: Snapshot,
    told: Option<Snapshot>,
}

#[derive(Clone, Debug, Default, PartialEq)]
struct Snapshot {
    nodes: BTreeMap<MirrorId, MirrorNode>,
    children: Vec<MirrorId>,
    focus: Option<MirrorId>,
}

impl egui::Plugin for Mirror {
    fn debug_name(&self) -> &'static str {
        "mirror"
    }

    fn output_hook(&mut self, _ctx: &Context, output: &mut FullOutput) {
        let output = &output.platform_output;
        // A pass that is done over has half of the tree.
        if let Some(update) = output.accesskit_update.as_ref().filter(|_| !output.requested_discard()) {
            self.now = Snapshot::of(update);
        }
    }
}

impl Mirror {
    /// What changed since the last call; `None` when nothing did.
    pub fn take_changes(&mut self) -> Option<MirrorChanges> {
        let told = self.told.replace(self.now.clone());
        if told.as_ref() == Some(&self.now) {
            return None;
        }
        let fresh = told.is_none();
        let told = told.unwrap_or_default();
        let now = &self.now;
        let differs = |node: &&MirrorNode| told.nodes.get(&node.id) != Some(node);
        let is_gone = |id: &&MirrorId| !now.nodes.contains_key(id);
        Some(MirrorChanges {
            changed: now.nodes.values().filter(differs).cloned().collect(),
            removed: told.nodes.keys().filter(is_gone).copied().collect(),
            children: now.children.clone(),
            focus: now.focus,
            fresh,
        })
    }

    /// The text of each element as it was seen last, indented: its role, name and state.
    pub fn outline(&self) -> String {
        fn write(snapshot: &Snapshot, ids: &[MirrorId], depth: usize, text: &mut String) {
            for node in ids.iter().filter_map(|id| snapshot.nodes.get(id)) {
                *text += &"  ".repeat(depth);
                *text += &format!("{} {:?}", node.role, node.name);
                let value = node.value.clone().or(node.number.map(|number| number.to_string()));
                let states = [
                    value.map(|value| format!(" = {value}")),
                    node.on.map(|on| format!(" on: {on}")),
                    node.expanded.map(|expanded| format!(" expanded: {expanded}")),
                    node.disabled.then(|| " disabled".to_owned()),
                    node.focusable.then(|| " focusable".to_owned()),
                ];
                text.extend(states.into_iter().flatten());
                *text += "\n";
                write(snapshot, &node.children, depth + 1, text);
            }
        }
        let mut text = String::new();
        write(&self.now, &self.now.children, 0, &mut text);
        text
    }
}

/// A record with those inside of it.
struct Branch {
    node: MirrorNode,
    children: Vec<Branch>,
}

impl Snapshot {
    fn of(update: &TreeUpdate) -> Self {
        let nodes: HashMap<NodeId, &Node> = update.nodes.iter().map(|(id, node)| (*id, node)).collect();
        let root = update.tree.as_ref().map(|tree| tree.root);
        let mut branches = Vec::new();
        let reader = Reader { nodes: &nodes };
        for &child in root
            .and_then(|root| nodes.get(&root))
            .map_or(&[][..], |root| root.children())
        {
            reader.read(child, &mut branches);
        }
        let mut branches = among_others(MirrorId(root.map_or(0, |root| root.0)), branches);
        branches.sort_by_key(|branch| reading_rank(&branch.node));
        let mut snapshot = Self::default();
        snapshot.children = snapshot.keep(branches, [0.0; 2]);
        snapshot.focus = Some(update.focus)
            .filter(|&focus| Some(focus) != root)
            .map(|focus| MirrorId(focus.0));
        snapshot.choose_stops();
        snapshot
    }

    /// Of the items of each tree and list box the one with the focus, the chosen one or the first is a stop of Tab.
    fn choose_stops(&mut self) {
        let is_walked = |node: &&MirrorNode| matches!(node.role, "tree" | "listbox");
        let walked: Vec<_> = self
            .nodes
            .values()
            .filter(is_walked)
            .map(|node| node.children.clone())
            .collect();
        for items in walked {
            let is_on = |id: &&MirrorId| self.nodes.get(id).is_some_and(|item| item.on == Some("true"));
            let focused = items.iter().find(|&&id| Some(id) == self.focus);
            let Some(&stop) = focused.or_else(|| items.iter().find(is_on)).or(items.first()) else {
                continue;
            };
            for id in items.iter().filter(|&&id| id != stop) {
                if let Some(item) = self.nodes.get_mut(id) {
                    item.stop = false;
                }
            }
        }
    }

    /// Keeps these records, placed from a corner. Returns their ids.
    fn keep(&mut self, branches: Vec<Branch>, [left, top]: [f32; 2]) -> Vec<MirrorId> {
        let mut ids = Vec::with_capacity(branches.len());
        for mut branch in branches {
            if is_overlay(&branch) && branch.node.name.is_empty() {
                branch.node.name = first_words(&branch.children);
            }
            let Branch { mut node, mut children } = branch;
            if let Some(count) = node.of.filter(|_| items_of(node.role).is_some()) {
                // ARIA tells the size of a set with its items.
                node.of = None;
                for item in &mut children {
                    item.node.of = item.node.of.or(Some(count));
                }
            }
            let [x, y, ..] = node.bounds;
            node.children = self.keep(children, [x, y]);
            (node.bounds[0], node.bounds[1]) = (x - left, y - top);
            ids.push(node.id);
            self.nodes.insert(node.id, node);
        }
        ids
    }
}

/// The panels in the order in which a person reads them, by their names. A failure comes first, what has no place between those on the
/// left and those on the right.
fn reading_rank(node: &MirrorNode) -> usize {
    const LEFT: [&str; 7] = ["Title", "Toolbar", "Tools", "Model", "Skeleton", "Legend", "Findings"];
    const RIGHT: [&str; 4] = ["Inspector", "Timeline", "Sheet", "Keys"];
    let place = |names: &[&str]| names.iter().position(|&name| name == node.name);
    match (node.role, place(&LEFT), place(&RIGHT)) {
        ("alertdialog", ..) => 0,
        (_, Some(place), _) => 1 + place,
        (_, _, Some(place)) => 2 + LEFT.len() + place,
        _ => 1 + LEFT.len(),
    }
}

struct Reader<'a> {
    nodes: &'a HashMap<NodeId, &'a Node>,
}

impl Reader<'_> {
    /// Reads a node with all that is in it; what only lays out is replaced by what is in it.
    fn read(&self, id: NodeId, branches: &mut Vec<Branch>) {
        let Some(&node) = self.nodes.get(&id) else {
            return;
        };
        // The view itself is the page's canvas.
        let is_view = node.role() == Role::Image && node.supports_action(Action::Focus);
        if node.is_hidden() || is_view {
            return;
        }
        let mut children = Vec::new();
        for &child in node.children() {
            self.read(child, &mut children);
        }
        let name = self.name_of(node);
        let clickable = node.supports_action(Action::Click);
        let Some(role) = role_of(node.role(), !name.is_empty(), clickable) else {
            branches.append(&mut children);
            return;
        };
        let mut branch = Branch {
            node: record(id, node, role, name, &children),
            children,
        };
        settle(&mut branch);
        // A control cannot have others in it, so what hangs from it follows it, and is called by it.
        let mut hung = match is_pressed(role) {
            true => std::mem::take(&mut branch.children),
            false => Vec::new(),
        };
        for child in hung
            .iter_mut()
            .filter(|child| is_overlay(child) && child.node.name.is_empty())
        {
            child.node.name.clone_from(&branch.node.name);
        }
        branches.push(branch);
        branches.append(&mut hung);
    }

    /// Its own name, or that of what labels it.
    fn name_of(&self, node: &Node) -> String {
        if let Some(label) = node.label() {
            return label.trim().to_owned();
        }
        if node.role() == Role::Label {
            return node.value().unwrap_or_default().trim().to_owned();
        }
        let labels = node.labelled_by().iter().filter_map(|id| self.nodes.get(id));
        let words: Vec<&str> = labels.filter_map(|label| label.label().or(label.value())).collect();
        words.join(" ")
    }
}

fn record(id: NodeId, node: &Node, role: &'static str, name: String, children: &[Branch]) -> MirrorNode {
    let bounds = node.bounds().map_or_else(
        || around(children),
        |bounds| [bounds.x0, bounds.y0, bounds.width(), bounds.height()].map(|side| side as f32),
    );
    let on = node.toggled().map(|toggled| match toggled {
        Toggled::True => "true",
        Toggled::False => "false",
        Toggled::Mixed => "mixed",
    });
    let selected = node
        .is_selected()
        .map(|selected| if selected { "true" } else { "false" });
    let words = |text: Option<&str>| text.filter(|text| !text.is_empty()).map(str::to_owned);
    MirrorNode {
        id: MirrorId(id.0),
        role,
        name,
        description: words(node.description()),
        value: match role {
            "textbox" => Some(node.value().unwrap_or_default().to_owned()),
            "text" => None,
            _ => words(node.value()),
        },
        placeholder: words(node.placeholder()),
        number: node.numeric_value(),
        min: node.min_numeric_value(),
        max: node.max_numeric_value(),
        step: node.numeric_value_step(),
        on: on.or(selected),
        expanded: node.is_expanded(),
        popup: node.has_popup().map(|popup| match popup {
            HasPopup::Menu => "menu",
            HasPopup::Listbox => "listbox",
            HasPopup::Tree => "tree",
            HasPopup::Grid => "grid",
            HasPopup::Dialog => "dialog",
        }),
        invalid: node.invalid().is_some(),
        disabled: node.is_disabled(),
        modal: node.is_modal(),
        focusable: node.supports_action(Action::Focus),
        stop: true,
        clickable: node.supports_action(Action::Click),
        folds: node.supports_action(Action::Expand) || node.supports_action(Action::Collapse),
        settable: node.supports_action(Action::SetValue),
        // AccessKit counts from 0.
        level: node.level().map(|level| level + usize::from(role == "treeitem")),
        place: node.position_in_set().map(|place| place + 1),
        of: node.size_of_set(),
        bounds,
        children: Vec::new(),
    }
}

/// Whether it is a control that is pressed as a whole.
fn is_pressed(role: &str) -> bool {
    matches!(role, "button" | "checkbox" | "switch" | "radio" | "tab" | "link")
}

/// Whether it lies over the rest while it is open.
fn is_overlay(branch: &Branch) -> bool {
    matches!(branch.node.role, "dialog" | "alertdialog" | "menu" | "listbox")
}

/// The first title or words among these.
fn first_words(branches: &[Branch]) -> String {
    let words = branches
        .iter()
        .find(|branch| matches!(branch.node.role, "heading" | "text"));
    words.map_or_else(|| "Choices".to_owned(), |branch| branch.node.name.clone())
}

/// The rect around all of these.
fn around(branches: &[Branch]) -> [f32; 4] {
    let rects = branches.iter().map(|branch| branch.node.bounds);
    let corners = rects.map(|[x, y, width, height]| [x, y, x + width, y + height]);
    let all = corners.reduce(|a, b| [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])]);
    all.map_or([0.0; 4], |[x0, y0, x1, y1]| [x0, y0, x1 - x0, y1 - y0])
}

/// The role of ARIA, `text` for words alone. None for what says nothing by itself.
fn role_of(role: Role, named: bool, clickable: bool) -> Option<&'static str> {
    Some(match role {
        Role::Button | Role::DefaultButton | Role::ColorWell | Role::DisclosureTriangle | Role::ComboBox => "button",
        Role::CheckBox => "checkbox",
        Role::Switch => "switch",
        Role::RadioButton => "radio",
        Role::Slider => "slider",
        Role::SpinButton | Role::NumberInput => "spinbutton",
        Role::Splitter | Role::ScrollBar => return None,
        Role::TextInput | Role::SearchInput | Role::MultilineTextInput => "textbox",
        Role::Link => "link",
        Role::Heading => "heading",
        Role::Tab => "tab",
        Role::TabList => "tablist",
        Role::TabPanel if named => "tabpanel",
        Role::Tree | Role::TreeGrid => "tree",
        Role::TreeItem => "treeitem",
        Role::List => "list",
        Role::ListItem | Role::ListBoxOption | Role::MenuListOption if clickable => "option",
        Role::ListItem => "listitem",
        Role::ListBox => "listbox",
        Role::Menu | Role::MenuListPopup => "menu",
        Role::MenuBar => "menubar",
        Role::MenuItem => "menuitem",
        Role::MenuItemCheckBox => "menuitemcheckbox",
        Role::MenuItemRadio => "menuitemradio",
        Role::Grid | Role::Table => "grid",
        Role::Row => "row",
        Role::Cell | Role::GridCell => "gridcell",
        Role::ColumnHeader => "columnheader",
        Role::RowHeader => "rowheader",
        Role::Dialog => "dialog",
        Role::AlertDialog => "alertdialog",
        Role::Alert => "alert",
        Role::Status => "status",
        Role::Toolbar if named => "toolbar",
        Role::RadioGroup => "radiogroup",
        Role::ProgressIndicator => "progressbar",
        Role::Tooltip => return None,
        Role::TextRun => return None,
        _ if !named => return None,
        Role::Label | Role::Paragraph => "text",
        Role::Image | Role::Canvas | Role::Figure => "img",
        Role::Region | Role::Pane | Role::Complementary | Role::Navigation | Role::Form | Role::Section => "region",
        _ if clickable => "button",
        _ => "group",
    })
}

/// Whether it is a row without cells, to be read and not to be used.
fn is_line(branch: &Branch) -> bool {
    branch.node.role == "row" && branch.children.is_empty() && !branch.node.focusable && !branch.node.clickable
}

/// What ARIA lets a container have in it; None for what may have anything.
fn items_of(container: &str) -> Option<&'static [&'static str]> {
    Some(match container {
        "tree" => &["treeitem"],
        "listbox" => &["option"],
        "list" => &["listitem"],
        "tablist" => &["tab"],
        "menu" | "menubar" => &["menuitem", "menuitemcheckbox", "menuitemradio"],
        "grid" => &["row"],
        "row" => &["gridcell", "columnheader", "rowheader"],
        _ => return None,
    })
}

/// Makes the items of a container what ARIA expects there. A container with anything else in it is a group.
fn settle(branch: &mut Branch) {
    let Some(items) = items_of(branch.node.role) else {
        branch.children = among_others(branch.node.id, std::mem::take(&mut branch.children));
        return;
    };
    if branch.node.role == "row" && branch.children.is_empty() {
        return;
    }
    if branch.node.role == "grid" && !branch.children.is_empty() && branch.children.iter().all(is_line) {
        // A table whose rows are read as a whole.
        branch.node.role = "list";
        for child in &mut branch.children {
            child.node.role = "listitem";
        }
        return;
    }
    let container = branch.node.role;
    branch.children = adopted(std::mem::take(&mut branch.children));
    let as_item = |child: &Branch| match (container, child.node.role) {
        (_, role) if items.contains(&role) => Some(role),
        _ if !child.children.is_empty() => None,
        ("listbox", "button" | "radio") => Some("option"),
        ("tablist", "button" | "radio") => Some("tab"),
        ("menu" | "menubar", "button") if child.node.on.is_none() => Some("menuitem"),
        ("menu" | "menubar", "button" | "radio" | "option") => Some("menuitemradio"),
        ("menu" | "menubar", "checkbox" | "switch") => Some("menuitemcheckbox"),
        ("list", "text") => Some("listitem"),
        _ => None,
    };
    let roles: Option<Vec<_>> = branch.children.iter().map(as_item).collect();
    match roles {
        Some(roles) if !roles.is_empty() => {
            for (child, role) in branch.children.iter_mut().zip(roles) {
                child.node.role = role;
                if role == "menuitem" {
                    // It does something, and is nothing that is chosen.
                    child.node.on = None;
                }
            }
        }
        _ => {
            branch.node.role = if is_overlay(branch) { "dialog" } else { "group" };
            branch.children = among_others(branch.node.id, std::mem::take(&mut branch.children));
        }
    }
}

/// Items that stand among other things: rows of a tree and tabs get the container that they lack, others are what they would be alone.
fn among_others(parent: MirrorId, children: Vec<Branch>) -> Vec<Branch> {
    let mut kept: Vec<Branch> = Vec::with_capacity(children.len());
    for mut child in adopted(children) {
        let container = match child.node.role {
            "treeitem" => Some("tree"),
            "tab" => Some("tablist"),
            _ => None,
        };
        if let Some(role) = container {
            match kept
                .last_mut()
                .filter(|last| last.node.role == role && last.node.id == parent.around(role))
            {
                Some(last) => last.children.push(child),
                None => kept.push(container_around(parent.around(role), role, child)),
            }
            continue;
        }
        child.node.role = match child.node.role {
            "option" | "menuitem" | "menuitemcheckbox" | "menuitemradio" => "button",
            "listitem" | "gridcell" | "columnheader" | "rowheader" if child.children.is_empty() => "text",
            "listitem" | "gridcell" | "columnheader" | "rowheader" | "row" => "group",
            role => role,
        };
        kept.push(child);
    }
    for container in kept
        .iter_mut()
        .filter(|branch| branch.node.id == parent.around(branch.node.role))
    {
        container.node.bounds = around(&container.children);
    }
    kept
}

/// Buttons that lie on a row of a tree belong to the row.
fn adopted(children: Vec<Branch>) -> Vec<Branch> {
    let mut kept: Vec<Branch> = Vec::with_capacity(children.len());
    for child in children {
        let row = kept
            .last_mut()
            .filter(|row| row.node.role == "treeitem" && child.node.role != "treeitem");
        match row.filter(|row| lies_on(child.node.bounds, row.node.bounds)) {
            Some(row) => row.children.push(child),
            None => kept.push(child),
        }
    }
    kept
}

fn lies_on([x, y, width, height]: [f32; 4], row: [f32; 4]) -> bool {
    let center = [x + 0.5 * width, y + 0.5 * height];
    (0..2).all(|axis| (row[axis]..=row[axis] + row[axis + 2]).contains(&center[axis]))
}

fn container_around(id: MirrorId, role: &'static str, child: Branch) -> Branch {
    let mut node = record(NodeId(id.0), &Node::new(Role::Unknown), role, String::new(), &[]);
    node.bounds = child.node.bounds;
    Branch {
        node,
        children: vec![child],
    }
}
