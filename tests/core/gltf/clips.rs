//! Clips: channels with times of their own, and ways between keys.

use bindpose::model::Way;
use glam::{Quat, Vec3};
use serde_json::{Value, json};

use super::{assert_at, bare, codes_of, posed, read};
use crate::gltf_files::Gltf;

/// A triangle on node 1, which is below node 0, with one animation; `samplers` are (path, times, output accessor, interpolation).
pub(crate) fn moving(samplers: impl FnOnce(&mut Gltf) -> Vec<(u32, &'static str, usize, usize, &'static str)>) -> Gltf {
    let mut file =
        bare(&json!({ "nodes": [{ "name": "arm", "children": [1] }, { "mesh": 0, "translation": [0.0, 1.0, 0.0] }] }));
    let samplers = samplers(&mut file);
    let channel = |(index, (node, path, ..)): (usize, &(u32, &str, usize, usize, &str))| json!({ "sampler": index, "target": { "node": node, "path": path } });
    let channels: Vec<Value> = samplers.iter().enumerate().map(channel).collect();
    let samplers: Vec<Value> = samplers
        .iter()
        .map(|(_, _, input, output, way)| json!({ "input": input, "output": output, "interpolation": way }))
        .collect();
    file.json["animations"] = json!([{ "name": "Wave", "channels": channels, "samplers": samplers }]);
    file
}

#[test]
fn a_clip_moves_a_mesh_without_a_skin_and_what_is_above_it() {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let file = moving(|file| {
        let times = file.floats(&[[1.0], [2.0]]);
        let turn = file.floats(&[[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, half, half]]);
        let other_times = file.floats(&[[0.0], [1.5], [3.0]]);
        let steps = file.floats(&[[0.0, 1.0, 0.0], [0.0, 2.5, 0.0], [0.0, 4.0, 0.0]]);
        vec![
            (0, "rotation", times, turn, "LINEAR"),
            (1, "translation", other_times, steps, "LINEAR"),
        ]
    });
    let imported = read(&file);
    let model = &imported.model;
    assert_eq!(model.skeleton.joint_count(), 2);
    assert_at(&posed(model, 0.0), &[[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 3.0, 0.0]]);
    // Turned by a quarter about z: (x, y) becomes (−y, x).
    assert_at(
        &posed(model, 3.0),
        &[[-4.0, 0.0, 0.0], [-4.0, 1.0, 0.0], [-6.0, 0.0, 0.0]],
    );
    // Half of the quarter at 1.5, on its way at even speed.
    let turned = Quat::from_rotation_z(std::f32::consts::FRAC_PI_4) * Vec3::new(0.0, 2.5, 0.0);
    assert_at(&posed(model, 1.5)[..1], &[turned.to_array()]);
    let clip = &model.clips[0];
    assert_eq!(
        (clip.name.as_str(), clip.start_secs, clip.end_secs, clip.key_count),
        ("Wave", 0.0, 3.0, 5)
    );
    assert!(clip.tracks.iter().all(|track| !track.holds() && !track.bends()));
}

#[test]
fn channels_of_one_joint_have_their_own_times_and_rotations_go_the_shorter_way() {
    let file = moving(|file| {
        let times = file.floats(&[[0.0], [1.0]]);
        // The same rotation with the other sign, and a turn of 60° the shorter way.
        let turn = Quat::from_rotation_y(-std::f32::consts::FRAC_PI_3);
        let turns = file.floats(&[[0.0, 0.0, 0.0, 1.0], (-turn).to_array()]);
        let other_times = file.floats(&[[0.25], [0.5], [0.75]]);
        let scales = file.floats(&[[1.0, 1.0, 1.0], [3.0, 1.0, 1.0], [1.0, 1.0, 1.0]]);
        vec![
            (1, "rotation", times, turns, "LINEAR"),
            (1, "scale", other_times, scales, "LINEAR"),
        ]
    });
    let track = read(&file).model.clips[0].tracks[1].clone();
    assert_eq!(track.times_secs(), [0.0, 0.25, 0.5, 0.75, 1.0]);
    for part in [0.0, 0.1, 0.25, 0.4, 0.5, 0.9, 1.0_f32] {
        let joint = track.at(part);
        let expected = Quat::from_rotation_y(-std::f32::consts::FRAC_PI_3 * part);
        assert!(joint.rotation.dot(expected).abs() > 1.0 - 1e-6, "{part}");
        let scale = 1.0 + 2.0 * (1.0 - (part - 0.5).abs() * 4.0).max(0.0);
        assert!((joint.scale.x - scale).abs() < 1e-5, "{part}");
        assert_eq!(joint.translation, Vec3::Y, "what no channel moves is at rest");
    }
}

