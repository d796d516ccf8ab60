//! Axes and sizes.

use bindpose::edit::{EditError, Edits};
use bindpose::model::{Front, Handedness, Model, UpAxis};

use super::{apart, curved, edit, figure, key_times, seen, size, swaying, try_edit};
use crate::documents::model_of;
use crate::rigs;

fn models() -> [(&'static str, Model); 3] {
    [("figure", figure()), ("curved", curved()), ("rig", rigs::model(12))]
}

fn spaces() -> impl Iterator<Item = Edits> {
    Handedness::ALL.into_iter().flat_map(|handedness| {
        UpAxis::ALL.into_iter().flat_map(move |up_axis| {
            Front::ALL.into_iter().map(move |front| Edits {
                handedness: Some(handedness),
                up_axis: Some(up_axis),
                front: Some(front),
                ..Edits::default()
            })
        })
    })
}

#[test]
fn the_world_sees_the_same_in_every_space_at_every_key() {
    for (name, model) in models() {
        for edits in spaces() {
            let turned = edit(&model, &edits).model;
            assert_eq!(Some(turned.handedness), edits.handedness);
            assert_eq!(Some(turned.up_axis), edits.up_axis);
            assert_eq!(turned.mesh.indices, model.mesh.indices);
            for (index, clip) in model.clips.iter().enumerate() {
                let times = key_times(clip);
                for &secs in times.iter().step_by(times.len() / 12 + 1).chain(times.last()) {
                    let (old, new) = (seen(&model, index, secs), seen(&turned, index, secs));
                    let off = apart(&old.positions, &new.positions);
                    assert!(off <= 1e-5 * size(&model), "{name} {edits:?} at {secs} s: {off}");
                    assert!(apart(&old.normals, &new.normals) < 1e-4, "{name} {edits:?}");
                    for ((old, new), (n, m)) in old
                        .tangents
                        .iter()
                        .zip(&new.tangents)
                        .zip(old.normals.iter().zip(&new.normals))
                    {
                        let bitangents = [n.cross(old.truncate()) * old.w, m.cross(new.truncate()) * new.w];
                        assert!(bitangents[0].distance(bitangents[1]) < 1e-4, "{name} {edits:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn there_and_back_is_the_same_model_to_the_bit() {
    for (name, model) in models() {
        for edits in spaces() {
            let there = edit(&model, &edits).model;
            let back = Edits {
                handedness: Some(model.handedness),
                up_axis: Some(model.up_axis),
                front: Some(model.front),
                ..Edits::default()
            };
            let back = edit(&there, &back).model;
            assert_eq!(back.mesh.positions, model.mesh.positions, "{name}");
            assert_eq!(back.mesh.tangents, model.mesh.tangents, "{name}");
            assert_eq!(
                back.skeleton.joint_from_bind(),
                model.skeleton.joint_from_bind(),
                "{name}"
            );
            assert_eq!(back.skeleton.rest(), model.skeleton.rest(), "{name}");
            for (new, old) in back.clips.iter().zip(&model.clips) {
                for (new, old) in new.tracks.iter().zip(&old.tracks) {
                    assert_eq!(new.translation(), old.translation(), "{name}");
                    assert_eq!(new.scale(), old.scale(), "{name}");
                    let (new, old) = (new.rotation(), old.rotation());
                    assert_eq!((new.way(), new.times_secs()), (old.way(), old.times_secs()), "{name}");
                    let mut turns = new.values().iter().zip(old.values());
                    assert!(turns.all(|(new, old)| new.abs_diff_eq(*old, 1e-7)), "{name}");
                }
            }
        }
    }
}

#[test]
fn a_space_that_is_there_already_changes_nothing() {
    let model = figure();
    let edits = Edits {
        handedness: Some(model.handedness),
        up_axis: Some(model.up_axis),
        front: Some(model.front),
        scale: Some(1.0),
        ..Edits::default()
    };
    let edited = edit(&model, &edits);
    assert_eq!(edited.changes, []);
    assert_eq!(edited.model.clips, model.clips);
}

#[test]
fn changes_of_space_are_told() {
    let (model, _) = crate::documents::model_of(&super::swaying(3, 1.0));
    let edits = Edits {
        handedness: Some(Handedness::Right),
        up_axis: Some(UpAxis::Z),
        scale: Some(2.5),
        ..Edits::default()
    };
    let edited = edit(&model, &edits);
    let told: Vec<_> = edited
        .changes
        .iter()
        .map(|change| (change.code, change.message.as_str()))
        .collect();
    let expected = [
        ("up-axis-changed", "z is up, not y."),
        ("handedness-changed", "It is right-handed, not left-handed."),
        ("scaled", "All lengths are multiplied by 2.5."),
    ];
    assert_eq!(told, expected);
}

#[test]
fn a_scale_multiplies_every_position_at_every_key() {
    for (name, model) in models() {
        for factor in [0.01, 3.0, 100.0] {
            let edits = Edits {
                scale: Some(factor),
                ..Edits::default()
            };
            let scaled = edit(&model, &edits).model;
            for (index, clip) in model.clips.iter().enumerate() {
                let times = key_times(clip);
                for &secs in times.iter().step_by(times.len() / 12 + 1) {
                    let mut old = seen(&model, index, secs).positions;
                    old.iter_mut().for_each(|position| *position *= factor);
                    let off = apart(&old, &seen(&scaled, index, secs).positions);
                    assert!(
                        off <= 1e-5 * factor * size(&model),
                        "{name} × {factor} at {secs} s: {off}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_scale_that_is_none_is_refused() {
    for factor in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let edits = Edits {
            scale: Some(factor),
            ..Edits::default()
        };
        let refused = try_edit(&curved(), &edits).expect_err("no scale");
        assert_eq!(
            refused.to_string(),
            format!("The factor of a scale cannot be {factor}.")
        );
    }
    let edits = Edits {
        scale: Some(f32::MAX),
        ..Edits::default()
    };
    let refused = try_edit(&figure(), &edits).expect_err("too large");
    assert!(matches!(refused, EditError::Overflows(_)), "{refused}");
}

#[test]
fn triangles_of_gltf_wind_as_the_hand_that_is_asked_for() {
    let mut model = figure();
    model.handedness = Handedness::Left;
    let old = model.mesh.indices.clone();
    assert_eq!(edit(&model, &Edits::default()).model.mesh.indices, old, "nobody asked");
    let asked = Edits {
        handedness: Some(Handedness::Left),
        ..Edits::default()
    };
    let edited = edit(&model, &asked);
    assert_eq!(edited.changes[0].code, "winding-changed");
    for (old, new) in old.chunks_exact(3).zip(edited.model.mesh.indices.chunks_exact(3)) {
        assert_eq!(new, [old[0], old[2], old[1]]);
    }
    assert_eq!(edit(&edited.model, &asked).changes, []);
}

/// A bone that is flat in the bind pose, and rests far away.
#[test]
fn lengths_that_overflow_at_rest_are_refused_with_their_bone() {
    let (mut model, _) = model_of(&swaying(3, 1.0));
    let mut rest = model.skeleton.rest().to_vec();
    rest[2].translation = glam::Vec3::splat(1e12);
    model.skeleton = model.skeleton.with_rest(&rest);
    let scaled = Edits {
        scale: Some(1e28),
        ..Edits::default()
    };
    let refused = try_edit(&model, &scaled).expect_err("it overflows");
    assert_eq!(
        refused.to_string(),
        "Numbers of the model overflow when it is changed so: Bone 2 is too far away at rest."
    );
}

/// Where no rest is told of, none is told of afterwards.
#[test]
fn a_rest_in_the_bind_pose_stays_one() {
    let (model, _) = model_of(&swaying(3, 1.0));
    assert!(model.skeleton.rests_in_bind_pose());
    for edits in spaces().chain([Edits {
        scale: Some(3.0),
        ..Edits::default()
    }]) {
        assert!(edit(&model, &edits).model.skeleton.rests_in_bind_pose(), "{edits:?}");
    }
}
