//! A [`RenderFrame`] as the uniforms that shaders read, and the colours of the themes.

use glam::{Mat4, Vec3};

use super::light_fit::{ContactFit, ShadowFit, StudioLights, to_book_lights};
use crate::scene::{
    Background, Ground, Light, Overlay, Pass, Projection, RenderFrame, Theme, ViewMode, linear_from_srgb8,
};
use crate::shaders;

/// Colours of one theme, sRGB.
pub(super) struct ThemeColors {
    /// Backdrop at its lightest.
    pub(super) backdrop_center: [u8; 3],
    /// Backdrop at its edge.
    pub(super) backdrop_edge: [u8; 3],
    pub(super) grid_minor: [u8; 3],
    pub(super) grid_minor_opacity: f32,
    pub(super) grid_major: [u8; 3],
    pub(super) grid_major_opacity: f32,
    /// Fraction of the ground's light that the shadow takes.
    pub(super) shadow_strength: f32,
    /// Fraction of the ground's light that the contact shadow takes.
    pub(super) contact_strength: f32,
    /// Edges of triangles, with opacity.
    pub(super) wire: [u8; 3],
    pub(super) wire_opacity: f32,
    /// A highlighted submesh.
    pub(super) accent: [u8; 3],
}

const DARK: ThemeColors = ThemeColors {
    backdrop_center: [0x33, 0x38, 0x42],
    backdrop_edge: [0x14, 0x16, 0x1A],
    grid_minor: [0x6B, 0x76, 0x8A],
    grid_minor_opacity: 0.24,
    grid_major: [0x7E, 0x8B, 0xA2],
    grid_major_opacity: 0.36,
    shadow_strength: 0.60,
    contact_strength: 0.85,
    wire: [0xE7, 0xEA, 0xF0],
    wire_opacity: 0.28,
    accent: [0x5A, 0xA9, 0xFF],
};

const LIGHT: ThemeColors = ThemeColors {
    backdrop_center: [0xF4, 0xF5, 0xF7],
    backdrop_edge: [0xCF, 0xD4, 0xDC],
    grid_minor: [0x8A, 0x90, 0x9C],
    grid_minor_opacity: 0.5,
    grid_major: [0x5B, 0x63, 0x70],
    grid_major_opacity: 0.7,
    shadow_strength: 0.5,
    contact_strength: 0.7,
    wire: [0x1B, 0x20, 0x29],
    wire_opacity: 0.4,
    accent: [0x17, 0x69, 0xD2],
};

/// The colours of a theme.
pub(super) fn theme_colors(theme: Theme) -> &'static ThemeColors {
    match theme {
        Theme::Dark => &DARK,
        Theme::Light => &LIGHT,
    }
}

/// The grid fades out this many radii of the scene from its middle, or this many camera distances if that is more.
const GRID_REACH: f32 = 9.0;
const GRID_REACH_OF_DISTANCE: f32 = 2.0;

/// Height of the figure in the books' demo. The demo's lengths go with it.
const BOOK_HEIGHT: f32 = 3.6;
/// A flat model counts as tall as this fraction of its diagonal.
const LEAST_HEIGHT_OF_DIAGONAL: f32 = 0.3;
/// How far occluders reach under the studio light, in units of the books' demo.
const STUDIO_OCCLUSION_RADIUS: f32 = 0.6;

/// What a frame uniform depends on beside the frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// Light of this part of the picture.
    pub(super) light: Light,
    /// Size of the whole picture, pixels.
    pub(super) size: [u32; 2],
    /// +1 when the model's triangles are clockwise from their front in a left-handed space, else −1.
    pub(super) winding: f32,
}

