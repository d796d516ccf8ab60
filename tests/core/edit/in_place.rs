//! Clips that stay over where they start: which joint is held, and what goes on as before.

use bindpose::anim::{CompiledClip, PoseBuffers};
use bindpose::edit::{Edits, leads_away};
use bindpose::format::Keyframe;
use bindpose::model::{Model, UpAxis};
use glam::{Quat, Vec3};

use super::edit;
use crate::documents::{key, model_of, track};
use crate::rigs;

/// Where a joint is in the model at a time of the only clip.
fn place(model: &Model, joint: usize, secs: f32) -> Vec3 {
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    pose.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), secs);
    pose.model.0[joint].translation.into()
}

/// A model of 12 bones whose second walks along all axes and whose third sways; the first has these keys.
fn walker(root: &[Keyframe]) -> Model {
    let steps = |place: fn(f32) -> [f32; 3]| {
        track(
            (0..=4)
                .map(|step| key(step as f32, place(step as f32)))
                .collect::<Vec<_>>(),
        )
    };
    let mut clip = rigs::single("walk", 12);
    clip.bones[0] = track(root);
    clip.bones[1] = steps(|step| [step, 0.5 + step * 0.25, step * 2.0]);
    clip.bones[2] = steps(|step| [(step % 2.0) * 0.3, 0.5, 0.0]);
    model_of(&rigs::rig(12, vec![clip])).0
}

#[test]
fn the_topmost_joint_that_goes_somewhere_is_held_and_those_above_that_stand_still_are_not() {
    let still = |secs: f32| key(secs, [3.0, 1.0, 2.0]);
    let turned = Keyframe {
        rotation: Quat::from_rotation_x(std::f32::consts::FRAC_PI_2).to_array(),
        ..still(0.5)
    };
    let rising = [key(0.0, [3.0, 1.0, 2.0]), key(4.0, [3.0, 2.0, 2.0])];
    for root in [&[][..], &[still(0.5)], &[still(0.0), still(4.0)], &[turned], &rising] {
        let model = walker(root);
        assert_eq!(model.up_axis, UpAxis::Y);
        let edits = Edits {
            in_place: vec!["walk".to_owned(); 2],
            ..Edits::default()
        };
        let edited = edit(&model, &edits);
        let told: Vec<&str> = edited.changes.iter().map(|change| change.code).collect();
        assert_eq!(told, ["in-place"], "{root:?}");
        let [before, after] = [&model, &edited.model].map(|model| &model.clips[0].tracks);
        for joint in (0..12).filter(|&joint| joint != 1) {
            assert_eq!(before[joint], after[joint], "{root:?}: joint {joint}");
        }
        let start = place(&model, 1, 0.0);
        for secs in [0.0, 0.5, 1.75, 4.0] {
            let wanted = start.with_y(place(&model, 1, secs).y);
            let found = place(&edited.model, 1, secs);
            assert!(found.abs_diff_eq(wanted, 1e-4), "{root:?}, {secs} s: {found} {wanted}");
        }
        assert!(place(&model, 1, 4.0).distance(start) > 4.0, "it walks");
    }
}

#[test]
fn an_arm_that_is_pulled_leads_nobody_away() {
    let leads = |bone: usize| {
        let mut clip = rigs::single("pull", 12);
        clip.bones[bone] = track([key(0.0, [0.0, 0.5, 0.0]), key(1.0, [2.0, 0.5, 0.0])]);
        let model = model_of(&rigs::rig(12, vec![clip])).0;
        leads_away(&model, &model.clips[0])
    };
    assert!(leads(1), "all but three bones go with it");
    assert!(!leads(10), "one bone goes with it");
}

#[test]
fn how_far_a_root_stands_from_the_origin_says_nothing_of_its_way() {
    let leads = |far: f32| {
        let mut clip = rigs::single("walk", 12);
        clip.bones[0] = track([key(0.0, [far, 0.0, 0.0]), key(1.0, [far + 2.0, 0.0, 0.0])]);
        let mut document = rigs::rig(12, vec![clip]);
        for offset in &mut document.bone_offsets {
            offset[12] = -far;
        }
        let model = model_of(&document).0;
        leads_away(&model, &model.clips[0])
    };
    assert_eq!([0.0, 1_000.0].map(leads), [true; 2]);
}
