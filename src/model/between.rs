//! Values on the straight way between two keys. Who leaves keys out and who reads what is left take the same steps.

use glam::{Quat, Vec3};

/// The part of the way between two times at which a third lies.
pub(crate) fn part_of_way([from_secs, to_secs]: [f32; 2], time_secs: f32) -> f64 {
    let [from_secs, to_secs, time_secs] = [from_secs, to_secs, time_secs].map(f64::from);
    (time_secs - from_secs) / (to_secs - from_secs)
}

/// A translation or a scale between two others.
pub(crate) fn vector_between([from, to]: [Vec3; 2], part: f64) -> Vec3 {
    from.as_dvec3().lerp(to.as_dvec3(), part).as_vec3()
}

/// A rotation between two others, along the shorter arc and of unit length.
pub(crate) fn rotation_between(rotations: [Quat; 2], part: f64) -> Quat {
    let [from, to] = rotations.map(|rotation| rotation.as_dquat().normalize());
    from.slerp(to, part).normalize().as_quat()
}
