//! Motions: as the same file in another format has them, and when they join a character.

use bindpose::anim::{CompiledClip, PoseBuffers};
use bindpose::edit::{Edits, apply, common_name};
use bindpose::import::import;
use bindpose::model::{Clip, JointIndex, JointNames, Model};
use bindpose::session::{File, FileCommand, Session};
use glam::{Affine3A, Vec3};

use super::files;

/// Each named joint relative to the model at a time of a clip.
fn posed(model: &Model, clip: &CompiledClip, secs: f32) -> Vec<(String, Affine3A)> {
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    pose.evaluate(&model.skeleton, clip, secs);
    let joints = (0..model.skeleton.joint_count()).map(|joint| JointIndex(joint as u32));
    joints
        .filter_map(|joint| Some((model.skeleton.name(joint)?.to_owned(), pose.model.0[joint.index()])))
        .collect()
}

#[test]
fn a_motion_of_mixamo_poses_as_its_gltf() {
    let Some((_, fbx)) = files("mixamo")
        .into_iter()
        .find(|(name, _)| name == "Breathing Idle.fbx")
    else {
        return;
    };
    let glb = std::fs::read(crate::shared::shared("fbx/mixamo/Breathing Idle.glb").expect("it is beside"))
        .expect("it is beside");
    let [fbx, glb] = [fbx, glb].map(|bytes| import(&bytes).expect("it is sound").model);
    let times = glb.clips[0]
        .tracks
        .iter()
        .find(|track| track.has_keys())
        .expect("it moves")
        .times_secs()
        .to_vec();
    assert!(times.len() > 50, "{}", times.len());
    let reach = |joints: &[(String, Affine3A)]| {
        let hips = joints
            .iter()
            .find(|(name, _)| name.ends_with("Hips"))
            .expect("hips")
            .1
            .translation;
        joints
            .iter()
            .map(|(_, joint)| joint.translation.distance(hips))
            .fold(0.0, f32::max)
    };
    let mut worst = 0f32;
    let clips = [&fbx, &glb].map(|model| (model, CompiledClip::new(&model.clips[0])));
    for &secs in &times {
        let [ours, theirs] = clips.each_ref().map(|(model, clip)| posed(model, clip, secs));
        let scale = reach(&ours) / reach(&theirs);
        let mut count = 0;
        for (name, joint) in &theirs {
            let Some((_, our)) = ours.iter().find(|(other, _)| common_name(other) == common_name(name)) else {
                continue;
            };
            count += 1;
            let off = (Vec3::from(our.translation) / scale).distance(joint.translation.into()) / reach(&theirs);
            worst = worst.max(off);
        }
        assert!(count >= 30, "{count} joints");
    }
    assert!(worst < 1e-4, "{worst}");
}

/// A character and two motions without a mesh, which assets/blender/motions.py makes.
fn fixture(name: &str) -> File {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/fixtures/fbx")
        .join(name);
    File::new(name, std::fs::read(path).expect("it is there"))
}

fn names(clips: &[Clip]) -> Vec<&str> {
    clips.iter().map(|clip| clip.name.as_str()).collect()
}

/// A session with the character and its motions, dropped together.
fn dropped() -> Session {
    let mut session = Session::default();
    session.apply(FileCommand::Add(
        ["waving.fbx", "walker.fbx", "walking.fbx"].map(fixture).into(),
    ));
    session
}

#[test]
fn a_character_and_its_motions_open_as_one_model() {
    let session = dropped();
    let open = session.open_model().expect("it opened");
    assert_eq!(open.file.path, "walker.fbx");
    assert_eq!(names(&open.model.clips), ["walking", "waving"]);
    // Each bone is where the motion has it, though the character was exported in another pose.
    for (clip, file) in open.model.clips.iter().zip(["walking.fbx", "waving.fbx"]) {
        let motion = import(&fixture(file).bytes).expect("it is sound").model;
        let compiled = [CompiledClip::new(clip), CompiledClip::new(&motion.clips[0])];
        for part in 0..=10 {
            let secs = clip.end_secs * part as f32 / 10.0;
            let [ours, theirs] = [
                posed(&open.model, &compiled[0], secs),
                posed(&motion, &compiled[1], secs),
            ];
            for (name, joint) in &theirs {
                let (_, our) = ours.iter().find(|(other, _)| other == name).expect("both have it");
                assert!(
                    our.abs_diff_eq(*joint, 2e-4),
                    "{file}, {secs} s, {name}: {our:?} {joint:?}"
                );
            }
        }
    }
    assert_eq!(
        session
            .diagnostics()
            .filter(|finding| finding.code == "clips-by-names")
            .count(),
        0
    );
}

