//! The book's light on the GPU, read back, against its twin.

use bindpose::shaders::BOOK_WGSL;
use glam::Vec3;

use super::evaluate::evaluate;
use super::{ANGLES, ROUGHNESSES};
use crate::twins::book::{
    BOOK_STRENGTHS, BookSurface, PhongSurface, blinn_phong, book_light, book_reflectance, phong, phong_light,
    schlick_fresnel,
};

const QUANTITIES: u32 = 6;

/// Formulas in f32 on both sides; powers up to 256 enlarge what devices round of a logarithm.
const TOLERANCE: f32 = 1e-3;

fn on_cpu(quantity: u32, n_dot_v: f32, shininess: f32) -> Vec3 {
    let to_eye = Vec3::new((1.0 - n_dot_v * n_dot_v).sqrt(), n_dot_v, 0.0);
    let to_lights = [
        Vec3::new(-0.5, 0.6, 0.3),
        Vec3::new(0.7, 0.2, -0.4),
        Vec3::new(0.1, -0.6, 0.3),
    ]
    .map(Vec3::normalize);
    let dull = BookSurface {
        albedo: Vec3::new(0.6, 0.4, 0.3),
        fresnel0: Vec3::new(0.02, 0.1, 0.6),
        shininess,
        normal: Vec3::Y,
        to_eye,
    };
    let old = PhongSurface {
        texel: Vec3::new(0.9, 0.7, 0.5),
        ambient: Vec3::splat(0.5),
        diffuse: Vec3::new(0.8, 0.6, 0.4),
        specular: Vec3::new(0.1, 0.2, 0.4),
        power: shininess * 64.0,
        normal: Vec3::Y,
        to_eye,
    };
    match quantity {
        0 => schlick_fresnel(dull.fresnel0 * shininess, n_dot_v),
        1 => blinn_phong(&dull, to_lights[0], BOOK_STRENGTHS[0]),
        2 => book_light(&dull, to_lights, 0.75, 0.5),
        3 => book_reflectance(&dull, (-to_eye).reflect(Vec3::Y)),
        4 => phong(&old, to_lights[0], BOOK_STRENGTHS[0]),
        _ => phong_light(&old, to_lights, 0.75, 0.5),
    }
}

on_both_backends! {
    fn the_book_agrees_with_its_twin(gpu) {
        let constants = format!("const ANGLES: u32 = {ANGLES}u;\nconst ROUGHNESSES: u32 = {ROUGHNESSES}u;\n");
        let source = [BOOK_WGSL.source, &constants, include_str!("book_probe.wgsl")].concat();
        let found = evaluate(gpu, source, &[], [ANGLES, ROUGHNESSES * QUANTITIES]);
        assert_eq!(found.len() as u32, ANGLES * ROUGHNESSES * QUANTITIES);
        for (index, found) in (0..).zip(found) {
            let (row, column) = (index / ANGLES, index % ANGLES);
            let n_dot_v = (column as f32 + 0.5) / ANGLES as f32;
            let shininess = (row % ROUGHNESSES) as f32 / (ROUGHNESSES - 1) as f32;
            let expected = on_cpu(row / ROUGHNESSES, n_dot_v, shininess);
            let error = (found - expected).abs().max_element() / expected.max_element().max(0.1);
            assert!(
                error <= TOLERANCE,
                "quantity {}, n·v {n_dot_v}, shininess {shininess}: {found} for {expected}, off by {error:e}",
                row / ROUGHNESSES
            );
        }
    }
}
