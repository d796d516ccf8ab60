//! The light of the books' demos, by its twin.

use glam::Vec3;

use crate::twins::book::{
    BookSurface, PhongSurface, blinn_phong, book_light, book_reflectance, phong, phong_light, schlick_fresnel,
};

fn assert_near(found: Vec3, expected: [f32; 3]) {
    assert!(
        found.abs_diff_eq(Vec3::from(expected), 1e-4),
        "{found} for {expected:?}"
    );
}

/// Faces the viewer.
fn surface() -> BookSurface {
    BookSurface {
        albedo: Vec3::new(0.5, 0.4, 0.2),
        fresnel0: Vec3::splat(0.1),
        shininess: 0.5,
        normal: Vec3::Y,
        to_eye: Vec3::Y,
    }
}

fn phong_surface() -> PhongSurface {
    PhongSurface {
        texel: Vec3::new(1.0, 0.5, 0.5),
        ambient: Vec3::splat(0.8),
        diffuse: Vec3::splat(0.5),
        specular: Vec3::new(0.1, 0.2, 0.3),
        power: 2.0,
        normal: Vec3::Y,
        to_eye: Vec3::Y,
    }
}

/// A light that meets the normal at this cosine.
fn slanted(cos_angle: f32) -> Vec3 {
    Vec3::new((1.0 - cos_angle * cos_angle).sqrt(), cos_angle, 0.0)
}

#[test]
fn surfaces_mirror_all_where_they_are_grazed() {
    let fresnel0 = Vec3::new(0.02, 0.1, 0.9);
    assert_near(schlick_fresnel(fresnel0, 1.0), [0.02, 0.1, 0.9]);
    assert_near(schlick_fresnel(fresnel0, -0.3), [1.0; 3]);
    // 0.5⁵ = 1/32.
    assert_near(
        schlick_fresnel(fresnel0, 0.5),
        [0.02 + 0.98 / 32.0, 0.1 + 0.9 / 32.0, 0.9 + 0.1 / 32.0],
    );
}

/// Straight above, power 128: lobe 136/8 = 17, specular 1.7, of which 1.7 / 2.7 is kept.
#[test]
fn a_light_behind_the_viewer_shows_the_peak_of_the_lobe() {
    let kept = 1.7 / 2.7;
    let found = blinn_phong(&surface(), Vec3::Y, Vec3::new(1.0, 0.5, 1.0));
    assert_near(found, [0.5 + kept, (0.4 + kept) * 0.5, 0.2 + kept]);
}

/// 60° aside with shininess 0: the lobe is 1 everywhere, and the half vector stands 30° off both.
#[test]
fn a_dull_surface_mirrors_its_fresnel_share_alone() {
    let dull = BookSurface {
        shininess: 0.0,
        ..surface()
    };
    let fresnel = 0.1 + 0.9 * (1.0 - 0.75_f32.sqrt()).powi(5);
    let kept = fresnel / (fresnel + 1.0);
    assert_near(
        blinn_phong(&dull, slanted(0.5), Vec3::ONE),
        [(0.5 + kept) * 0.5, (0.4 + kept) * 0.5, (0.2 + kept) * 0.5],
    );
    assert_eq!(book_reflectance(&dull, Vec3::Y), Vec3::ZERO);
}

#[test]
fn lights_below_the_surface_give_nothing() {
    assert_eq!(blinn_phong(&surface(), slanted(-0.2), Vec3::ONE), Vec3::ZERO);
    assert_eq!(phong(&phong_surface(), slanted(-0.2), Vec3::ONE), Vec3::ZERO);
}

/// All three lights below, so that only what comes from everywhere is left, a half of it.
#[test]
fn occlusion_dims_only_what_comes_from_everywhere() {
    let below = [Vec3::NEG_Y; 3];
    assert_near(book_light(&surface(), below, 1.0, 0.5), [0.0625, 0.05, 0.035]);
    assert_near(phong_light(&phong_surface(), below, 1.0, 0.5), [0.1, 0.05, 0.07]);
    let lit = [Vec3::Y; 3];
    let [open, closed] = [1.0, 0.0].map(|occlusion| book_light(&surface(), lit, 1.0, occlusion));
    assert_near(open - closed, [0.125, 0.1, 0.07]);
}

/// The second and third light cast no shadows: 0.6 of the 1.5 of the first channel are left.
#[test]
fn shadow_takes_the_first_light_alone() {
    let [lit, shadowed] = [1.0, 0.0].map(|visible| book_light(&surface(), [Vec3::Y; 3], visible, 0.0));
    assert!((shadowed.x / lit.x - 0.6 / 1.5).abs() < 1e-5, "{shadowed} of {lit}");
    let [lit, shadowed] = [1.0, 0.0].map(|visible| phong_light(&phong_surface(), [Vec3::Y; 3], visible, 0.0));
    assert!((shadowed.z / lit.z - 0.6 / 1.3).abs() < 1e-5, "{shadowed} of {lit}");
}

/// 60° aside the mirrored light passes the eye at 60°: 0.5² of the specular colour, and the cosine 0.5 of the diffuse.
#[test]
fn phong_adds_the_mirrored_light_at_its_power() {
    let found = phong(&phong_surface(), slanted(0.5), Vec3::new(1.0, 1.0, 2.0));
    assert_near(found, [0.25 + 0.025, 0.125 + 0.05, 2.0 * (0.125 + 0.075)]);
}

/// Half of it is rough, and so is half the mirror; grazed, all that is smooth mirrors.
#[test]
fn reflectance_is_fresnel_times_shininess() {
    assert_near(book_reflectance(&surface(), Vec3::Y), [0.05; 3]);
    assert_near(book_reflectance(&surface(), Vec3::X), [0.5; 3]);
}
