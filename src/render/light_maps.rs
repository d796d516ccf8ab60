//! The maps of one light, which passes draw before the picture reads them: shadow map, ambient occlusion and contact map.

use std::ops::Range;

use super::buffers::bind_group;
use super::light_fit::SHADOW_MAP_SIZE;
use super::model::{GpuModel, Posed};
use super::pipelines::Pipelines;
use super::recipe::{Cut, Draw, ModelDraw};
use super::target::{DEPTH_FORMAT, FRACTION_FORMAT, GEOMETRY_FORMAT, PassTargets, begin_pass, flat_texture};
use crate::scene::Light;

const DRAWN_AND_READ: wgpu::TextureUsages =
    wgpu::TextureUsages::RENDER_ATTACHMENT.union(wgpu::TextureUsages::TEXTURE_BINDING);

/// The depth of the model from the key light.
pub(super) struct ShadowMap {
    view: wgpu::TextureView,
}

impl ShadowMap {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        Self {
            view: flat_texture(device, "shadow map", [SHADOW_MAP_SIZE; 2], DEPTH_FORMAT, DRAWN_AND_READ),
        }
    }

    pub(super) fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    /// Without a model the map is empty.
    pub(super) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame_group: &wgpu::BindGroup,
        model: Option<(&GpuModel, Posed<'_>)>,
        nothing: &wgpu::BindGroup,
    ) {
        let targets = PassTargets {
            depth: Some(&self.view),
            depth_is_kept: true,
            ..PassTargets::default()
        };
        let mut pass = begin_pass(encoder, "shadow map", targets);
        if let Some((model, posed)) = model {
            pass.set_bind_group(0, frame_group, &[]);
            pass.set_bind_group(2, nothing, &[]);
            model.draw_caster(&mut pass, posed);
        }
    }
}

/// What the geometry map holds where there is no model: the farthest depth.
const NO_GEOMETRY: wgpu::Color = wgpu::Color {
    r: 0.5,
    g: 0.5,
    b: 1.0,
    a: 1.0,
};

/// Texels beside a light's columns that its blurs read: one radius for each of the book's four blurs.
const BLUR_MARGIN: u32 = 4 * 5;

/// Ambient occlusion at half the picture's resolution, from the normals and the depth of what is in view. Its textures fit
/// pictures of one size.
pub(super) struct AmbientOcclusion {
    size: [u32; 2],
    geometry: wgpu::TextureView,
    depth: wgpu::TextureView,
    occlusion: wgpu::TextureView,
    half_blurred: wgpu::TextureView,
    /// Reads the geometry and `occlusion`.
    occlusion_group: wgpu::BindGroup,
    /// Reads the geometry and `half_blurred`.
    half_blurred_group: wgpu::BindGroup,
}

impl AmbientOcclusion {
    pub(super) fn new(device: &wgpu::Device, pipelines: &Pipelines, size: [u32; 2]) -> Self {
        let texture = |label, format| flat_texture(device, label, half(size), format, DRAWN_AND_READ);
        let geometry = texture("geometry", GEOMETRY_FORMAT);
        let occlusion = texture("occlusion", FRACTION_FORMAT);
        let half_blurred = texture("occlusion, half blurred", FRACTION_FORMAT);
        let group = |rough| {
            let resources = [&geometry, rough].map(wgpu::BindingResource::TextureView);
            bind_group(device, "occlusion", &pipelines.layouts.occlusion, resources)
        };
        Self {
            size,
            depth: flat_texture(
                device,
                "geometry depth",
                half(size),
                DEPTH_FORMAT,
                wgpu::TextureUsages::RENDER_ATTACHMENT,
            ),
            occlusion_group: group(&occlusion),
            half_blurred_group: group(&half_blurred),
            geometry,
            occlusion,
            half_blurred,
        }
    }

    /// Size of the pictures that it fits, pixels.
    pub(super) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Once drawn: the fraction of the environment that reaches each pixel.
    pub(super) fn view(&self) -> &wgpu::TextureView {
        &self.occlusion
    }

