//! Clips: they loop, feet keep to the ground, joints bend their own way.

use bindpose::format::Vertex;
use glam::{DMat4, DVec3};

use super::{FIGURE, LEFT_THIGH, RIGHT_THIGH, end_secs, frames, is_below, model_from_joint, palette, quat, skinned};

#[test]
fn clips_loop_and_keep_30_keys_a_second() {
    let names: Vec<&str> = FIGURE.clips.iter().map(|clip| clip.name.as_str()).collect();
    assert_eq!(names, ["Idle", "Walk", "Run", "Wave"]);
    for clip in &FIGURE.clips {
        assert_eq!(clip.bones.len(), FIGURE.bone_offsets.len());
        let end = end_secs(clip);
        for (joint, bone) in clip.bones.iter().enumerate() {
            let (first, last) = (bone.keyframes[0], bone.keyframes[bone.keyframes.len() - 1]);
            assert_eq!(
                (first.time_secs, last.time_secs),
                (0.0, end),
                "{} joint {joint}",
                clip.name
            );
            assert_eq!(
                (first.translation, first.rotation),
                (last.translation, last.rotation),
                "{} {joint}",
                clip.name
            );
            for (before, after) in bone.keyframes.iter().zip(&bone.keyframes[1..]) {
                let spans = (after.time_secs - before.time_secs) * 30.0;
                assert!(
                    bone.keyframes.len() == 2 || (spans - 1.0).abs() < 1e-3,
                    "{} joint {joint}",
                    clip.name
                );
                let (a, b) = (quat(before.rotation), quat(after.rotation));
                assert!((a.length() - 1.0).abs() < 1e-5);
                // Neighbours on one side, and no joint jumps: 30 degrees in a thirtieth of a second.
                assert!(
                    a.dot(b) > 15f64.to_radians().cos(),
                    "{} joint {joint} at {}",
                    clip.name,
                    before.time_secs
                );
            }
        }
    }
}

#[test]
fn feet_stay_above_the_ground() {
    // Soles are soft: where they roll over heel and ball they press in a little.
    const PRESSED_METRES: f64 = 0.012;
    for clip in &FIGURE.clips {
        for frame in 0..=frames(clip) {
            let palette = palette(clip, frame);
            let lowest = FIGURE
                .vertices
                .iter()
                .map(|vertex| skinned(vertex, &palette).y)
                .fold(f64::INFINITY, f64::min);
            assert!(lowest > -PRESSED_METRES, "{} frame {frame}: {lowest}", clip.name);
            if clip.name != "Run" {
                assert!(
                    lowest < PRESSED_METRES,
                    "{} frame {frame} floats at {lowest}",
                    clip.name
                );
            }
        }
    }
}

#[test]
fn planted_feet_move_with_the_ground() {
    //             stance      flat part of it     metres a second
    for (name, from, to) in [("Walk", 0.10, 0.32), ("Run", 0.07, 0.16)] {
        let clip = FIGURE.clips.iter().find(|clip| clip.name == name).expect("named above");
        let count = frames(clip);
        for (ankle, shift) in [(LEFT_THIGH + 2, 0.0), (RIGHT_THIGH + 2, 0.5)] {
            let places: Vec<DVec3> = (0..count)
                .filter(|frame| (from..to).contains(&(*frame as f64 / count as f64 + shift).rem_euclid(1.0)))
                .map(|frame| model_from_joint(clip, frame)[ankle].w_axis.truncate())
                .collect();
            assert!(places.len() >= 2, "{name}");
            // Right feet may be planted across the loop: only steps between neighbours count.
            let steps: Vec<DVec3> = places
                .windows(2)
                .map(|pair| pair[1] - pair[0])
                .filter(|d| d.z > 0.0)
                .collect();
            for step in &steps {
                assert!((*step - steps[0]).length() < 5e-4, "{name}: {step} is not {}", steps[0]);
                assert!(
                    step.y.abs() < 5e-4 && step.x.abs() < 5e-4 && step.z > 0.02,
                    "{name}: {step}"
                );
            }
        }
    }
}

#[test]
fn feet_that_stand_stay_where_they_are() {
    // A step of the walk is 0.63 m long.
    const HUNDREDTH_OF_A_STEP: f64 = 0.0063;
    let soles: Vec<_> = FIGURE
        .vertices
        .iter()
        .filter(|vertex| vertex.position[1] < 0.02)
        .collect();
    assert!(soles.len() > 100, "{} vertices", soles.len());
    for clip in FIGURE
        .clips
        .iter()
        .filter(|clip| ["Idle", "Wave"].contains(&clip.name.as_str()))
    {
        let start = palette(clip, 0);
        for frame in 0..=frames(clip) {
            let palette = palette(clip, frame);
            for vertex in &soles {
                let moved = skinned(vertex, &palette).distance(skinned(vertex, &start));
                assert!(moved < HUNDREDTH_OF_A_STEP, "{} frame {frame}: {moved}", clip.name);
            }
        }
    }
}

