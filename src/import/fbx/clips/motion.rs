//! A stack while it is asked where its models are. What is asked is taken from what may be asked of the file.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::rc::Rc;

use super::fitting::{Fitted, Source};
use super::layers::{Layer, Moved, Property};
use crate::diagnostic::Fault;
use crate::import::fbx::nodes::Nodes;
use crate::import::fbx::transform::{Parts, is_even};
use crate::model::{LocalJoint, Track};

/// How far a channel may be off: rotations in radians, scales as they are, translations as a part of the model's size. Off by so much in each joint of
/// a chain of ten, nothing is off by a ten-thousandth.
const MOST_OFF: f64 = 5e-6;

/// So often a channel is asked for between two keys at most, as long as nothing is halved.
const EVALUATIONS_PER_KEY: u64 = 24;

/// Between two keys a joint is asked for as often as it turns by so much: a whole turn would be seen by no one who looks at both its ends.
const MOST_TURN_DEGREES: f64 = 60.0;

/// Pieces between two keys of a joint that turns far, at most.
const MOST_TURN_PIECES: f64 = 128.0;

const SCALE: &[Property] = &[Property::Scale];

/// What a layer has of a model, and whether it is the lowest of all.
type Moving<'s> = (&'s Layer, &'s Moved, bool);

/// A stack over the models that it moves.
pub(super) struct Motion<'s> {
    nodes: &'s Nodes,
    span: Option<[f64; 2]>,
    /// Of each model, the lowest layer first.
    layers: BTreeMap<u32, Vec<Moving<'s>>>,
    evaluations_left: &'s Cell<u64>,
}

impl<'s> Motion<'s> {
    /// Of a stack's layers, the lowest first, and where it is in seconds. `None` where they have more models than may still be asked for.
    pub(super) fn of(
        layers: &'s [Rc<Layer>],
        span: Option<[f64; 2]>,
        nodes: &'s Nodes,
        evaluations_left: &'s Cell<u64>,
    ) -> Option<Self> {
        let mut motion = Self {
            nodes,
            span,
            layers: BTreeMap::new(),
            evaluations_left,
        };
        for (index, layer) in layers.iter().enumerate() {
            if !motion.take(layer.moved().len()) {
                return None;
            }
            for (model, moved) in layer.moved() {
                motion.layers.entry(model).or_default().push((layer, moved, index == 0));
            }
        }
        Some(motion)
    }

    /// Takes so many evaluations; whether there were so many.
    fn take(&self, count: usize) -> bool {
        let left = self.evaluations_left.get().checked_sub(count as u64);
        self.evaluations_left.set(left.unwrap_or_default());
        left.is_some()
    }

    fn layers_of(&self, model: u32) -> &[Moving<'s>] {
        self.layers.get(&model).map_or(&[], Vec::as_slice)
    }

    /// The models whose scale differs by axis at some key.
    pub(super) fn uneven(&self) -> Vec<u32> {
        let is_uneven = |secs: f64, model: u32| !is_even(self.parts(model, SCALE, (secs, false)).scale);
        let models = self.layers.keys().copied();
        models
            .filter(|&model| self.key_times(model, SCALE).any(|secs| is_uneven(secs, model)))
            .collect()
    }

    /// The times of the keys of some properties of a model, as far as they may still be asked for.
    fn key_times<'a>(&'a self, model: u32, properties: &'a [Property]) -> impl Iterator<Item = f64> + 'a {
        let layers = self.layers_of(model);
        self.take(layers.len());
        layers
            .iter()
            .flat_map(move |(layer, moved, _)| layer.times_secs(moved, properties, self.span))
            .take_while(|_| self.take(1))
    }

    /// The parts of a model at a time or just before it, with some properties as the stack has them.
    fn parts(&self, model: u32, properties: &[Property], moment: (f64, bool)) -> Parts {
        let transform = &self.nodes.transforms[model as usize];
        let layers = self.layers_of(model);
        // One that nothing moves is looked at all the same.
        self.take((layers.len() * properties.len()).max(1));
        let mut parts = transform.parts();
        for &(layer, moved, is_lowest) in layers {
            layer.add_to(&mut parts, (moved, properties), transform, moment, is_lowest);
        }
        parts
    }

