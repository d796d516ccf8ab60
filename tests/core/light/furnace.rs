//! White surfaces in a white room vanish: none gives back more or less light than it gets.

use std::f32::consts::{PI, TAU};

use bindpose::light::{BRDF_TABLE_SIDE, BrdfTable, Environment, LAMP_RADIUS_RADIANS, Prefiltered};
use glam::{Vec2, Vec3};

use crate::light::all_directions;
use crate::twins::pbr::{ggx_distribution, reflectance, sheen_albedo, sheen_lobe, specular_lobe};
use crate::twins::studio::{EnvironmentLight, StudioLights, StudioSurface};

const ANGLES: [f32; 9] = [0.01, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 1.0];
const ROUGHNESSES: [f32; 7] = [0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0];

fn to_eye(n_dot_v: f32) -> Vec3 {
    Vec3::new((1.0 - n_dot_v * n_dot_v).sqrt(), 0.0, n_dot_v)
}

/// Without direct lights, or with what is given.
fn dark() -> StudioLights {
    StudioLights {
        to_key: Vec3::Z,
        key_color: Vec3::ZERO,
        key_visible: 1.0,
        key_mirrored: 1.0,
        to_rim: Vec3::Z,
        rim_color: Vec3::ZERO,
    }
}

#[test]
fn a_white_surface_vanishes_in_a_white_room() {
    let prefiltered = Prefiltered::of(&Environment::from_fn(16, |_| Vec3::ONE));
    let brdf_table = BrdfTable::new(BRDF_TABLE_SIDE);
    let room = EnvironmentLight {
        prefiltered: &prefiltered,
        brdf_table: &brdf_table,
        turn: (0.6, 0.8),
        intensity: 1.0,
    };
    for n_dot_v in ANGLES {
        for roughness in ROUGHNESSES {
            for fresnel0 in [0.0, 0.04, 0.3, 0.9, 1.0] {
                let surface = StudioSurface {
                    albedo: Vec3::ONE,
                    fresnel0: Vec3::splat(fresnel0),
                    roughness,
                    normal: Vec3::Z,
                    smooth_normal: Vec3::Z,
                    to_eye: to_eye(n_dot_v),
                    ..StudioSurface::default()
                };
                let found = room.studio_light(&surface, &dark());
                let error = (found - Vec3::ONE).abs().max_element();
                assert!(
                    error < 0.02,
                    "n·v {n_dot_v}, roughness {roughness}, F0 {fresnel0}: {found}"
                );
            }
        }
    }
}

/// What a coat or a sheen gives back is missing beneath it.
#[test]
fn a_white_surface_under_layers_vanishes_too() {
    let prefiltered = Prefiltered::of(&Environment::from_fn(16, |_| Vec3::ONE));
    let brdf_table = BrdfTable::new(BRDF_TABLE_SIDE);
    let room = EnvironmentLight {
        prefiltered: &prefiltered,
        brdf_table: &brdf_table,
        turn: (0.6, 0.8),
        intensity: 1.0,
    };
    for n_dot_v in ANGLES {
        for roughness in ROUGHNESSES {
            for (sheen, coat) in [(0.0, 0.5), (0.0, 1.0), (0.5, 0.0), (1.0, 0.0), (1.0, 1.0)] {
                let surface = StudioSurface {
                    fresnel0: Vec3::splat(0.04),
                    roughness: 1.05 - roughness,
                    normal: Vec3::Z,
                    smooth_normal: Vec3::Z,
                    to_eye: to_eye(n_dot_v),
                    sheen: Vec3::splat(sheen),
                    sheen_roughness: roughness.max(0.2),
                    coat,
                    coat_roughness: roughness,
                    ..StudioSurface::default()
                };
                let case = format!("n·v {n_dot_v}, roughness {roughness}, sheen {sheen}, coat {coat}");
                let found = room.studio_light(&surface, &dark());
                assert!((found - Vec3::ONE).abs().max_element() < 0.02, "{case}: {found}");
                // A coloured sheen takes away as much in all channels as it gives in its brightest.
                let red = StudioSurface {
                    sheen: Vec3::new(sheen, 0.0, 0.0),
                    ..surface
                };
                let found = room.studio_light(&red, &dark());
                assert!(found.max_element() < 1.02 && found.y <= found.x, "{case}: {found}");
                // Black, it gives back what it keeps out.
                let black = StudioSurface {
                    albedo: Vec3::ZERO,
                    ..surface
                };
                let given = room.studio_radiance(&black, &dark());
                assert!((given.mirrored.x - given.kept_out).abs() < 0.02, "{case}: {given:?}");
            }
        }
    }
}

