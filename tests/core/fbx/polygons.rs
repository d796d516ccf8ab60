//! Polygons of many corners: triangles cover them once, and no polygon takes what the others need.

use std::f64::consts::TAU;

use bindpose::import::{Imported, import};
use glam::DVec3;

use super::told;

/// A file with these points, and polygons of them one after the other.
fn file(points: &[[f64; 2]], polygons: &[Vec<usize>]) -> String {
    let joined = |numbers: Vec<String>| format!("*{} {{\n\t\t\ta: {}\n\t\t}}", numbers.len(), numbers.join(","));
    let points: Vec<String> = points
        .iter()
        .flat_map(|[x, y]| [format!("{x:.5}"), format!("{y:.5}"), "0".to_owned()])
        .collect();
    let corners = polygons.iter().flat_map(|polygon| {
        let last = polygon.len() - 1;
        let stored = move |(place, &corner): (usize, &usize)| {
            let corner = corner as i64;
            if place == last { !corner } else { corner }.to_string()
        };
        polygon.iter().enumerate().map(stored)
    });
    format!(
        "; FBX 7.4.0 project file\nObjects:  {{\n\tGeometry: 1, \"Geometry::Outlines\", \"Mesh\" {{\n\t\tVertices: {}\n\t\t\
         PolygonVertexIndex: {}\n\t}}\n\tModel: 2, \"Model::Outlines\", \"Mesh\" {{\n\t}}\n}}\nConnections:  {{\n\tC: \"OO\",1,2\n\t\
         C: \"OO\",2,0\n}}\n",
        joined(points),
        joined(corners.collect())
    )
}

/// What a file becomes, and its triangles in the file's unit.
fn triangles(file: &str) -> (Imported, Vec<[DVec3; 3]>) {
    let imported = import(file.as_bytes()).unwrap_or_else(|refused| panic!("{:?}", refused.error));
    let mesh = &imported.model.mesh;
    let corner = |&index: &u32| mesh.positions[index as usize].as_dvec3() * 100.0;
    let triangles = mesh.indices.as_chunks::<3>().0.iter();
    let triangles = triangles.map(|corners| corners.each_ref().map(corner)).collect();
    (imported, triangles)
}

fn area<'a>(triangles: impl IntoIterator<Item = &'a [DVec3; 3]>) -> f64 {
    let triangles = triangles.into_iter();
    triangles.map(|[a, b, c]| (*b - *a).cross(*c - *a).length() / 2.0).sum()
}

fn outline_area(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    let doubled: f64 = points
        .iter()
        .zip(next)
        .map(|([x, y], [to_x, to_y])| x * to_y - to_x * y)
        .sum();
    doubled / 2.0
}

/// Of polygons that did not come out.
const BROKEN: &str = "fbx-rule-broken";
const NOT_WHOLE: &str =
    "of \"Outlines\" without an area, with sides that cross or with too many corners; triangles may overlap.";

/// A disc from whose rim a wedge goes to its middle. With twenty of them work that grew by the square of the corners would be beyond what the file is given
/// (8 million tests, and 16 for each of its bytes), and what is left would be cut like a fan, over the wedge.
#[test]
fn notched_discs_of_thousands_of_corners_are_cut_in_bounded_work() {
    const CORNERS: usize = 6000;
    const WEDGE: f64 = 0.1;
    const DISCS: usize = 20;
    let rim = (0..CORNERS - 1).map(|at| WEDGE + (TAU - 2.0 * WEDGE) * at as f64 / (CORNERS - 2) as f64);
    let mut points: Vec<[f64; 2]> = rim.map(|angle| [100.0 * angle.cos(), 100.0 * angle.sin()]).collect();
    points.push([0.0, 0.0]);
    let disc: Vec<usize> = (0..CORNERS).collect();
    let (imported, triangles) = triangles(&file(&points, &vec![disc; DISCS]));
    assert_eq!(triangles.len(), DISCS * (CORNERS - 2));
    // Areas with signs always sum to the outline's: without signs they do where no triangle is turned over.
    let (ours, whole) = (area(&triangles), DISCS as f64 * outline_area(&points));
    assert!((ours - whole).abs() < 1e-4 * whole, "{ours}, not {whole}");
    for corners in &triangles {
        let middle = corners.iter().sum::<DVec3>() / 3.0;
        assert!(
            middle.y.atan2(middle.x).abs() > WEDGE - 1e-4,
            "{corners:?} lies in the wedge"
        );
    }
    assert_eq!(told(&imported, BROKEN), [""; 0]);
}

/// Spikes that stand along a ring: the box about each meets a quarter of the ring.
fn swirl(spikes: usize) -> Vec<[f64; 2]> {
    let corners = (0..spikes).flat_map(|at| {
        let angle = TAU * at as f64 / spikes as f64;
        let [x, y] = [10.0 * angle.cos(), 10.0 * angle.sin()];
        let along = angle + 1.4;
        [[x, y], [x + 40.0 * along.cos(), y + 40.0 * along.sin()]]
    });
    corners.collect()
}

#[test]
fn polygons_that_take_all_tests_are_told_and_leave_the_others_theirs() {
    let mut points = swirl(6000);
    let swirl: Vec<usize> = (0..points.len()).collect();
    let start = points.len();
    // An L whose first corner does not see all others.
    let l = [[2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0], [0.0, 0.0]];
    points.extend(l.map(|[x, y]| [1000.0 + x, y]));
    let l: Vec<usize> = (start..start + 6).collect();
    let (imported, triangles) = triangles(&file(&points, &[swirl.clone(), swirl.clone(), swirl, l]));
    let of_l: Vec<_> = triangles.iter().filter(|corners| corners[0].x > 500.0).collect();
    assert_eq!(of_l.len(), 4);
    let ours = area(of_l);
    assert!((ours - 3.0).abs() < 1e-3, "{ours}");
    let told = told(&imported, BROKEN);
    let [note] = told.as_slice() else { panic!("{told:?}") };
    assert!(note.ends_with(NOT_WHOLE), "{note}");
}

#[test]
fn polygons_without_an_area_and_with_sides_that_cross_are_told() {
    let line = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]];
    let square = [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]];
    // Its second half runs the other way round.
    let crossing = [
        [0.0, 0.0],
        [8.0, 0.0],
        [8.0, 8.0],
        [-2.0, -2.0],
        [-2.0, -6.0],
        [-6.0, -6.0],
        [-6.0, -2.0],
    ];
    let points = [&line[..], &square, &crossing].concat();
    let polygons: [Vec<usize>; 3] = [(0..4).collect(), (4..8).collect(), (8..15).chain([11]).collect()];
    for (which, message) in [
        (0..3, vec![format!("2 polygons {NOT_WHOLE}")]),
        (1..3, vec![format!("1 polygon {NOT_WHOLE}")]),
        (1..2, vec![]),
    ] {
        let (imported, triangles) = triangles(&file(&points, &polygons[which.clone()]));
        assert_eq!(told(&imported, BROKEN), message);
        let corners: usize = polygons[which].iter().map(|polygon| polygon.len() - 2).sum();
        assert_eq!(triangles.len(), corners);
    }
}
