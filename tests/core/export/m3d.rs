//! Models in the books' format: what was read is read again, bit for bit, and by the books' own loaders.

use std::collections::HashSet;

use bindpose::check::book::{self, Book, Known};
use bindpose::edit::{Edits, apply};
use bindpose::export::{Loss, m3d, m3d_losses, one_word};
use bindpose::format::{Dialect, Document, LineMap, parse};
use bindpose::import::m3d::from_document;
use bindpose::model::{
    AlphaMode, Channel, Front, Handedness, JointNames, Layers, LocalJoint, Material, Model, Reflectance, Track, UpAxis,
    Wrap,
};
use glam::{Quat, Vec2, Vec3, Vec4};
use proptest::prelude::*;

use crate::documents::{REAL_FILES, arm, figure, material, quad, real_file, with_rotation, with_translation};
use crate::format::written_documents as document;

fn written(model: &Model, dialect: Dialect) -> Vec<u8> {
    m3d(model, &JointNames::default(), dialect)
        .expect("it can be written")
        .bytes
}

fn read(bytes: &[u8]) -> Model {
    let parsed = parse(bytes).expect("what was written is read");
    let findings: Vec<_> = parsed.diagnostics.iter().map(|finding| &finding.message).collect();
    let text = String::from_utf8_lossy(bytes);
    assert!(findings.is_empty(), "{findings:?}\n{text}");
    from_document(&parsed.document, &parsed.lines)
        .expect("what was written is sound")
        .0
}

/// All that a model is, to the bit; not how many keys a file had, of which some may have been left out, and not its handedness, which
/// is found by normals that a file may lack.
pub(super) fn all_of(mut model: Model) -> String {
    model.clips.iter_mut().for_each(|clip| clip.key_count = 0);
    model.handedness = Handedness::default();
    format!("{model:?}")
}

fn codes(losses: &[Loss]) -> Vec<&str> {
    losses.iter().map(|loss| loss.code).collect()
}

/// The same with what the format does not hold left out: names are single words, and each subset has a material of its own.
pub(super) fn plain(mut document: Document) -> Document {
    let mut taken = HashSet::new();
    let mut word = |name: &mut String| {
        *name = one_word(name);
        while !taken.insert(name.clone()) || name.is_empty() {
            name.push('x');
        }
    };
    if document.dialect == Dialect::D3d12 {
        document
            .materials
            .iter_mut()
            .for_each(|material| word(&mut material.name));
    } else {
        document.materials.iter_mut().for_each(|material| material.name.clear());
    }
    document.clips.iter_mut().for_each(|clip| word(&mut clip.name));
    for material in &mut document.materials {
        for map in [&mut material.diffuse_map, &mut material.normal_map] {
            *map = map.as_deref().map(one_word);
        }
    }
    document.subsets.resize(document.materials.len(), Default::default());
    document
}

proptest! {
    #![proptest_config(crate::properties::cases(300))]

    #[test]
    fn a_written_model_reads_back_bit_for_bit(document in document()) {
        let document = plain(document);
        // Parents may form a circle.
        if let Ok((model, _)) = from_document(&document, &LineMap::default()) {
            let again = read(&written(&model, document.dialect));
            let (again, model) = (all_of(again), all_of(model));
            let differs = again.bytes().zip(model.bytes()).position(|(a, b)| a != b).unwrap_or_default();
            prop_assert!(again == model, "…{}\n…{}", &again[differs.saturating_sub(99)..], &model[differs.saturating_sub(99)..]);
        }
    }

    #[test]
    fn what_any_name_and_subset_became_stays(document in document()) {
        if let Ok((model, _)) = from_document(&document, &LineMap::default()) {
            let once = read(&written(&model, document.dialect));
            let twice = read(&written(&once, document.dialect));
            prop_assert_eq!(all_of(twice), all_of(once));
        }
    }
}

