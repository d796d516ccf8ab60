//! The maps that passes draw before the picture reads them: shadow map, ambient occlusion and contact map of one light, and the
//! geometry in view. A map is drawn again only when something that it shows is different.

use std::ops::Range;

use super::band::{BLUR_MARGIN, Band, half};
use super::buffers::bind_group;
use super::model::{GpuModel, Posed};
use super::pipelines::Pipelines;
use super::recipe::{Draw, Purpose};
use super::target::{CONTACT_FORMAT, DEPTH_FORMAT, GEOMETRY_FORMAT, PassTargets, begin_pass, flat_texture, pixels};
use super::timing::FrameEncoder;
use crate::scene::{Light, TimedPass};
use crate::shaders;

const DRAWN_AND_READ: wgpu::TextureUsages =
    wgpu::TextureUsages::RENDER_ATTACHMENT.union(wgpu::TextureUsages::TEXTURE_BINDING);

/// What a map was last drawn from.
struct DrawnFrom<T>(Option<T>);

impl<T: PartialEq> DrawnFrom<T> {
    /// Whether the map has to be drawn, since it was drawn from something else or never.
    fn update(&mut self, source: T) -> bool {
        let differs = self.0.as_ref() != Some(&source);
        self.0 = Some(source);
        differs
    }
}

/// The depth of the model from the key light.
pub(super) struct ShadowMap {
    view: wgpu::TextureView,
    /// Revision of the shape, and `shadow_clip_from_world`.
    drawn_from: DrawnFrom<(u64, [[f32; 4]; 4])>,
}

impl ShadowMap {
    pub(super) fn new(device: &wgpu::Device, side: u32) -> Self {
        Self {
            view: flat_texture(device, "shadow map", [side; 2], DEPTH_FORMAT, DRAWN_AND_READ),
            drawn_from: DrawnFrom(None),
        }
    }

    /// Texels along each edge.
    pub(super) fn side(&self) -> u32 {
        self.view.texture().width()
    }

