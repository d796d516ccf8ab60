//! glTF in a session: drops of several files, pictures, names, and a model without a clip.

use bindpose::model::{AlphaMode, JointIndex, Layers, MapSlot, Material, Reflectance};
use bindpose::scene::ViewPreset;
use bindpose::session::{
    CameraCommand, File, FileCommand, FileFormat, FileSet, HistoryCommand, MaterialCommand, Session,
};
use glam::{Affine3A, Quat, Vec2};
use serde_json::json;

use super::banner::banner;
use super::{bare, skins, triangle};
use crate::gltf_files::Gltf;

/// A PNG. What it shows does not matter here.
const PICTURE: &[u8] = include_bytes!("../../../web/sample/figure_norm.png");

fn textured(image: &serde_json::Value) -> Gltf {
    let material = json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } });
    triangle(
        &json!({ "materials": [material], "meshes": [{ "primitives": [{ "material": 0 }] }], "textures": [{ "source": 0 }], "images": [image] }),
        |file| json!({ "TEXCOORD_0": file.floats(&[[0.0; 2]; 3]) }),
    )
}

fn opened(files: Vec<File>) -> Session {
    let mut session = Session::new(false);
    session.apply(FileCommand::Add(files));
    assert_eq!(session.error(), None);
    session
}

#[test]
fn a_drop_of_text_data_and_picture_opens_as_one_model() {
    let file = textured(&json!({ "uri": "maps/skin.png" }));
    let session = opened(vec![
        File::new("fox/data.bin", file.bin.clone()),
        File::new("fox/maps/skin.png", PICTURE),
        File::new("fox/fox.gltf", file.text_beside("data.bin")),
    ]);
    let open = session.open_model().expect("it is open");
    assert_eq!((open.file.base_name(), open.format), ("fox.gltf", FileFormat::Gltf));
    assert!(session.maps().image(0, MapSlot::Diffuse).is_some());
    // The data lie elsewhere: the base name is enough.
    let session = opened(vec![
        File::new("elsewhere/DATA.bin", file.bin.clone()),
        File::new("fox.gltf", file.text_beside("data.bin")),
    ]);
    assert!(session.open_model().is_some());
    let files = FileSet::new([
        File::new("a.bin", [1]),
        File::new("readme.txt", [2; 9]),
        File::new("b.glb", [3]),
    ]);
    assert_eq!(
        files.models().iter().map(|file| file.base_name()).collect::<Vec<_>>(),
        ["b.glb"]
    );
}

/// A clip that turns the knee by this much about z.
fn turning(file: &mut Gltf, name: &str, knee: u32, radians: f32) {
    let times = file.floats(&[[0.0], [1.0]]);
    let turns = file.floats(&[Quat::IDENTITY, Quat::from_rotation_z(radians)].map(|turn| turn.to_array()));
    file.json["animations"] = json!([{
        "name": name,
        "channels": [{ "sampler": 0, "target": { "node": knee, "path": "rotation" } }],
        "samplers": [{ "input": times, "output": turns }],
    }]);
}

#[test]
fn a_drop_of_a_character_and_of_motions_without_a_mesh_opens_as_one_model() {
    let mut character = skins::skinned(&skins::rig());
    turning(&mut character, "stand", 3, 0.0);
    let motion = |name: &str, radians: f32| {
        let nodes = json!([
            { "name": "Armature", "scale": [2.0, 2.0, 2.0], "children": [1] },
            { "name": "Hip", "children": [2], "translation": [1.0, 0.0, 0.0] },
            { "name": "Knee", "translation": [0.0, 1.0, 0.0] },
        ]);
        let mut file = Gltf::new(&json!({ "scenes": [{ "nodes": [0] }], "nodes": nodes }));
        turning(&mut file, name, 2, radians);
        file
    };
    let mut long = motion("walk", 0.5);
    long.json["asset"]["copyright"] = "x".repeat(10_000).into();
    assert!(
        long.glb().len() > character.glb().len(),
        "the size does not say which is the character"
    );
    let session = opened(vec![
        File::new("walk.glb", long.glb()),
        File::new("hero.glb", character.glb()),
        File::new("wave.gltf", motion("mixamo.com", -1.0).text()),
    ]);
    let open = session.open_model().expect("it is open");
    assert_eq!(open.file.path, "hero.glb");
    let clips = &open.model.clips;
    assert_eq!(
        clips.iter().map(|clip| clip.name.as_str()).collect::<Vec<_>>(),
        ["stand", "walk", "wave"]
    );
    let skeleton = &open.model.skeleton;
    let knee = (0..3).find(|&joint| skeleton.name(JointIndex(joint)) == Some("Knee"));
    let knee = knee.expect("it has a name") as usize;
    for (clip, radians) in clips.iter().zip([0.0, 0.5, -1.0]) {
        let turned = clip.tracks[knee].at(1.0).rotation;
        assert!(
            turned.abs_diff_eq(Quat::from_rotation_z(radians), 1e-5),
            "{}: {turned}",
            clip.name
        );
    }
    // Without a character the motions are models as any other.
    let alone = opened(vec![File::new("walk.glb", long.glb())]);
    assert_eq!(alone.open_model().expect("it is open").model.clips.len(), 1);
}

