//! Models of a file as nodes of a scene: who is whose parent, and where each is.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::objects::{Object, ObjectIndex, Objects};
use super::transform::{Inherit, Local, Parts, Transform};
use crate::fbx::Document;
use crate::import::scene::{self, Scene};
use crate::model::Tag;

/// Nodes, with what only FBX knows of them.
pub(super) struct Nodes {
    pub(super) scene: Scene,
    /// Of each node.
    pub(super) transforms: Vec<Transform>,
    /// Of each node.
    pub(super) objects: Vec<ObjectIndex>,
    /// Of each object: its node.
    pub(super) node_of: Vec<Option<u32>>,
    /// Nodes that were below themselves: they hang on the scene.
    pub(super) tangled: Vec<ObjectIndex>,
    /// Axes of the file -> x right, y up, z towards the viewer.
    model_from_file: DMat3,
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
        let tangled = untangle(&mut parents).into_iter().map(|node| models[node as usize]).collect();
        let transforms: Vec<Transform> = models.iter().map(|&model| Transform::of(objects.get(model))).collect();
        let mut nodes = Self {
            scene: Scene {
                order: scene::parents_first(&parents, Some),
                parents,
                ..Scene::default()
            },
            transforms,
            objects: models,
            node_of,
            tangled,
            model_from_file: axes(document),
        };
        nodes.place(objects);
        nodes
    }

    /// Fills the scene's nodes with where they are at rest.
    fn place(&mut self, objects: &Objects<'_, '_>) {
        let rest = |node: u32| self.transforms[node as usize].parts();
        let mut model_from_node = vec![DAffine3::IDENTITY; self.objects.len()];
        for &node in &self.scene.order {
            let local = self.local_matrix(node, &rest);
            let parent = self.scene.parents[node as usize];
            model_from_node[node as usize] = parent.map_or(local, |parent| model_from_node[parent as usize] * local);
        }
        let nodes = (0u32..).zip(&self.objects).map(|(node, &object)| scene::Node {
            tag: tag(objects.get(object)),
            local: self.local(node, &rest).joint(),
            model_from_node: model_from_node[node as usize],
            in_scene: true,
            is_moved: false,
            bone: None,
        });
        self.scene.nodes = nodes.collect();
    }

    /// Where a node is relative to its parent, with these parts of it and of those above. What no rotation and scale make is brought to the nearest.
    pub(super) fn local(&self, node: u32, parts: &dyn Fn(u32) -> Parts) -> Local {
        let plain = self.transforms[node as usize].local(parts(node));
        match self.scene.parents[node as usize] {
            None if self.model_from_file == DMat3::IDENTITY => plain,
            None if self.model_from_file.determinant() > 0.0 => Local {
                translation: self.model_from_file * plain.translation,
                rotation: DQuat::from_mat3(&self.model_from_file) * plain.rotation,
                ..plain
            },
            Some(parent) if self.inherit(node) == Inherit::Whole || self.scale_below(parent, parts) == DVec3::ONE => plain,
            _ => Local::of_matrix(self.local_matrix(node, parts)),
        }
    }

    fn local_matrix(&self, node: u32, parts: &dyn Fn(u32) -> Parts) -> DAffine3 {
        let plain = self.transforms[node as usize].local(parts(node));
        let Some(parent) = self.scene.parents[node as usize] else {
            return DAffine3::from_mat3(self.model_from_file) * plain.matrix();
        };
        if self.inherit(node) == Inherit::Whole {
            return plain.matrix();
        }
        // In the parent's space, where its scale acts on what lies in it.
        let undone = self.scale_below(parent, parts).map(|part| if part == 0.0 { 1.0 } else { part.recip() });
        let scaled = Local {
            translation: DVec3::ZERO,
            scale: plain.scale * self.scale_from_above(node, parts),
            ..plain
        };
        DAffine3 {
            matrix3: DMat3::from_diagonal(undone) * scaled.matrix().matrix3,
            translation: plain.translation,
        }
    }

    fn inherit(&self, node: u32) -> Inherit {
        self.transforms[node as usize].inherit
    }

    /// The scale that acts on what lies in a node: its own, and what it has from above by itself.
    fn scale_below(&self, node: u32, parts: &dyn Fn(u32) -> Parts) -> DVec3 {
        parts(node).scale * self.scale_from_above(node, parts)
    }

    /// The scale that a node has from those above in another way than by lying in them.
    fn scale_from_above(&self, node: u32, parts: &dyn Fn(u32) -> Parts) -> DVec3 {
        let mut scale = DVec3::ONE;
        let mut node = node;
        while let (inherit @ (Inherit::ScaleAfterRotation | Inherit::NoScale), Some(parent)) =
            (self.inherit(node), self.scene.parents[node as usize])
        {
            if inherit == Inherit::ScaleAfterRotation {
                scale *= parts(parent).scale;
            }
            node = parent;
        }
        scale
    }

    /// The nodes on whose parts the place of a node depends, itself first.
    pub(super) fn moved_by(&self, node: u32) -> Vec<u32> {
        let mut nodes = vec![node];
        let mut at = node;
        while let (Inherit::ScaleAfterRotation | Inherit::NoScale, Some(parent)) = (self.inherit(at), self.scene.parents[at as usize]) {
            nodes.push(parent);
            at = parent;
        }
        nodes
    }
}

/// Name of an object.
pub(super) fn tag(object: &Object<'_, '_>) -> Tag {
    Tag {
        name: object.name.clone().into_owned(),
        extras: None,
    }
}

pub(super) fn mesh_tag(object: &Object<'_, '_>) -> Arc<Tag> {
    Arc::new(tag(object))
}

/// Takes a node of each circle off its parent; which these are.
fn untangle(parents: &mut [Option<u32>]) -> Vec<u32> {
    // By which walk upwards a node was reached first.
    let mut walks = vec![0u32; parents.len()];
    let mut tangled = Vec::new();
    for start in 0..parents.len() as u32 {
        let walk = start + 1;
        let mut at = Some(start);
        while let Some(node) = at {
            let reached = std::mem::replace(&mut walks[node as usize], walk);
            if reached == walk {
                parents[node as usize] = None;
                tangled.push(node);
            }
            at = if reached == 0 { parents[node as usize] } else { None };
            if reached != 0 {
                walks[node as usize] = reached;
            }
        }
    }
    tangled
}

/// The file's axes -> those of a model: its own words say which axis points to the right, up, and to the front.
fn axes(document: &Document<'_>) -> DMat3 {
    let settings = document.find("GlobalSettings").or_else(|| document.find("Version5").and_then(|version| version.find("Settings")));
    let settings = settings.and_then(|settings| settings.find("Properties70").or_else(|| settings.find("Properties60")));
    let integer = |name: &str, default: i64| {
        let of = |record: &&crate::fbx::Record<'_>| record.bytes(0) == Some(name.as_bytes());
        let found = settings.and_then(|settings| settings.records.iter().find(of));
        found.and_then(|record| record.integer(if record.name == "P" { 4 } else { 3 })).unwrap_or(default)
    };
    let axis = |name: &str, default: i64| {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let axis = axes[integer(name, default).clamp(0, 2) as usize];
        axis * if integer(&format!("{name}Sign"), 1) < 0 { -1.0 } else { 1.0 }
    };
    let rows = DMat3::from_cols(axis("CoordAxis", 0), axis("UpAxis", 1), axis("FrontAxis", 2)).transpose();
    // Some name an axis twice.
    if rows.determinant().abs() == 1.0 { rows } else { DMat3::IDENTITY }
}
