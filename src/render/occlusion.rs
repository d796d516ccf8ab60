//! Ambient occlusion: normals and depth of what is in view, at half the picture's resolution, and how open each pixel is.

use super::gpu_model::{GpuModel, Posed};
use super::pipelines::{Cut, Draw, GEOMETRY_FORMAT, ModelDraw, Pipelines, SHARE_FORMAT};
use super::target::{DEPTH_FORMAT, begin_color_pass, flat_texture};
use crate::scene::Light;

/// No normal, as far as can be.
const NOTHING_SEEN: wgpu::Color = wgpu::Color {
    r: 0.5,
    g: 0.5,
    b: 1.0,
    a: 1.0,
};

/// Textures for pictures of one size.
pub(super) struct Occlusion {
    size: [u32; 2],
    geometry: wgpu::TextureView,
    depth: wgpu::TextureView,
    openness: wgpu::TextureView,
    between: wgpu::TextureView,
    /// Reads the geometry and what is in `openness`; and what is in `between`.
    openness_group: wgpu::BindGroup,
    between_group: wgpu::BindGroup,
}

impl Occlusion {
    pub(super) fn new(device: &wgpu::Device, pipelines: &Pipelines, size: [u32; 2]) -> Self {
        let half = size.map(|side| side.div_ceil(2));
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let texture = |label, format| flat_texture(device, label, half, format, usage);
        let geometry = texture("geometry", GEOMETRY_FORMAT);
        let (openness, between) = (
            texture("openness", SHARE_FORMAT),
            texture("openness, between", SHARE_FORMAT),
        );
        let group = |rough| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("around"),
                layout: &pipelines.layouts.around,
                entries: &[
                    wgpu::BindGroupEntry {
                        binding: 0,
                        resource: wgpu::BindingResource::TextureView(&geometry),
                    },
                    wgpu::BindGroupEntry {
                        binding: 1,
                        resource: wgpu::BindingResource::TextureView(rough),
                    },
                ],
            })
        };
        Self {
            size,
            openness_group: group(&openness),
            between_group: group(&between),
            depth: flat_texture(
                device,
                "geometry depth",
                half,
                DEPTH_FORMAT,
                wgpu::TextureUsages::RENDER_ATTACHMENT,
            ),
            geometry,
            openness,
            between,
        }
    }

    /// Of the pictures that it is for, pixels.
    pub(super) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Share of the surroundings that reaches each pixel, once drawn.
    pub(super) fn view(&self) -> &wgpu::TextureView {
        &self.openness
    }

    pub(super) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame_group: &wgpu::BindGroup,
        model: &GpuModel,
        posed: Posed<'_>,
        light: Light,
        nothing: &wgpu::BindGroup,
    ) {
        {
            let mut pass = begin_color_pass(encoder, "geometry", &self.geometry, NOTHING_SEEN, Some(&self.depth));
            pass.set_bind_group(0, frame_group, &[]);
            pass.set_bind_group(2, nothing, &[]);
            model.draw(&mut pass, posed, Cut::Hard, ModelDraw::Geometry);
        }
        self.fill(
            encoder,
            frame_group,
            posed.pipelines,
            Draw::Occlusion(light),
            &self.openness,
        );
        // The demo blurs twice.
        let blurs = match light {
            Light::Book => 2,
            Light::Studio => 1,
        };
        for _ in 0..blurs {
            self.fill(
                encoder,
                frame_group,
                posed.pipelines,
                Draw::OcclusionBlurRows,
                &self.between,
            );
            self.fill(
                encoder,
                frame_group,
                posed.pipelines,
                Draw::OcclusionBlurColumns,
                &self.openness,
            );
        }
    }

    /// Draws over the whole of `target` from the geometry and the other of the two.
    fn fill(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame_group: &wgpu::BindGroup,
        pipelines: &Pipelines,
        draw: Draw,
        target: &wgpu::TextureView,
    ) {
        let source = if target == &self.openness {
            &self.between_group
        } else {
            &self.openness_group
        };
        let mut pass = begin_color_pass(encoder, "occlusion", target, wgpu::Color::WHITE, None);
        pass.set_pipeline(&pipelines.get(draw));
        pass.set_bind_group(0, frame_group, &[]);
        pass.set_bind_group(1, source, &[]);
        pass.draw(0..3, 0..1);
    }
}
