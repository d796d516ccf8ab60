//! What materials of glTF look like in the books' words: by the formulas of both books' lights, and by their pictures.

use bindpose::export::{Look, MapImages, glb, looks, m3d, m3d_in};
use bindpose::format::{self, Dialect, parse};
use bindpose::image::Image;
use bindpose::import::import;
use bindpose::model::{JointNames, MapSlot, Material, Model, Reflectance};
use bindpose::slices::{Slices, at_once};
use glam::{Vec2, Vec3};

use super::glb::chunks;
use crate::documents::{model_of, quad};
use crate::twins::book::{BookSurface, PhongSurface, book_light, phong_light};

/// A square of one material.
fn square(material: Material) -> Model {
    let mut model = model_of(&quad()).0;
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    model.mesh.positions = corners.map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec();
    model.mesh.tex_coords = corners.map(Vec2::from_array).to_vec();
    model.materials = vec![Material {
        name: "skin".into(),
        ..material
    }];
    model
}

fn metallic(diffuse: [f32; 3], metallic: f32, roughness: f32) -> Material {
    Material {
        diffuse,
        reflectance: Reflectance::MetallicRoughness { metallic, roughness },
        ..Material::default()
    }
}

fn first(bytes: &[u8]) -> format::Material {
    parse(bytes).expect("it is sound").document.materials.remove(0)
}

/// What is written of a model's only material.
fn told(model: &Model, dialect: Dialect) -> format::Material {
    let written = m3d(model, &JointNames::default(), dialect).expect("it can be written");
    first(&written.bytes)
}

fn told_with(model: &Model, dialect: Dialect, looks: &[Look]) -> format::Material {
    let names = JointNames::default();
    let written = at_once(m3d_in(model, &names, dialect, looks, &Slices::ENDLESS)).expect("it can be written");
    first(&written.bytes)
}

