//! Pictures that somebody looked at. `BLESS=1 cargo test --test gpu golden` draws them anew, from Vulkan.

use std::path::{Path, PathBuf};

use bindpose::render::device::Backend;
use bindpose::scene::{Background, Projection, Theme};

use crate::gpu::{Gpu, Picture};
use crate::scenes::{FRONT, Scene, bent_tube, card};

/// Drivers round and antialias differently: a channel may be off by this much anywhere …
const TOLERANCE: u8 = 6;
/// … and by more in this share of the pixels, those on edges.
const SHARE: f64 = 0.004;

fn compare(gpu: &Gpu, name: &str, scene: &Scene) {
    let actual = gpu.draw(scene, 320, 200);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/gpu/golden/{name}.png"));
    if std::env::var_os("BLESS").is_some() {
        if gpu.backend == Backend::Vulkan {
            save(&path, &actual);
        }
        return;
    }
    let expected = load(&path);
    let differs = actual.share_that_differs(&expected, TOLERANCE);
    if differs > SHARE {
        let beside =
            |what| PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}-{what}.png", gpu.backend));
        save(&beside("actual"), &actual);
        save(&beside("difference"), &difference(&actual, &expected));
        panic!(
            "{:.2} % of {name} differ by more than {TOLERANCE}; see {} and its neighbour. \
             If the new picture is right: BLESS=1 cargo test --test gpu golden",
            differs * 100.0,
            beside("actual").display()
        );
    }
}

fn save(path: &Path, picture: &Picture) {
    image::save_buffer(
        path,
        &picture.rgba,
        picture.width,
        picture.height,
        image::ColorType::Rgba8,
    )
    .expect("writes a PNG");
}

fn load(path: &Path) -> Picture {
    let image = image::open(path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
        .into_rgba8();
    Picture {
        width: image.width(),
        height: image.height(),
        rgba: image.into_raw(),
    }
}

/// Eight times the difference, opaque.
fn difference(a: &Picture, b: &Picture) -> Picture {
    let channels = a.rgba.iter().zip(&b.rgba).enumerate();
    let rgba = channels
        .map(|(index, (a, b))| {
            if index % 4 == 3 {
                255
            } else {
                a.abs_diff(*b).saturating_mul(8)
            }
        })
        .collect();
    Picture {
        rgba,
        width: a.width,
        height: a.height,
    }
}

on_both_backends! {
    fn card_on_dark_ground(gpu) {
        compare(gpu, "card-dark", &Scene::of(card(FRONT)).three_quarter(Theme::Dark));
    }
    fn card_on_light_ground(gpu) {
        compare(gpu, "card-light", &Scene::of(card(FRONT)).three_quarter(Theme::Light));
    }
    fn bent_tube_on_dark_ground(gpu) {
        compare(gpu, "bent-tube-dark", &bent_tube(0.9).three_quarter(Theme::Dark));
    }
    fn bent_tube_on_light_ground_in_parallel(gpu) {
        let mut scene = bent_tube(-0.9).three_quarter(Theme::Light);
        scene.camera.projection = Projection::Orthographic;
        compare(gpu, "bent-tube-light-orthographic", &scene);
    }
    fn bent_tube_on_nothing(gpu) {
        let mut scene = bent_tube(0.9).three_quarter(Theme::Light);
        scene.options.background = Background::None;
        compare(gpu, "bent-tube-transparent", &scene);
    }
}
