//! How much of the environment's light a surface reflects: the second factor of the split sum (Karis 2013).

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use crate::image::half;

/// Entries along each edge of the table that the renderer uploads.
pub const BRDF_TABLE_SIDE: usize = 64;

/// Half vectors that are averaged for each entry.
const HALF_VECTORS: u32 = 128;

/// The table with its lookup.
#[derive(Clone, Debug, PartialEq)]
pub struct BrdfTable {
    side: usize,
    entries: Vec<[f32; 2]>,
}

impl BrdfTable {
    /// Computes [`brdf_table`]; `side` is raised to 2 where it is less.
    pub fn new(side: usize) -> Self {
        let side = side.max(2);
        Self {
            side,
            entries: brdf_table(side),
        }
    }

    /// Entries in a row, and rows.
    pub fn side(&self) -> usize {
        self.side
    }

    /// The entries, row by row, as pairs of half floats: what a GPU takes as `Rg16Float`.
    pub fn to_rg16f(&self) -> Vec<u16> {
        self.entries
            .iter()
            .flatten()
            .map(|&value| half::from_f32(value))
            .collect()
    }

    /// Scale and bias between the entries, as `brdf_lookup` in `environment.wgsl` has them.
    pub fn lookup(&self, n_dot_v: f32, roughness: f32) -> Vec2 {
        let last = self.side - 1;
        let place = |value: f32| {
            let place = value.clamp(0.0, 1.0) * last as f32;
            let first = (place as usize).min(last - 1);
            (first, place - first as f32)
        };
        let ((column, right), (row, below)) = (place(n_dot_v.max(0.0).sqrt()), place(roughness));
        let entry = |row: usize, column: usize| Vec2::from(self.entries[row * self.side + column]);
        let upper = entry(row, column).lerp(entry(row, column + 1), right);
        let lower = entry(row + 1, column).lerp(entry(row + 1, column + 1), right);
        upper.lerp(lower, below)
    }
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
