//! Vertices: normals, tangents, handedness, limits.

use bindpose::format::{Dialect, Document, parse, write};
use bindpose::import::m3d;
use bindpose::model::{Handedness, UpAxis};
use glam::{Vec2, Vec3, Vec4};

use crate::documents::{assert_told, figure, message_of, model_of, quad, vertex};

/// The quad as seen in a mirror: z negated, and with it normals; the winding stays.
fn right_handed() -> Document {
    let mut document = quad();
    document
        .vertices
        .iter_mut()
        .for_each(|vertex| vertex.normal = [0.0, 0.0, 1.0]);
    document
}

#[test]
fn winding_against_normals_tells_the_hand() {
    assert_eq!(model_of(&quad()).0.handedness, Handedness::Left);
    assert_eq!(model_of(&right_handed()).0.handedness, Handedness::Right);
    // No evidence: as in the books.
    let mut document = quad();
    document.vertices.iter_mut().for_each(|vertex| vertex.normal = [0.0; 3]);
    assert_eq!(model_of(&document).0.handedness, Handedness::Left);
}

#[test]
fn a_divided_vote_is_told() {
    let mut document = quad();
    document.triangles = vec![[0, 1, 2], [0, 3, 2]];
    let (model, codes) = model_of(&document);
    assert_eq!(
        (model.handedness, codes),
        (Handedness::Left, vec!["handedness-unclear"])
    );
    assert_eq!(
        message_of(&document, "handedness-unclear"),
        "1 of 2 triangles wind as in a left-handed file, the rest as in a right-handed one."
    );
}

#[test]
fn up_is_z_in_the_blender_dialect_only() {
    for (dialect, up_axis) in [
        (Dialect::D3d12, UpAxis::Y),
        (Dialect::D3d11, UpAxis::Y),
        (Dialect::Imm, UpAxis::Z),
    ] {
        let document = Document { dialect, ..quad() };
        assert_eq!(model_of(&document).0.up_axis, up_axis);
    }
}

#[test]
fn missing_normals_follow_the_file_s_hand_and_the_triangles_area() {
    for (mut document, facing) in [(quad(), Vec3::NEG_Z), (right_handed(), Vec3::Z)] {
        document.vertices[1].normal = [0.0; 3];
        document.vertices[2].normal = [f32::NAN, 0.0, 1.0];
        let (model, codes) = model_of(&document);
        assert_eq!(model.mesh.normals[1], facing);
        assert_eq!(model.mesh.normals[2], facing);
        assert_eq!(codes, ["normals-missing"]);
    }
    // A roof of two slopes, the right one three times as wide: its side weighs three times as much.
    let mut roof = quad();
    let corners = [
        [-1.0, 0.0, 0.0],
        [0.0, 0.0, -1.0],
        [0.0, 1.0, -1.0],
        [-1.0, 1.0, 0.0],
        [3.0, 0.0, 2.0],
        [3.0, 1.0, 2.0],
    ];
    roof.vertices = corners
        .map(|position| bindpose::format::Vertex {
            position,
            normal: [0.0; 3],
            ..vertex(0.0, 0.0)
        })
        .to_vec();
    roof.triangles = vec![[0, 3, 2], [0, 2, 1], [1, 2, 5], [1, 5, 4]];
    let (model, _) = model_of(&roof);
    let (left, right) = (Vec3::new(-1.0, 0.0, -1.0), Vec3::new(1.0, 0.0, -1.0));
    // Of the ridge, vertex 1 has one left and two right triangles, vertex 2 two left ones and one right.
    for (vertex, normal) in [
        (0, left),
        (1, left + right * 6.0),
        (2, left * 2.0 + right * 3.0),
        (4, right),
    ] {
        let computed = model.mesh.normals[vertex];
        assert!(
            computed.abs_diff_eq(normal.normalize(), 1e-6),
            "vertex {vertex}: {computed}"
        );
    }
    assert_eq!(
        message_of(&roof, "normals-missing"),
        "6 vertices have a normal that is zero or not finite; computed from the triangles."
    );
}