#[test]
fn a_motion_joins_bones_of_other_prefixes_and_tells_what_does_not_fit() {
    let mut session = dropped();
    let renamed = |from: &str, to: &str| {
        let mut file = fixture("walking.fbx");
        let text = file.bytes.to_vec();
        let at: Vec<usize> = memchr::memmem::find_iter(&text, from).collect();
        assert!(!at.is_empty());
        let mut text = text;
        at.into_iter()
            .for_each(|at| text[at..at + to.len()].copy_from_slice(to.as_bytes()));
        file.bytes = text.into();
        file.path = "other.fbx".to_owned();
        file
    };
    session.apply(FileCommand::AddClips(vec![renamed("mixamorig:", "mixamorig7")]));
    let open = session.open_model().expect("it is open");
    assert_eq!(names(&open.model.clips), ["walking", "waving", "other"]);
    assert_eq!(open.model.clips[2].tracks, open.model.clips[0].tracks);
    session.apply(FileCommand::AddClips(vec![renamed(
        "mixamorig:Spine",
        "mixamorig:Spire",
    )]));
    let told: Vec<&str> = session
        .diagnostics()
        .filter(|finding| finding.code == "clips-by-names")
        .map(|finding| &*finding.message)
        .collect();
    assert_eq!(
        told,
        [
            "1 bone of other.fbx is not in walker.fbx: mixamorig:Spire; 1 bone of walker.fbx is not in other.fbx and at rest: mixamorig:Spine."
        ]
    );
    session.apply(FileCommand::AddClips(vec![renamed("mixamorig:", "otherrig:_")]));
    let error = session.error().expect("it is refused");
    assert_eq!(error.diagnostic.code, "clips-bones-differ");
    assert_eq!(names(&session.open_model().expect("it stays").model.clips).len(), 3);
}

#[test]
fn a_clip_in_place_keeps_its_height_and_its_turns() {
    let session = dropped();
    let model = &session.open_model().expect("it opened").model;
    let edits = Edits {
        in_place: vec!["walking".to_owned(), "waving".to_owned()],
        ..Edits::default()
    };
    let edited = apply(model.clone(), &JointNames::default(), &edits).expect("it can be made");
    let told: Vec<&str> = edited.changes.iter().map(|change| change.code).collect();
    assert_eq!(told, ["in-place"], "what waves goes nowhere");
    let compiled = [model, &edited.model].map(|model| CompiledClip::new(&model.clips[0]));
    let hips = |model: &Model, clip: &CompiledClip, secs: f32| {
        let joints = posed(model, clip, secs);
        joints
            .iter()
            .find(|(name, _)| common_name(name) == "Hips")
            .expect("hips")
            .1
    };
    let start = hips(model, &compiled[0], 0.0).translation;
    let mut furthest = 0f32;
    for part in 0..=20 {
        let secs = part as f32 / 20.0;
        let [before, after] = [hips(model, &compiled[0], secs), hips(&edited.model, &compiled[1], secs)];
        furthest = furthest.max(before.translation.distance(start));
        assert!((after.translation - start).with_y(0.0).length() < 1e-4, "{secs}");
        assert!((after.translation.y - before.translation.y).abs() < 1e-4, "{secs}");
        assert!(after.matrix3.abs_diff_eq(before.matrix3, 1e-4), "{secs}");
    }
    assert!(furthest > 1.0, "it walks: {furthest}");
    let wrong = Edits {
        in_place: vec!["flying".to_owned()],
        ..Edits::default()
    };
    assert!(apply(model.clone(), &JointNames::default(), &wrong).is_err());
}
