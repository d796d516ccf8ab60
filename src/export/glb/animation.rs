//! Clips as animations.

use std::collections::HashMap;

use serde_json::{Value, json};

use super::binary::{Binary, Target};
use super::keys::needed;
use super::space::Space;
use crate::model::{Clip, Curve, CurveValue, Curves, LocalJoint, Model, Track};

/// The animations of all clips that have keys.
pub(super) fn animations(model: &Model, space: &Space, binary: &mut Binary) -> Vec<Value> {
    let clips = model.clips.iter().filter(|clip| has_keys(clip));
    clips
        .map(|clip| {
            let mut writer = Writer {
                // glTF has no time before 0.
                shift_secs: clip.start_secs.min(0.0),
                binary,
                inputs: HashMap::new(),
                samplers: Vec::new(),
                channels: Vec::new(),
            };
            for (bone, joint) in model.skeleton.joint_of_bone().iter().enumerate() {
                let rest = space.joint(&model.skeleton.rest()[joint.index()]);
                writer.track(bone, &clip.tracks[joint.index()], &rest, space);
            }
            json!({ "name": clip.name, "samplers": writer.samplers, "channels": writer.channels })
        })
        .collect()
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
        if !track.has_keys() {
            return;
        }
        let moved = track.sooner(self.shift_secs).and_then(|track| {
            track.mapped(
                |value| space.vector(value),
                |value| space.rotation(value),
                |value| space.scale(value),
            )
        });
        // Axes are exchanged and turned round, and no time that is read overflows: there is no other track.
        let track = &moved.unwrap_or_else(|_| track.clone());
        let no_curves = Curves::default();
        let curves = track.curves().unwrap_or(&no_curves);
        let [rotations, translations, scales] = needed(track, rest);
        match &curves.rotation {
            Some(curve) => self.curve(bone, "rotation", curve),
            None => self.straight(bone, "rotation", track, track.rotations(), &rotations),
        }
        match &curves.translation {
            Some(curve) => self.curve(bone, "translation", curve),
            None => self.straight(bone, "translation", track, track.translations(), &translations),
        }
        match &curves.scale {
            Some(curve) => self.curve(bone, "scale", curve),
            None => self.straight(bone, "scale", track, track.scales(), &scales),
        }
    }

    /// Some keys of a track, between which values go straight; no channel without any.
    fn straight<T: Copy + Into<[f32; N]>, const N: usize>(
        &mut self,
        bone: usize,
        path: &str,
        track: &Track,
        values: &[T],
        keys: &[usize],
    ) {
        if keys.is_empty() {
            return;
        }
        let times_secs: Vec<f32> = keys.iter().map(|&key| track.times_secs()[key]).collect();
        let rows: Vec<_> = keys.iter().map(|&key| values[key].into()).collect();
        self.channel(bone, path, "LINEAR", &times_secs, &rows);
    }

    /// Held values, or splines.
    fn curve<T: CurveValue + Into<[f32; N]>, const N: usize>(&mut self, bone: usize, path: &str, curve: &Curve<T>) {
        let values = curve.values();
        match curve.tangents() {
            // A spline has two keys or more.
            Some(tangents) if values.len() > 1 => {
                let keys = tangents.iter().zip(values);
                let rows = keys.flat_map(|(&[before, after], &value)| [before, value, after].map(Into::into));
                let rows: Vec<_> = rows.collect();
                self.channel(bone, path, "CUBICSPLINE", curve.times_secs(), &rows);
            }
            _ => {
                let rows: Vec<_> = values.iter().map(|&value| value.into()).collect();
                self.channel(bone, path, "STEP", curve.times_secs(), &rows);
            }
        }
    }

    fn channel<const N: usize>(&mut self, bone: usize, path: &str, way: &str, times_secs: &[f32], rows: &[[f32; N]]) {
        let input = self.input(times_secs);
        let output = self.binary.floats(rows, Target::Other, false);
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
