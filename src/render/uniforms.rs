//! A [`RenderFrame`] as the uniforms that shaders read, and the colours of the themes.

use glam::{Mat4, Quat, Vec3};

use super::band::{BLUR_MARGIN, Band};
use super::environment::{Lamps, room};
use super::light_fit::{ContactFit, ShadowFit, StudioLights, light_axes, to_book_lights};
use super::samples::{lamp_offset, lens_offset, noise_turn, pixel_offset};
use crate::light::{LAMP_RADIUS_RADIANS, RoomLights};
use crate::scene::{
    Aabb, Background, Camera, Detail, Light, Overlay, Pass, Projection, RenderFrame, Theme, ViewMode, linear_from_srgb8,
};
use crate::shaders;

/// Colours of one theme, sRGB.
pub(super) struct ThemeColors {
    /// Backdrop at its lightest.
    pub(super) backdrop_center: [u8; 3],
    pub(super) backdrop_edge: [u8; 3],
    pub(super) grid: [u8; 3],
    pub(super) grid_opacity: f32,
    /// The floor where the model stands.
    pub(super) floor: [u8; 3],
    /// Fraction of the ground's light that the shadow takes.
    pub(super) shadow_strength: f32,
    pub(super) wire: [u8; 3],
    pub(super) wire_opacity: f32,
    pub(super) accent: [u8; 3],
}

const DARK: ThemeColors = ThemeColors {
    backdrop_center: [0x33, 0x38, 0x42],
    backdrop_edge: [0x14, 0x16, 0x1A],
    grid: [0xB8, 0xC2, 0xD4],
    grid_opacity: 0.10,
    floor: [0x4A, 0x4F, 0x59],
    shadow_strength: 0.60,
    wire: [0xE7, 0xEA, 0xF0],
    wire_opacity: 0.28,
    accent: [0x5A, 0xA9, 0xFF],
};

const LIGHT: ThemeColors = ThemeColors {
    backdrop_center: [0xEB, 0xED, 0xF0],
    backdrop_edge: [0xCF, 0xD4, 0xDC],
    grid: [0x3A, 0x42, 0x50],
    grid_opacity: 0.24,
    floor: [0xE0, 0xE3, 0xE7],
    shadow_strength: 0.55,
    wire: [0x1B, 0x20, 0x29],
    wire_opacity: 0.4,
    accent: [0x17, 0x69, 0xD2],
};

pub(super) fn theme_colors(theme: Theme) -> &'static ThemeColors {
    match theme {
        Theme::Dark => &DARK,
        Theme::Light => &LIGHT,
    }
}

/// The grid fades out this many radii of the scene from its middle.
const GRID_REACH: f32 = 3.5;
/// So many radii from it, a third of the floor is left.
const FLOOR_REACH: f32 = 2.2;

/// Height of a picture that no screen shows, points.
const POINTS_HIGH: f32 = 900.0;

/// Height of the figure in the books' demo. The demo's lengths go with it.
const BOOK_HEIGHT: f32 = 3.6;
/// A flat model counts as tall as this fraction of its diagonal.
const LEAST_HEIGHT_OF_DIAGONAL: f32 = 0.3;
/// Samples of the shadow map for each point.
pub const SHADOW_TAPS: u32 = 16;
/// The part of the lamp's angle by which each of its points is softened where a picture at rest is drawn many times: there are 4 × 4.
const STRATUM: f32 = 0.25;
/// How far occluders reach under the studio light, in units of the books' demo.
const STUDIO_OCCLUSION_RADIUS: f32 = 0.6;
/// The most that ambient occlusion looks away from a pixel, parts of the picture's height. Under the studio light `occlusion_studio.wgsl`
/// has the same limit.
const STUDIO_MOST_REACH: f32 = 0.12;
/// `occlusion_book.wgsl` has no limit: occluders that lie farther off in the picture than this, as where the model is seen from nearby, are not
/// found from within a band.
const BOOK_MOST_REACH: f32 = 0.25;

/// The band of the maps in view that a band of the picture reads: at half the picture's resolution, of a sample at rest at all of it.
///
/// A pixel's ambient occlusion reads the geometry around it, as far as occluders reach, and the blurs read what lies beside it; so the
/// maps have more rows than the picture's band, above and below. How many: the length that occluders reach in the world (the studio's, the
/// book's is shorter), as the nearest point of the model shows it in the picture, but no more than the limit of the light. In a picture
/// divided between two lights both read one map, so the larger limit holds.
pub(super) fn map_band(frame: &RenderFrame<'_>, band: Band) -> Band {
    let camera = &frame.camera;
    let nearest = match camera.projection {
        Projection::Perspective { .. } => seen_depths(frame).0 / camera.distance,
        Projection::Orthographic => 1.0,
    };
    let is_studio = frame.options.light == Light::Studio && frame.options.split.is_none();
    let most = if is_studio { STUDIO_MOST_REACH } else { BOOK_MOST_REACH };
    let reach = STUDIO_OCCLUSION_RADIUS * book_unit(frame) / (camera.height_in_view() * nearest);
    let rows = (reach.min(most) * band.whole[1] as f32) as u32 + 2 * BLUR_MARGIN;
    let band = band.widened(rows.next_multiple_of(2));
    if frame.sample.is_some() { band } else { band.half() }
}

