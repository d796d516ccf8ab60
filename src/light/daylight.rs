//! An outdoor sky, plain enough to stand behind anything.

use glam::Vec3;

use super::cube::smoothstep;

/// Straight up: sRGB (70, 120, 190).
const ZENITH: Vec3 = Vec3::new(0.061, 0.188, 0.515);
/// Half-way up: sRGB (134, 178, 225).
const SKY: Vec3 = Vec3::new(0.238, 0.445, 0.753);
/// At the horizon: sRGB (222, 232, 240).
const HORIZON: Vec3 = Vec3::new(0.730, 0.807, 0.871);
/// Ground in the distance: sRGB (150, 148, 144).
const FAR_GROUND: Vec3 = Vec3::new(0.305, 0.296, 0.279);
/// Ground below: sRGB (112, 110, 106).
const NEAR_GROUND: Vec3 = Vec3::new(0.162, 0.156, 0.144);

/// Light from a direction of unit length; y is up.
pub(super) fn radiance(direction: Vec3) -> Vec3 {
    let up = direction.y;
    let low = HORIZON.lerp(SKY, 1.0 - (1.0 - up.clamp(0.0, 1.0)).powi(5));
    let sky = low.lerp(ZENITH, smoothstep(0.1, 1.0, up));
    let ground = FAR_GROUND.lerp(NEAR_GROUND, smoothstep(0.0, -0.7, up));
    ground.lerp(sky, smoothstep(-0.035, 0.015, up))
}
