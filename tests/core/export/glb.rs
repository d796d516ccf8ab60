//! Models in glTF's binary form.

use bindpose::export::{MapImages, glb, glb_losses};
use bindpose::format::{Document, LineMap};
use bindpose::image::{self, Image};
use bindpose::import::import;
use bindpose::import::m3d::from_document;
use bindpose::model::{
    AlphaMode, Channel, Front, Handedness, JointNames, Layers, LocalJoint, MapSlot, Material, Model, Reflectance,
    Track, UpAxis, Wrap,
};
use glam::{Affine2, Mat2, Quat, Vec2, Vec3, Vec4};
use serde_json::{Value, json};

use crate::documents::{arm, quad, reordered, with_rotation, with_translation};

fn model(document: &Document) -> Model {
    from_document(document, &LineMap::default()).expect("it is sound").0
}

/// Small models, each with something that a file may have.
pub(super) fn models() -> Vec<(String, Model)> {
    let mut roots = arm();
    roots.bone_parents = vec![-1, -1, 0];
    let mut early = model(&arm());
    let keys = [-2.5, 0.25].map(|time_secs| (time_secs, LocalJoint::IDENTITY));
    early.clips[0].tracks[0] = Track::new(keys).expect("sound keys");
    early.clips[0] = bindpose::model::Clip::new("early", early.clips[0].tracks.clone());
    let mut unweighted = model(&arm());
    unweighted.mesh.influences[3] = Default::default();
    let mut twice = model(&arm());
    twice.mesh.influences[4].joints = [1, 1, 2, 1];
    twice.mesh.influences[4].weights = [0.25, 0.25, 0.25, 0.25];
    let mut lying = model(&arm());
    lying.up_axis = UpAxis::Z;
    lying.handedness = Handedness::Right;
    [
        ("quad", model(&quad())),
        ("arm", model(&arm())),
        ("arm-backwards", model(&reordered(&arm(), &[2, 0, 1]))),
        ("arm-of-two-roots", model(&roots)),
        ("arm-early", early),
        ("arm-unweighted", unweighted),
        ("arm-named-twice", twice),
        ("arm-lying", lying),
        ("arm-of-curves", curved()),
        ("arm-rich", rich()),
        ("arm-unlit", unlit()),
    ]
    .map(|(name, model)| (name.to_owned(), model))
    .into()
}

/// The arm with held values and splines.
fn curved() -> Model {
    let mut model = model(&arm());
    let held = Channel::held([(0.0, Vec3::Y), (0.5, Vec3::Y * 1.5), (1.0, Vec3::Y)]);
    let slope = [Quat::from_xyzw(0.0, 0.0, 0.5, 0.0); 2];
    let spline = Channel::spline([0.0, 0.5, 1.0].map(|secs| (secs, Quat::from_rotation_z(secs), slope)));
    let keys = [(0.0, 1.0), (0.5, 1.5), (1.0, 1.0)].map(|(time_secs, height)| {
        let joint = LocalJoint {
            translation: Vec3::Y * height,
            rotation: Quat::from_rotation_z(time_secs),
            ..LocalJoint::IDENTITY
        };
        (time_secs, joint)
    });
    let track = Track::new(keys).expect("sound keys");
    model.clips[0].tracks[1] = with_translation(&track, held);
    model.clips[0].tracks[2] = with_rotation(&track, spline);
    model
}

const LAYERS: Layers = Layers {
    ior: 1.25,
    specular: 0.75,
    specular_color: [2.0, 0.5, 1.0],
    clearcoat: 0.5,
    clearcoat_roughness: 0.125,
    clearcoat_normal_scale: 0.25,
    sheen_color: [0.25, 0.5, 0.75],
    sheen_roughness: 0.375,
    transmission: 0.625,
};

