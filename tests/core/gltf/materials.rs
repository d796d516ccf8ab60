//! Materials and pictures.

use std::f32::consts::FRAC_PI_2;

use bindpose::model::{AlphaMode, Layers, MapSlot, Material, Reflectance, Wrap};
use glam::Vec2;
use serde_json::json;

use super::{bare, codes_of, read, refused, told, told_all, triangle};
use crate::gltf_files::Gltf;

const PNG: &[u8] = b"\x89PNG\r\n\x1a\n and more";

#[test]
fn every_value_of_a_material_arrives() {
    let material = json!({
        "name": "Skin",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.6,
            "baseColorTexture": { "index": 0, "texCoord": 1 },
            "metallicRoughnessTexture": { "index": 1 },
        },
        "normalTexture": { "index": 1, "scale": 0.7, "extensions": { "KHR_texture_transform": {
            "offset": [0.5, 0.25], "rotation": FRAC_PI_2, "scale": [2.0, 4.0], "texCoord": 0 } }, "texCoord": 1 },
        "occlusionTexture": { "index": 1, "strength": 0.8 },
        "emissiveTexture": { "index": 0 }, "emissiveFactor": [1.0, 0.5, 0.0],
        "alphaMode": "MASK", "alphaCutoff": 0.3, "doubleSided": true,
        "extensions": { "KHR_materials_unlit": {}, "KHR_materials_emissive_strength": { "emissiveStrength": 4.0 } },
    });
    let extensions = [
        "KHR_materials_unlit",
        "KHR_materials_emissive_strength",
        "KHR_texture_transform",
    ];
    let file = triangle(
        &json!({
            "extensionsUsed": extensions,
            "materials": [material, { "alphaMode": "BLEND" }],
            "meshes": [{ "primitives": [{ "material": 0 }, { "material": 1 }, {}] }],
            "textures": [{ "source": 0, "sampler": 0 }, { "source": 1 }],
            "samplers": [{ "wrapS": 33071, "wrapT": 33648, "magFilter": 9728 }],
            "images": [{ "uri": "textures/a%20b.png" }, { "uri": "other.jpg" }],
        }),
        |file| {
            json!({
                "NORMAL": file.floats(&[[0.0, 0.0, 1.0]; 3]),
                "TEXCOORD_0": file.floats(&[[0.25, 0.0]; 3]),
                "TEXCOORD_1": file.floats(&[[0.5, 1.0]; 3]),
            })
        },
    );
    let imported = read(&file);
    let model = &imported.model;
    assert_eq!(model.mesh.second_tex_coords, [Vec2::new(0.5, 1.0); 3]);
    let skin = &model.materials[0];
    assert_eq!(
        (skin.name.as_str(), skin.diffuse, skin.opacity),
        ("Skin", [0.1, 0.2, 0.3], 0.4)
    );
    assert_eq!(
        skin.reflectance,
        Reflectance::MetallicRoughness {
            metallic: 0.5,
            roughness: 0.6
        }
    );
    assert_eq!(
        (skin.alpha, skin.double_sided, skin.unlit),
        (AlphaMode::Mask { cutoff: 0.3 }, true, true)
    );
    assert_eq!(
        (skin.emissive, skin.normal_scale, skin.occlusion_strength),
        ([4.0, 2.0, 0.0], 0.7, 0.8)
    );
    let names = MapSlot::ALL.map(|slot| skin.map_name(slot));
    let [first, second] = [Some("textures/a b.png"), Some("other.jpg")];
    assert_eq!(names, [first, second, second, second, first, None, None, None, None]);
    let diffuse = skin.map(MapSlot::Diffuse).expect("it has one").sampling;
    assert_eq!(
        (diffuse.second_tex_coords, diffuse.wrap, diffuse.nearest),
        (true, [Wrap::Clamp, Wrap::Mirror], true)
    );
    let normal = skin.map(MapSlot::Normal).expect("it has one").sampling;
    assert!(!normal.second_tex_coords, "the transform says otherwise");
    // Scaled to (2, 4), turned to (4, −2), moved: as the extension's own matrix has it.
    let moved = normal.map_from_mesh.transform_point2(Vec2::ONE);
    assert!(moved.abs_diff_eq(Vec2::new(4.5, -1.75), 1e-5), "{moved}");
    assert_eq!(model.materials[1].alpha, AlphaMode::Blend);
    let default = &model.materials[2];
    assert_eq!(
        (default.name.as_str(), default.diffuse, default.double_sided),
        ("default", [1.0; 3], false)
    );
    assert_eq!(codes_of(&imported), Vec::<&str>::new());
}

