//! Models of a file as nodes of a scene: who is whose parent, and where each is.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::objects::{Object, ObjectIndex, Objects};
use super::transform::{Inherit, Local, Parts, Transform};
use crate::fbx::Document;
use crate::import::scene::{self, Scene};
use crate::model::Tag;

/// Of so many models above it the scale of one depends at most: chains of joints that do not inherit scale are shorter.
const MOST_DEPTH: usize = 64;

/// Nodes, with what only FBX knows of them.
///
/// A node whose scale differs by axis, and does not act wholly on what is below, becomes two: a rigid one, and on it one that scales. The first have the
/// numbers of the file's models, so that what hangs on a model hangs on the one that scales; rigid ones stand behind all of them.
pub(super) struct Nodes {
    pub(super) scene: Scene,
    /// Of each node.
    pub(super) transforms: Vec<Transform>,
    /// Of each node.
    pub(super) objects: Vec<ObjectIndex>,
    /// Of each object: its node.
    pub(super) node_of: Vec<Option<u32>>,
    /// Of each model: the one above it in the file.
    above: Vec<Option<u32>>,
    /// Of each model: its rigid node.
    rigid: Vec<Option<u32>>,
    /// Of each node: the model that it is of.
    model_of: Vec<u32>,
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
            parents
                .filter(|parent| parent.property.is_empty())
                .find_map(|parent| node_of[parent.to.index()])
        };
        let mut parents: Vec<Option<u32>> = models.iter().map(parent).collect();
        let tangled = untangle(&mut parents)
            .into_iter()
            .map(|node| models[node as usize])
            .collect();
        let transforms: Vec<Transform> = models.iter().map(|&model| Transform::of(objects.get(model))).collect();
        Self {
            scene: Scene::default(),
            rigid: vec![None; parents.len()],
            model_of: (0..parents.len() as u32).collect(),
            above: parents,
            transforms,
            objects: models,
            node_of,
            tangled,
            model_from_file: axes(document),
        }
    }

    /// Makes the scene of the nodes, with where they are at rest. `differs` tells whether the scale of a model's own differs by axis, at rest or in a clip.
    pub(super) fn place(&mut self, objects: &Objects<'_, '_>, differs: impl Fn(u32) -> bool) {
        let models = 0..self.above.len() as u32;
        let differs: Vec<bool> = models.clone().map(differs).collect();
        let mut asks = vec![false; differs.len()];
        for model in models.clone().filter(|&model| self.inherit(model) != Inherit::Whole) {
            if let Some(above) = self.above[model as usize] {
                asks[above as usize] = true;
            }
        }
        for model in models.clone() {
            if asks[model as usize] && self.moved_by(model).iter().any(|&model| differs[model as usize]) {
                self.rigid[model as usize] = Some(self.objects.len() as u32);
                self.objects.push(self.objects[model as usize]);
                self.transforms.push(self.transforms[model as usize]);
                self.model_of.push(model);
            }
        }
        let parent = |node: u32| {
            let model = self.model_of[node as usize];
            match self.rigid[model as usize] {
                Some(rigid) if rigid != node => Some(rigid),
                _ => {
                    let above = self.above[model as usize]?;
                    let rigid = self.rigid[above as usize].filter(|_| self.inherit(model) != Inherit::Whole);
                    Some(rigid.unwrap_or(above))
                }
            }
        };
        self.scene.parents = (0..self.objects.len() as u32).map(parent).collect();
        self.scene.order = scene::parents_first(&self.scene.parents, Some);
        let rest = |model: u32| self.transforms[model as usize].parts();
        let mut model_from_node = vec![DAffine3::IDENTITY; self.objects.len()];
        for &node in &self.scene.order {
            let local = self.local(node, &rest).matrix();
            let parent = self.scene.parents[node as usize];
            model_from_node[node as usize] = parent.map_or(local, |parent| model_from_node[parent as usize] * local);
        }
        let nodes = (0u32..).zip(&self.objects).map(|(node, &object)| {
            let mut tag = tag(objects.get(object));
            if self.rigid.get(node as usize).is_some_and(Option::is_some) {
                tag.name += " (scale)";
            }
            scene::Node {
                tag,
                local: self.local(node, &rest).joint(),
                model_from_node: model_from_node[node as usize],
                in_scene: true,
                is_moved: false,
                bone: None,
            }
        });
        self.scene.nodes = nodes.collect();
    }

    /// Where a node is relative to its parent; `parts` are those of models.
    pub(super) fn local(&self, node: u32, parts: &dyn Fn(u32) -> Parts) -> Local {
        let model = self.model_of[node as usize];
        let plain = self.transforms[model as usize].local(parts(model));
        let rigid = self.rigid[model as usize];
        if rigid.is_some_and(|rigid| rigid != node) {
            return Local {
                translation: DVec3::ZERO,
                rotation: DQuat::IDENTITY,
                scale: plain.scale * self.scale_from_above(model, parts),
            };
        }
        let mut local = match self.above[model as usize] {
            None => self.in_axes(plain),
            Some(_) if self.inherit(model) == Inherit::Whole => plain,
            Some(above) => {
                let of_above = self.scale_below(above, parts);
                let scale = plain.scale * self.scale_from_above(model, parts);
                match self.rigid[above as usize] {
                    Some(_) => Local {
                        translation: plain.translation * of_above,
                        scale,
                        ..plain
                    },
                    // One number for all axes, which is undone.
                    None => Local {
                        scale: if of_above.x == 0.0 { scale } else { scale / of_above.x },
                        ..plain
                    },
                }
            }
        };
        if rigid.is_some() {
            local.scale = DVec3::ONE;
        }
        local
    }

    fn in_axes(&self, local: Local) -> Local {
        let axes = self.model_from_file;
        if axes.determinant() > 0.0 {
            return Local {
                translation: axes * local.translation,
                rotation: DQuat::from_mat3(&axes) * local.rotation,
                ..local
            };
        }
        // A mirror is a turn and a scale of −1 along all axes.
        Local {
            translation: axes * local.translation,
            rotation: DQuat::from_mat3(&(axes * -1.0)) * local.rotation,
            scale: -local.scale,
        }
    }

    fn inherit(&self, model: u32) -> Inherit {
        self.transforms[model as usize].inherit
    }

    /// The scale that acts on what lies in a model: its own, and what it has from above by itself.
    fn scale_below(&self, model: u32, parts: &dyn Fn(u32) -> Parts) -> DVec3 {
        parts(model).scale * self.scale_from_above(model, parts)
    }

    /// The scale that a model has from those above in another way than by lying in them.
    fn scale_from_above(&self, model: u32, parts: &dyn Fn(u32) -> Parts) -> DVec3 {
        let mut scale = DVec3::ONE;
        for above in self.moved_by(model).windows(2) {
            if self.inherit(above[0]) == Inherit::ScaleAfterRotation {
                scale *= parts(above[1]).scale;
            }
        }
        scale
    }

    /// The models on whose parts the place of a model depends, itself first.
    pub(super) fn moved_by(&self, model: u32) -> Vec<u32> {
        let mut models = vec![model];
        let mut at = model;
        while let (Inherit::ScaleAfterRotation | Inherit::NoScale, Some(above)) =
            (self.inherit(at), self.above[at as usize])
        {
            models.push(above);
            at = above;
            if models.len() == MOST_DEPTH {
                break;
            }
        }
        models
    }

    /// The models of the file, which are the first nodes.
    pub(super) fn models(&self) -> &[ObjectIndex] {
        &self.objects[..self.above.len()]
    }

    /// The model that a node is of.
    pub(super) fn model_of(&self, node: u32) -> u32 {
        self.model_of[node as usize]
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
            let reached = walks[node as usize];
            if reached == walk {
                parents[node as usize] = None;
                tangled.push(node);
            }
            at = if reached == 0 { parents[node as usize] } else { None };
            if reached == 0 {
                walks[node as usize] = walk;
            }
        }
    }
    tangled
}

