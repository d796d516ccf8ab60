//! Polygons as triangles: corners that stick out are cut off, one after the other.

use std::cell::Cell;

use glam::{DVec2, DVec3, Vec3};

/// Corners of an outline by where they are, so that a triangle meets few that are far from it.
struct Grid {
    least: DVec2,
    cells_per_length: DVec2,
    side: usize,
    /// Where the corners of each cell begin among `corners`, and where the last ones end.
    starts: Vec<u32>,
    corners: Vec<u32>,
}

impl Grid {
    fn of(corners: &[u32], points: &[DVec2]) -> Self {
        const MOST_CELLS_PER_SIDE: usize = 512;
        let places = || corners.iter().map(|&corner| points[corner as usize]);
        let least = places().fold(DVec2::INFINITY, DVec2::min);
        let most = places().fold(DVec2::NEG_INFINITY, DVec2::max);
        let side = corners.len().isqrt().clamp(1, MOST_CELLS_PER_SIDE);
        let mut grid = Self {
            least,
            cells_per_length: side as f64 / (most - least).max(DVec2::splat(f64::MIN_POSITIVE)),
            side,
            starts: vec![0; side * side + 1],
            corners: vec![0; corners.len()],
        };
        let cells: Vec<usize> = places().map(|point| grid.index(grid.cell(point))).collect();
        cells.iter().for_each(|&cell| grid.starts[cell + 1] += 1);
        for cell in 0..side * side {
            grid.starts[cell + 1] += grid.starts[cell];
        }
        let mut free = grid.starts.clone();
        for (&corner, &cell) in corners.iter().zip(&cells) {
            grid.corners[free[cell] as usize] = corner;
            free[cell] += 1;
        }
        grid
    }

    fn cell(&self, point: DVec2) -> [usize; 2] {
        let place = (point - self.least) * self.cells_per_length;
        // What is no number is in the first.
        place.to_array().map(|place| (place as usize).min(self.side - 1))
    }

    fn index(&self, [x, y]: [usize; 2]) -> usize {
        y * self.side + x
    }

    /// The corners of the cells between two points, cell by cell.
    fn between(&self, least: DVec2, most: DVec2) -> impl Iterator<Item = &[u32]> {
        let ([left, low], [right, high]) = (self.cell(least), self.cell(most));
        (low..=high).flat_map(move |y| {
            (left..=right).map(move |x| {
                let cell = self.index([x, y]);
                &self.corners[self.starts[cell] as usize..self.starts[cell + 1] as usize]
            })
        })
    }
}

/// An outline while corners are cut off.
struct Outline {
    /// Seen so that it runs to the left.
    points: Vec<DVec2>,
    before: Vec<u32>,
    after: Vec<u32>,
    /// The corners that bend inwards or not at all: where another one lies in an ear, so does one of these.
    grid: Grid,
}

fn side(from: DVec2, to: DVec2, point: DVec2) -> f64 {
    (to - from).perp_dot(point - from)
}

/// The corner behind one that was cut off.
const GONE: u32 = u32::MAX;

impl Outline {
    /// Of what lies about a normal.
    fn new(places: &[DVec3], normal: DVec3) -> Self {
        let size = normal.abs();
        let flat = |place: &DVec3| match () {
            () if size.x >= size.y && size.x >= size.z => (DVec2::new(place.y, place.z), normal.x),
            () if size.y >= size.z => (DVec2::new(place.z, place.x), normal.y),
            () => (DVec2::new(place.x, place.y), normal.z),
        };
        let turned = |(point, towards): (DVec2, f64)| {
            if towards > 0.0 {
                point
            } else {
                DVec2::new(point.y, point.x)
            }
        };
        let points: Vec<DVec2> = places.iter().map(flat).map(turned).collect();
        let count = points.len() as u32;
        let before: Vec<u32> = (0..count).map(|corner| (corner + count - 1) % count).collect();
        let after: Vec<u32> = (0..count).map(|corner| (corner + 1) % count).collect();
        let bends_outwards = |corner: u32| {
            let [a, b, c] = [before[corner as usize], corner, after[corner as usize]].map(|at| points[at as usize]);
            side(a, b, c) > 0.0
        };
        let others: Vec<u32> = (0..count).filter(|&corner| !bends_outwards(corner)).collect();
        Self {
            grid: Grid::of(&others, &points),
            before,
            after,
            points,
        }
    }

