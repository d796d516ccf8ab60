//! Which joint and which vertex the pointer or a choice is about, how the skeleton and the skin are shown, and what joints are
//! called.

mod apply;
mod command;

pub use command::JointCommand;

use crate::anim::SkinView;
use crate::model::{JointIndex, JointNames, JointTree, Model, VertexCounts, hierarchy_fingerprint};
use crate::scene::{BoneStyle, Hit, MarkedJoints};

/// A vertex that was selected. It stays the same vertex in another pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SelectedVertex {
    /// Its number in the mesh, which is the file's.
    pub vertex: u32,
    /// Where the pointer met the skin, when it selected it. The place is that of the pose of then.
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

    drawn_revision: u64,
    names_revision: u64,
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

    /// Counts changes of what is drawn.
    pub(super) fn drawn_revision(&self) -> u64 {
        self.drawn_revision
    }

    fn change_names(&mut self, change: impl FnOnce(&mut JointNames)) {
        let before = self.names.clone();
        change(&mut self.names);
        if self.names != before {
            self.names_revision += 1;
            self.drawn_revision += 1;
        }
    }

    fn has(&self, joint: JointIndex) -> bool {
        joint.index() < self.count()
    }

    /// Takes up another model. With `keeps` set and a hierarchy like before, choices and names stay; how things are shown stays
    /// in any case.
    pub(super) fn take_up(&mut self, model: &Model, keeps: bool) {
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
            drawn_revision: before.drawn_revision + 1,
            names_revision: before.names_revision,
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
            Self {
                names_revision: before.names_revision + 1,
                ..shown
            }
        };
    }

    fn select(&mut self, joint: Option<JointIndex>) {
        if joint.is_some_and(|joint| !self.has(joint)) {
            return;
        }
        if self.marked.selected != joint {
            self.marked.selected = joint;
            self.drawn_revision += 1;
        }
        let mut above = joint.and_then(|joint| self.parents[joint.index()]);
        while let Some(joint) = above {
            self.folded[joint.index()] = false;
            above = self.parents[joint.index()];
        }
    }

    fn hover(&mut self, joint: Option<JointIndex>) {
        if joint.is_none_or(|joint| self.has(joint)) && self.marked.hovered != joint {
            self.marked.hovered = joint;
            self.drawn_revision += 1;
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

    fn select_vertex(&mut self, vertex: Option<SelectedVertex>) {
        let known = vertex.is_none_or(|vertex| (vertex.vertex as usize) < self.vertex_count);
        if known && self.vertex != vertex {
            self.vertex = vertex;
            self.drawn_revision += 1;
        }
    }

    /// Selects neither joint nor vertex.
    pub(super) fn let_go(&mut self) {
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
        self.drawn_revision += 1;
    }

    /// Sets what is shown, and counts it if it changed.
    fn show<T: PartialEq>(&mut self, value: T, place: impl FnOnce(&mut Self) -> &mut T) {
        let place = place(self);
        if *place != value {
            *place = value;
            self.drawn_revision += 1;
        }
    }
}
