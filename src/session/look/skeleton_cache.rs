//! The bones in the world and the colours of the skin, made anew only when what they are made from is different.

use glam::{Affine3A, Vec3};

use crate::anim::{ModelPose, SkinView, Stretch, dominant_joints, influence_counts, joint_weights};
use crate::model::{Handedness, JointIndex, Model, Skeleton, UpAxis};
use crate::scene::{Bones, colors_of_counts, colors_of_joints, colors_of_values, joint_colors, legend};

/// Buffers that are kept from pose to pose.
#[derive(Debug, Default)]
pub(in crate::session) struct SkeletonCache {
    placed: Option<PlaceKey>,
    bones: Bones,
    values: Vec<f32>,
    counts: Vec<u8>,
    joints: Vec<Option<JointIndex>>,
    /// With the revision of its model.
    stretch: Option<(u64, Stretch)>,
}

/// What the places of bones in the world depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::session) struct PlaceKey {
    pub(in crate::session) pose_revision: u64,
    pub(in crate::session) handedness: Handedness,
    pub(in crate::session) up_axis: UpAxis,
}

/// What the colours of a skin depend on: the same key, the same colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinColorsKey {
    pub(in crate::session) view: SkinView,
    pub(in crate::session) model_revision: u64,
    pub(in crate::session) joint: Option<JointIndex>,
    pub(in crate::session) pose_revision: Option<u64>,
}

impl SkinColorsKey {
    pub(in crate::session) fn needs_posed_vertices(&self) -> bool {
        self.pose_revision.is_some()
    }
}

impl SkeletonCache {
    pub(in crate::session) fn is_placed(&self, key: PlaceKey) -> bool {
        self.placed == Some(key)
    }

    /// Places the bones of a pose in the world.
    pub(in crate::session) fn place(
        &mut self,
        key: PlaceKey,
        skeleton: &Skeleton,
        pose: &ModelPose,
        world_from_model: Affine3A,
        scene_radius: f32,
    ) {
        self.bones.place(skeleton, pose, world_from_model, scene_radius);
        self.placed = Some(key);
    }

    pub(in crate::session) fn bones(&self) -> &Bones {
        &self.bones
    }

    /// A colour for each vertex, sRGB, in the caller's empty buffer. `positions` are those of the pose for a key that needs them.
    pub(in crate::session) fn skin_colors(
        &mut self,
        model: &Model,
        key: SkinColorsKey,
        positions: &[Vec3],
        colors_srgb: &mut Vec<[u8; 4]>,
    ) {
        let mesh = &model.mesh;
        match key.view {
            SkinView::Weight => {
                match key.joint {
                    Some(joint) => joint_weights(mesh, joint, &mut self.values),
                    None => {
                        self.values.clear();
                        self.values.resize(mesh.vertex_count(), 0.0);
                    }
                }
                colors_of_values(legend(key.view), &self.values, colors_srgb);
            }
            SkinView::InfluenceCount => {
                influence_counts(mesh, &mut self.counts);
                colors_of_counts(&self.counts, colors_srgb);
            }
            SkinView::DominantJoint => {
                dominant_joints(mesh, &mut self.joints);
                colors_of_joints(&self.joints, &joint_colors(&model.skeleton), colors_srgb);
            }
            SkinView::Stretch => {
                let known = self.stretch.take().filter(|(model, _)| *model == key.model_revision);
                let stretch = known.unwrap_or_else(|| (key.model_revision, Stretch::new(mesh)));
                let (_, stretch) = self.stretch.insert(stretch);
                stretch.ratios(positions, &mut self.values);
                colors_of_values(legend(key.view), &self.values, colors_srgb);
            }
        }
    }
}