#[test]
fn real_files_read_back_bit_for_bit_and_by_the_loaders() {
    let real = REAL_FILES.iter().filter_map(|name| Some((*name, real_file(name)?)));
    for (name, parsed) in real.chain([("figure", figure())]) {
        let dialect = parsed.document.dialect;
        let (model, _) = from_document(&parsed.document, &parsed.lines).expect("it is sound");
        let bytes = written(&model, dialect);
        let losses = m3d_losses(&model, &JointNames::default(), dialect);
        assert_eq!(codes(&losses), [""; 0], "{name}");
        assert!(format!("{:?}", read(&bytes)) == format!("{model:?}"), "{name}");
        for (book, of_book) in [(Book::D3d11, Dialect::D3d11), (Book::D3d12, Dialect::D3d12)] {
            let bytes = written(&model, of_book);
            let reading = book::read(book, &bytes, &Known::default());
            assert_eq!((reading.stop, reading.mistake), (None, None), "{name} for {book:?}");
            let parsed = parse(&bytes).expect("it can be read");
            assert_eq!(
                reading.document.vertices, parsed.document.vertices,
                "{name} for {book:?}"
            );
            assert_eq!(reading.document.clips, parsed.document.clips, "{name} for {book:?}");
        }
    }
}

#[test]
fn names_of_several_words_become_one_that_the_loaders_keep() {
    let mut document = arm();
    document.materials[0].name = "left  arm".into();
    document.materials[0].diffuse_map = Some("my skin.dds".into());
    document.clips[0].name = "Take 1".into();
    let (model, _) = from_document(&document, &LineMap::default()).expect("it is sound");
    let bytes = written(&model, Dialect::D3d12);
    let reading = book::read(Book::D3d12, &bytes, &Known::default()).document;
    assert_eq!(reading.clips[0].name, "Take_1");
    assert_eq!(reading.materials[0].name, "left_arm");
    assert_eq!(reading.materials[0].diffuse_map.as_deref(), Some("my_skin.dds"));
    let losses = m3d_losses(&model, &JointNames::default(), Dialect::D3d12);
    assert_eq!(codes(&losses), ["names-of-one-word"]);
    assert_eq!(losses[0].count, 3);
}

#[test]
fn subsets_that_share_a_material_get_copies() {
    let mut document = quad();
    document.materials.push(material("unused"));
    let (mut model, _) = from_document(&document, &LineMap::default()).expect("it is sound");
    let [submesh] = model.mesh.submeshes[..] else {
        panic!("one subset")
    };
    model.mesh.submeshes = vec![submesh; 2];
    let again = read(&written(&model, Dialect::D3d12));
    let names: Vec<_> = again.materials.iter().map(|material| material.name.as_str()).collect();
    assert_eq!(names, ["plain", "plain_2"]);
    let losses = m3d_losses(&model, &JointNames::default(), Dialect::D3d12);
    assert_eq!(codes(&losses), ["materials-shared", "materials-unused"]);
}

