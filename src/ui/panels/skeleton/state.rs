//! Which of the skeleton's panels are open, and what they read from the session before the layout.

use egui::{Rect, Ui};
use glam::Vec2;

use super::naming::Naming;
use super::numbers::Digits;
use crate::anim::{JointReadout, SkinView, VertexExplanation};
use crate::model::{Handedness, JointIndex, MirrorPair, UpAxis};
use crate::scene::{LabelPlace, joint_colors};
use crate::session::{Command, JointCommand, JointRow, LookCommand, Session};
use crate::ui::kit::Kept;
use crate::ui::window::viewport::in_picture;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::ui) enum SidePage {
    #[default]
    Model,
    Skeleton,
}

/// Which of the skeleton's panels are open, and what they read.
#[derive(Debug, Default)]
pub(in crate::ui) struct SkeletonState {
    pub(in crate::ui) page: SidePage,
    pub(super) reading: Reading,
    pub(super) tree: TreeState,
    pub(super) naming: Naming,
    pub(super) space: Space,
    pub(super) key_part: KeyPart,
    pub(super) keys: KeyList,
    pub(super) mirrored: Mirrored,
    /// The vertex that the panel showed in the last pass.
    pub(super) shown_vertex: Option<u32>,
    pub(in crate::ui) explains: bool,
    /// Whether the matrices of each influence of the explained vertex are unfolded. Kept for the next vertex.
    pub(super) unfolded: [bool; 4],
    /// The joint whose row or link is under the pointer in this pass.
    pub(in crate::ui) hovered: Option<JointIndex>,
    bones: TreeBones,
    /// The pointer if it is over the view: x right, y up, −1…1.
    pointer_in_view: Option<Vec2>,
    model: u64,
}

impl SkeletonState {
    /// Reads what the panels show in this pass.
    pub(in crate::ui) fn read(&mut self, ui: &Ui, session: &mut Session, window: Rect) {
        self.follow_model(session);
        if !has_joints(session) {
            self.page = SidePage::Model;
        }
        self.hovered = None;
        self.tree.focused = None;
        let pointer = ui.input(|input| input.pointer.hover_pos());
        let over_view = |at| ui.ctx().layer_id_at(at) == Some(ui.layer_id());
        let held = ui.input(|input| input.pointer.any_down());
        self.pointer_in_view = pointer
            .filter(|&at| window.contains(at) && !held && over_view(at))
            .map(|at| in_picture(window, at));
        self.reading.take(session, window.height());
    }

    /// Of another model nothing is kept.
    fn follow_model(&mut self, session: &Session) {
        if self.model != session.model_revision() {
            self.model = session.model_revision();
            self.naming = Naming::default();
            self.tree = TreeState::default();
            self.bones = TreeBones::default();
        }
    }

    /// Highlights the joint under the pointer. `elsewhere`: the joint hovered in another panel.
    pub(in crate::ui) fn hover(&self, session: &Session, elsewhere: Option<JointIndex>, commands: &mut Vec<Command>) {
        let bones_at = self.pointer_in_view.filter(|_| session.look().bones_visible);
        match (self.hovered.or(elsewhere).or(self.tree.focused), bones_at) {
            (None, Some(pointer)) => commands.push(JointCommand::HoverAt(Some(pointer)).into()),
            (hovered, _) if session.joints().hovered() != hovered => {
                commands.push(JointCommand::Hover(hovered).into());
            }
            _ => {}
        }
    }

    /// Whether a click in the view is about bones and vertices. Always on a coloured skin. Else the side panel decides: while it is seen, by
    /// its page; while it is not, by whether bones are drawn.
    pub(in crate::ui) fn picks_bones(&self, session: &Session, page_seen: bool) -> bool {
        let by_page = match page_seen {
            true => self.page == SidePage::Skeleton,
            false => session.look().bones_visible,
        };
        session.look().skin_view.is_some() || by_page
    }

    /// Draws the bones while the tree is the page, unless the person hid them.
    pub(in crate::ui) fn show_bones_with_tree(&mut self, session: &Session, commands: &mut Vec<Command>) {
        let (visible, tree) = (session.look().bones_visible, self.page == SidePage::Skeleton);
        let bones = &mut self.bones;
        if bones.tree != tree {
            bones.tree = tree;
            let shows = tree && !visible && !bones.refused;
            if shows || (bones.shown && visible) {
                commands.push(LookCommand::SetBonesVisible(shows).into());
            }
            bones.shown = shows;
        } else if bones.shown != visible {
            bones.refused = bones.shown;
            bones.shown = false;
        }
    }

