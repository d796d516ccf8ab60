//! The lamp of a sky: its sun or, without one, the brightest part of it. It casts the shadow.

use std::f32::consts::PI;

use glam::{Vec3, Vec3A};

use super::cube::{Cube, FACES, solid_angles, texel_direction};

/// Radiance from which on a texel is a lamp, and not a part of the sky.
const LAMP_RADIANCE: f32 = 256.0;
/// The same in medians of the sky.
const LAMP_MEDIANS: f32 = 50.0;
/// All that is brighter within so many degrees of it than the sky around is the lamp's.
const LAMP_DEGREES: f32 = 10.0;
/// The sky around ends so many degrees from it.
const AROUND_DEGREES: f32 = 13.0;
/// A sky without such a texel has its brightest hundredth as a soft lamp, as far as that lies within so many degrees.
const SOFT_DEGREES: f32 = 45.0;

/// The light of a sky that comes from one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyLamp {
    /// Towards it in the axes of the environment; of unit length.
    pub direction: Vec3,
    /// What a white surface that faces it shows of it.
    pub color: Vec3,
    /// The fraction of the light on level ground that is its own.
    pub ground_share: f32,
    /// Whether it was taken out of what surfaces mirror: it is a sun. Soft lamps are still seen there.
    pub is_sun: bool,
}

struct Texel {
    direction: Vec3A,
    steradians: f32,
    light: Vec3A,
}

impl SkyLamp {
    /// The lamp of a sky, and the sky without its sun, where nothing is brighter than [`LAMP_RADIANCE`]. None of a sky of one colour.
    pub(super) fn of(cube: Cube) -> (Cube, Option<Self>) {
        let side = cube.side();
        let angles = solid_angles(side);
        let places = (0..FACES).flat_map(|face| (0..side * side).map(move |index| (face, index % side, index / side)));
        let texels: Vec<Texel> = places
            .map(|(face, x, y)| Texel {
                direction: texel_direction(side, face, x, y).normalize(),
                steradians: angles[y * side + x],
                light: cube.texel(face, x, y),
            })
            .collect();
        let mut lights: Vec<f32> = texels.iter().map(|texel| luminance(texel.light)).collect();
        let brightest = lights
            .iter()
            .enumerate()
            .max_by(|a, b| a.1.total_cmp(b.1))
            .map(|(index, &light)| (texels[index].direction, light));
        let Some((towards, peak)) = brightest else {
            return (cube, None);
        };
        let mut least_of_share = |share: usize| {
            let index = (lights.len() * share / 100).min(lights.len() - 1);
            *lights.select_nth_unstable_by(index, f32::total_cmp).1
        };
        let (median, of_hundredth) = (least_of_share(50), least_of_share(99));
        let within = |towards: Vec3A, degrees: f32| {
            let least = degrees.to_radians().cos();
            move |texel: &&Texel| texel.direction.dot(towards) > least
        };
        if peak <= LAMP_RADIANCE && peak <= LAMP_MEDIANS * median {
            let bright = texels
                .iter()
                .filter(within(towards, SOFT_DEGREES))
                .filter(|texel| luminance(texel.light) >= of_hundredth);
            let brighter = |texel: &Texel| texel.light * (1.0 - median / luminance(texel.light)).max(0.0);
            let lamp = Self::sum(bright, brighter, false);
            return (cube, lamp.map(|lamp| lamp.on_ground(&texels)));
        }
        // Its middle, from the brightest texel and then from what that found.
        let middle = |towards: Vec3A| {
            Self::sum(
                texels.iter().filter(within(towards, LAMP_DEGREES)),
                |texel| texel.light,
                true,
            )
        };
        let towards = middle(towards).map_or(towards, |lamp| lamp.direction.into());
        let around = texels
            .iter()
            .filter(within(towards, AROUND_DEGREES))
            .filter(|texel| texel.direction.dot(towards) <= LAMP_DEGREES.to_radians().cos());
        let (light, steradians) = around.fold((Vec3A::ZERO, 0.0), |(light, steradians), texel| {
            (light + texel.light * texel.steradians, steradians + texel.steradians)
        });
        let around = light / f32::max(steradians, f32::MIN_POSITIVE);
        let brighter = |texel: &Texel| (texel.light - around).max(Vec3A::ZERO);
        let lamp = Self::sum(texels.iter().filter(within(towards, LAMP_DEGREES)), brighter, true);
        let without = |face: usize, x: usize, y: usize| {
            let texel = &texels[(face * side + y) * side + x];
            let is_lamp = within(towards, LAMP_DEGREES)(&texel);
            let most = if is_lamp { around } else { Vec3A::INFINITY };
            texel.light.min(most).min(Vec3A::splat(LAMP_RADIANCE))
        };
        (
            Cube::from_texels(side, without),
            lamp.map(|lamp| lamp.on_ground(&texels)),
        )
    }

    /// Of some texels together what `brighter` says of each: by how much it is brighter than the sky. None where nothing is.
    fn sum<'a>(
        texels: impl Iterator<Item = &'a Texel>,
        brighter: impl Fn(&Texel) -> Vec3A,
        is_sun: bool,
    ) -> Option<Self> {
        let (mut light, mut towards) = (Vec3A::ZERO, Vec3A::ZERO);
        for texel in texels {
            let more = brighter(texel) * texel.steradians;
            light += more;
            towards += texel.direction * luminance(more);
        }
        let direction = towards.try_normalize()?;
        Some(Self {
            direction: direction.into(),
            color: (light / PI).into(),
            ground_share: 0.0,
            is_sun,
        })
    }

    /// The same with its share of the ground's light. `texels` are those of the whole sky.
    fn on_ground(self, texels: &[Texel]) -> Self {
        let of_texel = |texel: &Texel| luminance(texel.light) * texel.direction.y.max(0.0) * texel.steradians / PI;
        let whole: f32 = texels.iter().map(of_texel).sum();
        let own = luminance(self.color.into()) * self.direction.y.max(0.0);
        Self {
            ground_share: own / whole.max(own).max(f32::MIN_POSITIVE),
            ..self
        }
    }
}

/// Relative luminance of linear sRGB.
fn luminance(light: Vec3A) -> f32 {
    light.dot(Vec3A::new(0.2126, 0.7152, 0.0722))
}
