//! One number a vertex, against plain loops.

use bindpose::anim::{
    CompiledClip, PoseBuffers, Stretch, dominant_joints, influence_counts, joint_weights, skin_positions,
};
use bindpose::import::m3d;
use bindpose::model::{JointIndex, Model};
use glam::Vec3;

use crate::chains::mirrored_model;
use crate::documents::{arm, model_of, quad, soldier};

fn check_weights(model: &Model) {
    let (mut weights, mut counts, mut dominant) = (Vec::new(), Vec::new(), Vec::new());
    influence_counts(&model.mesh, &mut counts);
    dominant_joints(&model.mesh, &mut dominant);
    let mut sums = vec![0.0_f64; model.mesh.vertex_count()];
    let mut greatest = vec![0.0_f32; model.mesh.vertex_count()];
    let joints = (0..model.skeleton.joint_count() as u32).map(JointIndex);
    for joint in joints {
        joint_weights(&model.mesh, joint, &mut weights);
        assert_eq!(weights.len(), model.mesh.vertex_count());
        for (vertex, &weight) in weights.iter().enumerate() {
            sums[vertex] += f64::from(weight);
            greatest[vertex] = greatest[vertex].max(weight);
            if dominant[vertex] == Some(joint) {
                assert!(weight > 0.0);
            }
        }
    }
    for vertex in 0..model.mesh.vertex_count() {
        let expected = if counts[vertex] == 0 { 0.0 } else { 1.0 };
        assert!((sums[vertex] - expected).abs() < 1e-5, "weights sum to one");
        assert_eq!(dominant[vertex].is_some(), counts[vertex] > 0);
        if let Some(joint) = dominant[vertex] {
            joint_weights(&model.mesh, joint, &mut weights);
            // No joint alone is above it but one that the vertex names twice.
            assert!(weights[vertex] >= greatest[vertex] || counts[vertex] > 1);
        }
    }
}

#[test]
fn weights_counts_and_strongest_joints_belong_together() {
    check_weights(&model_of(&arm()).0);
    check_weights(&model_of(&quad()).0);
    let mut document = arm();
    document.vertices[4].blend_weights = [0.0; 4];
    check_weights(&model_of(&document).0);
    check_weights(&mirrored_model(40));
}

#[test]
fn counts_are_of_weights_above_zero() {
    let (model, _) = model_of(&arm());
    let (mut counts, mut dominant) = (Vec::new(), Vec::new());
    influence_counts(&model.mesh, &mut counts);
    assert_eq!(counts[..6], [1, 1, 2, 2, 1, 1]);
    dominant_joints(&model.mesh, &mut dominant);
    assert_eq!(
        dominant[..6],
        [0, 0, 0, 0, 1, 1].map(|joint| Some(JointIndex(joint))),
        "the first of equals"
    );
}

/// The mean ratio of the edges at each place, by a loop over all corners.
fn plain_ratios(model: &Model, positions: &[Vec3]) -> Vec<f64> {
    let mesh = &model.mesh;
    let mut edges = std::collections::BTreeSet::new();
    let same =
        |a: usize, b: usize| mesh.positions[a] == mesh.positions[b] && mesh.influences.get(a) == mesh.influences.get(b);
    let first = |vertex: u32| {
        (0..=vertex as usize)
            .find(|&other| same(other, vertex as usize))
            .expect("itself")
    };
    for corners in mesh.indices.chunks_exact(3) {
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let (from, to) = (first(corners[from]), first(corners[to]));
            edges.insert((from.min(to), from.max(to)));
        }
    }
    (0..mesh.vertex_count() as u32)
        .map(|vertex| {
            let ratio = |&(from, to): &(usize, usize)| {
                positions[from].as_dvec3().distance(positions[to].as_dvec3())
                    / mesh.positions[from].as_dvec3().distance(mesh.positions[to].as_dvec3())
            };
            let vertex = first(vertex);
            let ratios: Vec<f64> = edges
                .iter()
                .filter(|ends| ends.0 == vertex || ends.1 == vertex)
                .map(ratio)
                .collect();
            if ratios.is_empty() {
                1.0
            } else {
                ratios.iter().sum::<f64>() / ratios.len() as f64
            }
        })
        .collect()
}