fn image(width: u32, height: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Image {
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let texels = places.flat_map(|(x, y)| texel(x, y)).collect();
    Image::from_rgba8(width, height, texels, "test").expect("a sound picture")
}

fn fresnel(material: &format::Material) -> ([f32; 3], f32) {
    match material.reflectance {
        format::Reflectance::Fresnel { fresnel0, roughness } => (fresnel0, roughness),
        format::Reflectance::Phong { .. } => panic!("a material of the DirectX 12 book"),
    }
}

fn is_near(found: [f32; 3], wanted: [f32; 3], tolerance: f32) -> bool {
    found
        .into_iter()
        .zip(wanted)
        .all(|(found, wanted)| (found - wanted).abs() <= tolerance)
}

#[track_caller]
fn assert_near(found: [f32; 3], wanted: [f32; 3], tolerance: f32) {
    assert!(is_near(found, wanted, tolerance), "{found:?} is not {wanted:?}");
}

/// The mean difference, of 255, between both books' light on a ball seen from the front, the lights of the demo turned eight ways about
/// it. Nothing is mirrored.
fn difference(source: [Vec3; 2], roughness: f32, of_book: &format::Material) -> f32 {
    let format::Reflectance::Phong {
        ambient,
        specular,
        spec_power,
        ..
    } = of_book.reflectance
    else {
        panic!("a material of the DirectX 11 book")
    };
    let lights = [
        [-0.57735, 0.57735, -0.57735],
        [0.57735, 0.57735, -0.57735],
        [0.0, 0.707, 0.707],
    ];
    let (mut sum, mut count) = (0.0, 0.0);
    for turn in 0..8 {
        let turn = glam::Quat::from_rotation_y(turn as f32 * std::f32::consts::FRAC_PI_4);
        let to_lights = lights.map(|light| turn * Vec3::from_array(light));
        for y in -15_i16..=15 {
            for x in -15_i16..=15 {
                let [x, y] = [x, y].map(|place| f32::from(place) / 16.0);
                if x * x + y * y >= 1.0 {
                    continue;
                }
                let normal = Vec3::new(x, y, -(1.0 - x * x - y * y).sqrt());
                let to_eye = Vec3::NEG_Z;
                let before = BookSurface {
                    albedo: source[0],
                    fresnel0: source[1],
                    shininess: 1.0 - roughness,
                    normal,
                    to_eye,
                };
                let after = PhongSurface {
                    texel: Vec3::ONE,
                    ambient: ambient.into(),
                    diffuse: of_book.diffuse.into(),
                    specular: specular.into(),
                    power: spec_power,
                    normal,
                    to_eye,
                };
                let before = book_light(&before, to_lights, 1.0, 1.0).min(Vec3::ONE);
                let after = phong_light(&after, to_lights, 1.0, 1.0).min(Vec3::ONE);
                sum += (before - after).abs().element_sum() / 3.0;
                count += 1.0;
            }
        }
    }
    255.0 * sum / count
}

/// The DirectX 11 book's lobe has no Lambert's term and no upper end, so smooth metals come less near.
#[test]
fn the_light_of_one_book_is_near_that_of_the_other() {
    for (fresnel0, most) in [([0.04; 3], 3.0), ([0.9, 0.6, 0.3], 12.0)] {
        for tenth in 0..=10 {
            let roughness = tenth as f32 / 10.0;
            let diffuse = if most < 5.0 { [0.5, 0.3, 0.2] } else { [0.0; 3] };
            let material = Material {
                diffuse,
                reflectance: Reflectance::Fresnel { fresnel0, roughness },
                ..Material::default()
            };
            let of_book = told(&square(material), Dialect::D3d11);
            let off = difference([diffuse, fresnel0].map(Vec3::from_array), roughness, &of_book);
            assert!(
                off <= most,
                "Fresnel0 {fresnel0:?}, roughness {roughness}: off by {off}"
            );
            if tenth == 10 {
                assert!(off <= 1.0, "rough ones are only diffuse: {off}");
            }
        }
    }
}

/// With an exponent near 0 all that is lit would be white.
#[test]
fn no_exponent_makes_all_of_a_lit_face_shine() {
    for (metal, roughness) in [(0.0, 1.0), (0.0, 0.5), (1.0, 1.0), (1.0, 0.9), (1.0, 0.0)] {
        let told = told(&square(metallic([0.9; 3], metal, roughness)), Dialect::D3d11);
        let format::Reflectance::Phong { spec_power, .. } = told.reflectance else {
            panic!("a material of the DirectX 11 book")
        };
        assert!((8.0..=256.0).contains(&spec_power), "{metal} {roughness}: {spec_power}");
    }
}

#[test]
fn factors_are_written_as_the_books_multiply_them() {
    let told = told(&square(metallic([0.5, 0.25, 0.0], 0.0, 0.7)), Dialect::D3d12);
    assert_near(told.diffuse, [0.735_357, 0.537_099, 0.0], 1e-5);
    assert_eq!(fresnel(&told), ([0.04; 3], 0.7));
}

/// The books add up what is shown, glTF adds up light: a colour that goes to the books and back is the same.
#[test]
fn colours_come_back_from_the_books() {
    for dialect in [Dialect::D3d11, Dialect::D3d12] {
        let rough = square(metallic([0.8, 0.25, 0.01], 0.0, 0.7));
        let written = m3d(&rough, &JointNames::default(), dialect).expect("it can be written");
        let of_book = import(&written.bytes).expect("it is sound").model;
        let surface = of_book.materials[0].metallic_surface();
        assert_near(surface.base_color, [0.8, 0.25, 0.01], 1e-4);
        let again = glb(&of_book, &JointNames::default(), &MapImages::new()).expect("it can be written");
        let (root, _) = chunks(&again.bytes);
        let factor = &root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"];
        let factor = [0, 1, 2].map(|channel: usize| factor[channel].as_f64().expect("a number") as f32);
        assert_near(factor, [0.8, 0.25, 0.01], 1e-4);
    }
}

/// Blender writes no factor where a picture has it, so that the factor is 1.
#[test]
fn metalness_and_roughness_are_those_of_their_picture() {
    let mut material = metallic([1.0; 3], 1.0, 1.0);
    material.metallic_roughness_map = Some("surface".into());
    let model = square(material);
    let blank = told(&model, Dialect::D3d12);
    assert_eq!(
        (blank.diffuse, fresnel(&blank)),
        ([1.0; 3], ([0.04; 3], 1.0)),
        "no picture is no metal"
    );

    let cloth = image(4, 4, |_, _| [0, 102, 0, 255]);
    let maps = MapImages::from([((0, MapSlot::MetallicRoughness), &cloth)]);
    let mut found = looks(&model, &maps);
    let told = told_with(&model, Dialect::D3d12, &found);
    assert_eq!((told.diffuse, fresnel(&told)), ([1.0; 3], ([0.04; 3], 0.4)));
    assert_eq!(found[0].bake(Dialect::D3d12), None, "what is even needs no map");

    // A quarter is metal, whose roughness is 0.2; the rest has 0.6.
    let patch = image(64, 64, |x, y| match x < 32 && y < 32 {
        true => [0, 51, 255, 255],
        false => [0, 153, 0, 255],
    });
    let maps = MapImages::from([((0, MapSlot::MetallicRoughness), &patch)]);
    let mut found = looks(&model, &maps);
    let told = told_with(&model, Dialect::D3d12, &found);
    let (fresnel0, roughness) = fresnel(&told);
    assert_near(fresnel0, [0.28; 3], 0.02);
    assert!((roughness - 0.5).abs() < 0.02, "{roughness}");
    assert_near(told.diffuse, [0.75; 3], 0.02);

    let bake = found[0].bake(Dialect::D3d12).expect("it is uneven");
    let told = told_with(&model, Dialect::D3d12, &found);
    assert_eq!(told.diffuse, [1.0; 3], "the map has the colour");
    let (texels, width, height) = bake.texels(None, &patch);
    assert_eq!((width, height), (64, 64));
    assert_eq!(
        [&texels[..4], &texels[4 * 63..4 * 64]],
        [[0, 0, 0, 255], [255, 255, 255, 255]]
    );
}

#[test]
fn a_baked_map_has_the_size_and_the_alpha_of_the_base_colour() {
    let mut material = metallic([1.0, 0.5, 1.0], 1.0, 1.0);
    material.diffuse_map = Some("color".into());
    material.metallic_roughness_map = Some("surface".into());
    let model = square(material.clone());
    let color = image(8, 8, |x, _| [188, 188, 10, 30 * x as u8]);
    let surface = image(32, 32, |x, _| [0, 255, if x < 16 { 0 } else { 128 }, 255]);
    let maps = MapImages::from([
        ((0, MapSlot::Diffuse), &color),
        ((0, MapSlot::MetallicRoughness), &surface),
    ]);
    let bake = looks(&model, &maps)[0].bake(Dialect::D3d12).expect("it is uneven");
    let (texels, width, height) = bake.texels(Some(&color), &surface);
    assert_eq!((width, height), (8, 8));
    // 188 is 0.5 of light: half of it by the factor, and 127/255 of that are left where it is metal.
    assert_eq!(texels[..4], [188, 137, 10, 0]);
    assert_eq!(texels[4 * 7..4 * 8], [137, 99, 5, 210]);

    // The picture of metalness is twice as large on the surface, and turned over.
    let mut moved = material.clone();
    if let Some(map) = &mut moved.metallic_roughness_map {
        map.sampling.map_from_mesh = glam::Affine2::from_scale_angle_translation(Vec2::new(-1.0, 1.0), 0.0, Vec2::X);
    }
    let bake = looks(&square(moved), &maps)[0]
        .bake(Dialect::D3d12)
        .expect("it is uneven");
    let (texels, ..) = bake.texels(Some(&color), &surface);
    assert_eq!([texels[0], texels[4 * 7]], [137, 188]);

    // With texture coordinates of its own it cannot be multiplied; its mean counts.
    let mut second = square(material);
    if let Some(map) = &mut second.materials[0].metallic_roughness_map {
        map.sampling.second_tex_coords = true;
    }
    second.mesh.second_tex_coords = second.mesh.tex_coords.clone();
    let mut found = looks(&second, &maps);
    assert_eq!(found[0].bake(Dialect::D3d12), None);
    assert!((found[0].metallic - 0.25).abs() < 0.02, "{}", found[0].metallic);
}

/// What no triangle shows does not count.
#[test]
fn means_are_of_what_the_mesh_shows() {
    let mut material = metallic([1.0; 3], 1.0, 1.0);
    material.metallic_roughness_map = Some("surface".into());
    let mut model = square(material);
    model.mesh.tex_coords.iter_mut().for_each(|at| *at *= 0.5);
    let surface = image(64, 64, |x, y| match x < 34 && y < 34 {
        true => [0, 204, 255, 255],
        false => [0, 0, 0, 255],
    });
    let maps = MapImages::from([((0, MapSlot::MetallicRoughness), &surface)]);
    let told = told_with(&model, Dialect::D3d12, &looks(&model, &maps));
    let (fresnel0, roughness) = fresnel(&told);
    assert_near(fresnel0, [1.0; 3], 1e-5);
    assert!((roughness - 0.8).abs() < 1e-5, "{roughness}");
}
