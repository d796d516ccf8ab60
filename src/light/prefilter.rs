//! The environment as surfaces of each roughness reflect it, and as matt ones show it.

use std::f32::consts::{PI, TAU};

use glam::{Vec3, Vec3A};

use super::Environment;
use super::brdf_table::hammersley;
use super::cube::{Cube, FACES, solid_angles, texel_direction};
use crate::slices::{Slices, at_once};

/// Levels of each chain. The last, for roughness 1, has a sixteenth of the first one's side.
const LEVEL_COUNT: u32 = 5;

/// Directions that are averaged for each texel of the second level; each level after it, which has a quarter of the texels,
/// takes twice as many. Each stands for a patch of the environment, not for a point of it.
const DIRECTIONS: u32 = 48;

/// Diffuse light is summed up over texels of a cube that has no more a side.
const IRRADIANCE_SIDE: usize = 64;

/// An environment ready to light surfaces: a copy for each roughness for specular light, and irradiance for diffuse light.
///
/// The copies are the first factor of the split sum (Karis 2013), for a viewer in the direction of the normal. Level `l` of
/// `n` is for the perceptual roughness `r` whose `r (2 − r)` is `l / (n − 1)`, as in Filament: most levels are for what is polished, where
/// a blur that is mixed of a sharp and a soft picture would show. Each has half the side of the one before.
#[derive(Clone, Debug, PartialEq)]
pub struct Prefiltered {
    levels: Vec<Cube>,
    irradiance: Irradiance,
}

impl Prefiltered {
    /// Filters an environment.
    pub fn of(environment: &Environment) -> Self {
        at_once(Self::of_in(environment, &Slices::ENDLESS))
    }

    /// The same in slices.
    pub async fn of_in(environment: &Environment, slices: &Slices) -> Self {
        let sharp = &environment.cube;
        let mut mips = vec![sharp.clone()];
        while let Some(last) = mips.last().filter(|last| last.side() > 1) {
            slices.pause().await;
            mips.push(last.halved());
        }
        let mut levels = vec![sharp.clone()];
        for level in 1..LEVEL_COUNT {
            let roughness = roughness_of(level);
            let directions = DIRECTIONS << (level - 1);
            let lobe = lobe(roughness * roughness, directions, sharp.side(), mips.len() - 1);
            let side = sharp.side() >> level;
            let texel = |face, x, y| gather(&mips, &lobe, texel_direction(side, face, x, y).normalize());
            levels.push(Cube::from_texels_in(side, texel, slices).await);
        }
        slices.pause().await;
        let of_diffuse = mips.iter().find(|mip| mip.side() <= IRRADIANCE_SIDE);
        let mut irradiance = Irradiance::of_cube(of_diffuse.unwrap_or(sharp));
        // A soft lamp is still in the radiances: matt surfaces have it from the lamp alone.
        if let Some(lamp) = environment.lamp().filter(|lamp| !lamp.is_sun) {
            irradiance.add(lamp.direction, -lamp.color);
        }
        Self { levels, irradiance }
    }

    /// How many levels there are: five.
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

    /// Diffuse light by normal.
    pub fn irradiance(&self) -> &Irradiance {
        &self.irradiance
    }

    /// Light from a direction of any length but 0, as a surface with a perceptual roughness of 0 to 1 reflects it, filtered as a GPU does
    /// between texels and levels.
    pub fn sample(&self, direction: Vec3, roughness: f32) -> Vec3 {
        let last = self.levels.len() - 1;
        let roughness = roughness.clamp(0.0, 1.0);
        let level = roughness * (2.0 - roughness) * last as f32;
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

/// The perceptual roughness that a level is for.
fn roughness_of(level: u32) -> f32 {
    1.0 - (1.0 - level as f32 / (LEVEL_COUNT - 1) as f32).sqrt()
}

struct Tap {
    /// Around +z, unit.
    direction: Vec3A,
    /// The weights of a lobe sum to 1.
    weight: f32,
    /// The level of the mip chain whose texels are about as large as the patch that the tap stands for.
    mip: usize,
}

/// GGX importance sampling of reflected directions, with the view along the normal. `alpha` is above 0, `side` that of
/// the sharpest mip.
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

/// Normalisation of the spherical harmonics 1; y, z, x; xy, yz, 3z² − 1, xz, x² − y².
const BASIS: [f32; 9] = [
    0.282_095, 0.488_603, 0.488_603, 0.488_603, 1.092_548, 1.092_548, 0.315_392, 1.092_548, 0.546_274,
];

/// What the cosine lobe keeps of each band, divided by π: π, 2π/3, π/4.
const COSINE: [f32; 9] = [1.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 0.25, 0.25, 0.25, 0.25, 0.25];

/// Irradiance by normal, divided by π: what a white Lambert surface shows.
///
/// Spherical harmonics of three bands (Ramamoorthi and Hanrahan 2001), exact to about a hundredth. All constants are in the coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Irradiance {
    coefficients: [Vec3; 9],
}

impl Irradiance {
    /// Of all the light of an environment.
    pub fn of(environment: &Environment) -> Self {
        Self::of_cube(&environment.cube)
    }

    fn of_cube(cube: &Cube) -> Self {
        let side = cube.side();
        let angles = solid_angles(side);
        let mut coefficients = [Vec3A::ZERO; 9];
        for face in 0..FACES {
            for (index, &steradians) in angles.iter().enumerate() {
                let (x, y) = (index % side, index / side);
                let light = cube.texel(face, x, y) * steradians;
                let polynomials = polynomials(texel_direction(side, face, x, y).normalize().into());
                for (coefficient, polynomial) in coefficients.iter_mut().zip(polynomials) {
                    *coefficient += light * polynomial;
                }
            }
        }
        let constant = |index: usize| BASIS[index] * BASIS[index] * COSINE[index];
        Self {
            coefficients: std::array::from_fn(|index| (coefficients[index] * constant(index)).into()),
        }
    }

    /// Adds light from one direction of unit length; `color` is what a white surface that faces it shows of it.
    fn add(&mut self, direction: Vec3, color: Vec3) {
        for (index, polynomial) in polynomials(direction).into_iter().enumerate() {
            self.coefficients[index] += color * (PI * polynomial * BASIS[index] * BASIS[index] * COSINE[index]);
        }
    }

    /// For a surface with this normal of unit length; never negative.
    pub fn towards(&self, normal: Vec3) -> Vec3 {
        let terms = self.coefficients.iter().zip(polynomials(normal));
        let sum: Vec3 = terms.map(|(coefficient, polynomial)| coefficient * polynomial).sum();
        sum.max(Vec3::ZERO)
    }

    /// The coefficients as the uniform block has them; the fourth numbers are 0.
    pub fn to_uniform(&self) -> [[f32; 4]; 9] {
        self.coefficients.map(|coefficient| coefficient.extend(0.0).to_array())
    }
}

/// The polynomials of the three bands, without their constants.
fn polynomials(Vec3 { x, y, z }: Vec3) -> [f32; 9] {
    [1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y]
}
