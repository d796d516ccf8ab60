//! What is at a point of the picture, and which joints, vertices and submeshes are selected, hovered, folded.

use glam::{Vec2, Vec3};

use super::joint_rows::{JointRow, joint_rows};
use super::joints::{Joints, SelectedVertex};
use super::picking::first_met;
use super::submeshes::Submeshes;
use crate::anim::dominant_joint;
use crate::model::JointIndex;
use crate::scene::{Aabb, Hit, pick_joint};
use crate::session::{Caches, Session};

/// How far from a bone the pointer may be, in heights of the picture: 14 pixels of 900.
const PICK_RADIUS: f32 = 0.016;

/// How much larger than the box of a clip is taken what may reach out of it between two keys.
const REACH_BETWEEN_KEYS: f32 = 0.05;

/// A command about joints and vertices. One that the model does not have is ignored. Selecting one clears the selected submesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointCommand {
    /// Selects one, clears the selected vertex and unfolds the branches above it, or selects none.
    Select(Option<JointIndex>),
    /// Selects what is at a point of the picture: x right, y up, −1…1. Another instance there is selected first.
    /// - Plain skin: the nearest bone within a few pixels, else the strongest bone of the skin there.
    /// - Coloured skin: a bone that is drawn there, else the nearest vertex.
    /// - Beside the model: nothing; on a coloured skin the bone whose weights are shown stays selected.
    SelectAt(Vec2),
    /// Selects the parent of the selected one, if it has one.
    SelectParent,
    /// Selects the first child of the selected one, if it has one; the first root when none is selected.
    SelectChild,
    /// Highlights one, or none.
    Hover(Option<JointIndex>),
    /// Highlights the bone that is drawn at a point of the picture: x right, y up, −1…1.
    HoverAt(Option<Vec2>),
    /// Selects a vertex by its number, or none.
    SelectVertex(Option<u32>),
    /// Selects a triangle by its number in the file, with its first corner as the selected vertex.
    SelectTriangle(u32),
    /// Folds or unfolds a branch of the tree.
    SetFolded {
        /// Its topmost joint.
        joint: JointIndex,
        /// Whether what hangs from it is left out.
        folded: bool,
    },
    /// Folds or unfolds all branches.
    SetAllFolded(bool),
}

/// A command about a submesh, by its index. An index without a submesh is ignored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SubmeshCommand {
    /// Shows or hides one. A solo ends; the others stay shown or hidden as they are on screen.
    SetVisible {
        submesh: usize,
        visible: bool,
    },
    /// Shows one alone. A second time for the same one restores what was shown before.
    Solo(usize),
    ShowAll,
    /// Selects one, or none.
    Select(Option<usize>),
    /// Selects what is drawn at a point of the picture: x right, y up, −1…1. The ground and the sky select none. Either way it
    /// clears the selected joint and vertex. Another instance there is selected first. A bone that is drawn there is selected instead.
    SelectAt(Vec2),
    /// Highlights one, or none.
    Hover(Option<usize>),
    /// Highlights what is drawn of the selected instance at a point of the picture: x right, y up, −1…1.
    HoverAt(Option<Vec2>),
}

impl Session {
    /// Brings the picker's vertices to the pose of now.
    pub(in crate::session) fn pose_vertices(&mut self) {
        self.pose_now();
        if let Some(open) = &self.content.open {
            let palette = &self.actor.pose.palette;
            self.caches
                .picker
                .update(&open.model.mesh, palette, self.revisions.pose);
        }
    }

    /// What is at a point of the picture, whichever instance it is of: x right, y up, −1…1. Submeshes that are left out are looked
    /// through, and what alpha cuts away too. Skins the mesh once a pose.
    pub fn pick(&mut self, pointer: Vec2) -> Option<Hit> {
        self.pick_instance(pointer).map(|(_, hit)| hit)
    }