    /// Whether a corner can be cut off: it bends outwards, and no other corner lies in it.
    fn is_ear(&self, corners: [u32; 3], tests_left: &Cell<u64>) -> bool {
        let point = |corner: u32| self.points[corner as usize];
        let ends @ [a, b, c] = corners.map(point);
        tests_left.set(tests_left.get().saturating_sub(1));
        if side(a, b, c) <= 0.0 {
            return false;
        }
        let is_inside = |point: DVec2| side(a, b, point) >= 0.0 && side(b, c, point) >= 0.0 && side(c, a, point) >= 0.0;
        let mut cells = self.grid.between(a.min(b).min(c), a.max(b).max(c));
        !cells.any(|cell| {
            tests_left.set(tests_left.get().saturating_sub(1 + cell.len() as u64));
            let left = cell.iter().filter(|&&corner| self.after[corner as usize] != GONE);
            left.map(|&corner| point(corner))
                .any(|point| !ends.contains(&point) && is_inside(point))
        })
    }

    fn cut(&mut self, [before, ear, after]: [u32; 3]) {
        self.after[before as usize] = after;
        self.before[after as usize] = before;
        self.after[ear as usize] = GONE;
    }
}

/// How many corners each corner of a polygon may have looked at, whatever others took.
const OWN_TESTS: u64 = 64;

/// Cuts a polygon into triangles whose corners run as its own do. `tests_left` is how many corners may still be looked at beside those that are the polygon's own.
/// What is left when there are none is cut like a fan, and so is a polygon without an area; one that crosses itself is cut at corners that are no ears. Gives
/// whether none of that was so.
pub(super) fn triangulate(
    polygon: &[u32],
    positions: &[[f32; 3]],
    triangles: &mut Vec<[u32; 3]>,
    tests_left: &Cell<u64>,
) -> bool {
    if let &[a, b, c] = polygon {
        triangles.push([a, b, c]);
        return true;
    }
    let places: Vec<DVec3> = polygon
        .iter()
        .map(|&vertex| Vec3::from_array(positions[vertex as usize]).as_dvec3())
        .collect();
    // Newell's normal: the sum of the areas seen along each axis.
    let normal: DVec3 = (0..places.len())
        .map(|at| (places[at] - places[0]).cross(places[(at + 1) % places.len()] - places[0]))
        .sum();
    if normal == DVec3::ZERO {
        triangles.extend((2..polygon.len()).map(|at| [polygon[0], polygon[at - 1], polygon[at]]));
        return false;
    }
    let mut outline = Outline::new(&places, normal);
    let vertices = |corners: [u32; 3]| corners.map(|corner| polygon[corner as usize]);
    let of_file = tests_left.get();
    tests_left.set(of_file + OWN_TESTS * polygon.len() as u64);
    let (mut corner, mut left, mut tried, mut is_whole) = (0u32, polygon.len(), 0, true);
    while left > 3 && tests_left.get() > 0 {
        let ear @ [_, _, after] = [outline.before[corner as usize], corner, outline.after[corner as usize]];
        // An outline that crosses itself has no ear at the end.
        let has_ear = tried < left;
        if !has_ear || outline.is_ear(ear, tests_left) {
            triangles.push(vertices(ear));
            outline.cut(ear);
            is_whole &= has_ear;
            // The next ear does not share the new side, where it can be so: triangles stay small.
            (corner, left, tried) = (outline.after[after as usize], left - 1, 0);
        } else {
            (corner, tried) = (after, tried + 1);
        }
    }
    tests_left.set(tests_left.get().min(of_file));
    let mut second = outline.after[corner as usize];
    for _ in 2..left {
        let third = outline.after[second as usize];
        triangles.push(vertices([corner, second, third]));
        second = third;
    }
    is_whole && left == 3
}
