//! The studio's lamp: its highlight and its shadow tell of the same direction, and shadows are as soft as it is large.

use bindpose::image::{Image, half};
use bindpose::light::LAMP_RADIUS_RADIANS;
use bindpose::model::{Material, Reflectance};
use bindpose::render::for_tests::StudioLights;
use bindpose::scene::{Projection, Theme, ViewMode};
use glam::{Quat, Vec3};

use crate::gpu::{Gpu, Picture};
use crate::scenes::{Scene, material};
use crate::sets::{Plate, floor, plates};
use crate::sky::float_cube;
use crate::still_life::add_ball;

const SIZE: [u32; 2] = [480, 480];
/// Of the ball, above a floor at y = 0.
const CENTER: Vec3 = Vec3::new(0.0, 2.0, 0.0);
const RADIUS: f32 = 0.4;

/// A mirror ball high over a floor, seen in parallel, so that its shadow lies beside it.
fn ball_over_floor(yaw_radians: f32) -> Scene {
    let mut model = plates(&[floor(4.0)]);
    add_ball(&mut model.mesh, CENTER, RADIUS);
    model.materials.push(Material {
        reflectance: Reflectance::Fresnel {
            fresnel0: [1.0; 3],
            roughness: 0.0,
        },
        ..material("mirror", [0.0; 3])
    });
    seen(Scene::of(model), yaw_radians, 0.8, 7.0)
}

fn seen(mut scene: Scene, yaw_radians: f32, pitch_radians: f32, height: f32) -> Scene {
    scene.options.theme = Theme::Dark;
    scene.options.overlays = bindpose::scene::Overlays::none();
    let camera = &mut scene.camera;
    (camera.yaw_radians, camera.pitch_radians) = (yaw_radians, pitch_radians);
    camera.projection = Projection::Orthographic;
    camera.target = Vec3::Y;
    camera.distance *= height / camera.height_in_view();
    scene
}

/// A point on the ray of a pixel, which goes along the camera's forward.
fn on_ray(scene: &Scene, [x, y]: [f32; 2]) -> Vec3 {
    let camera = &scene.camera;
    let half = 0.5 * camera.height_in_view();
    let ndc = [
        (x + 0.5) / SIZE[0] as f32 * 2.0 - 1.0,
        1.0 - (y + 0.5) / SIZE[1] as f32 * 2.0,
    ];
    camera.target + (camera.right() * ndc[0] + camera.up() * ndc[1]) * half
}

/// Where the ray of a pixel first meets the ball.
fn on_ball(scene: &Scene, pixel: [f32; 2]) -> Option<Vec3> {
    let (point, along) = (on_ray(scene, pixel), scene.camera.forward());
    let to_center = CENTER - point;
    let nearest = point + along * to_center.dot(along);
    let off = (nearest - CENTER).length_squared();
    (off < RADIUS * RADIUS).then(|| nearest - along * (RADIUS * RADIUS - off).sqrt())
}

/// Where it meets the floor.
fn on_floor(scene: &Scene, pixel: [f32; 2]) -> Vec3 {
    let (point, along) = (on_ray(scene, pixel), scene.camera.forward());
    point - along * (point.y / along.y)
}

/// The weighted mean of the pixels.
fn centroid(picture: &Picture, weight: impl Fn([f32; 2], [u8; 4]) -> f32) -> [f32; 2] {
    let (mut sum, mut weights) = ([0.0, 0.0], 0.0);
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            let at = [x as f32, y as f32];
            let weight = weight(at, picture.pixel(x, y));
            sum = [sum[0] + weight * at[0], sum[1] + weight * at[1]];
            weights += weight;
        }
    }
    assert!(weights > 0.0, "there is something");
    sum.map(|sum| sum / weights)
}

/// Where the shadow of the ball tells that the lamp stands, in a picture of shadows.
fn cast(scene: &Scene, shadow: &Picture) -> Vec3 {
    let dark = centroid(shadow, |at, pixel| {
        let is_floor = on_ball(scene, at).is_none() && on_floor(scene, at).abs().max_element() < 3.9;
        if is_floor {
            1.0 - f32::from(pixel[0]) / 255.0
        } else {
            0.0
        }
    });
    (CENTER - on_floor(scene, dark)).normalize()
}

/// A black sky with a sun of 2° in this direction.
fn sun(towards: Vec3) -> Image {
    const SIDE: u32 = 128;
    float_cube(SIDE, |face, x, y| {
        let [across, down] = [x, y].map(|place| (2 * place + 1) as f32 / SIDE as f32 - 1.0);
        let along = match face {
            0 => Vec3::new(1.0, -down, -across),
            1 => Vec3::new(-1.0, -down, across),
            2 => Vec3::new(across, 1.0, down),
            3 => Vec3::new(across, -1.0, -down),
            4 => Vec3::new(across, -down, 1.0),
            _ => Vec3::new(-across, -down, -1.0),
        };
        let is_sun = along.angle_between(towards) < f32::to_radians(2.0);
        let light = half::from_f32(if is_sun { 1500.0 } else { 0.0 });
        [light, light, light, half::from_f32(1.0)]
    })
}

fn draw(gpu: &Gpu, scene: &Scene) -> Picture {
    gpu.draw(scene, SIZE[0], SIZE[1])
}

