//! How much of the environment's light a surface reflects, the second factor of the split sum (Karis 2013), and how much of the
//! lamp is in what it mirrors.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use crate::image::half;

/// Entries along each edge of the table that the renderer uploads.
pub const BRDF_TABLE_SIDE: usize = 64;

/// Half vectors that are averaged for each entry.
const HALF_VECTORS: u32 = 128;
/// Circles about the middle of a lobe over which it is summed up.
const RINGS: u32 = 24;

/// Angle between the middle and the edge of the lamp, the disc that is the key light, as surfaces see it: 9°.
pub const LAMP_RADIUS_RADIANS: f32 = PI / 20.0;

/// The table with its lookups.
#[derive(Clone, Debug, PartialEq)]
pub struct BrdfTable {
    side: usize,
    entries: Vec<[f32; 2]>,
    /// As many, of [`lamp_share`]: roughness as in `entries`, columns by the root of the sine of half the angle.
    lamp: Vec<f32>,
}

impl BrdfTable {
    /// Computes [`brdf_table`]; `side` is raised to 2 where it is less.
    pub fn new(side: usize) -> Self {
        let side = side.max(2);
        Self {
            side,
            entries: brdf_table(side),
            lamp: lamp_table(side),
        }
    }

    /// Entries in a row, and rows.
    pub fn side(&self) -> usize {
        self.side
    }

    /// The entries, row by row, as half floats: what a GPU takes as `Rgba16Float`. Scale, bias, the lamp, nothing.
    pub fn to_rgba16f(&self) -> Vec<u16> {
        let texels = self.entries.iter().zip(&self.lamp);
        texels
            .flat_map(|(&[scale, bias], &lamp)| [scale, bias, lamp, 0.0])
            .map(half::from_f32)
            .collect()
    }

    /// Scale and bias between the entries, as `brdf_lookup` in `environment.wgsl` has them.
    pub fn lookup(&self, n_dot_v: f32, roughness: f32) -> Vec2 {
        self.between(n_dot_v.max(0.0).sqrt(), roughness, |index| {
            Vec2::from(self.entries[index])
        })
    }

    /// How much of a lobe the lamp fills, between the entries, as `lamp_lookup` in `environment.wgsl` has it. Both directions are of unit
    /// length.
    pub fn lamp_lookup(&self, mirrored: Vec3, to_lamp: Vec3, roughness: f32) -> f32 {
        let sine_of_half = 0.5 * mirrored.distance(to_lamp);
        self.between(sine_of_half.sqrt(), roughness, |index| Vec2::splat(self.lamp[index]))
            .x
    }

    fn between(&self, across: f32, down: f32, entry: impl Fn(usize) -> Vec2) -> Vec2 {
        let last = self.side - 1;
        let place = |value: f32| {
            let place = value.clamp(0.0, 1.0) * last as f32;
            let first = (place as usize).min(last - 1);
            (first, place - first as f32)
        };
        let ((column, right), (row, below)) = (place(across), place(down));
        let entry = |row: usize, column: usize| entry(row * self.side + column);
        let upper = entry(row, column).lerp(entry(row, column + 1), right);
        let lower = entry(row + 1, column).lerp(entry(row + 1, column + 1), right);
        upper.lerp(lower, below)
    }
}

/// The entries of [`lamp_share`]: column `c` is for the angle whose half has the sine `(c / (side − 1))²`, since the lamp's edge wants the
/// finest steps; row `r` for perceptual roughness `r / (side − 1)`.
fn lamp_table(side: usize) -> Vec<f32> {
    let value = |index: usize| index as f32 / side.saturating_sub(1).max(1) as f32;
    (0..side * side)
        .map(|index| lamp_share(2.0 * value(index % side).powi(2).asin(), value(index / side)))
        .collect()
}