#[test]
fn steps_and_splines_are_kept_as_such() {
    let file = moving(|file| {
        let times = file.floats(&[[0.0], [1.0], [2.0]]);
        let held = file.floats(&[[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]]);
        // In-tangent, value, out-tangent of each key.
        let spline = file.floats(&[
            [0.0; 3],
            [1.0, 1.0, 1.0],
            [2.0, 0.0, 0.0],
            [0.0; 3],
            [2.0, 1.0, 1.0],
            [0.0, 0.0, 0.0],
            [-1.0, 0.0, 0.0],
            [2.0, 1.0, 1.0],
            [0.0; 3],
        ]);
        vec![
            (1, "translation", times, held, "STEP"),
            (1, "scale", times, spline, "CUBICSPLINE"),
        ]
    });
    let track = read(&file).model.clips[0].tracks[1].clone();
    assert!(!track.rotation().has_keys());
    assert_eq!(*track.translation().way(), Way::Held);
    assert!(matches!(track.scale().way(), Way::Spline(_)));
    let x = |time_secs| (track.at(time_secs).translation.x, track.at(time_secs).scale.x);
    assert_eq!(x(0.999).0, 1.0);
    assert_eq!(x(1.0).0, 2.0);
    // 2t³ − 3t² + 1 = ½ of 1, ½ of 2, and t³ − 2t² + t = ⅛ of the slope 2.
    assert!((x(0.5).1 - 1.75).abs() < 1e-6);
    // Both ends 2, and t³ − t² = −⅛ of the slope −1.
    assert!((x(1.5).1 - 2.125).abs() < 1e-6);
}

#[test]
fn keys_that_are_out_of_order_doubled_or_no_numbers_are_mended_and_told() {
    let file = moving(|file| {
        let times = file.floats(&[[1.0], [0.0], [1.0], [f32::NAN], [2.0]]);
        let values = file.floats(&[[1.0, 0.0, 0.0], [0.0; 3], [5.0, 0.0, 0.0], [9.0; 3], [6.0, 0.0, 0.0]]);
        let turn_times = file.floats(&[[0.0], [1.0]]);
        let turns = file.floats(&[[0.0, 0.0, 0.0, 2.0], [0.0; 4]]);
        vec![
            (1, "translation", times, values, "LINEAR"),
            (0, "rotation", turn_times, turns, "LINEAR"),
        ]
    });
    let imported = read(&file);
    let track = &imported.model.clips[0].tracks[1];
    assert_eq!(track.times_secs(), [0.0, 1.0, 1.0_f32.next_up(), 2.0]);
    assert_eq!(
        track
            .translation()
            .values()
            .iter()
            .map(|place| place.x)
            .collect::<Vec<_>>(),
        [0.0, 1.0, 5.0, 6.0]
    );
    let mut codes = codes_of(&imported);
    codes.sort_unstable();
    assert_eq!(
        codes,
        [
            "gltf-normals-absent",
            "keys-at-equal-times",
            "keys-not-finite",
            "keys-not-sorted",
            "rotation-not-unit",
            "rotation-zero"
        ]
    );
}

#[test]
fn what_no_joint_has_is_left_out_and_told() {
    let mut file = moving(|file| {
        let times = file.floats(&[[0.0], [1.0]]);
        let values = file.floats(&[[0.0; 3], [1.0; 3]]);
        let weights = file.floats(&[[0.0], [1.0]]);
        vec![
            (1, "translation", times, values, "LINEAR"),
            (1, "weights", times, weights, "LINEAR"),
            (2, "scale", times, values, "STEP"),
        ]
    });
    file.json["nodes"]
        .as_array_mut()
        .expect("a list")
        .push(json!({ "camera": 0 }));
    file.json["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 1.0, "znear": 0.1 } }]);
    let imported = read(&file);
    let mut codes = codes_of(&imported);
    codes.sort_unstable();
    assert_eq!(
        codes,
        [
            "gltf-channel-left-out",
            "gltf-morph-animation-left-out",
            "gltf-normals-absent"
        ]
    );
    // An animation of nothing else is no clip.
    file.json["animations"][0]["channels"]
        .as_array_mut()
        .expect("a list")
        .remove(0);
    assert!(read(&file).model.clips.is_empty());
}
