//! The key light's depth map over the whole scene box: it does not swim while the model moves.

use glam::{Mat4, Vec3, Vec4};

use super::target::{DEPTH_FORMAT, PassTargets, begin_pass, flat_texture};
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
        let targets = PassTargets {
            depth: Some(&self.view),
            depth_is_kept: true,
            ..PassTargets::default()
        };
        begin_pass(encoder, "shadow map", targets)
    }
}

/// The demo's map covers a sphere of radius √(10² + 15²) units with 2048 texels: world size of a texel, units of the demo.
const BOOK_TEXEL: f32 = 2.0 * 18.027_756 / 2048.0;
/// The demo takes 3 × 3 comparison samples a texel apart, each a ramp one texel wide. Together they make an edge a ramp 3 texels
/// wide, of which the part from 10 to 90 % is 2.4 texels: 1.17 % of the height of the figure there, which is 3.6 units.
const BOOK_EDGE: f32 = 2.4 * BOOK_TEXEL;
/// From 10 to 90 % of the edge that taps spread evenly over a disc make, in radii of the disc: of the disc's area, a tenth lies
/// beyond 0.687 radii on either side.
const DISC_EDGE: f32 = 1.374;
/// Texels in the radius of the book light's disc: as far apart as its 16 taps can be without leaving steps in the edge.
const BOOK_RADIUS_TEXELS: f32 = 3.5;

/// Texels in the radius of the studio light's disc on the model: a soft box is never quite sharp.
const STUDIO_RADIUS_TEXELS: f32 = 2.5;
/// And on the ground, where the shadow lies farther from what casts it.
const STUDIO_GROUND_RADIUS_TEXELS: f32 = 6.0;

/// How the map covers a scene, and how it is blurred. It depends on the scene's box and the light alone, so texels stay where they
/// are while the model moves in its box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ShadowFit {
    /// World -> the map's clip space.
    pub(super) shadow_clip_from_world: Mat4,
    /// World units that a texel covers.
    pub(super) texel: f32,
    /// Radius of the disc over which shadows on the model are blurred, texels.
    pub(super) radius_texels: f32,
    /// The same for the shadow on the ground.
    pub(super) ground_radius_texels: f32,
}

impl ShadowFit {
    /// The studio's: the least square that holds the box as seen from the light, so that edges are as sharp as the map allows.
    /// `to_key` is a unit vector.
    pub(super) fn studio(world_bounds: &Aabb, to_key: Vec3) -> Self {
        Self {
            radius_texels: STUDIO_RADIUS_TEXELS,
            ground_radius_texels: STUDIO_GROUND_RADIUS_TEXELS,
            ..Self::with_least_texel(world_bounds, to_key, 0.0)
        }
    }

    /// The book's: its edges are as wide as the demo's, [`BOOK_EDGE`], whatever the box. `book_unit` is one unit of the demo in
    /// world units. The box may lie in the middle of a larger square, as the figure does in the demo.
    pub(super) fn book(world_bounds: &Aabb, to_key: Vec3, book_unit: f32) -> Self {
        let radius = BOOK_EDGE / DISC_EDGE * book_unit;
        let fit = Self::with_least_texel(world_bounds, to_key, radius / BOOK_RADIUS_TEXELS);
        let radius_texels = radius / fit.texel;
        Self {
            radius_texels,
            ground_radius_texels: radius_texels,
            ..fit
        }
    }

    /// A square that holds the box as seen from the light, with texels of this size or, if it needs them, larger ones. No blur.
    fn with_least_texel(world_bounds: &Aabb, to_key: Vec3, least_texel: f32) -> Self {
        let [right, up, forward] = light_axes(to_key);
        let center = world_bounds.center();
        // From the light's axes through the middle of the box, so that numbers stay small wherever the box lies.
        let light_from_world = Mat4::from_cols(right.extend(0.0), up.extend(0.0), forward.extend(0.0), Vec4::W)
            .transpose()
            * Mat4::from_translation(-center);
        let half_size = world_bounds.size() * 0.5;
        let reach = |axis: Vec3| axis.abs().dot(half_size);
        // An empty or flat box still wants a map of some size.
        let least = f32::MIN_POSITIVE.max(half_size.max_element() * 1e-3).max(1e-20);
        let tight = reach(right).max(reach(up)).max(least) * (1.0 + 2.0 * MARGIN_TEXELS / SIZE as f32);
        let half_width = tight.max(least_texel * SIZE as f32 * 0.5);
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
            radius_texels: 0.0,
            ground_radius_texels: 0.0,
        }
    }
}

