//! What is at a point of the picture, what a click there selects, and what is said of subsets and joints.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3};

use super::Session;
use super::joint_rows::{JointRow, joint_rows};
use super::joints::{JointCommand, Joints, SelectedVertex};
use super::subsets::{SubsetCommand, Subsets};
use crate::anim::dominant_joint;
use crate::model::{JointIndex, JointNames, MirrorPair, SavedNames, Skeleton, mirror_pairs};
use crate::scene::{Hit, pick_joint};

/// How far from a bone the pointer may be, in heights of the picture: 11 pixels of 900.
const PICK_RADIUS: f32 = 0.012;

impl Session {
    /// Brings the picker's vertices to the pose of now.
    pub(super) fn pose_vertices(&mut self) {
        self.pose_now();
        if let Some(open) = &self.content.open {
            let palette = &self.actor.pose.palette;
            self.caches
                .picker
                .update(&open.model.mesh, palette, self.revisions.pose);
        }
    }

    /// What is at a point of the picture: x right, y up, −1…1. Subsets that are left out are looked through, and what alpha
    /// cuts away too. Skins the mesh once a pose.
    pub fn pick(&mut self, pointer: Vec2) -> Option<Hit> {
        if !pointer.is_finite() {
            return None;
        }
        let world_bounds = self.world_bounds();
        let ray = self.view.camera.ray(pointer, self.view.aspect, &world_bounds);
        let world_from_model = self.world_from_model();
        self.pose_vertices();
        self.caches.picker.pick(
            &self.content,
            &self.selection.subsets,
            world_from_model,
            ray,
            self.revisions.maps,
        )
    }

    /// The joint at a point of the picture: x right, y up, −1…1, whether bones are shown or not.
    pub fn joint_at(&mut self, pointer: Vec2) -> Option<JointIndex> {
        if !pointer.is_finite() {
            return None;
        }
        let screen = self.screen();
        pick_joint(self.bones(), &screen, pointer, PICK_RADIUS)
    }

    /// Selects what is shown at a point of the picture (x right, y up, −1…1): a bone while bones are drawn, a vertex while the
    /// skin is coloured, else a subset. Beside all of them nothing is selected, but for the bone whose weights are shown.
    pub(super) fn select_at(&mut self, pointer: Vec2) {
        let bone = self.selection.joints.bones_visible().then(|| self.joint_at(pointer));
        if let Some(bone) = bone.flatten() {
            self.apply_to_joints(JointCommand::Select(Some(bone)));
        } else if self.selection.joints.skin_view().is_some() {
            self.apply_to_joints(JointCommand::SelectVertexAt(pointer));
        } else {
            self.apply_to_subsets(SubsetCommand::SelectAt(pointer));
            self.selection.joints.clear_selection();
        }
    }

    /// Where a point of the model (model space) is in the picture: x right, y up, −1…1. None outside of it and behind the
    /// eye.
    pub fn place_in_picture(&mut self, position: Vec3) -> Option<Vec2> {
        let world = self.world_from_model().transform_point3(position);
        self.screen().place(world).map(Vec3::truncate)
    }

    /// Which subsets are drawn, selected, hovered.
    pub fn subsets(&self) -> &Subsets {
        &self.selection.subsets
    }

    pub(super) fn apply_to_subsets(&mut self, command: SubsetCommand) {
        match command {
            SubsetCommand::SetVisible { subset, visible } => self.selection.subsets.set_visible(subset, visible),
            SubsetCommand::Solo(subset) => self.selection.subsets.toggle_solo(subset),
            SubsetCommand::ShowAll => self.selection.subsets.show_all(),
            SubsetCommand::Select(subset) => self.selection.subsets.select(subset, None),
            SubsetCommand::SelectAt(pointer) => {
                let hit = self.pick(pointer);
                self.selection.subsets.select(hit.map(|hit| hit.submesh), hit);
            }
            SubsetCommand::Hover(subset) => self.selection.subsets.hover(subset),
            SubsetCommand::HoverAt(pointer) => {
                let hit = pointer.and_then(|pointer| self.pick(pointer));
                self.selection.subsets.hover(hit.map(|hit| hit.submesh));
            }
        }
        if self.selection.subsets.selected().is_some() {
            self.selection.joints.clear_selection();
        }
    }

    /// Which joints are selected, hovered, folded, and how they are shown.
    pub fn joints(&self) -> &Joints {
        &self.selection.joints
    }