/// The view of a picture, of which this band is drawn.
pub(super) fn camera_uniform(frame: &RenderFrame<'_>, band: Band) -> shaders::Camera {
    let [width, height] = band.whole.map(|side| side as f32);
    let map = map_band(frame, band);
    let aspect = width / height;
    let (camera, lens_shift) = through_lens(frame, aspect);
    let [right, up] = frame.sample.map_or([0.0; 2], pixel_offset);
    let jitter = [right * 2.0 / width + lens_shift[0], up * 2.0 / height + lens_shift[1]];
    let jittered = Mat4::from_translation(Vec3::new(jitter[0], jitter[1], 0.0));
    let clip_from_world = jittered * camera.clip_from_view(aspect, &frame.world_bounds) * camera.view_from_world();
    let half_height = camera.height_in_view() * 0.5;
    let (per_y, per_x) = (camera.up() * half_height, camera.right() * (half_height * aspect));
    let (is_perspective, eye_scale, forward_scale) = match camera.projection {
        Projection::Perspective { .. } => (1.0, 0.0, 1.0 / camera.distance),
        Projection::Orthographic => (0.0, 1.0, 0.0),
    };
    let (depth_near, depth_far) = seen_depths(frame);
    shaders::Camera {
        clip_from_world: clip_from_world.to_cols_array_2d(),
        eye: camera.eye().to_array(),
        is_perspective,
        forward: camera.forward().to_array(),
        depth_near,
        eye_per_x: (per_x * eye_scale).to_array(),
        depth_far,
        eye_per_y: (per_y * eye_scale).to_array(),
        exposure_stops: frame.options.exposure_stops,
        forward_per_x: (per_x * forward_scale).to_array(),
        view_mode: frame.options.view_mode as u32,
        forward_per_y: (per_y * forward_scale).to_array(),
        first_row: band.first_row as f32,
        viewport_pixels: [width, height],
        jitter,
        sample: frame.sample.unwrap_or_default() as f32,
        points_high: frame.options.points_high.unwrap_or(POINTS_HIGH),
        map_size: map.whole.map(|side| side as f32),
        first_map_row: map.first_row as f32,
        ..Default::default()
    }
}

/// The camera moved to a point of the lens, and by how much the picture is moved back, ndc, so that what is in focus stays where it is.
fn through_lens(frame: &RenderFrame<'_>, aspect: f32) -> (Camera, [f32; 2]) {
    let mut camera = frame.camera;
    let options = &frame.options;
    let (Some(sample), true) = (frame.sample, options.aperture > 0.0) else {
        return (camera, [0.0; 2]);
    };
    let focus = options.focus.unwrap_or(camera.target);
    let focus_distance = (focus - camera.eye()).dot(camera.forward()).max(camera.distance * 0.01);
    let [x, y] = lens_offset(sample).map(|offset| offset * 0.5 * options.aperture * focus_distance);
    camera.target += camera.right() * x + camera.up() * y;
    let half_height = 0.5
        * camera.height_in_view()
        * match camera.projection {
            Projection::Perspective { .. } => focus_distance / camera.distance,
            Projection::Orthographic => 1.0,
        };
    (camera, [x / (half_height * aspect), y / half_height])
}

/// The part of a picture that this light lights, with a shadow map of so many texels along each edge.
pub fn light_uniform(frame: &RenderFrame<'_>, light: Light, lamps: Lamps, map_side: u32) -> shaders::Light {
    let options = &frame.options;
    let (to_key, shadow) = key_light(frame, light, lamps, map_side);
    let lights = match lamps {
        Lamps::Studio => room(options.theme).lights(),
        Lamps::Sky(lamp) => RoomLights {
            key: lamp.map_or(Vec3::ZERO, |lamp| lamp.color),
            rim: Vec3::ZERO,
        },
    };
    let is_mirrored = match lamps {
        Lamps::Studio => true,
        Lamps::Sky(lamp) => lamp.is_some_and(|lamp| lamp.is_sun),
    };
    let to_rim = StudioLights::beside(&frame.camera, options.environment_turn_radians).to_rim;
    let [_, to_book_light_1, to_book_light_2] = to_book_lights(options.book_lights_turn_radians);
    let book_unit = book_unit(frame);
    shaders::Light {
        shadow_clip_from_world: shadow.shadow_clip_from_world.to_cols_array_2d(),
        to_key: to_key.to_array(),
        shadow_texel: shadow.texel,
        to_rim: to_rim.to_array(),
        shadow_radius_texels: shadow.radius_texels,
        shadow_depth: shadow.depth,
        to_book_light_1: to_book_light_1.to_array(),
        occlusion_radius: STUDIO_OCCLUSION_RADIUS * book_unit,
        to_book_light_2: to_book_light_2.to_array(),
        book_unit,
        key_shadow: u32::from(options.passes.has(Pass::Shadow)),
        reflections: if options.passes.has(Pass::Environment) {
            1.0
        } else {
            0.0
        },
        is_book: u32::from(light == Light::Book),
        normal_green_sign: if options.normal_green_flipped { -1.0 } else { 1.0 },
        fine_occlusion: u32::from(options.occlusion_detail == Detail::Full),
        shadow_taps: match options.shadow_detail {
            Detail::Full => SHADOW_TAPS,
            Detail::Low => SHADOW_TAPS / 2,
        },
        key_color: lights.key.to_array(),
        noise_turn: frame.sample.map_or(0.0, noise_turn),
        lamp_tangent: LAMP_RADIUS_RADIANS.tan() * if frame.sample.is_some() { STRATUM } else { 1.0 },
        key_mirrored: f32::from(u8::from(is_mirrored)),
        rim_color: lights.rim.to_array(),
    }
}

