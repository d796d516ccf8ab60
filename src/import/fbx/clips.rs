//! Animation stacks as clips: layers over each other, Euler angles as rotations, curves as keys of our channels.
//!
//! A stack is evaluated as FBX says; from what comes out a channel is made that is off from it by at most [`MOST_OFF`]: straight between the file's keys where
//! that is enough, else a spline with as many keys as it takes. Channels that stay are at rest.

mod fitting;
mod layers;

use self::fitting::{Fitted, Source};
use self::layers::{Layer, Property};
use super::curves::TICKS_PER_SEC;
use super::file::File;
use super::nodes::Nodes;
use super::objects::Objects;
use super::transform::{Local, Parts, Transform, is_even};
use crate::diagnostic::codes;
use crate::diagnostic::collect::counted;
use crate::diagnostic::{Fault, Subject};
use crate::import::scene::Rig;
use crate::model::{Clip, LocalJoint, Track, unique_names};
use crate::slices::Slices;

/// How far a channel may be off: rotations in radians, scales as they are, translations as a part of the model's size. Off by so much in each joint of
/// a chain of ten, nothing is off by a ten-thousandth.
pub(super) const MOST_OFF: f64 = 5e-6;

/// A stack: what it is called, when it is, and its layers, the lowest first.
pub(super) struct Stack {
    name: String,
    /// Where it says so. In seconds.
    span_secs: Option<[f64; 2]>,
    layers: Vec<Layer>,
}

impl Stack {
    /// The stacks of a file.
    ///
    /// # Errors
    /// When an array of a curve is damaged.
    pub(super) fn all(file: &File<'_, '_>, objects: &Objects<'_, '_>, nodes: &Nodes) -> Result<Vec<Self>, Fault> {
        let mut stacks = Vec::new();
        for (_, stack) in objects.of_class("AnimationStack") {
            let secs = |name: &str| stack.number(name).map(|ticks| ticks / TICKS_PER_SEC);
            let layers = objects.children(stack, "AnimationLayer");
            let layers = layers
                .map(|(_, layer)| Layer::read(file, objects, nodes, layer))
                .collect::<Result<_, _>>()?;
            stacks.push(Self {
                name: stack.name.clone().into_owned(),
                span_secs: secs("LocalStart").zip(secs("LocalStop")).map(Into::into),
                layers,
            });
        }
        for take in file
            .document
            .find("Takes")
            .into_iter()
            .flat_map(|takes| takes.all("Take"))
        {
            let span = take
                .find("LocalTime")
                .and_then(|time| Some([time.number(0)?, time.number(1)?]));
            let layer = Layer::of_take(take, objects, nodes, file.settings.unit_metres);
            // Files of 7.x have takes without curves.
            if !layer.is_empty() {
                stacks.push(Self {
                    name: take.text(0).unwrap_or_default().into_owned(),
                    span_secs: span.map(|span| span.map(|ticks| ticks / TICKS_PER_SEC)),
                    layers: vec![layer],
                });
            }
        }
        Ok(stacks)
    }

    /// Marks the nodes that it moves.
    pub(super) fn mark_moved(&self, nodes: &mut Nodes) {
        let mut is_moved = vec![false; nodes.transforms.len()];
        self.layers
            .iter()
            .flat_map(Layer::models)
            .for_each(|model| is_moved[model as usize] = true);
        for node in 0..nodes.scene.nodes.len() as u32 {
            let by_own = is_moved[nodes.model_of(node) as usize];
            nodes.scene.nodes[node as usize].is_moved |= by_own;
        }
    }

    /// Whether the scale of a model differs by axis at some key.
    pub(super) fn scales_unevenly(&self, model: u32, transform: &Transform) -> bool {
        let mut times = self.key_times_secs(model, &[Property::Scale]);
        times.any(|secs| !is_even(self.parts(transform, model, secs, false).scale))
    }

    fn key_times_secs(&self, model: u32, properties: &[Property]) -> impl Iterator<Item = f64> {
        self.layers
            .iter()
            .flat_map(move |layer| layer.times_secs(model, properties, self.span()))
    }

    /// From when to when it is, where it says so.
    fn span(&self) -> Option<[f64; 2]> {
        self.span_secs.filter(|[start, end]| start < end)
    }

    /// The parts of a model at a time.
    fn parts(&self, transform: &Transform, model: u32, secs: f64, is_before: bool) -> Parts {
        let mut parts = transform.parts();
        for (index, layer) in self.layers.iter().enumerate() {
            layer.add_to(
                &mut parts,
                (model, transform),
                [secs, if is_before { 1.0 } else { 0.0 }],
                index == 0,
            );
        }
        parts
    }

