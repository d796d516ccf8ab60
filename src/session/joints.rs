//! Which joint and which vertex the pointer or a choice is about, how the skeleton and the skin are shown, and what joints are
//! called.

use glam::Vec2;

use super::changes::Changes;
use crate::anim::SkinView;
use crate::model::{
    JointIndex, JointNames, JointTree, Model, SavedNames, Skeleton, VertexCounts, hierarchy_fingerprint,
};
use crate::scene::{BoneStyle, Hit, MarkedJoints};

/// A wish about joints. One that the model has not is left out.
#[derive(Clone, Debug, PartialEq)]
pub enum JointCommand {
    /// Selects one, and unfolds what it hangs from, or none.
    Select(Option<JointIndex>),
    /// Selects the bone that is drawn at a point of the picture: x right, y up, −1…1. Beside all bones none.
    SelectAt(Vec2),
    /// Selects the parent of the selected one, if it has one.
    SelectParent,
    /// Selects the first child of the selected one, if it has one; the first root when none is selected.
    SelectChild,
    /// Lets one stand out, or none.
    Hover(Option<JointIndex>),
    /// Lets the bone that is drawn at a point of the picture stand out: x right, y up, −1…1.
    HoverAt(Option<Vec2>),
    /// Selects the vertex nearest to what is drawn of the skin at a point of the picture: x right, y up, −1…1. Beside the skin
    /// none.
    SelectVertexAt(Vec2),
    /// Selects a vertex by its number, or none.
    SelectVertex(Option<u32>),
    /// Folds or unfolds a branch of the tree.
    SetFolded {
        /// Its topmost joint.
        joint: JointIndex,
        /// Whether what hangs from it is left out.
        folded: bool,
    },
    /// Folds or unfolds all branches.
    SetAllFolded(bool),
    /// Names a joint; an empty name takes it away.
    Rename {
        /// Which.
        joint: JointIndex,
        /// What it is called.
        name: String,
    },
    /// Takes the names of [`Session::proposed_names`](crate::session::Session::proposed_names).
    AcceptMirrorNames,
    /// Takes names that were kept, if they belong to a hierarchy like this one. They replace those that are there.
    ImportNames(SavedNames),
    /// Takes all names away.
    ClearNames,
    /// Draws bones in a style.
    SetBoneStyle(BoneStyle),
    /// Shows or hides bones.
    SetBonesVisible(bool),
    /// Shows or hides names at the joints. Names stand only where bones are drawn: showing them shows the bones too.
    SetLabelsVisible(bool),
    /// Shows a number of the skin as colours, or the skin as it is.
    SetSkinView(Option<SkinView>),
    /// Draws the way of a joint through the clip, or leaves it, in turn.
    ToggleTrail(JointIndex),
    /// Leaves all ways.
    ClearTrails,
}

/// A vertex that was selected. It stays the same vertex in another pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SelectedVertex {
    /// Its number in the mesh, which is the file's.
    pub vertex: u32,
    /// Where the pointer met the skin, when it selected it: a position in the pose at the time of the click.
    pub hit: Option<Hit>,
}

/// The joints of the open model, as they are looked at.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joints {
    tree: JointTree,
    counts: VertexCounts,
    fingerprint: u64,
    parents: Vec<Option<JointIndex>>,
    vertex_count: usize,
    names: JointNames,

    marked: MarkedJoints,
    vertex: Option<SelectedVertex>,
    folded: Vec<bool>,
    trails: Vec<JointIndex>,

    bone_style: BoneStyle,
    bones_visible: bool,
    /// Names that are wanted wait while bones are hidden.
    labels_visible: bool,
    skin_view: Option<SkinView>,

    /// What is drawn, or the names, changed since it was last asked.
    changes: Changes,
}

impl Joints {
    /// How many the model has.
    pub fn count(&self) -> usize {
        self.parents.len()
    }

    /// Order and branches.
    pub fn tree(&self) -> &JointTree {
        &self.tree
    }

