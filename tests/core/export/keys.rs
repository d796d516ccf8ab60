//! Keys of a `.glb`: as few as the source had, and the same tracks when they are read.

use bindpose::edit::{Edits, apply};
use bindpose::export::{MapImages, glb};
use bindpose::import::import;
use bindpose::model::{Channel, Clip, JointNames, LocalJoint, Model, Track};
use glam::{Quat, Vec3};
use proptest::prelude::*;
use serde_json::Value;

use super::both_ways::made;
use super::glb::{chunks, models};
use crate::documents::{REAL_FILES, arm, figure, model_of, real_file, with_translation};
use crate::gltf::moving;
use crate::gltf_files::Gltf;
use crate::shared::shared;

fn read(bytes: &[u8]) -> Model {
    import(bytes)
        .unwrap_or_else(|refused| panic!("{}", refused.error.message))
        .model
}

fn written(model: &Model) -> Vec<u8> {
    let exported = glb(model, &JointNames::default(), &MapImages::new());
    exported.expect("it can be written").bytes
}

/// Of each channel that moves a joint: node, path, and how many keys it has.
fn channels(root: &Value) -> Vec<(u64, String, u64)> {
    let mut found = Vec::new();
    for animation in root["animations"].as_array().into_iter().flatten() {
        for channel in animation["channels"].as_array().expect("channels") {
            let at = |index: &Value| index.as_u64().expect("an index") as usize;
            let sampler = &animation["samplers"][at(&channel["sampler"])];
            let count = &root["accessors"][at(&sampler["input"])]["count"];
            let path = channel["target"]["path"].as_str().expect("a path");
            if path != "weights" {
                let node = channel["target"]["node"].as_u64().expect("a node");
                found.push((node, path.to_owned(), count.as_u64().expect("a count")));
            }
        }
    }
    found
}

fn key_count(root: &Value) -> u64 {
    channels(root).iter().map(|(.., count)| count).sum()
}

/// Asserts that clips with keys have the same tracks, bone by bone; −0 is 0.
fn assert_same_tracks(name: &str, old: &Model, new: &Model) {
    let has_keys = |clip: &&Clip| clip.tracks.iter().any(Track::has_keys);
    let before: Vec<_> = old.clips.iter().filter(has_keys).collect();
    assert_eq!(before.len(), new.clips.len(), "{name}");
    for (before, after) in before.into_iter().zip(&new.clips) {
        for (bone, joint) in old.skeleton.joint_of_bone().iter().enumerate() {
            let again = &after.tracks[new.skeleton.joint_of_bone()[bone].index()];
            let track = &before.tracks[joint.index()];
            assert_eq!(track.has_keys(), again.has_keys(), "{name} {} bone {bone}", before.name);
            if track.has_keys() {
                let at = format!("{name} {} bone {bone}", before.name);
                assert_eq!(track.times_secs(), again.times_secs(), "{at}");
                for (key, &time_secs) in track.times_secs().iter().enumerate() {
                    assert_eq!(track.key(key), again.key(key), "{at} at {time_secs} s");
                }
                assert_eq!((track.holds(), track.bends()), (again.holds(), again.bends()), "{at}");
            }
        }
    }
}

/// Asserts that clips have the same channels, with the same keys. A single key beside other channels may be left out where it says what the
/// node says at rest; what it says is the track's.
fn assert_same_channels(name: &str, old: &Model, new: &Model) {
    assert_same_tracks(name, old, new);
    for (before, after) in old.clips.iter().zip(&new.clips) {
        for (bone, joint) in old.skeleton.joint_of_bone().iter().enumerate() {
            let again = &after.tracks[new.skeleton.joint_of_bone()[bone].index()];
            let (track, at) = (
                &before.tracks[joint.index()],
                format!("{name} {} bone {bone}", before.name),
            );
            if track.translation().times_secs().len() != 1 {
                assert_eq!(track.translation(), again.translation(), "{at}");
            }
            if track.rotation().times_secs().len() != 1 {
                assert_eq!(track.rotation(), again.rotation(), "{at}");
            }
            if track.scale().times_secs().len() != 1 {
                assert_eq!(track.scale(), again.scale(), "{at}");
            }
        }
    }
}

