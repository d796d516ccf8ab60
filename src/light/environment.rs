//! What lights a model: radiance from each direction.

use glam::{Vec3, Vec3A};

use super::cube::{Cube, FACES, resized, smoothstep, solid_angles, texel_direction};
use super::sky_lamp::SkyLamp;
use super::studio_set::{Room, Set};
use crate::image::srgb::{linear_from_srgb, srgb_from_linear};
use crate::image::{Image, ImageKind};
use crate::slices::{Slices, at_once};

/// Texels a side of the smallest environment: a smaller one would have no levels for rough surfaces.
const MIN_SIDE: usize = 16;

/// Texels a side of the largest environment.
const MAX_SIDE: usize = 256;

/// Texels a side of an environment that is filtered in no time: what is shown until the large one is ready.
const FIRST_SIDE: usize = 64;

/// Of a larger cube with mips the largest level up to this side is read. Smaller levels may hold filtered light, as cubes
/// that were made for reflections do.
const MAX_READ_SIDE: u32 = 512;

/// Texels a side of the generated sky.
const DAYLIGHT_SIDE: usize = 64;

/// The sky straight up: sRGB (70, 120, 190).
const ZENITH: Vec3 = Vec3::new(0.061, 0.188, 0.515);
/// Half-way up: sRGB (134, 178, 225).
const SKY: Vec3 = Vec3::new(0.238, 0.445, 0.753);
/// At the horizon: sRGB (222, 232, 240).
const HORIZON: Vec3 = Vec3::new(0.730, 0.807, 0.871);
/// Ground in the distance: sRGB (150, 148, 144).
const FAR_GROUND: Vec3 = Vec3::new(0.305, 0.296, 0.279);
/// Ground below: sRGB (112, 110, 106).
const NEAR_GROUND: Vec3 = Vec3::new(0.162, 0.156, 0.144);

/// The largest radiance of a texel of a file. Infinity would leave nothing of what is averaged with it.
const MAX_RADIANCE: f32 = 1e6;

/// A cube of linear radiance, a power of two from 16 to 256 texels a side.
///
/// Faces are +x, −x, +y, −y, +z, −z, laid out and looked up as in D3D and WebGPU.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    pub(super) cube: Cube,
    /// Of the light that comes from one direction; none of a generated environment.
    lamp: Option<SkyLamp>,
}

impl Environment {
    /// A neutral photo studio, for a viewer who stands at −z and looks along +z, with x to the right and y up, with texels of the largest
    /// cube.
    ///
    /// A soft box overhead in front, a window beside the viewer, a fill on the left, cool strips behind, a warm floor. The direct lights,
    /// of which the key casts shadows, are not in it: [`Room::lights`].
    pub fn studio(room: Room) -> Self {
        at_once(Self::studio_in(room, &Slices::ENDLESS))
    }

    /// The same in slices.
    pub async fn studio_in(room: Room, slices: &Slices) -> Self {
        Self::studio_of(room, MAX_SIDE, slices).await
    }

    /// The same with few texels, which is filtered in no time.
    pub fn coarse_studio(room: Room) -> Self {
        at_once(Self::studio_of(room, FIRST_SIDE, &Slices::ENDLESS))
    }

    async fn studio_of(room: Room, side: usize, slices: &Slices) -> Self {
        let set = Set::new(room, std::f32::consts::FRAC_PI_2 / side as f32);
        let texel = |face, x, y| {
            let direction = texel_direction(side, face, x, y).normalize();
            set.radiance(direction.into()).into()
        };
        Self {
            cube: Cube::from_texels_in(side, texel, slices).await,
            lamp: None,
        }
    }

    /// The same light with few texels, which is filtered in no time.
    #[must_use]
    pub fn coarse(&self) -> Self {
        let mut cube = self.cube.clone();
        while cube.side() > FIRST_SIDE {
            cube = cube.halved();
        }
        Self { cube, lamp: self.lamp }
    }

    /// The lamp of a sky. A sun is no longer in the radiances.
    pub fn lamp(&self) -> Option<&SkyLamp> {
        self.lamp.as_ref()
    }

    /// An outdoor sky without sun: blue above, pale at the horizon, neutral ground. No channel exceeds 1.
    pub fn daylight() -> Self {
        Self::from_fn(DAYLIGHT_SIDE, daylight)
    }