/// The file's axes -> those of a model: its own words say which axis points to the right, up, and to the front.
fn axes(document: &Document<'_>) -> DMat3 {
    // Files of 6.1 have them among the objects.
    let settings = document
        .find("GlobalSettings")
        .or_else(|| document.find("Objects")?.find("GlobalSettings"));
    let settings =
        settings.and_then(|settings| settings.find("Properties70").or_else(|| settings.find("Properties60")));
    let integer = |name: &str, default: i64| {
        let of = |record: &&crate::fbx::Record<'_>| record.bytes(0) == Some(name.as_bytes());
        let found = settings.and_then(|settings| settings.records.iter().rfind(of));
        found
            .and_then(|record| record.integer(if record.name == "P" { 4 } else { 3 }))
            .unwrap_or(default)
    };
    let axis = |name: &str, default: i64| {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let axis = axes[integer(name, default).clamp(0, 2) as usize];
        axis * if integer(&format!("{name}Sign"), 1) < 0 {
            -1.0
        } else {
            1.0
        }
    };
    let rows = DMat3::from_cols(axis("CoordAxis", 0), axis("UpAxis", 1), axis("FrontAxis", 2)).transpose();
    // Some name an axis twice.
    if rows.determinant().abs() == 1.0 {
        rows
    } else {
        DMat3::IDENTITY
    }
}