#[test]
fn a_vertex_without_triangles_still_has_directions() {
    let mut document = quad();
    document.vertices.push(bindpose::format::Vertex {
        normal: [0.0; 3],
        tangent: [0.0; 4],
        ..vertex(5.0, 5.0)
    });
    let (model, codes) = model_of(&document);
    assert_eq!(model.mesh.normals[4], Vec3::Y);
    let tangent = model.mesh.tangents[4];
    assert!(tangent.truncate().dot(Vec3::Y).abs() < 1e-6 && (tangent.truncate().length() - 1.0).abs() < 1e-6);
    assert_eq!(codes, ["normals-missing", "tangents-missing"]);
}

#[test]
fn missing_tangents_follow_u_and_their_sign_points_along_v() {
    // (texture coordinates of a vertex at x, y; tangent; the way v grows)
    type Case = (fn(f32, f32) -> [f32; 2], Vec3, Vec3);
    let cases: [Case; 4] = [
        (|x, y| [x, -y], Vec3::X, Vec3::NEG_Y),
        (|x, y| [-x, -y], Vec3::NEG_X, Vec3::NEG_Y),
        (|x, y| [3.0 * y, 0.5 * x], Vec3::Y, Vec3::X),
        (|x, y| [x + y, -y], Vec3::X, Vec3::new(1.0, -1.0, 0.0)),
    ];
    for (tex_coords, tangent, along_v) in cases {
        let mut document = quad();
        for vertex in &mut document.vertices {
            vertex.tex_coords = tex_coords(vertex.position[0], vertex.position[1]);
            vertex.tangent = [0.0; 4];
        }
        let (model, _) = model_of(&document);
        for (computed, normal) in model.mesh.tangents.iter().zip(&model.mesh.normals) {
            assert!(
                computed.truncate().abs_diff_eq(tangent, 1e-6),
                "{computed} is not {tangent}"
            );
            let bitangent = normal.cross(computed.truncate()) * computed.w;
            assert!(bitangent.dot(along_v) > 0.0, "{bitangent} is against {along_v}");
        }
        let words = "4 vertices have a tangent that is zero or not finite; computed from the texture coordinates.";
        assert_told(&document, "tangents-missing", words);
    }
}

#[test]
fn texture_coordinates_without_area_give_some_tangent_in_the_surface() {
    let mut document = quad();
    for vertex in &mut document.vertices {
        vertex.tex_coords = [0.5, 0.5];
        vertex.tangent = [f32::NAN, 0.0, 0.0, 1.0];
    }
    let (model, _) = model_of(&document);
    for tangent in &model.mesh.tangents {
        assert!(
            tangent.z.abs() < 1e-6 && (tangent.truncate().length() - 1.0).abs() < 1e-6,
            "{tangent}"
        );
        assert_eq!(tangent.w.abs(), 1.0);
    }
}

#[test]
fn signs_are_1_and_vectors_are_unit() {
    let mut document = quad();
    document.vertices[0].tangent = [2.0, 0.0, 0.0, -0.5];
    document.vertices[1].tangent = [2.0, 0.0, 0.0, 0.0];
    document.vertices[2].tangent = [2.0, 0.0, 0.0, f32::NAN];
    document.vertices[3].normal = [0.0, 0.0, -7.0];
    let (model, _) = model_of(&document);
    let signs: Vec<f32> = model.mesh.tangents.iter().map(|tangent| tangent.w).collect();
    assert_eq!(signs, [-1.0, 1.0, 1.0, 1.0]);
    assert!(model.mesh.tangents.iter().all(|tangent| tangent.truncate() == Vec3::X));
    assert!(model.mesh.normals.iter().all(|&normal| normal == Vec3::NEG_Z));
    let words = "3 vertices have a tangent whose fourth number is not 1 or −1; its sign is kept.";
    assert_told(&document, "tangent-sign", words);
}

