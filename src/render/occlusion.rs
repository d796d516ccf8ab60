//! Ambient occlusion: normals and depth of what is in view, at half the picture's resolution, and how open each pixel is.

use std::ops::Range;

use super::model::{GpuModel, Posed};
use super::pipelines::Pipelines;
use super::recipe::{Cut, Draw, ModelDraw};
use super::target::{DEPTH_FORMAT, FRACTION_FORMAT, GEOMETRY_FORMAT, PassTargets, begin_pass, flat_texture};
use crate::scene::Light;

/// No normal, as far as can be.
const NOTHING_SEEN: wgpu::Color = wgpu::Color {
    r: 0.5,
    g: 0.5,
    b: 1.0,
    a: 1.0,
};

/// Texels beside the columns of a light that its blurs read: a radius for each of the book's four.
const BLUR_MARGIN: u32 = 4 * 5;

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
        let half = half(size);
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let texture = |label, format| flat_texture(device, label, half, format, usage);
        let geometry = texture("geometry", GEOMETRY_FORMAT);
        let (openness, between) = (
            texture("openness", FRACTION_FORMAT),
            texture("openness, between", FRACTION_FORMAT),
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
        (light, columns): (Light, &Range<u32>),
        nothing: &wgpu::BindGroup,
    ) {
        {
            let targets = PassTargets {
                color: Some((&self.geometry, NOTHING_SEEN)),
                depth: Some(&self.depth),
                ..PassTargets::default()
            };
            let mut pass = begin_pass(encoder, "geometry", targets);
            pass.set_bind_group(0, frame_group, &[]);
            pass.set_bind_group(2, nothing, &[]);
            model.draw(&mut pass, posed, Cut::Hard, ModelDraw::Geometry);
        }
        let fill = |encoder: &mut wgpu::CommandEncoder, draw, target| {
            let mut pass = self.begin_fill(encoder, columns, target);
            pass.set_pipeline(&posed.pipelines.get(draw));
            pass.set_bind_group(0, frame_group, &[]);
            pass.draw(0..3, 0..1);
        };
        fill(encoder, Draw::Occlusion(light), &self.openness);
        // The demo blurs twice.
        let blurs = match light {
            Light::Book => 2,
            Light::Studio => 1,
        };
        for _ in 0..blurs {
            fill(encoder, Draw::OcclusionBlurRows, &self.between);
            fill(encoder, Draw::OcclusionBlurColumns, &self.openness);
        }
    }

    /// A pass over these columns of the picture into `target`, from the geometry and the other of the two.
    fn begin_fill<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        columns: &Range<u32>,
        target: &wgpu::TextureView,
    ) -> wgpu::RenderPass<'a> {
        let source = if target == &self.openness {
            &self.between_group
        } else {
            &self.openness_group
        };
        let [width, height] = half(self.size);
        let start = (columns.start / 2).saturating_sub(BLUR_MARGIN);
        let end = (columns.end.div_ceil(2) + BLUR_MARGIN).min(width);
        let targets = PassTargets {
            color: Some((target, wgpu::Color::WHITE)),
            scissor: Some([start, 0, end - start, height]),
            ..PassTargets::default()
        };
        let mut pass = begin_pass(encoder, "occlusion", targets);
        pass.set_bind_group(1, source, &[]);
        pass
    }
}

/// Of the textures for a picture of this size.
fn half(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| side.div_ceil(2))
}
