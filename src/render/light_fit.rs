//! Where the lights stand, and what their shadow and contact maps cover. Both maps depend on the scene's box alone, not on the
//! pose, so they do not swim while the model moves.

use glam::{Mat4, Quat, Vec2, Vec3, Vec4};

use crate::scene::{Aabb, Camera};

/// Where the studio's lights stand. They keep their place beside the viewer, as if the model stood on a turntable: every side
/// that is looked at is lit well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StudioLights {
    /// Unit vector towards the key: high over the viewer's right shoulder.
    pub to_key: Vec3,
    /// Unit vector towards the rim: behind the model, from the left.
    pub to_rim: Vec3,
}

impl StudioLights {
    /// Turns with the whole studio about y.
    pub fn beside(camera: &Camera, turn_radians: f32) -> Self {
        let turn = Quat::from_rotation_y(turn_radians);
        let right = camera.right();
        let ahead = right.cross(Vec3::Y);
        let towards = |x: f32, y: f32, z: f32| turn * (right * x + Vec3::Y * y + ahead * z).normalize();
        Self {
            to_key: towards(0.55, 0.66, -0.51),
            to_rim: towards(-0.72, 0.36, 0.58),
        }
    }
}

/// Directions in which the three lights of the books' demo shine, before they turn.
const BOOK_DIRECTIONS: [Vec3; 3] = [
    Vec3::new(0.57735, -0.57735, 0.57735),
    Vec3::new(-0.57735, -0.57735, 0.57735),
    Vec3::new(0.0, -0.707, -0.707),
];

/// Unit vectors towards the three lights of the books' demo, turned about y.
pub fn to_book_lights(turn_radians: f32) -> [Vec3; 3] {
    let turn = Quat::from_rotation_y(turn_radians);
    BOOK_DIRECTIONS.map(|direction| turn * -direction.normalize())
}

/// Texels around the scene's box that stay empty: those at the edge stand for all that is beside the map.
const MARGIN_TEXELS: f32 = 4.0;

/// The demo's map covers a sphere of radius √(10² + 15²) units with 2048 texels: world size of a texel, units of the demo.
const BOOK_TEXEL: f32 = 2.0 * 18.027_756 / 2048.0;
/// The demo takes 3 × 3 comparison samples a texel apart, each a ramp one texel wide. Together they make an edge a ramp 3 texels
/// wide, of which the part from 10 to 90 % is 2.4 texels: 1.17 % of the height of the figure there, which is 3.6 units.
const BOOK_EDGE: f32 = 2.4 * BOOK_TEXEL;
/// Width of a shadow's edge from 10 to 90 % when it is blurred evenly over a disc, in radii of the disc: a tenth of the disc's
/// area lies beyond 0.687 radii on either side.
const DISC_EDGE: f32 = 1.374;
/// Texels in the radius of the book light's disc. In a larger disc its 16 taps would show steps in the edge.
const BOOK_RADIUS_TEXELS: f32 = 3.5;

/// Where the map is too coarse for that, this radius hides its steps.
const LEAST_RADIUS_TEXELS: f32 = 1.5;

/// How the shadow map covers a scene, and how it is blurred.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadowFit {
    /// World -> the map's clip space.
    pub shadow_clip_from_world: Mat4,
    /// World units that a texel covers.
    pub texel: f32,
    /// World units between its nearest and its farthest depth.
    pub depth: f32,
    /// Radius of the disc over which the book's shadows are blurred, texels. The studio's are as soft as the lamp makes them.
    pub radius_texels: f32,
}

impl ShadowFit {
    /// For the studio light: the smallest square that holds the box as seen from the light, so that edges are as sharp as the map
    /// allows. `to_key` is a unit vector; the map has `map_side` texels along each edge.
    pub fn studio(world_bounds: &Aabb, to_key: Vec3, map_side: u32) -> Self {
        Self::with_least_texel(world_bounds, to_key, map_side, 0.0)
    }

    /// For the book light: edges are as wide as the demo's, [`BOOK_EDGE`], whatever the box. So the map may be larger than the box,
    /// as it is in the demo. Where the map is too coarse for that, they are wider. `book_unit` is one unit of the demo in world units.
    pub fn book(world_bounds: &Aabb, to_key: Vec3, map_side: u32, book_unit: f32) -> Self {
        let radius = BOOK_EDGE / DISC_EDGE * book_unit;
        let fit = Self::with_least_texel(world_bounds, to_key, map_side, radius / BOOK_RADIUS_TEXELS);
        let radius_texels = (radius / fit.texel).max(LEAST_RADIUS_TEXELS);
        Self { radius_texels, ..fit }
    }

