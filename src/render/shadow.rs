//! The key light's depth map over the whole scene box: it does not swim while the model moves.

use glam::{Mat4, Vec3};

use super::target::{DEPTH_FORMAT, flat_texture};
use crate::scene::Aabb;

/// Texels along each edge.
const SIZE: u32 = 2048;
/// Texels around the box that stay empty, so that a blurred edge never leaves the map.
const MARGIN_TEXELS: f32 = 8.0;

/// The depth map.
pub(super) struct ShadowMap {
    view: wgpu::TextureView,
}

impl ShadowMap {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        Self {
            view: flat_texture(device, "shadow map", [SIZE; 2], DEPTH_FORMAT, usage),
        }
    }

    pub(super) fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    pub(super) fn begin_pass<'a>(&self, encoder: &'a mut wgpu::CommandEncoder) -> wgpu::RenderPass<'a> {
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow map"),
            color_attachments: &[],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        })
    }
}

/// How the map covers a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ShadowFit {
    /// World -> the map's clip space.
    pub(super) shadow_clip_from_world: Mat4,
    /// World units that a texel covers.
    pub(super) texel: f32,
}

impl ShadowFit {
    /// The least square that holds the box as seen from the light. `to_key` is a unit vector.
    pub(super) fn new(world_bounds: &Aabb, to_key: Vec3) -> Self {
        let forward = -to_key;
        let right = to_key.any_orthonormal_vector();
        let up = forward.cross(right);
        let center = world_bounds.center();
        // From the light's axes through the middle of the box, so that numbers stay small wherever the box lies.
        let light_from_world = Mat4::from_cols(right.extend(0.0), up.extend(0.0), forward.extend(0.0), glam::Vec4::W)
            .transpose()
            * Mat4::from_translation(-center);
        let half_size = world_bounds.size() * 0.5;
        let reach = |axis: Vec3| axis.abs().dot(half_size);
        // An empty or flat box still wants a map of some size.
        let least = f32::MIN_POSITIVE.max(half_size.max_element() * 1e-3).max(1e-20);
        let half_width = reach(right).max(reach(up)).max(least) * (1.0 + 2.0 * MARGIN_TEXELS / SIZE as f32);
        let half_depth = reach(forward).max(least) * 1.01;
        let clip_from_light = glam::camera::lh::proj::directx::orthographic(
            -half_width,
            half_width,
            -half_width,
            half_width,
            -half_depth,
            half_depth,
        );
        Self {
            shadow_clip_from_world: clip_from_light * light_from_world,
            texel: 2.0 * half_width / SIZE as f32,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_corner_of_the_box_lies_inside_the_map() {
        let to_key = Vec3::new(0.6, 0.7, -0.4).normalize();
        for (min, max) in [
            (Vec3::ZERO, Vec3::new(1.0, 70.0, 3.0)),
            (Vec3::splat(-1e4), Vec3::splat(1e4)),
            (Vec3::splat(5.0), Vec3::splat(5.001)),
            (Vec3::ZERO, Vec3::ZERO),
        ] {
            let fit = ShadowFit::new(&Aabb { min, max }, to_key);
            for corner in 0..8 {
                let pick = |bit: usize| if corner >> bit & 1 == 0 { min[bit] } else { max[bit] };
                let clip = fit
                    .shadow_clip_from_world
                    .project_point3(Vec3::new(pick(0), pick(1), pick(2)));
                assert!(
                    clip.x.abs() < 1.0 && clip.y.abs() < 1.0 && (0.0..1.0).contains(&clip.z),
                    "{clip}"
                );
            }
        }
    }
}