    /// How many vertices they move.
    pub fn vertex_counts(&self) -> &VertexCounts {
        &self.counts
    }

    /// The one that was selected.
    pub fn selected(&self) -> Option<JointIndex> {
        self.marked.selected
    }

    /// The one that the pointer is over, in the picture, the tree or the timeline.
    pub fn hovered(&self) -> Option<JointIndex> {
        self.marked.hovered
    }

    /// Both.
    pub fn marked(&self) -> MarkedJoints {
        self.marked
    }

    /// The vertex that was selected.
    pub fn selected_vertex(&self) -> Option<&SelectedVertex> {
        self.vertex.as_ref()
    }

    /// Whether the branch of a joint is folded.
    pub fn is_folded(&self, joint: JointIndex) -> bool {
        self.folded.get(joint.index()) == Some(&true)
    }

    /// Those whose way through the clip is drawn, in the order in which they were chosen.
    pub fn trails(&self) -> &[JointIndex] {
        &self.trails
    }

    /// How bones are drawn when they are.
    pub fn bone_style(&self) -> BoneStyle {
        self.bone_style
    }

    /// Whether bones are drawn.
    pub fn bones_visible(&self) -> bool {
        self.bones_visible
    }

    /// Whether names stand at the joints: when they are wanted and bones are drawn.
    pub fn labels_visible(&self) -> bool {
        self.labels_visible && self.bones_visible
    }

    /// The number of the skin that is shown as colours.
    pub fn skin_view(&self) -> Option<SkinView> {
        self.skin_view
    }

    /// What is drawn, or the names, changed since the last call.
    pub(super) fn take_changes(&mut self) -> Changes {
        self.changes.take()
    }

    /// What joints are called.
    pub(super) fn names(&self) -> &JointNames {
        &self.names
    }

    /// Does what was asked, as far as it needs no picture and no other part of the session.
    pub(super) fn apply(&mut self, command: JointCommand, skeleton: &Skeleton) {
        match command {
            JointCommand::Select(joint) => self.select(joint),
            JointCommand::SelectParent => self.select_parent(),
            JointCommand::SelectChild => self.select_child(),
            JointCommand::Hover(joint) => self.hover(joint),
            JointCommand::SelectVertex(vertex) => {
                self.select_vertex(vertex.map(|vertex| SelectedVertex { vertex, hit: None }));
            }
            JointCommand::SetFolded { joint, folded } => {
                if let Some(place) = self.folded.get_mut(joint.index()) {
                    *place = folded;
                }
            }
            JointCommand::SetAllFolded(folded) => self.folded.fill(folded),
            JointCommand::Rename { joint, name } => {
                if let Some(&bone) = skeleton.file_bones().get(joint.index()) {
                    self.change_names(|names| names.set(bone, &name));
                }
            }
            JointCommand::ImportNames(saved) => {
                if let Some(kept) = JointNames::from_saved(&saved, skeleton) {
                    self.change_names(|names| *names = kept);
                }
            }
            JointCommand::ClearNames => self.change_names(|names| *names = JointNames::default()),
            JointCommand::SetBoneStyle(style) => self.show(style, |joints| &mut joints.bone_style),
            JointCommand::SetBonesVisible(visible) => self.show(visible, |joints| &mut joints.bones_visible),
            JointCommand::SetLabelsVisible(visible) => {
                self.show(visible, |joints| &mut joints.labels_visible);
                if visible {
                    self.show(true, |joints| &mut joints.bones_visible);
                }
            }
            JointCommand::SetSkinView(view) => self.show(view, |joints| &mut joints.skin_view),
            JointCommand::ToggleTrail(joint) => self.toggle_trail(joint),
            JointCommand::ClearTrails => self.show(Vec::new(), |joints| &mut joints.trails),
            // What is at a point of the picture, and which joints mirror each other, the session knows.
            JointCommand::SelectAt(_)
            | JointCommand::HoverAt(_)
            | JointCommand::SelectVertexAt(_)
            | JointCommand::AcceptMirrorNames => {}
        }
    }

