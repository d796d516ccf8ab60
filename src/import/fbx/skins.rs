//! Skins: which bones move the control points of a geometry, and how they were bound.

use glam::{DAffine3, DMat4};

use super::file::{File, in_object};
use super::nodes::Nodes;
use super::objects::{Object, ObjectIndex, Objects};
use crate::diagnostic::collect::quoted;
use crate::diagnostic::{Fault, codes};
use crate::fbx::Record;
use crate::import::scene::{Skin, is_invertible};

/// What moves the control points of a geometry, wherever it is used.
pub(super) struct Weights {
    clusters: Vec<Cluster>,
    /// Whether a point has no weight: it follows the node of its mesh, by a slot behind those of the clusters.
    has_unweighted: bool,
    /// Weight and slot, by control point.
    pairs: Vec<(f32, u32)>,
    starts: Vec<u32>,
}

/// The bone of a cluster, and how it was bound as far as the file says it.
struct Cluster {
    node: u32,
    /// The space of the mesh's node -> the bone's.
    bone_from_node: Option<DAffine3>,
    /// The bone -> the world, in the file's axes.
    file_from_bone: Option<DAffine3>,
}

/// What is kept of a skin for each of its bones, in it and on each node that has its mesh: two matrices of a slot, and a joint that may stand in.
pub(super) const BYTES_PER_SLOT: u64 = 320;
/// Records of a cluster are looked through for each skin that has it.
const BYTES_PER_RECORD: u64 = 16;

/// What a control point has at most; of more the greatest are taken.
const MOST_PAIRS: usize = 64;

impl Weights {
    /// Weights with their slots of a control point: all above 0, with a sum of 1.
    pub(super) fn pairs(&self, control_point: u32) -> &[(f32, u32)] {
        let [start, end] = [0, 1].map(|step| self.starts[control_point as usize + step] as usize);
        &self.pairs[start..end]
    }

    pub(super) fn slot_count(&self) -> usize {
        self.clusters.len() + usize::from(self.has_unweighted)
    }

    /// The skin of a mesh on a node.
    pub(super) fn skin(&self, nodes: &Nodes, mesh_node: u32) -> Skin {
        let model = |node: u32| nodes.scene.nodes[node as usize].model_from_node;
        let node_from_geometry = nodes.transforms[mesh_node as usize].node_from_geometry;
        let slots = self.clusters.iter().map(|cluster| {
            // Where a cluster does not say how it was bound, it was as the scene stands.
            let at_rest = || match cluster.file_from_bone {
                Some(file_from_bone) => (nodes.model_from_file() * file_from_bone).inverse() * model(mesh_node),
                None => model(cluster.node).inverse() * model(mesh_node),
            };
            (
                cluster.node,
                cluster.bone_from_node.unwrap_or_else(at_rest) * node_from_geometry,
            )
        });
        let slots = slots.chain(self.has_unweighted.then_some((mesh_node, node_from_geometry)));
        let (joints, joint_from_mesh) = slots.unzip();
        Skin {
            joints,
            joint_from_mesh,
        }
    }

    /// Of entries with control point, weight and slot, each point below `count`.
    fn of(clusters: Vec<Cluster>, mut entries: Vec<(u32, f32, u32)>, count: usize) -> Self {
        // By point; of one point the greatest come first, and stay in the order of the clusters where they are equal.
        entries.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        let of_node = clusters.len() as u32;
        let mut weights = Self {
            clusters,
            has_unweighted: false,
            pairs: Vec::with_capacity(entries.len()),
            starts: Vec::with_capacity(count + 1),
        };
        let mut rest = entries.as_slice();
        for point in 0..count as u32 {
            weights.starts.push(weights.pairs.len() as u32);
            let (of_point, others) = rest.split_at(rest.partition_point(|entry| entry.0 <= point));
            rest = others;
            let of_point = &of_point[..of_point.len().min(MOST_PAIRS)];
            // FBX takes weights as parts of their sum.
            let sum: f64 = of_point.iter().map(|&(_, weight, _)| f64::from(weight)).sum();
            let parts = of_point
                .iter()
                .map(|&(_, weight, slot)| ((f64::from(weight) / sum) as f32, slot));
            weights.pairs.extend(parts.filter(|&(weight, _)| weight > 0.0));
            if of_point.is_empty() {
                weights.has_unweighted = true;
                weights.pairs.push((1.0, of_node));
            }
        }
        weights.starts.push(weights.pairs.len() as u32);
        weights
    }
}

