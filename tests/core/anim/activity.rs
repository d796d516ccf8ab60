//! How much each joint moves.

use bindpose::anim::activity;
use bindpose::format::Keyframe;
use bindpose::import::m3d;
use bindpose::model::Model;

use crate::documents::{REAL_FILES, arm, key, model_of, real_file, track, turned};
use crate::rigs::{self, JOINT_COUNTS};

const UP: [f32; 3] = [0.0, 1.0, 0.0];

#[test]
fn ways_are_summed_and_compared_with_the_longest() {
    let mut document = arm();
    // There and back by 1, then a quarter turn there and back, then nothing.
    document.clips[0].bones = vec![
        track([key(0.0, [0.0; 3]), key(0.5, [1.0, 0.0, 0.0]), key(1.0, [0.0; 3])]),
        track([key(0.0, UP), turned(key(0.5, UP), 1.0), key(1.0, UP)]),
        track([key(0.0, UP), key(0.5, UP)]),
    ];
    let (model, _) = model_of(&document);
    let joints = activity(&model.skeleton, &model.clips[0], 2.0);
    let [shifted, turned, still] = &joints[..] else {
        panic!("three joints")
    };
    assert!((shifted.path - 2.0).abs() < 1e-6 && shifted.turned_degrees == 0.0 && shifted.fraction == 1.0);
    assert!((turned.turned_degrees - 2.0_f32.to_degrees()).abs() < 1e-3 && turned.path == 0.0);
    // Two radians at a tenth of the size, beside a way of two units.
    assert!((turned.fraction - 2.0 * 0.1 * 2.0 / 2.0).abs() < 1e-5, "{turned:?}");
    assert!(still.constant && still.fraction == 0.0 && !turned.constant && !shifted.constant);
}

#[test]
fn what_files_round_is_no_motion_and_what_comes_back_is() {
    let mut document = arm();
    let nearly = |time_secs, x: f32| key(time_secs, [x, 1.0, 0.0]);
    document.clips[0].bones = vec![
        track([nearly(0.0, 0.0), nearly(0.5, 0.000_004), nearly(1.0, -0.000_004)]),
        track([
            key(0.0, UP),
            Keyframe {
                scale: [1.0, 1.2, 1.0],
                ..key(0.5, UP)
            },
            key(1.0, UP),
        ]),
        track([]),
    ];
    let (model, _) = model_of(&document);
    let joints = activity(&model.skeleton, &model.clips[0], 2.0);
    assert_eq!(
        joints.iter().map(|joint| joint.constant).collect::<Vec<_>>(),
        [true, false, true]
    );
    assert_eq!(
        joints.iter().map(|joint| joint.fraction).collect::<Vec<_>>(),
        [0.0, 1.0, 0.0]
    );
    assert!((joints[1].scaled - 2.0 * 0.2 / 1.2).abs() < 1e-6, "{:?}", joints[1]);
}

#[test]
fn a_clip_in_which_nothing_moves_has_fractions_of_zero() {
    for bones in JOINT_COUNTS {
        let model = rigs::model(bones);
        let still = activity(&model.skeleton, &model.clips[1], 5.0);
        assert_eq!(still.len(), bones as usize);
        assert!(still.iter().all(|joint| joint.constant && joint.fraction == 0.0));
    }
}

#[test]
fn fractions_are_fractions_in_every_clip() {
    let mut models: Vec<Model> = JOINT_COUNTS.map(rigs::model).into();
    models.extend(REAL_FILES.iter().filter_map(|name| {
        let parsed = real_file(name)?;
        Some(m3d::from_parsed(&parsed).expect("sound").0)
    }));
    for model in &models {
        for clip in &model.clips {
            let joints = activity(&model.skeleton, clip, 5.0);
            assert_eq!(joints.len(), model.skeleton.joint_count());
            let most = joints.iter().map(|joint| joint.fraction).fold(0.0, f32::max);
            let moves = joints.iter().any(|joint| !joint.constant);
            assert_eq!(most, if moves { 1.0 } else { 0.0 }, "{}", clip.name);
            for (joint, track) in joints.iter().zip(&clip.tracks) {
                assert!((0.0..=1.0).contains(&joint.fraction) && joint.constant == (joint.fraction == 0.0));
                assert!(joint.constant || track.key_count() > 1);
            }
        }
    }
}