    pub(super) fn change_names(&mut self, change: impl FnOnce(&mut JointNames)) {
        let before = self.names.clone();
        change(&mut self.names);
        if self.names != before {
            self.changes.names = true;
            self.changes.picture = true;
        }
    }

    fn has(&self, joint: JointIndex) -> bool {
        joint.index() < self.count()
    }

    /// Resets to the joints of another model. With `keeps` set and a hierarchy like before, choices and names stay; how things are shown stays
    /// in any case.
    pub(super) fn reset_for_model(&mut self, model: &Model, keeps: bool) {
        let fingerprint = hierarchy_fingerprint(&model.skeleton);
        let joint_count = model.skeleton.joint_count();
        let before = std::mem::take(self);
        let keeps = keeps && fingerprint == before.fingerprint && joint_count == before.count();
        let tree = JointTree::new(&model.skeleton);
        let shown = Self {
            counts: tree.vertex_counts(&model.skeleton, &model.mesh),
            tree,
            fingerprint,
            parents: model.skeleton.parents().to_vec(),
            vertex_count: model.mesh.vertex_count(),
            folded: vec![false; joint_count],
            bone_style: before.bone_style,
            bones_visible: before.bones_visible,
            labels_visible: before.labels_visible,
            skin_view: before.skin_view,
            ..Self::default()
        };
        *self = if keeps {
            // The vertex goes: it belongs to the old file's mesh.
            Self {
                names: before.names,
                marked: before.marked,
                folded: before.folded,
                trails: before.trails,
                ..shown
            }
        } else {
            shown
        };
        self.changes.names = !keeps;
    }

    pub(super) fn select(&mut self, joint: Option<JointIndex>) {
        if joint.is_some_and(|joint| !self.has(joint)) {
            return;
        }
        if self.marked.selected != joint {
            self.marked.selected = joint;
            self.changes.picture = true;
        }
        let mut above = joint.and_then(|joint| self.parents[joint.index()]);
        while let Some(joint) = above {
            self.folded[joint.index()] = false;
            above = self.parents[joint.index()];
        }
    }

    pub(super) fn hover(&mut self, joint: Option<JointIndex>) {
        if joint.is_none_or(|joint| self.has(joint)) && self.marked.hovered != joint {
            self.marked.hovered = joint;
            self.changes.picture = true;
        }
    }

    fn select_parent(&mut self) {
        let parent = self.selected().and_then(|joint| self.parents[joint.index()]);
        if parent.is_some() {
            self.select(parent);
        }
    }

    fn select_child(&mut self) {
        let child = match self.selected() {
            Some(joint) => self.tree.children(joint).next(),
            None => self.tree.order().first().copied(),
        };
        if child.is_some() {
            self.select(child);
        }
    }

    pub(super) fn select_vertex(&mut self, vertex: Option<SelectedVertex>) {
        let known = vertex.is_none_or(|vertex| (vertex.vertex as usize) < self.vertex_count);
        if known && self.vertex != vertex {
            self.vertex = vertex;
            self.changes.picture = true;
        }
    }

    /// Selects neither joint nor vertex.
    pub(super) fn clear_selection(&mut self) {
        self.select(None);
        self.select_vertex(None);
    }

    fn toggle_trail(&mut self, joint: JointIndex) {
        if !self.has(joint) {
            return;
        }
        match self.trails.iter().position(|&other| other == joint) {
            Some(place) => drop(self.trails.remove(place)),
            None => self.trails.push(joint),
        }
        self.changes.picture = true;
    }

    /// Sets what is shown, and counts it if it changed.
    fn show<T: PartialEq>(&mut self, value: T, place: impl FnOnce(&mut Self) -> &mut T) {
        let place = place(self);
        if *place != value {
            *place = value;
            self.changes.picture = true;
        }
    }
}
