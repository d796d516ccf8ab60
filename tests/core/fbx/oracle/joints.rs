//! Joints: where they are, how they are turned and scaled.

use bindpose::anim::{CompiledClip, PoseBuffers};
use bindpose::model::{JointIndex, Model};
use glam::{DAffine3, DMat3, DVec3};
use ufbx::Scene;

use super::{
    CYCLE, Outcome, TOLERANCE, Table, all_points, axes, compare_all, evaluated, matrix, measure, size, stacks, times,
    told,
};

const OTHER_JOINTS: Table = &[CYCLE];

/// What a joint's name has behind that of its node where it is the one of two that scales; the other one is rigid.
const SCALES: &str = " (scale)";

/// A joint and the node of the same name.
struct Pair {
    joint: usize,
    node: usize,
    is_rigid: bool,
}

/// Joints whose name is one node's alone.
fn pairs(model: &Model, scene: &Scene) -> Vec<Pair> {
    let name = |joint: usize| model.skeleton.name(JointIndex(joint as u32));
    let all = 0..model.skeleton.joint_count();
    let pair = |joint: usize| {
        let own = name(joint)?;
        let of_node = own.strip_suffix(SCALES).unwrap_or(own);
        let mut nodes = scene
            .nodes
            .iter()
            .enumerate()
            .filter(|(_, node)| *node.element.name == *of_node);
        let (Some((node, _)), None) = (nodes.next(), nodes.next()) else {
            return None;
        };
        let is_rigid = all
            .clone()
            .any(|other| name(other).and_then(|name| name.strip_suffix(SCALES)) == Some(own));
        Some(Pair { joint, node, is_rigid })
    };
    all.clone().filter_map(pair).collect()
}

/// Their nodes in the model's space. Lengths along their axes are told in metres too.
fn their_places(scene: &Scene, pairs: &[Pair]) -> Vec<DAffine3> {
    let axes = DAffine3::from_mat3(axes(scene));
    let place = |pair: &Pair| {
        let mut place = axes * matrix(&scene.nodes[pair.node].node_to_world);
        place.matrix3 *= 1.0 / scene.metadata.root_scale;
        if pair.is_rigid {
            let [x, y, z] = columns(place.matrix3).map(DVec3::normalize);
            place.matrix3 = DMat3::from_cols(x, y, z);
        }
        place
    };
    pairs.iter().map(place).collect()
}

fn our_places(pose: &PoseBuffers, pairs: &[Pair]) -> Vec<DAffine3> {
    let place = |pair: &Pair| {
        let place = pose.model.0[pair.joint];
        DAffine3 {
            matrix3: DMat3::from_cols(
                place.matrix3.x_axis.as_dvec3(),
                place.matrix3.y_axis.as_dvec3(),
                place.matrix3.z_axis.as_dvec3(),
            ),
            translation: place.translation.as_dvec3(),
        }
    };
    pairs.iter().map(place).collect()
}

fn columns(matrix: DMat3) -> [DVec3; 3] {
    [matrix.x_axis, matrix.y_axis, matrix.z_axis]
}

/// The greatest difference in place, as a part of a size, and in axes, as a part of the longest.
fn off(ours: &[DAffine3], theirs: &[DAffine3], size: f64) -> [f64; 2] {
    let mut off = [0f64; 2];
    for (ours, theirs) in ours.iter().zip(theirs) {
        let length = columns(theirs.matrix3)
            .map(DVec3::length)
            .into_iter()
            .fold(1e-9, f64::max);
        let apart = columns(ours.matrix3 - theirs.matrix3)
            .map(DVec3::length)
            .into_iter()
            .fold(0.0, f64::max);
        let parts = [ours.translation.distance(theirs.translation) / size, apart / length];
        for (off, part) in off.iter_mut().zip(parts) {
            *off = off.max(if part.is_nan() { f64::INFINITY } else { part });
        }
    }
    off
}

fn compare(name: &str, model: &Model, scene: &Scene) -> Outcome {
    let pairs = pairs(model, scene);
    if pairs.is_empty() {
        return Outcome::Nothing("no joint has a node's name");
    }
    let rest = their_places(scene, &pairs);
    let of_joints: Vec<DVec3> = rest.iter().map(|place| place.translation).collect();
    let rest_size = size(&[of_joints, all_points(scene)].concat());
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    pose.set_rest_pose(&model.skeleton);
    let mut all = vec![("rest".to_owned(), off(&our_places(&pose, &pairs), &rest, rest_size))];
    let stacks = match stacks(model, scene) {
        Ok(stacks) => stacks,
        Err(why) => return Outcome::Wrong(why),
    };
    for (stack, clip) in stacks {
        let compiled = clip.map(CompiledClip::new);
        let measure = measure(name, (stack, clip), scene, rest_size);
        let mut worst = [0f64; 2];
        for secs in times(stack, clip) {
            let theirs = their_places(&evaluated(scene, stack, f64::from(secs)), &pairs);
            // What moves nothing is no clip.
            match &compiled {
                Some(compiled) => pose.evaluate(&model.skeleton, compiled, secs),
                None => pose.set_rest_pose(&model.skeleton),
            }
            let off = off(&our_places(&pose, &pairs), &theirs, measure);
            worst = [worst[0].max(off[0]), worst[1].max(off[1])];
        }
        all.push((told(stack, clip, measure / rest_size), worst));
    }
    let listed: Vec<String> = all
        .iter()
        .map(|(clip, [place, axes])| format!("{clip} {place:.1e}, axes {axes:.1e}"))
        .collect();
    let listed = format!(
        "{} of {} joints, of {rest_size:.2e} m at rest: {}",
        pairs.len(),
        model.skeleton.joint_count(),
        listed.join("; ")
    );
    match all.iter().all(|(_, off)| off.iter().all(|off| *off <= TOLERANCE)) {
        true => Outcome::Near(listed),
        false => Outcome::Wrong(listed),
    }
}

#[test]
fn joints_are_where_ufbx_has_them() {
    compare_all(OTHER_JOINTS, compare);
}
