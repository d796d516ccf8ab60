//! The skin: closed, facing outwards, laid flat without twists.

use std::collections::BTreeMap;

use glam::DVec3;

use super::{FIGURE, WRITTEN_METRES, position, vector, welded};

/// Texels a side of a look at the figure, over two metres.
const LOOK: usize = 200;

/// What is seen first of the figure along a direction: for each texel how near it is, and whether it faces the eye.
fn look(points: &[DVec3], along: DVec3) -> Vec<Option<(f64, bool)>> {
    let right = along.any_orthonormal_vector();
    let up = right.cross(along);
    let mut seen = vec![None::<(f64, bool)>; LOOK * LOOK];
    let texels = LOOK as f64 / 2.0;
    let flat = |point: DVec3| {
        let from_middle = point - DVec3::Y * 0.9;
        DVec3::new(
            (from_middle.dot(right) + 1.0) * texels,
            (from_middle.dot(up) + 1.0) * texels,
            from_middle.dot(along),
        )
    };
    for triangle in &FIGURE.triangles {
        let [a, b, c] = triangle.map(|corner| points[corner as usize]);
        let faces = (b - a).cross(c - a).dot(along) < 0.0;
        let [a, b, c] = [a, b, c].map(flat);
        let area = (b - a).truncate().perp_dot((c - a).truncate());
        if area == 0.0 {
            continue;
        }
        let (min, max) = (a.min(b).min(c), a.max(b).max(c));
        for y in min.y.ceil() as usize..=max.y as usize {
            for x in min.x.ceil() as usize..=max.x as usize {
                let at = glam::DVec2::new(x as f64, y as f64);
                let part =
                    |from: DVec3, to: DVec3| (to.truncate() - from.truncate()).perp_dot(at - from.truncate()) / area;
                let [u, v, w] = [part(b, c), part(c, a), part(a, b)];
                if u < 0.0 || v < 0.0 || w < 0.0 {
                    continue;
                }
                let depth = a.z * u + b.z * v + c.z * w;
                let texel = &mut seen[y * LOOK + x];
                if texel.is_none_or(|(nearest, _)| depth < nearest) {
                    *texel = Some((depth, faces));
                }
            }
        }
    }
    seen
}

#[test]
fn from_no_side_one_sees_the_inside() {
    // Solids are open where they end inside of others: there, an eye would see a face from behind.
    let points: Vec<DVec3> = FIGURE.vertices.iter().map(|vertex| vector(vertex.position)).collect();
    for x in -1..=1 {
        for y in -1..=1 {
            for z in -1..=1 {
                let along = DVec3::new(f64::from(x) + 0.1, f64::from(y) + 0.03, f64::from(z) - 0.07).normalize();
                let seen = look(&points, along);
                let behind = seen.iter().flatten().filter(|(_, faces)| !faces).count();
                let all = seen.iter().flatten().count();
                assert!(
                    behind * 400 < all,
                    "along {along}: {behind} of {all} texels show an inside"
                );
            }
        }
    }
}

#[test]
fn winding_and_normals_point_outwards_as_in_left_handed_files() {
    let mut inside_out = Vec::new();
    for triangle in &FIGURE.triangles {
        let [a, b, c] = triangle.map(position);
        let normals = triangle.map(|corner| vector(FIGURE.vertices[corner as usize].normal));
        let facing = (b - a)
            .cross(c - a)
            .normalize()
            .dot(normals.into_iter().sum::<DVec3>().normalize());
        if facing <= 0.0 {
            inside_out.push((a, facing));
        }
    }
    assert!(inside_out.is_empty(), "{inside_out:?}");
}

#[test]
fn normals_and_tangents_are_unit_and_across() {
    // Three decimals.
    const ROUNDING: f64 = 2e-3;
    for (index, vertex) in FIGURE.vertices.iter().enumerate() {
        let (normal, [x, y, z, w]) = (vector(vertex.normal), vertex.tangent);
        let tangent = vector([x, y, z]);
        assert!((normal.length() - 1.0).abs() < ROUNDING, "vertex {index}: {normal}");
        assert!((tangent.length() - 1.0).abs() < ROUNDING, "vertex {index}: {tangent}");
        assert!(
            normal.dot(tangent).abs() < ROUNDING,
            "vertex {index}: {normal} and {tangent}"
        );
        // Some renderers of these files, the books' own among them, leave it unread and take 1.
        assert!(w == 1.0, "vertex {index}: {w}");
    }
}