#[test]
fn what_was_read_is_written_with_its_own_keys() {
    for name in [
        "CesiumMan.glb",
        "Fox.glb",
        "RiggedSimple.glb",
        "RobotExpressive.glb",
        "SimpleSkin.gltf",
    ] {
        let Some(path) = shared(&format!("gltf/models/{name}")) else {
            return;
        };
        let source = std::fs::read(path).expect("it can be read");
        let of_source = match source.starts_with(b"glTF") {
            true => chunks(&source).0,
            false => serde_json::from_slice(&source).expect("it is JSON"),
        };
        let model = read(&source);
        let bytes = written(&model);
        let of_written = chunks(&bytes).0;
        let counts = [&of_source, &of_written].map(key_count);
        assert!(counts[1] <= counts[0], "{name}: {counts:?}");
        assert_same_channels(name, &model, &read(&bytes));
    }
}

/// Keys of a channel, at times from a list, with values of 4 or 3 numbers.
fn keyed<const N: usize>(file: &mut Gltf, times_secs: &[f32], value: impl Fn(f32) -> [f32; N]) -> [usize; 2] {
    let times: Vec<[f32; 1]> = times_secs.iter().map(|&secs| [secs]).collect();
    let values: Vec<[f32; N]> = times_secs.iter().map(|&secs| value(secs)).collect();
    [file.floats(&times), file.floats(&values)]
}

fn turned(secs: f32) -> [f32; 4] {
    let rotation = Quat::from_euler(glam::EulerRot::XYZ, secs.sin(), 0.3 * secs, (1.7 * secs).cos());
    // Files have rotations that are rounded, of either sign.
    let sign = if secs > 1.0 { -1.000_000_3 } else { 1.0 };
    rotation.to_array().map(|number| number * sign)
}

fn placed(secs: f32) -> [f32; 3] {
    [0.3 * secs, (3.0 * secs).sin(), 7.0 / (1.0 + secs)]
}

#[test]
fn channels_of_one_joint_keep_their_own_times() {
    let every = |step: f32, count: u16| (0..count).map(|key| f32::from(key) * step).collect::<Vec<f32>>();
    let file = moving(|file| {
        let mut channels = Vec::new();
        let mut add = |node, path, [times, values]: [usize; 2]| channels.push((node, path, times, values, "LINEAR"));
        // Many turns while it goes straight from place to place, and is scaled at times of its own.
        add(0, "rotation", keyed(file, &every(0.04, 100), turned));
        add(0, "translation", keyed(file, &[0.0, 1.3, 3.96], placed));
        add(0, "scale", keyed(file, &[0.51, 0.52, 3.3], placed));
        // Few turns, many places that begin later and end earlier.
        add(1, "rotation", keyed(file, &[0.0, 1.01, 2.5, 4.0], turned));
        add(1, "translation", keyed(file, &every(0.035, 60)[9..], placed));
        // It stands still for long, with keys of its own.
        add(1, "scale", keyed(file, &[0.0, 2.22, 4.0], |_| [2.0; 3]));
        channels
    });
    let model = read(&file.glb());
    let bytes = written(&model);
    let counts = |root: &Value| channels(root).into_iter().map(|(.., count)| count).collect::<Vec<_>>();
    let of_source = counts(&file.json);
    let found = counts(&chunks(&bytes).0);
    assert_eq!(of_source, [100, 3, 3, 4, 51, 3]);
    let merged: Vec<_> = model.clips[0].tracks.iter().map(Track::key_count).collect();
    assert_eq!(merged, [104, 56], "a track has all times of its channels");
    assert_eq!(found, of_source);
    assert_same_channels("own times", &model, &read(&bytes));
}

/// The model as the file has it, brought back into its own space.
fn back(model: &Model) -> Model {
    let edits = Edits {
        handedness: Some(model.handedness),
        up_axis: Some(model.up_axis),
        front: Some(model.front),
        ..Edits::default()
    };
    let again = read(&written(model));
    apply(again, &JointNames::default(), &edits)
        .expect("it can be turned")
        .model
}

/// The model with its clips as glTF has them: from 0 s on.
fn from_zero(mut model: Model) -> Model {
    for clip in &mut model.clips {
        let shift_secs = clip.start_secs.min(0.0);
        let moved = |track: &Track| match track.has_keys() && !track.holds() && !track.bends() && shift_secs < 0.0 {
            true => Track::new(track.keys().map(|(secs, joint)| (secs - shift_secs, joint))).expect("sound keys"),
            false => track.clone(),
        };
        let tracks = clip.tracks.iter().map(moved).collect();
        *clip = Clip::new(&clip.name, tracks);
    }
    model
}

