//! Fronts of triangles, and whether backs may be seen.

use bindpose::model::{AlphaMode, Handedness, Influences, Material, Mesh, Model, Reflectance, Submesh};
use glam::{Vec2, Vec3};

/// A box of one material with corners and normals of each side's own, wound clockwise from outside in a left-handed space.
fn boxed() -> Model {
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let at = |out: f32, u: f32, v: f32| {
                let mut place = [0.0; 3];
                (place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3]) = (out, u, v);
                Vec3::from_array(place)
            };
            let first = mesh.positions.len() as u32;
            let [a, b] = [sign, 1.0];
            mesh.positions
                .extend([at(sign, -a, -b), at(sign, a, -b), at(sign, a, b), at(sign, -a, b)]);
            mesh.normals.extend([at(sign, 0.0, 0.0); 4]);
            mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
        }
    }
    mesh.tex_coords = vec![Vec2::ZERO; 24];
    mesh.submeshes = vec![Submesh {
        triangle_start: 0,
        triangle_count: 12,
        material: 0,
    }];
    let model = Model {
        materials: vec![Material::default()],
        mesh,
        ..Model::default()
    };
    model.checked().expect("it is sound")
}

fn turn(model: &mut Model, triangles: std::ops::Range<usize>) {
    for triangle in triangles {
        model.mesh.indices.swap(3 * triangle + 1, 3 * triangle + 2);
    }
}

fn needs_both_sides(model: &Model) -> Vec<bool> {
    model.needs_both_sides(&model.turned_submeshes())
}

#[test]
fn of_a_closed_box_no_backs_are_seen() {
    assert_eq!(needs_both_sides(&boxed()), [false]);
    let mut right_handed = boxed();
    right_handed.handedness = Handedness::Right;
    turn(&mut right_handed, 0..12);
    assert_eq!(needs_both_sides(&right_handed), [false]);
    let mut far_away = boxed();
    far_away
        .mesh
        .positions
        .iter_mut()
        .for_each(|at| *at += Vec3::splat(1000.0));
    assert_eq!(needs_both_sides(&far_away), [false]);
}

#[test]
fn backs_are_seen_through_an_opening_and_where_triangles_are_turned() {
    type Change = (&'static str, fn(&mut Model));
    let changes: [Change; 8] = [
        ("a triangle is missing", |model| {
            model.mesh.submeshes[0].triangle_count = 11;
        }),
        ("a triangle is turned", |model| turn(model, 3..4)),
        ("a triangle is there twice", |model| {
            let first = model.mesh.indices[..3].to_vec();
            model.mesh.indices.extend(first);
            model.mesh.submeshes[0].triangle_count = 13;
        }),
        ("a submesh is there twice", |model| {
            model.mesh.submeshes.extend_from_within(..);
        }),
        ("its fronts are inside", |model| {
            turn(model, 0..12);
            model.mesh.normals.iter_mut().for_each(|normal| *normal = -*normal);
        }),
        ("alpha cuts it", |model| {
            model.materials[0].alpha = AlphaMode::clipped(true);
        }),
        ("an edge tears open when it moves", |model| {
            let by = |joint| Influences {
                joints: [joint, 0, 0, 0],
                weights: [1.0, 0.0, 0.0, 0.0],
            };
            model.mesh.influences = (0..24).map(|vertex| by(u32::from(vertex < 4))).collect();
        }),
        ("one of two boxes has its fronts inside", |model| {
            let Mesh {
                positions,
                normals,
                indices,
                ..
            } = &mut model.mesh;
            positions.extend_from_within(..);
            positions[24..]
                .iter_mut()
                .for_each(|at| *at = *at * 0.5 + Vec3::X * 9.0);
            normals.extend_from_within(..);
            normals[24..].iter_mut().for_each(|normal| *normal = -*normal);
            indices.extend_from_within(..);
            indices[36..].iter_mut().for_each(|index| *index += 24);
            model.mesh.submeshes[0].triangle_count = 24;
            turn(model, 12..24);
        }),
    ];
    for (what, change) in changes {
        let mut model = boxed();
        change(&mut model);
        assert_eq!(needs_both_sides(&model), [true], "{what}");
        // What a file says is kept.
        model.materials[0].double_sided = false;
        assert_eq!(needs_both_sides(&model), [false], "{what}");
    }
    let mut of_gltf = boxed();
    of_gltf.materials[0].reflectance = Reflectance::MetallicRoughness {
        metallic: 0.0,
        roughness: 1.0,
    };
    assert_eq!(needs_both_sides(&of_gltf), [true], "as its file says");
}

#[test]
fn each_submesh_of_a_book_is_wound_as_most_of_its_triangles_are() {
    let mut model = boxed();
    let half = |triangle_start| Submesh {
        triangle_start,
        triangle_count: 6,
        material: 0,
    };
    model.mesh.submeshes = vec![half(0), half(6)];
    assert_eq!(model.turned_submeshes(), [false, false]);
    turn(&mut model, 6..11);
    assert_eq!(model.turned_submeshes(), [false, true]);
    // A submesh that overlaps both goes with most of its own.
    model.mesh.submeshes.push(half(4));
    assert_eq!(model.turned_submeshes(), [false, true, true]);
    model.handedness = Handedness::Right;
    assert_eq!(model.turned_submeshes(), [true, false, false]);
    for material in [
        Material {
            double_sided: false,
            ..Material::default()
        },
        Material {
            reflectance: Reflectance::MetallicRoughness {
                metallic: 0.0,
                roughness: 1.0,
            },
            ..Material::default()
        },
    ] {
        model.materials = vec![material];
        assert_eq!(model.turned_submeshes(), [false; 3], "it faces as it is wound");
    }
}