/// The arm with all that a material and a vertex can have.
fn rich() -> Model {
    let mut model = model(&arm());
    let vertex_count = model.mesh.vertex_count();
    (model.handedness, model.front) = (Handedness::Right, Front::Positive);
    model.mesh.colors = vec![Vec4::new(1.0, 0.5, 0.25, 1.0); vertex_count];
    model.mesh.second_tex_coords = vec![Vec2::splat(0.5); vertex_count];
    let mut material = Material {
        name: "gold".into(),
        diffuse: [1.0, 0.5, 0.25],
        opacity: 0.5,
        reflectance: Reflectance::MetallicRoughness {
            metallic: 0.75,
            roughness: 0.25,
        },
        layers: LAYERS,
        alpha: AlphaMode::Blend,
        double_sided: true,
        unlit: false,
        emissive: [2.0, 0.5, 0.0],
        normal_scale: 0.5,
        occlusion_strength: 0.25,
        diffuse_map: Some("gold.png".into()),
        normal_map: Some("bumps.png".into()),
        metallic_roughness_map: Some("shine.png".into()),
        occlusion_map: Some("hollows.png".into()),
        emissive_map: Some("glow.png".into()),
        specular_map: Some("varnish.png".into()),
        clearcoat_map: Some("lacquer.png".into()),
        clearcoat_normal_map: Some("drops.png".into()),
        sheen_map: Some("dust.png".into()),
    };
    for (map, channels) in [
        (&mut material.specular_map, [false, false, false, true]),
        (&mut material.clearcoat_map, [true, true, false, false]),
    ] {
        if let Some(map) = map {
            map.sampling.channels = channels;
        }
    }
    if let Some(map) = &mut material.diffuse_map {
        map.sampling.wrap = [Wrap::Clamp, Wrap::Mirror];
        map.sampling.second_tex_coords = true;
        map.sampling.nearest = true;
        map.sampling.map_from_mesh =
            Affine2::from_scale_angle_translation(Vec2::splat(2.0), -0.5, Vec2::new(0.25, 0.5));
    }
    model.materials[0] = material;
    let names = ["hip", "", "hand"].map(str::to_owned).to_vec();
    model.skeleton = model.skeleton.with_names(names);
    model
}

fn unlit() -> Model {
    let mut model = rich();
    model.materials[0].unlit = true;
    model
}

/// The JSON and the binary chunk of a file.
pub(super) fn chunks(bytes: &[u8]) -> (Value, Vec<u8>) {
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")) as usize;
    assert_eq!((&bytes[..4], word(4), word(8)), (&b"glTF"[..], 2, bytes.len()));
    let json = &bytes[20..20 + word(12)];
    let rest = &bytes[20 + word(12)..];
    let root = serde_json::from_slice(json).expect("it is JSON");
    (root, rest.get(8..).unwrap_or_default().to_vec())
}

fn written(model: &Model, maps: &MapImages<'_>) -> (Value, Vec<u8>) {
    let exported = glb(model, &JointNames::default(), maps).expect("it can be written");
    chunks(&exported.bytes)
}

fn picture(texels: &[[u8; 4]]) -> Image {
    let width = texels.len() as u32;
    Image::from_rgba8(width, 1, texels.as_flattened().to_vec(), "test").expect("a sound picture")
}

#[test]
fn each_submesh_is_a_primitive_over_shared_vertices() {
    let mut document = quad();
    document.materials.push(document.materials[0].clone());
    document.subsets = vec![crate::documents::subset(0, 1), crate::documents::subset(1, 1)];
    let (root, _) = written(&model(&document), &MapImages::default());
    let primitives = root["meshes"][0]["primitives"].as_array().expect("primitives");
    assert_eq!(primitives.len(), 2);
    assert_eq!(primitives[0]["attributes"], primitives[1]["attributes"]);
    assert_eq!(
        [&primitives[0]["material"], &primitives[1]["material"]],
        [&json!(0), &json!(1)]
    );
    assert_eq!(root.get("skins"), None);
}

#[test]
fn indices_run_against_the_clock_in_sixteen_bits() {
    let (root, binary) = written(&model(&quad()), &MapImages::default());
    let indices = root["meshes"][0]["primitives"][0]["indices"].as_u64().expect("indices") as usize;
    let accessor = &root["accessors"][indices];
    assert_eq!(accessor["componentType"], 5123);
    let view = &root["bufferViews"][accessor["bufferView"].as_u64().expect("a view") as usize];
    let start = view["byteOffset"].as_u64().expect("a place") as usize;
    let found: Vec<u8> = binary[start..start + 12].iter().step_by(2).copied().collect();
    assert_eq!(found, [0, 2, 1, 0, 3, 2]);
}

