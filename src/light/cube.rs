//! Cube maps of linear light, and which texel lies in which direction.

use glam::{FloatExt as _, Vec3, Vec3A};

use crate::image::{cube_direction, half};
use crate::slices::{Slices, at_once};

/// So many rows are filled between two places at which that can stop: a millisecond or less.
const ROWS_A_PIECE: usize = 8;

/// Faces of a cube: +x, −x, +y, −y, +z, −z.
pub(super) const FACES: usize = 6;

/// Six square faces of linear RGB, laid out and looked up as in D3D and WebGPU.
///
/// Each face is kept with a border of one texel, copied from its neighbours, so that filtering never reads across an
/// edge.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cube {
    side: usize,
    /// Faces one after another, each of `side + 2` rows of `side + 2` texels.
    bordered: Vec<Vec3A>,
}

impl Cube {
    /// A cube of `side` × `side` texels a face, each as `texel(face, x, y)` says; rows from the top. `side` is not 0.
    pub(super) fn from_texels(side: usize, texel: impl Fn(usize, usize, usize) -> Vec3A) -> Self {
        at_once(Self::from_texels_in(side, texel, &Slices::ENDLESS))
    }

    /// The same in slices, each of some rows.
    pub(super) async fn from_texels_in(
        side: usize,
        texel: impl Fn(usize, usize, usize) -> Vec3A,
        slices: &Slices,
    ) -> Self {
        let mut cube = Self {
            side,
            bordered: vec![Vec3A::ZERO; FACES * (side + 2) * (side + 2)],
        };
        for face in 0..FACES {
            for y in 0..side {
                if y.is_multiple_of(ROWS_A_PIECE) {
                    slices.pause().await;
                }
                let first = cube.index(face, 1, y + 1);
                for (x, place) in cube.bordered[first..first + side].iter_mut().enumerate() {
                    *place = texel(face, x, y);
                }
            }
        }
        for face in 0..FACES {
            cube.fill_border(face);
        }
        cube
    }

    /// A cube of which each texel is `radiance(direction)` at its middle; the direction is of unit length.
    pub(super) fn from_directions(side: usize, radiance: impl Fn(Vec3A) -> Vec3A) -> Self {
        Self::from_texels(side, |face, x, y| {
            radiance(texel_direction(side, face, x, y).normalize())
        })
    }

    /// Texels a side.
    pub(super) fn side(&self) -> usize {
        self.side
    }

    /// The texel in column `x` of row `y`, both below the side.
    pub(super) fn texel(&self, face: usize, x: usize, y: usize) -> Vec3A {
        self.bordered[self.index(face, x + 1, y + 1)]
    }

    /// All texels: faces one after another, rows from the top.
    pub(super) fn texels(&self) -> impl Iterator<Item = Vec3A> + '_ {
        let rows = (0..FACES).flat_map(move |face| (0..self.side).map(move |y| (face, y)));
        rows.flat_map(move |(face, y)| (0..self.side).map(move |x| self.texel(face, x, y)))
    }

    /// All texels as RGBA half floats, alpha 1: what a GPU takes as `Rgba16Float`.
    pub(super) fn to_rgba16f(&self) -> Vec<u16> {
        let one = half::from_f32(1.0);
        let rgba = |texel: Vec3A| {
            let [red, green, blue] = texel.to_array().map(half::from_f32);
            [red, green, blue, one]
        };
        self.texels().flat_map(rgba).collect()
    }

    /// Light from a direction of any length; bilinear, and continuous across edges.
    pub(super) fn sample(&self, direction: Vec3A) -> Vec3A {
        let (face, across, down) = face_at(direction);
        let side = self.side as f32;
        // In texels of the bordered face, from the middle of its first: at least 0.5 and at most side + 0.5.
        let x = (across * 0.5 + 0.5) * side + 0.5;
        let y = (down * 0.5 + 0.5) * side + 0.5;
        let (column, row) = ((x as usize).min(self.side), (y as usize).min(self.side));
        let (right, below) = (x - column as f32, y - row as f32);
        let first = self.index(face, column, row);
        let second = first + self.side + 2;
        let upper = self.bordered[first].lerp(self.bordered[first + 1], right);
        let lower = self.bordered[second].lerp(self.bordered[second + 1], right);
        upper.lerp(lower, below)
    }

    /// The next mip: each texel is the mean of four, weighted by their solid angles. The side is even.
    pub(super) fn halved(&self) -> Self {
        let angles = solid_angles(self.side);
        Self::from_texels(self.side / 2, |face, x, y| {
            let (mut light, mut sum) = (Vec3A::ZERO, 0.0);
            for (x, y) in [
                (2 * x, 2 * y),
                (2 * x + 1, 2 * y),
                (2 * x, 2 * y + 1),
                (2 * x + 1, 2 * y + 1),
            ] {
                let steradians = angles[y * self.side + x];
                light += self.texel(face, x, y) * steradians;
                sum += steradians;
            }
            light / sum
        })
    }

    fn index(&self, face: usize, column: usize, row: usize) -> usize {
        let stride = self.side + 2;
        (face * stride + row) * stride + column
    }

    /// Copies the texels next to a face's edges from its neighbours. At a corner, where only three texels meet, the
    /// border is their mean, as on GPUs.
    fn fill_border(&mut self, face: usize) {
        let (side, last) = (self.side, self.side + 1);
        for along in 1..=side {
            for (column, row) in [(0, along), (last, along), (along, 0), (along, last)] {
                let index = self.index(face, column, row);
                self.bordered[index] = self.beyond(face, column, row);
            }
        }
        for (column, inner_column) in [(0, 1), (last, side)] {
            for (row, inner_row) in [(0, 1), (last, side)] {
                let corner = [(inner_column, inner_row), (column, inner_row), (inner_column, row)];
                let sum: Vec3A = corner
                    .map(|(x, y)| self.bordered[self.index(face, x, y)])
                    .into_iter()
                    .sum();
                let index = self.index(face, column, row);
                self.bordered[index] = sum / 3.0;
            }
        }
    }

    /// The neighbour's texel at a place of the border. The middle of a texel one step beyond the edge, seen from the
    /// middle of the cube, always lies on that texel.
    fn beyond(&self, face: usize, column: usize, row: usize) -> Vec3A {
        let side = self.side as f32;
        let place = |index: usize| (2.0 * index as f32 - 1.0) / side - 1.0;
        let (face, across, down) = face_at(cube_direction(face, place(column), place(row)));
        let texel = |place: f32| (((place * 0.5 + 0.5) * side) as usize).min(self.side - 1);
        self.texel(face, texel(across), texel(down))
    }
}

