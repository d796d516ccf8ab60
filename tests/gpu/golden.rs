//! Pictures that somebody looked at. `BLESS=1 cargo test --test gpu golden` draws them anew, from Vulkan.

use std::path::{Path, PathBuf};

use bindpose::render::device::Backend;
use bindpose::scene::{
    Background, FrameOptions, Insets, Light, Overlay, Passes, Projection, Theme, ViewMode, ViewPreset,
};
use bindpose::session::{CameraCommand, File, FileCommand, PlayCommand, Session};

use crate::gltf_materials::{GltfMaps, gltf_still_life};
use crate::gpu::{Gpu, Picture};
use crate::scenes::{FRONT, Scene, bent_tube, card};
use crate::still_life::{StillLifeMaps, still_life};

/// Drivers round and antialias differently: a channel may be off by this much anywhere …
const TOLERANCE: u8 = 6;
/// … and by more in this share of the pixels, those on edges.
const SHARE: f64 = 0.004;

fn compare(gpu: &Gpu, name: &str, scene: &Scene) {
    compare_picture(gpu, name, &gpu.draw(scene, 320, 200));
}

pub(crate) fn compare_picture(gpu: &Gpu, name: &str, actual: &Picture) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/gpu/golden/{name}.png"));
    if std::env::var_os("BLESS").is_some() {
        if gpu.backend == Backend::Vulkan {
            save(&path, actual);
        }
        return;
    }
    let expected = load(&path);
    let differs = actual.share_that_differs(&expected, TOLERANCE);
    if differs > SHARE {
        let beside =
            |what| PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}-{what}.png", gpu.backend));
        save(&beside("actual"), actual);
        save(&beside("difference"), &difference(actual, &expected));
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

/// The sample, with its maps.
fn figure() -> Session {
    let mut session = Session::new(true);
    let files = [
        ("figure.m3d", &include_bytes!("../../web/sample/figure.m3d")[..]),
        ("figure_diff.png", include_bytes!("../../web/sample/figure_diff.png")),
        ("figure_norm.png", include_bytes!("../../web/sample/figure_norm.png")),
    ];
    let files = files.map(|(name, bytes)| File::new(name, bytes.to_vec()));
    session.apply(FileCommand::Add(files.into()));
    session
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
    fn still_life_in_every_way(gpu) {
        let (mut scene, maps) = (still_life(), StillLifeMaps::new());
        let mut easel = gpu.easel(&scene, &maps.images(), [240, 160]);
        let plain = scene.options;
        for light in Light::ALL {
            scene.options.light = light;
            compare_picture(gpu, &format!("still-life-{}", light.name()), &easel.draw(&scene));
        }
        for mode in ViewMode::ALL.into_iter().skip(1) {
            scene.options = FrameOptions { view_mode: mode, ..plain };
            compare_picture(gpu, &format!("still-life-{}", mode.name()), &easel.draw(&scene));
        }
        scene.options = FrameOptions { light: Light::Book, view_mode: ViewMode::AmbientOcclusion, ..plain };
        compare_picture(gpu, "still-life-ao-book", &easel.draw(&scene));
        scene.options = FrameOptions { background: Background::Sky, light: Light::Book, ..plain };
        scene.options.environment_turn_radians = 1.0;
        compare_picture(gpu, "still-life-sky-book", &easel.draw(&scene));
        scene.options = FrameOptions { split: Some(0.5), theme: Theme::Light, passes: Passes::none(), ..plain };
        for overlay in Overlay::ALL {
            scene.options.overlays.set(overlay, true);
        }
        scene.highlighted = Some(4);
        scene.hidden = vec![false, true];
        compare_picture(gpu, "still-life-split-lines", &easel.draw(&scene));
    }
    fn what_gltf_has_in_both_lights(gpu) {
        let (mut scene, maps) = (gltf_still_life(), GltfMaps::new());
        let mut easel = gpu.easel(&scene, &maps.images(), [300, 180]);
        for light in Light::ALL {
            scene.options.light = light;
            compare_picture(gpu, &format!("gltf-still-life-{}", light.name()), &easel.draw(&scene));
        }
        scene.options.view_mode = ViewMode::Roughness;
        compare_picture(gpu, "gltf-still-life-roughness", &easel.draw(&scene));
        scene.options.view_mode = ViewMode::Lit;
        scene.options.light = Light::Studio;
        scene.camera.yaw_radians += std::f32::consts::PI;
        compare_picture(gpu, "gltf-still-life-behind", &easel.draw(&scene));
    }
    /// As the page shows it first, with its maps, when all is refined.
    fn figure_in_both_lights_and_themes(gpu) {
        let mut session = figure();
        session.apply(CameraCommand::SetViewport { aspect: 640.0 / 480.0, insets: Insets::default() });
        session.apply(CameraCommand::LookFrom(ViewPreset::ThreeQuarter));
        let mut renderer = gpu.renderer();
        renderer.set_model(&session.open_model().expect("the sample is sound").model).expect("small");
        renderer.set_maps(&session.maps().images().collect::<Vec<_>>());
        let mut target = gpu.target(640, 480);
        for (theme, word) in [(Theme::Dark, "dark"), (Theme::Light, "light")] {
            for light in Light::ALL {
                let mut frame = session.frame();
                (frame.options.theme, frame.options.light) = (theme, light);
                renderer.refine_for(&frame);
                renderer.render(&frame, &mut target);
                compare_picture(gpu, &format!("figure-{}-{word}", light.name()), &gpu.read(&target));
            }
        }
    }
    /// The sample, in the middle of a step, both lights.
    fn figure_in_the_middle_of_a_step(gpu) {
        let mut session = figure();
        let clips = &session.open_model().expect("the sample is sound").model.clips;
        let walk = clips.iter().position(|clip| clip.name == "Walk").expect("it walks");
        session.apply(PlayCommand::SelectClip(walk));
        session.apply(PlayCommand::Seek { time_secs: 0.25 });
        session.apply(CameraCommand::SetViewport { aspect: 0.75, insets: Insets::default() });
        session.apply(CameraCommand::LookFrom(ViewPreset::ThreeQuarter));
        let mut renderer = gpu.renderer();
        renderer.set_model(&session.open_model().expect("the sample is sound").model).expect("small");
        let mut target = gpu.target(180, 240);
        let mut frame = session.frame();
        frame.options.split = Some(0.5);
        renderer.render(&frame, &mut target);
        compare_picture(gpu, "figure-split", &gpu.read(&target));
    }
}
