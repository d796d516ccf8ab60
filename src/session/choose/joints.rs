//! Which joint and which vertex are selected or hovered, and which branches of the tree are folded.

use crate::model::{JointIndex, JointTree, Model, VertexCounts, hierarchy_fingerprint};
use crate::scene::{Hit, MarkedJoints};

/// A vertex that was selected. It stays the same vertex in another pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SelectedVertex {
    /// Its number in the mesh, which is the file's.
    pub vertex: u32,
    /// Where the pointer met the skin, when it selected it: a position in the pose at the time of the click.
    pub hit: Option<Hit>,
}

/// The joints of the open model: their tree, and which of them are selected, hovered, folded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joints {
    tree: JointTree,
    counts: VertexCounts,
    fingerprint: u64,
    parents: Vec<Option<JointIndex>>,
    vertex_count: usize,

    marked: MarkedJoints,
    vertex: Option<SelectedVertex>,
    /// The selected vertex is a corner of it, and it was meant.
    triangle: Option<u32>,
    folded: Vec<bool>,
    /// Something else stands out or is selected since the last [`Joints::take_redraw`].
    redraw: bool,
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

    /// The triangle that was selected. Its first corner is the selected vertex.
    pub fn selected_triangle(&self) -> Option<u32> {
        self.triangle
    }

    /// Whether the branch of a joint is folded.
    pub fn is_folded(&self, joint: JointIndex) -> bool {
        self.folded.get(joint.index()) == Some(&true)
    }

    /// Whether something else stands out or is selected since the last call.
    pub(in crate::session) fn take_redraw(&mut self) -> bool {
        std::mem::take(&mut self.redraw)
    }

    fn has(&self, joint: JointIndex) -> bool {
        joint.index() < self.count()
    }

    /// Resets to the joints of another model. With `keeps` set and the same hierarchy as before, selection and folding stay.
    /// Returns whether they stayed.
    pub(in crate::session) fn reset_for_model(&mut self, model: &Model, keeps: bool) -> bool {
        let fingerprint = hierarchy_fingerprint(&model.skeleton);
        let joint_count = model.skeleton.joint_count();
        let before = std::mem::take(self);
        let keeps = keeps && fingerprint == before.fingerprint && joint_count == before.count();
        let tree = JointTree::new(&model.skeleton);
        *self = Self {
            counts: tree.vertex_counts(&model.skeleton, &model.mesh),
            tree,
            fingerprint,
            parents: model.skeleton.parents().to_vec(),
            vertex_count: model.mesh.vertex_count(),
            folded: vec![false; joint_count],
            ..Self::default()
        };
        if keeps {
            self.marked = before.marked;
            self.folded = before.folded;
            // In a mesh of another size a number means another vertex.
            self.vertex = before.vertex.filter(|_| self.vertex_count == before.vertex_count);
        }
        keeps
    }

    pub(in crate::session) fn set_folded(&mut self, joint: JointIndex, folded: bool) {
        if let Some(place) = self.folded.get_mut(joint.index()) {
            *place = folded;
        }
    }

    pub(in crate::session) fn set_all_folded(&mut self, folded: bool) {
        self.folded.fill(folded);
    }

    pub(in crate::session) fn select(&mut self, joint: Option<JointIndex>) {
        if joint.is_some_and(|joint| !self.has(joint)) {
            return;
        }
        if self.marked.selected != joint {
            self.marked.selected = joint;
            self.redraw = true;
        }
        if joint.is_some() {
            self.select_vertex(None);
        }
        let mut above = joint.and_then(|joint| self.parents[joint.index()]);
        while let Some(joint) = above {
            self.folded[joint.index()] = false;
            above = self.parents[joint.index()];
        }
    }

    pub(in crate::session) fn hover(&mut self, joint: Option<JointIndex>) {
        if joint.is_none_or(|joint| self.has(joint)) && self.marked.hovered != joint {
            self.marked.hovered = joint;
            self.redraw = true;
        }
    }

    pub(in crate::session) fn select_parent(&mut self) {
        let parent = self.selected().and_then(|joint| self.parents[joint.index()]);
        if parent.is_some() {
            self.select(parent);
        }
    }

    pub(in crate::session) fn select_child(&mut self) {
        let child = match self.selected() {
            Some(joint) => self.tree.children(joint).next(),
            None => self.tree.order().first().copied(),
        };
        if child.is_some() {
            self.select(child);
        }
    }

    pub(in crate::session) fn select_vertex(&mut self, vertex: Option<SelectedVertex>) {
        let known = vertex.is_none_or(|vertex| (vertex.vertex as usize) < self.vertex_count);
        if known && (self.vertex != vertex || self.triangle.is_some()) {
            self.vertex = vertex;
            self.triangle = None;
            self.redraw = true;
        }
    }

    pub(in crate::session) fn select_triangle(&mut self, triangle: u32, first_corner: u32) {
        self.select(None);
        self.select_vertex(Some(SelectedVertex {
            vertex: first_corner,
            hit: None,
        }));
        self.triangle = Some(triangle);
    }

    /// Selects neither joint nor vertex.
    pub(in crate::session) fn clear_selection(&mut self) {
        self.select(None);
        self.select_vertex(None);
    }
}