#[test]
fn a_missing_file_is_told_with_its_name_and_place() {
    let file = bare(&json!({}));
    let mut session = Session::new(false);
    session.apply(FileCommand::Add(vec![File::new(
        "fox.gltf",
        file.text_beside("data.bin"),
    )]));
    let error = session.error().expect("it cannot be opened");
    assert_eq!(error.diagnostic.code, "gltf-buffer-missing");
    assert!(error.excerpt.is_some(), "the line that names it");
    assert!(error.to_text().starts_with("fox.gltf:"), "{}", error.to_text());
    assert!(error.to_text().contains("data.bin"));
}

#[test]
fn pictures_inside_a_file_are_maps_and_a_dropped_one_of_that_name_takes_over() {
    let mut file = textured(&json!({}));
    let view = file.view(PICTURE, None);
    file.json["images"] = json!([{ "name": "skin", "bufferView": view, "mimeType": "image/png" }]);
    let mut session = opened(vec![File::new("fox.glb", file.glb())]);
    assert_eq!(
        session.maps().file(0, MapSlot::Diffuse).map(File::base_name),
        Some("skin.png")
    );
    assert!(session.maps().image(0, MapSlot::Diffuse).is_some());
    session.apply(FileCommand::Add(vec![File::new("new/skin.png", PICTURE)]));
    assert_eq!(
        session.maps().file(0, MapSlot::Diffuse).map(|file| file.path.as_str()),
        Some("new/skin.png")
    );
}

#[test]
fn without_a_clip_joints_are_at_rest_and_have_the_files_names() {
    let nodes = json!([{ "mesh": 0, "skin": 0 }, { "name": "Spine", "translation": [0.0, 3.0, 0.0], "children": [2] },
        { "name": "Head", "rotation": [0.0, 0.0, 1.0, 0.0] }]);
    let mut file = triangle(
        &json!({ "scenes": [{ "nodes": [0, 1] }], "nodes": nodes, "skins": [{ "joints": [1, 2] }] }),
        |file| json!({ "JOINTS_0": file.shorts(&[[1, 0, 0, 0]; 3]), "WEIGHTS_0": file.floats(&[[1.0, 0.0, 0.0, 0.0]; 3]) }),
    );
    let matrices = file.floats(&[Affine3A::IDENTITY; 2].map(|matrix| glam::Mat4::from(matrix).to_cols_array()));
    file.json["skins"][0]["inverseBindMatrices"] = matrices.into();
    let mut session = opened(vec![File::new("fox.glb", file.glb())]);
    assert_eq!(session.joint_label(JointIndex(1)), "Head");
    let frame = session.frame();
    let palette = frame.palette.0.to_vec();
    // The head is turned by half a turn, and 3 above.
    let posed = palette[1].transform_point3(glam::Vec3::new(1.0, 2.0, 0.0));
    assert!(posed.abs_diff_eq(glam::Vec3::new(-1.0, 1.0, 0.0), 1e-5), "{posed}");
    let bounds = session.open_model().expect("it is open").extent(None).bounds;
    assert!(bounds.max.y < 3.1 && bounds.min.y > 0.9, "{bounds:?}");
}