/// A file with a material for each set of extensions.
fn with_extensions(extensions: &[serde_json::Value]) -> Gltf {
    let materials: Vec<_> = extensions
        .iter()
        .map(|values| json!({ "extensions": values }))
        .collect();
    let primitives: Vec<_> = (0..materials.len()).map(|index| json!({ "material": index })).collect();
    let used = ["clearcoat", "ior", "sheen", "specular", "transmission"].map(|name| format!("KHR_materials_{name}"));
    bare(&json!({ "materials": materials, "meshes": [{ "primitives": primitives }], "extensionsUsed": used }))
}

#[test]
fn what_lies_over_a_surface_arrives() {
    let all = json!({
        "KHR_materials_ior": { "ior": 2.0 },
        "KHR_materials_specular": { "specularFactor": 0.5, "specularColorFactor": [0.25, 1.0, 3.0] },
        "KHR_materials_clearcoat": { "clearcoatFactor": 0.75, "clearcoatRoughnessFactor": 0.125 },
        "KHR_materials_sheen": { "sheenColorFactor": [0.5, 0.25, 0.0], "sheenRoughnessFactor": 0.625 },
    });
    let empty = json!({
        "KHR_materials_ior": {}, "KHR_materials_specular": {}, "KHR_materials_clearcoat": {}, "KHR_materials_sheen": {},
    });
    let imported = read(&with_extensions(&[
        all,
        empty,
        json!({ "KHR_materials_ior": { "ior": 0 } }),
    ]));
    let [all, empty, mirror] = &imported.model.materials[..3] else {
        panic!("three materials")
    };
    let expected = Layers {
        ior: 2.0,
        specular: 0.5,
        specular_color: [0.25, 1.0, 3.0],
        clearcoat: 0.75,
        clearcoat_roughness: 0.125,
        sheen_color: [0.5, 0.25, 0.0],
        sheen_roughness: 0.625,
        ..Layers::default()
    };
    assert_eq!((all.layers, empty.layers), (expected, Layers::default()));
    // ((2 - 1) / (2 + 1))² is a ninth.
    let ninth = 1.0 / 9.0_f32;
    for (found, expected) in all
        .layers
        .fresnel0()
        .into_iter()
        .zip([0.25 * ninth, ninth, 3.0 * ninth])
    {
        assert!((found - 0.5 * expected).abs() < 1e-6, "{found}");
    }
    assert_eq!(
        empty.layers.fresnel0(),
        [0.04; 3],
        "to the bit: nothing changes where nothing is said"
    );
    assert_eq!(mirror.layers.fresnel0(), [1.0; 3]);
    let dielectric = Material {
        reflectance: Reflectance::MetallicRoughness {
            metallic: 0.0,
            roughness: 1.0,
        },
        ..mirror.clone()
    };
    assert_eq!(dielectric.fresnel_surface().fresnel0, [1.0; 3]);
    assert_eq!(
        codes_of(&imported),
        ["gltf-normals-absent"],
        "of the layers nothing is told"
    );
}

#[test]
fn layers_out_of_range_are_brought_into_it_and_told() {
    let odd = json!({
        "KHR_materials_ior": { "ior": 0.5 },
        "KHR_materials_specular": { "specularFactor": -1, "specularColorFactor": [-1, 1, 1] },
        "KHR_materials_clearcoat": { "clearcoatFactor": 2, "clearcoatRoughnessFactor": 3 },
        "KHR_materials_sheen": { "sheenColorFactor": [2, 0, 0], "sheenRoughnessFactor": 7 },
    });
    let imported = read(&with_extensions(&[odd]));
    let expected = Layers {
        ior: 1.0,
        specular: 0.0,
        specular_color: [0.0, 1.0, 1.0],
        clearcoat: 1.0,
        clearcoat_roughness: 1.0,
        sheen_color: [1.0, 0.0, 0.0],
        sheen_roughness: 1.0,
        ..Layers::default()
    };
    assert_eq!(imported.model.materials[0].layers, expected);
    assert_eq!(told(&imported, "gltf-rule-broken").count, 7);
}

/// With two pictures: "a.png", "b.png".
fn with_pictures(extensions: &serde_json::Value) -> Gltf {
    bare(&json!({
        "materials": [{ "extensions": extensions }],
        "meshes": [{ "primitives": [{ "material": 0 }] }],
        "textures": [{ "source": 0 }, { "source": 1 }],
        "images": [{ "uri": "a.png" }, { "uri": "b.png" }],
    }))
}