#[test]
fn bones_are_nodes_in_the_files_order_with_their_names() {
    let backwards = model(&reordered(&arm(), &[2, 0, 1]));
    let mut names = JointNames::default();
    names.set(1, "hip");
    let exported = glb(&backwards, &names, &MapImages::default()).expect("it can be written");
    let (root, _) = chunks(&exported.bytes);
    assert_eq!(root["skins"][0]["joints"], json!([0, 1, 2]));
    assert_eq!(root["nodes"][1]["name"], "hip");
    assert_eq!(root["nodes"][1]["children"], json!([2]));
    assert_eq!(root["nodes"][2]["children"], json!([0]));
    assert_eq!(root["nodes"][0]["extras"]["bindpose"]["bone"], 0);
    assert_eq!(root["nodes"][0].get("name"), None);
}

#[test]
fn several_roots_get_a_node_above_them() {
    let (_, model) = models().swap_remove(3);
    let (root, _) = written(&model, &MapImages::default());
    assert_eq!(root["skins"][0]["joints"], json!([0, 1, 2]));
    assert_eq!(root["nodes"][3], json!({ "name": "skeleton", "children": [0, 1] }));
    assert_eq!(root["scenes"][0]["nodes"], json!([3, 4]));
}

#[test]
fn materials_of_the_books_keep_their_values_in_extras() {
    let (root, _) = written(&model(&arm()), &MapImages::default());
    let material = &root["materials"][0];
    assert_eq!(
        material["extras"]["bindpose"],
        json!({
            "reflectance": "fresnel", "diffuse": [0.5, 0.5, 0.5], "fresnel0": [0.05, 0.05, 0.05], "roughness": 0.5,
            "alphaClip": false, "diffuseMap": null, "normalMap": null,
        })
    );
    assert_eq!(material["pbrMetallicRoughness"]["metallicFactor"], 0.0);
    assert_eq!(
        root["scenes"][0]["extras"]["bindpose"],
        json!({ "handedness": "left", "up": "y" })
    );
}

#[test]
fn the_words_of_gltf_come_out_as_they_went_in() {
    let image = picture(&[[1, 2, 3, 255]]);
    let maps: MapImages<'_> = MapSlot::ALL.into_iter().map(|slot| ((0, slot), &image)).collect();
    let (root, _) = written(&rich(), &maps);
    let material = &root["materials"][0];
    assert_eq!(material.get("extras"), None);
    assert_eq!(root["scenes"][0].get("extras"), None);
    let transform = "/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform";
    for (pointer, expected) in [
        ("/pbrMetallicRoughness/metallicFactor", json!(0.75)),
        ("/pbrMetallicRoughness/baseColorFactor", json!([1.0, 0.5, 0.25, 0.5])),
        ("/emissiveFactor", json!([1.0, 0.25, 0.0])),
        (
            "/extensions/KHR_materials_emissive_strength/emissiveStrength",
            json!(2.0),
        ),
        ("/alphaMode", json!("BLEND")),
        ("/doubleSided", json!(true)),
        ("/normalTexture/scale", json!(0.5)),
        ("/occlusionTexture/strength", json!(0.25)),
        ("/pbrMetallicRoughness/baseColorTexture/texCoord", json!(1)),
        (&format!("{transform}/offset"), json!([0.25, 0.5])),
        (&format!("{transform}/rotation"), json!(0.5)),
        ("/extensions/KHR_materials_clearcoat/clearcoatFactor", json!(0.5)),
        (
            "/extensions/KHR_materials_clearcoat/clearcoatNormalTexture/index",
            json!(1),
        ),
    ] {
        assert_eq!(material.pointer(pointer), Some(&expected), "{pointer}");
    }
    let extensions = [
        "KHR_materials_clearcoat",
        "KHR_materials_emissive_strength",
        "KHR_materials_ior",
        "KHR_materials_sheen",
        "KHR_materials_specular",
        "KHR_materials_transmission",
        "KHR_texture_transform",
    ];
    assert_eq!(root["extensionsUsed"], json!(extensions));
    let (root, _) = written(&unlit(), &maps);
    let extensions = ["KHR_materials_unlit", "KHR_texture_transform"];
    assert_eq!(root["extensionsUsed"], json!(extensions));
    let bytes = glb(&rich(), &JointNames::default(), &maps)
        .expect("it can be written")
        .bytes;
    let read = &import(&bytes).expect("what was written is read").model.materials[0];
    assert_eq!(read.layers, LAYERS);
    for slot in MapSlot::ALL.into_iter().filter(|slot| *slot != MapSlot::Diffuse) {
        let sampling = |material: &Material| material.map(slot).map(|map| map.sampling);
        assert_eq!(sampling(read), sampling(&rich().materials[0]), "{slot:?}");
    }
    let layers = [
        MapSlot::Specular,
        MapSlot::Clearcoat,
        MapSlot::ClearcoatNormal,
        MapSlot::Sheen,
    ];
    let colors = [10, 20, 30, 40].map(|red| picture(&[[red, 0, 0, 255]]));
    let maps: MapImages<'_> = layers
        .into_iter()
        .zip(&colors)
        .map(|(slot, image)| ((0, slot), image))
        .collect();
    let (own, _) = written(&rich(), &maps);
    let extensions = &own["materials"][0]["extensions"];
    let [specular, coat, sheen] =
        ["specular", "clearcoat", "sheen"].map(|name| &extensions[format!("KHR_materials_{name}")]);
    for (info, texture) in [
        (&specular["specularTexture"], 0),
        (&coat["clearcoatTexture"], 1),
        (&coat["clearcoatRoughnessTexture"], 1),
        (&coat["clearcoatNormalTexture"], 2),
        (&sheen["sheenColorTexture"], 3),
        (&sheen["sheenRoughnessTexture"], 3),
    ] {
        assert_eq!(info["index"], texture, "{extensions}");
    }
    // One picture for all, sampled in two ways.
    let counts = ["images", "samplers", "textures"].map(|list| root[list].as_array().map_or(0, Vec::len));
    assert_eq!(counts, [1, 2, 2]);
}

