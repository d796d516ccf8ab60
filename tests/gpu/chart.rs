//! A chart of materials: metal, plastic, paper and cloth in seven roughnesses, and a ball of glass. What the light does to one of them shows here
//! first.

use bindpose::model::{AlphaMode, Material, Reflectance};
use bindpose::scene::{Light, Theme};
use glam::Vec3;

use crate::golden::compare_picture;
use crate::scenes::{Scene, material};
use crate::sets::{floor, plates};
use crate::still_life::add_ball_of;

const ROUGHNESSES: [f32; 7] = [0.0, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0];
const RADIUS: f32 = 0.42;

fn with(color: [f32; 3], metallic: f32, roughness: f32) -> Material {
    Material {
        reflectance: Reflectance::MetallicRoughness { metallic, roughness },
        ..material("ball", color)
    }
}

fn chart() -> Scene {
    let mut model = plates(&[floor(4.0)]);
    model.materials = vec![with([0.07; 3], 0.0, 0.8)];
    // Gold, red plastic, paper, blue cloth.
    let rows = [
        ([1.0, 0.77, 0.34], 1.0),
        ([0.4, 0.02, 0.015], 0.0),
        ([0.9; 3], 0.0),
        ([0.02, 0.035, 0.09], 0.0),
    ];
    for (row, (color, metallic)) in rows.into_iter().enumerate() {
        for (column, roughness) in ROUGHNESSES.into_iter().enumerate() {
            let center = Vec3::new(column as f32 - 3.0, RADIUS, 1.6 - row as f32);
            add_ball_of(&mut model.mesh, center, RADIUS, [32, 48]);
            model.materials.push(with(color, metallic, roughness));
        }
    }
    add_ball_of(&mut model.mesh, Vec3::new(0.0, 0.6, -2.6), 0.6, [32, 48]);
    model.materials.push(Material {
        opacity: 0.3,
        alpha: AlphaMode::Blend,
        double_sided: true,
        ..with([0.75, 0.85, 0.85], 0.0, 0.05)
    });
    let mut scene = Scene::of(model);
    (scene.camera.yaw_radians, scene.camera.pitch_radians) = (-0.25, 0.5);
    scene.camera.target = Vec3::new(0.0, 0.2, -0.2);
    scene.camera.distance = 11.5;
    scene
}

on_both_backends! {
    fn in_both_lights_and_themes(gpu) {
        let mut scene = chart();
        let mut easel = gpu.easel(&scene, &[], [640, 480]);
        for theme in [Theme::Dark, Theme::Light] {
            scene.options.theme = theme;
            easel.renderer.refine_for(&scene.frame());
            for light in Light::ALL {
                scene.options.light = light;
                let name = format!("chart-{}-{}", light.name(), if theme == Theme::Dark { "dark" } else { "light" });
                compare_picture(gpu, &name, &easel.draw(&scene));
            }
        }
    }

    /// What is shown before the large cubes are filtered: mirrors are a little less sharp, and nothing else is another.
    fn few_texels_show_nearly_the_same(gpu) {
        let mut scene = chart();
        let mut easel = gpu.easel(&scene, &[], [640, 480]);
        for theme in [Theme::Dark, Theme::Light] {
            scene.options.theme = theme;
            let coarse = easel.draw(&scene);
            easel.renderer.refine_for(&scene.frame());
            let fine = easel.draw(&scene);
            let off: Vec<u8> = coarse.rgba.iter().zip(&fine.rgba).map(|(a, b)| a.abs_diff(*b)).collect();
            let mean = off.iter().map(|&off| f64::from(off)).sum::<f64>() / off.len() as f64;
            let far = off.iter().filter(|&&off| off > 24).count() as f64 / off.len() as f64;
            assert!(mean < 0.7 && far < 0.005, "{theme:?}: {mean} on average, {far} far off");
        }
    }
}
