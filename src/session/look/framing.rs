//! The camera frames the model, or what of it is selected, in what the panels leave free.

use glam::{Affine3A, Vec3};

use super::view::Framed;
use crate::scene::{Insets, swept_about_y};
use crate::session::Session;

/// Half the size of what is framed around a vertex, as a fraction of the model's radius: enough to see where on the model it is.
const VERTEX_ROOM: f32 = 0.15;

/// Cameras that are nearer to each other than this part of their distance are in one place.
const SAME_PLACE: f32 = 1e-4;

/// Pictures whose shapes (width / height) differ by less than this part show the same.
const SAME_SHAPE: f32 = 0.01;

/// Whether pictures of these shapes show the same.
pub(in crate::session) fn is_same_shape(one: f32, other: f32) -> bool {
    (one - other).abs() <= SAME_SHAPE * other
}

impl Session {
    pub(in crate::session) fn frame_model(&mut self) {
        let points = self.reached_points();
        self.view.frame_points(&points);
        self.view.framed = Framed::Yes;
    }

    /// Whether the camera is where framing the model would bring it: it may have gone round it since then, or another clip may be seen.
    pub(in crate::session) fn is_framed_from_here(&self) -> bool {
        if self.view.framed == Framed::No {
            return false;
        }
        let mut framed = self.view.clone();
        framed.frame_points(&self.reached_points());
        let (now, then) = (&self.view.camera, &framed.camera);
        let off = now.target.distance(then.target) + (now.distance - then.distance).abs();
        off <= SAME_PLACE * now.distance
    }

    /// Frames the model so that all of it stays in the picture while the camera turns about its middle.
    pub(in crate::session) fn frame_all_round(&mut self) {
        let (points, middle) = swept_about_y(&self.reached_points());
        self.view.frame_points(&points);
        self.view.camera.aim_at_axis(middle);
        self.view.framed = Framed::Yes;
    }

    /// Points by which all that the clips of all instances reach is framed, world space.
    fn reached_points(&self) -> Vec<Vec3> {
        let mut points = Vec::new();
        if self.instances.are_many() {
            // The box of all clips at each place: no closer view, but few points, and the same whoever is selected.
            let formation = self.formation();
            for index in 0..self.instances.count() {
                let offset = self.instances.offset(&formation, index);
                points.extend(formation.reach.corners().map(|corner| corner + offset));
            }
        } else {
            self.add_reach(self.clip_index(), self.world_from_model(), &mut points);
        }
        points
    }

    /// Adds the points by which a clip is framed, world space.
    fn add_reach(&self, clip: Option<usize>, world_from_model: Affine3A, points: &mut Vec<Vec3>) {
        let of_clip = self
            .content
            .open
            .as_ref()
            .map_or(&[][..], |open| &open.extent(clip).points);
        points.extend(of_clip.iter().map(|&point| world_from_model.transform_point3(point)));
    }

    pub(in crate::session) fn frame_selection(&mut self) {
        let mut points = self.selected_points();
        if points.is_empty() && self.instances.are_many() {
            self.add_reach(self.clip_index(), self.world_from_model(), &mut points);
        }
        if points.is_empty() {
            self.frame_model();
        } else {
            self.view.frame_points(&points);
            self.view.framed = Framed::No;
        }
    }

    /// Vertices that the selected joint moves for the greater part, with its bones; or the selected vertex or triangle with a little
    /// around it; or those of the selected submesh. World space, as they are posed now.
    pub(in crate::session) fn selected_points(&mut self) -> Vec<Vec3> {
        self.pose_vertices();
        let around_vertex = VERTEX_ROOM * self.selected_bounds().radius();
        let world_from_model = self.world_from_model();
        let joints = &self.selection.joints;
        let (joint, vertex) = (joints.selected(), joints.selected_vertex().copied());
        let triangle = joints.selected_triangle();
        let mut points = Vec::new();
        if let Some(joint) = joint {
            let bones = self.bones().bones().iter().filter(|bone| bone.joint == joint);
            points.extend(bones.flat_map(|bone| [bone.from, bone.to]));
        }
        let Some(open) = &self.content.open else { return points };
        let mesh = &open.model.mesh;
        let positions = self.caches.picker.positions();
        let in_world = |vertex: usize| Some(world_from_model.transform_point3(*positions.get(vertex)?));
        let submesh = self.selection.submeshes.selected();
        if let Some(joint) = joint {
            let moved = mesh.influences.iter().enumerate().filter(|(_, influences)| {
                let slots = influences.joints.into_iter().zip(influences.weights);
                let of_joint = slots.filter(|&(of, _)| of == joint.0);
                of_joint.map(|(_, weight)| weight).sum::<f32>() >= 0.5
            });
            points.extend(moved.filter_map(|(vertex, _)| in_world(vertex)));
        } else if let Some(vertex) = vertex {
            let corners = triangle.and_then(|triangle| mesh.triangle(triangle));
            for place in corners
                .unwrap_or([vertex.vertex; 3])
                .into_iter()
                .filter_map(|corner| in_world(corner as usize))
            {
                let sides = Vec3::AXES.map(|axis| axis * around_vertex);
                points.extend(sides.into_iter().flat_map(|side| [place - side, place + side]));
            }
        } else if let Some(submesh) = submesh.and_then(|submesh| mesh.submeshes.get(submesh)) {
            let start = submesh.triangle_start as usize * 3;
            let corners = &mesh.indices[start..start + submesh.triangle_count as usize * 3];
            points.extend(corners.iter().filter_map(|&vertex| in_world(vertex as usize)));
        }
        points
    }

    /// Says that the camera frames the model: in every window where it would be framed to the same place now, else in windows of this shape.
    pub(in crate::session) fn hold_framed(&mut self) {
        self.view.framed = Framed::InShape(self.view.aspect);
        if self.is_framed_from_here() {
            self.view.framed = Framed::Yes;
        }
    }

    /// A model that nobody panned or zoomed stays framed in a picture of another shape. An aspect or insets that are not finite
    /// are ignored.
    pub(in crate::session) fn set_viewport(&mut self, aspect: f32, insets: Insets) {
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
        match self.view.framed {
            Framed::No => {}
            Framed::InShape(of) if is_same_shape(of, aspect) => {}
            Framed::Yes | Framed::InShape(_) => self.frame_model(),
        }
    }
}