#[test]
fn layers_are_read_as_they_were_written_and_only_those_that_differ_are() {
    let written = |layers| {
        let mut model = rich();
        model.materials[0].layers = layers;
        let bytes = glb(&model, &JointNames::default(), &MapImages::default())
            .expect("it can be written")
            .bytes;
        let (root, _) = chunks(&bytes);
        let keys = root["materials"][0]["extensions"].as_object().expect("extensions");
        let names: Vec<String> = keys.keys().cloned().collect();
        let read = import(&bytes).expect("what was written is read").model.materials[0].clone();
        // The strength of the coat's normal map stands with the map.
        let layers = Layers {
            clearcoat_normal_scale: 1.0,
            ..layers
        };
        assert_eq!((read.layers, read.alpha, read.opacity), (layers, AlphaMode::Blend, 0.5));
        names.join(" ").replace("KHR_materials_", "")
    };
    let none = Layers::default();
    assert_eq!(
        written(LAYERS),
        "clearcoat emissive_strength ior sheen specular transmission"
    );
    assert_eq!(written(none), "emissive_strength");
    for (layers, expected) in [
        (Layers { ior: 0.0, ..none }, "emissive_strength ior"),
        (
            Layers {
                specular_color: [1.0, 1.0, 0.5],
                ..none
            },
            "emissive_strength specular",
        ),
        (Layers { clearcoat: 1.0, ..none }, "clearcoat emissive_strength"),
        (
            Layers {
                sheen_color: [0.5, 0.0, 0.0],
                ..none
            },
            "emissive_strength sheen",
        ),
        (
            Layers {
                transmission: 1.0,
                ..none
            },
            "emissive_strength transmission",
        ),
    ] {
        assert_eq!(written(layers), expected);
    }
}