/// The arm with all that the format does not hold.
fn rich() -> Model {
    let (mut model, _) = from_document(&arm(), &LineMap::default()).expect("it is sound");
    let vertex_count = model.mesh.vertex_count();
    model.up_axis = UpAxis::Z;
    model.front = Front::Positive;
    model.mesh.colors = vec![Vec4::ONE; vertex_count];
    model.mesh.second_tex_coords = vec![Vec2::ZERO; vertex_count];
    model.materials[0] = Material {
        name: "gold".into(),
        diffuse: [1.0, 0.5, 0.25],
        opacity: 0.5,
        reflectance: Reflectance::MetallicRoughness {
            metallic: 0.5,
            roughness: 0.25,
        },
        layers: Layers {
            clearcoat: 0.5,
            ..Layers::default()
        },
        alpha: AlphaMode::Blend,
        double_sided: true,
        unlit: true,
        emissive: [1.0; 3],
        normal_scale: 0.5,
        diffuse_map: Some("gold.png".into()),
        normal_map: Some("bumps.png".into()),
        metallic_roughness_map: Some("shine.png".into()),
        occlusion_map: Some("hollows.png".into()),
        emissive_map: Some("glow.png".into()),
        ..Material::default()
    };
    if let Some(map) = &mut model.materials[0].diffuse_map {
        map.sampling.wrap = [Wrap::Clamp; 2];
    }
    let held = Channel::held([(0.0, Vec3::ZERO), (1.0, Vec3::X)]);
    let still = [Quat::from_xyzw(0.0, 0.0, 0.0, 0.0); 2];
    let half_a_turn = Quat::from_xyzw(0.0, 0.0, 1.0, 0.0);
    let spline = Channel::spline([(0.0, Quat::IDENTITY, still), (1.0, half_a_turn, still)]);
    let key = |translation, rotation| LocalJoint {
        translation,
        rotation,
        ..LocalJoint::IDENTITY
    };
    let keys = [(0.0, key(Vec3::ZERO, Quat::IDENTITY)), (1.0, key(Vec3::X, half_a_turn))];
    let track = Track::new(keys).expect("sound keys");
    model.clips[0].tracks[1] = with_translation(&track, held);
    model.clips[0].tracks[2] = with_rotation(&track, spline);
    let rest: Vec<_> = model
        .skeleton
        .rest()
        .iter()
        .map(|joint| key(joint.translation * 2.0, joint.rotation))
        .collect();
    let names = vec!["hip".to_owned(), String::new(), "hand".to_owned()];
    model.skeleton = model.skeleton.with_rest(&rest).with_names(names);
    model
}

#[test]
fn a_material_of_gltf_that_is_no_metal_loses_no_metalness() {
    for (metallic, is_lost) in [(0.0, false), (0.25, true)] {
        let mut model = rich();
        for material in &mut model.materials {
            material.reflectance = Reflectance::MetallicRoughness {
                metallic,
                roughness: 0.5,
            };
        }
        let losses = m3d_losses(&model, &JointNames::default(), Dialect::D3d12);
        assert_eq!(codes(&losses).contains(&"metallic-roughness"), is_lost, "{metallic}");
    }
}

#[test]
fn what_the_format_does_not_hold_is_said_before() {
    let losses = m3d_losses(&rich(), &JointNames::default(), Dialect::D3d12);
    let expected = "up-axis front vertex-colors second-tex-coords joint-names rest-pose step-keys cubic-keys \
        metallic-roughness alpha-blend opacity double-sided unlit emissive layers normal-scale metallic-roughness-map \
        occlusion-map emissive-map map-sampling";
    assert_eq!(codes(&losses).join(" "), expected);
    for loss in &losses {
        assert!(crate::documents::is_sentence(&loss.message), "{}", loss.message);
    }
    assert_eq!(losses[4].message, "2 bones have a name; the format numbers its bones.");
    let codes_of_11 = m3d_losses(&rich(), &JointNames::default(), Dialect::D3d11);
    assert!(codes(&codes_of_11).contains(&"fresnel-to-phong"));
}

#[test]
fn a_specular_map_is_lost_too() {
    let mut model = rich();
    model.materials[0].layers = Layers::default();
    for (map, is_lost) in [(None, false), (Some("varnish.png".into()), true)] {
        model.materials[0].specular_map = map;
        let losses = m3d_losses(&model, &JointNames::default(), Dialect::D3d12);
        assert_eq!(codes(&losses).contains(&"layers"), is_lost);
    }
}

#[test]
fn curves_become_straight_keys_that_pose_alike() {
    let model = rich();
    let again = read(&written(&model, Dialect::D3d12));
    for (track, straight) in model.clips[0].tracks.iter().zip(&again.clips[0].tracks) {
        for step in 0..=1000 {
            let time_secs = step as f32 / 1000.0;
            let (wanted, found) = (track.at(time_secs), straight.at(time_secs));
            assert!(wanted.translation.distance(found.translation) <= 2e-5, "{time_secs}");
            assert!(1.0 - wanted.rotation.dot(found.rotation).abs() <= 1e-6, "{time_secs}");
        }
    }
}

