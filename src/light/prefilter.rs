//! The environment as surfaces of each roughness mirror it.

use std::f32::consts::{PI, TAU};

use glam::{Vec3, Vec3A};

use super::cube::{Cube, texel_direction};
use super::low_discrepancy::hammersley;
use super::{Environment, Irradiance};

/// Texels a side of the smallest level, the one for roughness 1.
const LAST_SIDE: usize = 4;

/// Directions that are averaged for each texel of the second level; each level after it, which has a quarter of the texels,
/// takes twice as many. Each stands for a patch of the environment, not for a point of it.
const DIRECTIONS: u32 = 64;

/// An environment ready to light surfaces: blurred copies for mirror light, and irradiance for diffuse light.
///
/// The copies are the first factor of the split sum (Karis 2013), for a viewer in the direction of the normal. Level `l` of
/// `n` is for perceptual roughness `l / (n − 1)`; each has half the side of the one before.
#[derive(Clone, Debug, PartialEq)]
pub struct Prefiltered {
    levels: Vec<Cube>,
    irradiance: Irradiance,
}

impl Prefiltered {
    /// Blurs an environment.
    pub fn of(environment: &Environment) -> Self {
        let sharp = &environment.cube;
        let mut mips = vec![sharp.clone()];
        while let Some(last) = mips.last().filter(|last| last.side() > 1) {
            mips.push(last.halved());
        }
        let level_count = level_count(sharp.side());
        let blurred = (1..level_count).map(|level| {
            let roughness = level as f32 / (level_count - 1) as f32;
            let directions = DIRECTIONS << (level - 1);
            let lobe = lobe(roughness * roughness, directions, sharp.side(), mips.len() - 1);
            let side = sharp.side() >> level;
            Cube::from_texels(side, |face, x, y| {
                gather(&mips, &lobe, texel_direction(side, face, x, y).normalize())
            })
        });
        Self {
            levels: std::iter::once(sharp.clone()).chain(blurred).collect(),
            irradiance: Irradiance::of(environment),
        }
    }

    /// How many levels there are, at least three.
    pub fn level_count(&self) -> u32 {
        self.levels.len() as u32
    }

    /// Texels a side of the first level; each level has half the side of the one before.
    pub fn side(&self) -> u32 {
        self.levels[0].side() as u32
    }

    /// Texels of one level as RGBA half floats: six faces one after another, rows from the top. `None` where there is no
    /// such level.
    pub fn level_rgba16f(&self, level: u32) -> Option<Vec<u16>> {
        self.levels.get(level as usize).map(Cube::to_rgba16f)
    }

    /// Diffuse light from all around.
    pub fn irradiance(&self) -> &Irradiance {
        &self.irradiance
    }

    /// Light from a direction of any length but 0, blurred for a perceptual roughness of 0 to 1: as a GPU filters it
    /// between texels and levels.
    pub fn sample(&self, direction: Vec3, roughness: f32) -> Vec3 {
        let last = self.levels.len() - 1;
        let level = roughness.clamp(0.0, 1.0) * last as f32;
        let lower = (level as usize).min(last);
        let upper = (lower + 1).min(last);
        let direction = Vec3A::from(direction);
        let (sharper, blurrier) = (
            self.levels[lower].sample(direction),
            self.levels[upper].sample(direction),
        );
        sharper.lerp(blurrier, level - lower as f32).into()
    }
}

/// Levels from a side, a power of two, down to [`LAST_SIDE`].
fn level_count(side: usize) -> usize {
    (side / LAST_SIDE).ilog2() as usize + 1
}

/// One direction of a lobe.
struct Tap {
    /// Around +z, unit.
    direction: Vec3A,
    /// All weights of a lobe sum to 1.
    weight: f32,
    /// The level of the mip chain whose texels are about as large as the patch that the tap stands for.
    mip: usize,
}

/// GGX importance sampling of mirrored directions about the normal, with normal, view and mirrored direction the same.
/// `alpha` is above 0, `side` that of the sharpest mip.
fn lobe(alpha: f32, directions: u32, side: usize, last_mip: usize) -> Vec<Tap> {
    let alpha_squared = alpha * alpha;
    let texel_steradians = 4.0 * PI / (6 * side * side) as f32;
    let tap = |index| {
        let (u, v) = hammersley(index, directions);
        let cos_squared = (1.0 - u) / (1.0 + (alpha_squared - 1.0) * u);
        // The half vector's angle to the normal, doubled.
        let cos = 2.0 * cos_squared - 1.0;
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let spread = cos_squared * (alpha_squared - 1.0) + 1.0;
        // D (n·h) / (4 v·h), where v is n.
        let density = alpha_squared / (PI * spread * spread) / 4.0;
        let patch_steradians = 1.0 / (directions as f32 * density);
        // Half a level coarser, so that neighbouring patches overlap (Colbert and Křivánek 2007).
        let mip = 0.5 * (patch_steradians / texel_steradians).log2() + 0.5;
        Tap {
            direction: Vec3A::new(sin * (TAU * v).cos(), sin * (TAU * v).sin(), cos),
            weight: cos,
            mip: (mip.round().max(0.0) as usize).min(last_mip),
        }
    };
    let mut taps: Vec<Tap> = (0..directions).map(tap).filter(|tap| tap.weight > 0.0).collect();
    let sum: f32 = taps.iter().map(|tap| tap.weight).sum();
    taps.iter_mut().for_each(|tap| tap.weight /= sum);
    taps
}

/// The light of a lobe about a direction of unit length.
fn gather(mips: &[Cube], lobe: &[Tap], normal: Vec3A) -> Vec3A {
    let (tangent, bitangent) = normal.any_orthonormal_pair();
    let light = |tap: &Tap| {
        let direction = tangent * tap.direction.x + bitangent * tap.direction.y + normal * tap.direction.z;
        mips[tap.mip].sample(direction) * tap.weight
    };
    lobe.iter().map(light).sum()
}