/// Towards the middle of a texel; not of unit length.
pub(super) fn texel_direction(side: usize, face: usize, x: usize, y: usize) -> Vec3A {
    let place = |index: usize| (2.0 * index as f32 + 1.0) / side as f32 - 1.0;
    cube_direction(face, place(x), place(y))
}

/// The face that a direction meets, and where: the inverse of [`cube_direction`].
fn face_at(direction: Vec3A) -> (usize, f32, f32) {
    let [x, y, z] = direction.to_array();
    let size = direction.abs();
    if size.x >= size.y && size.x >= size.z {
        if x >= 0.0 {
            (0, -z / size.x, -y / size.x)
        } else {
            (1, z / size.x, -y / size.x)
        }
    } else if size.y >= size.z {
        if y >= 0.0 {
            (2, x / size.y, z / size.y)
        } else {
            (3, x / size.y, -z / size.y)
        }
    } else if z >= 0.0 {
        (4, x / size.z, -y / size.z)
    } else {
        (5, -x / size.z, -y / size.z)
    }
}

/// Steradians of each texel of a face, rows from the top; six times their sum is 4π.
pub(super) fn solid_angles(side: usize) -> Vec<f32> {
    // Of the part of the face between its middle and a corner at (x, y), signed.
    let corner = |x: f32, y: f32| (x * y).atan2((x * x + y * y + 1.0).sqrt());
    let place = |index: usize| 2.0 * index as f32 / side as f32 - 1.0;
    let row = |y: usize| -> Vec<f32> { (0..=side).map(|x| corner(place(x), place(y))).collect() };
    let mut above = row(0);
    let mut angles = Vec::with_capacity(side * side);
    for y in 1..=side {
        let below = row(y);
        let texels = above.windows(2).zip(below.windows(2));
        angles.extend(texels.map(|(above, below)| above[0] - above[1] - below[0] + below[1]));
        above = below;
    }
    angles
}

/// Resizes a square of texels: each new texel is the mean of the area that it covers. Neither side is 0.
pub(super) fn resized(texels: &[Vec3], side: usize, new_side: usize) -> Vec<Vec3> {
    let columns = covered(side, new_side);
    let mean = |spans: &[(usize, f32)], value: &dyn Fn(usize) -> Vec3| {
        spans.iter().map(|&(index, weight)| value(index) * weight).sum::<Vec3>()
    };
    let narrow: Vec<Vec3> = texels
        .chunks_exact(side)
        .flat_map(|row| columns.iter().map(|spans| mean(spans, &|x| row[x])))
        .collect();
    let column_means = |spans: &Vec<(usize, f32)>| -> Vec<Vec3> {
        (0..new_side)
            .map(|x| mean(spans, &|y| narrow[y * new_side + x]))
            .collect()
    };
    columns.iter().flat_map(column_means).collect()
}

/// For each texel of a new row, the texels of the old row that it covers, and their weights.
fn covered(side: usize, new_side: usize) -> Vec<Vec<(usize, f32)>> {
    let per_texel = side as f32 / new_side as f32;
    let spans = |index: usize| {
        let (start, end) = (index as f32 * per_texel, (index + 1) as f32 * per_texel);
        let overlap = |old: usize| end.min((old + 1) as f32) - start.max(old as f32);
        let reached = start as usize..(end.ceil() as usize).min(side);
        reached
            .map(|old| (old, overlap(old) / per_texel))
            .filter(|&(_, fraction)| fraction > 0.0)
            .collect()
    };
    (0..new_side).map(spans).collect()
}

/// The Hermite step from 0 at `start` to 1 at `end`, as WGSL has it.
pub(super) fn smoothstep(start: f32, end: f32, value: f32) -> f32 {
    let t = value.remap(start, end, 0.0, 1.0).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