/// The first skin of a geometry; `None` where it has none, or none of its bones is there.
///
/// # Errors
/// When an array is damaged, or the budget has no room for the bones.
pub(super) fn read(
    file: &mut File<'_, '_>,
    objects: &Objects<'_, '_>,
    nodes: &Nodes,
    geometry: ObjectIndex,
    control_point_count: usize,
) -> Result<Option<Weights>, Fault> {
    let geometry = objects.get(geometry);
    let mut skins = objects
        .children(geometry, "Deformer")
        .filter(|(_, deformer)| deformer.kind == "Skin");
    let Some((_, skin)) = skins.next() else { return Ok(None) };
    if let Some((_, other)) = skins.next() {
        let kind = "Geometries with several skins";
        file.note_each(other.record.place, &codes::FBX_LEFT_OUT, kind, || {
            format!("{} has several skins; the first moves it.", quoted(&geometry.name))
        });
    }
    let method = skin.record.find("SkinningType").and_then(|kind| kind.text(0));
    if method.is_some_and(|kind| matches!(&*kind, "DualQuaternion" | "Blend")) {
        let kind = "Geometries that are skinned by dual quaternions";
        file.note_each(skin.record.place, &codes::FBX_LEFT_OUT, kind, || {
            let name = quoted(&geometry.name);
            format!("{name} is skinned by dual quaternions; here it is linearly.")
        });
    }
    let mut clusters = Vec::new();
    let mut entries = Vec::new();
    for (_, cluster) in objects.children(skin, "Deformer") {
        let bytes = BYTES_PER_SLOT + BYTES_PER_RECORD * cluster.record.records.len() as u64;
        file.budget.keep(bytes, cluster.record.place)?;
        if cluster.kind != "Cluster" {
            continue;
        }
        let mut add = |point: i64, weight: f64, slot: usize| {
            let weight = weight as f32;
            let point = usize::try_from(point).ok().filter(|&point| point < control_point_count);
            if let Some(point) = point.filter(|_| weight.is_finite() && weight > 0.0) {
                entries.push((point as u32, weight, slot as u32));
            }
        };
        let slot = clusters.len();
        let read = self::cluster(file, objects, nodes, cluster, |point, weight| add(point, weight, slot))?;
        clusters.extend(read);
    }
    let is_none = clusters.is_empty();
    Ok((!is_none).then(|| Weights::of(clusters, entries, control_point_count)))
}

fn cluster(
    file: &mut File<'_, '_>,
    objects: &Objects<'_, '_>,
    nodes: &Nodes,
    cluster: &Object<'_, '_>,
    add: impl FnMut(i64, f64),
) -> Result<Option<Cluster>, Fault> {
    let record = cluster.record;
    let mut bones = objects.children(cluster, "Model");
    let bone = bones.find_map(|(model, _)| Some((model, nodes.node_of[model.index()]?)));
    let Some((bone, node)) = bone else {
        let kind = "Clusters without a bone";
        file.note_each(record.place, &codes::FBX_RULE_BROKEN, kind, || {
            let name = quoted(&cluster.name);
            format!("Cluster {name} names no bone; its weights are left out.")
        });
        return Ok(None);
    };
    let named = in_object(&cluster.name);
    let points = record.integers_of("Indexes", &file.budget).map_err(&named)?;
    let weights = record.numbers_of("Weights", &file.budget).map_err(&named)?;
    if points.len() != weights.len() {
        let kind = "Clusters with more control points than weights, or fewer";
        file.note_each(record.place, &codes::FBX_RULE_BROKEN, kind, || {
            let counts = format!("{} control points, but {} weights", points.len(), weights.len());
            format!("Cluster {} has {counts}.", quoted(&cluster.name))
        });
    }
    let mut add = add;
    points
        .iter()
        .zip(&weights)
        .for_each(|(&point, &weight)| add(point, weight));
    let [bone_from_node, file_from_bone] =
        ["Transform", "TransformLink"].map(|name| matrix(record, name, file).map_err(&named));
    let (bone_from_node, file_from_bone) = (bone_from_node?, file_from_bone?);
    if let (Some(link), Some(posed)) = (file_from_bone, file.bind_pose.get(&bone))
        && !link.abs_diff_eq(*posed, 1e-3 * (1.0 + link.translation.length()))
    {
        file.disagreeing.insert(bone);
    }
    Ok(Some(Cluster {
        node,
        bone_from_node: bone_from_node.filter(is_invertible),
        file_from_bone: file_from_bone.filter(is_invertible),
    }))
}

/// The matrix of this name in a record, lengths in metres: sixteen numbers, column by column as we have them. `None` without it.
///
/// # Errors
/// When the array is damaged.
pub(super) fn matrix(record: &Record<'_>, name: &str, file: &File<'_, '_>) -> Result<Option<DAffine3>, Fault> {
    let numbers = record.numbers_of(name, &file.budget)?;
    let matrix = numbers.first_chunk().map(DMat4::from_cols_array);
    let matrix = matrix.map(DAffine3::from_mat4).filter(|matrix| matrix.is_finite());
    Ok(matrix.map(|matrix| DAffine3 {
        translation: matrix.translation * file.settings.unit_metres,
        ..matrix
    }))
}
