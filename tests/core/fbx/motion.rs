//! Motions: as the same file in another format has them, and when they join a character.

mod beyond;
mod made;

use bindpose::anim::{CompiledClip, PoseBuffers, skin_positions};
use bindpose::edit::{Edits, apply, common_name};
use bindpose::export::{MapImages, glb, m3d};
use bindpose::format::Dialect;
use bindpose::import::import;
use bindpose::model::{Clip, JointIndex, JointNames, Model};
use bindpose::session::{
    Command, ExportOptions, File, FileCommand, HistoryCommand, MAX_LINK_LEN, PlayCommand, Session,
};
use glam::{Affine3A, Quat, Vec3};

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
    let (mut worst, mut worst_turn, mut most_turn) = (0f32, 0f32, 0f32);
    // Both are in units of their own: one is the other's so many times, all the clip long.
    let mut scale = None;
    let clips = [&fbx, &glb].map(|model| (model, CompiledClip::new(&model.clips[0])));
    // Bones may have axes of their own in each. How they turn from where they are at first is the same.
    let first = clips.each_ref().map(|(model, clip)| posed(model, clip, times[0]));
    let turn = |first: &Affine3A, joint: &Affine3A| {
        let [first, joint] = [first, joint].map(|placed| placed.to_scale_rotation_translation().1);
        joint * first.inverse()
    };
    // The sine of half of it is exact where its cosine is nearly 1.
    let angle = |turn: Quat| 2.0 * turn.xyz().length().min(1.0).asin();
    for &secs in &times {
        let [ours, theirs] = clips.each_ref().map(|(model, clip)| posed(model, clip, secs));
        let scale = *scale.get_or_insert(reach(&ours) / reach(&theirs));
        let mut count = 0;
        for ((name, joint), (_, joint_first)) in theirs.iter().zip(&first[1]) {
            let mut ours = ours.iter().zip(&first[0]);
            let found = ours.find(|((other, _), _)| common_name(other) == common_name(name));
            let Some(((_, our), (_, our_first))) = found else {
                continue;
            };
            count += 1;
            let [turned, wanted] = [turn(our_first, our), turn(joint_first, joint)];
            worst_turn = worst_turn.max(angle(turned * wanted.inverse()));
            most_turn = most_turn.max(angle(wanted));
            let off = (Vec3::from(our.translation) / scale).distance(joint.translation.into()) / reach(&theirs);
            worst = worst.max(off);
        }
        assert!(count >= 30, "{count} joints");
    }
    assert!(worst < 1e-4, "{worst}");
    assert!(
        worst_turn < 1e-3 && most_turn > 0.05,
        "off by {worst_turn} rad, while bones turn by up to {most_turn}"
    );
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
    assert_eq!(names(&open.model.clips), ["Scene", "walking", "waving"]);
    let shown = session.clip().map(|clip| &*clip.name);
    assert_eq!(
        shown,
        Some("walking"),
        "what was given for its own sake, and not the rest pose that breathes"
    );
    let link = session.link(Vec::new(), MAX_LINK_LEN).text;
    assert_eq!(link, "clip=walking", "which who opens the character alone lacks");
    // Each bone is where the motion has it, though the character was exported in another pose.
    for (clip, file) in open.model.clips.iter().zip(["walker.fbx", "walking.fbx", "waving.fbx"]) {
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

/// The same model as `.glb`.
fn as_glb(file: &File) -> File {
    let model = import(&file.bytes).expect("it is sound").model;
    let glb = glb(&model, &JointNames::default(), &MapImages::default()).expect("it can be written");
    File::new(&file.path.replace(".fbx", ".glb"), glb.bytes)
}

/// How far the joints of two clips of a model are apart at most, and how far the first moves them.
fn apart(model: &Model, clips: [usize; 2]) -> (f32, f32) {
    let compiled = clips.map(|clip| CompiledClip::new(&model.clips[clip]));
    let (mut apart, mut way) = (0f32, 0f32);
    let starts = posed(model, &compiled[0], model.clips[clips[0]].start_secs);
    for part in 0..=10 {
        let poses = [0, 1].map(|which| {
            let clip = &model.clips[clips[which]];
            posed(
                model,
                &compiled[which],
                clip.start_secs + clip.duration_secs() * part as f32 / 10.0,
            )
        });
        for (((_, start), (_, one)), (_, other)) in starts.iter().zip(&poses[0]).zip(&poses[1]) {
            apart = apart.max(one.translation.distance(other.translation));
            way = way.max(one.translation.distance(start.translation));
        }
    }
    (apart, way)
}

#[test]
fn motions_join_characters_of_the_other_format_by_names() {
    let walking = fixture("walking.fbx");
    let both = [as_glb(&walking), walking];
    for character in [fixture("walker.fbx"), as_glb(&fixture("walker.fbx"))] {
        let mut session = Session::default();
        session.apply(FileCommand::Add(vec![character.clone()]));
        for motion in &both {
            session.apply(FileCommand::AddClips(vec![motion.clone()]));
            assert_eq!(session.error(), None, "{} {}", character.path, motion.path);
        }
        let model = &session.open_model().expect("it opened").model;
        assert_eq!(
            names(&model.clips),
            ["Scene", "walking", "walking (2)"],
            "{}",
            character.path
        );
        let (apart, way) = apart(model, [1, 2]);
        assert!(apart < 1e-3 && way > 1.0, "{}: {apart} {way}", character.path);
    }
}

#[test]
fn a_motion_of_mixamo_joins_itself_in_the_other_format() {
    let Some(folder) = crate::shared::shared("fbx/mixamo") else {
        return;
    };
    let file = |name: &str| File::new(name, std::fs::read(folder.join(name)).expect("it is there"));
    for [character, motion] in
        [["fbx", "glb"], ["glb", "fbx"]].map(|kinds| kinds.map(|kind| file(&format!("Breathing Idle.{kind}"))))
    {
        let mut session = Session::default();
        session.apply(FileCommand::Add(vec![character.clone()]));
        session.apply(FileCommand::AddClips(vec![motion]));
        assert_eq!(session.error(), None, "{}", character.path);
        let open = session.open_model().expect("it opened");
        let (apart, way) = apart(&open.model, [0, 1]);
        let size = open.size();
        assert!(
            apart < 1e-3 * size && way > 0.01 * size,
            "{}: {apart} {way} {size}",
            character.path
        );
    }
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
    assert_eq!(names(&open.model.clips), ["Scene", "walking", "waving", "other"]);
    assert_eq!(open.model.clips[3].tracks, open.model.clips[1].tracks);
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
    assert_eq!(names(&session.open_model().expect("it stays").model.clips).len(), 4);
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
    let compiled = [model, &edited.model].map(|model| CompiledClip::new(&model.clips[1]));
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

#[test]
fn what_is_written_for_the_book_has_the_palette_of_the_source() {
    let session = dropped();
    let model = &session.open_model().expect("it opened").model;
    let edits = Edits {
        for_book: true,
        ..Edits::default().in_space_of_the_books(model)
    };
    let edited = apply(model.clone(), &JointNames::default(), &edits)
        .expect("it can be made")
        .model;
    let bytes = m3d(&edited, &JointNames::default(), Dialect::D3d12)
        .expect("it can be written")
        .bytes;
    let written = import(&bytes).expect("what was written is read").model;
    assert_eq!(written.clips.len(), 3);
    let mut worst = 0f32;
    // The book's figures are turned round, of the demo's size and in its place: once for all times.
    let turned = Vec3::new(-1.0, 1.0, -1.0);
    let mut fit = None;
    for (clip, source) in written.clips.iter().zip(&model.clips) {
        let [ours, theirs] = [clip, source].map(CompiledClip::new);
        let mut poses = [&written, model].map(|model| PoseBuffers::for_skeleton(&model.skeleton));
        for part in 0..12 {
            let secs = source.start_secs + (source.end_secs - source.start_secs) * part as f32 / 11.0;
            // The book's clips begin at 0.
            poses[0].evaluate(&written.skeleton, &ours, secs - source.start_secs + clip.start_secs);
            poses[1].evaluate(&model.skeleton, &theirs, secs);
            let [mut placed, mut wanted] = [&written, model].map(|model| model.mesh.positions.clone());
            skin_positions(&written.mesh, &poses[0].palette, &mut placed);
            skin_positions(&model.mesh, &poses[1].palette, &mut wanted);
            wanted.iter_mut().for_each(|want| *want *= turned);
            let lengths = |places: &[Vec3]| places.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f32>();
            let middle = |places: &[Vec3]| places.iter().sum::<Vec3>() / places.len() as f32;
            let (scale, moved) = *fit.get_or_insert_with(|| {
                let scale = lengths(&placed) / lengths(&wanted);
                (scale, middle(&placed) - middle(&wanted) * scale)
            });
            for (place, want) in placed.iter().zip(&wanted) {
                worst = worst.max(((place - moved) / scale - want).abs().max_element());
            }
        }
    }
    assert!(worst < 1e-4, "{worst} m of a figure of 1.8 m");
}

#[test]
fn a_clip_that_is_kept_in_place_is_one_step_goes_into_links_and_exports() {
    let mut session = dropped();
    let hips = |session: &Session| {
        let open = session.open_model().expect("it is open");
        let compiled = &open.compiled[1];
        let joints = posed(&open.model, compiled, open.model.clips[1].end_secs);
        joints
            .iter()
            .find(|(name, _)| common_name(name) == "Hips")
            .expect("hips")
            .1
            .translation
    };
    let away = hips(&session);
    session.apply(PlayCommand::SelectClip(1));
    session.apply(PlayCommand::SetInPlace { clip: 0, on: true });
    assert!(session.history().undo_label().is_none(), "what breathes goes nowhere");
    session.apply(PlayCommand::SetInPlace { clip: 1, on: true });
    let kept = hips(&session);
    assert!((away - kept).with_y(0.0).length() > 1.0, "{away} {kept}");
    assert_eq!(session.view_state().playback.in_place, ["walking"]);
    let state = session.view_state();
    let written = session.export_job(&ExportOptions::default()).expect("it is open").run();
    let changes = written.expect("it can be written").plan.changes;
    assert!(changes.iter().any(|change| change.code == "in-place"), "{changes:?}");
    session.apply(HistoryCommand::Undo);
    assert_eq!(hips(&session), away);
    session.apply(HistoryCommand::Redo);
    assert_eq!(hips(&session), kept);
    session.apply(PlayCommand::SetInPlace { clip: 1, on: false });
    assert_eq!(hips(&session), away);
    let mut other = dropped();
    other.apply(Command::Restore(Box::new(state)));
    assert_eq!(hips(&other), kept);
}
