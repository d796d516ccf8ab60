//! Animation stacks as clips: layers over each other, Euler angles as rotations, curves as keys of our channels.
//!
//! A stack is evaluated as FBX says; from what comes out a channel is made that is off from it by at most [`MOST_OFF`] wherever it is looked at, at three places
//! from key to key: held or straight between the file's keys where that is enough, else a spline. That has as many keys as it takes, up to 128 ways between two
//! of the file's, while the file's evaluations last. Channels that stay are at rest.

mod fitting;
mod layers;

use std::cell::Cell;
use std::collections::HashMap;
use std::rc::Rc;

use self::fitting::{Fitted, Source};
use self::layers::{Layer, Property};
use super::curves::TICKS_PER_SEC;
use super::file::File;
use super::nodes::Nodes;
use super::objects::{ObjectIndex, Objects};
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

/// More tracks than this do not come from a file of a character.
const MOST_TRACKS: usize = 1_000_000;

/// Between two keys a joint is asked for as often as it turns by so much: a whole turn would be seen by no one who looks at both its ends.
const MOST_TURN_DEGREES: f64 = 60.0;

/// A stack: what it is called, when it is, and its layers, the lowest first.
pub(super) struct Stack {
    name: String,
    /// Where it says so. In seconds.
    span_secs: Option<[f64; 2]>,
    layers: Vec<Rc<Layer>>,
}

impl Stack {
    /// The stacks of a file.
    ///
    /// # Errors
    /// When an array of a curve is damaged.
    pub(super) fn all(file: &File<'_, '_>, objects: &Objects<'_, '_>, nodes: &Nodes) -> Result<Vec<Self>, Fault> {
        let mut stacks = Vec::new();
        let mut known_layers: HashMap<ObjectIndex, Rc<Layer>> = HashMap::new();
        let mut curves = HashMap::new();
        for (_, stack) in objects.of_class("AnimationStack") {
            let secs = |name: &str| stack.number(name).map(|ticks| ticks / TICKS_PER_SEC);
            let mut layers = Vec::new();
            for (index, layer) in objects.children(stack, "AnimationLayer") {
                let known = match known_layers.get(&index) {
                    Some(known) => Rc::clone(known),
                    None => Rc::new(Layer::read((file, &mut curves), objects, nodes, (index, layer))?),
                };
                known_layers.insert(index, Rc::clone(&known));
                layers.push(known);
            }
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
                    layers: vec![Rc::new(layer)],
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
            .flat_map(|layer| layer.models())
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
        let is_one = |[start, end]: &[f64; 2]| start < end && start.is_finite() && end.is_finite();
        self.span_secs.filter(is_one)
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
        if properties.contains(&Property::Rotation) {
            let added = self.turning(nodes, nodes.model_of(node), &times);
            times.extend(added);
            times.sort_by(f64::total_cmp);
        }
        // Equal ones as a clip has them.
        times.dedup_by(|next, before| *next as f32 <= *before as f32);
        times
    }

    /// Times between those at which a model turns far.
    fn turning(&self, nodes: &Nodes, model: u32, times: &[f64]) -> Vec<f64> {
        const MOST_PIECES: f64 = 128.0;
        let transform = &nodes.transforms[model as usize];
        let degrees = |secs: f64, is_before| self.parts(transform, model, secs, is_before).rotation;
        let mut added = Vec::new();
        for &[from, to] in times.array_windows() {
            let turn = (degrees(to, true) - degrees(from, false)).abs().max_element();
            let pieces = (turn / MOST_TURN_DEGREES).ceil().clamp(1.0, MOST_PIECES) as u32;
            added.extend((1..pieces).map(|piece| from + (to - from) * f64::from(piece) / f64::from(pieces)));
        }
        added
    }

    /// `evaluations_left` is how often joints of the file may still be asked for.
    fn track(
        &self,
        nodes: &Nodes,
        node: u32,
        rest: LocalJoint,
        size: f64,
        evaluations_left: &Cell<u64>,
    ) -> Result<Track, Fault> {
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
                evaluations_left,
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
    // Tracks whose numbers are too great for any.
    let mut unwritten = 0;
    let most = MOST_TRACKS / rig.node_of_joint.len().max(1);
    for stack in &stacks[..stacks.len().min(most)] {
        let mut tracks = Vec::with_capacity(rig.node_of_joint.len());
        for (joint, (&node, &rest)) in (0u32..).zip(rig.node_of_joint.iter().zip(rig.skeleton.rest())) {
            slices.pause().await;
            let stands_in = rig.joint_of_node[node as usize] != Some(joint);
            // A joint that stands in for another has no motion of its own.
            let track = match stands_in {
                true => Ok(Track::at_rest(rest)),
                false => stack.track(nodes, node, rest, size, &file.evaluations_left),
            };
            tracks.push(track.unwrap_or_else(|_| {
                unwritten += 1;
                Track::at_rest(rest)
            }));
        }
        if tracks.iter().any(Track::has_keys) {
            read.push((stack, tracks));
        }
    }
    let names = unique_names(read.iter().map(|(stack, _)| &*stack.name), "clip", |index, name| {
        let message = format!("Another clip has the same name; this one is shown as \"{name}\".");
        file.note_about(Subject::Clip(index), &codes::DUPLICATE_CLIP_NAME, message);
    });
    if unwritten > 0 {
        let message = format!(
            "{} numbers that overflow; at rest.",
            counted(unwritten, "track has", "tracks have")
        );
        file.note(&codes::FBX_RULE_BROKEN, message);
    }
    if stacks.len() > most {
        let message = format!(
            "{} beyond what fits into memory; left out.",
            counted(stacks.len() - most, "clip is", "clips are")
        );
        file.note(&codes::FBX_LEFT_OUT, message);
    }
    if file.evaluations_left.get() == 0 {
        let message =
            "There are more curves than can be followed exactly; some may be off between their keys.".to_owned();
        file.note(&codes::FBX_LEFT_OUT, message);
    }
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
