//! What a session says of its joints, and how wishes about them change it.

use super::{JointCommand, Joints, SelectedVertex};
use crate::anim::dominant_joint;
use crate::model::{JointIndex, JointNames, MirrorPair, SavedNames, mirror_pairs};
use crate::scene::MarkedJoints;
use crate::session::Session;

impl Session {
    /// Which joints are selected, hovered, folded, and how they are shown.
    pub fn joints(&self) -> &Joints {
        &self.joints
    }

    /// The joint whose weights the skin shows. The pointer over another one looks ahead; where none is selected, the strongest
    /// one of the selected vertex.
    pub fn weighed_joint(&self) -> Option<JointIndex> {
        let MarkedJoints { hovered, selected } = self.joints.marked;
        hovered.or(selected).or_else(|| {
            let vertex = self.joints.selected_vertex()?.vertex;
            let influences = &self.open_model()?.model.mesh.influences;
            dominant_joint(influences.get(vertex as usize)?)
        })
    }

    /// What joints are called.
    pub fn joint_names(&self) -> &JointNames {
        &self.joints.names
    }

    /// Counts changes of the names: another number, other names to keep.
    pub fn joint_names_revision(&self) -> u64 {
        self.joints.names_revision
    }

    /// The names as plain data, to keep; nothing without a model.
    pub fn saved_joint_names(&self) -> Option<SavedNames> {
        let open = self.open_model()?;
        Some(self.joints.names.saved(&open.model.skeleton))
    }

    /// The name that was given to a joint.
    pub fn joint_name(&self, joint: JointIndex) -> Option<&str> {
        let bones = self.open_model()?.model.skeleton.file_bones();
        self.joints.names.get(*bones.get(joint.index())?)
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
    fn bone_number(&self, joint: JointIndex) -> u32 {
        let bones = self.open_model().map(|open| open.model.skeleton.file_bones());
        let bone = bones.and_then(|bones| bones.get(joint.index()));
        bone.copied().unwrap_or(joint.0)
    }

    /// Joints that mirror each other in the bind pose.
    pub fn mirror_pairs(&self) -> Vec<MirrorPair> {
        let Some(open) = self.open_model() else {
            return Vec::new();
        };
        mirror_pairs(&open.model.skeleton, &self.joints.tree, self.world_from_model())
    }

    /// Names for the other sides of mirrored joints of which one has a name, by the joint's number in the file.
    pub fn proposed_names(&self) -> std::collections::BTreeMap<usize, String> {
        match self.open_model() {
            // Without a name there is nothing to mirror, and no need to search.
            Some(open) if !self.joints.names.is_empty() => {
                self.joints.names.mirrored(&open.model.skeleton, &self.mirror_pairs())
            }
            _ => std::collections::BTreeMap::new(),
        }
    }

    pub(in crate::session) fn apply_to_joints(&mut self, command: JointCommand) {
        match command {
            JointCommand::Select(joint) => self.joints.select(joint),
            JointCommand::SelectAt(pointer) => {
                let joint = self.joint_at(pointer);
                self.joints.select(joint);
            }
            JointCommand::SelectParent => self.joints.select_parent(),
            JointCommand::SelectChild => self.joints.select_child(),
            JointCommand::Hover(joint) => self.joints.hover(joint),
            JointCommand::HoverAt(pointer) => {
                let joint = pointer.and_then(|pointer| self.joint_at(pointer));
                self.joints.hover(joint);
            }
            JointCommand::SelectVertexAt(pointer) => {
                let hit = self.pick(pointer);
                self.joints.select_vertex(hit.map(|hit| SelectedVertex {
                    vertex: hit.vertex,
                    hit: Some(hit),
                }));
            }
            JointCommand::SelectVertex(vertex) => {
                self.joints
                    .select_vertex(vertex.map(|vertex| SelectedVertex { vertex, hit: None }));
            }
            JointCommand::SetFolded { joint, folded } => {
                if let Some(place) = self.joints.folded.get_mut(joint.index()) {
                    *place = folded;
                }
            }
            JointCommand::SetAllFolded(folded) => self.joints.folded.fill(folded),
            JointCommand::Rename { joint, name } => self.rename_joint(joint, &name),
            JointCommand::AcceptMirrorNames => {
                let proposed = self.proposed_names();
                self.joints.change_names(|names| {
                    for (bone, name) in proposed {
                        names.set(bone as u32, &name);
                    }
                });
            }
            JointCommand::ImportNames(saved) => {
                let skeleton = self.open.as_ref().map(|open| &open.model.skeleton);
                if let Some(kept) = skeleton.and_then(|skeleton| JointNames::from_saved(&saved, skeleton)) {
                    self.joints.change_names(|names| *names = kept);
                }
            }
            JointCommand::ClearNames => self.joints.change_names(|names| *names = JointNames::default()),
            JointCommand::SetBoneStyle(style) => self.joints.show(style, |joints| &mut joints.bone_style),
            JointCommand::SetBonesVisible(visible) => self.joints.show(visible, |joints| &mut joints.bones_visible),
            JointCommand::SetLabelsVisible(visible) => {
                self.joints.show(visible, |joints| &mut joints.labels_visible);
                if visible {
                    self.joints.show(true, |joints| &mut joints.bones_visible);
                }
            }
            JointCommand::SetSkinView(view) => self.joints.show(view, |joints| &mut joints.skin_view),
            JointCommand::ToggleTrail(joint) => self.joints.toggle_trail(joint),
            JointCommand::ClearTrails => self.joints.show(Vec::new(), |joints| &mut joints.trails),
        }
    }

    fn rename_joint(&mut self, joint: JointIndex, name: &str) {
        let bones = self.open_model().map(|open| open.model.skeleton.file_bones());
        if let Some(&bone) = bones.and_then(|bones| bones.get(joint.index())) {
            self.joints.change_names(|names| names.set(bone, name));
        }
    }
}