#[test]
fn tangents_follow_the_texture_across_each_triangle() {
    // Where a coarse triangle spans a crease, as between fingers, its corners lean away from it; that stays rare.
    let (mut leaning, mut turned) = (0, 0);
    for triangle in &FIGURE.triangles {
        let [a, b, c] = triangle.map(position);
        let [ta, tb, tc] = triangle.map(|corner| FIGURE.vertices[corner as usize].tex_coords.map(f64::from));
        let (u1, v1, u2, v2) = (tb[0] - ta[0], tb[1] - ta[1], tc[0] - ta[0], tc[1] - ta[1]);
        let area = u1 * v2 - u2 * v1;
        // A triangle without area in the texture would have no direction.
        assert!(area.abs() > 1e-7, "triangle {triangle:?} at {a}");
        let along_u = ((b - a) * v2 - (c - a) * v1) / area;
        let along_v = ((c - a) * u1 - (b - a) * u2) / area;
        for corner in triangle {
            let vertex = FIGURE.vertices[*corner as usize];
            let [x, y, z, w] = vertex.tangent;
            let (tangent, normal) = (vector([x, y, z]), vector(vertex.normal));
            let bitangent = normal.cross(tangent) * f64::from(w);
            let (u, v) = (tangent.dot(along_u.normalize()), bitangent.dot(along_v.normalize()));
            leaning += usize::from(u < 0.4 || v < 0.4);
            turned += usize::from(u < 0.0 || v < 0.0);
        }
    }
    let corners = 3 * FIGURE.triangles.len();
    assert!(
        leaning < corners / 150 && turned < corners / 3_000,
        "{leaning} corners lean away, {turned} are turned"
    );
}

#[test]
fn subsets_cover_all_triangles_and_only_their_own_vertices() {
    let (mut face, mut vertex) = (0, 0);
    assert_eq!(FIGURE.subsets.len(), FIGURE.materials.len());
    for subset in &FIGURE.subsets {
        assert_eq!((subset.face_start, subset.vertex_start), (face, vertex));
        assert!(subset.face_count > 100);
        face += subset.face_count;
        vertex += subset.vertex_count;
        let own = subset.vertex_start..vertex;
        let triangles = &FIGURE.triangles[subset.face_start as usize..face as usize];
        assert!(triangles.iter().flatten().all(|corner| own.contains(corner)));
    }
    assert_eq!(
        (face as usize, vertex as usize),
        (FIGURE.triangles.len(), FIGURE.vertices.len())
    );
    assert!(
        (16_000..20_000).contains(&FIGURE.triangles.len()),
        "{} triangles",
        FIGURE.triangles.len()
    );
}

#[test]
fn it_stands_on_the_ground_and_is_1_8_m_tall() {
    let bounds = |axis: usize| {
        let values = FIGURE.vertices.iter().map(|vertex| f64::from(vertex.position[axis]));
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), value| {
            (min.min(value), max.max(value))
        })
    };
    let ((left, right), (bottom, top)) = (bounds(0), bounds(1));
    assert!(bottom.abs() < 0.003, "{bottom}");
    assert!((1.76..1.82).contains(&top), "{top}");
    assert!((left + right).abs() < 2.0 * WRITTEN_METRES, "{left} … {right}");
}

#[test]
fn the_bind_pose_is_its_own_mirror_image() {
    // Sums that run in the other order on the other side differ in their last bits, and so may the last decimal.
    let cell = |p: DVec3| (p * 2_000.0).round().as_i64vec3().to_array();
    let (welded, _) = welded(&FIGURE);
    let mut cells = BTreeMap::<[i64; 3], Vec<DVec3>>::new();
    for &point in &welded {
        cells.entry(cell(point)).or_default().push(point);
    }
    let mut alone = 0usize;
    for point in &welded {
        let mirrored = DVec3::new(-point.x, point.y, point.z);
        let [x, y, z] = cell(mirrored);
        let near = |[dx, dy, dz]: [i64; 3]| cells.get(&[x + dx, y + dy, z + dz]).into_iter().flatten();
        let offsets = (0..27).map(|i| [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1]);
        let found = offsets
            .flat_map(near)
            .any(|other| other.distance(mirrored) < 5.0 * WRITTEN_METRES);
        alone += usize::from(!found);
    }
    // The aerial, and what is on the chest.
    assert!(alone * 100 < welded.len(), "{alone} of {} vertices", welded.len());
}