    /// The joint whose weights the skin shows. The pointer over another one looks ahead; where none is selected, the strongest
    /// one of the selected vertex.
    pub fn weighed_joint(&self) -> Option<JointIndex> {
        let marked = self.selection.joints.marked();
        marked.hovered.or(marked.selected).or_else(|| {
            let vertex = self.selection.joints.selected_vertex()?.vertex;
            let influences = &self.open_model()?.model.mesh.influences;
            dominant_joint(influences.get(vertex as usize)?)
        })
    }

    /// What joints are called.
    pub fn joint_names(&self) -> &JointNames {
        self.selection.joints.names()
    }

    /// Counts changes of the names: another number, other names to keep.
    pub fn joint_names_revision(&self) -> u64 {
        self.revisions.names
    }

    /// The names as plain data, to keep; nothing without a model.
    pub fn saved_joint_names(&self) -> Option<SavedNames> {
        let open = self.open_model()?;
        Some(self.selection.joints.names().saved(&open.model.skeleton))
    }

    /// The name that was given to a joint.
    pub fn joint_name(&self, joint: JointIndex) -> Option<&str> {
        let bones = self.open_model()?.model.skeleton.file_bones();
        self.selection.joints.names().get(*bones.get(joint.index())?)
    }

    /// What a joint is called: its name, or `Bone 12` by its number in the file.
    pub fn joint_label(&self, joint: JointIndex) -> String {
        match self.joint_name(joint) {
            Some(name) => name.to_owned(),
            None => format!("Bone {}", self.bone_number(joint)),
        }
    }

    /// Number and name of a joint, `12 Left hand`; without a name `Bone 12`.
    pub fn numbered_joint_label(&self, joint: JointIndex) -> String {
        match self.joint_name(joint) {
            Some(name) => format!("{} {name}", self.bone_number(joint)),
            None => self.joint_label(joint),
        }
    }

    /// The number of a joint in the file.
    pub(super) fn bone_number(&self, joint: JointIndex) -> u32 {
        let bones = self.open_model().map(|open| open.model.skeleton.file_bones());
        let bone = bones.and_then(|bones| bones.get(joint.index()));
        bone.copied().unwrap_or(joint.0)
    }

    /// Joints that mirror each other in the bind pose.
    pub fn mirror_pairs(&self) -> Vec<MirrorPair> {
        let Some(open) = self.open_model() else {
            return Vec::new();
        };
        mirror_pairs(
            &open.model.skeleton,
            self.selection.joints.tree(),
            self.world_from_model(),
        )
    }

    /// Names for the other sides of mirrored joints of which one has a name, by the joint's number in the file.
    pub fn proposed_names(&self) -> BTreeMap<usize, String> {
        match self.open_model() {
            // Without a name there is nothing to mirror, and no need to search.
            Some(open) if !self.selection.joints.names().is_empty() => self
                .selection
                .joints
                .names()
                .mirrored(&open.model.skeleton, &self.mirror_pairs()),
            _ => BTreeMap::new(),
        }
    }

    pub(super) fn apply_to_joints(&mut self, command: JointCommand) {
        match command {
            JointCommand::SelectAt(pointer) => {
                let joint = self.joint_at(pointer);
                self.selection.joints.select(joint);
            }
            JointCommand::HoverAt(pointer) => {
                let joint = pointer.and_then(|pointer| self.joint_at(pointer));
                self.selection.joints.hover(joint);
            }
            JointCommand::SelectVertexAt(pointer) => {
                let hit = self.pick(pointer);
                self.selection.joints.select_vertex(hit.map(|hit| SelectedVertex {
                    vertex: hit.vertex,
                    hit: Some(hit),
                }));
            }
            JointCommand::AcceptMirrorNames => {
                let proposed = self.proposed_names();
                self.selection.joints.change_names(|names| {
                    for (bone, name) in proposed {
                        names.set(bone as u32, &name);
                    }
                });
            }
            command => {
                let no_skeleton = Skeleton::default();
                let open = self.content.open.as_ref();
                let skeleton = open.map_or(&no_skeleton, |open| &open.model.skeleton);
                self.selection.joints.apply(command, skeleton);
            }
        }
        if self.selection.joints.selected().is_some() || self.selection.joints.selected_vertex().is_some() {
            self.selection.subsets.select(None, None);
        }
    }

    /// The rows of the tree, depth first, in the caller's buffer. With words in `query`: all joints whose name has them,
    /// whatever the case, or whose number in the file they are (`12`, `#12` and `bone 12` alike), and what these hang from,
    /// unfolded.
    pub fn joint_rows(&self, query: &str, rows: &mut Vec<JointRow>) {
        rows.clear();
        if let Some(open) = self.open_model() {
            joint_rows(&open.model.skeleton, self.joints(), query, rows);
        }
    }
}
