//! Clips as animations.

use std::collections::HashMap;

use serde_json::{Value, json};

use super::binary::{Binary, Target};
use super::space::Space;
use crate::model::{Channel, ChannelValue, Clip, LocalJoint, Model, Track, Way};
use crate::slices::Slices;

/// The animations of all clips that have keys.
pub(super) async fn animations(model: &Model, space: &Space, binary: &mut Binary, slices: &Slices) -> Vec<Value> {
    let mut animations = Vec::new();
    for clip in model.clips.iter().filter(|clip| has_keys(clip)) {
        let mut writer = Writer {
            // glTF has no time before 0.
            shift_secs: clip.start_secs.min(0.0),
            binary,
            inputs: HashMap::new(),
            samplers: Vec::new(),
            channels: Vec::new(),
        };
        for (bone, joint) in model.skeleton.joint_of_bone().iter().enumerate() {
            slices.pause().await;
            let rest = space.joint(&model.skeleton.rest()[joint.index()]);
            writer.track(bone, &clip.tracks[joint.index()], &rest, space);
        }
        animations.push(json!({ "name": clip.name, "samplers": writer.samplers, "channels": writer.channels }));
    }
    animations
}

/// Whether any bone has keys in a clip.
pub(super) fn has_keys(clip: &Clip) -> bool {
    clip.tracks.iter().any(Track::has_keys)
}

struct Writer<'a> {
    shift_secs: f32,
    binary: &'a mut Binary,
    /// Accessors of times, by their bits.
    inputs: HashMap<Vec<u32>, usize>,
    samplers: Vec<Value>,
    channels: Vec<Value>,
}

impl Writer<'_> {
    fn track(&mut self, bone: usize, track: &Track, rest: &LocalJoint, space: &Space) {
        let moved = track.shifted_earlier(self.shift_secs).and_then(|track| {
            track.mapped(
                |value| space.vector(value),
                |value| space.rotation(value),
                |value| space.scale(value),
            )
        });
        // Axes are exchanged and turned round, and no time that is read overflows: there is no other track.
        let track = &moved.unwrap_or_else(|_| track.clone());
        let (rotation, translation, scale) = (track.rotation(), track.translation(), track.scale());
        let lists = [rotation.times_secs(), translation.times_secs(), scale.times_secs()];
        let says_rest = [
            *rotation.values() == [rest.rotation],
            *translation.values() == [rest.translation],
            *scale.values() == [rest.scale],
        ];
        // One key that says what the node says at rest is there for its time alone.
        let others = lists.iter().zip(says_rest).filter(|(_, says_rest)| !says_rest);
        let mut held: Vec<&[f32]> = others.map(|(times_secs, _)| *times_secs).collect();
        let is_written: [bool; 3] = std::array::from_fn(|channel| {
            let is_held = |secs: &f32| held.iter().any(|times_secs| times_secs.contains(secs));
            let is_needed = !(lists[channel].is_empty() || says_rest[channel] && lists[channel].iter().all(is_held));
            if is_needed && says_rest[channel] {
                held.push(lists[channel]);
            }
            is_needed
        });
        if is_written[0] {
            self.channel(bone, "rotation", rotation);
        }
        if is_written[1] {
            self.channel(bone, "translation", translation);
        }
        if is_written[2] {
            self.channel(bone, "scale", scale);
        }
    }

    fn channel<T: ChannelValue + Into<[f32; N]>, const N: usize>(
        &mut self,
        bone: usize,
        path: &str,
        channel: &Channel<T>,
    ) {
        let values = channel.values();
        let (way, rows): (_, Vec<[f32; N]>) = match channel.way() {
            // A spline has two keys or more.
            Way::Spline(slopes) if values.len() > 1 => {
                let keys = slopes.iter().zip(values);
                let rows = keys.flat_map(|(&[before, after], &value)| [before, value, after].map(Into::into));
                ("CUBICSPLINE", rows.collect())
            }
            Way::Straight => ("LINEAR", values.iter().map(|&value| value.into()).collect()),
            Way::Held | Way::Spline(_) => ("STEP", values.iter().map(|&value| value.into()).collect()),
        };
        let input = self.input(channel.times_secs());
        let output = self.binary.floats(&rows, Target::Other, false);
        let mut sampler = json!({ "input": input, "output": output });
        if way != "LINEAR" {
            sampler["interpolation"] = json!(way);
        }
        self.channels.push(json!({
            "sampler": self.samplers.len(), "target": { "node": bone, "path": path },
        }));
        self.samplers.push(sampler);
    }

    /// The accessor of some times; equal ones share it.
    fn input(&mut self, times_secs: &[f32]) -> usize {
        let bits = times_secs.iter().map(|time_secs| time_secs.to_bits()).collect();
        let rows: Vec<[f32; 1]> = times_secs.iter().map(|&time_secs| [time_secs]).collect();
        let binary = &mut *self.binary;
        *self
            .inputs
            .entry(bits)
            .or_insert_with(|| binary.floats(&rows, Target::Other, true))
    }
}