/// Brute force: the lobe times n·l over all directions, crowded where the light grazes.
#[test]
fn the_fit_is_what_a_sheen_gives_back() {
    const RINGS: usize = 200;
    const SPOKES: usize = 200;
    for n_dot_v in ANGLES {
        for roughness in [0.2f32, 0.3, 0.45, 0.6, 0.8, 1.0] {
            let mut sum = 0.0;
            for ring in 0..RINGS {
                let t = (ring as f32 + 0.5) / RINGS as f32;
                let (n_dot_l, per_ring) = (t * t, 2.0 * t / RINGS as f32);
                for spoke in 0..SPOKES {
                    let turn = TAU * (spoke as f32 + 0.5) / SPOKES as f32;
                    let sine = (1.0 - n_dot_l * n_dot_l).sqrt();
                    let to_light = Vec3::new(sine * turn.cos(), sine * turn.sin(), n_dot_l);
                    let n_dot_h = (to_light + to_eye(n_dot_v)).normalize().z;
                    sum += sheen_lobe(n_dot_l, n_dot_v, n_dot_h, roughness) * n_dot_l * per_ring * TAU / SPOKES as f32;
                }
            }
            let found = sheen_albedo(n_dot_v, roughness);
            assert!(
                (found - sum.min(1.0)).abs() < 0.035,
                "n·v {n_dot_v}, roughness {roughness}: {found} for {sum}"
            );
        }
    }
}

/// With `specular` 0 nothing is mirrored, whatever the index of refraction; an index of 1 has no boundary.
#[test]
fn specular_and_index_scale_what_is_mirrored() {
    let table = BrdfTable::new(BRDF_TABLE_SIDE);
    let entry = table.lookup(0.1, 0.3);
    let shares = |fresnel0: f32, grazing| reflectance(Vec3::ONE, Vec3::splat(fresnel0), grazing, entry);
    let none = shares(0.0, 0.0);
    assert_eq!(
        (none.single, none.multiple, none.diffuse),
        (Vec3::ZERO, Vec3::ZERO, Vec3::ONE)
    );
    let [half, whole] = [shares(0.02, 0.5), shares(0.04, 1.0)];
    assert!((half.single * 2.0 - whole.single).abs().max_element() < 1e-6);
}

/// Sum over all light directions of the lobe times n·l, by half vectors, which are as dense as the lobe is narrow.
fn directional_albedo(n_dot_v: f32, fresnel0: f32, alpha: f32) -> f32 {
    const RINGS: usize = 400;
    const SPOKES: usize = 200;
    let (normal, to_eye) = (Vec3::Z, to_eye(n_dot_v));
    let mut sum = 0.0;
    for ring in 0..RINGS {
        // Shares of the micro-facets' distribution, finest where it ends: from the side the steepest facets count most.
        let rest = 1.0 - (ring as f32 + 0.5) / RINGS as f32;
        let (share, share_per_ring) = (1.0 - rest * rest * rest, 3.0 * rest * rest);
        let cos = ((1.0 - share) / (1.0 + (alpha * alpha - 1.0) * share)).sqrt();
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        for spoke in 0..SPOKES {
            let turn = TAU * (spoke as f32 + 0.5) / SPOKES as f32;
            let halfway = Vec3::new(sin * turn.cos(), sin * turn.sin(), cos);
            let v_dot_h = to_eye.dot(halfway);
            let to_light = halfway * (2.0 * v_dot_h) - to_eye;
            if v_dot_h > 0.0 && to_light.z > 0.0 {
                let density = ggx_distribution(normal, halfway, alpha) * cos / (4.0 * v_dot_h);
                let f0 = Vec3::splat(fresnel0);
                let lobe = specular_lobe(normal, to_eye, to_light, to_light.z, n_dot_v, f0, alpha).x;
                sum += lobe * to_light.z / density * share_per_ring;
            }
        }
    }
    sum / (RINGS * SPOKES) as f32
}

#[test]
fn the_table_is_what_the_lobe_gives_back() {
    let table = BrdfTable::new(BRDF_TABLE_SIDE);
    // Where entries lie, so that what lies between them is not in question.
    let last = BRDF_TABLE_SIDE - 1;
    let place = |entry: usize| entry as f32 / last as f32;
    for column in [last / 6, last / 3, last / 2, last * 5 / 7, last] {
        for row in [last.div_ceil(4), last * 2 / 5, last * 2 / 3, last] {
            let (n_dot_v, roughness) = (place(column).powi(2), place(row));
            let Vec2 { x: scale, y: bias } = table.lookup(n_dot_v, roughness);
            for fresnel0 in [1.0, 0.04] {
                let lobe = directional_albedo(n_dot_v, fresnel0, roughness * roughness);
                // F90 is 1 from a reflectance of 2 % on.
                let split = fresnel0 * scale + bias;
                assert!(
                    (lobe - split).abs() < 0.005,
                    "{n_dot_v} {roughness} {fresnel0}: {lobe} beside {split}"
                );
            }
        }
    }
}