#[test]
fn stretch_is_the_mean_over_the_edges() {
    for model in [model_of(&arm()).0, mirrored_model(60)] {
        let stretch = Stretch::new(&model.mesh);
        let (mut pose, mut positions, mut ratios) = (PoseBuffers::default(), Vec::new(), Vec::new());
        pose.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), 0.8);
        skin_positions(&model.mesh, &pose.palette, &mut positions);
        stretch.ratios(&positions, &mut ratios);
        let expected = plain_ratios(&model, &positions);
        assert!(ratios.iter().any(|ratio| (ratio - 1.0).abs() > 1e-5), "it bends");
        for (ratio, expected) in ratios.iter().zip(expected) {
            assert!((f64::from(*ratio) - expected).abs() < 1e-4, "{ratio} {expected}");
        }
    }
}

#[test]
fn the_bind_pose_is_not_stretched_and_twice_the_size_is_two() {
    for model in [model_of(&arm()).0, model_of(&quad()).0, mirrored_model(300)] {
        let stretch = Stretch::new(&model.mesh);
        let mut ratios = Vec::new();
        stretch.ratios(&model.mesh.positions, &mut ratios);
        assert!(ratios.iter().all(|ratio| (ratio - 1.0).abs() < 1e-6));
        let doubled: Vec<_> = model.mesh.positions.iter().map(|&position| position * 2.0).collect();
        stretch.ratios(&doubled, &mut ratios);
        assert!(ratios.iter().all(|ratio| (ratio - 2.0).abs() < 1e-5));
        stretch.ratios(&[], &mut ratios);
        assert!(ratios.iter().all(|&ratio| ratio == 1.0), "no positions, no stretch");
    }
}

#[test]
fn a_seam_does_not_part_the_stretch_and_edges_of_no_length_do_not_count() {
    // The quad with each triangle having vertices of its own, and a triangle that is a point.
    let mut document = quad();
    let vertices = [0, 1, 2, 0, 2, 3, 0, 0, 0].map(|vertex: usize| document.vertices[vertex]);
    document.vertices = vertices.to_vec();
    document.triangles = vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]];
    let (model, _) = model_of(&document);
    let stretch = Stretch::new(&model.mesh);
    let wider: Vec<_> = model
        .mesh
        .positions
        .iter()
        .map(|&position| position * Vec3::new(3.0, 1.0, 1.0))
        .collect();
    let mut ratios = Vec::new();
    stretch.ratios(&wider, &mut ratios);
    assert_eq!((ratios[0], ratios[2]), (ratios[3], ratios[4]), "one place, one stretch");
    assert_eq!(ratios[6], ratios[0]);
    let diagonal = 10.0_f32.sqrt() / 2.0_f32.sqrt();
    assert!((ratios[0] - (1.0 + 3.0 + diagonal) / 3.0).abs() < 1e-5, "{}", ratios[0]);
}

#[test]
fn the_soldier_has_four_joints_a_vertex_at_most_and_stretches_where_it_bends() {
    let Some(parsed) = soldier() else { return };
    let (model, _) = m3d::from_parsed(&parsed).expect("sound");
    check_weights(&model);
    let stretch = Stretch::new(&model.mesh);
    let (mut pose, mut positions, mut ratios) = (PoseBuffers::default(), Vec::new(), Vec::new());
    pose.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), 0.517);
    skin_positions(&model.mesh, &pose.palette, &mut positions);
    stretch.ratios(&positions, &mut ratios);
    assert!(ratios.iter().all(|ratio| ratio.is_finite() && *ratio > 0.0));
    let unchanged = ratios.iter().filter(|ratio| (0.9..1.1).contains(*ratio)).count();
    assert!(
        unchanged * 2 > ratios.len(),
        "most of it is as it was: {unchanged} of {}",
        ratios.len()
    );
}