on_both_backends! {
    fn highlight_and_shadow_tell_of_one_lamp(gpu) {
        for yaw_radians in [0.3, 2.0, -1.3] {
            let mut scene = ball_over_floor(yaw_radians);
            // The lamp alone is then brighter than middle grey; the window is less than half as bright.
            scene.options.exposure_stops = -4.0;
            let lit = draw(gpu, &scene);
            let highlight = centroid(&lit, |at, pixel| {
                let is_lamp = pixel[1] > 230 && on_ball(&scene, at).is_some();
                if is_lamp { 1.0 } else { 0.0 }
            });
            let normal = (on_ball(&scene, highlight).expect("on the ball") - CENTER).normalize();
            let mirrored = scene.camera.forward().reflect(normal);

            scene.options.view_mode = ViewMode::Shadow;
            let cast = cast(&scene, &draw(gpu, &scene));
            let degrees = mirrored.angle_between(cast).to_degrees();
            assert!(degrees < 1.0, "yaw {yaw_radians}: {mirrored} and {cast}, {degrees}° apart");
            let to_key = StudioLights::beside(&scene.camera, 0.0).to_key;
            assert!(cast.angle_between(to_key).to_degrees() < 1.0, "{cast} for {to_key}");
        }
    }

    /// Shadows lie opposite to it from wherever one looks, and what it does not reach is dark: the lamps beside the
    /// viewer are gone. It turns with the sky.
    fn the_sun_of_a_sky_is_the_only_lamp_and_stands_in_the_world(gpu) {
        let towards = Vec3::new(0.5, 0.8, 0.4).normalize();
        let sky = sun(towards);
        for (yaw_radians, turn_radians) in [(0.3, 0.0), (2.0, 0.0), (-1.3, 0.0), (0.3, 1.1)] {
            let mut scene = ball_over_floor(yaw_radians);
            let paper = scene.model.materials.len() - 1;
            scene.model.materials[paper] = material("paper", [0.8; 3]);
            scene.options.environment_turn_radians = turn_radians;
            let mut easel = gpu.easel(&scene, &[], SIZE);
            assert!(easel.renderer.set_sky(Some(&sky)));
            let towards = Quat::from_rotation_y(turn_radians) * towards;
            let lit = easel.draw(&scene);
            let words = format!("yaw {yaw_radians}, turned by {turn_radians}");
            let [mut bright, mut dark] = [0, 0];
            for (x, y) in (0..SIZE[0] * SIZE[1]).map(|index| (index % SIZE[0], index / SIZE[0])) {
                let Some(point) = on_ball(&scene, [x as f32, y as f32]) else { continue };
                let normal = (point - CENTER) / RADIUS;
                // Its flat triangles lie within the ball.
                let is_rim = normal.dot(scene.camera.forward()) > -0.45;
                let [red, ..] = lit.pixel(x, y);
                match normal.dot(towards) {
                    _ if is_rim => {}
                    facing if facing > 0.7 => {
                        assert!(red > 100, "{words}: {red} at {normal}");
                        bright += 1;
                    }
                    facing if facing < -0.25 => {
                        assert!(red < 12, "{words}: {red} at {normal}");
                        dark += 1;
                    }
                    _ => {}
                }
            }
            assert!(bright + dark > 200, "{words}: {bright} and {dark} pixels");
            scene.options.view_mode = ViewMode::Shadow;
            let cast = cast(&scene, &easel.draw(&scene));
            assert!(cast.angle_between(towards).to_degrees() < 1.0, "{words}: {cast} for {towards}");
        }
    }

    /// The edge of a plate at two heights above a floor: its penumbra is as wide as the lamp's disc, seen from there.
    fn shadows_are_the_softer_the_farther_their_caster_is(gpu) {
        for above in [0.08f32, 0.16] {
            let lid = Plate {
                corner: Vec3::new(0.0, above, -1.5),
                along_u: Vec3::X * 1.5,
                along_v: Vec3::Z * 3.0,
                normal: Vec3::Y,
            };
            let view_height = 0.4;
            let mut scene = seen(Scene::of(plates(&[floor(1.8), lid])), 0.0, 1.2, view_height);
            let to_key = StudioLights::beside(&scene.camera, 0.0).to_key;
            // The lamp stands at the right of the edge, which runs along z: the shadow's edge lies beside it on the left.
            scene.camera.target = Vec3::new(-to_key.x / to_key.y * above, 0.0, 0.0);
            scene.options.view_mode = ViewMode::Shadow;
            let picture = draw(gpu, &scene);
            // The mean of many rows, which has no grain.
            let light = |x: u32| (150..330).map(|y| f32::from(picture.pixel(x, y)[0])).sum::<f32>() / (180.0 * 255.0);
            let crossing = |level: f32| {
                let x = (0..SIZE[0] / 2 + 100).find(|&x| light(x) < level).expect("dark under the lid");
                let [before, here] = [light(x - 1), light(x)];
                x as f32 - (here - level) / (here - before)
            };
            let found = (crossing(0.1) - crossing(0.9)) * view_height / SIZE[0] as f32;
            // Of an edge that is blurred over a disc, 10 to 90 % are 1.374 of its radius, in the light's view.
            let radius = above / to_key.y * LAMP_RADIUS_RADIANS.tan();
            let expected = 1.374 * radius * (1.0 - to_key.z * to_key.z).sqrt() / to_key.y;
            // What hides a point is taken as the mean of what lies about it, and of a plate that leans to the lamp half is nearer to it.
            assert!((0.9..1.45).contains(&(found / expected)), "{above} above: {found} for {expected}");
        }
    }
}