    /// What is at a point of the picture, and of which instance.
    fn pick_instance(&mut self, pointer: Vec2) -> Option<(usize, Hit)> {
        if !pointer.is_finite() {
            return None;
        }
        let world_bounds = self.world_bounds();
        let ray = self.view.camera.ray(pointer, self.view.aspect, &world_bounds);
        let world_from_model = self.world_from_model();
        self.pose_vertices();
        let (selected, has_crowd) = (self.crowd().selected, self.instances.are_many());
        if has_crowd {
            self.pose_crowd(self.quality.poses_all());
        }
        let formation = self.formation();
        let joint_count = self.selection.joints.count();
        let (content, submeshes) = (&self.content, &self.selection.submeshes);
        let Caches { picker, crowd, .. } = &mut self.caches;
        picker.prepare(content, self.revisions.maps);
        if !has_crowd {
            let hit = picker.pick(content, submeshes, world_from_model, ray)?;
            return Some((selected, hit));
        }
        // Between two keys a turning part may reach a little out of its clip's box.
        let room = formation.reach.size() * REACH_BETWEEN_KEYS;
        let mut entered = picker.take_list();
        entered.extend((0..self.instances.count()).filter_map(|instance| {
            let offset = self.instances.offset(&formation, instance);
            let reach = Aabb {
                min: formation.reach.min + offset - room,
                max: formation.reach.max + offset + room,
            };
            Some((ray.enters(&reach)?, instance))
        }));
        let first = first_met(&mut entered, |instance| {
            if instance == selected {
                return picker.pick(content, submeshes, world_from_model, ray);
            }
            picker.pick_other(content, submeshes, crowd.posed(instance, joint_count)?, ray)
        });
        picker.keep_list(entered);
        first
    }

    /// Selects the instance that is at a point of the picture. Returns what is there of it.
    fn select_instance_at(&mut self, pointer: Vec2) -> Option<Hit> {
        let (instance, hit) = self.pick_instance(pointer)?;
        self.select_instance(instance);
        Some(hit)
    }

    /// What is at a point of the picture, if it is of the selected instance.
    fn pick_selected(&mut self, pointer: Vec2) -> Option<Hit> {
        let (instance, hit) = self.pick_instance(pointer)?;
        (instance == self.crowd().selected).then_some(hit)
    }

    /// Whether another instance than the selected one is at a point of the picture.
    fn is_other_at(&mut self, pointer: Vec2) -> bool {
        self.instances.are_many()
            && self
                .pick_instance(pointer)
                .is_some_and(|(instance, _)| instance != self.instances.state().selected)
    }

    /// The joint of the selected instance at a point of the picture: x right, y up, −1…1, whether bones are shown or not. Where they
    /// are not shown, what is behind another instance is not there.
    pub fn joint_at(&mut self, pointer: Vec2) -> Option<JointIndex> {
        if !pointer.is_finite() || (!self.view.look.bones_visible && self.is_other_at(pointer)) {
            return None;
        }
        let screen = self.screen();
        pick_joint(self.bones(), &screen, pointer, PICK_RADIUS)
    }

    fn drawn_bone_at(&mut self, pointer: Vec2) -> Option<JointIndex> {
        self.view.look.bones_visible.then(|| self.joint_at(pointer)).flatten()
    }

    /// Selects the bone or the vertex at a point of the picture, as [`JointCommand::SelectAt`] says.
    fn select_joint_at(&mut self, pointer: Vec2) {
        let colored = self.view.look.skin_view.is_some();
        let is_picked = self.view.look.bones_visible || !colored;
        let bone = is_picked.then(|| self.joint_at(pointer)).flatten();
        if bone.is_some() {
            self.selection.joints.select(bone);
            return;
        }
        let was_selected = self.crowd().selected;
        let hit = self.select_instance_at(pointer);
        let bone = (is_picked && self.crowd().selected != was_selected).then(|| self.joint_at(pointer));
        if let Some(bone) = bone.flatten() {
            self.selection.joints.select(Some(bone));
        } else if colored {
            self.selection.joints.select_vertex(hit.map(|hit| SelectedVertex {
                vertex: hit.vertex,
                hit: Some(hit),
            }));
        } else {
            let bone = hit.and_then(|hit| self.strongest_joint(hit.vertex));
            self.selection.joints.clear_selection();
            self.selection.joints.select(bone);
        }
        self.selection.submeshes.select(None, None);
    }

    /// The joint that moves a vertex most. None if no joint moves it.
    fn strongest_joint(&self, vertex: u32) -> Option<JointIndex> {
        let influences = &self.open_model()?.model.mesh.influences;
        dominant_joint(influences.get(vertex as usize)?)
    }

