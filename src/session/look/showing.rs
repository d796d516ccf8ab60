//! What there is to see and to read of the pose of now: the frame for a renderer, bones, names, numbers.

use glam::Vec3;

use super::skeleton_cache::{PlaceKey, SkinColorsKey};
use super::view::View;
use crate::anim::{Extent, JointReadout, SkinView, VertexExplanation, explain_vertex};
use crate::model::{JointIndex, Skeleton};
use crate::scene::{Aabb, BoneColors, Bones, Crowd, Ground, LabelPlace, RenderFrame, Screen, label_places};
use crate::session::{Caches, Session};

impl Session {
    /// All that a renderer needs for the picture of now. The box is empty and the palette too when nothing is open.
    pub fn frame(&mut self) -> RenderFrame<'_> {
        let poses_all = self.quality.poses_all();
        self.prepare(poses_all);
        if self.instances.are_many() {
            let bounds = self.selected_bounds();
            let ground = self.ground().height;
            let colors = BoneColors::of(self.view.theme);
            self.caches.overlays.mark_place(&bounds, ground, colors.selected);
        }
        self.prepared_frame()
    }

    /// The same for a picture that is saved: as at rest, with all detail, and without the mark of the selected instance.
    pub fn frame_at_rest(&mut self) -> RenderFrame<'_> {
        let passes = self.quality.wanted();
        let selected = Aabb::from_points(self.selected_points());
        self.prepare(true);
        let mut frame = self.prepared_frame();
        frame.options.focus = (!selected.is_empty()).then(|| selected.center());
        frame.options.passes = passes;
        (frame.options.occlusion_detail, frame.options.shadow_detail) = Default::default();
        frame
    }

    fn prepare(&mut self, poses_all: bool) {
        self.pose_now();
        self.pose_crowd(poses_all);
        self.update_overlays();
    }

    fn prepared_frame(&self) -> RenderFrame<'_> {
        RenderFrame {
            camera: self.view.camera,
            world_from_model: self.world_from_model(),
            world_bounds: self.world_bounds(),
            ground: self.ground(),
            mesh: self.content.open.as_deref().map(|open| &open.model.mesh),
            palette: &self.actor.pose.palette,
            crowd: if self.instances.are_many() {
                self.caches.crowd.crowd()
            } else {
                Crowd::default()
            },
            hidden_submeshes: self.selection.submeshes.left_out(),
            highlighted_submesh: self.selection.submeshes.highlighted(),
            vertex_colors: self.caches.overlays.vertex_colors(),
            ghosts: self.caches.overlays.ghosts(),
            seen_through: Some(self.caches.overlays.geometry()),
            sample: None,
            options: self.frame_options(),
        }
    }

    /// The ground under the clip on show, where a person has moved it to.
    pub fn ground(&self) -> Ground {
        let (clip, world_from_model) = (self.clip_index(), self.world_from_model());
        let lowest = |points: &[Vec3]| {
            let heights = points.iter().map(|&point| world_from_model.transform_point3(point).y);
            heights.reduce(f32::min)
        };
        let open = self.content.open.as_deref();
        let poses = open.into_iter().flat_map(|open| open.extent(clip).poses());
        let (mut heights, mut count) = ([0.0; Extent::MOST_POSES], 0);
        for (height, found) in heights.iter_mut().zip(poses.filter_map(lowest)) {
            *height = found;
            count += 1;
        }
        let ground = Ground::under(&self.world_bounds(), &mut heights[..count]);
        Ground {
            height: ground.height + self.view.look.ground_offset * self.selected_bounds().size().y,
            ..ground
        }
    }

    /// Brings the other instances to the pose of now.
    pub(in crate::session) fn pose_crowd(&mut self, poses_all: bool) {
        if let Some(open) = self.content.open.as_deref()
            && self.instances.are_many()
        {
            let (bind_weight, crowd) = (self.actor.bind_weight, &mut self.caches.crowd);
            crowd.update(
                open,
                &self.instances,
                bind_weight,
                &self.view,
                self.revisions,
                poses_all,
            );
        }
    }

    fn update_overlays(&mut self) {
        self.place_bones();
        let colors_key = self.skin_colors_key();
        if colors_key.is_some_and(|key| key.needs_posed_vertices()) {
            self.pose_vertices();
        }
        let in_world = (self.view.theme, self.world_from_model());
        let open = self.content.open.as_deref();
        let (actor, look, revisions) = (&mut self.actor, &self.view.look, self.revisions);
        let marked = self.selection.joints.marked();
        let Caches {
            picker,
            skeleton,
            overlays,
            crowd: _,
        } = &mut self.caches;
        let model = open.map(|open| &open.model);
        overlays.update_colors(colors_key, model, picker.positions(), skeleton);
        overlays.update_ghosts(open, actor, look, revisions);
        overlays.update_geometry(open, actor, (look, marked), skeleton, in_world, revisions);
    }

    /// Brings the bones to the pose of now.
    fn place_bones(&mut self) {
        let key = PlaceKey {
            pose_revision: self.revisions.pose,
            handedness: self.handedness(),
            up_axis: self.up_axis(),
        };
        if self.caches.skeleton.is_placed(key) {
            return;
        }
        self.pose_now();
        let (world_from_model, scene_radius) = (self.world_from_model(), self.selected_bounds().radius());
        let no_skeleton = Skeleton::default();
        let open = self.content.open.as_ref();
        let skeleton = open.map_or(&no_skeleton, |open| &open.model.skeleton);
        let pose = &self.actor.pose.model;
        self.caches
            .skeleton
            .place(key, skeleton, pose, world_from_model, scene_radius);
    }

    /// The bones of the pose of now, world space.
    pub fn bones(&mut self) -> &Bones {
        self.place_bones();
        self.caches.skeleton.bones()
    }

    /// Where the names of joints stand, in the caller's buffer: the selected and the hovered first. Joints closer than `spacing`
    /// (heights of the picture) to one before them are left out; nothing while labels are hidden.
    pub fn joint_labels(&mut self, spacing: f32, places: &mut Vec<LabelPlace>) {
        places.clear();
        if self.view.look.labels_visible() {
            let marked = self.selection.joints.marked();
            let first: Vec<_> = [marked.selected, marked.hovered].into_iter().flatten().collect();
            let screen = self.screen();
            label_places(self.bones(), &screen, spacing, &first, places);
        }
    }

    pub(in crate::session) fn screen(&mut self) -> Screen {
        let world_bounds = self.world_bounds();
        let View { camera, aspect, .. } = &self.view;
        Screen {
            clip_from_world: camera.clip_from_view(*aspect, &world_bounds) * camera.view_from_world(),
            aspect: *aspect,
        }
    }

    /// All numbers of a joint in the pose of now.
    pub fn inspect_joint(&mut self, joint: JointIndex) -> Option<JointReadout> {
        self.pose_now();
        let skeleton = &self.content.open.as_ref()?.model.skeleton;
        JointReadout::of(skeleton, self.selection.joints.tree(), &self.actor.pose, joint)
    }

    /// How the selected vertex comes to its place in the pose of now.
    pub fn explain_vertex(&mut self) -> Option<VertexExplanation> {
        self.pose_now();
        let vertex = self.selection.joints.selected_vertex()?.vertex;
        explain_vertex(&self.content.open.as_ref()?.model, &self.actor.pose, vertex)
    }

    /// Where the corners of the selected triangle are in the pose of now, model space.
    pub fn selected_corners(&mut self) -> Option<[Vec3; 3]> {
        let triangle = self.selection.joints.selected_triangle()?;
        self.pose_now();
        let model = &self.content.open.as_ref()?.model;
        let place = |vertex| Some(explain_vertex(model, &self.actor.pose, vertex)?.position);
        let [a, b, c] = model.mesh.triangle(triangle)?;
        Some([place(a)?, place(b)?, place(c)?])
    }

    /// What the colours of the skin depend on: the same key, the same colours. None while the skin is shown as it is. Weights are
    /// those of [`Session::weighed_joint`], all 0 without one.
    pub fn skin_colors_key(&self) -> Option<SkinColorsKey> {
        self.open_model()?;
        let view = self.view.look.skin_view?;
        Some(SkinColorsKey {
            view,
            model_revision: self.revisions.model,
            joint: self.weighed_joint().filter(|_| view == SkinView::Weight),
            pose_revision: (view == SkinView::Stretch).then_some(self.revisions.pose),
        })
    }
}