    fn local(&self, nodes: &Nodes, node: u32, secs: f64, is_before: bool) -> Local {
        nodes.local(node, &|model| {
            self.parts(&nodes.transforms[model as usize], model, secs, is_before)
        })
    }

    /// The times at which something happens to a node: keys within the stack's span, and its ends.
    fn times(&self, nodes: &Nodes, node: u32, properties: &[Property]) -> Vec<f64> {
        let moving = nodes.depends_on(nodes.model_of(node));
        let mut times: Vec<f64> = moving
            .iter()
            .flat_map(|&model| self.key_times_secs(model, properties))
            .collect();
        times.sort_by(f64::total_cmp);
        if let (Some([start, end]), Some(_)) = (self.span(), times.first()) {
            times.retain(|&secs| start < secs && secs < end);
            times.insert(0, start);
            times.push(end);
        }
        // Nearer ones would be the same to a clip.
        times.dedup_by(|next, before| *next as f32 <= *before as f32);
        times
    }

    fn track(&self, nodes: &Nodes, node: u32, rest: LocalJoint, size: f64) -> Result<Track, Fault> {
        let all = [Property::Translation, Property::Rotation, Property::Scale];
        let of = |property: Property| {
            let transform = &nodes.transforms[node as usize];
            let is_alone = nodes.depends_on(nodes.model_of(node)).len() == 1;
            match property {
                _ if !is_alone => &all[..],
                Property::Translation if transform.has_pivots() => &all[..],
                Property::Translation => &all[..1],
                Property::Rotation => &all[1..2],
                Property::Scale => &all[2..],
            }
        };
        let fitted = |property: Property, tolerance: f64| {
            let source = Source {
                at: &|secs, is_before| {
                    let local = self.local(nodes, node, secs, is_before);
                    match property {
                        Property::Translation => local.translation.extend(0.0),
                        Property::Rotation => local.rotation.into(),
                        Property::Scale => local.scale.extend(0.0),
                    }
                },
                is_rotation: property == Property::Rotation,
                tolerance,
            };
            source.fitted(&self.times(nodes, node, of(property)))
        };
        let vector = |fitted: Fitted, rest| fitted.channel(|value| value.truncate().as_vec3(), rest);
        Ok(Track::of_channels(
            vector(fitted(Property::Translation, MOST_OFF * size), rest.translation)?,
            fitted(Property::Rotation, MOST_OFF)
                .channel(|value| glam::DQuat::from_vec4(value).as_quat(), rest.rotation)?,
            vector(fitted(Property::Scale, MOST_OFF), rest.scale)?,
        ))
    }
}

/// The clips of a file for a skeleton; `size` is the model's. Stacks that move no joint are none.
///
/// # Errors
/// When a channel is none.
pub(super) async fn clips(
    file: &mut File<'_, '_>,
    nodes: &Nodes,
    stacks: &[Stack],
    rig: &Rig,
    size: f64,
    slices: &Slices,
) -> Result<Vec<Clip>, Fault> {
    let mut read = Vec::new();
    for stack in stacks {
        let mut tracks = Vec::with_capacity(rig.node_of_joint.len());
        for (joint, (&node, &rest)) in (0u32..).zip(rig.node_of_joint.iter().zip(rig.skeleton.rest())) {
            slices.pause().await;
            let stands_in = rig.joint_of_node[node as usize] != Some(joint);
            tracks.push(if stands_in {
                Track::at_rest(rest)
            } else {
                stack.track(nodes, node, rest, size)?
            });
        }
        if tracks.iter().any(Track::has_keys) {
            read.push((stack, tracks));
        }
    }
    let names = unique_names(read.iter().map(|(stack, _)| &*stack.name), "clip", |index, name| {
        let message = format!("Another clip has the same name; this one is shown as \"{name}\".");
        file.note_about(Subject::Clip(index), &codes::DUPLICATE_CLIP_NAME, message);
    });
    let layered = read.iter().filter(|(stack, _)| stack.layers.len() > 1).count();
    if layered > 0 {
        let message = format!(
            "{} of several layers, which become one.",
            counted(layered, "clip is", "clips are")
        );
        file.note(&codes::FBX_LEFT_OUT, message);
    }
    let clips = names.into_iter().zip(read);
    Ok(clips.map(|(name, (_, tracks))| Clip::new(name, tracks)).collect())
}
