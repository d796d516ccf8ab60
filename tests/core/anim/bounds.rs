//! The space that a clip needs.

use std::time::Instant;

use bindpose::anim::{CompiledClip, Extent, PoseBuffers, skin_positions};
use bindpose::import::m3d;
use bindpose::model::{Aabb, Clip, Mesh, Model};
use glam::Vec3;

use crate::documents::{arm, extent, model_of, quad, soldier};
use crate::textbook;

fn animated_bounds(model: &Model, clip: &CompiledClip) -> Aabb {
    extent(model, Some(clip)).bounds
}

#[test]
fn a_static_model_and_a_resting_clip_keep_the_bind_bounds() {
    let (model, _) = model_of(&quad());
    assert_eq!(
        animated_bounds(&model, &CompiledClip::new(&Clip::default())),
        model.bind_bounds()
    );

    let mut document = arm();
    document.clips[0]
        .bones
        .iter_mut()
        .for_each(|bone| bone.keyframes.clear());
    let (model, _) = model_of(&document);
    let bounds = animated_bounds(&model, &CompiledClip::new(&model.clips[0]));
    assert!(bounds.min.abs_diff_eq(model.bind_bounds().min, 1e-6), "{bounds:?}");
    assert!(bounds.max.abs_diff_eq(model.bind_bounds().max, 1e-6), "{bounds:?}");
}

#[test]
fn the_box_is_that_of_the_vertices_at_the_keys() {
    let (model, _) = model_of(&arm());
    let mut buffers = PoseBuffers::default();
    let mut positions = Vec::new();
    let mut expected = Aabb::EMPTY;
    for time_secs in [0.0, 1.0] {
        buffers.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), time_secs);
        skin_positions(&model.mesh, &buffers.palette, &mut positions);
        expected = positions
            .iter()
            .fold(expected, |bounds, &position| bounds.include(position));
    }
    assert_eq!(animated_bounds(&model, &CompiledClip::new(&model.clips[0])), expected);
}

#[test]
fn too_much_work_gives_a_box_that_is_rather_too_large() {
    let (small, _) = model_of(&arm());
    let mut document = arm();
    // Nine million vertices and key times together.
    while document.vertices.len() * 90 < 9_000_000 {
        document.vertices.extend_from_within(..14);
    }
    for bone in &mut document.clips[0].bones {
        let (first, last) = (bone.keyframes[0], bone.keyframes[1]);
        bone.keyframes = (0_u8..90)
            .map(|key| {
                let part = f32::from(key) / 89.0;
                crate::documents::turned(
                    crate::documents::key(part, first.translation),
                    last.rotation[2].asin() * 2.0 * part,
                )
            })
            .collect();
    }
    let (large, _) = model_of(&document);
    let rough = animated_bounds(&large, &CompiledClip::new(&large.clips[0]));
    let exact = animated_bounds(&small, &CompiledClip::new(&large.clips[0]));
    assert!(
        rough.min.cmple(exact.min + 1e-5).all() && rough.max.cmpge(exact.max - 1e-5).all(),
        "{rough:?} {exact:?}"
    );
    assert!(
        rough.size().cmple(exact.size() * 1.5 + 0.01).all(),
        "{rough:?} {exact:?}"
    );
}

/// The arm swings through the middle of its way: no key shows how far it reaches there.
#[test]
fn many_key_times_are_looked_at_evenly() {
    let mut document = arm();
    for bone in &mut document.clips[0].bones {
        let first = bone.keyframes[0];
        bone.keyframes = (0_u16..3_000)
            .map(|key| {
                let part = f32::from(key) / 2_999.0;
                crate::documents::turned(crate::documents::key(part, first.translation), (part * 6.0).sin())
            })
            .collect();
    }
    let (model, _) = model_of(&document);
    let bounds = animated_bounds(&model, &CompiledClip::new(&model.clips[0]));
    let mut buffers = PoseBuffers::default();
    let mut positions = Vec::new();
    for step in 0_u16..=500 {
        buffers.evaluate(
            &model.skeleton,
            &CompiledClip::new(&model.clips[0]),
            f32::from(step) / 500.0,
        );
        skin_positions(&model.mesh, &buffers.palette, &mut positions);
        let reach = Aabb::from_points(positions.iter().copied());
        assert!(bounds.min.cmple(reach.min + 1e-2).all() && bounds.max.cmpge(reach.max - 1e-2).all());
    }
}

