//! Where the model is seen from, where that depends on the model: framing, zooming, gliding, flying.

use glam::{Affine3A, Vec2, Vec3};

use super::view::View;
use super::{Command, Session};
use crate::anim::GhostPlan;
use crate::model::{Handedness, UpAxis};
use crate::scene::{Camera, Insets};

/// Flight ends this far from the scene's middle, in radii of the scene: where zooming ends too.
const FARTHEST_RADII: f32 = 100.0;

/// What is framed around a vertex, as a part of the model's radius: its neighbourhood, and where on the model that is.
const VERTEX_ROOM: f32 = 0.15;

impl Session {
    /// From where the model is seen.
    pub fn camera(&self) -> &Camera {
        &self.view.camera
    }

    /// The handedness in force: chosen, or else found.
    pub fn handedness(&self) -> Handedness {
        self.view.handedness(self.open_model())
    }

    /// The handedness that was chosen over what was found.
    pub fn handedness_override(&self) -> Option<Handedness> {
        self.view.handedness
    }

    /// The up axis in force: chosen, or else found.
    pub fn up_axis(&self) -> UpAxis {
        self.view.up_axis(self.open_model())
    }

    /// The up axis that was chosen over what was found.
    pub fn up_axis_override(&self) -> Option<UpAxis> {
        self.view.up_axis
    }

    /// Poses beside that of now.
    pub fn ghost_plan(&self) -> Option<GhostPlan> {
        self.view.ghosts
    }

    /// Whether the bind pose is seen as a ghost.
    pub fn bind_ghost(&self) -> bool {
        self.view.bind_ghost
    }

    /// The file's space -> the world.
    pub(super) fn world_from_model(&self) -> Affine3A {
        self.view.world_from_model(self.open_model())
    }

    pub(super) fn zoom(&mut self, factor: f32, pointer: Vec2) {
        let radius = self.world_bounds().radius().max(1e-6);
        let View { camera, framed, .. } = &mut self.view;
        // Neither through the model nor so far that it is a dot.
        let distance = (camera.distance * factor).clamp(radius * 1e-2, radius * 100.0);
        camera.zoom(distance / camera.distance, pointer);
        *framed = false;
    }

    pub(super) fn frame_model(&mut self) {
        let world_from_model = self.world_from_model();
        if let Some(open) = &self.content.open {
            let (_, points) = open.extent(self.actor.clip);
            let points: Vec<_> = points
                .iter()
                .map(|&point| world_from_model.transform_point3(point))
                .collect();
            self.view.frame_points(&points);
        }
        self.view.framed = true;
    }

    pub(super) fn frame_selection(&mut self) {
        let points = self.selected_points();
        if points.is_empty() {
            self.frame_model();
        } else {
            self.view.frame_points(&points);
            self.view.framed = false;
        }
    }

    /// Vertices that the selected joint moves for the greater part, with its bones; or the selected vertex with a little
    /// around it; or those of the selected subset. World space, as they are posed now.
    fn selected_points(&mut self) -> Vec<Vec3> {
        self.pose_vertices();
        let around_vertex = VERTEX_ROOM * self.world_bounds().radius();
        let world_from_model = self.world_from_model();
        let joints = &self.selection.joints;
        let (joint, vertex) = (joints.selected(), joints.selected_vertex().copied());
        let mut points = Vec::new();
        if let Some(joint) = joint {
            let bones = self.bones().bones().iter().filter(|bone| bone.joint == joint);
            points.extend(bones.flat_map(|bone| [bone.from, bone.to]));
        }
        let Some(open) = &self.content.open else { return points };
        let mesh = &open.model.mesh;
        let positions = self.caches.picker.positions();
        let in_world = |vertex: usize| Some(world_from_model.transform_point3(*positions.get(vertex)?));
        let submesh = self.selection.subsets.selected();
        if let Some(joint) = joint {
            let moved = mesh.influences.iter().enumerate().filter(|(_, influences)| {
                let slots = influences.joints.into_iter().zip(influences.weights);
                let of_joint = slots.filter(|&(of, _)| of == joint.0);
                of_joint.map(|(_, weight)| weight).sum::<f32>() >= 0.5
            });
            points.extend(moved.filter_map(|(vertex, _)| in_world(vertex)));
        } else if let Some(place) = vertex.and_then(|vertex| in_world(vertex.vertex as usize)) {
            let sides = Vec3::AXES.map(|axis| axis * around_vertex);
            points.extend(sides.into_iter().flat_map(|side| [place - side, place + side]));
        } else if let Some(submesh) = submesh.and_then(|submesh| mesh.submeshes.get(submesh)) {
            let start = submesh.triangle_start as usize * 3;
            let corners = &mesh.indices[start..start + submesh.triangle_count as usize * 3];
            points.extend(corners.iter().filter_map(|&vertex| in_world(vertex as usize)));
        }
        points
    }