pub(super) fn frame_uniform(frame: &RenderFrame<'_>, part: Part) -> shaders::Frame {
    let camera = &frame.camera;
    let options = &frame.options;
    let [width, height] = part.size.map(|side| side as f32);
    let aspect = width / height;
    let colors = theme_colors(options.theme);
    let bounds = &frame.world_bounds;
    let ground = Ground::under(bounds);
    let contact = ContactFit::new(bounds);
    let book_lights = to_book_lights(options.book_lights_turn_radians);
    let studio_lights = StudioLights::beside(camera, options.environment_turn_radians);
    let book_unit = book_unit(frame);
    let (to_key, shadow) = match part.light {
        Light::Studio => {
            let to_key = studio_lights.to_key;
            (to_key, ShadowFit::studio(bounds, to_key))
        }
        Light::Book => {
            let to_key = book_lights[0];
            (to_key, ShadowFit::book(bounds, to_key, book_unit))
        }
    };
    let clip_from_world = camera.clip_from_view(aspect, bounds) * camera.view_from_world();
    let mirrors = frame.world_from_model.matrix3.determinant() < 0.0;

    let half_height = camera.height_in_view() * 0.5;
    let (per_y, per_x) = (camera.up() * half_height, camera.right() * (half_height * aspect));
    let (is_perspective, eye_scale, forward_scale) = match camera.projection {
        Projection::Perspective { .. } => (1.0, 0.0, 1.0 / camera.distance),
        Projection::Orthographic => (0.0, 1.0, 0.0),
    };
    let reach = (bounds.radius() * GRID_REACH).max(camera.distance * GRID_REACH_OF_DISTANCE);
    let center = bounds.center();
    let (depth_near, depth_far) = seen_depths(frame);
    let passes = options.passes;
    let (background, background_srgb) = match options.background {
        Background::Backdrop | Background::None => (0, [0; 3]),
        Background::Sky => (1, [0; 3]),
        Background::Color(color) => (2, color),
    };
    let to_light = |direction: Vec3| direction.extend(0.0).to_array();
    let is_drawn = |pass| if passes.has(pass) { 1.0 } else { 0.0 };

    shaders::Frame {
        clip_from_world: clip_from_world.to_cols_array_2d(),
        world_from_model: Mat4::from(frame.world_from_model).to_cols_array_2d(),
        shadow_clip_from_world: shadow.shadow_clip_from_world.to_cols_array_2d(),
        eye: camera.eye().to_array(),
        front_sign: if mirrors { -part.winding } else { part.winding },
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
        to_key: to_key.to_array(),
        shadow_strength: if options.view_mode == ViewMode::Lit {
            colors.shadow_strength * is_drawn(Pass::Shadow)
        } else {
            0.0
        },
        to_rim: studio_lights.to_rim.to_array(),
        grid_strength: if options.overlays.has(Overlay::Grid) { 1.0 } else { 0.0 },
        backdrop_center_srgb: encoded(colors.backdrop_center, 1.0),
        backdrop_edge_srgb: encoded(colors.backdrop_edge, 1.0),
        grid_minor: linear(colors.grid_minor, colors.grid_minor_opacity),
        grid_major: linear(colors.grid_major, colors.grid_major_opacity),
        grid_center: [center.x, center.z],
        viewport_pixels: [width, height],
        normal_green_sign: if options.normal_green_flipped { -1.0 } else { 1.0 },
        view_mode: options.view_mode as u32,
        key_shadow: u32::from(passes.has(Pass::Shadow)),
        reflections: is_drawn(Pass::Environment),
        depth_near,
        depth_far,
        exposure_stops: options.exposure_stops,
        is_book: u32::from(part.light == Light::Book),
        to_book_light_1: to_light(book_lights[1]),
        to_book_light_2: to_light(book_lights[2]),
        background_srgb: background_srgb.map(|channel| f32::from(channel) / 255.0),
        background,
        contact_center: contact.center.to_array(),
        contact_half_width: contact.half_width,
        contact_strength: if options.draws_under(Pass::ContactShadow, part.light) {
            colors.contact_strength
        } else {
            0.0
        },
        occlusion_radius: STUDIO_OCCLUSION_RADIUS * book_unit,
        book_unit,
        shadow_radius_texels: shadow.radius_texels,
        ground_shadow_radius_texels: shadow.ground_radius_texels,
    }
}

/// One unit of the books' demo in world units.
fn book_unit(frame: &RenderFrame<'_>) -> f32 {
    let bounds = &frame.world_bounds;
    let height = bounds.size().y.max(2.0 * bounds.radius() * LEAST_HEIGHT_OF_DIAGONAL);
    (height / BOOK_HEIGHT).max(f32::MIN_POSITIVE)
}

/// The nearest and farthest distance of the scene along the view. As narrow as possible, since depth has 16 bits between them.
fn seen_depths(frame: &RenderFrame<'_>) -> (f32, f32) {
    let (camera, bounds) = (&frame.camera, &frame.world_bounds);
    let (near, far) = camera.depth_range(bounds);
    let reach = camera.forward().abs().dot(bounds.size() * 0.5) * 1.01;
    let to_center = (bounds.center() - camera.eye()).dot(camera.forward());
    let (nearest, farthest) = ((to_center - reach).max(near), (to_center + reach).min(far));
    if nearest < farthest {
        (nearest, farthest)
    } else {
        (near, far)
    }
}

/// An encoded colour with opacity, 0…1 a channel.
pub(super) fn encoded(srgb: [u8; 3], opacity: f32) -> [f32; 4] {
    let [red, green, blue] = srgb.map(|channel| f32::from(channel) / 255.0);
    [red, green, blue, opacity]
}

/// A linear colour with opacity.
fn linear(srgb: [u8; 3], opacity: f32) -> [f32; 4] {
    let [red, green, blue] = srgb.map(linear_from_srgb8);
    [red, green, blue, opacity]
}
