//! Light that falls on a surface from all around, as nine numbers a channel.

use glam::{Vec3, Vec3A};

use super::Environment;
use super::cube::{FACES, solid_angles, texel_direction};

/// Normalisation of the spherical harmonics 1; y, z, x; xy, yz, 3z² − 1, xz, x² − y².
const BASIS: [f32; 9] = [
    0.282_095, 0.488_603, 0.488_603, 0.488_603, 1.092_548, 1.092_548, 0.315_392, 1.092_548, 0.546_274,
];

/// What the cosine lobe keeps of each band, divided by π: π, 2π/3, π/4.
const COSINE: [f32; 9] = [1.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 0.25, 0.25, 0.25, 0.25, 0.25];

/// Irradiance by normal, divided by π: what a white Lambert surface shows.
///
/// Spherical harmonics of three bands (Ramamoorthi and Hanrahan 2001), exact to about a hundredth for light from all around.
/// All constants are in the coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Irradiance {
    coefficients: [Vec3; 9],
}

impl Irradiance {
    /// Of all the light of an environment.
    pub fn of(environment: &Environment) -> Self {
        let cube = &environment.cube;
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
