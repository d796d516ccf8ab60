//! What there is to see and to read of the skeleton and the skin in the pose on show.

use glam::Vec2;

use super::Session;
use super::pose::OnShow;
use crate::anim::{
    self, JointReadout, SkinView, Stretch, Trails, VertexExplanation, dominant_joints, explain_vertex,
    influence_counts, joint_weights,
};
use crate::model::{Handedness, JointIndex, UpAxis};
use crate::scene::{
    BoneColors, Bones, LabelPlace, OverlayGeometry, Screen, colors_of_counts, colors_of_joints, colors_of_values,
    draw_bones, joint_colors, label_places, legend, pick_joint,
};

/// How far from a bone the pointer may be, in heights of the picture: 11 pixels of 900.
const PICK_RADIUS: f32 = 0.012;

/// Buffers that are kept from pose to pose.
#[derive(Clone, Debug, Default)]
pub(super) struct SkeletonView {
    placed: Option<(OnShow, Handedness, UpAxis)>,
    bones: Bones,
    skin: SkinBuffers,
}

/// What colours are made from.
#[derive(Clone, Debug, Default)]
struct SkinBuffers {
    values: Vec<f32>,
    counts: Vec<u8>,
    joints: Vec<Option<JointIndex>>,
    /// With the model that it is of.
    stretch: Option<(u64, Stretch)>,
}

/// What the colours of a skin depend on: the same key, the same colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinColorsKey {
    view: SkinView,
    model: u64,
    joint: Option<JointIndex>,
    pose: Option<OnShow>,
}

impl Session {
    /// The bones of the pose on show, world space.
    pub fn bones(&mut self) -> &Bones {
        let place = (self.on_show(), self.handedness(), self.up_axis());
        if self.skeleton_view.placed != Some(place) {
            self.pose_now();
            let scene_radius = self.world_bounds().radius();
            let world_from_model = self.world_from_model();
            let no_skeleton = crate::model::Skeleton::default();
            let skeleton = self.open.as_ref().map_or(&no_skeleton, |open| &open.model.skeleton);
            self.skeleton_view
                .bones
                .place(skeleton, &self.pose.model, world_from_model, scene_radius);
            self.skeleton_view.placed = Some(place);
        }
        &self.skeleton_view.bones
    }

    /// Lines and triangles of the bones as they are shown, in the caller's buffers; nothing while they are hidden.
    pub fn draw_bones(&mut self, out: &mut OverlayGeometry) {
        out.clear();
        if self.joints.bones_visible() {
            let (style, marked) = (self.joints.bone_style(), self.joints.marked());
            let colors = BoneColors::of(self.theme);
            draw_bones(self.bones(), style, marked, colors, out);
        }
    }

    /// The joint at a point of the picture: x right, y up, −1…1, whether bones are shown or not.
    pub fn joint_at(&mut self, pointer: Vec2) -> Option<JointIndex> {
        if !pointer.is_finite() {
            return None;
        }
        let screen = self.screen();
        pick_joint(self.bones(), &screen, pointer, PICK_RADIUS)
    }

    /// Where the names of joints stand, in the caller's buffer: the selected and the hovered first. Joints closer than `spacing`
    /// (heights of the picture) to one before them are left out; nothing while labels are hidden.
    pub fn joint_labels(&mut self, spacing: f32, places: &mut Vec<LabelPlace>) {
        places.clear();
        if self.joints.labels_visible() {
            let marked = self.joints.marked();
            let first: Vec<_> = [marked.selected, marked.hovered].into_iter().flatten().collect();
            let screen = self.screen();
            label_places(self.bones(), &screen, spacing, &first, places);
        }
    }

    pub(super) fn screen(&mut self) -> Screen {
        let world_bounds = self.world_bounds();
        Screen {
            clip_from_world: self.camera.clip_from_view(self.aspect, &world_bounds) * self.camera.view_from_world(),
            aspect: self.aspect,
        }
    }

    /// All numbers of a joint in the pose on show.
    pub fn inspect_joint(&mut self, joint: JointIndex) -> Option<JointReadout> {
        self.pose_now();
        let skeleton = &self.open.as_ref()?.model.skeleton;
        JointReadout::of(skeleton, self.joints.tree(), &self.pose, joint)
    }

    /// How the selected vertex comes to its place in the pose on show.
    pub fn explain_vertex(&mut self) -> Option<VertexExplanation> {
        self.pose_now();
        let vertex = self.joints.selected_vertex()?.vertex;
        explain_vertex(&self.open.as_ref()?.model, &self.pose, vertex)
    }

    /// What the colours of the skin depend on now: as long as it stays, they need not be asked for. None while the skin is shown
    /// as it is.
    pub fn skin_colors_key(&self) -> Option<SkinColorsKey> {
        self.open_model()?;
        let view = self.joints.skin_view()?;
        Some(SkinColorsKey {
            view,
            model: self.model_revision,
            joint: self.weighed_joint().filter(|_| view == SkinView::Weight),
            pose: (view == SkinView::Stretch).then(|| self.on_show()),
        })
    }

    /// A colour for each vertex, sRGB, in the caller's buffer; empty while the skin is shown as it is. Weights are those of
    /// [`Session::weighed_joint`], all 0 without one.
    pub fn skin_colors(&mut self, colors_srgb: &mut Vec<[u8; 4]>) {
        colors_srgb.clear();
        let Some(view) = self.joints.skin_view() else { return };
        if view == SkinView::Stretch {
            self.pose_vertices();
        }
        let weighed = self.weighed_joint();
        let Some(open) = &self.open else { return };
        let (mesh, skeleton) = (&open.model.mesh, &open.model.skeleton);
        let skin = &mut self.skeleton_view.skin;
        match view {
            SkinView::Weight => {
                match weighed {
                    Some(joint) => joint_weights(mesh, joint, &mut skin.values),
                    None => {
                        skin.values.clear();
                        skin.values.resize(mesh.vertex_count(), 0.0);
                    }
                }
                colors_of_values(legend(view), &skin.values, colors_srgb);
            }
            SkinView::InfluenceCount => {
                influence_counts(mesh, &mut skin.counts);
                colors_of_counts(&skin.counts, colors_srgb);
            }
            SkinView::DominantJoint => {
                dominant_joints(mesh, &mut skin.joints);
                colors_of_joints(&skin.joints, &joint_colors(skeleton), colors_srgb);
            }
            SkinView::Stretch => {
                let known = skin.stretch.take().filter(|(model, _)| *model == self.model_revision);
                let (_, stretch) = skin
                    .stretch
                    .insert(known.unwrap_or_else(|| (self.model_revision, Stretch::new(mesh))));
                stretch.ratios(self.picker.positions(), &mut skin.values);
                colors_of_values(legend(view), &skin.values, colors_srgb);
            }
        }
    }

    /// The ways of the chosen joints through the clip on show and what is blended into it, model space, in the caller's buffers.
    /// It poses the clip at each frame: ask again only when the model, the clip, the blend or the choice changed.
    pub fn follow_trails(&mut self, trails: &mut Trails, pose: &mut anim::PoseBuffers) {
        let Self { open, mix, joints, .. } = self;
        let Some(open) = open else {
            *trails = Trails::default();
            return;
        };
        match self.clip.and_then(|clip| open.model.clips.get(clip)) {
            Some(clip) => trails.follow_posed(clip, joints.trails(), pose, |time_secs, pose| {
                mix.pose_unfaded(open, clip, time_secs, pose);
            }),
            None => *trails = Trails::default(),
        }
    }
}
