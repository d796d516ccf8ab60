//! Models of a file as nodes of a scene: who is whose parent, and where each is.

use std::collections::HashSet;

use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::objects::{Object, ObjectIndex, Objects};
use super::settings::Settings;
use super::transform::{Inherit, Local, Parts, Transform, is_even};
use crate::import::scene::{self, Scene};
use crate::model::Tag;

/// Of so many models above it the scale of one depends at most: chains of joints that do not inherit scale are shorter.
const MOST_DEPTH: usize = 64;

/// Nodes, with what only FBX knows of them.
///
/// A model whose scale differs by axis, and does not act wholly on its children, becomes two nodes: a rigid parent, and a child that only scales. The
/// scaling child keeps the model's index, so that meshes hang on it. Rigid nodes are added after all models.
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
    pub(super) fn of(settings: Settings, objects: &Objects<'_, '_>) -> Self {
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
        let transforms: Vec<Transform> = models
            .iter()
            .map(|&model| Transform::of(objects.get(model), settings.unit_metres))
            .collect();
        Self {
            scene: Scene::default(),
            rigid: vec![None; parents.len()],
            model_of: (0..parents.len() as u32).collect(),
            above: parents,
            transforms,
            objects: models,
            node_of,
            tangled,
            model_from_file: settings.model_from_file,
        }
    }

    /// Builds the scene of the nodes, with where they are at rest. `uneven` are the models whose own scale differs by axis in a clip.
    pub(super) fn build_scene(&mut self, objects: &Objects<'_, '_>, uneven: &HashSet<u32>) {
        let models = 0..self.above.len() as u32;
        let differs = |model: u32| uneven.contains(&model) || !is_even(self.transforms[model as usize].scale);
        let differs: Vec<bool> = models.clone().map(differs).collect();
        let mut asks = vec![false; differs.len()];
        for model in models.clone().filter(|&model| self.inherit(model) != Inherit::Whole) {
            if let Some(above) = self.above[model as usize] {
                asks[above as usize] = true;
            }
        }
        for model in models.clone() {
            if asks[model as usize] && self.depends_on(model).iter().any(|&model| differs[model as usize]) {
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
                let from_above = self.scale_from_above(above, parts);
                let of_above = parts(above).scale * from_above;
                let on_model = match self.inherit(model) {
                    Inherit::ScaleAfterRotation => of_above,
                    _ => from_above,
                };
                let scale = plain.scale * on_model;
                match self.rigid[above as usize] {
                    Some(_) => Local {
                        translation: plain.translation * of_above,
                        scale,
                        ..plain
                    },
                    // The parent's scale is even here: it is divided out, so that it does not act.
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

    /// The product of the parents' scales that [`Inherit::ScaleAfterRotation`] applies on the model itself, not through its parent's matrix.
    fn scale_from_above(&self, model: u32, parts: &dyn Fn(u32) -> Parts) -> DVec3 {
        self.scaling(model).map(|above| parts(above).scale).product()
    }

    /// The models whose scales those are.
    fn scaling(&self, model: u32) -> impl Iterator<Item = u32> {
        let chain = self.depends_on(model);
        let count = chain.len();
        let acts = move |at: usize| (self.inherit(chain[at - 1]) == Inherit::ScaleAfterRotation).then(|| chain[at]);
        (1..count).filter_map(acts)
    }

    /// The models above whose scales where a model is relative to its parent depends on.
    pub(super) fn scales_of(&self, model: u32) -> Vec<u32> {
        let above = self.above[model as usize].filter(|_| self.inherit(model) != Inherit::Whole);
        above
            .into_iter()
            .flat_map(|above| std::iter::once(above).chain(self.scaling(above)))
            .collect()
    }

    /// The model, and those above that it does not inherit as a whole, nearest first.
    fn depends_on(&self, model: u32) -> Vec<u32> {
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

    /// The file's axes -> the model's.
    pub(super) fn model_from_file(&self) -> DAffine3 {
        DAffine3::from_mat3(self.model_from_file)
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

/// Cuts each circle of parents at one node; gives those nodes.
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
