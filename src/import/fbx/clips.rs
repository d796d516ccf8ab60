//! Animation stacks as clips: layers over each other, Euler angles as rotations, curves as keys of our channels.
//!
//! A stack is evaluated as FBX says; from what comes out a channel is made that is off from it by at most `MOST_OFF` wherever it is looked at, at three places
//! from key to key: held or straight between those of the file's keys that it needs where that is enough, else a spline. That has as many keys as it takes, up
//! to 128 ways between two of the file's, while the file's evaluations last. Channels that stay are at rest.

mod fitting;
mod layers;
mod motion;

use std::cell::Cell;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use self::fitting::MOST_HALVINGS;
use self::layers::Layer;
use self::motion::Motion;
use super::curves::TICKS_PER_SEC;
use super::file::File;
use super::nodes::Nodes;
use super::objects::{ObjectIndex, Objects};
use crate::diagnostic::collect::{Few, counted, quoted};
use crate::diagnostic::{Fault, Subject, codes};
use crate::fbx::Place;
use crate::import::scene::Rig;
use crate::model::{Clip, Track, unique_names};
use crate::slices::Slices;

/// More tracks than this do not come from a file of a character.
const MOST_TRACKS: usize = 1_000_000;

/// What is kept of a key of a channel at most, in the clip and as it is laid out for sampling.
const BYTES_PER_KEY: u64 = 64;

/// A stack: what it is called, when it is, and its layers, the lowest first.
pub(super) struct Stack {
    name: String,
    place: Place,
    /// Where it says so. In seconds.
    span_secs: Option<[f64; 2]>,
    layers: Vec<Rc<Layer>>,
}

impl Stack {
    /// The stacks of a file.
    ///
    /// # Errors
    /// When an array of a curve is damaged, or the budget has no room for what is moved.
    pub(super) fn all(file: &mut File<'_, '_>, objects: &Objects<'_, '_>, nodes: &Nodes) -> Result<Vec<Self>, Fault> {
        let mut stacks = Vec::new();
        let mut known_layers: HashMap<ObjectIndex, Rc<Layer>> = HashMap::new();
        let mut curves = HashMap::new();
        for (_, stack) in objects.of_class("AnimationStack") {
            let ticks_per_sec = file.settings.ticks_per_sec;
            let secs = |name: &str| stack.number(name).map(|ticks| ticks / ticks_per_sec);
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
                place: stack.record.place,
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
            let layer = Layer::of_take(take, file, objects, nodes);
            // Files of 7.x have takes without curves.
            if !layer.is_empty() {
                stacks.push(Self {
                    name: take.text(0).unwrap_or_default().into_owned(),
                    place: take.place,
                    span_secs: span.map(|span| span.map(|ticks| ticks / TICKS_PER_SEC)),
                    layers: vec![Rc::new(layer)],
                });
            }
        }
        Ok(stacks)
    }

    /// From when to when it is, where it says so.
    fn span(&self) -> Option<[f64; 2]> {
        let is_one = |[start, end]: &[f64; 2]| start < end && start.is_finite() && end.is_finite();
        self.span_secs.filter(is_one)
    }
}

/// The models whose scale differs by axis at some key.
pub(super) fn uneven(stacks: &[Stack], nodes: &Nodes, evaluations_left: &Cell<u64>) -> HashSet<u32> {
    let motions = stacks
        .iter()
        .filter_map(|stack| Motion::of(&stack.layers, stack.span(), nodes, evaluations_left));
    motions.flat_map(|motion| motion.uneven()).collect()
}

/// Marks the nodes that stacks move.
pub(super) fn mark_moved(stacks: &[Stack], nodes: &mut Nodes) {
    let mut is_moved = vec![false; nodes.transforms.len()];
    let mut known = HashSet::new();
    let layers = stacks.iter().flat_map(|stack| &stack.layers);
    layers
        .filter(|layer| known.insert(Rc::as_ptr(layer)))
        .flat_map(|layer| layer.models())
        .for_each(|model| is_moved[model as usize] = true);
    for node in 0..nodes.scene.nodes.len() as u32 {
        let by_own = is_moved[nodes.model_of(node) as usize];
        nodes.scene.nodes[node as usize].is_moved |= by_own;
    }
}