/// Summed up over all places of the lamp, the part of a lobe that it fills is the part of all directions that it fills.
#[test]
fn the_lamp_gives_no_more_than_it_has() {
    let table = BrdfTable::new(BRDF_TABLE_SIDE);
    for roughness in ROUGHNESSES {
        let filled = |to_lamp: Vec3| table.lamp_lookup(Vec3::Z, to_lamp, roughness);
        let count = 100_000;
        let sum: f32 = all_directions(count).map(filled).sum();
        let of_disc = (1.0 - LAMP_RADIUS_RADIANS.cos()) / 2.0;
        let share = sum / count as f32 / of_disc;
        assert!((0.98..1.02).contains(&share), "roughness {roughness}: {share}");
    }
}

/// Brute force: the lobe over the lamp's disc, for a viewer in the direction of the normal.
#[test]
fn the_lamp_fills_of_a_lobe_what_lies_in_its_disc() {
    let table = BrdfTable::new(BRDF_TABLE_SIDE);
    for roughness in [0.3f32, 0.5, 0.7, 1.0] {
        let alpha = roughness * roughness;
        // Density of mirrored directions, times n·l.
        let lobe = |direction: Vec3| {
            let halfway = (direction + Vec3::Z).normalize_or(Vec3::X);
            ggx_distribution(Vec3::Z, halfway, alpha) * direction.z.max(0.0)
        };
        let directions: Vec<(Vec3, f32)> = all_directions(60_000)
            .map(|direction| (direction, lobe(direction)))
            .collect();
        let whole: f32 = directions.iter().map(|(_, density)| density).sum();
        for degrees in [0.0f32, 6.0, 15.0, 40.0, 80.0] {
            let angle = degrees.to_radians();
            let to_lamp = Vec3::new(angle.sin(), 0.0, angle.cos());
            let in_disc = directions
                .iter()
                .filter(|(direction, _)| direction.dot(to_lamp) > LAMP_RADIUS_RADIANS.cos());
            let brute = in_disc.map(|(_, density)| density).sum::<f32>() / whole;
            let found = table.lamp_lookup(Vec3::Z, to_lamp, roughness);
            assert!(
                (found - brute).abs() < 0.02 * brute.max(0.05),
                "roughness {roughness}, {degrees}°: {found} for {brute}"
            );
        }
    }
}

#[test]
fn a_mirror_shows_the_lamps_edge() {
    let table = BrdfTable::new(BRDF_TABLE_SIDE);
    let at = |degrees: f32| {
        let angle = degrees.to_radians();
        table.lamp_lookup(Vec3::Z, Vec3::new(angle.sin(), 0.0, angle.cos()), 0.0)
    };
    assert!([0.0, 4.0, 7.5].map(at).into_iter().all(|share| share > 0.999));
    assert!([10.5, 30.0, 179.0].map(at).into_iter().all(|share| share < 0.001));
}

#[test]
fn what_is_mirrored_is_not_also_scattered() {
    let table = BrdfTable::new(BRDF_TABLE_SIDE);
    let shares = |fresnel0: f32| reflectance(Vec3::splat(0.5), Vec3::splat(fresnel0), 1.0, table.lookup(0.8, 0.5));
    assert!(shares(0.04).diffuse.x > 0.45);
    assert!(shares(0.5).diffuse.x < 0.27);
    assert!(shares(1.0).diffuse.x.abs() < 1e-4);
}

/// The integral of D (n·h) over the hemisphere is 1 by definition of D.
#[test]
fn the_distribution_is_normalised() {
    const STEPS: usize = 4_000;
    for alpha in [0.01f32, 0.1, 0.5, 1.0] {
        let sum: f32 = (0..STEPS)
            .map(|step| {
                // Angles crowd where the lobe is narrow.
                let t = (step as f32 + 0.5) / STEPS as f32;
                let angle = t * t * PI / 2.0;
                let halfway = Vec3::new(angle.sin(), 0.0, angle.cos());
                let per_step = t * PI / STEPS as f32;
                ggx_distribution(Vec3::Z, halfway, alpha) * angle.cos() * TAU * angle.sin() * per_step
            })
            .sum();
        assert!((sum - 1.0).abs() < 2e-3, "alpha {alpha}: {sum}");
    }
}

#[test]
fn occlusion_and_horizon_leave_open_surfaces_alone() {
    use crate::twins::pbr::{horizon_fade, specular_occlusion};
    for n_dot_v in ANGLES {
        for alpha in [0.0, 0.2, 1.0] {
            assert!(specular_occlusion(n_dot_v, 1.0, alpha) > 0.999);
            assert!(specular_occlusion(n_dot_v, 0.0, alpha) < n_dot_v.max(0.001));
            let closing: Vec<f32> = (0..=10)
                .map(|step| specular_occlusion(n_dot_v, step as f32 / 10.0, alpha))
                .collect();
            assert!(closing.is_sorted(), "{closing:?}");
        }
        let mirrored = (-to_eye(n_dot_v)).reflect(Vec3::Z);
        assert_eq!(horizon_fade(mirrored, Vec3::Z), 1.0);
    }
    assert_eq!(horizon_fade(Vec3::NEG_Z, Vec3::Z), 0.0);
}