    /// `columns` of the picture are this light's.
    pub(super) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame_group: &wgpu::BindGroup,
        (model, posed): (&GpuModel, Posed<'_>),
        (light, columns): (Light, &Range<u32>),
        nothing: &wgpu::BindGroup,
    ) {
        {
            let targets = PassTargets {
                color: Some((&self.geometry, NO_GEOMETRY)),
                depth: Some(&self.depth),
                ..PassTargets::default()
            };
            let mut pass = begin_pass(encoder, "geometry", targets);
            pass.set_bind_group(0, frame_group, &[]);
            pass.set_bind_group(2, nothing, &[]);
            model.draw(&mut pass, posed, Cut::Hard, ModelDraw::Geometry);
        }
        let [width, height] = half(self.size);
        let start = (columns.start / 2).saturating_sub(BLUR_MARGIN);
        let end = (columns.end.div_ceil(2) + BLUR_MARGIN).min(width);
        let mut fill = |draw, source: &wgpu::BindGroup, target: &wgpu::TextureView| {
            let targets = PassTargets {
                color: Some((target, wgpu::Color::WHITE)),
                scissor: Some([start, 0, end - start, height]),
                ..PassTargets::default()
            };
            let mut pass = begin_pass(encoder, "occlusion", targets);
            pass.set_pipeline(&posed.pipelines.get(draw));
            pass.set_bind_group(0, frame_group, &[]);
            pass.set_bind_group(1, source, &[]);
            pass.draw(0..3, 0..1);
        };
        fill(Draw::Occlusion(light), &self.half_blurred_group, &self.occlusion);
        // The books' demo blurs twice.
        let blurs = match light {
            Light::Book => 2,
            Light::Studio => 1,
        };
        for _ in 0..blurs {
            fill(Draw::OcclusionBlurRows, &self.occlusion_group, &self.half_blurred);
            fill(Draw::OcclusionBlurColumns, &self.half_blurred_group, &self.occlusion);
        }
    }
}

/// Size of the textures for a picture of this size.
fn half(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| side.div_ceil(2))
}

/// Texels along each edge of the contact map. Few are enough, since it is blurred.
const CONTACT_MAP_SIZE: u32 = 256;

/// The soft dark on the ground under what is near it: the model seen from straight below, blurred.
pub(super) struct ContactMap {
    map: wgpu::TextureView,
    half_blurred: wgpu::TextureView,
    map_group: wgpu::BindGroup,
    half_blurred_group: wgpu::BindGroup,
}

impl ContactMap {
    pub(super) fn new(device: &wgpu::Device, pipelines: &Pipelines) -> Self {
        let texture = |label| flat_texture(device, label, [CONTACT_MAP_SIZE; 2], FRACTION_FORMAT, DRAWN_AND_READ);
        let group = |view| {
            let resources = [wgpu::BindingResource::TextureView(view)];
            bind_group(device, "contact", &pipelines.layouts.texels, resources)
        };
        let (map, half_blurred) = (texture("contact"), texture("contact, half blurred"));
        Self {
            map_group: group(&map),
            half_blurred_group: group(&half_blurred),
            map,
            half_blurred,
        }
    }

    pub(super) fn view(&self) -> &wgpu::TextureView {
        &self.map
    }

    pub(super) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame_group: &wgpu::BindGroup,
        (model, posed): (&GpuModel, Posed<'_>),
    ) {
        let over_black = |view| PassTargets {
            color: Some((view, wgpu::Color::BLACK)),
            ..PassTargets::default()
        };
        {
            let mut pass = begin_pass(encoder, "contact", over_black(&self.map));
            pass.set_bind_group(0, frame_group, &[]);
            model.draw_shape(&mut pass, posed, ModelDraw::Contact);
        }
        let rows = (Draw::ContactBlurRows, &self.map_group, &self.half_blurred);
        let columns = (Draw::ContactBlurColumns, &self.half_blurred_group, &self.map);
        // Two narrow blurs read fewer texels than one wide blur.
        for (draw, source, target) in [rows, columns, rows, columns] {
            let mut pass = begin_pass(encoder, "contact blur", over_black(target));
            pass.set_pipeline(&posed.pipelines.get(draw));
            pass.set_bind_group(0, source, &[]);
            pass.draw(0..3, 0..1);
        }
    }
}
