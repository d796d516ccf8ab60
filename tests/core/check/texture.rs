//! Texture coordinates and tangents that spoil maps.

use bindpose::diagnostic::Subject;
use bindpose::format::{Document, LineMap};

use super::{codes_of, only};
use crate::documents::{material, quad, subset, vertex};

const NONE: [&str; 0] = [];

/// The quad with both maps.
fn mapped() -> Document {
    let mut document = quad();
    document.materials[0].diffuse_map = Some("diff.dds".to_owned());
    document.materials[0].normal_map = Some("norm.dds".to_owned());
    document
}

#[test]
fn equal_coordinates_harm_only_where_a_map_is_named() {
    for (document, codes) in [(quad(), &NONE[..]), (mapped(), &["tex-coords-equal"])] {
        let mut equal = document;
        for vertex in &mut equal.vertices {
            vertex.tex_coords = [0.25, 0.5];
        }
        assert_eq!(codes_of(&equal), codes);
        equal.vertices[3].tex_coords = [0.25, 0.75];
        assert_eq!(codes_of(&equal), NONE, "one that differs");
    }
}

/// Two triangles at each of the points a, a, b, and two that are stretched, looked at by every range.
#[test]
fn each_subset_is_told_for_itself_wherever_it_begins() {
    let mut document = mapped();
    let corners = |at: [f32; 2]| {
        [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[x, y]| bindpose::format::Vertex {
            tex_coords: at,
            ..vertex(x, y)
        })
    };
    let (a, b) = ([0.5, 0.5], [0.0, 0.5]);
    document.vertices = [a, a, b].into_iter().flat_map(corners).collect();
    document.vertices.extend(quad().vertices);
    document.triangles = vec![[0, 1, 2], [3, 4, 5], [6, 7, 8], [9, 10, 11], [9, 11, 12]];
    for start in 0..5 {
        for count in 0..=5 - start {
            document.subsets = vec![subset(0, 5), subset(start, count)];
            document.materials = vec![document.materials[0].clone(); 2];
            document.materials[1].name = "other".to_owned();
            let is_one =
                count > 0 && (start..start + count).all(|triangle| triangle < 2 || (triangle == 2 && start == 2));
            let (_, findings) = crate::documents::checked(&document, &LineMap::default());
            let told = findings.iter().find(|finding| finding.code == "tex-coords-equal");
            let expected = is_one.then_some(Subject::Subset(1));
            assert_eq!(told.and_then(|finding| finding.subject), expected, "{start} {count}");
        }
    }
}

#[test]
fn a_sign_is_wrong_where_every_triangle_says_so() {
    let mut document = mapped();
    document.vertices[1].tangent[3] = -1.0;
    let finding = only(&document, &LineMap::default());
    assert_eq!(
        (finding.code, finding.subjects),
        ("tangent-sign-against-uv", vec![Subject::Vertex(1)])
    );
    document.materials[0].normal_map = None;
    assert_eq!(codes_of(&document), NONE, "tangents are for normal maps");
}

#[test]
fn mirrored_coordinates_are_fine_with_their_sign() {
    let mut document = mapped();
    for vertex in &mut document.vertices {
        vertex.tex_coords[0] *= -1.0;
        vertex.tangent = [-1.0, 0.0, 0.0, -1.0];
    }
    assert_eq!(codes_of(&document), NONE);
}

/// The second triangle is mirrored at the diagonal, whose vertices have one sign for both.
#[test]
fn where_mirrored_triangles_meet_no_sign_is_accused() {
    let mut document = mapped();
    document.vertices[3].tex_coords = document.vertices[1].tex_coords;
    document.vertices[3].tangent = [0.0, 1.0, 0.0, -1.0];
    assert_eq!(codes_of(&document), NONE);
}

/// A needle's directions are made of rounding errors.
#[test]
fn needles_say_nothing_of_a_sign() {
    let mut document = mapped();
    let half = std::f32::consts::FRAC_1_SQRT_2;
    for (thinness, codes) in [(0.001, &NONE[..]), (0.1, &["tangent-sign-against-uv"])] {
        for vertex in &mut document.vertices {
            let [x, y, _] = vertex.position;
            // All in a line, but for this little.
            vertex.tex_coords = [x + y, (x + y) * 0.5 + y * thinness];
            vertex.tangent = [half, half, 0.0, 1.0];
        }
        assert_eq!(codes_of(&document), codes, "{thinness}");
    }
}

#[test]
fn subsets_without_a_normal_map_are_left_alone() {
    let mut document = mapped();
    document.materials.push(material("other"));
    document.subsets = vec![subset(1, 1), subset(0, 1)];
    for vertex in &mut document.vertices {
        vertex.tangent[3] = -1.0;
    }
    assert_eq!(
        only(&document, &LineMap::default()).subjects,
        [0, 2, 3].map(Subject::Vertex)
    );
}
