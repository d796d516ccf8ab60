//! From the books' format to glTF and back: what comes back is what went out.

use bindpose::anim::{CompiledClip, PoseBuffers};
use bindpose::edit::{Edits, apply};
use bindpose::export::{MapImages, glb, glb_losses, m3d, one_word};
use bindpose::format::{Dialect, Document, LineMap, parse};
use bindpose::import::import;
use bindpose::import::m3d::from_document;
use bindpose::model::{Clip, Influences, JointIndex, JointNames, Model, Reflectance};
use glam::{Affine3A, Mat4, Quat, Vec3};
use proptest::prelude::*;

use super::m3d::{all_of, plain};
use crate::documents::{REAL_FILES, arm, figure, quad, real_file, reordered};
use crate::edit::swaying;
use crate::format::{fixtures, written_documents};
use crate::rigs;

/// How far a palette may be from the original's: of a matrix's columns, and of its place as a part of the model's size.
const MOST_APART: f32 = 1e-4;

/// Times of a clip at which palettes are compared.
const TIMES: u16 = 100;

/// The model as a `.glb` file, that read again, brought into the model's space, written for the books, and read again.
fn there_and_back(model: &Model, dialect: Dialect) -> Model {
    let names = JointNames::default();
    let bytes = glb(model, &names, &MapImages::new()).expect("it can be written").bytes;
    let from_glb = import(&bytes).unwrap_or_else(|refused| panic!("{}", refused.error.message));
    let edits = Edits {
        handedness: Some(model.handedness),
        up_axis: Some(model.up_axis),
        front: Some(model.front),
        ..Edits::default()
    };
    let turned = apply(from_glb.model, &names, &edits).expect("it can be turned").model;
    let bytes = m3d(&turned, &names, dialect).expect("it can be written").bytes;
    import(&bytes).expect("what was written is read").model
}

fn joint_of_bone(model: &Model, bone: usize) -> JointIndex {
    model.skeleton.joint_of_bone()[bone]
}

/// The palette of a clip at a time, in the order of the file's bones.
fn palette(model: &Model, clip: &CompiledClip, secs: f32) -> Vec<Affine3A> {
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    pose.evaluate(&model.skeleton, clip, secs);
    let joints = model.skeleton.joint_of_bone().iter();
    joints.map(|joint| pose.palette.0[joint.index()]).collect()
}

/// Bones and weights of a vertex, without those of no weight; none for a vertex that `bones` bones do not move.
fn weights(model: &Model, influences: &Influences, bones: usize) -> Vec<(u32, f32)> {
    let mut found: Vec<(u32, f32)> = Vec::new();
    for (&joint, &weight) in influences.joints.iter().zip(&influences.weights) {
        let bone = model.skeleton.file_bones()[joint as usize];
        if weight == 0.0 || bone as usize >= bones {
            continue;
        }
        match found.iter_mut().find(|(other, _)| *other == bone) {
            Some((_, sum)) => *sum += weight,
            None => found.push((bone, weight)),
        }
    }
    found.sort_by_key(|&(bone, _)| bone);
    found
}

/// Asserts that all came back but what `.glb` says that it loses.
fn assert_came_back(name: &str, old: &Model, new: &Model) {
    let lost: Vec<_> = glb_losses(old, &MapImages::new(), &Default::default())
        .iter()
        .map(|loss| loss.code)
        .collect();
    assert_mesh_came_back(name, old, new, &lost);
    assert_materials_came_back(name, old, new);
    let bones = old.skeleton.joint_count();
    let parent_of = |model: &Model, bone: usize| {
        let parent = model.skeleton.parents()[joint_of_bone(model, bone).index()];
        let parent = parent.map(|parent| model.skeleton.file_bones()[parent.index()] as usize);
        parent.filter(|&parent| parent < bones)
    };
    for bone in 0..bones {
        assert_eq!(
            parent_of(old, bone),
            parent_of(new, bone),
            "{name}: the parent of bone {bone}"
        );
    }
    let has_keys = |clip: &&Clip| clip.tracks.iter().any(|track| track.has_keys());
    let kept: Vec<_> = old.clips.iter().filter(has_keys).collect();
    assert_eq!(kept.len(), new.clips.len(), "{name}: clips");
    for (before, after) in kept.into_iter().zip(&new.clips) {
        assert_eq!(one_word(&before.name), one_word(&after.name), "{name}");
        assert_clip_came_back(name, (old, before), (new, after));
    }
}

