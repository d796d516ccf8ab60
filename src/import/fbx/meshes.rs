//! The geometries of a file as one mesh: each on the nodes that have it, moved by its skin or by its node.

use std::collections::HashMap;
use std::sync::Arc;

use glam::DAffine3;

use super::file::{File, in_object};
use super::geometry::{self, BYTES_PER_TRIANGLE, BYTES_PER_VERTEX, Geometry};
use super::materials::Materials;
use super::nodes::{self, Nodes};
use super::objects::{ObjectIndex, Objects};
use super::skins::{self, BYTES_PER_SLOT, Weights};
use crate::diagnostic::collect::{Diagnostics, counted, quoted};
use crate::diagnostic::{Fault, codes};
use crate::fbx::Place;
use crate::import::scene::{MeshBuilder, MeshUse, Rig};
use crate::model::{Influences, Mesh, Object};
use crate::slices::{Slices, Stage};
use crate::sorting;

/// What is kept of a part of a mesh on each node that has it, besides what its triangles take.
const BYTES_PER_PART: u64 = 64;

/// The geometries that nodes have, with their skins.
#[derive(Default)]
pub(super) struct Meshes {
    geometries: Vec<(ObjectIndex, Geometry, Option<Weights>)>,
}

/// The meshes of a scene as one.
pub(super) struct Meshed {
    pub(super) mesh: Mesh,
    pub(super) objects: Vec<(MeshUse, Object)>,
    /// Of each submesh: where its geometry begins.
    pub(super) places: Vec<Place>,
}

impl Meshes {
    /// Reads the geometries and skins of a file, and tells the scene of them.
    ///
    /// # Errors
    /// When an array is damaged, or a corner names a control point that is not there.
    pub(super) async fn read(
        file: &mut File<'_, '_>,
        objects: &Objects<'_, '_>,
        nodes: &mut Nodes,
        slices: &Slices,
    ) -> Result<Self, Fault> {
        let mut meshes = Self::default();
        let mut uses: Vec<(ObjectIndex, u32)> = Vec::new();
        let mut known = HashMap::new();
        let mut has_points = |index: &ObjectIndex| {
            let find = || objects.get(*index).record.find("Vertices").is_some();
            *known.entry(*index).or_insert_with(find)
        };
        for (node, &object) in (0u32..).zip(nodes.models()) {
            let model = objects.get(object);
            // In files of 6.1 a model is its own geometry.
            let hanging = objects.children(model, "Geometry");
            let hanging = hanging.filter(|(_, geometry)| geometry.kind != "Shape");
            let all = [object].into_iter().chain(hanging.map(|(index, _)| index));
            uses.extend(all.filter(&mut has_points).map(|geometry| (geometry, node)));
        }
        sorting::sort(&mut uses);
        for (at, &(index, node)) in uses.iter().enumerate() {
            slices.pause_at(Stage::Building, at, uses.len()).await;
            let object = objects.get(index);
            let is_first = meshes.geometries.last().is_none_or(|(before, ..)| *before != index);
            if is_first {
                let geometry = geometry::read((object.record, &object.name), file, slices).await;
                let geometry = geometry.map_err(in_object(&object.name))?;
                if geometry.left_out > 0 {
                    let kind = "Geometries with polygons of fewer than three corners";
                    file.note_each(object.record.place, &codes::FBX_LEFT_OUT, kind, || {
                        format!(
                            "{} of {} with fewer than three corners; left out.",
                            counted(geometry.left_out, "polygon", "polygons"),
                            quoted(&object.name)
                        )
                    });
                }
                let weights = match geometry.parts.is_empty() {
                    true => None,
                    false => skins::read(file, objects, nodes, index, geometry.control_point_count)?,
                };
                nodes.scene.meshes.push(Arc::new(nodes::tag(object)));
                meshes.geometries.push((index, geometry, weights));
            }
            let mesh = meshes.geometries.len() - 1;
            let (_, geometry, weights) = &meshes.geometries[mesh];
            if geometry.parts.is_empty() {
                continue;
            }
            let triangles: usize = geometry.parts.iter().map(|part| part.triangles.len()).sum();
            let slots = weights.as_ref().map_or(0, Weights::slot_count);
            // Those of the first use were asked for while they were read.
            let copied = BYTES_PER_VERTEX * geometry.control_points.len() as u64
                + BYTES_PER_TRIANGLE * triangles as u64
                + BYTES_PER_SLOT * slots as u64;
            let bytes = if is_first { 0 } else { copied }
                + BYTES_PER_PART * geometry.parts.len() as u64
                + nodes.scene.nodes[node as usize].tag.name.len() as u64;
            file.budget.keep(bytes, object.record.place)?;
            let skin = weights.as_ref().map(|weights| {
                let skin = weights.skin(nodes, node);
                nodes.scene.skins.push(Some(skin));
                nodes.scene.skins.len() - 1
            });
            nodes.scene.uses.push(MeshUse {
                mesh,
                node,
                skin,
                is_on_node: skin.is_none(),
            });
        }
        Ok(meshes)
    }

