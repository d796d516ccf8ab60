//! Models of a file as nodes of a scene: who is whose parent, and where each is.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};

use super::objects::{ObjectIndex, Objects};
use super::transform::{Inherit, Transform};
use crate::fbx::Document;
use crate::import::scene::{self, Scene};
use crate::model::{LocalJoint, Tag};

/// Nodes, with what only FBX knows of them.
pub(super) struct Nodes {
    pub(super) scene: Scene,
    /// Of each node.
    pub(super) transforms: Vec<Transform>,
    /// Of each node.
    pub(super) objects: Vec<ObjectIndex>,
    /// Of each object: its node.
    pub(super) node_of: Vec<Option<u32>>,
    /// Nodes that are below themselves: they hang on the scene.
    pub(super) tangled: Vec<ObjectIndex>,
    /// Axes of the file -> x right, y up, z towards the viewer.
    pub(super) model_from_file: DMat3,
    /// Centimetres of a unit.
    pub(super) unit_cm: f64,
}

/// The parts of a node's local transform at a time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts {
    pub(super) translation: DVec3,
    /// Degrees.
    pub(super) rotation: DVec3,
    pub(super) scale: DVec3,
}

impl Transform {
    /// Those of the node where no clip moves it.
    pub(super) fn parts(&self) -> Parts {
        Parts {
            translation: self.translation,
            rotation: self.rotation,
            scale: self.scale,
        }
    }
}

impl Nodes {
    pub(super) fn of(document: &Document<'_>, objects: &Objects<'_, '_>) -> Self {
        let models: Vec<ObjectIndex> = objects.of_class("Model").map(|(index, _)| index).collect();
        let mut node_of = vec![None; objects.all.len()];
        for (node, model) in (0u32..).zip(&models) {
            node_of[model.index()] = Some(node);
        }
        let parent = |model: &ObjectIndex| {
            let parents = objects.get(*model).parents.iter();
            parents.filter(|parent| parent.property.is_empty()).find_map(|parent| node_of[parent.to.index()])
        };
        let mut parents: Vec<Option<u32>> = models.iter().map(parent).collect();
        let mut order = scene::parents_first(&parents, Some);
        let mut tangled = Vec::new();
        if order.len() < parents.len() {
            let mut is_reached = vec![false; parents.len()];
            for &node in &order {
                is_reached[node as usize] = true;
            }
            for node in 0..parents.len() {
                if !is_reached[node] && is_below_itself(node as u32, &parents) {
                    tangled.push(models[node]);
                    parents[node] = None;
                }
            }
            order = scene::parents_first(&parents, Some);
        }
        let transforms: Vec<Transform> = models.iter().map(|&model| Transform::of(objects.get(model))).collect();
        let (model_from_file, unit_cm) = settings(document);
        let mut nodes = Self {
            scene: Scene {
                parents,
                order,
                ..Scene::default()
            },
            transforms,
            objects: models,
            node_of,
            tangled,
            model_from_file,
            unit_cm,
        };
        let parts: Vec<Parts> = nodes.transforms.iter().map(Transform::parts).collect();
        let (local, model_from_node) = nodes.placed(&parts);
        nodes.scene.nodes = nodes
            .objects
            .iter()
            .enumerate()
            .map(|(node, &object)| scene::Node {
                tag: Tag {
                    name: objects.get(object).name.clone().into_owned(),
                    extras: None,
                },
                local: LocalJoint::from_matrix(&local[node]),
                model_from_node: model_from_node[node],
                in_scene: true,
                is_moved: false,
                bone: None,
            })
            .collect();
        nodes.scene.meshes = objects
            .of_class("Geometry")
            .map(|(_, object)| {
                Arc::new(Tag {
                    name: object.name.clone().into_owned(),
                    extras: None,
                })
            })
            .collect();
        nodes
    }