fn assert_mesh_came_back(name: &str, old: &Model, new: &Model, lost: &[&str]) {
    let ([before, after], bones) = ([&old.mesh, &new.mesh], old.skeleton.joint_count());
    let is_drawn = before.submeshes.iter().any(|submesh| submesh.triangle_count > 0);
    if !is_drawn {
        return;
    }
    let size = old.bind_bounds().size().length();
    assert_eq!(before.vertex_count(), after.vertex_count(), "{name}");
    for (vertex, (old, new)) in before.positions.iter().zip(&after.positions).enumerate() {
        assert!(
            old.distance(*new) <= 1e-6 * size,
            "{name}: vertex {vertex}: {old} became {new}"
        );
    }
    for (vertex, (old, new)) in before.normals.iter().zip(&after.normals).enumerate() {
        assert!(
            old.distance(*new) <= 1e-5,
            "{name}: normal {vertex}: {old} became {new}"
        );
    }
    assert_eq!(before.tex_coords, after.tex_coords, "{name}");
    if !lost.contains(&"triangles-undrawn") {
        let mut expected = before.indices.clone();
        for (submesh, is_turned) in before.submeshes.iter().zip(old.turned_submeshes()) {
            let (start, count) = (submesh.triangle_start as usize, submesh.triangle_count as usize);
            for triangle in (start..start + count).filter(|_| is_turned) {
                expected.swap(3 * triangle + 1, 3 * triangle + 2);
            }
        }
        assert_eq!(expected, after.indices, "{name}");
    }
    if !lost.contains(&"subsets-empty") && !lost.contains(&"triangles-undrawn") {
        assert_eq!(before.submeshes, after.submeshes, "{name}");
    }
    for (vertex, (of_old, of_new)) in before.influences.iter().zip(&after.influences).enumerate() {
        let (of_old, of_new) = (weights(old, of_old, bones), weights(new, of_new, bones));
        let alike = of_old.len() == of_new.len()
            && of_old
                .iter()
                .zip(&of_new)
                .all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() <= 1e-6);
        assert!(alike, "{name}: vertex {vertex}: {of_old:?} became {of_new:?}");
    }
}

fn assert_materials_came_back(name: &str, old: &Model, new: &Model) {
    let used = |model: &Model| {
        let drawn = model.mesh.submeshes.iter().filter(|submesh| submesh.triangle_count > 0);
        let materials = drawn.map(|submesh| model.materials[submesh.material as usize].clone());
        materials
            .map(|mut material| {
                // The books' names are words, and the DirectX 11 book's materials have none.
                if matches!(material.reflectance, Reflectance::Phong { .. }) {
                    material.name.clear();
                }
                let maps = [&mut material.diffuse_map, &mut material.normal_map];
                let names = maps.into_iter().flatten().map(|map| &mut map.name);
                for name in names.chain([&mut material.name]) {
                    *name = one_word(name);
                }
                material
            })
            .collect::<Vec<_>>()
    };
    assert_eq!(used(old), used(new), "{name}");
}

fn assert_clip_came_back(name: &str, (old, before): (&Model, &Clip), (new, after): (&Model, &Clip)) {
    // glTF has no time before 0.
    let shift_secs = before.start_secs.min(0.0);
    let size = old.bind_bounds().size().length();
    let [compiled, again] = [before, after].map(CompiledClip::new);
    for step in 0..TIMES {
        let part = f32::from(step) / f32::from(TIMES - 1);
        let secs = before.start_secs + part * before.duration_secs();
        let expected = palette(old, &compiled, secs);
        let found = palette(new, &again, secs - shift_secs);
        for (bone, (expected, found)) in expected.iter().zip(&found).enumerate() {
            // Of what overflows on its way out nothing is known on its way back.
            let is_near = !expected.is_finite()
                || expected.matrix3.abs_diff_eq(found.matrix3, MOST_APART)
                    && expected.translation.distance(found.translation) <= MOST_APART * size;
            assert!(
                is_near,
                "{name} {} at {secs} s, bone {bone}: {expected} became {found}",
                before.name
            );
        }
    }
}

/// Small documents of each kind that machines without the real ones have.
pub(super) fn made() -> Vec<(String, Document)> {
    let mut roots = arm();
    roots.bone_parents = vec![-1, -1, 0];
    let mut free = arm();
    free.vertices[3].blend_weights = [0.0; 4];
    let clips = vec![
        rigs::ragged("ragged", 40),
        rigs::single("single", 40),
        rigs::even("even", 40, -2.0, 9, 4.0),
    ];
    let mut textured = swaying(7, 1.0);
    textured.materials[0].diffuse_map = Some("skin.dds".into());
    textured.materials[0].normal_map = Some("bumps.dds".into());
    textured.materials[0].alpha_clip = true;
    [
        ("quad", quad()),
        ("arm", arm()),
        ("arm backwards", reordered(&arm(), &[2, 0, 1])),
        ("arm of two roots", roots),
        ("arm with a free vertex", free),
        ("forty bones", rigs::rig(40, clips)),
        ("swaying", textured),
    ]
    .map(|(name, document)| (name.to_owned(), document))
    .into()
}

#[test]
fn models_come_back_from_gltf_with_their_palettes() {
    let real = REAL_FILES
        .iter()
        .filter_map(|name| Some(((*name).to_owned(), real_file(name)?.document)));
    let figure = [("figure".to_owned(), figure().document)];
    let of_fixtures = fixtures("good").into_iter().map(|fixture| {
        let document = parse(&fixture.bytes).expect("good fixtures can be read").document;
        (fixture.name, document)
    });
    for (name, document) in real.chain(figure).chain(of_fixtures).chain(made()) {
        let (model, _) = from_document(&document, &LineMap::default()).expect("it is sound");
        assert_came_back(&name, &model, &there_and_back(&model, document.dialect));
    }
}

