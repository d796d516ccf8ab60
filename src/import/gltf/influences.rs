//! Joints and weights of the vertices of a primitive.

use crate::diagnostic::{Diagnostic, Subject, codes};
use crate::gltf::{Fault, Primitive, Reader, Wanted};
use crate::import::weights::{Noted, SUM_TOLERANCE};
use crate::model::Influences;

/// The weights of a primitive on a skin.
pub(super) struct Weighted<'a> {
    /// What [`sets`] read of the primitive.
    pub(super) sets: &'a [Set],
    /// The joint of each slot of the skin.
    pub(super) joints: &'a [u32],
    pub(super) first_vertex: u32,
    pub(super) pointer: &'a str,
}

/// Joints and weights of all vertices, four of each.
pub(super) type Set = (Vec<[u32; 4]>, Vec<[f32; 4]>);

/// `JOINTS_0` with `WEIGHTS_0`, `JOINTS_1` with `WEIGHTS_1` and so on, of `count` vertices.
///
/// # Errors
/// When the numbers are of the wrong kind, or are not there.
pub(super) fn sets(reader: &Reader<'_>, part: &Primitive, count: usize, pointer: &str) -> Result<Vec<Set>, Fault> {
    let mut sets = Vec::new();
    for number in 0.. {
        let keys = [format!("JOINTS_{number}"), format!("WEIGHTS_{number}")];
        let [joints, weights] = keys.each_ref().map(|key| part.attributes.get(key));
        let (Some(&joints), Some(&weights)) = (joints, weights) else {
            break;
        };
        let at = |key: &str| format!("{pointer}/attributes/{key}");
        let joints = reader.whole::<4>(joints, &at(&keys[0]))?;
        let weights = reader.floats::<4>(weights, Wanted::Fractions, &at(&keys[1]))?;
        if joints.len() < count || weights.len() < count {
            break;
        }
        sets.push((joints, weights));
    }
    Ok(sets)
}

impl Weighted<'_> {
    /// The influences of `count` vertices.
    ///
    /// # Errors
    /// When a vertex gives weight to a joint that the skin does not have.
    pub(super) fn read(&self, count: usize, noted: &mut Noted) -> Result<Vec<Influences>, Fault> {
        let sets = self.sets;
        let mut pairs = Vec::with_capacity(4 * sets.len());
        let mut all = Vec::with_capacity(count);
        for vertex in 0..count {
            let influences = match sets {
                [set] => self.of_one_set(set, vertex),
                _ => None,
            };
            all.push(match influences {
                Some(influences) => influences,
                None => self.influences(vertex, &mut pairs, noted)?,
            });
        }
        Ok(all)
    }

    /// The influences of a vertex as nearly all files have them: the weights are sound, sum to 1, and those that are 0 come last. `None`
    /// for any other; [`Weighted::influences`] gives the same for these.
    fn of_one_set(&self, (joints, weights): &Set, vertex: usize) -> Option<Influences> {
        let (slots, weights) = (joints[vertex], weights[vertex]);
        let falls = |two: &[f32; 2]| (two[0] > 0.0 && two[1] >= 0.0) || two[1] == 0.0;
        if !(weights[0] > 0.0 && weights.array_windows().all(falls)) {
            return None;
        }
        let sum: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
        if (sum - 1.0).abs() > SUM_TOLERANCE {
            return None;
        }
        let mut influences = Influences::default();
        for (slot, weight) in weights.into_iter().enumerate().filter(|&(_, weight)| weight > 0.0) {
            influences.joints[slot] = *self.joints.get(slots[slot] as usize)?;
            influences.weights[slot] = if sum == 1.0 {
                weight
            } else {
                (f64::from(weight) / sum) as f32
            };
        }
        Some(influences)
    }

    fn influences(&self, vertex: usize, pairs: &mut Vec<(f32, u32)>, noted: &mut Noted) -> Result<Influences, Fault> {
        let number = self.first_vertex + vertex as u32;
        pairs.clear();
        let mut is_sound = true;
        for (joints, weights) in self.sets {
            for (&slot, &weight) in joints[vertex].iter().zip(&weights[vertex]) {
                let is_weight = weight.is_finite() && weight >= 0.0;
                is_sound &= is_weight;
                if is_weight && weight > 0.0 {
                    pairs.push((weight, self.joint(slot, number)?));
                }
            }
        }
        if !is_sound {
            noted.mended.invalid.add(number);
        }
        Ok(noted.strongest(number, pairs))
    }

    fn joint(&self, slot: u32, vertex: u32) -> Result<u32, Fault> {
        self.joints.get(slot as usize).copied().ok_or_else(|| {
            let count = self.joints.len();
            let message = format!("Vertex {vertex} gives weight to joint {slot} of its skin, which has {count}.");
            Box::new(Diagnostic {
                subject: Some(Subject::Vertex(vertex)),
                subjects: vec![Subject::Vertex(vertex)],
                expected: Some(format!("a joint below {count}")),
                found: Some(slot.to_string()),
                ..codes::INFLUENCE_OUT_OF_RANGE
                    .says(message)
                    .pointing_at(format!("{}/attributes", self.pointer))
            })
        })
    }
}
