//! A [`RenderFrame`] as the shaders want it.

use glam::Mat4;

use super::look::{Lights, encoded, linear, look};
use super::shadow::ShadowFit;
use crate::scene::{Ground, Overlay, Projection, RenderFrame};
use crate::shaders;

/// The grid is gone this many radii of the scene from its middle, or this many camera distances if that is more.
const GRID_REACH: f32 = 9.0;
const GRID_REACH_OF_DISTANCE: f32 = 2.0;

/// `winding` is +1 when the model's triangles are clockwise from their front in a left-handed space, else −1.
pub(super) fn frame_uniform(frame: &RenderFrame<'_>, [width, height]: [u32; 2], winding: f32) -> shaders::Frame {
    let camera = &frame.camera;
    let aspect = width as f32 / height as f32;
    let look = look(frame.options.theme);
    let ground = Ground::under(&frame.world_bounds);
    let lights = Lights::beside(camera);
    let shadow = ShadowFit::new(&frame.world_bounds, lights.to_key);
    let clip_from_world = camera.clip_from_view(aspect, &frame.world_bounds) * camera.view_from_world();
    let mirrors = frame.world_from_model.matrix3.determinant() < 0.0;

    let half_height = camera.height_in_view() * 0.5;
    let (per_y, per_x) = (camera.up() * half_height, camera.right() * (half_height * aspect));
    let (is_perspective, eye_scale, forward_scale) = match camera.projection {
        Projection::Perspective { .. } => (1.0, 0.0, 1.0 / camera.distance),
        Projection::Orthographic => (0.0, 1.0, 0.0),
    };
    let reach = (frame.world_bounds.radius() * GRID_REACH).max(camera.distance * GRID_REACH_OF_DISTANCE);
    let center = frame.world_bounds.center();

    shaders::Frame {
        clip_from_world: clip_from_world.to_cols_array_2d(),
        world_from_model: Mat4::from(frame.world_from_model).to_cols_array_2d(),
        shadow_clip_from_world: shadow.shadow_clip_from_world.to_cols_array_2d(),
        eye: camera.eye().to_array(),
        front_sign: if mirrors { -winding } else { winding },
        forward: camera.forward().to_array(),
        is_perspective,
        eye_per_x: (per_x * eye_scale).to_array(),
        ground_height: ground.height,
        eye_per_y: (per_y * eye_scale).to_array(),
        grid_cell: ground.cell,
        forward_per_x: (per_x * forward_scale).to_array(),
        grid_reach: reach,
        forward_per_y: (per_y * forward_scale).to_array(),
        shadow_texel: shadow.texel,
        to_key: lights.to_key.to_array(),
        shadow_strength: look.shadow_strength,
        to_rim: lights.to_rim.to_array(),
        grid_strength: if frame.options.overlays.has(Overlay::Grid) {
            1.0
        } else {
            0.0
        },
        backdrop_center_srgb: encoded(look.backdrop_center),
        backdrop_edge_srgb: encoded(look.backdrop_edge),
        grid_minor: linear(look.grid_minor, look.grid_minor_opacity),
        grid_major: linear(look.grid_major, look.grid_major_opacity),
        grid_center: [center.x, center.z],
        viewport_pixels: [width as f32, height as f32],
        normal_green_sign: if frame.options.normal_green_flipped { -1.0 } else { 1.0 },
        unused: [0.0; 3],
    }
}
