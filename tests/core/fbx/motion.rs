//! Motions: as the same file in another format has them, and when they join a character.

use bindpose::anim::{CompiledClip, PoseBuffers};
use bindpose::import::import;
use bindpose::model::{JointIndex, Model};
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
    let Some((_, fbx)) = files("mixamo").into_iter().find(|(name, _)| name == "Breathing Idle.fbx") else { return };
    let glb = std::fs::read(crate::shared::shared("fbx/mixamo/Breathing Idle.glb").expect("it is beside")).expect("it is beside");
    let [fbx, glb] = [fbx, glb].map(|bytes| import(&bytes).expect("it is sound").model);
    let times = glb.clips[0].tracks.iter().find(|track| track.has_keys()).expect("it moves").times_secs().to_vec();
    assert!(times.len() > 50, "{}", times.len());
    let reach = |joints: &[(String, Affine3A)]| {
        let hips = joints.iter().find(|(name, _)| name.ends_with("Hips")).expect("hips").1.translation;
        joints.iter().map(|(_, joint)| joint.translation.distance(hips)).fold(0.0, f32::max)
    };
    let mut worst = 0f32;
    let clips = [&fbx, &glb].map(|model| (model, CompiledClip::new(&model.clips[0])));
    for &secs in &times {
        let [ours, theirs] = clips.each_ref().map(|(model, clip)| posed(model, clip, secs));
        let scale = reach(&ours) / reach(&theirs);
        let mut count = 0;
        for (name, joint) in &theirs {
            let Some((_, our)) = ours.iter().find(|(other, _)| bindpose::edit::common_name(other) == bindpose::edit::common_name(name)) else {
                continue;
            };
            count += 1;
            let off = (Vec3::from(our.translation) / scale).distance(joint.translation.into()) / reach(&theirs);
            worst = worst.max(off);
        }
        assert!(count >= 30, "{count} joints");
    }
    println!("{} times, {worst:.1e} of the size", times.len());
    assert!(worst < 1e-4, "{worst}");
}
