//! The camera, where it needs to know the model and the window.

use super::Session;
use crate::scene::Insets;

impl Session {
    pub(super) fn zoom(&mut self, factor: f32, pointer: glam::Vec2) {
        let radius = self.world_bounds().radius().max(1e-6);
        // Neither through the model nor so far that it is a dot.
        let distance = (self.camera.distance * factor).clamp(radius * 1e-2, radius * 100.0);
        self.camera.zoom(distance / self.camera.distance, pointer);
        self.framed = false;
    }

    pub(super) fn frame_model(&mut self) {
        let world_from_model = self.world_from_model();
        if let Some(open) = &mut self.open {
            let (_, points) = open.extent(self.clip);
            let world_points: Vec<_> = points
                .iter()
                .map(|&point| world_from_model.transform_point3(point))
                .collect();
            // A figure stands in the middle of the window; only what would reach under the panels beside it makes way.
            let centered = Insets {
                left: 0.0,
                right: 0.0,
                ..self.insets
            };
            self.camera.frame(&world_points, self.aspect, centered);
            let (left, right) = self.camera.free_at_sides(&world_points, self.aspect);
            if left < self.insets.left || right < self.insets.right {
                self.camera.frame(&world_points, self.aspect, self.insets);
            }
        }
        self.framed = true;
    }

    /// A model that nobody panned or zoomed stays framed in a picture of another shape. A shape that is none is left out.
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
        (self.aspect, self.insets) = (aspect, insets);
        if self.framed {
            self.frame_model();
        }
    }
}
