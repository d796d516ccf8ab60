//! What a surface looks like in the studio.

use bindpose::light::{BRDF_TABLE_SIDE, BrdfTable, Environment, Prefiltered, Room};
use bindpose::scene::{Camera, Projection, srgb8_from_linear};
use glam::Vec3;

use crate::light::{all_directions, difference};
use crate::twins::studio::{EnvironmentLight, StudioLights, StudioSurface, own_light};
use crate::twins::tone_map::tone_mapped;

struct Studio {
    environment: Environment,
    prefiltered: Prefiltered,
    brdf_table: BrdfTable,
}

impl Studio {
    fn new() -> Self {
        Self::of(Room::Dark)
    }

    fn of(room: Room) -> Self {
        let environment = Environment::coarse_studio(room);
        Self {
            prefiltered: Prefiltered::of(&environment),
            environment,
            brdf_table: BrdfTable::new(BRDF_TABLE_SIDE),
        }
    }

    fn turned(&self, turn: (f32, f32)) -> EnvironmentLight<'_> {
        EnvironmentLight {
            prefiltered: &self.prefiltered,
            brdf_table: &self.brdf_table,
            turn,
            intensity: 1.0,
        }
    }
}

/// For a viewer at −z who looks along +z.
fn lights(key_visible: f32) -> StudioLights {
    StudioLights {
        key_visible,
        ..lights_of(Room::Dark)
    }
}

fn lights_of(room: Room) -> StudioLights {
    StudioLights {
        to_key: Vec3::new(0.55, 0.66, -0.51).normalize(),
        key_color: room.lights().key,
        key_visible: 1.0,
        key_mirrored: 1.0,
        to_rim: Vec3::new(-0.72, 0.36, 0.58).normalize(),
        rim_color: room.lights().rim,
    }
}

fn surface(normal: Vec3) -> StudioSurface {
    StudioSurface {
        albedo: Vec3::splat(0.5),
        fresnel0: Vec3::splat(0.04),
        roughness: 0.5,
        normal,
        smooth_normal: normal,
        to_eye: Vec3::NEG_Z,
        ..StudioSurface::default()
    }
}

/// Normals that the viewer sees.
fn seen_normals() -> impl Iterator<Item = Vec3> {
    all_directions(600).filter(|normal| normal.z < -0.05)
}

#[test]
fn the_studio_turns_with_the_viewer() {
    let studio = Studio::new();
    for yaw_radians in [0.0, 0.7, 2.5, -2.0] {
        let camera = Camera {
            target: Vec3::ZERO,
            distance: 1.0,
            yaw_radians,
            pitch_radians: 0.2,
            projection: Projection::Orthographic,
        };
        let right = camera.right();
        let ahead = right.cross(Vec3::Y);
        assert!(ahead.dot(camera.forward()) > 0.9);
        let environment = studio.turned((right.x, right.z));
        for local in all_directions(40) {
            let world = right * local.x + Vec3::Y * local.y + ahead * local.z;
            let found = environment.environment_specular_light(world, 0.0);
            assert!(difference(found, studio.environment.sample(local)) < 1e-3, "{local}");
            let diffuse = environment.environment_diffuse(world);
            assert!(
                difference(diffuse, studio.prefiltered.irradiance().towards(local)) < 1e-4,
                "{local}"
            );
        }
    }
}

#[test]
fn nothing_of_skin_or_cloth_is_burnt_out_and_nothing_is_black() {
    for room in Room::ALL {
        let studio = Studio::of(room);
        let environment = studio.turned((1.0, 0.0));
        for normal in seen_normals() {
            for (albedo, roughness) in [(0.6, 0.4), (0.6, 0.9), (0.05, 0.35)] {
                let surface = StudioSurface {
                    albedo: Vec3::splat(albedo),
                    roughness,
                    ..surface(normal)
                };
                for key_visible in [0.0, 1.0] {
                    let lights = StudioLights {
                        key_visible,
                        ..lights_of(room)
                    };
                    let shown = tone_mapped(environment.studio_light(&surface, &lights));
                    let words = format!("{room:?}, {normal}, {albedo}, {roughness}: {shown}");
                    // sRGB 250, in the middle of the lamp's image alone.
                    assert!(shown.max_element() < 0.96, "{words}");
                    // sRGB 12 for nearly black cloth, 50 for skin.
                    assert!(shown.min_element() > albedo * 0.06, "{words}");
                }
            }
        }
    }
}

/// Stored, for a normal, in bytes.
fn stored(light: Vec3) -> [u8; 3] {
    tone_mapped(light).to_array().map(srgb8_from_linear)
}