#[test]
#[allow(clippy::print_stderr, reason = "the time is worth seeing")]
fn the_soldier_needs_the_box_of_the_textbook() {
    let Some(parsed) = soldier() else { return };
    let (model, _) = m3d::from_parsed(&parsed).expect("sound");
    let begun = Instant::now();
    let bounds = animated_bounds(&model, &CompiledClip::new(&model.clips[0]));
    eprintln!("animated bounds of the soldier in {:?}", begun.elapsed());

    let document = &parsed.document;
    let (mut least, mut greatest) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for key in &document.clips[0].bones[0].keyframes {
        let palette = textbook::palette(document, 0, f64::from(key.time_secs));
        for vertex in &document.vertices {
            let weights = vertex.blend_weights.map(f64::from);
            let position = textbook::skinned(vertex.position, weights, vertex.blend_indices, &palette);
            for axis in 0..3 {
                least[axis] = least[axis].min(position[axis]);
                greatest[axis] = greatest[axis].max(position[axis]);
            }
        }
    }
    let narrow = |numbers: [f64; 3]| Vec3::from_array(numbers.map(|number| number as f32));
    assert!(bounds.min.abs_diff_eq(narrow(least), 3e-4), "{bounds:?} {least:?}");
    assert!(
        bounds.max.abs_diff_eq(narrow(greatest), 3e-4),
        "{bounds:?} {greatest:?}"
    );
    // The run is far deeper than the bind pose, and the arms come down.
    assert!(bounds.size().z > 44.0 && bounds.size().x < 32.0, "{bounds:?}");
}

#[test]
fn the_corners_of_a_box_are_kept_and_its_inside_is_not() {
    let mut positions = vec![Vec3::ZERO, Vec3::splat(0.3)];
    positions.extend(
        Aabb {
            min: Vec3::new(-1.0, -2.0, -3.0),
            max: Vec3::new(4.0, 5.0, 6.0),
        }
        .corners(),
    );
    let mesh = Mesh {
        positions: positions.clone(),
        ..Mesh::default()
    };
    let model = Model {
        mesh,
        ..Model::default()
    };
    let points = extent(&model, None).points;
    assert!(positions[2..].iter().all(|corner| points.contains(corner)));
    assert!(!points.contains(&Vec3::ZERO) && !points.contains(&Vec3::splat(0.3)));
}

/// How far points reach along a direction.
fn reach(points: &[Vec3], along: Vec3) -> f32 {
    points
        .iter()
        .map(|point| point.dot(along))
        .fold(f32::NEG_INFINITY, f32::max)
}

#[test]
fn what_is_left_out_of_the_extremes_is_a_hundredth_of_the_size() {
    let arm = model_of(&arm()).0;
    let soldier = soldier().map(|parsed| m3d::from_parsed(&parsed).expect("sound").0);
    for model in [Some(arm), soldier].into_iter().flatten() {
        let clip = CompiledClip::new(&model.clips[0]);
        let points = extent(&model, Some(&clip)).points;
        let (mut buffers, mut positions, mut all) = (PoseBuffers::default(), Vec::new(), Vec::new());
        for i in 0_u8..12 {
            let part = f32::from(i) / 11.0;
            let time_secs = clip.start_secs() + part * (clip.end_secs() - clip.start_secs());
            buffers.evaluate(&model.skeleton, &clip, time_secs);
            skin_positions(&model.mesh, &buffers.palette, &mut positions);
            all.extend_from_slice(&positions);
        }
        let size = Aabb::from_points(all.iter().copied()).size().length();
        // Directions between those that are looked along.
        for i in 0_u8..200 {
            let (turn, y) = (f32::from(i) * 2.4, f32::from(i) / 100.0 - 0.995);
            let flat = (1.0 - y * y).sqrt();
            let along = Vec3::new(flat * turn.cos(), y, flat * turn.sin());
            let missed = reach(&all, along) - reach(&points, along);
            assert!(
                (0.0..0.03 * size).contains(&(missed + 1e-6)),
                "{missed} of {size} along {along}"
            );
        }
    }
}

