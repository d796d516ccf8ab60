//! Solids: corners with normals that keep edges sharp, and the joints that move them.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use crate::document::round;
use crate::materials::Material;
use crate::rig::mirrored_joint;

/// Up to four joints and their weights in hundredths, which sum to 100; the heaviest first.
pub(crate) type Influences = [(usize, u32); 4];

/// What moves a solid.
#[derive(Clone, Debug)]
pub(crate) enum Binding {
    /// One joint moves all of it.
    Rigid(usize),
    /// Joints follow each other along a direction: each has all the weight at its place, metres along from the origin.
    Along {
        origin: DVec3,
        along: DVec3,
        joints: Vec<(f64, usize)>,
    },
}

impl Binding {
    fn influences(&self, point: DVec3) -> Influences {
        match self {
            Binding::Rigid(joint) => [(*joint, 100), (0, 0), (0, 0), (0, 0)],
            Binding::Along { origin, along, joints } => {
                let at = (point - *origin).dot(*along);
                let after = joints.iter().position(|joint| joint.0 > at);
                let single = |joint| [(joint, 100), (0, 0), (0, 0), (0, 0)];
                match after {
                    Some(0) => single(joints[0].1),
                    None => single(joints[joints.len() - 1].1),
                    Some(after) => {
                        let ((from, a), (to, b)) = (joints[after - 1], joints[after]);
                        let t = (at - from) / (to - from);
                        let second = (t * t * (3.0 - 2.0 * t) * 100.0).round() as u32;
                        let mut pair = [(a, 100 - second), (b, second), (0, 0), (0, 0)];
                        if a == b || second == 0 {
                            return single(a);
                        }
                        if second == 100 {
                            return single(b);
                        }
                        if second > 50 {
                            pair.swap(0, 1);
                        }
                        pair
                    }
                }
            }
        }
    }
}

/// Rows of as many places each, with their texture coordinates in metres. Rows that shrink to a point are poles; ends
/// that do not are open, and lie inside of other solids.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grid {
    pub(crate) rows: Vec<Vec<(DVec3, DVec2)>>,
    /// The outline of a plate in its chart; lofts have none.
    pub(crate) outline: Vec<DVec2>,
    /// Normals of the last rows, which are the top of a plate: its triangles are too uneven to give them.
    pub(crate) top_normals: Vec<Vec<DVec3>>,
}

/// A vertex of a solid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    pub(crate) position: DVec3,
    pub(crate) normal: DVec3,
    pub(crate) tangent: DVec3,
    /// Metres in the solid's own chart.
    pub(crate) chart: DVec2,
    pub(crate) influences: Influences,
}

/// A piece of one material.
#[derive(Clone, Debug)]
pub(crate) struct Solid {
    pub(crate) material: Material,
    pub(crate) corners: Vec<Corner>,
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Of the chart, metres; it begins at zero.
    pub(crate) chart_size: DVec2,
    /// Of a plate, in the chart.
    pub(crate) outline: Vec<DVec2>,
}

/// Faces that meet at less than this cosine keep an edge between them.
const SMOOTH_COSINE: f64 = 0.15;
/// Decimals of positions in metres.
pub(crate) const POSITION_DECIMALS: i32 = 4;