    /// Where a point of the model (model space) is in the picture: x right, y up, −1…1. None outside of it and behind the
    /// eye.
    pub fn place_in_picture(&mut self, position: Vec3) -> Option<Vec2> {
        let world = self.world_from_model().transform_point3(position);
        self.screen().place(world).map(Vec3::truncate)
    }

    /// Which submeshes are drawn, selected, hovered.
    pub fn submeshes(&self) -> &Submeshes {
        &self.selection.submeshes
    }

    pub(in crate::session) fn apply_to_submeshes(&mut self, command: SubmeshCommand) {
        match command {
            SubmeshCommand::SetVisible { submesh, visible } => self.selection.submeshes.set_visible(submesh, visible),
            SubmeshCommand::Solo(submesh) => self.selection.submeshes.toggle_solo(submesh),
            SubmeshCommand::ShowAll => self.selection.submeshes.show_all(),
            SubmeshCommand::Select(submesh) => self.selection.submeshes.select(submesh, None),
            SubmeshCommand::SelectAt(pointer) if self.drawn_bone_at(pointer).is_some() => self.select_joint_at(pointer),
            SubmeshCommand::SelectAt(pointer) => {
                let hit = self.select_instance_at(pointer);
                self.selection.submeshes.select(hit.map(|hit| hit.submesh), hit);
                self.selection.joints.clear_selection();
            }
            SubmeshCommand::Hover(submesh) => self.selection.submeshes.hover(submesh),
            SubmeshCommand::HoverAt(pointer) => {
                let hit = pointer.and_then(|pointer| self.pick_selected(pointer));
                self.selection.submeshes.hover(hit.map(|hit| hit.submesh));
            }
        }
        if self.selection.submeshes.selected().is_some() {
            self.selection.joints.clear_selection();
        }
    }

    /// Which joints are selected, hovered, folded.
    pub fn joints(&self) -> &Joints {
        &self.selection.joints
    }

    /// The joint whose weights the skin shows: the hovered one, else the selected one, else the strongest one of the selected
    /// vertex.
    pub fn weighed_joint(&self) -> Option<JointIndex> {
        let marked = self.selection.joints.marked();
        marked.hovered.or(marked.selected).or_else(|| {
            let vertex = self.selection.joints.selected_vertex()?.vertex;
            self.strongest_joint(vertex)
        })
    }

    pub(in crate::session) fn apply_to_joints(&mut self, command: JointCommand) {
        match command {
            JointCommand::SelectAt(pointer) => self.select_joint_at(pointer),
            JointCommand::HoverAt(pointer) => {
                let joint = pointer.and_then(|pointer| self.joint_at(pointer));
                self.selection.joints.hover(joint);
            }
            JointCommand::Select(joint) => self.selection.joints.select(joint),
            JointCommand::SelectParent => self.selection.joints.select_parent(),
            JointCommand::SelectChild => self.selection.joints.select_child(),
            JointCommand::Hover(joint) => self.selection.joints.hover(joint),
            JointCommand::SelectVertex(vertex) => {
                let vertex = vertex.map(|vertex| SelectedVertex { vertex, hit: None });
                self.selection.joints.select_vertex(vertex);
            }
            JointCommand::SelectTriangle(triangle) => {
                let corners = self.open_model().and_then(|open| open.model.mesh.triangle(triangle));
                if let Some([first, ..]) = corners {
                    self.selection.joints.select_triangle(triangle, first);
                }
            }
            JointCommand::SetFolded { joint, folded } => self.selection.joints.set_folded(joint, folded),
            JointCommand::SetAllFolded(folded) => self.selection.joints.set_all_folded(folded),
        }
        if self.selection.joints.selected().is_some() || self.selection.joints.selected_vertex().is_some() {
            self.selection.submeshes.select(None, None);
        }
    }

    /// The rows of the tree, depth first, in the caller's buffer. With words in `query`: all joints whose name has them,
    /// whatever the case, or whose number in the file they are (`12`, `#12` and `bone 12` alike), and what these hang from,
    /// unfolded.
    pub fn joint_rows(&self, query: &str, rows: &mut Vec<JointRow>) {
        rows.clear();
        if let Some(open) = self.open_model() {
            joint_rows(&open.model.skeleton, self.joints(), self.joint_names(), query, rows);
        }
    }
}