    /// A model that nobody panned or zoomed stays framed in a picture of another shape. An aspect or insets that are not finite
    /// are ignored.
    pub(super) fn set_viewport(&mut self, aspect: f32, insets: Insets) {
        let Insets {
            left,
            right,
            top,
            bottom,
        } = insets;
        if !(aspect.is_finite() && aspect > 0.0 && [left, right, top, bottom].into_iter().all(f32::is_finite)) {
            return;
        }
        (self.view.aspect, self.view.insets) = (aspect, insets);
        if self.view.framed {
            self.frame_model();
        }
    }

    /// Whether the camera turns about the model by itself.
    pub fn turntable(&self) -> bool {
        self.view.motion.turntable()
    }

    pub(super) fn is_camera_moving(&self) -> bool {
        self.view.motion.is_moving(self.content.open.is_some())
    }

    /// Does what was asked, and lets the camera go there instead of jumping.
    pub(super) fn glide(&mut self, command: Command) {
        if self.reduced_motion || !command.sends_camera() {
            return self.perform(command);
        }
        let from = self.view.camera;
        // Sent again on its way, it goes from here to where it would have been sent from there.
        if let Some(goal) = self.view.motion.goal() {
            self.view.camera = goal;
            self.view.motion.end_glide();
        }
        self.perform(command);
        let View { camera, motion, .. } = &mut self.view;
        let to = std::mem::replace(camera, from);
        camera.projection = to.projection;
        if *camera != to {
            motion.glide(from, to);
        }
    }

    /// Changes the camera, or where it is going while it glides.
    pub(super) fn change_goal(&mut self, change: impl FnOnce(&mut Self)) {
        let Some(goal) = self.view.motion.goal() else {
            return change(self);
        };
        let here = std::mem::replace(&mut self.view.camera, goal);
        change(self);
        let View { camera, motion, .. } = &mut self.view;
        let to = std::mem::replace(camera, here);
        camera.projection = to.projection;
        motion.set_goal(to);
    }

    /// Lets time pass for the camera.
    pub(super) fn advance_camera(&mut self, dt_secs: f32) {
        if !(self.is_camera_moving() && dt_secs.is_finite() && dt_secs > 0.0) {
            return;
        }
        let has_model = self.content.open.is_some();
        let View { camera, motion, .. } = &mut self.view;
        let flight_radii = motion.advance(camera, dt_secs, has_model);
        if flight_radii != Vec3::ZERO {
            self.fly(flight_radii);
        }
    }

    fn fly(&mut self, way_radii: Vec3) {
        let bounds = self.world_bounds();
        let (center, radius) = (bounds.center(), bounds.radius().max(1e-6));
        let camera = &mut self.view.camera;
        // Whoever is farther out already comes nearer or stays.
        let farthest = (FARTHEST_RADII * radius).max(camera.eye().distance(center));
        camera.fly(way_radii * radius);
        let off = camera.eye() - center;
        let target = camera.target - (off - off.clamp_length_max(farthest));
        if target.is_finite() {
            camera.target = target;
        }
        // An orthographic view grows instead; it ends where zooming does.
        self.zoom(1.0, Vec2::ZERO);
    }
}

impl Command {
    /// Whether it says where the camera shall be.
    fn sends_camera(&self) -> bool {
        matches!(
            self,
            Self::Orbit { .. }
                | Self::Pan { .. }
                | Self::Zoom { .. }
                | Self::FrameModel
                | Self::FrameSelection
                | Self::LookFrom(_)
                | Self::ResetCamera
                | Self::SetViewport { .. }
        )
    }
}