impl Solid {
    /// The solid over a grid, facing outwards.
    pub(crate) fn new(material: Material, grid: &Grid, binding: &Binding) -> Solid {
        let mut points = Vec::new();
        let mut triangles = Vec::new();
        let columns = grid.rows[0].len();
        for row in &grid.rows {
            points.extend(row.iter().copied());
        }
        let top = grid.rows.len() - grid.top_normals.len();
        let known: Vec<Option<DVec3>> = std::iter::repeat_n(None, top * columns)
            .chain(grid.top_normals.iter().flatten().copied().map(Some))
            .collect();
        let at = |row: usize, column: usize| (row * columns + column) as u32;
        for row in 1..grid.rows.len() {
            for column in 1..columns {
                let (a, b) = (at(row - 1, column - 1), at(row - 1, column));
                let (c, d) = (at(row, column), at(row, column - 1));
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        Solid::from_triangles(material, &points, triangles, &known, &grid.outline, binding)
    }

    /// A solid of triangles that all face one way.
    fn from_triangles(
        material: Material,
        points: &[(DVec3, DVec2)],
        mut triangles: Vec<[u32; 3]>,
        known_normals: &[Option<DVec3>],
        outline: &[DVec2],
        binding: &Binding,
    ) -> Solid {
        let positions: Vec<DVec3> = points.iter().map(|point| written(point.0)).collect();
        let of = |triangle: &[u32; 3]| triangle.map(|corner| positions[corner as usize]);
        // Where rows shrink to a point triangles vanish.
        triangles.retain(|triangle| {
            let [a, b, c] = of(triangle);
            a != b && b != c && c != a
        });
        let middle = positions.iter().sum::<DVec3>() / positions.len() as f64;
        let volume: f64 = triangles
            .iter()
            .map(of)
            .map(|[a, b, c]| (a - middle).dot((b - a).cross(c - a)))
            .sum();
        if volume < 0.0 {
            triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        let chart_area: f64 = triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] = triangle.map(|corner| points[corner as usize].1);
                (b - a).perp_dot(c - a)
            })
            .sum();
        let flip = if chart_area < 0.0 {
            DVec2::new(-1.0, 1.0)
        } else {
            DVec2::ONE
        };
        let charts: Vec<DVec2> = points.iter().map(|point| point.1 * flip).collect();
        let used = || triangles.iter().flatten().map(|corner| charts[*corner as usize]);
        let least = used().fold(DVec2::INFINITY, DVec2::min);
        let most = used().fold(DVec2::NEG_INFINITY, DVec2::max);

        let normals = normals(&positions, &triangles, known_normals);
        let tangents = tangents(&positions, &charts, &triangles);
        let mut corners = Vec::new();
        let mut added = BTreeMap::<(u32, [u32; 3]), u32>::new();
        let mut split = Vec::with_capacity(triangles.len());
        for ((triangle, normals), tangent) in triangles.iter().zip(normals).zip(tangents) {
            let mut corner = |index: usize| {
                let point = triangle[index] as usize;
                let normal = normals[index];
                let key = (point as u32, normal.to_array().map(|value| round(value, 3).to_bits()));
                let added = *added.entry(key).or_insert_with(|| {
                    corners.push(Corner {
                        position: positions[point],
                        normal,
                        tangent: DVec3::ZERO,
                        chart: charts[point] - least,
                        influences: binding.influences(positions[point]),
                    });
                    corners.len() as u32 - 1
                });
                // The faces that share its normal share its tangent.
                corners[added as usize].tangent += tangent;
                added
            };
            split.push([corner(0), corner(1), corner(2)]);
        }
        for Corner { normal, tangent, .. } in &mut corners {
            let across = tangent.reject_from_normalized(*normal);
            *tangent = across.normalize_or(normal.any_orthonormal_vector());
        }
        Solid {
            material,
            corners,
            triangles: split,
            chart_size: most - least,
            outline: outline.iter().map(|point| *point * flip - least).collect(),
        }
    }

    /// The same on the other side of the figure. Its chart is turned round too, so that no texture is mirrored.
    pub(crate) fn mirrored(&self) -> Solid {
        let flip = DVec3::new(-1.0, 1.0, 1.0);
        let corner = |corner: &Corner| Corner {
            position: corner.position * flip,
            normal: corner.normal * flip,
            tangent: -corner.tangent * flip,
            chart: DVec2::new(self.chart_size.x - corner.chart.x, corner.chart.y),
            influences: corner.influences.map(|(joint, weight)| (mirrored_joint(joint), weight)),
        };
        Solid {
            material: self.material,
            corners: self.corners.iter().map(corner).collect(),
            triangles: self.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect(),
            chart_size: self.chart_size,
            outline: Vec::new(),
        }
    }
}

/// As the file will have it.
fn written(point: DVec3) -> DVec3 {
    let unit = 10f64.powi(POSITION_DECIMALS);
    (point * unit).round() / unit
}

/// Normals of the corners of each triangle: those that are known, else the mean of the faces there that meet smoothly, by area. Beside a bevel the
/// large face wins, so faces look flat and bevels round.
fn normals(positions: &[DVec3], triangles: &[[u32; 3]], known: &[Option<DVec3>]) -> Vec<[DVec3; 3]> {
    let key = |corner: u32| positions[corner as usize].to_array().map(f64::to_bits);
    let face = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|corner| positions[corner as usize]);
        (b - a).cross(c - a)
    };
    let faces: Vec<DVec3> = triangles.iter().map(face).collect();
    let mut around = BTreeMap::<[u64; 3], Vec<usize>>::new();
    for (index, triangle) in triangles.iter().enumerate() {
        for &corner in triangle {
            around.entry(key(corner)).or_default().push(index);
        }
    }
    let normal = |index: usize, corner: u32| {
        let own = faces[index].normalize();
        if let Some(known) = known[corner as usize].filter(|known| known.dot(own) > SMOOTH_COSINE) {
            return known;
        }
        let smooth = around[&key(corner)]
            .iter()
            .map(|other| faces[*other])
            .filter(|other| other.normalize().dot(own) > SMOOTH_COSINE);
        smooth.sum::<DVec3>().normalize()
    };
    triangles
        .iter()
        .enumerate()
        .map(|(index, triangle)| triangle.map(|corner| normal(index, corner)))
        .collect()
}

/// The direction of growing u in each triangle, the longer the larger it is.
fn tangents(positions: &[DVec3], charts: &[DVec2], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let along_u = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|corner| positions[corner as usize]);
        let [ta, tb, tc] = triangle.map(|corner| charts[corner as usize]);
        let (ab, ac) = (tb - ta, tc - ta);
        ((b - a) * ac.y - (c - a) * ab.y) * ab.perp_dot(ac).signum()
    };
    triangles.iter().map(along_u).collect()
}