#[test]
fn knees_and_elbows_bend_their_own_way() {
    for clip in &FIGURE.clips {
        for frame in 0..=frames(clip) {
            let joints = model_from_joint(clip, frame);
            let origin = |joint: usize| joints[joint].w_axis.truncate();
            for thigh in [LEFT_THIGH, RIGHT_THIGH] {
                let (upper, lower) = (origin(thigh + 1) - origin(thigh), origin(thigh + 2) - origin(thigh + 1));
                let bent = upper.angle_between(lower).to_degrees();
                assert!(bent < 130.0, "{} frame {frame}: knee {bent}", clip.name);
                // The shin leaves the thigh's line backwards.
                let aside = lower.reject_from(upper);
                assert!(
                    bent < 2.0 || aside.z > 0.0,
                    "{} frame {frame}: the shin bends towards {aside}",
                    clip.name
                );
            }
            for upper_arm in [LEFT_THIGH - 11, RIGHT_THIGH - 11] {
                let upper = origin(upper_arm + 1) - origin(upper_arm);
                let bent = upper
                    .angle_between(origin(upper_arm + 2) - origin(upper_arm + 1))
                    .to_degrees();
                assert!(
                    (5.0..140.0).contains(&bent),
                    "{} frame {frame}: elbow {bent}",
                    clip.name
                );
            }
        }
    }
}

#[test]
fn hands_do_not_pass_through_the_body() {
    // The body as capsules inside the skin: hips and thighs, and the trunk up to the ribs.
    const HIPS: usize = 1;
    const RIBS: usize = 3;
    let from_stretch = |point: DVec3, from: DVec3, to: DVec3| {
        let along = to - from;
        let part = ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        point.distance(from + along * part)
    };
    let hands: Vec<_> = FIGURE
        .vertices
        .iter()
        .filter(|vertex| {
            let mover = vertex.blend_indices[0] as usize;
            is_below(mover, LEFT_THIGH - 9) || is_below(mover, RIGHT_THIGH - 9)
        })
        .collect();
    assert!(hands.len() > 1_000, "{} vertices of hands", hands.len());
    for clip in &FIGURE.clips {
        for frame in 0..=frames(clip) {
            let joints = model_from_joint(clip, frame);
            let at = |joint: usize| joints[joint].w_axis.truncate();
            let capsules = [
                (at(LEFT_THIGH), at(LEFT_THIGH + 1), 0.06),
                (at(RIGHT_THIGH), at(RIGHT_THIGH + 1), 0.06),
                (at(LEFT_THIGH), at(RIGHT_THIGH), 0.085),
                (at(HIPS), at(RIBS), 0.1),
            ];
            let palette = palette(clip, frame);
            for vertex in &hands {
                let point = skinned(vertex, &palette);
                for (from, to, radius) in capsules {
                    let distance = from_stretch(point, from, to);
                    assert!(
                        distance > radius,
                        "{} frame {frame}: a hand {distance} from a bone",
                        clip.name
                    );
                }
            }
        }
    }
}

/// Beside ground that goes evenly under them, no point of a sole goes farther than a hundredth of a step while the
/// foot is flat.
#[test]
fn planted_soles_stay_on_the_ground_all_the_while() {
    // A step of the walk is 0.63 m long, one of the run is longer.
    const HUNDREDTH_OF_A_STEP: f64 = 0.0063;
    for (name, from, to) in [("Walk", 0.10, 0.32), ("Run", 0.07, 0.16)] {
        let clip = FIGURE.clips.iter().find(|clip| clip.name == name).expect("named above");
        let count = frames(clip);
        for (thigh, shift) in [(LEFT_THIGH, 0.0), (RIGHT_THIGH, 0.5)] {
            let is_of_leg = |vertex: &&Vertex| {
                let influences = vertex.blend_weights.into_iter().zip(vertex.blend_indices);
                influences
                    .filter(|(weight, _)| *weight > 0.0)
                    .all(|(_, joint)| is_below(joint as usize, thigh))
            };
            let soles = FIGURE
                .vertices
                .iter()
                .filter(|vertex| vertex.position[1] < 0.02)
                .filter(is_of_leg);
            let soles: Vec<_> = soles.collect();
            assert!(soles.len() > 50, "{} vertices", soles.len());
            let planted = |frame: &usize| (from..to).contains(&(*frame as f64 / count as f64 + shift).rem_euclid(1.0));
            // The frames of one stance in order, over the end of the loop.
            let first = (0..count).find(|frame| planted(frame) && !planted(&(frame + count - 1)));
            let first = first.expect("it begins somewhere");
            let palettes: Vec<_> = (first..)
                .take_while(planted)
                .map(|frame| palette(clip, frame % count))
                .collect();
            assert!(palettes.len() >= 2, "{name}");
            let mean = |palette: &Vec<DMat4>| {
                soles.iter().map(|vertex| skinned(vertex, palette)).sum::<DVec3>() / soles.len() as f64
            };
            let spans = (palettes.len() - 1) as f64;
            let step = (mean(&palettes[palettes.len() - 1]) - mean(&palettes[0])) / spans;
            assert!(step.z > 0.02, "{name}: the ground goes by {step}");
            for (frame, palette) in palettes.iter().enumerate() {
                for vertex in &soles {
                    let moved = skinned(vertex, palette) - skinned(vertex, &palettes[0]) - step * frame as f64;
                    assert!(moved.length() < HUNDREDTH_OF_A_STEP, "{name} frame {frame}: {moved}");
                }
            }
        }
    }
}
