//! Signed distances of the solids that the figure is blended from: negative inside, metres, gradients about one long.
//!
//! Only + − × ÷ √ occur here, which IEEE 754 fixes to the last bit: what decides the topology is the same on every machine.

use glam::DVec3;

/// A solid.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shape {
    /// Two spheres and the cone that touches both. The spheres must not contain each other.
    RoundCone {
        from: DVec3,
        to: DVec3,
        from_radius: f64,
        to_radius: f64,
    },
    /// Axis-aligned; the distance is a close bound, exact on the surface.
    Ellipsoid { centre: DVec3, radii: DVec3 },
    /// Axis-aligned; `half` is half the size with its rounding.
    RoundBox { centre: DVec3, half: DVec3, rounding: f64 },
}

impl Shape {
    /// Least and greatest corner of a box around it.
    pub(crate) fn bounds(&self) -> (DVec3, DVec3) {
        match *self {
            Shape::RoundCone {
                from,
                to,
                from_radius,
                to_radius,
            } => (
                (from - from_radius).min(to - to_radius),
                (from + from_radius).max(to + to_radius),
            ),
            Shape::Ellipsoid { centre, radii: half } | Shape::RoundBox { centre, half, .. } => {
                (centre - half, centre + half)
            }
        }
    }

    /// Signed distance from `point`.
    pub(crate) fn distance(&self, point: DVec3) -> f64 {
        match *self {
            Shape::RoundCone {
                from,
                to,
                from_radius,
                to_radius,
            } => round_cone(point - from, to - from, from_radius, to_radius),
            Shape::Ellipsoid { centre, radii } => {
                let scaled = (point - centre) / radii;
                let slope = (scaled / radii).length();
                // At the very centre the quotient has no value; the least radius is a bound from below there.
                if slope < 1e-9 {
                    -radii.min_element()
                } else {
                    scaled.length() * (scaled.length() - 1.0) / slope
                }
            }
            Shape::RoundBox { centre, half, rounding } => {
                let outside = (point - centre).abs() - (half - rounding);
                outside.max(DVec3::ZERO).length() + outside.max_element().min(0.0) - rounding
            }
        }
    }
}

/// Distance from a cone with round ends; `offset` and `axis` start at the centre of the first sphere.
///
/// The nearest point of the slanted side belongs to the sphere at which the axis is left at the cone's own slope, so the
/// foot of the point on the axis is moved by that slope and clamped to the axis.
fn round_cone(offset: DVec3, axis: DVec3, from_radius: f64, to_radius: f64) -> f64 {
    let length = axis.length();
    let along = offset.dot(axis) / length;
    let across = (offset.length_squared() - along * along).max(0.0).sqrt();
    let sine = (from_radius - to_radius) / length;
    let cosine = (1.0 - sine * sine).sqrt();
    let foot = (along - across * sine / cosine).clamp(0.0, length);
    let radius = from_radius - (foot / length) * (from_radius - to_radius);
    let (along, across) = (along - foot, across);
    (along * along + across * across).sqrt() - radius
}

/// Union whose seam is rounded over `width`: cubic, so that normals stay smooth. Commutative to the last bit.
pub(crate) fn smooth_union(a: f64, b: f64, width: f64) -> f64 {
    let overlap = (width - (a - b).abs()).max(0.0) / width;
    a.min(b) - overlap * overlap * overlap * width / 6.0
}

/// Intersection whose edge is rounded over `width`.
pub(crate) fn smooth_intersection(a: f64, b: f64, width: f64) -> f64 {
    -smooth_union(-a, -b, width)
}

/// Gradient by central differences, mirror-symmetric as the field is.
pub(crate) fn gradient(field: &impl Fn(DVec3) -> f64, point: DVec3) -> DVec3 {
    /// Metres: far below the finest feature, far above rounding.
    const STEP: f64 = 2e-4;
    let slope = |axis: DVec3| (field(point + axis * STEP) - field(point - axis * STEP)) / (2.0 * STEP);
    DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z))
}

/// Smooth step from 0 at `from` to 1 at `to`.
pub(crate) fn ramp(from: f64, to: f64, value: f64) -> f64 {
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
