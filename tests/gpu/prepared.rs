//! Pipelines are built before somebody asks for what they draw, and each once.

use bindpose::model::{AlphaMode, Material};
use bindpose::render::{MaterialImages, SampleCount, Target};
use bindpose::scene::{Background, Light, Overlay, Theme, ViewMode};
use glam::Vec3;

use crate::gltf_materials::{blended, metallic_roughness};
use crate::gpu::{Gpu, vulkan};
use crate::scenes::{Scene, bent_tube};
use crate::sets::corner;
use crate::textures::{card_once, diffuse, square};

const SIZE: [u32; 2] = [32, 24];

/// What a key or the pointer asks for.
type Ask = (&'static str, fn(&mut Scene));

/// One after another, and what was asked for before stays.
const ASKED: [Ask; 10] = [
    ("nothing", |_| {}),
    ("a picture on nothing", |scene| {
        scene.options.background = Background::None;
    }),
    ("V", |scene| scene.options.light = Light::Book),
    ("the divider", |scene| scene.options.split = Some(0.5)),
    ("Z", |scene| scene.options.overlays.set(Overlay::Wireframe, true)),
    ("N", |scene| scene.options.overlays.set(Overlay::Normals, true)),
    ("B", |scene| {
        scene.seen_through.line(Vec3::ZERO, Vec3::Y, [255; 4]);
        scene.seen_through.triangle([Vec3::ZERO, Vec3::X, Vec3::Y], [255; 4]);
    }),
    ("the pointer", |scene| scene.highlighted = Some(0)),
    ("T", |scene| scene.options.view_mode = ViewMode::BaseColor),
    ("W", |scene| {
        scene.colors_srgb = vec![[200, 100, 50, 255]; scene.model.mesh.vertex_count()];
    }),
];

fn check(gpu: &Gpu, mut scene: Scene, maps: &[MaterialImages<'_>]) {
    let mut easel = gpu.easel(&scene, maps, SIZE);
    easel.draw(&scene);
    let of_first_picture = easel.renderer.pipelines_built();
    let mut prepared = 0;
    let samples = [gpu.open.samples];
    while !easel.renderer.is_prepared(&samples) {
        assert!(easel.renderer.prepare_next(&samples));
        prepared += 1;
        assert_eq!(
            easel.renderer.pipelines_built(),
            of_first_picture + prepared,
            "one at a time, none twice"
        );
    }
    assert!(prepared > 5);
    assert!(!easel.renderer.prepare_next(&samples), "nothing is left");
    let all = easel.renderer.pipelines_built();
    for (what, ask) in ASKED {
        ask(&mut scene);
        let drawn = easel.draw(&scene);
        assert_eq!(easel.renderer.pipelines_built(), all, "{what} builds none");
        assert!(
            drawn == gpu.easel(&scene, maps, SIZE).draw(&scene),
            "{what} is drawn as ever"
        );
    }
}

on_both_backends! {
    fn no_key_builds_a_pipeline(gpu) {
        check(gpu, bent_tube(0.3).three_quarter(Theme::Dark), &[]);
    }

    fn no_key_builds_one_for_a_model_with_holes(gpu) {
        let map = square(16, |x, _| [40, 160, 60, if x < 8 { 0 } else { 255 }]);
        let mut scene = card_once().three_quarter(Theme::Dark);
        scene.model.materials[0].alpha = AlphaMode::clipped(true);
        check(gpu, scene, &diffuse(&map));
    }

    /// Of what glTF says has one side fronts are drawn alone, and backs of glass by themselves.
    fn no_key_builds_one_for_sides_and_glass(gpu) {
        let mut scene = corner().three_quarter(Theme::Dark);
        let glass = blended([200, 220, 240], 0.5);
        let pane = Material { double_sided: false, ..glass.clone() };
        scene.model.materials = vec![metallic_roughness([0.5; 3], 0.0, 0.5), glass, pane];
        check(gpu, scene, &[]);
    }

    /// A slow device draws what moves with one sample a pixel: the first drag, and keys while a clip plays.
    fn a_picture_that_moves_with_one_sample_builds_none(gpu) {
        let mut scene = bent_tube(0.3).three_quarter(Theme::Dark);
        scene.options.overlays.set(Overlay::Bounds, true);
        let mut easel = gpu.easel(&scene, &[], SIZE);
        let at_rest = easel.draw(&scene);
        let samples = [SampleCount::One, SampleCount::Four];
        while easel.renderer.prepare_next(&samples) {}
        let all = easel.renderer.pipelines_built();
        let mut plain = Target::with_samples(&gpu.open.device, SIZE[0], SIZE[1], SampleCount::One);
        let mut now = Scene { options: scene.options, ..bent_tube(0.3) };
        for (what, ask) in ASKED {
            ask(&mut now);
            easel.renderer.render(&now.frame(), &mut plain);
            assert_eq!(easel.renderer.pipelines_built(), all, "{what} builds none");
            easel.draw(&now);
            assert_eq!(easel.renderer.pipelines_built(), all, "{what}, at rest, builds none");
        }
        assert!(easel.draw(&scene) == at_rest, "at rest it is drawn as ever");
    }
}

#[test]
fn without_a_model_there_is_nothing_to_prepare() {
    let mut renderer = vulkan().renderer();
    let samples = [SampleCount::One, SampleCount::Four];
    assert!(renderer.is_prepared(&samples) && !renderer.prepare_next(&samples));
    assert_eq!(renderer.pipelines_built(), 0);
}