#[test]
fn maps_of_layers_arrive_with_the_channels_that_hold_their_values() {
    let [a, b] = [0, 1].map(|index| json!({ "index": index }));
    let mapped = json!({
        "KHR_materials_specular": { "specularFactor": 0.5, "specularTexture": a },
        "KHR_materials_clearcoat": {
            "clearcoatFactor": 0.5, "clearcoatTexture": b, "clearcoatRoughnessTexture": b,
            "clearcoatNormalTexture": { "index": 0, "scale": 0.25 },
        },
        "KHR_materials_sheen": { "sheenColorFactor": [1, 1, 1], "sheenColorTexture": a, "sheenRoughnessTexture": a },
    });
    let imported = read(&with_pictures(&mapped));
    let material = &imported.model.materials[0];
    let found = [
        MapSlot::Specular,
        MapSlot::Clearcoat,
        MapSlot::ClearcoatNormal,
        MapSlot::Sheen,
    ]
    .map(|slot| {
        let map = material.map(slot).expect("it has the map");
        let channels = "rgba".chars().zip(map.sampling.channels);
        let read: String = channels.filter_map(|(name, is_read)| is_read.then_some(name)).collect();
        format!("{} {read}", map.name)
    });
    assert_eq!(found, ["a.png a", "b.png rg", "a.png rgba", "a.png rgba"]);
    let layers = material.layers;
    assert_eq!(
        (layers.specular, layers.clearcoat_normal_scale, layers.sheen_color),
        (0.5, 0.25, [1.0; 3])
    );
    assert_eq!(told_all(&imported, "gltf-map-left-out").count(), 0);
}

#[test]
fn of_two_pictures_of_a_layer_one_is_read_and_the_other_told() {
    let [a, b] = [0, 1].map(|index| json!({ "index": index }));
    let moved = json!({ "index": 0, "extensions": { "KHR_texture_transform": { "offset": [0.5, 0.0] } } });
    let mapped = json!({
        "KHR_materials_specular": { "specularTexture": a, "specularColorTexture": b },
        "KHR_materials_clearcoat": { "clearcoatTexture": a, "clearcoatRoughnessTexture": moved },
        "KHR_materials_sheen": { "sheenColorTexture": b, "sheenRoughnessTexture": b },
        "KHR_materials_transmission": { "transmissionFactor": 1, "transmissionTexture": a },
    });
    let imported = read(&with_pictures(&mapped));
    let material = &imported.model.materials[0];
    let channels = |slot| material.map(slot).map(|map| (map.name.as_str(), map.sampling.channels));
    assert_eq!(channels(MapSlot::Specular), Some(("b.png", [true, true, true, false])));
    assert_eq!(
        channels(MapSlot::Clearcoat),
        Some(("a.png", [true, false, false, false]))
    );
    assert_eq!(channels(MapSlot::Sheen), Some(("b.png", [true; 4])));
    assert_eq!(material.layers.transmission, 0.0);
    let finding = told(&imported, "gltf-map-left-out");
    assert_eq!(finding.count, 3);
    assert_eq!(
        finding.message,
        "Maps of the material \"material 0\" are left out: specularTexture, clearcoatRoughnessTexture, transmissionTexture (and the \
         transmission with it)."
    );
}

#[test]
fn a_sheen_whose_colour_cannot_be_read_is_left_out() {
    let mapped =
        json!({ "KHR_materials_sheen": { "sheenColorFactor": [1, 1, 1], "sheenColorTexture": { "index": 0 } } });
    let mut file = with_pictures(&mapped);
    file.json["textures"][0] = json!({ "extensions": { "KHR_texture_basisu": { "source": 0 } } });
    let imported = read(&file);
    assert_eq!(imported.model.materials[0].layers.sheen_color, [0.0; 3]);
    assert_eq!(told_all(&imported, "gltf-image-not-read").count(), 1);
}

#[test]
fn a_map_of_a_layer_that_is_not_there_fails_with_its_place() {
    let mapped = json!({ "KHR_materials_sheen": { "sheenRoughnessTexture": { "index": 7 } } });
    let pointer = "/materials/0/extensions/KHR_materials_sheen/sheenRoughnessTexture/index";
    assert_eq!(
        refused(&with_pictures(&mapped).text()).pointer.as_deref(),
        Some(pointer)
    );
}