/// The clips of a file for a skeleton, and where their stacks stand; `size` is the model's. Stacks that move no joint are none.
///
/// # Errors
/// When the budget has no room for their keys.
pub(super) async fn clips(
    file: &mut File<'_, '_>,
    nodes: &Nodes,
    stacks: &[Stack],
    rig: &Rig,
    size: f64,
    slices: &Slices,
) -> Result<(Vec<Clip>, Vec<Place>), Fault> {
    let mut read = Vec::new();
    // Tracks whose numbers are too great for any, those that would take too long, and those that are off.
    let (mut unwritten, mut unfollowed, mut off) = (0, 0, Few::default());
    let most = MOST_TRACKS / rig.node_of_joint.len().max(1);
    let mut left_out = stacks.len().saturating_sub(most);
    for stack in stacks.iter().take(most) {
        let Some(motion) = Motion::of(&stack.layers, stack.span(), nodes, &file.evaluations_left) else {
            left_out += 1;
            continue;
        };
        let mut tracks = Vec::with_capacity(rig.node_of_joint.len());
        for (joint, (&node, &rest)) in (0u32..).zip(rig.node_of_joint.iter().zip(rig.skeleton.rest())) {
            slices.pause().await;
            let is_off = Cell::new(false);
            // A joint that stands in for another has no motion of its own.
            let stands_in = rig.joint_of_node[node as usize] != Some(joint);
            let track = match (!stands_in).then(|| motion.track(node, rest, size, &is_off)) {
                Some(Some(Ok(track))) => track,
                other => {
                    unwritten += usize::from(matches!(other, Some(Some(Err(_)))));
                    unfollowed += usize::from(matches!(other, Some(None)));
                    Track::at_rest(rest)
                }
            };
            if is_off.get() {
                let name = &nodes.scene.nodes[node as usize].tag.name;
                off.extend([format!("{} in {}", quoted(name), quoted(&stack.name))]);
            }
            let bytes = size_of::<Track>() as u64 + BYTES_PER_KEY * track.channel_key_count() as u64;
            file.budget.keep(bytes, stack.place)?;
            tracks.push(track);
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
    let inexact = usize::from(file.evaluations_left.get() == 0);
    for (count, code, message) in [
        (
            unwritten,
            &codes::FBX_RULE_BROKEN,
            format!(
                "{} numbers that overflow; at rest.",
                counted(unwritten, "track has", "tracks have")
            ),
        ),
        (
            unfollowed,
            &codes::FBX_LEFT_OUT,
            format!(
                "{} keys or layers than are followed in a file of this size; at rest.",
                counted(unfollowed, "track has more", "tracks have more")
            ),
        ),
        (
            off.count,
            &codes::FBX_LEFT_OUT,
            format!(
                "{} between two keys more than {} pieces follow: {off}.",
                counted(off.count, "track bends", "tracks bend"),
                1 << MOST_HALVINGS,
            ),
        ),
        (
            left_out,
            &codes::FBX_LEFT_OUT,
            format!(
                "{} beyond what is read of a file of this size; left out.",
                counted(left_out, "clip is", "clips are")
            ),
        ),
        (
            inexact,
            &codes::FBX_LEFT_OUT,
            "There are more curves than can be followed exactly; some may be off between their keys.".to_owned(),
        ),
        (
            layered,
            &codes::FBX_LEFT_OUT,
            format!(
                "{} of several layers, which become one.",
                counted(layered, "clip is", "clips are")
            ),
        ),
    ] {
        if count > 0 {
            file.note(code, message);
        }
    }
    let clips = names.into_iter().zip(read);
    Ok(clips
        .map(|(name, (stack, tracks))| (Clip::new(name, tracks), stack.place))
        .unzip())
}