    /// Shows a page of the side panel. The tree scrolls to the joint selected next.
    pub(in crate::ui) fn show_page(&mut self, session: &Session, page: SidePage) {
        self.page = if has_joints(session) { page } else { SidePage::Model };
        self.naming.proposing = false;
        self.tree.reset();
    }

    /// Shows a page as a link says, which also says whether bones are drawn.
    pub(in crate::ui) fn show_linked_page(&mut self, session: &Session, page: SidePage) {
        // It may come before the first pass with its model.
        self.follow_model(session);
        self.show_page(session, page);
        self.bones = TreeBones {
            tree: self.page == SidePage::Skeleton,
            ..TreeBones::default()
        };
    }

    /// Whether a joint is being named in its row.
    pub(in crate::ui) fn is_naming(&self) -> bool {
        self.naming.of.is_some()
    }

    /// Whether a field for a name will appear. Its row may have to scroll into view first.
    pub(in crate::ui) fn awaits_field(&self) -> bool {
        self.naming.awaits_field()
    }

    /// Ends the naming of a joint whose row was not shown in this pass.
    pub(in crate::ui) fn settle_naming(&mut self, ui: &Ui, commands: &mut Vec<Command>) {
        self.naming.settle(ui, commands);
    }

    /// Begins to name the selected joint in its row.
    pub(in crate::ui) fn rename_selected(&mut self, ui: &Ui, session: &Session) {
        if let Some(joint) = session.joints().selected() {
            self.page = SidePage::Skeleton;
            self.tree.reveal(joint);
            self.naming.begin(ui, session, joint);
        }
    }
}

/// Whether the bones are drawn for the tree.
#[derive(Debug, Default)]
struct TreeBones {
    tree: bool,
    /// They are drawn for that reason alone.
    shown: bool,
    refused: bool,
}

/// Whether a joint or a vertex is selected.
pub(in crate::ui) fn is_inspected(session: &Session) -> bool {
    session.joints().selected().is_some() || session.joints().selected_vertex().is_some()
}

pub(in crate::ui) fn has_joints(session: &Session) -> bool {
    session.joints().count() > 0
}

#[derive(Debug, Default)]
pub(super) struct TreeState {
    pub(super) query: String,
    pub(super) rows: Vec<JointRow>,
    /// The joint whose row Tab stops at, once a key or a selection has chosen one.
    pub(super) stop: Option<JointIndex>,
    /// The joint whose row has the keyboard in this pass.
    pub(super) focused: Option<JointIndex>,
    pub(super) typed: Typed,
    /// The selected joint to which the tree has scrolled. Without it, it does again.
    pub(super) shown: Option<JointIndex>,
    /// Height that the rows had in the last pass.
    pub(super) room: Option<f32>,
}

/// Typing goes on if the next letter comes within this time.
const TYPING_SECS: f64 = 1.0;

/// Letters that were typed to find a row.
#[derive(Debug, Default)]
pub(super) struct Typed {
    letters: String,
    at_secs: f64,
}

impl Typed {
    /// Whether letters that come now join those before.
    pub(super) fn goes_on(&self, now_secs: f64) -> bool {
        !self.letters.is_empty() && now_secs - self.at_secs <= TYPING_SECS
    }

    /// Adds letters. Returns all that were typed without a pause, and whether there were some before these.
    pub(super) fn add(&mut self, letters: &str, now_secs: f64) -> (&str, bool) {
        let more = self.goes_on(now_secs);
        if !more {
            self.letters.clear();
        }
        self.letters += letters;
        self.at_secs = now_secs;
        (&self.letters, more)
    }
}

impl TreeState {
    /// Clears the search if it leaves out a joint, and scrolls to the joint.
    pub(super) fn reveal(&mut self, joint: JointIndex) {
        if !self.rows.iter().any(|row| row.joint == joint) {
            self.query.clear();
        }
        self.shown = None;
    }

    /// Clears the search, and scrolls to the selected joint again.
    pub(super) fn reset(&mut self) {
        self.query.clear();
        self.shown = None;
    }