    pub(super) fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    /// Without a model the map is empty.
    pub(super) fn draw(
        &mut self,
        encoder: &mut FrameEncoder,
        (frame_group, light): (&wgpu::BindGroup, &shaders::Light),
        (shape_revision, model): (u64, Option<(&GpuModel, Posed<'_>)>),
        nothing: &wgpu::BindGroup,
    ) {
        if !self.drawn_from.update((shape_revision, light.shadow_clip_from_world)) {
            return;
        }
        let targets = PassTargets {
            depth: Some(&self.view),
            depth_is_kept: true,
            ..PassTargets::default()
        };
        let mut pass = begin_pass(encoder, TimedPass::ShadowMap, targets);
        if let Some((model, posed)) = model {
            pass.set_bind_group(0, frame_group, &[]);
            pass.set_bind_group(2, nothing, &[]);
            model.draw_solid(&mut pass, posed, Purpose::Caster);
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

/// Normals and depth of the model in view, at half the picture's resolution; of a sample at rest at all of it. Both lights read it. It may
/// fill a part of its textures, from the top left.
pub(super) struct GeometryMap {
    /// What is filled.
    band: Band,
    geometry: wgpu::TextureView,
    depth: wgpu::TextureView,
    shares_depth: bool,
    is_full_size: bool,
    /// Revision of the shape, the camera, and the band.
    drawn_from: DrawnFrom<(u64, shaders::Camera, Band)>,
    /// Counts how often it was drawn.
    revision: u64,
}

impl GeometryMap {
    /// For bands up to this size. It may share the depth of a target of this capacity, whose picture is drawn after it.
    pub(super) fn new(
        device: &wgpu::Device,
        capacity: [u32; 2],
        of_target: Option<&wgpu::TextureView>,
        is_full_size: bool,
    ) -> Self {
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let own_depth = || flat_texture(device, "geometry depth", capacity, DEPTH_FORMAT, usage);
        Self {
            band: Band::all(capacity),
            geometry: flat_texture(device, "geometry", capacity, GEOMETRY_FORMAT, DRAWN_AND_READ),
            depth: of_target.cloned().unwrap_or_else(own_depth),
            shares_depth: of_target.is_some(),
            is_full_size,
            drawn_from: DrawnFrom(None),
            revision: 0,
        }
    }

    fn capacity(&self) -> [u32; 2] {
        [self.geometry.texture().width(), self.geometry.texture().height()]
    }

    /// Whether a band of this size fits, of a target with this depth where that is shared.
    pub(super) fn has_room(&self, size: [u32; 2], of_target: Option<&wgpu::TextureView>) -> bool {
        let has_all = self.capacity().iter().zip(size).all(|(&has, needs)| has >= needs);
        has_all && of_target.map_or(!self.shares_depth, |depth| self.depth == *depth)
    }

    /// Whether it has more than so many times the texels that a picture of this size needs, at half its resolution.
    pub(super) fn exceeds(&self, times: u64, size: [u32; 2]) -> bool {
        pixels(self.capacity()) > times * pixels(half(size))
    }

    pub(super) fn textures(&self) -> [&wgpu::Texture; 2] {
        [self.geometry.texture(), self.depth.texture()]
    }

    pub(super) fn draw(
        &mut self,
        encoder: &mut FrameEncoder,
        (frame_group, camera, band): (&wgpu::BindGroup, &shaders::Camera, Band),
        (shape_revision, (model, posed)): (u64, (&GpuModel, Posed<'_>)),
        nothing: &wgpu::BindGroup,
    ) {
        let place = shaders::Camera {
            exposure_stops: 0.0,
            view_mode: 0,
            sample: 0.0,
            ..*camera
        };
        if !self.drawn_from.update((shape_revision, place, band)) {
            return;
        }
        self.revision += 1;
        self.band = band;
        let targets = PassTargets {
            color: Some((&self.geometry, NO_GEOMETRY)),
            depth: Some(&self.depth),
            filled: Some(band),
            ..PassTargets::default()
        };
        let mut pass = begin_pass(encoder, TimedPass::Geometry, targets);
        pass.set_bind_group(0, frame_group, &[]);
        pass.set_bind_group(2, nothing, &[]);
        model.draw(&mut pass, posed, Purpose::Geometry);
    }
}

/// What ambient occlusion is drawn from, beside the geometry of this revision.
#[derive(PartialEq)]
struct OcclusionSource {
    geometry_revision: u64,
    columns: Range<u32>,
    band: Band,
    /// Lengths of the light, world units.
    radius: f32,
    book_unit: f32,
    fine: u32,
    noise_turn: f32,
}

/// Ambient occlusion at the size of the geometry map, from the normals and the depth of what is in view. In samples at rest it is not
/// blurred: their mean is smooth.
pub(super) struct OcclusionMap {
    occlusion: wgpu::TextureView,
    half_blurred: wgpu::TextureView,
    is_blurred: bool,
    /// Reads the geometry and `occlusion`.
    occlusion_group: wgpu::BindGroup,
    /// Reads the geometry and `half_blurred`.
    half_blurred_group: wgpu::BindGroup,
    drawn_from: DrawnFrom<OcclusionSource>,
}

impl OcclusionMap {
    pub(super) fn new(device: &wgpu::Device, pipelines: &Pipelines, map: &GeometryMap) -> Self {
        let texture = |label, size| flat_texture(device, label, size, GEOMETRY_FORMAT, DRAWN_AND_READ);
        let is_blurred = !map.is_full_size;
        let blurred_size = if is_blurred { map.capacity() } else { [1; 2] };
        let occlusion = texture("occlusion", map.capacity());
        let half_blurred = texture("occlusion, half blurred", blurred_size);
        let group = |rough| {
            let resources = [&map.geometry, rough].map(wgpu::BindingResource::TextureView);
            bind_group(device, "occlusion", &pipelines.layouts.occlusion, resources)
        };
        Self {
            occlusion_group: group(&occlusion),
            half_blurred_group: group(&half_blurred),
            occlusion,
            half_blurred,
            is_blurred,
            drawn_from: DrawnFrom(None),
        }
    }

    pub(super) fn textures(&self) -> [&wgpu::Texture; 2] {
        [self.occlusion.texture(), self.half_blurred.texture()]
    }

    /// Once drawn: the fraction of the environment that reaches each pixel.
    pub(super) fn view(&self) -> &wgpu::TextureView {
        &self.occlusion
    }

    /// `columns` of the picture's band are this light's.
    pub(super) fn draw(
        &mut self,
        encoder: &mut FrameEncoder,
        pipelines: &Pipelines,
        (frame_group, uniform): (&wgpu::BindGroup, &shaders::Light),
        (light, columns, band): (Light, &Range<u32>, Band),
        map: &GeometryMap,
    ) {
        let source = OcclusionSource {
            geometry_revision: map.revision,
            columns: columns.clone(),
            band,
            radius: uniform.occlusion_radius,
            book_unit: uniform.book_unit,
            fine: uniform.fine_occlusion,
            noise_turn: uniform.noise_turn,
        };
        if !self.drawn_from.update(source) {
            return;
        }
        let [width, _] = map.band.whole;
        let divisor = if self.is_blurred { 2 } else { 1 };
        let start = (columns.start / divisor).saturating_sub(BLUR_MARGIN);
        let end = (columns.end.div_ceil(divisor) + BLUR_MARGIN).min(width);
        let drawn = if self.is_blurred { band.half() } else { band }.widened(BLUR_MARGIN);
        let top = drawn.first_row - map.band.first_row;
        let mut fill = |draw, source: &wgpu::BindGroup, target: &wgpu::TextureView| {
            let targets = PassTargets {
                color: Some((target, wgpu::Color::WHITE)),
                filled: Some(map.band),
                scissor: Some([start, top, end - start, drawn.rows]),
                ..PassTargets::default()
            };
            let mut pass = begin_pass(encoder, TimedPass::AmbientOcclusion, targets);
            pass.set_pipeline(&pipelines.get(draw));
            pass.set_bind_group(0, frame_group, &[]);
            pass.set_bind_group(1, source, &[]);
            pass.draw(0..3, 0..1);
        };
        fill(Draw::Occlusion(light), &self.half_blurred_group, &self.occlusion);
        let blurs = if self.is_blurred { occlusion_blurs(light) } else { 0 };
        for _ in 0..blurs {
            fill(Draw::OcclusionBlurRows, &self.occlusion_group, &self.half_blurred);
            fill(Draw::OcclusionBlurColumns, &self.half_blurred_group, &self.occlusion);
        }
    }
}

/// How often ambient occlusion is blurred, along rows and along columns: in the books' demo twice.
pub fn occlusion_blurs(light: Light) -> u32 {
    match light {
        Light::Book => 2,
        Light::Studio => 1,
    }
}

/// Along rows and columns in turn: two narrow blurs read fewer texels than one wide blur.
pub const CONTACT_BLURS: usize = 4;

/// The soft dark on the ground under what is near it: the model seen from straight below, blurred.
pub(super) struct ContactMap {
    /// Texels along each edge.
    size: u32,
    map: wgpu::TextureView,
    half_blurred: wgpu::TextureView,
    map_group: wgpu::BindGroup,
    half_blurred_group: wgpu::BindGroup,
    drawn_from: DrawnFrom<ContactSource>,
}

/// What the contact map is drawn from: the shape of this revision, and where the map lies, world units.
#[derive(PartialEq)]
struct ContactSource {
    shape_revision: u64,
    center: [f32; 2],
    half_width: f32,
    ground_height: f32,
    book_unit: f32,
}

impl ContactMap {
    pub(super) fn new(device: &wgpu::Device, pipelines: &Pipelines, size: u32) -> Self {
        let texture = |label| flat_texture(device, label, [size; 2], CONTACT_FORMAT, DRAWN_AND_READ);
        let group = |view| {
            let resources = [wgpu::BindingResource::TextureView(view)];
            bind_group(device, "contact", &pipelines.layouts.texels, resources)
        };
        let (map, half_blurred) = (texture("contact"), texture("contact, half blurred"));
        Self {
            size,
            map_group: group(&map),
            half_blurred_group: group(&half_blurred),
            map,
            half_blurred,
            drawn_from: DrawnFrom(None),
        }
    }

    /// Texels along each edge.
    pub(super) fn size(&self) -> u32 {
        self.size
    }

    pub(super) fn view(&self) -> &wgpu::TextureView {
        &self.map
    }

    pub(super) fn draw(
        &mut self,
        encoder: &mut FrameEncoder,
        (frame_group, light, ground): (&wgpu::BindGroup, &shaders::Light, &shaders::Ground),
        (shape_revision, (model, posed)): (u64, (&GpuModel, Posed<'_>)),
        nothing: &wgpu::BindGroup,
    ) {
        let source = ContactSource {
            shape_revision,
            center: ground.contact_center,
            half_width: ground.contact_half_width,
            ground_height: ground.height,
            book_unit: light.book_unit,
        };
        if !self.drawn_from.update(source) {
            return;
        }
        let over_black = |view| PassTargets {
            color: Some((view, wgpu::Color::BLACK)),
            ..PassTargets::default()
        };
        {
            let mut pass = begin_pass(encoder, TimedPass::Contact, over_black(&self.map));
            pass.set_bind_group(0, frame_group, &[]);
            pass.set_bind_group(2, nothing, &[]);
            model.draw_solid(&mut pass, posed, Purpose::Contact);
        }
        let rows = (Draw::ContactBlurRows, &self.map_group, &self.half_blurred);
        let columns = (Draw::ContactBlurColumns, &self.half_blurred_group, &self.map);
        for (draw, source, target) in [rows, columns].into_iter().cycle().take(CONTACT_BLURS) {
            let mut pass = begin_pass(encoder, TimedPass::Contact, over_black(target));
            pass.set_pipeline(&posed.pipelines.get(draw));
            pass.set_bind_group(0, source, &[]);
            pass.draw(0..3, 0..1);
        }
    }
}