/// The ground where this light lights it, and what is behind the model.
pub(super) fn ground_uniform(frame: &RenderFrame<'_>, light: Light, lamps: Lamps) -> shaders::Ground {
    let options = &frame.options;
    let colors = theme_colors(options.theme);
    let bounds = &frame.world_bounds;
    let ground = &frame.ground;
    let contact = contact_fit(frame);
    let center = bounds.center();
    let (background, background_srgb) = match options.background {
        Background::Backdrop => (0, [0; 3]),
        Background::Sky => (1, [0; 3]),
        Background::Color(color) => (2, color),
        Background::None => (3, [0; 3]),
    };
    let when = |is_drawn, strength| if is_drawn { strength } else { 0.0 };
    let has_shadow = options.view_mode == ViewMode::Lit && options.passes.has(Pass::Shadow);
    let has_contact = options.draws_under(Pass::ContactShadow, light);
    shaders::Ground {
        backdrop_center_srgb: encoded(colors.backdrop_center, 1.0),
        backdrop_edge_srgb: encoded(colors.backdrop_edge, 1.0),
        grid: linear(
            colors.grid,
            when(options.overlays.has(Overlay::Grid), colors.grid_opacity),
        ),
        floor: linear(colors.floor, when(background == 0, 1.0)),
        background_srgb: background_srgb.map(|channel| f32::from(channel) / 255.0),
        background,
        center: [center.x, center.z],
        contact_center: contact.center.to_array(),
        contact_half_width: contact.half_width,
        contact_strength: when(has_contact, 1.0),
        shadow_strength: when(
            has_shadow,
            match (light, lamps) {
                (Light::Studio, Lamps::Sky(lamp)) => lamp.map_or(0.0, |lamp| lamp.ground_share),
                _ => colors.shadow_strength,
            },
        ),
        height: ground.height,
        grid_cell: ground.cell,
        grid_reach: bounds.radius() * GRID_REACH,
        floor_reach: bounds.radius() * FLOOR_REACH,
        ..Default::default()
    }
}

pub(super) fn contact_fit(frame: &RenderFrame<'_>) -> ContactFit {
    ContactFit::new(&frame.world_bounds, book_unit(frame))
}

/// The unit vector towards the light that casts shadows, and what its shadow map covers.
fn key_light(frame: &RenderFrame<'_>, light: Light, lamps: Lamps, map_side: u32) -> (Vec3, ShadowFit) {
    let (options, bounds) = (&frame.options, &frame.world_bounds);
    match light {
        Light::Studio => {
            let turn = options.environment_turn_radians;
            let to_key = match lamps {
                Lamps::Studio => StudioLights::beside(&frame.camera, turn).to_key,
                Lamps::Sky(lamp) => Quat::from_rotation_y(turn) * lamp.map_or(Vec3::Y, |lamp| lamp.direction),
            };
            // A sample at rest has the shadow of one point of the lamp.
            let [right, up, _] = light_axes(to_key);
            let lamp_point = frame.sample.map_or(to_key, |sample| {
                let [x, y] = lamp_offset(sample).map(|offset| offset * LAMP_RADIUS_RADIANS.tan());
                (to_key + right * x + up * y).normalize()
            });
            (to_key, ShadowFit::studio(bounds, lamp_point, map_side))
        }
        Light::Book => {
            let [to_key, ..] = to_book_lights(options.book_lights_turn_radians);
            (to_key, ShadowFit::book(bounds, to_key, map_side, book_unit(frame)))
        }
    }
}

/// Size of the box that one instance reaches, world space: the scene's, less how far apart the instances stand. Lengths that go with the
/// figure are then the same in a crowd. Where instances are turned, or the scene's box is not as wide as they stand, it is about that.
pub fn instance_size(frame: &RenderFrame<'_>) -> Vec3 {
    let crowd = frame.crowd.instances.iter().map(|instance| &instance.world_from_model);
    let places = std::iter::once(&frame.world_from_model).chain(crowd);
    let apart = Aabb::from_points(places.map(|world_from_model| world_from_model.translation.into())).size();
    (frame.world_bounds.size() - apart).max(Vec3::ZERO)
}

/// One unit of the books' demo in world units.
fn book_unit(frame: &RenderFrame<'_>) -> f32 {
    let size = instance_size(frame);
    let height = size.y.max(size.length() * LEAST_HEIGHT_OF_DIAGONAL);
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
