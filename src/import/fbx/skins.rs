//! Skins: which bones move the control points of a geometry, and how they were bound.

use glam::{DAffine3, DMat4};

use super::file::File;
use super::nodes::Nodes;
use super::objects::{Object, ObjectIndex, Objects};
use crate::diagnostic::{Fault, codes};
use crate::fbx::Record;
use crate::import::scene::{Skin, is_invertible};

/// The weights of a geometry's control points, and the bones of each slot.
pub(super) struct Bound {
    /// Bones and, of each, geometry -> bone. What stands behind the clusters is the node of the geometry itself, for points without weights.
    pub(super) skin: Skin,
    /// Weight and slot, by control point.
    pairs: Vec<(f32, u32)>,
    starts: Vec<u32>,
}

impl Bound {
    /// Weights with their slots of a control point: all above 0.
    pub(super) fn pairs(&self, control_point: u32) -> &[(f32, u32)] {
        let [start, end] = [0, 1].map(|step| self.starts[control_point as usize + step] as usize);
        &self.pairs[start..end]
    }
}

/// A cluster, as far as the file says it.
struct Cluster {
    node: u32,
    geometry_from_bone: DAffine3,
    points: Vec<i64>,
    weights: Vec<f64>,
}

/// The first skin of a geometry; `None` where it has none, or none of its bones is there.
///
/// # Errors
/// When an array is damaged.
pub(super) fn read(
    file: &mut File<'_, '_>,
    objects: &Objects<'_, '_>,
    nodes: &Nodes,
    (geometry, mesh_node): (ObjectIndex, u32),
    control_point_count: usize,
) -> Result<Option<Bound>, Fault> {
    let geometry = objects.get(geometry);
    let mut skins = objects
        .children(geometry, "Deformer")
        .filter(|(_, deformer)| deformer.kind == "Skin");
    let Some((_, skin)) = skins.next() else { return Ok(None) };
    if let Some((_, other)) = skins.next() {
        let message = format!("\"{}\" has several skins; the first moves it.", geometry.name);
        file.note_of(other.record.place, &codes::FBX_LEFT_OUT, message);
    }
    let is_dual = skin
        .record
        .find("SkinningType")
        .and_then(|kind| kind.text(0))
        .is_some_and(|kind| matches!(&*kind, "DualQuaternion" | "Blend"));
    if is_dual {
        let message = format!(
            "\"{}\" is skinned by dual quaternions; here it is linearly.",
            geometry.name
        );
        file.note_of(skin.record.place, &codes::FBX_LEFT_OUT, message);
    }
    let node_from_geometry = nodes.transforms[mesh_node as usize].node_from_geometry;
    let mut clusters = Vec::new();
    for (_, cluster) in objects
        .children(skin, "Deformer")
        .filter(|(_, deformer)| deformer.kind == "Cluster")
    {
        clusters.extend(self::cluster(file, objects, nodes, cluster, mesh_node)?);
    }
    if clusters.is_empty() {
        return Ok(None);
    }
    // By control point, in the order of the clusters.
    let is_weight = |weight: f64| (weight as f32).is_finite() && weight as f32 > 0.0;
    let entries = || {
        clusters.iter().enumerate().flat_map(|(slot, cluster)| {
            let pairs = cluster.points.iter().zip(&cluster.weights);
            let pairs = pairs.filter_map(|(&point, &weight)| Some((usize::try_from(point).ok()?, weight)));
            pairs
                .filter(|&(point, weight)| point < control_point_count && is_weight(weight))
                .map(move |(point, weight)| (point, weight as f32, slot as u32))
        })
    };
    let mut starts = vec![0u32; control_point_count + 1];
    entries().for_each(|(point, _, _)| starts[point + 1] += 1);
    let rests = starts[1..].contains(&0);
    if rests {
        starts[1..].iter_mut().for_each(|count| *count = (*count).max(1));
    }
    for point in 0..control_point_count {
        starts[point + 1] += starts[point];
    }
    let of_node = clusters.len() as u32;
    let mut pairs = vec![(1.0, of_node); starts[control_point_count] as usize];
    let mut next = starts.clone();
    for (point, weight, slot) in entries() {
        pairs[next[point] as usize] = (weight, slot);
        next[point] += 1;
    }
    // FBX takes weights as parts of their sum.
    for point in 0..control_point_count {
        let of_point = &mut pairs[starts[point] as usize..starts[point + 1] as usize];
        let sum: f64 = of_point.iter().map(|&(weight, _)| f64::from(weight)).sum();
        of_point
            .iter_mut()
            .for_each(|(weight, _)| *weight = (f64::from(*weight) / sum) as f32);
    }
    let slots = clusters
        .iter()
        .map(|cluster| (cluster.node, cluster.geometry_from_bone * node_from_geometry));
    let slots = slots.chain(rests.then_some((mesh_node, node_from_geometry)));
    let (joints, joint_from_mesh) = slots.unzip();
    Ok(Some(Bound {
        skin: Skin {
            joints,
            joint_from_mesh,
        },
        pairs,
        starts,
    }))
}

