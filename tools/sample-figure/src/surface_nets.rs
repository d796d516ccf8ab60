//! Surface nets: one vertex for each sheet of surface in a cell, one quad across each crossed edge. And the lattice of the
//! figure: finer where hands, face and feet are, bent along the arms.

use glam::DVec3;

use crate::rig::ARM;
use crate::sdf::ramp;

/// A lattice of three ascending lists of lines, bent by a map that keeps neighbours apart.
pub(crate) struct Lattice<W> {
    /// Lines across x, y and z.
    pub(crate) lines: [Vec<f64>; 3],
    /// From lattice space to model space, one to one.
    pub(crate) warp: W,
}

/// Vertices and quads. A quad's corners go round so that cross(b − a, c − a) points outwards.
#[derive(Default)]
pub(crate) struct QuadMesh {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) quads: Vec<[u32; 4]>,
}

/// Edges of a cell as pairs of corners, whose bits are x, y and z: four along x, four along y, four along z.
const EDGES: [(usize, usize); 12] = [
    (0, 1),
    (2, 3),
    (4, 5),
    (6, 7),
    (0, 2),
    (1, 3),
    (4, 6),
    (5, 7),
    (0, 4),
    (1, 5),
    (2, 6),
    (3, 7),
];

/// Faces of a cell: four corners in turn and the edges between them, the last edge leading back to the first corner.
const FACES: [([usize; 4], [usize; 4]); 6] = [
    ([0, 1, 3, 2], [0, 5, 1, 4]),
    ([4, 5, 7, 6], [2, 7, 3, 6]),
    ([0, 1, 5, 4], [0, 9, 2, 8]),
    ([2, 3, 7, 6], [1, 11, 3, 10]),
    ([0, 2, 6, 4], [4, 10, 6, 8]),
    ([1, 3, 7, 5], [5, 11, 7, 9]),
];

/// For each crossed edge of a cell the first edge of the same sheet of surface. Two sheets pass through a cell where fingers
/// are close; with one vertex for both they would be welded there.
fn sheets(inside: &[bool; 8]) -> [Option<usize>; 12] {
    let mut sheets: [Option<usize>; 12] = std::array::from_fn(|edge| {
        let (a, b) = EDGES[edge];
        (inside[a] != inside[b]).then_some(edge)
    });
    let mut join = |a: usize, b: usize| {
        let (Some(a), Some(b)) = (sheets[a], sheets[b]) else {
            return;
        };
        sheets
            .iter_mut()
            .filter(|sheet| **sheet == Some(a.max(b)))
            .for_each(|sheet| *sheet = Some(a.min(b)));
    };
    for (corners, edges) in FACES {
        let is_inside = corners.map(|corner| inside[corner]);
        if is_inside[0] == is_inside[2] && is_inside[1] == is_inside[3] {
            // No edge or all four are crossed: each inside corner is cut off by itself, which keeps gaps open.
            (0..4)
                .filter(|corner| is_inside[*corner])
                .for_each(|corner| join(edges[(corner + 3) % 4], edges[corner]));
        } else {
            let mut crossed = (0..4)
                .filter(|i| is_inside[*i] != is_inside[(*i + 1) % 4])
                .map(|i| edges[i]);
            if let (Some(a), Some(b)) = (crossed.next(), crossed.next()) {
                join(a, b);
            }
        }
    }
    sheets
}

/// The surface where `field` is zero. The lattice must reach past it on all sides.
pub(crate) fn polygonise<W: Fn(DVec3) -> DVec3>(lattice: &Lattice<W>, field: impl Fn(DVec3) -> f64) -> QuadMesh {
    let [xs, ys, zs] = &lattice.lines;
    let size = [xs.len(), ys.len(), zs.len()];
    let at = |i: [usize; 3]| (i[2] * size[1] + i[1]) * size[0] + i[0];
    let point = |i: [usize; 3]| (lattice.warp)(DVec3::new(xs[i[0]], ys[i[1]], zs[i[2]]));

    let mut samples = vec![0.0; size[0] * size[1] * size[2]];
    for_each_index(size, |i| samples[at(i)] = field(point(i)));

    let mut mesh = QuadMesh::default();
    let mut cell_of = vec![u32::MAX; samples.len()];
    // For each crossed cell, the vertex that belongs to each of its crossed edges.
    let mut cells = Vec::<[u32; 12]>::new();
    for_each_index(size.map(|n| n - 1), |i| {
        let corners: [[usize; 3]; 8] = std::array::from_fn(|c| [i[0] + (c & 1), i[1] + (c >> 1 & 1), i[2] + (c >> 2)]);
        let values = corners.map(|corner| samples[at(corner)]);
        let inside = values.map(|value| value < 0.0);
        if inside == [inside[0]; 8] {
            return;
        }
        let sheets = sheets(&inside);
        let mut vertices = [u32::MAX; 12];
        for first in (0..12).filter(|edge| sheets[*edge] == Some(*edge)) {
            let (mut sum, mut crossings) = (DVec3::ZERO, 0.0);
            for edge in (0..12).filter(|edge| sheets[*edge] == Some(first)) {
                let (a, b) = EDGES[edge];
                sum += point(corners[a]).lerp(point(corners[b]), values[a] / (values[a] - values[b]));
                crossings += 1.0;
                vertices[edge] = mesh.positions.len() as u32;
            }
            mesh.positions.push(sum / crossings);
        }
        cell_of[at(i)] = cells.len() as u32;
        cells.push(vertices);
    });

    for_each_index(size.map(|n| n - 1), |i| {
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let mut end = i;
            end[axis] += 1;
            let (inside, end_inside) = (samples[at(i)] < 0.0, samples[at(end)] < 0.0);
            if inside == end_inside {
                continue;
            }
            // The lattice reaches past the surface, so a crossed edge has cells on all four sides.
            let around = [(1, 1), (0, 1), (0, 0), (1, 0)].map(|(du, dv)| {
                let mut cell = i;
                cell[u] -= du;
                cell[v] -= dv;
                let edge = if axis == 1 {
                    4 + dv + 2 * du
                } else {
                    4 * axis + du + 2 * dv
                };
                cells[cell_of[at(cell)] as usize][edge]
            });
            let [a, b, c, d] = around;
            mesh.quads.push(if inside { [a, b, c, d] } else { [d, c, b, a] });
        }
    });
    mesh
}

