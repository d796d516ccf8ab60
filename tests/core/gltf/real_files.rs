//! Real files of others: what is in them, and that they hold together when they move.

use std::fs;

use bindpose::anim::{CompiledClip, PoseBuffers, skin_positions};
use bindpose::check;
use bindpose::import::import;
use bindpose::model::Aabb;

use crate::shared::shared;

/// Name, vertices, joints, and the spans of the first clips in seconds.
type Facts = (&'static str, usize, usize, &'static [(&'static str, f32)]);

const FACTS: [Facts; 5] = [
    ("CesiumMan.glb", 3273, 20, &[("Anim_0", 2.0)]),
    (
        "Fox.glb",
        1728,
        25,
        &[("Survey", 3.4167), ("Walk", 0.7083), ("Run", 1.1583)],
    ),
    ("RiggedSimple.glb", 960, 5, &[("Anim_0_Armature", 6.6667)]),
    ("RobotExpressive.glb", 6015, 78, &[("Dance", 3.3333), ("Death", 0.9583)]),
    ("SimpleSkin.gltf", 10, 3, &[("clip 0", 5.5)]),
];

#[test]
fn real_models_have_what_their_makers_put_into_them() {
    for (name, vertices, joints, clips) in FACTS {
        let Some(path) = shared(&format!("gltf/models/{name}")) else {
            return;
        };
        let bytes = fs::read(path).expect("it can be read");
        let imported = import(&bytes).expect("it makes a model");
        let model = &imported.model;
        assert_eq!(
            (model.mesh.vertex_count(), model.skeleton.joint_count()),
            (vertices, joints),
            "{name}"
        );
        let bind = model.bind_bounds();
        for ((clip, &(clip_name, span_secs)), compiled) in
            model.clips.iter().zip(clips).zip(CompiledClip::all(&model.clips))
        {
            assert_eq!(clip.name, clip_name);
            assert!((clip.end_secs - span_secs).abs() < 1e-3, "{name}: {}", clip.end_secs);
            let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
            let mut positions = Vec::new();
            for step in 0..=10 {
                pose.evaluate(&model.skeleton, &compiled, clip.end_secs * step as f32 / 10.0);
                skin_positions(&model.mesh, &pose.palette, &mut positions);
                let posed = Aabb::from_points(positions.iter().copied());
                let size = posed.size().length() / bind.size().length();
                assert!(
                    (0.6..1.8).contains(&size),
                    "{name} {clip_name} at {step}: {size} times its size"
                );
            }
        }
        let compiled = CompiledClip::all(&model.clips);
        let worse = check::model(model, &compiled, &*imported.source.places(&bytes));
        assert!(worse.iter().all(|finding| finding.code != "exploded"), "{name}");
        for finding in &worse {
            assert!(
                finding.pointer.is_some() || finding.subject.is_none(),
                "{name}: {finding:?}"
            );
        }
    }
}
