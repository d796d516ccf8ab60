//! From solids to an even mesh: polygonise, find regions, then relax along the surface and snap to borders.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::body::Body;
use crate::materials::Region;
use crate::rig::Rig;
use crate::sdf::gradient;
use crate::surface_nets::{figure_lattice, polygonise};

/// The figure's closed skin in the bind pose.
pub(crate) struct Skin {
    /// On the surface.
    pub(crate) positions: Vec<DVec3>,
    /// Unit, outwards.
    pub(crate) normals: Vec<DVec3>,
    /// Corners so that cross(b − a, c − a) points outwards.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// One per triangle.
    pub(crate) regions: Vec<Region>,
    /// Neighbours along edges of quads.
    pub(crate) neighbours: Vec<Vec<u32>>,
}

/// Rounds of moving vertices to the middle of their neighbours: enough to even out the lattice's steps, few enough to keep
/// fingertips and rims populated.
const RELAX_ROUNDS: usize = 8;
const RELAX_RATE: f64 = 0.5;

impl Skin {
    /// The skin of `body`.
    pub(crate) fn new(body: &Body, rig: &Rig) -> Skin {
        let field = |point| body.distance(point);
        let mesh = polygonise(&figure_lattice(), field);
        let (mut positions, quads) = (mesh.positions, mesh.quads);
        for position in &mut positions {
            *position = onto_surface(&field, *position, 3);
        }

        let mut quad_regions: Vec<Region> = quads
            .iter()
            .map(|quad| Region::of(body, rig, onto_surface(&field, middle(&positions, quad), 1)))
            .collect();
        fill_notches(&quads, &mut quad_regions);
        let borders = borders(positions.len(), &quads, &quad_regions);
        let neighbours = neighbours(positions.len(), &quads);

        let surface = Surface {
            body,
            rig,
            borders: &borders,
        };
        for _ in 0..RELAX_ROUNDS {
            surface.relax(&mut positions, &neighbours);
        }
        surface.settle(&mut positions);

        let normals: Vec<DVec3> = positions
            .iter()
            .map(|position| gradient(&field, *position).normalize())
            .collect();
        let mut triangles = Vec::with_capacity(2 * quads.len());
        let mut regions = Vec::with_capacity(2 * quads.len());
        for (quad, region) in quads.iter().zip(quad_regions) {
            triangles.extend(split(quad, &positions, &normals));
            regions.extend([region; 2]);
        }
        Skin {
            positions,
            normals,
            triangles,
            regions,
            neighbours,
        }
    }
}

/// What vertices keep to while they move.
struct Surface<'a> {
    body: &'a Body,
    rig: &'a Rig,
    /// For each vertex the region whose border it keeps to.
    borders: &'a [Option<Region>],
}

impl Surface<'_> {
    fn field(&self) -> impl Fn(DVec3) -> f64 {
        |point| self.body.distance(point)
    }

    fn border(&self, region: Region) -> impl Fn(DVec3) -> f64 {
        move |point| region.border(self.body, self.rig, point)
    }

    /// Moves all vertices along the surface towards the middle of their neighbours.
    fn relax(&self, positions: &mut [DVec3], neighbours: &[Vec<u32>]) {
        let before = positions.to_vec();
        for (vertex, position) in positions.iter_mut().enumerate() {
            let border = self.borders[vertex];
            // A border vertex follows its border only, or the border would be smoothed away.
            let follows = |other: &&u32| border.is_none() || self.borders[**other as usize] == border;
            let around = neighbours[vertex]
                .iter()
                .filter(follows)
                .map(|other| before[*other as usize]);
            let (sum, count) = around.fold((DVec3::ZERO, 0.0), |(sum, count), point| (sum + point, count + 1.0));
            let pull = if count > 0.0 {
                (sum / count - *position) * RELAX_RATE
            } else {
                DVec3::ZERO
            };
            *position = match border {
                // Newton with two surfaces keeps only what is along the border.
                Some(region) => onto_border(&self.field(), &self.border(region), *position + pull, 2),
                None => {
                    let slope = gradient(&self.field(), *position);
                    let along_surface = pull - slope * (pull.dot(slope) / slope.length_squared());
                    onto_surface(&self.field(), *position + along_surface, 1)
                }
            };
        }
    }

    /// Brings all vertices onto the surface and their borders, to less than the file can say.
    fn settle(&self, positions: &mut [DVec3]) {
        for (position, border) in positions.iter_mut().zip(self.borders) {
            *position = match border {
                Some(region) => onto_border(&self.field(), &self.border(*region), *position, 4),
                None => onto_surface(&self.field(), *position, 2),
            };
        }
    }
}