/// The box with every vertex skinned at every key.
fn textbook_bounds(model: &Model, clip: &Clip) -> Aabb {
    let mut times_secs: Vec<f32> = clip
        .tracks
        .iter()
        .flat_map(|track| track.times_secs())
        .copied()
        .collect();
    times_secs.sort_by(f32::total_cmp);
    times_secs.dedup();
    let compiled = CompiledClip::new(clip);
    let (mut buffers, mut positions, mut bounds) = (PoseBuffers::default(), Vec::new(), Aabb::EMPTY);
    for time_secs in times_secs {
        buffers.evaluate(&model.skeleton, &compiled, time_secs);
        skin_positions(&model.mesh, &buffers.palette, &mut positions);
        bounds = positions
            .iter()
            .fold(bounds, |bounds, &position| bounds.include(position));
    }
    bounds
}

/// The points with every vertex skinned at every time, and each looked at along each line.
fn textbook_points(model: &Model, clip: &CompiledClip) -> Vec<Vec3> {
    let golden_angle = std::f32::consts::PI * (3.0 - 5.0_f32.sqrt());
    let axes: Vec<Vec3> = (0_u8..32)
        .map(|i| {
            let y = 1.0 - (f32::from(i) + 0.5) / 32.0;
            let (sin, cos) = (golden_angle * f32::from(i)).sin_cos();
            let radius = (1.0 - y * y).sqrt();
            Vec3::new(radius * cos, y, radius * sin)
        })
        .collect();
    let (mut buffers, mut positions, mut points) = (PoseBuffers::default(), Vec::new(), Vec::new());
    for i in 0_u8..12 {
        let time_secs = clip.start_secs() + f32::from(i) / 11.0 * (clip.end_secs() - clip.start_secs());
        buffers.evaluate(&model.skeleton, clip, time_secs);
        skin_positions(&model.mesh, &buffers.palette, &mut positions);
        for axis in &axes {
            let farthest = |sign: f32| {
                let further = |best: Vec3, next: &Vec3| {
                    let is_further = sign * axis.dot(*next) > sign * axis.dot(best);
                    if is_further { *next } else { best }
                };
                positions.iter().fold(positions[0], further)
            };
            points.extend([farthest(1.0), farthest(-1.0)]);
        }
    }
    points
}

#[test]
fn groups_that_are_left_out_change_no_bit_of_the_box_and_the_points() {
    let mut document = arm();
    // So many vertices that there are groups, some of them without weights, some with weights that sum to another number than 1.
    for round in 0_u8..40 {
        for mut vertex in arm().vertices {
            let by = f32::from(round) / 40.0;
            vertex.position = vertex.position.map(|number| number * by);
            if round % 8 == 0 {
                vertex.blend_weights = [0.0; 4];
            }
            document.vertices.push(vertex);
        }
    }
    let arms = model_of(&document).0;
    let mut uneven = arms.clone();
    for (influences, of) in uneven.mesh.influences.iter_mut().zip(0_u16..) {
        influences.weights[0] *= [1.0, 1.02, 0.97, -0.5][usize::from(of % 4)];
    }
    // The joint with the greatest weight has less than another one in three slots.
    let mut in_three_slots = arms.clone();
    for influences in &mut in_three_slots.mesh.influences {
        influences.joints = [0, 1, 1, 1];
        influences.weights = [0.4, 0.2, 0.2, 0.2];
    }
    let soldier = soldier().map(|parsed| m3d::from_parsed(&parsed).expect("sound").0);
    for model in [Some(arms), Some(uneven), Some(in_three_slots), soldier]
        .into_iter()
        .flatten()
    {
        let clip = &model.clips[0];
        let compiled = CompiledClip::new(clip);
        let Extent { bounds, points, .. } = extent(&model, Some(&compiled));
        assert_eq!(bounds, textbook_bounds(&model, clip));
        assert_eq!(points, textbook_points(&model, &compiled));
    }
}

#[test]
fn nothing_has_no_extremes() {
    assert!(extent(&Model::default(), None).points.is_empty());
}