#[test]
fn gloss_of_a_normal_map_becomes_roughness() -> Result<(), Box<dyn std::error::Error>> {
    let mut document = arm();
    document.materials[0].normal_map = Some("bumps.dds".into());
    let bumps = picture(&[[128, 128, 255, 255], [255, 128, 128, 0]]);
    let maps = MapImages::from([((0, MapSlot::Normal), &bumps)]);
    let (root, binary) = written(&model(&document), &maps);
    let surface = &root["materials"][0]["pbrMetallicRoughness"];
    assert_eq!(surface["roughnessFactor"], 1.0);
    let decoded: Vec<_> = root["images"]
        .as_array()
        .expect("pictures")
        .iter()
        .map(|image| {
            let view = &root["bufferViews"][image["bufferView"].as_u64().expect("a view") as usize];
            let [start, length] =
                ["byteOffset", "byteLength"].map(|key| view[key].as_u64().expect("a number") as usize);
            let picture = image::decode(&binary[start..start + length], "map.png").expect("a picture");
            (image["name"].clone(), picture.to_rgba8(0, 0).expect("texels"))
        })
        .collect();
    assert_eq!(
        decoded,
        [
            (json!("bumps.dds (roughness)"), vec![255, 128, 0, 255, 255, 255, 0, 255]),
            // Its green pointed down.
            (json!("bumps.dds"), vec![128, 127, 255, 255, 255, 127, 128, 255]),
        ]
    );
    Ok(())
}

#[test]
fn curves_stay_what_they_are() {
    let (root, _) = written(&curved(), &MapImages::default());
    let samplers = root["animations"][0]["samplers"].as_array().expect("samplers");
    let ways: Vec<_> = samplers
        .iter()
        .filter_map(|sampler| sampler["interpolation"].as_str())
        .collect();
    assert_eq!(ways, ["STEP", "CUBICSPLINE"]);
}

#[test]
fn what_gltf_does_not_hold_is_said() {
    let by_name = |name: &str| {
        let found = models().into_iter().find(|(named, _)| named == name);
        found.expect("it is there").1
    };
    for (name, code) in [
        ("arm-early", "negative-times"),
        ("arm-unweighted", "vertices-unweighted"),
        ("arm-rich", "maps-missing"),
    ] {
        let losses = glb_losses(&by_name(name), &MapImages::default(), &Default::default());
        let codes: Vec<_> = losses.iter().map(|loss| loss.code).collect();
        assert_eq!(codes, [code]);
        assert!(
            crate::documents::is_sentence(&losses[0].message),
            "{}",
            losses[0].message
        );
    }
    assert_eq!(
        glb_losses(&by_name("arm"), &MapImages::default(), &Default::default()),
        []
    );
}

#[test]
fn texture_coordinates_that_are_sheared_are_a_loss_and_turned_ones_are_none() {
    let image = picture(&[[1, 2, 3, 255]]);
    let maps: MapImages<'_> = MapSlot::ALL.into_iter().map(|slot| ((0, slot), &image)).collect();
    let losses = |matrix2: Mat2| {
        let mut model = rich();
        let material = &mut model.materials[0];
        for map in [&mut material.diffuse_map, &mut material.emissive_map] {
            let map = map.as_mut().expect("it has the map");
            map.sampling.map_from_mesh = Affine2::from_mat2(matrix2);
        }
        glb_losses(&model, &maps, &Default::default())
    };
    let turned = Mat2::from_angle(0.7) * Mat2::from_diagonal(Vec2::new(2.0, -0.5));
    assert_eq!(losses(turned), [], "turned, mirrored and of two sizes");
    let sheared = losses(turned * Mat2::from_cols(Vec2::X, Vec2::new(0.001, 1.0)));
    let [loss] = &sheared[..] else {
        panic!("one loss, not {sheared:?}");
    };
    assert_eq!((loss.code, loss.count), ("texture-shear", 2));
    assert!(
        loss.message.starts_with("2 maps shear texture coordinates,"),
        "{}",
        loss.message
    );
}

#[test]
fn a_missing_picture_that_two_materials_name_is_one_map() {
    let mut model = model(&arm());
    let one = model.materials[0].clone();
    model.materials = ["skin.dds", "skin.dds", "coat.dds"]
        .map(|name| Material {
            diffuse_map: Some(name.into()),
            ..one.clone()
        })
        .into();
    let losses = glb_losses(&model, &MapImages::default(), &Default::default());
    let found: Vec<_> = losses.iter().map(|loss| (loss.code, loss.count)).collect();
    assert_eq!(found, [("maps-missing", 2)], "as the list of maps counts them");
    assert!(
        losses[0].message.starts_with("2 maps are left out"),
        "{}",
        losses[0].message
    );
}