#[test]
fn tracks_of_the_books_come_back_to_the_bit() {
    let real = REAL_FILES
        .iter()
        .filter_map(|name| Some(((*name).to_owned(), real_file(name)?.document)));
    let documents = real.chain([("figure".to_owned(), figure().document)]).chain(made());
    let of_documents = documents.map(|(name, document)| (name, model_of(&document).0));
    for (name, model) in of_documents.chain(models()) {
        assert_same_tracks(&name, &from_zero(model.clone()), &back(&model));
    }
}

/// A model whose joints all move as a track says.
fn with_track(track: &Track) -> Model {
    let mut model = model_of(&arm()).0;
    model.clips = vec![Clip::new("moves", vec![track.clone(); model.skeleton.joint_count()])];
    model
}

#[test]
fn a_track_of_many_keys_is_written_in_time_that_grows_with_them() {
    const KEYS: u32 = 30_000;
    let still = |_: u32| 1.0;
    // Off by roundings alone, so that no way ends for being bent.
    let noisy = |key: u32| f32::from_bits(1.0_f32.to_bits() + key.wrapping_mul(2_654_435_761) % 3);
    let straight = |key: u32| key as f32;
    let steps = |key: u32| (key / 1000 % 2) as f32;
    let values: [(&str, &dyn Fn(u32) -> f32); 4] = [
        ("still", &still),
        ("noisy", &noisy),
        ("straight", &straight),
        ("steps", &steps),
    ];
    for (name, value) in values {
        let keys = (0..KEYS).map(|key| {
            let joint = LocalJoint {
                translation: Vec3::new(value(key), 0.0, 1.0),
                rotation: Quat::from_rotation_x(1e-5 * value(key)),
                ..LocalJoint::IDENTITY
            };
            (key as f32, joint)
        });
        let model = with_track(&Track::new(keys).expect("sound keys"));
        assert_same_tracks(name, &model, &back(&model));
    }
}

#[test]
fn channels_of_rows_that_keep_still_have_one_key_or_none() {
    let times_secs = [0.0, 0.5, 1.0, 1.5, 2.0];
    let joint = |secs: f32| LocalJoint {
        translation: Vec3::splat(3.0),
        scale: Vec3::splat(1.0 + secs),
        ..LocalJoint::IDENTITY
    };
    let rows = Track::new(times_secs.map(|secs| (secs, joint(secs)))).expect("sound keys");
    let counts = |track: &Track| {
        let model = with_track(track);
        assert_same_tracks("rows", &model, &back(&model));
        let of_first = channels(&chunks(&written(&model)).0)
            .into_iter()
            .filter(|(node, ..)| *node == 0);
        of_first.map(|(_, path, count)| (path, count)).collect::<Vec<_>>()
    };
    let named = |path: &str, count| (path.to_owned(), count);
    // The rotation is that of the bone at rest.
    assert_eq!(counts(&rows), [named("translation", 1), named("scale", 5)]);
    let held = [0.0, 1.0].map(|secs| (secs, Vec3::splat(1.0 + secs)));
    let held = with_translation(&rows, Channel::held(held));
    assert_eq!(counts(&held), [named("translation", 2), named("scale", 5)]);
    let still = Track::new(times_secs.map(|secs| (secs, joint(0.0)))).expect("sound keys");
    assert_eq!(counts(&still), [named("translation", 5)]);
}

proptest! {
    #![proptest_config(crate::properties::cases(200))]

    /// Values of few kinds, so that runs, straight ways and jumps come together.
    #[test]
    fn random_tracks_come_back_to_the_bit(
        keys in prop::collection::vec((1_u8..9, 0_u8..3, 0_u8..3, 0_u8..3), 1..60),
        start_secs in -2.0_f32..2.0,
    ) {
        let mut secs = start_secs.max(0.0);
        let keys: Vec<_> = keys.into_iter().map(|(step, place, turn, size)| {
            secs += f32::from(step) * 0.0625;
            let joint = LocalJoint {
                translation: Vec3::new(if place == 2 { secs } else { f32::from(place) }, 0.1, 0.0),
                rotation: Quat::from_rotation_y(if turn == 2 { 0.1 * secs } else { 2.0 * f32::from(turn) }),
                scale: Vec3::splat(if size == 2 { 1.0 + secs } else { 1.0 }),
            };
            (secs, joint)
        }).collect();
        let model = with_track(&Track::new(keys).expect("sound keys"));
        assert_same_tracks("random", &model, &back(&model));
    }
}
