//! Blurred copies and irradiance, against brute force.

use std::f32::consts::PI;

use bindpose::light::{Environment, Prefiltered, Room};
use glam::Vec3;

use crate::light::{all_directions, difference};

/// Enough that the error of summing over points is a few thousandths for the lobes here.
const POINTS: usize = 40_000;

/// Mean of the cosine-weighted light of a hemisphere: irradiance over π.
fn irradiance(environment: &Environment, normal: Vec3) -> Vec3 {
    let light = |d: Vec3| environment.sample(d) * d.dot(normal).max(0.0);
    let sum: Vec3 = all_directions(POINTS).map(light).sum();
    sum * (4.0 * PI / POINTS as f32) / PI
}

/// The split sum's definition: GGX about half vectors for a viewer in the direction of the normal.
fn mirror_light(environment: &Environment, normal: Vec3, alpha: f32) -> Vec3 {
    let (mut sum, mut weights) = (Vec3::ZERO, 0.0);
    for light in all_directions(POINTS) {
        let n_dot_l = light.dot(normal);
        if n_dot_l > 0.0 {
            let cos_squared = (1.0 + n_dot_l) / 2.0;
            // Density of light directions times their weight n·l; D's constants cancel.
            let weight = n_dot_l / (cos_squared * (alpha * alpha - 1.0) + 1.0).powi(2);
            sum += environment.sample(light) * weight;
            weights += weight;
        }
    }
    sum / weights
}

#[test]
fn even_light_stays_as_it_is() {
    let light = Vec3::new(1.0, 0.5, 0.25);
    let prefiltered = Prefiltered::of(&Environment::from_fn(32, |_| light));
    for direction in all_directions(50) {
        for roughness in [0.0, 0.1, 0.5, 0.77, 1.0] {
            let found = prefiltered.sample(direction, roughness);
            assert!(difference(found, light) < 1e-5, "{direction}, {roughness}: {found}");
        }
        let found = prefiltered.irradiance().towards(direction);
        assert!(difference(found, light) < 1e-4, "{direction}: {found}");
    }
}

#[test]
fn a_mirror_shows_the_environment() {
    let studio = Environment::coarse_studio(Room::Dark);
    let prefiltered = Prefiltered::of(&studio);
    for direction in all_directions(500) {
        assert_eq!(prefiltered.sample(direction, 0.0), studio.sample(direction));
    }
}

#[test]
fn levels_halve_down_to_a_sixteenth() {
    for side in [16, 64, 256] {
        let prefiltered = Prefiltered::of(&Environment::from_fn(side, |_| Vec3::ONE));
        assert_eq!((prefiltered.side(), prefiltered.level_count()), (side as u32, 5));
        for level in 0..5 {
            let texels = prefiltered.level_rgba16f(level).expect("it is there").len() / 4;
            assert_eq!(texels, 6 * (side >> level) * (side >> level));
        }
        assert_eq!(prefiltered.level_rgba16f(5), None);
    }
}

/// Irradiance over π of a gradient `a + b y` is `a + 2/3 b y`: exact in spherical harmonics.
#[test]
fn irradiance_of_gradients_is_exact() {
    let environment = Environment::from_fn(32, |d| Vec3::new(1.0 + d.y, 1.0 - 0.5 * d.x, 2.0 + d.z));
    let prefiltered = Prefiltered::of(&environment);
    for normal in all_directions(60) {
        let exact = Vec3::new(
            1.0 + 2.0 / 3.0 * normal.y,
            1.0 - normal.x / 3.0,
            2.0 + 2.0 / 3.0 * normal.z,
        );
        let found = prefiltered.irradiance().towards(normal);
        assert!(difference(found, exact) < 2e-3, "{normal}: {found} for {exact}");
        let brute = irradiance(&environment, normal);
        assert!(difference(found, brute) < 5e-3, "{normal}: {found} for {brute}");
    }
}

/// Three bands leave out what the cosine lobe keeps of the fifth and on: a few hundredths of lights as broad as these.
#[test]
fn irradiance_of_the_studio_is_near_brute_force() {
    let studio = Environment::coarse_studio(Room::Dark);
    let prefiltered = Prefiltered::of(&studio);
    for normal in all_directions(60) {
        let (found, brute) = (prefiltered.irradiance().towards(normal), irradiance(&studio, normal));
        assert!(difference(found, brute) < 0.03, "{normal}: {found} for {brute}");
    }
}

#[test]
fn blurred_levels_are_near_brute_force() {
    let studio = Environment::coarse_studio(Room::Dark);
    let prefiltered = Prefiltered::of(&studio);
    let last = (prefiltered.level_count() - 1) as f32;
    // At level 1 the lobe is narrower than what the brute force can sum.
    for level in [2.0, 3.0, 4.0] {
        let roughness = 1.0 - (1.0 - level / last).sqrt();
        let (mut sum, mut worst) = (0.0, 0.0f32);
        for normal in all_directions(80) {
            let brute = mirror_light(&studio, normal, roughness * roughness);
            let error = difference(prefiltered.sample(normal, roughness), brute);
            sum += error / 80.0;
            worst = worst.max(error);
        }
        assert!(
            sum < 0.02 && worst < 0.12,
            "roughness {roughness}: mean {sum}, worst {worst}"
        );
    }
}

#[test]
fn rougher_is_never_sharper() {
    let prefiltered = Prefiltered::of(&Environment::coarse_studio(Room::Dark));
    let contrast = |roughness: f32| {
        let light = || all_directions(2_000).map(|d| prefiltered.sample(d, roughness).y);
        light().fold(0.0, f32::max) - light().fold(f32::MAX, f32::min)
    };
    let contrasts: Vec<f32> = (0..=8).map(|step| contrast(step as f32 / 8.0)).collect();
    assert!(
        contrasts.is_sorted_by(|sharper, rougher| rougher <= sharper),
        "{contrasts:?}"
    );
    assert!(contrasts[8] < 0.6 * contrasts[0], "{contrasts:?}");
}
