//! The skeleton and the skin: tree, numbers, marks in the view, what is drawn of them.

mod digits;
mod formula;
mod joint_panel;
mod key_table;
mod legend;
mod marks;
mod names;
mod numbers;
mod overlay_rows;
mod reading;
mod tree;
mod tree_row;
mod vertex_panel;
mod vertex_sum;

use egui::{Rect, Ui};

pub(super) use joint_panel::show as show_inspector;
pub(super) use legend::{CARD_HEIGHT, LegendShape, STRIP_HEIGHT, has_legend, show as show_legend};
pub(super) use marks::show as show_marks;
pub(super) use overlay_rows::{any_shown, show as show_overlay_rows};
pub(super) use tree::show as show_tree;

use super::viewport::in_picture;
use super::widgets::segmented;
use crate::model::JointIndex;
use crate::session::{Command, JointCommand, Session};
use joint_panel::Space;
use key_table::KeyPart;
use names::Naming;
use reading::Reading;
use tree::TreeState;

/// What the panel on the left is about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum SidePage {
    /// Facts, subsets, textures.
    #[default]
    Model,
    /// The tree of joints.
    Skeleton,
}

/// What of the skeleton's panels is open, and what they read.
#[derive(Debug, Default)]
pub(super) struct SkeletonState {
    pub(super) page: SidePage,
    reading: Reading,
    tree: TreeState,
    naming: Naming,
    space: Space,
    key_part: KeyPart,
    explains: bool,
    /// Influences of the explained vertex whose matrices are shown, by slot: the next vertex looks like this one.
    unfolded: [bool; 4],
    /// The joint whose row or link is under the pointer in this pass.
    hovered: Option<JointIndex>,
    /// Where the pointer is over the view itself: x right, y up, −1…1.
    pointer_in_view: Option<glam::Vec2>,
    model: u64,
}

impl SkeletonState {
    /// Reads what the panels of this pass show.
    pub(super) fn read(&mut self, ui: &Ui, session: &mut Session, window: Rect) {
        if self.model != session.model_revision() {
            self.model = session.model_revision();
            self.naming = Naming::default();
            self.tree = TreeState::default();
        }
        if !has_joints(session) {
            self.page = SidePage::Model;
        }
        self.hovered = None;
        let pointer = ui.input(|input| input.pointer.hover_pos());
        let over_view = |at| ui.ctx().layer_id_at(at) == Some(ui.layer_id());
        let held = ui.input(|input| input.pointer.any_down());
        self.pointer_in_view = pointer
            .filter(|&at| window.contains(at) && !held && over_view(at))
            .map(|at| in_picture(window, at));
        self.reading.take(session, window.height());
    }

    /// Lets the joint under the pointer stand out; `elsewhere` it is in another panel.
    pub(super) fn hover(&self, session: &Session, elsewhere: Option<JointIndex>, commands: &mut Vec<Command>) {
        let bones_at = self.pointer_in_view.filter(|_| session.joints().bones_visible());
        match (self.hovered.or(elsewhere), bones_at) {
            (None, Some(pointer)) => commands.push(JointCommand::HoverAt(Some(pointer)).into()),
            (hovered, _) if session.joints().hovered() != hovered => {
                commands.push(JointCommand::Hover(hovered).into());
            }
            _ => {}
        }
    }

    /// Turns the panel on the left to a page; the tree scrolls to the joint that is selected next.
    pub(super) fn show_page(&mut self, session: &Session, page: SidePage) {
        self.page = if has_joints(session) { page } else { SidePage::Model };
        self.naming.proposing = false;
        self.tree.reset();
    }

    /// Whether a joint is being named in its row.
    pub(super) fn is_naming(&self) -> bool {
        self.naming.of.is_some()
    }

    /// Whether a field for a name is on its way: its row may have to be scrolled to.
    pub(super) fn awaits_field(&self) -> bool {
        self.naming.awaits_field()
    }

    /// Ends the naming of a joint whose row was not shown in this pass.
    pub(super) fn settle_naming(&mut self, ui: &Ui, commands: &mut Vec<Command>) {
        self.naming.settle(ui, commands);
    }

    /// Lets the selected joint be named in its row.
    pub(super) fn rename_selected(&mut self, ui: &Ui, session: &Session) {
        if let Some(joint) = session.joints().selected() {
            self.page = SidePage::Skeleton;
            self.tree.reveal(joint);
            self.naming.begin(ui, session, joint);
        }
    }
}

/// Whether the inspector is about a joint or a vertex.
pub(super) fn is_inspected(session: &Session) -> bool {
    session.joints().selected().is_some() || session.joints().selected_vertex().is_some()
}

pub(super) fn has_joints(session: &Session) -> bool {
    session.joints().count() > 0
}

/// The heading of the panel on the left: which of its pages is shown.
pub(super) fn show_pages(ui: &mut Ui, state: &mut SkeletonState) {
    let pages = [(SidePage::Model, "Model"), (SidePage::Skeleton, "Skeleton")];
    if let Some(page) = segmented(ui, "Panel", &pages, Some(state.page)) {
        state.page = page;
    }
}