    /// A square that holds the box as seen from the light. Its texels are at least this large. No blur.
    fn with_least_texel(world_bounds: &Aabb, to_key: Vec3, map_side: u32, least_texel: f32) -> Self {
        let axes = light_axes(to_key);
        let [right, up, forward] = axes;
        let center = world_bounds.center();
        // The origin is the middle of the box, so that numbers stay small wherever the box lies.
        let light_from_world = Mat4::from_cols(right.extend(0.0), up.extend(0.0), forward.extend(0.0), Vec4::W)
            .transpose()
            * Mat4::from_translation(-center);
        let half_size = world_bounds.size() * 0.5;
        let half_width = tight_half_width(half_size, axes, map_side).max(least_texel * map_side as f32 * 0.5);
        let half_depth = reach(half_size, forward).max(least_reach(half_size)) * 1.01;
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
            texel: 2.0 * half_width / map_side as f32,
            depth: 2.0 * half_depth,
            radius_texels: 0.0,
        }
    }
}

/// Half the width of the least map that holds a box of this half size.
fn tight_half_width(half_size: Vec3, [right, up, _]: [Vec3; 3], map_side: u32) -> f32 {
    let reach = reach(half_size, right).max(reach(half_size, up));
    reach.max(least_reach(half_size)) * (1.0 + 2.0 * MARGIN_TEXELS / map_side as f32)
}

/// How far a box of this half size reaches from its middle along an axis.
fn reach(half_size: Vec3, axis: Vec3) -> f32 {
    axis.abs().dot(half_size)
}

/// An empty or flat box still needs a map of some size.
fn least_reach(half_size: Vec3) -> f32 {
    f32::MIN_POSITIVE.max(half_size.max_element() * 1e-3).max(1e-20)
}

/// Right, up and forward of the light's view. They turn evenly with the light, except within 1° of the vertical.
pub fn light_axes(to_key: Vec3) -> [Vec3; 3] {
    let forward = -to_key;
    let above = if forward.y.abs() < 0.9998 { Vec3::Y } else { Vec3::Z };
    let right = above.cross(forward).normalize();
    [right, forward.cross(right), forward]
}

/// World size of a texel of the contact map, units of the books' demo: 12 mm of a man of 1.8 m.
const CONTACT_TEXEL: f32 = 0.024;
/// Texels beside the scene's box: the blur needs room.
const CONTACT_MARGIN_TEXELS: f32 = 28.0;
/// Texels along each edge of the contact map of one figure. Few are enough, since it is blurred.
pub const CONTACT_MAP_SIZE: u32 = 256;
/// The same of a crowd's, at most, whose texels are then larger. Its blur takes the time.
const LARGEST_CONTACT_MAP_SIZE: u32 = 1024;

/// The square of the ground that the contact map covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactFit {
    /// World x and z of its middle: a whole number of texels, so that it does not swim where the scene's box grows.
    pub center: Vec2,
    pub half_width: f32,
    /// Texels along each edge.
    pub map_size: u32,
}

impl ContactFit {
    /// With texels of the same size in the world as far as the largest map allows. `book_unit` is one unit of the books' demo in world
    /// units.
    pub fn new(world_bounds: &Aabb, book_unit: f32) -> Self {
        let size = world_bounds.size();
        let width = size.x.max(size.z).max(0.0);
        let texels = width / (CONTACT_TEXEL * book_unit) + 2.0 * CONTACT_MARGIN_TEXELS + 1.0;
        let map_size = (CONTACT_MAP_SIZE..=LARGEST_CONTACT_MAP_SIZE)
            .step_by(CONTACT_MAP_SIZE as usize)
            .find(|&side| side as f32 >= texels)
            .unwrap_or(LARGEST_CONTACT_MAP_SIZE);
        let texel = (CONTACT_TEXEL * book_unit).max(width / (map_size as f32 - 2.0 * CONTACT_MARGIN_TEXELS - 1.0));
        let texel = texel.max(1e-20);
        let center = world_bounds.center();
        let snapped = |place: f32| (place / texel).round() * texel;
        Self {
            center: Vec2::new(snapped(center.x), snapped(center.z)),
            half_width: 0.5 * texel * map_size as f32,
            map_size,
        }
    }
}
