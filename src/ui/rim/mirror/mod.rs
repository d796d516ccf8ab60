//! The interface as a tree of plain records, for elements of a page that a screen reader can read and operate.
//!
//! egui says of its widgets what they are (AccessKit's tree), whole and in every pass. [`Mirror`] turns that into what ARIA knows: groups that
//! only lay things out are gone, items stand in the containers that they need, and what did not change is not told again.

pub(in crate::ui) mod aria;
mod input;
mod record;

use std::collections::{BTreeMap, HashMap};

use egui::accesskit::{Action, HasPopup, Node, NodeId, Role, Toggled, TreeUpdate};
use egui::{Context, FullOutput, Id, Rect};

use aria::{Branch, among_others, around, first_words, is_overlay, is_pressed, items_of, role_of, settle};
pub use input::MirrorInput;
pub(in crate::ui) use input::holds_key;
pub use record::{MirrorAction, MirrorChanges, MirrorId, MirrorNode};

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
    start: Option<MirrorId>,
}

impl egui::Plugin for Mirror {
    fn debug_name(&self) -> &'static str {
        "mirror"
    }

    fn output_hook(&mut self, ctx: &Context, output: &mut FullOutput) {
        let output = &output.platform_output;
        // A pass that is done over has half of the tree.
        if let Some(update) = output.accesskit_update.as_ref().filter(|_| !output.requested_discard()) {
            self.now = Snapshot::of(update, &visible_rects(ctx));
            let clicked = ctx.data(|data| data.get_temp::<Option<Id>>(tab_start_id()));
            self.now.start = clicked.flatten().map(|id| MirrorId(id.value()));
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
            start: now.start,
            fresh,
        })
    }

    /// All records, in the order in which they are read.
    pub fn in_order(&self) -> Vec<&MirrorNode> {
        fn collect<'a>(snapshot: &'a Snapshot, ids: &[MirrorId], nodes: &mut Vec<&'a MirrorNode>) {
            for node in ids.iter().filter_map(|id| snapshot.nodes.get(id)) {
                nodes.push(node);
                collect(snapshot, &node.children, nodes);
            }
        }
        let mut nodes = Vec::new();
        collect(&self.now, &self.now.children, &mut nodes);
        nodes
    }

    /// After what Tab goes on: what has the focus, or else what was clicked last.
    pub fn tab_start(&self) -> Option<MirrorId> {
        self.now.focus.or(self.now.start)
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

/// Notes what was clicked last, while nothing has the focus.
pub(in crate::ui) fn set_tab_start(ctx: &Context, clicked: Option<Id>) {
    ctx.data_mut(|data| data.insert_temp(tab_start_id(), clicked));
}

fn tab_start_id() -> Id {
    Id::unique("after what Tab goes on")
}

/// The visible part of each widget of the pass that has ended. Negative where a widget is scrolled out of view.
fn visible_rects(ctx: &Context) -> HashMap<NodeId, Rect> {
    ctx.viewport(|viewport| {
        let widgets = viewport.prev_pass.widgets.layers().flat_map(|(_, widgets)| widgets);
        let known = widgets.filter(|widget| widget.rect.is_finite());
        known
            .map(|widget| (widget.id.accesskit_id(), widget.interact_rect))
            .collect()
    })
}

/// The part of an element that is visible. One that is scrolled out of view lies as a line at the edge where it went, so that it covers no
/// other element.
fn clipped([x, y, width, height]: [f32; 4], visible: Rect) -> [f32; 4] {
    let (top, bottom) = (y.max(visible.min.y), (y + height).min(visible.max.y));
    match (top < bottom, visible.min.y <= y) {
        (true, _) => [x, top, width, bottom - top],
        (false, true) => [x, visible.max.y - 1.0, width, 1.0],
        (false, false) => [x, visible.min.y, width, 1.0],
    }
}

impl Snapshot {
    fn of(update: &TreeUpdate, visible: &HashMap<NodeId, Rect>) -> Self {
        let nodes: HashMap<NodeId, &Node> = update.nodes.iter().map(|(id, node)| (*id, node)).collect();
        let root = update.tree.as_ref().map(|tree| tree.root);
        let mut branches = Vec::new();
        let reader = Reader { nodes: &nodes, visible };
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
            if let Some(count) = node.of.filter(|_| items_of(node.role).is_some() && node.role != "grid") {
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

/// The panels in the order in which a person reads them. A failure comes first, what has no place between those on the left and those on
/// the right.
fn reading_rank(node: &MirrorNode) -> usize {
    const LEFT: [&str; 6] = ["error", "title", "toolbar", "model", "legend", "findings"];
    const RIGHT: [&str; 4] = ["inspector", "timeline", "drawer", "help"];
    let place = |names: &[&str]| names.iter().position(|&name| Some(name) == node.control.as_deref());
    let right = place(&RIGHT).map(|place| LEFT.len() + 1 + place);
    place(&LEFT).or(right).unwrap_or(LEFT.len())
}

struct Reader<'a> {
    nodes: &'a HashMap<NodeId, &'a Node>,
    visible: &'a HashMap<NodeId, Rect>,
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
        if let Some(&visible) = self.visible.get(&id).filter(|_| node.bounds().is_some()) {
            branch.node.bounds = clipped(branch.node.bounds, visible);
        }
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
        place: node.position_in_set().or(node.row_index()).map(|place| place + 1),
        of: node.size_of_set().or(node.row_count()),
        active: node.active_descendant().map(|id| MirrorId(id.0)),
        control: words(node.author_id()),
        bounds,
        children: Vec::new(),
    }
}