#[test]
fn channels_of_different_times_are_united_and_that_is_told() {
    let mut model = rich();
    let moved = Channel::straight([(0.0, Vec3::ZERO), (0.5, Vec3::X), (1.0, Vec3::Y)]);
    let turned = Channel::straight([(0.25, Quat::IDENTITY), (0.75, Quat::from_rotation_x(1.0))]);
    let track = with_rotation(&with_translation(&Track::default(), moved), turned);
    model.clips[0].tracks[0] = track.clone();
    let told = |model: &Model| -> Option<String> {
        let mut losses = m3d_losses(model, &JointNames::default(), Dialect::D3d12).into_iter();
        Some(losses.find(|loss| loss.code == "keys-united")?.message)
    };
    let expected = "1 track has channels with keys at different times; each key of one becomes a key of all three, where the others are \
                    at that time.";
    assert_eq!(told(&model).as_deref(), Some(expected));
    let again = read(&written(&model, Dialect::D3d12));
    let rows = &again.clips[0].tracks[0];
    assert_eq!(rows.times_secs(), [0.0, 0.25, 0.5, 0.75, 1.0]);
    assert!(rows.keys().all(|(secs, joint)| joint == track.at(secs)));
    assert_eq!(told(&again), None, "rows have one time for all three");
}

#[test]
fn a_metal_keeps_its_colour_as_what_it_reflects() {
    let mut model = rich();
    model.materials[0].metallic_roughness_map = None;
    let again = read(&written(&model, Dialect::D3d12));
    // The books multiply encoded colours: 0.5, 0.25 and 0.125 are left of what the metal has.
    let diffuse = Vec3::from_array(again.materials[0].diffuse);
    assert!(
        diffuse.distance(Vec3::new(0.735_357, 0.537_099, 0.388_573)) < 1e-5,
        "{diffuse}"
    );
    let Reflectance::Fresnel { fresnel0, roughness } = again.materials[0].reflectance else {
        panic!("a material of the DirectX 12 book")
    };
    let wanted = Vec3::new(0.52, 0.27, 0.145);
    assert!(Vec3::from_array(fresnel0).distance(wanted) < 1e-6);
    assert_eq!(roughness, 0.25);
}

#[test]
fn bones_that_rest_elsewhere_get_a_key_there() {
    let mut model = rich();
    model.clips[0].tracks[2] = Track::at_rest(model.skeleton.rest()[2]);
    let again = read(&written(&model, Dialect::D3d12));
    let track = &again.clips[0].tracks[2];
    assert_eq!((track.has_keys(), track.key_count()), (true, 1));
    assert_eq!(track.key(0), model.skeleton.rest()[2]);
}

#[test]
fn bones_without_keys_stay_so_and_are_told() {
    let mut model = from_document(&arm(), &LineMap::default()).expect("it is sound").0;
    let of = |model: &Model| {
        let losses = m3d_losses(model, &JointNames::default(), Dialect::D3d12);
        let empty = losses.into_iter().find(|loss| loss.code == "track-empty");
        empty.map(|loss| (loss.count, loss.message))
    };
    assert_eq!(of(&model), None, "all have keys");
    let rests = model.skeleton.rest().to_vec();
    let mut tracks = model.clips[0].tracks.clone();
    for joint in 1..3 {
        tracks[joint] = Track::at_rest(rests[joint]);
    }
    model.clips[0] = bindpose::model::Clip::new("Take1", tracks);
    let (count, message) = of(&model).expect("it is told");
    assert_eq!(count, 2);
    assert_eq!(
        message,
        "2 bones have no keys in a clip and get none; the books' demos need one. Without `--keep-empty` each gets one at rest."
    );
    let bytes = written(&model, Dialect::D3d12);
    assert_eq!(all_of(read(&bytes)), all_of(model.clone()), "no key comes in unasked");
    let edits = Edits {
        for_book: true,
        ..Edits::default()
    };
    let mended = apply(model, &JointNames::default(), &edits).expect("it can be mended");
    assert!(mended.changes.iter().any(|change| change.code == "track-empty"));
    assert_eq!(of(&mended.model), None);
}