#[test]
fn clips_of_a_text_with_its_data_join_and_join_again() {
    let file = banner();
    let beside = |name: &str| {
        vec![
            File::new(&format!("in/{name}.gltf"), file.text_beside(&format!("{name}.bin"))),
            File::new(&format!("in/{name}.bin"), file.bin.clone()),
        ]
    };
    let mut session = opened(beside("banner"));
    let clips = |session: &Session| {
        let open = session.open_model().expect("it is open");
        open.clip_list()
            .map(|clip| clip.file_name.to_owned())
            .collect::<Vec<_>>()
    };
    let joined = ["banner.gltf", "banner.gltf", "walk.gltf", "walk.gltf"];
    for _ in 0..2 {
        session.apply(FileCommand::AddClips(beside("walk")));
        assert_eq!(
            (session.error(), clips(&session)),
            (None, joined.map(str::to_owned).to_vec())
        );
    }
    for again in [
        FileCommand::Add(beside("banner")),
        FileCommand::Open("in/banner.gltf".to_owned()),
    ] {
        session.apply(again);
        assert_eq!(
            (session.error(), clips(&session)),
            (None, joined.map(str::to_owned).to_vec())
        );
    }
    assert!(session.diagnostics().all(|notice| notice.code != "gltf-buffer-missing"));

    session.apply(FileCommand::AddClips(beside("run")[..1].to_vec()));
    let error = session.error().expect("its data are not there");
    assert_eq!(
        (error.diagnostic.code, &*error.file_name),
        ("gltf-buffer-missing", "run.gltf")
    );
}

/// Two upright cards, one before the other; the nearer one is turned away from whoever looks at the front. `normal_z` is of both.
fn cards(normal_z: [f32; 2]) -> Session {
    let mut file = Gltf::new(&json!({
        "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
        "materials": [{ "name": "Near" }, { "name": "Far" }, { "name": "Both", "doubleSided": true }],
    }));
    let corners = |z: f32| [[-1.0, -1.0, z], [1.0, -1.0, z], [0.0, 2.0, z]];
    let card = |file: &mut Gltf, z: f32, normal_z: f32, order: [[u16; 1]; 3], material: usize| {
        let attributes =
            json!({ "POSITION": file.floats(&corners(z)), "NORMAL": file.floats(&[[0.0, 0.0, normal_z]; 3]) });
        json!({ "attributes": attributes, "indices": file.shorts(&order), "material": material })
    };
    let [near_z, far_z] = normal_z;
    let near = card(&mut file, 1.0, near_z, [[0], [2], [1]], 0);
    let far = card(&mut file, 0.0, far_z, [[0], [1], [2]], 1);
    // Behind all and turned away, but drawn from both sides.
    let both = card(&mut file, -1.0, 1.0, [[0], [2], [1]], 2);
    file.json["meshes"] = json!([{ "primitives": [near, far, both] }]);
    opened(vec![File::new("cards.glb", file.glb())])
}

#[test]
fn a_back_that_is_not_drawn_is_not_met() {
    let mut session = cards([-1.0, 1.0]);
    for (preset, submesh) in [(ViewPreset::Front, 1), (ViewPreset::Back, 2)] {
        session.apply(CameraCommand::LookFrom(preset));
        assert_eq!(
            session.pick(Vec2::ZERO).map(|hit| hit.submesh),
            Some(submesh),
            "{preset:?}"
        );
    }
    session.apply(MaterialCommand::DrawBothSides(true));
    session.apply(CameraCommand::LookFrom(ViewPreset::Front));
    assert_eq!(session.pick(Vec2::ZERO).map(|hit| hit.submesh), Some(0));
}

#[test]
fn triangles_that_look_away_from_their_normals_are_told_where_one_side_is_drawn() {
    let told = |session: &Session| {
        let all = session
            .diagnostics()
            .filter(|finding| finding.code == "triangles-turned-away");
        all.map(|finding| (finding.message.clone(), finding.count))
            .collect::<Vec<_>>()
    };
    // The third is turned too, but drawn from both sides.
    assert_eq!(told(&cards([-1.0, 1.0])), []);
    let words = "1 triangle is drawn from the side that normals point away from, and not from the other.";
    assert_eq!(told(&cards([1.0, 1.0])), [(words.to_owned(), 1)]);
    let words = "2 triangles are drawn from the side that normals point away from, and not from the other.";
    assert_eq!(told(&cards([1.0, -1.0])), [(words.to_owned(), 2)]);
}

