//! Clips as animations.

use std::collections::HashMap;

use glam::{Vec3, Vec4};
use serde_json::{Value, json};

use super::binary::{Binary, Target};
use super::space::Space;
use crate::model::{Clip, Curve, CurveValue, Model, Track};

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
                writer.track(bone, &clip.tracks[joint.index()], space);
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
    fn track(&mut self, bone: usize, track: &Track, space: &Space) {
        if !track.has_keys() {
            return;
        }
        let curves = track.curves();
        let vector = |value: Vec3| space.vector(value).to_array();
        let scale = |value: Vec3| space.scale(value).to_array();
        let rotation = |value: Vec4| space.rotation(value).to_array();
        match curves.and_then(|curves| curves.rotation.as_ref()) {
            Some(curve) => self.curve(bone, "rotation", curve, rotation),
            None => {
                let values: Vec<_> = track
                    .rotations()
                    .iter()
                    .map(|&value| rotation(Vec4::from(value)))
                    .collect();
                // All keys, also where they are alike: they say how long the track is.
                self.channel(bone, "rotation", "LINEAR", track.times_secs(), &values);
            }
        }
        match curves.and_then(|curves| curves.translation.as_ref()) {
            Some(curve) => self.curve(bone, "translation", curve, vector),
            None => self.straight(bone, "translation", track, track.translations(), vector),
        }
        match curves.and_then(|curves| curves.scale.as_ref()) {
            Some(curve) => self.curve(bone, "scale", curve, scale),
            None => self.straight(bone, "scale", track, track.scales(), scale),
        }
    }

    /// Keys between which values go straight. One stands for all when they are alike.
    fn straight(
        &mut self,
        bone: usize,
        path: &str,
        track: &Track,
        values: &[Vec3],
        in_gltf: impl Fn(Vec3) -> [f32; 3],
    ) {
        let is_constant = track.curves().is_none() && values.iter().all(|value| *value == values[0]);
        let count = if is_constant { 1 } else { values.len() };
        let values: Vec<_> = values[..count].iter().map(|&value| in_gltf(value)).collect();
        self.channel(bone, path, "LINEAR", &track.times_secs()[..count], &values);
    }

    /// Held values, or splines.
    fn curve<T: CurveValue, const N: usize>(
        &mut self,
        bone: usize,
        path: &str,
        curve: &Curve<T>,
        in_gltf: impl Fn(T) -> [f32; N],
    ) {
        let values = curve.values();
        match curve.tangents() {
            // A spline has two keys or more.
            Some(tangents) if values.len() > 1 => {
                let keys = tangents.iter().zip(values);
                let rows = keys.flat_map(|(&[before, after], &value)| [before, value, after].map(&in_gltf));
                let rows: Vec<_> = rows.collect();
                self.channel(bone, path, "CUBICSPLINE", curve.times_secs(), &rows);
            }
            _ => {
                let rows: Vec<_> = values.iter().map(|&value| in_gltf(value)).collect();
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
        let mut shifted: Vec<[f32; 1]> = Vec::with_capacity(times_secs.len());
        for time_secs in times_secs {
            let mut at = time_secs - self.shift_secs;
            // What is lost of a time that is moved must not make two the same.
            if let Some(&[before]) = shifted.last() {
                at = at.max(before.next_up());
            }
            shifted.push([at]);
        }
        let bits = shifted.iter().map(|[time_secs]| time_secs.to_bits()).collect();
        let binary = &mut *self.binary;
        *self
            .inputs
            .entry(bits)
            .or_insert_with(|| binary.floats(&shifted, Target::Other, true))
    }
}