#[test]
fn what_faces_the_key_is_exposed_as_a_photographer_would() {
    for room in Room::ALL {
        let studio = Studio::of(room);
        let environment = studio.turned((1.0, 0.0));
        let lights = lights_of(room);
        let facing = |albedo: f32| {
            let matt = StudioSurface {
                albedo: Vec3::splat(albedo),
                roughness: 0.9,
                ..surface(lights.to_key)
            };
            environment.studio_light(&matt, &lights)
        };
        let [paper, gray] = [0.9, 0.5].map(facing);
        assert!(
            stored(paper).into_iter().all(|byte| (230..=246).contains(&byte)),
            "{room:?}: {:?}",
            stored(paper)
        );
        assert!(
            stored(gray).into_iter().all(|byte| (188..=204).contains(&byte)),
            "{room:?}: {:?}",
            stored(gray)
        );
        // A mirror shows the lamp itself.
        let mirror = StudioSurface {
            albedo: Vec3::ZERO,
            fresnel0: Vec3::ONE,
            roughness: 0.045,
            ..surface((lights.to_key + Vec3::NEG_Z).normalize())
        };
        let highlight = environment.studio_light(&mirror, &lights);
        assert!(
            (highlight / paper).min_element() > 3.0,
            "{room:?}: {highlight} beside {paper}"
        );
    }
}

/// The side that faces the key, and the one that faces away from it, of a ball.
#[test]
fn from_key_to_shadow_it_is_about_three_to_one() {
    for room in Room::ALL {
        let (studio, lights) = (Studio::of(room), lights_of(room));
        let environment = studio.turned((1.0, 0.0));
        let at = |normal: Vec3| environment.studio_light(&surface(normal.normalize()), &lights).y;
        let (lit, shadow) = (at(lights.to_key), at(Vec3::new(-0.64, 0.0, -0.5)));
        assert!((2.5..3.5).contains(&(lit / shadow)), "{room:?}: {lit} and {shadow}");
    }
}

#[test]
fn a_base_colour_shows_about_as_it_is() {
    let studio = Studio::new();
    let environment = studio.turned((1.0, 0.0));
    let color = Vec3::new(0.16, 0.20, 0.12);
    let (mut sum, mut count) = (Vec3::ZERO, 0.0);
    for normal in seen_normals() {
        // As large as each part is in the picture.
        let weight = -normal.z;
        let surface = StudioSurface {
            albedo: color,
            ..surface(normal)
        };
        let key_visible = normal.dot(lights(1.0).to_key).clamp(0.0, 1.0).sqrt();
        sum += tone_mapped(environment.studio_light(&surface, &lights(key_visible))) * weight;
        count += weight;
    }
    let ratio = sum / count / color;
    assert!(ratio.min_element() > 0.55 && ratio.max_element() < 1.1, "{ratio}");
}

#[test]
fn light_fades_on_coarse_triangles_alone() {
    let to_key = Vec3::new(0.1, 0.0, 1.0).normalize();
    let grazing = Vec3::X;
    assert_eq!(own_light(grazing, grazing, to_key), 1.0);
    assert_eq!(own_light(-grazing, -grazing, to_key), 0.0);
    let flat = Vec3::new(1.0, 0.4, 0.0).normalize();
    assert!((0.01..0.6).contains(&own_light(flat, grazing, to_key)));
    assert_eq!(own_light(Vec3::Z, Vec3::new(0.3, 0.0, 1.0).normalize(), to_key), 1.0);
}

#[test]
fn the_rim_is_cool_and_hugs_the_silhouette() {
    let studio = Studio::new();
    let environment = studio.turned((1.0, 0.0));
    let rim = |normal: Vec3| {
        let without = StudioLights {
            rim_color: Vec3::ZERO,
            ..lights(1.0)
        };
        let surface = surface(normal.normalize());
        environment.studio_light(&surface, &lights(1.0)) - environment.studio_light(&surface, &without)
    };
    let silhouette = rim(Vec3::new(-0.9, 0.4, -0.1));
    assert!(silhouette.z > 0.2 && silhouette.z > 1.5 * silhouette.x, "{silhouette}");
    let turned_to_the_viewer = rim(Vec3::new(-0.9, 0.4, -1.0));
    assert!(turned_to_the_viewer.z < 0.3 * silhouette.z, "{turned_to_the_viewer}");
    assert_eq!(rim(Vec3::NEG_Z), Vec3::ZERO);
}

#[test]
fn the_key_goes_with_its_shadow_and_the_environment_with_its_occlusion() {
    let studio = Studio::new();
    let environment = studio.turned((1.0, 0.0));
    let facing = surface(Vec3::new(0.4, 0.6, -0.7).normalize());
    let [lit, half, shadowed] = [1.0, 0.5, 0.0].map(|visible| environment.studio_light(&facing, &lights(visible)));
    assert!(difference(lit + shadowed, half * 2.0) < 1e-5);
    assert!(lit.min_element() > 1.9 * shadowed.max_element(), "{lit} {shadowed}");
    let hidden = StudioSurface {
        ambient_occlusion: 0.0,
        ..facing
    };
    assert!(environment.studio_light(&hidden, &lights(0.0)).max_element() < 1e-3);
}