/// Right, up and forward of the light's view. They turn evenly with the light, but for lights within 1° of the vertical.
fn light_axes(to_key: Vec3) -> [Vec3; 3] {
    let forward = -to_key;
    let above = if forward.y.abs() < 0.9998 { Vec3::Y } else { Vec3::Z };
    let right = above.cross(forward).normalize();
    [right, forward.cross(right), forward]
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
            let bounds = Aabb { min, max };
            for fit in [
                ShadowFit::studio(&bounds, to_key),
                ShadowFit::book(&bounds, to_key, bounds.size().y / 3.6),
            ] {
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

    const FIGURE: Aabb = Aabb {
        min: Vec3::new(-0.7, 0.0, -0.4),
        max: Vec3::new(0.7, 3.6, 0.4),
    };

    /// A thousandth of a radian moves a point of a turning map by no more than that, in maps, times the corner's distance from
    /// the middle, which is below 2. A frame that turns over moves it by the whole map.
    #[test]
    fn the_map_turns_evenly_with_the_light() {
        const STEP_RADIANS: f32 = 1e-3;
        let lights = [Vec3::new(0.64, 0.74, -0.34), Vec3::new(-0.57735, 0.57735, -0.57735)];
        for to_key in lights.map(Vec3::normalize) {
            let fit_at = |step: u32| {
                let turned = glam::Quat::from_rotation_y(step as f32 * STEP_RADIANS) * to_key;
                [
                    ShadowFit::studio(&FIGURE, turned),
                    ShadowFit::book(&FIGURE, turned, 1.0),
                ]
            };
            let mut sign_changes = 0;
            let mut before = fit_at(0);
            for step in 1..=6284 {
                let here = fit_at(step);
                for (before, here) in before.iter().zip(here) {
                    for corner in [FIGURE.min, FIGURE.max] {
                        let at = |fit: &ShadowFit| fit.shadow_clip_from_world.project_point3(corner);
                        let moved = at(before).distance(at(&here));
                        assert!(moved < 3.0 * STEP_RADIANS, "{moved} at step {step}");
                    }
                }
                let z = |fits: &[ShadowFit; 2]| fits[0].shadow_clip_from_world.row(2).z;
                sign_changes += u32::from((z(&before) > 0.0) != (z(&here) > 0.0));
                before = here;
            }
            assert_eq!(sign_changes, 2, "a whole turn passes z = 0 twice");
        }
    }

    #[test]
    fn a_light_straight_above_has_axes() {
        for to_key in [Vec3::Y, Vec3::NEG_Y] {
            let [right, up, forward] = light_axes(to_key);
            assert!(right.cross(up).dot(forward).abs() > 0.999, "{right} {up} {forward}");
        }
    }

    /// 2.4 of the demo's texels, whichever box the animation reaches.
    #[test]
    fn the_books_blur_is_as_wide_in_every_box() {
        let to_key = Vec3::new(-0.57735, 0.57735, -0.57735).normalize();
        for width in [0.1, 1.4, 4.0, 11.0] {
            let half = Vec3::new(width * 0.5, 1.8, width * 0.5);
            let bounds = Aabb { min: -half, max: half };
            let fit = ShadowFit::book(&bounds, to_key, 1.0);
            let edge = fit.radius_texels * fit.texel * DISC_EDGE;
            assert!((edge / 3.6 - 0.011_74).abs() < 1e-4, "{edge} in a box {width} wide");
            assert!(fit.radius_texels >= 0.999 * BOOK_RADIUS_TEXELS, "the texels would show");
            assert_eq!(fit.radius_texels, fit.ground_radius_texels);
        }
        let [small, large] = [1.0, 20.0].map(|unit| {
            let bounds = Aabb {
                min: FIGURE.min * unit,
                max: FIGURE.max * unit,
            };
            ShadowFit::book(&bounds, to_key, unit)
        });
        assert!(
            (large.texel / small.texel - 20.0).abs() < 1e-3 && (large.radius_texels - small.radius_texels).abs() < 1e-3
        );
    }
}