#[test]
fn numbers_that_are_not_finite_become_0() {
    let mut document = quad();
    document.vertices[1].position = [f32::NAN, 1.0, f32::INFINITY];
    document.vertices[2].tex_coords = [f32::NEG_INFINITY, 0.5];
    let (model, codes) = model_of(&document);
    assert_eq!(model.mesh.positions[1], Vec3::Y);
    assert_eq!(model.mesh.tex_coords[2], Vec2::new(0.0, 0.5));
    assert_eq!(codes, ["vertex-not-finite"; 2]);
    document.vertices[2].tex_coords = [0.0; 2];
    assert_eq!(
        message_of(&document, "vertex-not-finite"),
        "1 vertex has a position that is not finite; taken as 0."
    );
}

#[test]
fn the_greatest_coordinates_give_finite_directions() {
    let mut document = quad();
    for vertex in &mut document.vertices {
        vertex.position = vertex.position.map(|number| number * f32::MAX);
        vertex.normal = [0.0; 3];
        vertex.tangent = [0.0; 4];
    }
    let (model, _) = model_of(&document);
    assert_eq!(model.mesh.normals[0], Vec3::NEG_Z);
    assert_eq!(model.mesh.tangents[0], Vec4::new(1.0, 0.0, 0.0, 1.0));
}

#[test]
fn more_vertices_than_16_bits_can_number_are_fine_and_told() {
    let mut document = quad();
    document.vertices.resize(65_536, vertex(0.0, 0.0));
    let (model, codes) = model_of(&document);
    assert_eq!((model.mesh.vertex_count(), codes), (65_536, vec![]));
    document.vertices.push(vertex(0.0, 0.0));
    let (model, codes) = model_of(&document);
    assert_eq!((model.mesh.vertex_count(), codes), (65_537, vec!["many-vertices"]));
    assert_eq!(
        message_of(&document, "many-vertices"),
        "There are 65537 vertices; the books' 16-bit indices can number 65536."
    );
}

#[test]
fn a_finding_about_tangents_is_on_their_own_lines() {
    let mut document = quad();
    for index in [0, 1, 3] {
        document.vertices[index].tangent = [0.0; 4];
    }
    // Between the position and the tangent of the second vertex is an empty line.
    let text = write(&document);
    let second = text.match_indices("Tangent:").nth(1).expect("four vertices").0;
    let text = format!("{}\n{}", &text[..second], &text[second..]);
    let parsed = parse(text.as_bytes()).expect("sound");
    let (_, findings) = m3d::from_parsed(&parsed).expect("sound");
    let finding = findings.iter().find(|finding| finding.code == "tangents-missing");
    let places = &finding.expect("it is told").places;
    let lines: Vec<&str> = text.lines().collect();
    let tangents = (1..).zip(&lines).filter(|(_, line)| line.starts_with("Tangent:"));
    let tangents: Vec<u32> = tangents.map(|(number, _)| number).collect();
    let expected = [tangents[0], tangents[1], tangents[3]];
    assert_eq!(places.iter().map(|place| place.line).collect::<Vec<_>>(), expected);
}

#[test]
fn a_few_missing_tangents_are_those_that_the_whole_mesh_would_have() {
    let mut document = figure().document;
    let missing: Vec<usize> = (0..document.vertices.len()).step_by(37).collect();
    for &vertex in &missing {
        document.vertices[vertex].tangent = [0.0; 4];
    }
    let mesh = model_of(&document).0.mesh;
    let computed = mesh.computed_tangents();
    assert!(missing.len() > 10);
    for vertex in missing {
        let [found, expected] =
            [mesh.tangents[vertex], computed[vertex]].map(|tangent| tangent.to_array().map(f32::to_bits));
        assert_eq!(found, expected, "{vertex}");
    }
}
