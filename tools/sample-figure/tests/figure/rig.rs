//! Joints and weights.

use super::{FIGURE, RIGHT_THIGH, WRITTEN_METRES, is_below, key, offset};

#[test]
fn weights_sum_to_one_and_unused_slots_are_empty() {
    for (index, vertex) in FIGURE.vertices.iter().enumerate() {
        let sum: f64 = vertex.blend_weights.iter().copied().map(f64::from).sum();
        assert!((sum - 1.0).abs() < 1e-6, "vertex {index}: {sum}");
        assert!(
            vertex.blend_weights.is_sorted_by(|a, b| a >= b),
            "vertex {index}: {:?}",
            vertex.blend_weights
        );
        for (slot, &joint) in vertex.blend_indices.iter().enumerate() {
            assert!((joint as usize) < FIGURE.bone_offsets.len());
            let repeated = vertex.blend_indices[..slot].contains(&joint);
            assert!(
                vertex.blend_weights[slot] == 0.0 && joint == 0 || !repeated,
                "vertex {index}: joint {joint} twice"
            );
        }
    }
}

#[test]
fn every_joint_but_the_root_moves_the_skin() {
    let mut most = vec![0.0f32; FIGURE.bone_offsets.len()];
    for vertex in &FIGURE.vertices {
        for (weight, joint) in vertex.blend_weights.into_iter().zip(vertex.blend_indices) {
            most[joint as usize] = most[joint as usize].max(weight);
        }
    }
    for (joint, (&most, &parent)) in most.iter().zip(&FIGURE.bone_parents).enumerate() {
        assert_eq!(parent < 0, joint == 0, "joint {joint}");
        assert!(parent < joint as i32, "joint {joint} comes before its parent");
        assert!(
            if joint == 0 { most == 0.0 } else { most > 0.4 },
            "joint {joint} moves at most {most}"
        );
    }
}

#[test]
fn one_leg_does_not_move_the_other() {
    let right_leg: Vec<usize> = (0..FIGURE.bone_parents.len())
        .filter(|joint| is_below(*joint, RIGHT_THIGH))
        .collect();
    assert_eq!(right_leg.len(), 4);
    for vertex in FIGURE.vertices.iter().filter(|vertex| vertex.position[0] > 0.0) {
        for (weight, joint) in vertex.blend_weights.into_iter().zip(vertex.blend_indices) {
            assert!(weight == 0.0 || !right_leg.contains(&(joint as usize)), "{vertex:?}");
        }
    }
}

#[test]
fn offsets_undo_the_bind_pose() {
    // The clips hold the bind lengths, so each joint's offset must put its origin where its children hang from.
    for (joint, &parent) in FIGURE
        .bone_parents
        .iter()
        .enumerate()
        .filter(|(_, parent)| **parent > 0)
    {
        let local = key(&FIGURE.clips[0], joint, 0).0;
        let in_parent = offset(parent as usize) * offset(joint).inverse();
        assert!(
            in_parent.w_axis.truncate().distance(local) < 0.06,
            "joint {joint} hangs {local} from its parent"
        );
        if joint > 1 {
            assert!(
                in_parent.w_axis.truncate().distance(local) < 3.0 * WRITTEN_METRES,
                "joint {joint}"
            );
        }
    }
}