/// Calls `visit` for each index below `size`, x fastest.
fn for_each_index(size: [usize; 3], mut visit: impl FnMut([usize; 3])) {
    for z in 0..size[2] {
        for y in 0..size[1] {
            for x in 0..size[0] {
                visit([x, y, z]);
            }
        }
    }
}

/// Cell size at a coordinate; sizes between are blended.
type Steps<'a> = &'a [(f64, f64)];

/// Height of the shoulders, around which the arms' part of the lattice shrinks towards the hands.
const SHOULDER_HEIGHT: f64 = 1.358;
/// Distance from the middle at which the lattice begins to follow the arms.
const BEND_START: f64 = 0.16;
/// Over which distance it does.
const BEND_WIDTH: f64 = 0.10;
/// Size of the cells across the hands, in parts of the size at the shoulders.
const HAND_SCALE: f64 = 0.52;

/// The figure's lattice.
pub(crate) fn figure_lattice() -> Lattice<impl Fn(DVec3) -> DVec3> {
    let half = lines(
        0.0,
        0.81,
        &[
            (0.0, 0.0185),
            (0.08, 0.0215),
            (0.17, 0.0245),
            (0.3, 0.031),
            (0.48, 0.029),
            (0.58, 0.0145),
            (0.62, 0.012),
            (0.79, 0.011),
        ],
    );
    let xs = half
        .iter()
        .rev()
        .map(|x| -x)
        .chain(half.iter().skip(1).copied())
        .collect();
    let ys = lines(
        -0.025,
        1.84,
        &[
            (0.0, 0.019),
            (0.10, 0.025),
            (0.3, 0.031),
            (0.8, 0.032),
            (1.15, 0.0265),
            (1.22, 0.019),
            (1.33, 0.019),
            (1.38, 0.021),
            (1.45, 0.0205),
            (1.8, 0.0215),
        ],
    );
    let back = lines(0.0, 0.26, &[(0.0, 0.0235), (0.26, 0.0255)]);
    let zs = back
        .iter()
        .rev()
        .map(|z| -z)
        .chain(back.iter().skip(1).copied())
        .collect();
    Lattice {
        lines: [xs, ys, zs],
        warp,
    }
}

/// Lattice space to model space. Columns beyond the shoulders slide down along the arms, and shrink towards the hands.
fn warp(point: DVec3) -> DVec3 {
    let beyond = (point.x.abs() - BEND_START).max(0.0);
    // A parabola, then its tangent: the slide starts without a kink.
    let slid = if beyond < BEND_WIDTH {
        beyond * beyond / (2.0 * BEND_WIDTH)
    } else {
        beyond - BEND_WIDTH / 2.0
    };
    let scale = 1.0 - (1.0 - HAND_SCALE) * ramp(0.42, 0.64, point.x.abs());
    let y = SHOULDER_HEIGHT + (point.y - SHOULDER_HEIGHT) * scale + slid * ARM.y / ARM.x;
    DVec3::new(point.x, y, point.z * scale)
}

/// Lines from `from` until past `to`, as far apart as `steps` says.
fn lines(from: f64, to: f64, steps: Steps<'_>) -> Vec<f64> {
    let mut lines = vec![from];
    let mut at = from;
    while at < to {
        at += step_at(steps, at);
        lines.push(at);
    }
    lines
}

fn step_at(steps: Steps<'_>, at: f64) -> f64 {
    let after = steps.partition_point(|step| step.0 <= at);
    if after == 0 || after == steps.len() {
        return steps[after.min(steps.len() - 1)].1;
    }
    let ((from, a), (to, b)) = (steps[after - 1], steps[after]);
    a + (b - a) * (at - from) / (to - from)
}
