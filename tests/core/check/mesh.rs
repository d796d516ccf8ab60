//! Triangles and vertices that add nothing, or harm.

use std::collections::{HashMap, HashSet};

use bindpose::diagnostic::{Position, Subject};
use bindpose::format::{Document, LineMap};
use proptest::prelude::*;

use super::{codes_of, only};
use crate::documents::{arm, quad, subset, vertex};

/// The quad with more triangles.
fn quad_and(triangles: &[[u32; 3]]) -> Document {
    let mut document = quad();
    document.triangles.extend(triangles);
    document.subsets = vec![subset(0, document.triangles.len() as u32)];
    document
}

#[test]
fn sound_meshes_have_no_findings_at_any_size() {
    let none: [&str; 0] = [];
    for size in [1e-15, 1e-6, 1.0, 1e6, 1e15] {
        for mut document in [quad(), arm()] {
            document.clips.clear();
            for vertex in &mut document.vertices {
                vertex.position = vertex.position.map(|number| number * size);
            }
            assert_eq!(codes_of(&document), none, "{size}");
        }
    }
    assert_eq!(codes_of(&Document::default()), none);
}

#[test]
fn a_triangle_is_flat_below_a_millionth_of_the_mesh() {
    for (height, codes) in [(0.9e-6, vec!["triangles-without-area"]), (1.1e-6, vec![])] {
        let mut document = quad_and(&[[0, 4, 5]]);
        // A long one: what counts is its height, not its area. The quad's diagonal is √2.
        let height = height * std::f32::consts::SQRT_2;
        document.vertices.extend([vertex(0.0, 0.9), vertex(height, 0.4)]);
        assert_eq!(codes_of(&document), codes, "{height}");
    }
}

/// The quad is a millionth of the way to the vertex, which no triangle has.
#[test]
fn a_vertex_far_away_makes_no_triangle_flat() {
    let mut document = quad();
    document.vertices.push(vertex(1e9, 0.0));
    let finding = only(&document, &LineMap::default());
    assert_eq!(
        (finding.code, finding.subject),
        ("vertices-unused", Some(Subject::Vertex(4)))
    );
    assert_eq!(finding.message, "1 vertex is a corner of no triangle.");
}

#[test]
fn equal_corners_are_told_once_however_often_they_stand() {
    let document = quad_and(&[[0, 0, 1], [0, 0, 1], [1, 0, 0], [2, 2, 2]]);
    let finding = only(&document, &LineMap::default());
    assert_eq!((finding.code, finding.count), ("triangles-without-area", 4));
    assert_eq!(finding.subjects, [2, 3, 4, 5].map(Subject::Triangle));
}

#[test]
fn triangles_are_the_same_from_whatever_corner_and_side() {
    let document = quad_and(&[[1, 2, 0], [3, 2, 0], [2, 0, 1]]);
    let lines = LineMap {
        triangles: (50..).take(5).collect(),
        ..LineMap::default()
    };
    let (_, findings) = crate::documents::checked(&document, &lines);
    let finding = findings
        .iter()
        .find(|finding| finding.code == "triangles-repeated")
        .expect("it is found");
    assert_eq!(
        finding.message,
        "3 triangles have the same three vertices as another one before."
    );
    assert_eq!(finding.subjects, [2, 3, 4].map(Subject::Triangle));
    assert_eq!(finding.places, [52, 53, 54].map(|line| Position { line, column: 1 }));
    // The first ones are sound, and no edge is crowded by what is there twice.
    assert!(!findings.iter().any(|finding| finding.code == "edges-crowded"));
}

#[test]
fn an_edge_is_crowded_from_its_third_triangle_on() {
    let mut document = quad_and(&[[0, 4, 2], [0, 5, 2], [0, 2, 6]]);
    document.vertices.extend([0.5, 1.0, 1.5].map(|depth| {
        let mut fin = vertex(0.5, 0.5);
        fin.position[2] = -depth;
        fin
    }));
    let finding = only(&document, &LineMap::default());
    assert_eq!((finding.code, finding.count), ("edges-crowded", 1));
    assert_eq!(finding.subjects, [Subject::Triangle(2)]);
    // Vertices at the same place that are not the same: sheets that touch.
    let seam = [document.vertices[0], document.vertices[2]];
    document.vertices.extend([seam, seam, seam].concat());
    document.triangles = vec![[0, 1, 2], [0, 2, 3], [7, 4, 8], [9, 5, 10], [11, 12, 6]];
    assert_eq!(codes_of(&document), Vec::<&str>::new());
}

proptest! {
    #![proptest_config(crate::properties::cases(300))]

    /// A few vertices with many triangles: what is told is what a look at each pair of triangles, and at each edge of each, finds.
    #[test]
    fn repeated_triangles_and_crowded_edges_are_those_that_a_plain_count_finds(
        corners in prop::collection::vec([0_u32..7, 0..7, 0..7], 1..9),
    ) {
        let mut document = quad();
        document.vertices.extend([0.3, 0.7, 0.9].map(|depth| {
            let mut fin = vertex(depth, 0.1);
            fin.position[2] = -depth * depth;
            fin
        }));
        document.subsets = vec![subset(0, corners.len() as u32)];
        document.triangles = corners.clone();
        let (mut met, mut edges, mut repeated, mut third) = (HashSet::new(), HashMap::new(), Vec::new(), Vec::new());
        for (triangle, mut corners) in (0_u32..).zip(corners) {
            corners.sort_unstable();
            let [a, b, c] = corners;
            if a == b || b == c {
                continue;
            }
            if !met.insert(corners) {
                repeated.push(Subject::Triangle(triangle));
                continue;
            }
            for edge in [[a, b], [b, c], [a, c]] {
                let count = edges.entry(edge).or_insert(0);
                *count += 1;
                if *count == 3 {
                    third.push(Subject::Triangle(triangle));
                }
            }
        }
        let (_, findings) = crate::documents::checked(&document, &LineMap::default());
        for (code, mut expected) in [("triangles-repeated", repeated), ("edges-crowded", third)] {
            let found = findings.iter().find(|finding| finding.code == code);
            let count = found.map_or(0, |finding| finding.count as usize);
            prop_assert_eq!(count, expected.len());
            expected.dedup();
            prop_assert_eq!(found.map_or(&[][..], |finding| &finding.subjects), &expected[..]);
        }
    }
}
