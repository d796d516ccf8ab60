//! Surface nets: one vertex in each cell that the surface crosses, one quad across each crossed edge.

use glam::DVec3;

/// A lattice of three ascending lists of lines, bent by a map that keeps neighbours apart.
pub(super) struct Lattice<W> {
    /// Lines across x, y and z.
    pub(super) lines: [Vec<f64>; 3],
    /// From lattice space to model space, one to one.
    pub(super) warp: W,
}

/// Vertices and quads. A quad's corners go round so that cross(b − a, c − a) points outwards.
#[derive(Default)]
pub(super) struct QuadMesh {
    pub(super) positions: Vec<DVec3>,
    pub(super) quads: Vec<[u32; 4]>,
}

/// Corner offsets of a cell in the order of the bits x, y, z, and its twelve edges as pairs of corners.
const EDGES: [(usize, usize); 12] =
    [(0, 1), (2, 3), (4, 5), (6, 7), (0, 2), (1, 3), (4, 6), (5, 7), (0, 4), (1, 5), (2, 6), (3, 7)];

/// The surface where `field` is zero. The lattice must reach past it on all sides.
pub(super) fn polygonise<W: Fn(DVec3) -> DVec3>(lattice: &Lattice<W>, field: impl Fn(DVec3) -> f64) -> QuadMesh {
    let [xs, ys, zs] = &lattice.lines;
    let size = [xs.len(), ys.len(), zs.len()];
    let at = |i: [usize; 3]| (i[2] * size[1] + i[1]) * size[0] + i[0];
    let point = |i: [usize; 3]| (lattice.warp)(DVec3::new(xs[i[0]], ys[i[1]], zs[i[2]]));

    let mut samples = vec![0.0; size[0] * size[1] * size[2]];
    for_each_index(size, |i| samples[at(i)] = field(point(i)));

    let mut mesh = QuadMesh::default();
    let mut vertex_of_cell = vec![u32::MAX; samples.len()];
    for_each_index(size.map(|n| n - 1), |i| {
        let corner = |c: usize| [i[0] + (c & 1), i[1] + (c >> 1 & 1), i[2] + (c >> 2)];
        let (mut sum, mut crossings) = (DVec3::ZERO, 0.0);
        for (a, b) in EDGES.map(|(a, b)| (corner(a), corner(b))) {
            let (from, to) = (samples[at(a)], samples[at(b)]);
            if (from < 0.0) != (to < 0.0) {
                sum += point(a).lerp(point(b), from / (from - to));
                crossings += 1.0;
            }
        }
        if crossings > 0.0 {
            vertex_of_cell[at(i)] = mesh.positions.len() as u32;
            mesh.positions.push(sum / crossings);
        }
    });

    for_each_index(size.map(|n| n - 1), |i| {
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let step = |mut i: [usize; 3], axis: usize, by: usize| {
                i[axis] -= by;
                i
            };
            let mut end = i;
            end[axis] += 1;
            let (inside, end_inside) = (samples[at(i)] < 0.0, samples[at(end)] < 0.0);
            if inside == end_inside {
                continue;
            }
            // The lattice reaches past the surface, so a crossed edge has cells on all four sides.
            let around = [(1, 1), (0, 1), (0, 0), (1, 0)].map(|(du, dv)| vertex_of_cell[at(step(step(i, u, du), v, dv))]);
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