    /// Each node relative to its parent and to the model, with these parts.
    ///
    /// A node may have its parent's scale in other ways than whole. Where `Ps` is the scale of all nodes above it, and `ps` the parent's own, it is
    /// `T · Ps⁻¹ · R · Ps · S` or `T · ps⁻¹ · R · S` then: Autodesk's `FbxTransform::EInheritType`.
    pub(super) fn placed(&self, parts: &[Parts]) -> (Vec<DAffine3>, Vec<DAffine3>) {
        let count = parts.len();
        let mut local = vec![DAffine3::IDENTITY; count];
        let mut model = vec![DAffine3::IDENTITY; count];
        let mut scales = vec![DVec3::ONE; count];
        let root = DAffine3::from_mat3(self.model_from_file);
        for &node in &self.scene.order {
            let node = node as usize;
            let Parts { translation, rotation, scale } = parts[node];
            let transform = &self.transforms[node];
            let plain = transform.parent_from_node(translation, rotation, scale);
            let parent = self.scene.parents[node].map(|parent| parent as usize);
            local[node] = match (parent, transform.inherit) {
                (None, _) => root * plain,
                (Some(_), Inherit::Whole) => plain,
                (Some(parent), Inherit::NoScale) => without(plain, parts[parent].scale, DVec3::ONE),
                (Some(parent), Inherit::ScaleAfterRotation) => {
                    let turned = transform.parent_from_node(translation, rotation, DVec3::ONE);
                    let between = without(turned, scales[parent], scales[parent]);
                    DAffine3 {
                        matrix3: between.matrix3 * DMat3::from_diagonal(scale),
                        translation: plain.translation,
                    }
                }
            };
            scales[node] = scale * parent.map_or(DVec3::ONE, |parent| scales[parent]);
            model[node] = parent.map_or(local[node], |parent| model[parent] * local[node]);
        }
        (local, model)
    }
}

/// `before⁻¹ · M · after` for the turning part. A scale of 0 stays: nothing undoes it.
fn without(matrix: DAffine3, before: DVec3, after: DVec3) -> DAffine3 {
    let undone = before.map(|part| if part == 0.0 { 1.0 } else { part.recip() });
    DAffine3 {
        matrix3: DMat3::from_diagonal(undone) * matrix.matrix3 * DMat3::from_diagonal(after),
        ..matrix
    }
}

/// Whether going up from a node leads to it again. A way is no longer than there are nodes.
fn is_below_itself(node: u32, parents: &[Option<u32>]) -> bool {
    let mut at = parents[node as usize];
    for _ in 0..parents.len() {
        match at {
            None => return false,
            Some(above) if above == node => return true,
            Some(above) => at = parents[above as usize],
        }
    }
    false
}

/// Axes and unit of the file.
fn settings(document: &Document<'_>) -> (DMat3, f64) {
    let settings = document.find("GlobalSettings").or_else(|| document.find("Version5").and_then(|version| version.find("Settings")));
    let properties = settings.and_then(|settings| settings.find("Properties70").or_else(|| settings.find("Properties60")));
    let number = |name: &str, default: f64| {
        let of = |record: &&crate::fbx::Record<'_>| record.bytes(0) == Some(name.as_bytes());
        let found = properties.and_then(|properties| properties.records.iter().find(of));
        let found = found.and_then(|record| record.number(if record.name == "P" { 4 } else { 3 }));
        found.filter(|number| number.is_finite()).unwrap_or(default)
    };
    let axis = |name: &str, default: f64| {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let axis = axes[(number(name, default) as usize).min(2)];
        axis * if number(&format!("{name}Sign"), 1.0) < 0.0 { -1.0 } else { 1.0 }
    };
    let [right, up, front] = [axis("CoordAxis", 0.0), axis("UpAxis", 1.0), axis("FrontAxis", 2.0)];
    let rows = DMat3::from_cols(right, up, front).transpose();
    let is_whole = rows.determinant().abs() == 1.0;
    (if is_whole { rows } else { DMat3::IDENTITY }, number("UnitScaleFactor", 1.0))
}