    /// The mesh of the scene, and its objects.
    ///
    /// # Errors
    /// When there are more vertices than numbers for them.
    pub(super) async fn mesh(
        &self,
        nodes: &Nodes,
        (objects, materials): (&Objects<'_, '_>, &Materials),
        rig: &Rig,
        diagnostics: &mut Diagnostics,
        slices: &Slices,
    ) -> Result<Meshed, Fault> {
        let scene = &nodes.scene;
        let normal_maps = materials.materials.iter().any(|material| material.normal_map.is_some());
        let mut builder = MeshBuilder::new(normal_maps, false);
        let mut places = Vec::new();
        for (at, mesh) in scene.uses.iter().enumerate() {
            slices.pause_at(Stage::Building, at, scene.uses.len()).await;
            let (object, geometry, weights) = &self.geometries[mesh.mesh];
            let place = objects.get(*object).record.place;
            let start = builder.vertex_count() as u32;
            let influences = influences(&mut builder, geometry, weights.as_ref(), rig, mesh);
            let node_from_geometry = match weights {
                // A skin's matrices have it.
                Some(_) => DAffine3::IDENTITY,
                None => nodes.transforms[mesh.node as usize].node_from_geometry,
            };
            let placement = rig.placement(mesh, weights.is_some()) * node_from_geometry;
            let too_many = || {
                Box::new(place.says(
                    &codes::FBX_DAMAGED,
                    "There are more vertices or triangles than numbers for them.",
                ))
            };
            builder.add_vertices(&geometry.vertices, influences, &placement, too_many)?;
            let is_mirrored = placement.matrix3.determinant() < 0.0;
            let of_node = objects.hanging(objects.get(nodes.objects[mesh.node as usize]), "Material");
            for part in &geometry.parts {
                slices.pause().await;
                let material = materials.index(of_node.get(part.material).map(|material| material.to));
                builder.add_triangles(part.triangles.iter().copied(), (start, is_mirrored), material, too_many)?;
                places.push(place);
            }
            builder.end_object(*mesh);
        }
        Ok(Meshed {
            objects: builder.objects(scene),
            mesh: builder.finish(diagnostics, slices).await?,
            places,
        })
    }
}

fn influences(
    builder: &mut MeshBuilder,
    geometry: &Geometry,
    weights: Option<&Weights>,
    rig: &Rig,
    mesh: &MeshUse,
) -> Vec<Influences> {
    let count = geometry.control_points.len();
    let (Some(weights), Some(joints)) = (weights, rig.slots(mesh, true)) else {
        let influences = rig.influences_on(mesh.node);
        return influences.map_or_else(Vec::new, |influences| vec![influences; count]);
    };
    let first = builder.vertex_count() as u32;
    let mut pairs = Vec::new();
    let all = (first..).zip(&geometry.control_points).map(|(vertex, &point)| {
        pairs.clear();
        pairs.extend(
            weights
                .pairs(point)
                .iter()
                .map(|&(weight, slot)| (weight, joints[slot as usize])),
        );
        builder.weights.strongest(vertex, &mut pairs)
    });
    all.collect()
}
