//! Texture coordinates and tangents of parts laid flat. Tubes wrap by a whole number, so a repeating texture shows no seam.
//! No chart is mirrored: the bitangent is `cross(normal, tangent)` everywhere, as renderers that leave `tangent.w` unread
//! take it.

use std::f64::consts::TAU;

use glam::{DQuat, DVec2, DVec3};

/// A way to lay a part of the skin flat.
#[derive(Clone, Copy, Debug)]
pub(super) enum Chart {
    /// Round `axis` through `origin`, `repeats` times across; u is `origin_uv.x` at `front` and grows from there to
    /// cross(axis, front), v is `origin_uv.y` at `origin` and grows along `axis`.
    Tube {
        origin: DVec3,
        axis: DVec3,
        front: DVec3,
        repeats: f64,
        per_metre: f64,
        origin_uv: DVec2,
    },
    /// Straight down onto two axes, whose lengths are repeats per metre; `origin_uv` at `origin`.
    Flat {
        origin: DVec3,
        u: DVec3,
        v: DVec3,
        origin_uv: DVec2,
    },
    /// True distances and directions from the pole of a ball, where the texture has its middle.
    Dome {
        centre: DVec3,
        pole: DVec3,
        u: DVec3,
        v: DVec3,
        repeats_per_radian: f64,
    },
}

/// Cosine between a normal and the way out of its chart below which the chart says little about directions there.
const LEAST_FACING: f64 = 0.3;
impl Chart {
    /// Seen from outside with v running down, u runs to the right.
    pub(super) fn flat(origin: DVec3, outwards: DVec3, v: DVec3, u_per_metre: f64, origin_uv: DVec2) -> Chart {
        let u = v.cross(outwards).normalize() * u_per_metre;
        Chart::Flat {
            origin,
            u,
            v,
            origin_uv,
        }
    }

    /// Likewise, of a ball.
    pub(super) fn dome(centre: DVec3, pole: DVec3, v: DVec3, repeats_per_radian: f64) -> Chart {
        Chart::Dome {
            centre,
            pole,
            u: v.cross(pole),
            v,
            repeats_per_radian,
        }
    }

    /// Texture coordinates; those of a tube lie within half its repeats of `near`, so that a triangle stays whole.
    pub(super) fn tex_coords(&self, point: DVec3, near: Option<DVec2>) -> DVec2 {
        match *self {
            Chart::Tube {
                origin,
                axis,
                front,
                repeats,
                per_metre,
                origin_uv,
            } => {
                let offset = point - origin;
                let turn = offset.dot(axis.cross(front)).atan2(offset.dot(front)) / TAU;
                let u = turn * repeats + origin_uv.x;
                let wraps = near.map_or(0.0, |near| ((near.x - u) / repeats).round());
                DVec2::new(u + wraps * repeats, offset.dot(axis) * per_metre + origin_uv.y)
            }
            Chart::Flat {
                origin,
                u,
                v,
                origin_uv,
            } => DVec2::new((point - origin).dot(u), (point - origin).dot(v)) + origin_uv,
            Chart::Dome {
                centre,
                pole,
                u,
                v,
                repeats_per_radian,
            } => {
                let offset = point - centre;
                let across = DVec2::new(offset.dot(u), offset.dot(v));
                let angle = across.length().atan2(offset.dot(pole));
                across.normalize_or_zero() * (angle * repeats_per_radian) + DVec2::splat(0.5)
            }
        }
    }

    /// Unit tangent across `normal`: as near to growing u as cross(normal, tangent) is to growing v.
    pub(super) fn tangent(&self, point: DVec3, normal: DVec3) -> DVec3 {
        let (u, v, outwards) = self.axes(point);
        // The chart's directions slide along `outwards` until they lie in the skin. In creases that would go on for ever.
        let facing = normal.dot(outwards).max(LEAST_FACING);
        let in_skin = |axis: DVec3| (axis - outwards * (axis.dot(normal) / facing)).normalize();
        let along_u = in_skin(u) + in_skin(v).cross(normal);
        (along_u - normal * along_u.dot(normal)).normalize()
    }

    /// Unit directions of growing u, of growing v, and out of the chart, each across the others.
    fn axes(&self, point: DVec3) -> (DVec3, DVec3, DVec3) {
        match *self {
            Chart::Tube { origin, axis, .. } => {
                let outwards = (point - origin).reject_from(axis).normalize();
                (axis.cross(outwards), axis, outwards)
            }
            Chart::Flat { u, v, .. } => {
                let (u, v) = (u.normalize(), v.normalize());
                (u, v, u.cross(v))
            }
            Chart::Dome { centre, pole, u, v, .. } => {
                let outwards = (point - centre).normalize();
                let turned = DQuat::from_rotation_arc(pole, outwards);
                (turned * u, turned * v, outwards)
            }
        }
    }
}