    /// The times at which something happens to a model: keys of its own and of the scales above within the stack's span, and its ends.
    fn times(&self, model: u32, properties: &[Property], above: &[u32]) -> Vec<f64> {
        let of_above = above.iter().flat_map(|&above| self.key_times(above, SCALE));
        let mut times: Vec<f64> = self.key_times(model, properties).chain(of_above).collect();
        times.sort_by(f64::total_cmp);
        if let (Some([start, end]), Some(_)) = (self.span, times.first()) {
            times.retain(|&secs| start < secs && secs < end);
            times.insert(0, start);
            times.push(end);
        }
        // Equal ones as a clip has them.
        times.dedup_by(|next, before| *next as f32 <= *before as f32);
        times
    }

    /// Adds times between those at which a model turns far, as far as they may still be asked for.
    fn add_turning(&self, model: u32, times: &mut Vec<f64>) {
        let degrees = |moment| self.parts(model, &[Property::Rotation], moment).rotation;
        let between = times.array_windows().flat_map(|&[from, to]| {
            let turn = (degrees((to, true)) - degrees((from, false))).abs().max_element();
            let pieces = (turn / MOST_TURN_DEGREES).ceil().clamp(1.0, MOST_TURN_PIECES) as u32;
            (1..pieces).map(move |piece| from + (to - from) * f64::from(piece) / f64::from(pieces))
        });
        let added: Vec<f64> = between.take_while(|_| self.take(1)).collect();
        times.extend(added);
        times.sort_by(f64::total_cmp);
        times.dedup_by(|next, before| *next as f32 <= *before as f32);
    }

    /// A channel of a node; `None` where it takes more evaluations than are left.
    fn fitted(&self, node: u32, property: Property, tolerance: f64, is_off: &Cell<bool>) -> Option<Fitted> {
        let model = self.nodes.model_of(node);
        let properties = match property {
            Property::Translation if self.nodes.transforms[model as usize].has_pivots() => &Property::ALL[..],
            Property::Translation => &[Property::Translation],
            Property::Rotation => &[Property::Rotation],
            Property::Scale => SCALE,
        };
        // How a node is turned depends on nothing above.
        let above = match property {
            Property::Rotation => Vec::new(),
            _ => self.nodes.scales_of(model),
        };
        let of_above = above.iter().map(|&above| self.layers_of(above).len());
        let own = self.layers_of(model).len() * properties.len();
        if own + of_above.clone().sum::<usize>() == 0 {
            return Some(Fitted::Rest(None));
        }
        let layers = own + of_above.map(|layers| layers.max(1)).sum::<usize>();
        let may_ask = |times: &[f64]| {
            let least = EVALUATIONS_PER_KEY * times.len() as u64 * layers as u64;
            self.evaluations_left.get() >= least.max(1)
        };
        let mut times = self.times(model, properties, &above);
        if properties.contains(&Property::Rotation) && may_ask(&times) {
            self.add_turning(model, &mut times);
        }
        if !may_ask(&times) {
            return None;
        }
        let of_above = if above.is_empty() { &[] } else { SCALE };
        let source = Source {
            at: &|secs, is_before| {
                let local = self.nodes.local(node, &|asked| {
                    let properties = if asked == model { properties } else { of_above };
                    self.parts(asked, properties, (secs, is_before))
                });
                match property {
                    Property::Translation => local.translation.extend(0.0),
                    Property::Rotation => local.rotation.into(),
                    Property::Scale => local.scale.extend(0.0),
                }
            },
            is_rotation: property == Property::Rotation,
            tolerance,
            evaluations_left: self.evaluations_left,
            is_off,
        };
        Some(source.fitted(&times))
    }

    /// The track of a node; `None` where it takes more evaluations than are left. `is_off` is set where it is off by more than it may.
    ///
    /// # Errors
    /// When a number is too great for a channel.
    pub(super) fn track(
        &self,
        node: u32,
        rest: LocalJoint,
        size: f64,
        is_off: &Cell<bool>,
    ) -> Option<Result<Track, Fault>> {
        let fitted = |property, tolerance| self.fitted(node, property, tolerance, is_off);
        let translation = fitted(Property::Translation, MOST_OFF * size)?;
        let rotation = fitted(Property::Rotation, MOST_OFF)?;
        let scale = fitted(Property::Scale, MOST_OFF)?;
        let vector = |fitted: Fitted, rest| fitted.channel(|value| value.truncate().as_vec3(), rest);
        let track = || {
            Ok(Track::of_channels(
                vector(translation, rest.translation)?,
                rotation.channel(|value| glam::DQuat::from_vec4(value).as_quat(), rest.rotation)?,
                vector(scale, rest.scale)?,
            ))
        };
        Some(track())
    }
}