/// Characters as programs for modelling make them: bones of any turn, place and even size, in any order, keys with any scale.
pub(super) fn characters() -> impl Strategy<Value = Document> {
    let place = || prop::array::uniform3(-5.0_f32..5.0);
    let turn =
        || prop::array::uniform4(-1.0_f32..1.0).prop_filter("a turn", |turn| turn.iter().any(|part| part.abs() > 0.1));
    let key = (place(), turn(), prop::array::uniform3(0.5_f32..2.0), 0.05_f32..1.0);
    let track = prop::collection::vec(key, 1..6);
    let bone = (place(), turn(), 0.5_f32..2.0, any::<prop::sample::Index>(), track);
    let corner = (
        place(),
        turn(),
        prop::array::uniform2(-2.0_f32..2.0),
        prop::array::uniform4((0.0_f32..1.0, any::<prop::sample::Index>())),
    );
    let mesh = (
        prop::collection::vec(corner, 3..20),
        prop::collection::vec(any::<[prop::sample::Index; 3]>(), 1..20),
    );
    let bones = prop::collection::vec(bone, 1..9).prop_flat_map(|bones| {
        let order: Vec<u32> = (0..bones.len() as u32).collect();
        (Just(bones), Just(order).prop_shuffle())
    });
    (written_documents(), bones, mesh).prop_map(|(written, (bones, order), (corners, triangles))| {
        let count = bones.len();
        let mut bind: Vec<Mat4> = Vec::new();
        let mut document = Document {
            bone_offsets: Vec::new(),
            bone_parents: Vec::new(),
            clips: vec![Default::default()],
            ..plain(written)
        };
        document.clips[0].name = "moves".into();
        for (bone, (place, turn, size, parent, keys)) in bones.into_iter().enumerate() {
            let parent = bone.checked_sub(1).map(|last| parent.index(last + 1));
            let turn = Quat::from_array(turn).normalize();
            let local = Mat4::from_scale_rotation_translation(Vec3::splat(size), turn, place.into());
            bind.push(parent.map_or(Mat4::IDENTITY, |parent| bind[parent]) * local);
            document.bone_parents.push(parent.map_or(-1, |parent| parent as i32));
            document.bone_offsets.push(bind[bone].inverse().to_cols_array());
            let mut secs = 0.0;
            let keyframes = keys.into_iter().map(|(translation, turn, scale, step)| {
                secs += step;
                bindpose::format::Keyframe {
                    time_secs: secs,
                    translation,
                    scale,
                    rotation: Quat::from_array(turn).normalize().to_array(),
                }
            });
            let keyframes = keyframes.collect();
            document.clips[0]
                .bones
                .push(bindpose::format::BoneAnimation { keyframes });
        }
        document.vertices = corners
            .into_iter()
            .map(|(position, normal, tex_coords, influences)| {
                let normal = Vec3::from_slice(&normal).try_normalize().unwrap_or(Vec3::Y);
                let tangent = normal.any_orthonormal_vector();
                bindpose::format::Vertex {
                    position,
                    normal: normal.to_array(),
                    tangent: tangent.extend(1.0).to_array(),
                    tex_coords,
                    blend_weights: influences.map(|(weight, _)| weight),
                    blend_indices: influences.map(|(_, bone)| bone.index(count) as u32),
                }
            })
            .collect();
        let vertices = document.vertices.len();
        document.triangles = triangles
            .into_iter()
            .map(|corners| corners.map(|corner| corner.index(vertices) as u32))
            .collect();
        // Each subset has its part of the triangles, the last one what is left.
        let (subsets, all) = (document.materials.len(), document.triangles.len());
        let start = |subset: usize| all * subset / subsets;
        document.subsets = (0..subsets)
            .map(|subset| crate::documents::subset(start(subset) as u32, (start(subset + 1) - start(subset)) as u32))
            .collect();
        reordered(&document, &order)
    })
}

proptest! {
    #![proptest_config(crate::properties::cases(100))]

    #[test]
    fn random_characters_come_back_from_gltf_with_their_palettes(document in characters()) {
        let (model, _) = from_document(&document, &LineMap::default()).expect("it is sound");
        assert_came_back("a character", &model, &there_and_back(&model, document.dialect));
    }

    #[test]
    fn the_other_books_file_has_all_but_the_surfaces(document in characters()) {
        let (model, _) = from_document(&document, &LineMap::default()).expect("it is sound");
        for dialect in [Dialect::D3d11, Dialect::D3d12] {
            let bytes = m3d(&model, &JointNames::default(), dialect).expect("it can be written").bytes;
            let mut again = import(&bytes).expect("what was written is read").model;
            let mut model = model.clone();
            again.materials.clear();
            model.materials.clear();
            // Files of the oldest dialect have z up, those of the books y.
            again.up_axis = model.up_axis;
            prop_assert_eq!(all_of(again), all_of(model));
        }
    }
}