    /// The environment with `radiance(direction)` in each direction of unit length. `side` becomes the next power of two
    /// from 16 to 256.
    pub fn from_fn(side: usize, radiance: impl Fn(Vec3) -> Vec3) -> Self {
        let side = side.clamp(MIN_SIDE, MAX_SIDE).next_power_of_two();
        let radiance = |direction: Vec3A| Vec3A::from(radiance(direction.into()));
        Self {
            cube: Cube::from_directions(side, radiance),
            lamp: None,
        }
    }

    /// The environment that a cube map shows; `None` where the picture is no cube.
    ///
    /// Float formats are taken as linear radiance, the others as sRGB. Larger cubes are averaged in linear light. A sun becomes the lamp.
    pub fn from_image(image: &Image) -> Option<Self> {
        if image.kind() != ImageKind::Cube || image.width() != image.height() {
            return None;
        }
        let level = (0..image.level_count()).find(|&level| image.level_size(level).0 <= MAX_READ_SIDE);
        let level = level.unwrap_or(0);
        let read_side = image.level_size(level).0 as usize;
        let side = read_side.clamp(MIN_SIDE, MAX_SIDE);
        let side = if side.is_power_of_two() {
            side
        } else {
            side.next_power_of_two() / 2
        };
        let face = |face| Some(resized(&linear_texels(image, face, level)?, read_side, side));
        let faces: Vec<Vec<Vec3>> = (0..FACES as u32).map(face).collect::<Option<_>>()?;
        let (cube, lamp) = SkyLamp::of(Cube::from_texels(side, |face, x, y| faces[face][y * side + x].into()));
        Some(Self { cube, lamp })
    }

    /// Texels a side of each face.
    pub fn side(&self) -> usize {
        self.cube.side()
    }

    /// Radiance from a direction of any length but 0; bilinear, and continuous across edges.
    pub fn sample(&self, direction: Vec3) -> Vec3 {
        self.cube.sample(direction.into()).into()
    }

    /// Mean radiance over all directions.
    pub fn average(&self) -> Vec3 {
        let angles = solid_angles(self.side());
        let weighted = self.cube.texels().zip(angles.iter().cycle());
        let sum: Vec3A = weighted.map(|(texel, &steradians)| texel * steradians).sum();
        Vec3::from(sum) / (4.0 * std::f32::consts::PI)
    }

    /// All texels as RGBA half floats, linear, alpha 1: faces one after another, rows from the top.
    pub fn to_rgba16f(&self) -> Vec<u16> {
        self.cube.to_rgba16f()
    }

    /// All texels as RGBA with 8 bits a channel, sRGB, cut at 1, alpha 255: faces one after another, rows from the top.
    pub fn to_rgba8_srgb(&self) -> Vec<u8> {
        let rgba = |texel: Vec3A| {
            let [red, green, blue] = texel.to_array().map(srgb_from_linear);
            [red, green, blue, 255]
        };
        self.cube.texels().flat_map(rgba).collect()
    }
}

/// A plain sky without sun. The direction is of unit length; y is up.
fn daylight(direction: Vec3) -> Vec3 {
    let up = direction.y;
    let low = HORIZON.lerp(SKY, 1.0 - (1.0 - up.clamp(0.0, 1.0)).powi(5));
    let sky = low.lerp(ZENITH, smoothstep(0.1, 1.0, up));
    let ground = FAR_GROUND.lerp(NEAR_GROUND, smoothstep(0.0, -0.7, up));
    ground.lerp(sky, smoothstep(-0.035, 0.015, up))
}

/// A number of a file as radiance: NaN and what is negative become 0.
pub fn sound_radiance(value: f32) -> f32 {
    value.max(0.0)
}

/// One face of a picture as linear light that can be averaged: neither negative nor infinite.
fn linear_texels(image: &Image, face: u32, level: u32) -> Option<Vec<Vec3>> {
    if image.format().is_float() {
        let texels = image.to_rgba32f(face, level)?;
        let sound = |value| sound_radiance(value).min(MAX_RADIANCE);
        let rgb = |&[red, green, blue, _]: &[f32; 4]| Vec3::new(sound(red), sound(green), sound(blue));
        return Some(texels.as_chunks().0.iter().map(rgb).collect());
    }
    let texels = image.to_rgba8(face, level)?;
    let rgb = |&[red, green, blue, _]: &[u8; 4]| Vec3::from([red, green, blue].map(linear_from_srgb));
    Some(texels.as_chunks().0.iter().map(rgb).collect())
}