#[test]
fn both_sides_of_all_are_drawn_and_that_is_taken_back() {
    let mut session = cards([1.0, 1.0]);
    let sides = |session: &Session| {
        session
            .materials()
            .iter()
            .map(|one| one.double_sided)
            .collect::<Vec<_>>()
    };
    let of_file = session.materials().to_vec();
    session.apply(MaterialCommand::DrawBothSides(true));
    assert_eq!(sides(&session), [true; 3]);
    assert!(session.is_edited(0) && !session.is_edited(2));
    assert_eq!(session.history().undo_label(), Some("edit Near and 1 more change"));
    session.apply(HistoryCommand::Undo);
    assert_eq!(session.materials(), of_file);
    session.apply(HistoryCommand::Redo);
    assert_eq!(sides(&session), [true; 3]);
    // Other edits stay.
    let mut material = Box::new(session.materials()[0].clone());
    material.diffuse = [0.25; 3];
    session.apply(MaterialCommand::Edit { index: 0, material });
    session.apply(MaterialCommand::DrawBothSides(false));
    assert_eq!(sides(&session), [false, false, true]);
    assert_eq!(session.materials()[0].diffuse, [0.25; 3]);
    let revision = session.materials_revision();
    session.apply(MaterialCommand::DrawBothSides(false));
    assert_eq!(session.materials_revision(), revision, "nothing changes");
}

#[test]
fn an_edit_brings_over_what_gltf_has_and_light_above_one_stays() {
    let shining = json!({
        "pbrMetallicRoughness": { "metallicFactor": 0.5, "roughnessFactor": 0.5 },
        "emissiveFactor": [1, 0, 0],
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 5 } },
    });
    let file = bare(&json!({ "materials": [shining], "meshes": [{ "primitives": [{ "material": 0 }] }] }));
    let mut session = opened(vec![File::new("a.glb", file.glb())]);
    let of_file = session.materials()[0].clone();
    assert_eq!(of_file.emissive, [5.0, 0.0, 0.0]);
    let mut edited = |material: Material| {
        session.apply(MaterialCommand::Reset(0));
        let material = Box::new(material);
        session.apply(MaterialCommand::Edit { index: 0, material });
        session.materials()[0].clone()
    };
    let metallic = |metallic| Reflectance::MetallicRoughness {
        metallic,
        roughness: 0.25,
    };
    let wanted = Material {
        reflectance: metallic(2.0),
        opacity: 0.5,
        alpha: AlphaMode::Blend,
        double_sided: !of_file.double_sided,
        unlit: true,
        emissive: [5.0, 7.0, 0.5],
        normal_scale: -2.0,
        occlusion_strength: f32::NAN,
        ..of_file.clone()
    };
    let expected = Material {
        reflectance: metallic(1.0),
        emissive: [5.0, 1.0, 0.5],
        occlusion_strength: 1.0,
        ..wanted.clone()
    };
    assert_eq!(edited(wanted), expected);
    let layered = |layers| Material {
        layers,
        ..of_file.clone()
    };
    let odd = Layers {
        ior: 0.5,
        specular: 2.0,
        specular_color: [f32::NAN, 0.5, 1.0],
        clearcoat: -1.0,
        transmission: f32::INFINITY,
        sheen_color: [0.5; 3],
        ..Layers::default()
    };
    let mended = Layers {
        ior: 1.5,
        specular: 1.0,
        specular_color: [1.0, 0.5, 1.0],
        clearcoat: 0.0,
        transmission: 0.0,
        ..odd
    };
    assert_eq!(edited(layered(odd)), layered(mended));
    let endless = Material {
        alpha: AlphaMode::Mask { cutoff: f32::NAN },
        ..of_file.clone()
    };
    assert_eq!(edited(endless), of_file);
}