/// Gives a quad that has another region on three sides to that region: snapped, its corners would all lie in one line.
fn fill_notches(quads: &[[u32; 4]], regions: &mut [Region]) {
    let edges = |quad: &[u32; 4]| [0, 1, 2, 3].map(|i| (quad[i], quad[(i + 1) % 4]));
    let of_edge: BTreeMap<(u32, u32), usize> = quads
        .iter()
        .enumerate()
        .flat_map(|(index, quad)| edges(quad).map(|edge| (edge, index)))
        .collect();
    for _ in 0..2 {
        let before = regions.to_vec();
        for (quad, region) in quads.iter().zip(&mut *regions) {
            // The skin is closed: each edge runs the other way in the quad beyond it.
            let beyond = edges(quad).map(|(a, b)| before[of_edge[&(b, a)]]);
            let owns_three = |other: &&Region| beyond.iter().filter(|region| region == other).count() >= 3;
            *region = *beyond.iter().find(owns_three).unwrap_or(region);
        }
    }
}

/// For a vertex where regions meet, the region whose border that is: the first in the order of ownership.
fn borders(vertex_count: usize, quads: &[[u32; 4]], regions: &[Region]) -> Vec<Option<Region>> {
    let mut first = vec![None::<Region>; vertex_count];
    let mut mixed = vec![false; vertex_count];
    for (quad, &region) in quads.iter().zip(regions) {
        for &vertex in quad {
            let vertex = vertex as usize;
            let known = first[vertex].get_or_insert(region);
            mixed[vertex] |= *known != region;
            *known = region.min(*known);
        }
    }
    first
        .into_iter()
        .zip(mixed)
        .map(|(first, mixed)| first.filter(|_| mixed))
        .collect()
}

fn neighbours(vertex_count: usize, quads: &[[u32; 4]]) -> Vec<Vec<u32>> {
    let mut neighbours = vec![Vec::with_capacity(6); vertex_count];
    for quad in quads {
        for corner in 0..4 {
            let (a, b) = (quad[corner], quad[(corner + 1) % 4]);
            for (from, to) in [(a, b), (b, a)] {
                let list: &mut Vec<u32> = &mut neighbours[from as usize];
                if !list.contains(&to) {
                    list.push(to);
                }
            }
        }
    }
    neighbours
}

fn middle(positions: &[DVec3], quad: &[u32; 4]) -> DVec3 {
    quad.iter().map(|vertex| positions[*vertex as usize]).sum::<DVec3>() / 4.0
}

/// Two triangles along the diagonal that makes the better worst triangle. Vertices that were snapped to a border can lie in
/// line, and a triangle of three such would have no area.
fn split(quad: &[u32; 4], positions: &[DVec3], normals: &[DVec3]) -> [[u32; 3]; 2] {
    let [a, b, c, d] = *quad;
    let worst = |triangles: &[[u32; 3]; 2]| {
        let shapes = triangles.map(|triangle| {
            shape(
                triangle.map(|v| positions[v as usize]),
                triangle.map(|v| normals[v as usize]),
            )
        });
        shapes[0].min(shapes[1])
    };
    let (first, second) = ([[a, b, c], [a, c, d]], [[b, c, d], [b, d, a]]);
    // The slack keeps mirrored quads alike where rounding would decide.
    if worst(&second) > worst(&first) + 1e-6 {
        second
    } else {
        first
    }
}

/// How good a triangle is: its area over its squared edges, negative where it faces away from its normals.
fn shape([a, b, c]: [DVec3; 3], normals: [DVec3; 3]) -> f64 {
    let area = (b - a).cross(c - a).dot(normals.into_iter().sum::<DVec3>().normalize());
    area / (a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a))
}

/// Newton steps to where `field` is zero.
fn onto_surface(field: &impl Fn(DVec3) -> f64, mut point: DVec3, steps: usize) -> DVec3 {
    for _ in 0..steps {
        let slope = gradient(field, point);
        point -= slope * (field(point) / slope.length_squared());
    }
    point
}

/// Least-norm Newton steps to where both are zero; where the two nearly touch without crossing, only the field counts.
fn onto_border(field: &impl Fn(DVec3) -> f64, border: &impl Fn(DVec3) -> f64, mut point: DVec3, steps: usize) -> DVec3 {
    /// Metres: a step longer than a cell would leave the neighbourhood.
    const LONGEST: f64 = 0.012;
    for _ in 0..steps {
        let (f, g) = (gradient(field, point), gradient(border, point));
        let (ff, fg, gg) = (f.length_squared(), f.dot(g), g.length_squared());
        let determinant = ff * gg - fg * fg;
        if determinant < 0.05 * ff * gg {
            break;
        }
        let (a, b) = (field(point), border(point));
        let step = f * ((gg * a - fg * b) / determinant) + g * ((ff * b - fg * a) / determinant);
        point -= step.clamp_length_max(LONGEST);
    }
    onto_surface(field, point, 2)
}