/// The fraction of the directions in which a surface of this roughness mirrors, for a viewer in the direction of the normal, that a lamp
/// fills whose middle is so far from the normal, radians: of the lobe with which environments are filtered.
fn lamp_share(angle: f32, roughness: f32) -> f32 {
    let alpha_squared = (roughness * roughness).max(1e-4).powi(2);
    // Half vectors up to half an angle from the normal, as a fraction of all.
    let up_to = |angle: f32| {
        let sin_squared = (0.5 * angle).sin().powi(2);
        sin_squared / (alpha_squared + (1.0 - alpha_squared) * sin_squared)
    };
    let weight = |cosine: f32| cosine.max(0.0);
    let cosine_at = |u: f32| {
        let sin_squared = u * alpha_squared / (1.0 - u * (1.0 - alpha_squared));
        1.0 - 2.0 * sin_squared
    };
    let between = |from: f32, to: f32, value: &dyn Fn(f32) -> f32| {
        let step = (to - from) / RINGS as f32;
        (0..RINGS)
            .map(|ring| value(cosine_at(from + (ring as f32 + 0.5) * step)))
            .sum::<f32>()
            * step
    };
    let (sine, cosine) = angle.sin_cos();
    // The part of a circle about the normal that lies within the lamp, by the spherical law of cosines.
    let part = |ring: f32| {
        let ring_sine = (1.0 - ring * ring).max(0.0).sqrt();
        let turn = (LAMP_RADIUS_RADIANS.cos() - cosine * ring) / (sine * ring_sine).max(1e-9);
        weight(ring) * turn.clamp(-1.0, 1.0).acos() / PI
    };
    let (near, far) = (
        (angle - LAMP_RADIUS_RADIANS).max(0.0),
        (angle + LAMP_RADIUS_RADIANS).min(PI),
    );
    let inside = (LAMP_RADIUS_RADIANS - angle).max(0.0);
    let filled = between(0.0, up_to(inside), &part) + between(up_to(near.max(inside)), up_to(far), &part);
    filled / between(0.0, 1.0, &weight)
}

/// Scale and bias by which `fresnel0` and `fresnel90` become the fraction of the environment's light that the GGX lobe with
/// height-correlated Smith shadowing reflects in one bounce.
///
/// Entry `column + side * row` is for n·v = `(column / (side − 1))²`, since values change most at grazing angles, and
/// for perceptual roughness `row / (side − 1)`.
pub fn brdf_table(side: usize) -> Vec<[f32; 2]> {
    let value = |index: usize| index as f32 / side.saturating_sub(1).max(1) as f32;
    (0..side * side)
        .map(|index| entry(value(index % side).powi(2), value(index / side)))
        .collect()
}

fn entry(n_dot_v: f32, roughness: f32) -> [f32; 2] {
    // At exactly 0 all half vectors would be equal.
    let alpha = (roughness * roughness).max(1e-4);
    let cos = n_dot_v.max(1e-3);
    let to_eye = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
    let mut sum = Vec2::ZERO;
    for index in 0..HALF_VECTORS {
        let halfway = visible_normal(to_eye, alpha, hammersley(index, HALF_VECTORS));
        let v_dot_h = to_eye.dot(halfway);
        let n_dot_l = 2.0 * v_dot_h * halfway.z - cos;
        if n_dot_l > 0.0 {
            let (eye, light) = (smith_lambda(cos, alpha), smith_lambda(n_dot_l, alpha));
            // Sampling visible normals accounts for the masking towards the eye, G1; G2 / G1 is left.
            let unshadowed = (1.0 + eye) / (1.0 + eye + light);
            let grazing = (1.0 - v_dot_h).clamp(0.0, 1.0).powi(5);
            sum += Vec2::new(1.0 - grazing, grazing) * unshadowed;
        }
    }
    (sum / HALF_VECTORS as f32).to_array()
}

/// Smith's Λ for GGX.
fn smith_lambda(cos: f32, alpha: f32) -> f32 {
    let tan_squared = (1.0 - cos * cos).max(0.0) / (cos * cos);
    0.5 * ((1.0 + alpha * alpha * tan_squared).sqrt() - 1.0)
}

/// A normal of the micro-surface as seen from `to_eye`, by spherical caps (Dupuy and Benyoub 2023); +z is the surface's.
fn visible_normal(to_eye: Vec3, alpha: f32, (u, v): (f32, f32)) -> Vec3 {
    let stretched = (to_eye * Vec3::new(alpha, alpha, 1.0)).normalize();
    let z = (1.0 - u) * (1.0 + stretched.z) - stretched.z;
    let radius = (1.0 - z * z).max(0.0).sqrt();
    let halfway = Vec3::new(radius * (TAU * v).cos(), radius * (TAU * v).sin(), z) + stretched;
    (halfway * Vec3::new(alpha, alpha, 1.0)).normalize_or(Vec3::Z)
}

/// Point `index` of `count` of the Hammersley set, 0 … 1 both ways, the first coordinate in the middle of its stratum.
pub(super) fn hammersley(index: u32, count: u32) -> (f32, f32) {
    // The radical inverse in base 2; 24 bits are exact in f32.
    let inverse = (index.reverse_bits() >> 8) as f32 / (1u32 << 24) as f32;
    ((index as f32 + 0.5) / count as f32, inverse)
}
