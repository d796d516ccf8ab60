//! Many instances at once against one at a time, to the bit.

use bindpose::anim::{ClipPose, CompiledClip, CrowdPalettes, PoseBuffers};
use bindpose::model::Model;
use glam::Affine3A;
use proptest::prelude::*;

use crate::rigs;

type Wanted = (Option<usize>, f32);

fn bits(palette: &[Affine3A]) -> Vec<[u32; 12]> {
    let matrices = palette.iter();
    matrices
        .map(|matrix| matrix.to_cols_array().map(f32::to_bits))
        .collect()
}

/// The palette of a single character.
fn single(model: &Model, clips: &[CompiledClip], bind_weight: f32, (clip, time_secs): Wanted) -> Vec<[u32; 12]> {
    let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
    if let Some(clip) = clip.and_then(|clip| clips.get(clip)) {
        buffers.evaluate(&model.skeleton, clip, time_secs);
        buffers.bring_toward_bind(&model.skeleton, bind_weight);
    }
    bits(&buffers.palette.0)
}

fn poses(wanted: &[Wanted]) -> Vec<ClipPose> {
    let poses = wanted.iter();
    poses.map(|&(clip, time_secs)| ClipPose::new(clip, time_secs)).collect()
}

/// The palette of each instance.
fn of_instances(crowd: &CrowdPalettes, joints: usize) -> Vec<Vec<[u32; 12]>> {
    let palette = |&slot: &u32| bits(&crowd.palettes()[slot as usize * joints..][..joints]);
    crowd.slots().iter().map(palette).collect()
}

fn wanted() -> impl Strategy<Value = Wanted> {
    let time_secs = prop_oneof![
        4 => -1.0_f32..6.0,
        // Equal ones among them.
        3 => prop::sample::select(vec![0.0, -0.0, 0.5, 3.0, 1e9, f32::NAN]),
    ];
    (prop::option::weighted(0.9, 0..4_usize), time_secs)
}

fn weight() -> impl Strategy<Value = f32> {
    prop_oneof![3 => Just(0.0_f32), 1 => 0.0_f32..1.0, 1 => Just(1.0)]
}

proptest! {
    #![proptest_config(crate::properties::cases(64))]

    /// One update after another, so that poses that stay and slots that are used again are among them.
    #[test]
    fn every_instance_has_the_palette_of_a_single_character(
        bones in 1_u32..13,
        updates in prop::collection::vec((weight(), prop::collection::vec(wanted(), 0..24)), 1..5),
    ) {
        let model = rigs::model(bones);
        let clips = CompiledClip::all(&model.clips);
        let mut crowd = CrowdPalettes::default();
        for (bind_weight, wanted) in updates {
            crowd.update(&model.skeleton, &clips, bind_weight, &poses(&wanted));
            let palettes = of_instances(&crowd, bones as usize);
            prop_assert_eq!(palettes.len(), wanted.len());
            for (palette, &wanted) in palettes.iter().zip(&wanted) {
                prop_assert_eq!(palette, &single(&model, &clips, bind_weight, wanted), "{:?}", wanted);
            }
        }
    }
}

#[test]
fn equal_poses_are_computed_once_and_those_that_stay_not_again() {
    let model = rigs::model(20);
    let clips = CompiledClip::all(&model.clips);
    let mut crowd = CrowdPalettes::default();
    let mut update = |wanted: &[Wanted]| {
        let before = crowd.posed();
        crowd.update(&model.skeleton, &clips, 0.0, &poses(wanted));
        (crowd.posed() - before, crowd.palettes().len() / 20)
    };
    assert_eq!(update(&[(Some(0), 0.5); 100]), (1, 1));
    assert_eq!(update(&[(Some(0), 0.5), (Some(2), 3.5), (Some(2), 0.5)]), (2, 3));
    assert_eq!(update(&[(Some(2), 0.5), (Some(0), 0.5), (Some(2), 3.5)]), (0, 3));
    assert_eq!(update(&[(Some(2), 3.6), (Some(0), 0.5), (Some(2), 3.7)]), (2, 3));
    assert_eq!(update(&[(None, 1.0), (None, 2.0), (Some(9), 2.0)]), (2, 2));
    assert_eq!(update(&[]), (0, 0));
}

/// What stays keeps its palette even where every other slot is used again.
#[test]
fn a_kept_palette_is_nobody_elses() {
    let model = rigs::model(8);
    let clips = CompiledClip::all(&model.clips);
    let mut crowd = CrowdPalettes::default();
    let kept = (Some(2), 3.25);
    for round in 0..50_u8 {
        let mut wanted: Vec<Wanted> = (0..12_u8)
            .map(|instance| (Some(0), f32::from(round) * 0.1 + f32::from(instance)))
            .collect();
        wanted[usize::from(round % 12)] = kept;
        wanted[usize::from((round + 5) % 12)] = kept;
        crowd.update(&model.skeleton, &clips, 0.0, &poses(&wanted));
        for (palette, &wanted) in of_instances(&crowd, 8).iter().zip(&wanted) {
            assert_eq!(*palette, single(&model, &clips, 0.0, wanted), "{round} {wanted:?}");
        }
    }
}

#[test]
fn buffers_stay_where_they_are_after_the_first_update() {
    let model = rigs::model(30);
    let clips = CompiledClip::all(&model.clips);
    let mut crowd = CrowdPalettes::default();
    let mut places = Vec::new();
    for round in 0..40_u8 {
        let wanted: Vec<Wanted> = (0..64_u8)
            .map(|instance| {
                let times = if round % 3 == 0 { 1 } else { 64 };
                (Some(0), f32::from(instance % times) * 0.01 + f32::from(round) * 0.016)
            })
            .collect();
        crowd.update(&model.skeleton, &clips, 0.0, &poses(&wanted));
        places.push((crowd.palettes().as_ptr(), crowd.slots().as_ptr()));
    }
    assert!(places.iter().all(|place| *place == places[0]));
}

#[test]
fn a_skeleton_without_joints_has_empty_palettes() {
    let mut crowd = CrowdPalettes::default();
    crowd.update(&bindpose::model::Skeleton::default(), &[], 0.0, &[ClipPose::BIND; 3]);
    assert_eq!((crowd.palettes().len(), crowd.slots()), (0, &[0, 0, 0][..]));
}