fn cluster(
    file: &mut File<'_, '_>,
    objects: &Objects<'_, '_>,
    nodes: &Nodes,
    cluster: &Object<'_, '_>,
    mesh_node: u32,
) -> Result<Option<Cluster>, Fault> {
    let record = cluster.record;
    let Some(node) = objects
        .children(cluster, "Model")
        .find_map(|(model, _)| nodes.node_of[model.index()])
    else {
        let message = format!("Cluster \"{}\" names no bone; its weights are left out.", cluster.name);
        file.note_of(record.place, &codes::FBX_RULE_BROKEN, message);
        return Ok(None);
    };
    let budget = &file.budget;
    let integers = |name: &str| {
        record
            .find(name)
            .map_or_else(|| Ok(Vec::new()), |found| found.integers(budget))
    };
    let numbers = |name: &str| {
        record
            .find(name)
            .map_or_else(|| Ok(Vec::new()), |found| found.numbers(budget))
    };
    let (points, weights) = (integers("Indexes")?, numbers("Weights")?);
    let [transform, link] = ["Transform", "TransformLink"].map(|name| record.find(name));
    let matrix = |found: Option<&Record<'_>>| found.map_or(Ok(None), |found| matrix(found, file));
    let (bone_from_node, model_from_bone) = (matrix(transform)?, matrix(link)?);
    let model = |node: u32| nodes.scene.nodes[node as usize].model_from_node;
    // Where a cluster does not say how it was bound, it was as the scene stands.
    let at_rest = || model_from_bone.unwrap_or_else(|| model(node)).inverse() * model(mesh_node);
    let bone_from_node = bone_from_node.filter(is_invertible).unwrap_or_else(at_rest);
    if points.len() != weights.len() {
        let message = format!(
            "Cluster \"{}\" has {} control points, but {} weights.",
            cluster.name,
            points.len(),
            weights.len()
        );
        file.note_of(record.place, &codes::FBX_RULE_BROKEN, message);
    }
    if let (Some(link), Some(posed)) = (
        model_from_bone,
        file.bind_pose.get(&cluster_bone(objects, cluster)).copied(),
    ) && !link.abs_diff_eq(posed, 1e-3 * (1.0 + link.translation.length()))
    {
        file.disagreeing += 1;
    }
    Ok(Some(Cluster {
        node,
        geometry_from_bone: bone_from_node,
        points,
        weights,
    }))
}

fn cluster_bone(objects: &Objects<'_, '_>, cluster: &Object<'_, '_>) -> ObjectIndex {
    let mut bones = objects.children(cluster, "Model");
    bones.next().map_or(ObjectIndex(u32::MAX), |(bone, _)| bone)
}

/// Sixteen numbers, column by column as we have them.
///
/// # Errors
/// When the array is damaged.
pub(super) fn matrix(record: &Record<'_>, file: &File<'_, '_>) -> Result<Option<DAffine3>, Fault> {
    let numbers = record.numbers(&file.budget)?;
    let matrix = numbers.first_chunk().map(DMat4::from_cols_array);
    Ok(matrix.map(DAffine3::from_mat4).filter(|matrix| matrix.is_finite()))
}