    /// Says that a joint was selected by its own row, so that the tree does not scroll.
    pub(super) fn select_in_place(&mut self, joint: JointIndex) {
        self.shown = Some(joint);
        self.stop = Some(joint);
    }

    /// The place of the row that Tab stops at.
    pub(super) fn stop(&self, rows: &[JointRow], selected: Option<JointIndex>) -> usize {
        let place = |joint: JointIndex| rows.iter().position(|row| row.joint == joint);
        self.stop.and_then(place).or(selected.and_then(place)).unwrap_or(0)
    }

    /// The index of the selected joint's row, once after each selection.
    pub(super) fn row_to_show(&mut self, selected: Option<JointIndex>) -> Option<usize> {
        if self.shown == selected {
            return None;
        }
        self.shown = selected;
        self.stop = selected.or(self.stop);
        self.rows.iter().position(|row| Some(row.joint) == selected)
    }
}

/// What a transform is relative to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Space {
    /// The parent.
    #[default]
    Local,
    Model,
}

/// Which part of the keys is listed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum KeyPart {
    #[default]
    Position,
    Rotation,
    Scale,
}

/// Which joints mirror each other, for a model and its axes.
#[derive(Debug, Default)]
pub(super) struct Mirrored(Kept<(u64, Handedness, UpAxis), Vec<MirrorPair>>);

impl Mirrored {
    /// The joint that mirrors another one in the bind pose.
    pub(super) fn partner(&mut self, session: &Session, joint: JointIndex) -> Option<JointIndex> {
        let of = (session.model_revision(), session.handedness(), session.up_axis());
        let pairs = self.0.of(of, || session.mirror_pairs());
        pairs.iter().find_map(|pair| match joint {
            joint if joint == pair.left => Some(pair.right),
            joint if joint == pair.right => Some(pair.left),
            _ => None,
        })
    }
}

#[derive(Debug, Default)]
pub(super) struct KeyList {
    /// The joint, the clip and the revision of the clips for which it is open.
    pub(super) opened: Option<(JointIndex, Option<usize>, u64)>,
    /// The key that Tab stops at, once keys or a click have chosen one. Otherwise it is the key in force.
    pub(super) stop: Option<usize>,
}

/// Least distance between the names of two joints, in points.
const LABEL_SPACING: f32 = 22.0;

/// What was read, in buffers that are reused.
#[derive(Debug, Default)]
pub(super) struct Reading {
    pub(super) labels: Vec<LabelPlace>,
    pub(super) joint: Option<JointReadout>,
    pub(super) vertex: Option<VertexExplanation>,
    /// Digits of the numbers of joint and vertex.
    pub(super) digits: Digits,
    /// The vertex's position in the picture: x right, y up, −1…1.
    pub(super) vertex_at: Option<Vec2>,
    /// Where the corners of the selected triangle are there.
    pub(super) corners_at: Option<[Vec2; 3]>,
    /// Colour of each joint (sRGB) while the skin shows the strongest joint of each vertex.
    pub(super) colors_srgb: Vec<[u8; 4]>,
    colors_of: Option<u64>,
}

impl Reading {
    /// Reads a session whose picture has this height, in points.
    pub(super) fn take(&mut self, session: &mut Session, height: f32) {
        session.joint_labels(LABEL_SPACING / height.max(1.0), &mut self.labels);
        let bounds = session.open_model().map(|open| &open.bind_bounds);
        self.digits = bounds.map_or_else(Digits::default, Digits::for_bounds);
        let selected = session.joints().selected();
        self.joint = selected.and_then(|joint| session.inspect_joint(joint));
        self.vertex = session.explain_vertex();
        let position = self.vertex.as_ref().map(|explained| explained.position);
        self.vertex_at = position.and_then(|position| session.place_in_picture(position));
        let corners = session.selected_corners();
        self.corners_at = corners.and_then(|corners| {
            let [a, b, c] = corners.map(|corner| session.place_in_picture(corner));
            Some([a?, b?, c?])
        });

        let shown = session.look().skin_view == Some(SkinView::DominantJoint);
        let wanted = shown.then_some(session.model_revision());
        if self.colors_of != wanted {
            self.colors_of = wanted;
            self.colors_srgb = match session.open_model().filter(|_| shown) {
                Some(open) => joint_colors(&open.model.skeleton),
                None => Vec::new(),
            };
        }
    }
}