#[test]
fn a_books_material_comes_back_from_what_was_written_of_it() {
    let book = json!({ "reflectance": "fresnel", "fresnel0": [0.1, 0.2, 0.3], "roughness": 0.9, "diffuse": [0.5, 0.6, 0.7],
        "alphaClip": true, "diffuseMap": "skin.dds", "normalMap": null });
    let phong = json!({ "reflectance": "phong", "ambient": [0.1, 0.1, 0.1], "specular": [0.2, 0.2, 0.2], "specPower": 8.0,
        "reflectivity": [0.0, 0.0, 0.5], "diffuse": [1.0, 1.0, 1.0], "alphaClip": false, "diffuseMap": null, "normalMap": "n.dds" });
    let file = bare(
        &json!({ "materials": [{ "extras": { "bindpose": book } }, { "extras": { "bindpose": phong }, "doubleSided": true }, { "extras": 7 }],
            "meshes": [{ "primitives": [{ "material": 0 }, { "material": 1 }, { "material": 2 }] }] }),
    );
    let materials = read(&file).model.materials;
    let skin = &materials[0];
    assert_eq!(
        skin.reflectance,
        Reflectance::Fresnel {
            fresnel0: [0.1, 0.2, 0.3],
            roughness: 0.9
        }
    );
    assert_eq!(
        (skin.diffuse, skin.alpha, skin.double_sided),
        ([0.5, 0.6, 0.7], AlphaMode::Mask { cutoff: 0.1 }, false)
    );
    assert_eq!(
        (skin.map_name(MapSlot::Diffuse), skin.map_name(MapSlot::Normal)),
        (Some("skin.dds"), None)
    );
    let Reflectance::Phong {
        spec_power,
        reflectivity,
        ..
    } = materials[1].reflectance
    else {
        panic!("{:?}", materials[1].reflectance)
    };
    assert_eq!(
        (spec_power, reflectivity, materials[1].map_name(MapSlot::Normal)),
        (8.0, [0.0, 0.0, 0.5], Some("n.dds"))
    );
    assert!(
        materials[1].double_sided && !materials[2].double_sided,
        "as the file says"
    );
    assert!(matches!(
        materials[2].reflectance,
        Reflectance::MetallicRoughness { .. }
    ));
}

#[test]
fn pictures_inside_the_file_have_names_of_their_own() {
    let texture = |index: usize| json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": index } } });
    let uri = format!("data:image/png;base64,{}", crate::gltf_files::base64(PNG));
    let mut file = triangle(
        &json!({
            "materials": (0..5).map(texture).collect::<Vec<_>>(),
            "meshes": [{ "primitives": (0..5).map(|material| json!({ "material": material })).collect::<Vec<_>>() }],
            "textures": (0..5).map(|source| json!({ "source": source })).collect::<Vec<_>>(),
        }),
        |file| json!({ "TEXCOORD_0": file.floats(&[[0.0; 2]; 3]) }),
    );
    let view = file.view(PNG, None);
    let strange = file.view(b"a picture of another kind", None);
    file.json["images"] = json!([
        { "name": "skin.png", "bufferView": view, "mimeType": "image/png" },
        { "name": "Skin", "uri": uri },
        { "bufferView": view, "mimeType": "image/png" },
        { "bufferView": strange, "mimeType": "image/avif" },
        { "uri": uri },
    ]);
    let imported = read(&file);
    let names: Vec<_> = imported
        .model
        .materials
        .iter()
        .map(|material| material.map_name(MapSlot::Diffuse))
        .collect();
    assert_eq!(
        names,
        [
            Some("skin.png"),
            Some("Skin (2).png"),
            Some("skin.png"),
            None,
            Some("image 4.png")
        ]
    );
    let pictures: Vec<_> = imported
        .pictures
        .iter()
        .map(|picture| (picture.name.as_str(), &*picture.bytes))
        .collect();
    assert_eq!(
        pictures,
        [("skin.png", PNG), ("Skin (2).png", PNG), ("image 4.png", PNG)]
    );
    let not_read = told(&imported, "gltf-image-not-read");
    assert_eq!(not_read.pointer.as_deref(), Some("/images/3/bufferView"));
}

#[test]
fn a_webp_picture_is_taken_before_the_one_for_other_programs() {
    const WEBP: &[u8] = b"RIFF\x04\0\0\0WEBP";
    let webp = json!({ "EXT_texture_webp": { "source": 1 } });
    let materials = [0, 1].map(|index| json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": index } } }));
    let mut file = triangle(
        &json!({ "materials": materials, "meshes": [{ "primitives": [{ "material": 0 }, { "material": 1 }] }],
            "extensionsUsed": ["EXT_texture_webp"], "extensionsRequired": ["EXT_texture_webp"],
            "textures": [{ "source": 0, "extensions": webp }, { "extensions": webp }] }),
        |file| json!({ "TEXCOORD_0": file.floats(&[[0.0; 2]; 3]), "NORMAL": file.floats(&[[0.0, 0.0, 1.0]; 3]) }),
    );
    let view = file.view(WEBP, None);
    file.json["images"] =
        json!([{ "uri": "skin.png" }, { "name": "skin", "bufferView": view, "mimeType": "image/webp" }]);
    let imported = read(&file);
    for material in &imported.model.materials {
        assert_eq!(material.map_name(MapSlot::Diffuse), Some("skin.webp"));
    }
    let [picture] = &imported.pictures[..] else {
        panic!("{:?}", imported.pictures)
    };
    assert_eq!((picture.name.as_str(), &*picture.bytes), ("skin.webp", WEBP));
    assert_eq!(codes_of(&imported), Vec::<&str>::new());
}
