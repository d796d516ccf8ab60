//! What vertices have besides their place: normals, texture coordinates, colours, tangents.

use bindpose::anim::{PoseBuffers, SkinnedVertices, skin};
use bindpose::model::Model;
use glam::{DAffine3, DVec2, DVec3, DVec4};
use ufbx::Scene;

use super::{CYCLE, NO_NUMBERS, Outcome, TOLERANCE, Table, all_points, axes, compare_all, size, world_from_vertex};

/// Of numbers that are 1 at most, as normals are.
const MOST_OFF: f64 = 1e-3;

/// ufbx takes other values where a layer names one that is not there; here there is none.
const OTHER_CORNERS: Table = &[
    NO_NUMBERS,
    CYCLE,
    (
        "synthetic_by_vertex_overflow_7500_ascii.fbx",
        "its layers name values that are not there",
    ),
    (
        "synthetic_unsafe_cube_7500_binary.fbx",
        "its layers name values that are not there",
    ),
];

/// A corner of a face, at rest.
struct Corner {
    place: DVec3,
    /// `None` where there is none, or one without a direction.
    normal: Option<DVec3>,
    tex_coord: DVec2,
    color: DVec4,
    /// Tangent and bitangent, likewise.
    tangent: Option<[DVec3; 2]>,
}

impl Corner {
    /// The greatest difference of what both have.
    fn apart(&self, other: &Self) -> f64 {
        let normal = self.normal.zip(other.normal).map_or(0.0, |(a, b)| a.distance(b));
        let tangent = self.tangent.zip(other.tangent).map_or(0.0, |([a, up], [b, other_up])| {
            // Binormals need not be square to the others: their side is compared.
            a.distance(b).max(if up.dot(other_up) > 0.0 { 0.0 } else { 2.0 })
        });
        let tex_coord = (self.tex_coord - other.tex_coord).abs().max_element();
        let color = (self.color - other.color).abs().max_element();
        normal.max(tangent).max(tex_coord).max(color)
    }
}

fn direction(vector: DVec3) -> Option<DVec3> {
    vector.try_normalize().filter(|vector| vector.is_finite())
}

fn their_corners(scene: &Scene) -> Vec<Corner> {
    let axes = axes(scene);
    let vector = |vector: ufbx::Vec3| DVec3::new(vector.x, vector.y, vector.z);
    let mut all = Vec::new();
    for node in scene.nodes.iter() {
        let Some(mesh) = &node.mesh else { continue };
        let to_world: Vec<DAffine3> = (0..mesh.num_vertices)
            .map(|vertex| world_from_vertex(node, mesh, vertex))
            .collect();
        for face in mesh.faces.iter().filter(|face| face.num_indices >= 3) {
            for corner in (face.index_begin..face.index_begin + face.num_indices).map(|corner| corner as usize) {
                let vertex = mesh.vertex_indices[corner] as usize;
                let (position, to_world) = (vector(mesh.vertices[vertex]), to_world[vertex]);
                let normal_matrix = to_world.matrix3.inverse().transpose();
                let along = |stream: &ufbx::VertexVec3| {
                    let along = stream
                        .exists
                        .then(|| axes * (to_world.matrix3 * vector(stream[corner])));
                    along.and_then(direction)
                };
                let normal = mesh.vertex_normal.exists.then(|| mesh.vertex_normal[corner]);
                let uv = mesh.vertex_uv.exists.then(|| mesh.vertex_uv[corner]);
                let color = mesh.vertex_color.exists.then(|| mesh.vertex_color[corner]);
                let color = color.map_or(DVec4::ONE, |color| DVec4::new(color.x, color.y, color.z, color.w));
                all.push(Corner {
                    place: axes * to_world.transform_point3(position),
                    normal: normal.and_then(|normal| direction(axes * (normal_matrix * vector(normal)))),
                    tex_coord: uv.map_or(DVec2::ZERO, |uv| DVec2::new(uv.x, 1.0 - uv.y)),
                    color: color.clamp(DVec4::ZERO, DVec4::ONE),
                    tangent: along(&mesh.vertex_tangent)
                        .zip(along(&mesh.vertex_bitangent))
                        .map(Into::into),
                });
            }
        }
    }
    all
}

fn our_corners(model: &Model) -> Vec<Corner> {
    let mesh = &model.mesh;
    let mut skinned = SkinnedVertices::default();
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    pose.set_rest_pose(&model.skeleton);
    skin(mesh, &pose.palette, &mut skinned);
    let corner = |vertex: usize| {
        let normal = skinned.normals[vertex].as_dvec3();
        Corner {
            place: skinned.positions[vertex].as_dvec3(),
            normal: Some(normal),
            tex_coord: mesh.tex_coords.get(vertex).map_or(DVec2::ZERO, |uv| uv.as_dvec2()),
            color: mesh.colors.get(vertex).map_or(DVec4::ONE, |color| color.as_dvec4()),
            tangent: skinned.tangents.get(vertex).map(|tangent| {
                let along = tangent.truncate().as_dvec3();
                [along, normal.cross(along) * f64::from(tangent.w)]
            }),
        }
    };
    (0..skinned.positions.len()).map(corner).collect()
}

/// The greatest way from what a corner has to what the nearest of the others has at its place.
fn off(corners: &[Corner], others: &[Corner], within: f64) -> f64 {
    let mut order: Vec<usize> = (0..others.len()).collect();
    order.sort_by(|a, b| others[*a].place.x.total_cmp(&others[*b].place.x));
    let nearest = |corner: &Corner| {
        let start = order.partition_point(|&index| others[index].place.x < corner.place.x - within);
        order[start..]
            .iter()
            .map(|&index| &others[index])
            .take_while(|other| other.place.x <= corner.place.x + within)
            .filter(|other| other.place.distance(corner.place) <= within)
            .map(|other| corner.apart(other))
            .fold(f64::INFINITY, f64::min)
    };
    corners.iter().map(nearest).fold(0.0, f64::max)
}

fn compare(_: &str, model: &Model, scene: &Scene) -> Outcome {
    let [our_corners, their_corners] = [our_corners(model), their_corners(scene)];
    if our_corners.is_empty() || their_corners.is_empty() {
        return Outcome::Nothing("no corners");
    }
    let has_tangents = |corners: &[Corner]| corners.iter().any(|corner| corner.tangent.is_some());
    if has_tangents(&their_corners) && !has_tangents(&our_corners) {
        return Outcome::Wrong("without tangents".to_owned());
    }
    let within = TOLERANCE * size(&all_points(scene));
    let off = off(&our_corners, &their_corners, within).max(off(&their_corners, &our_corners, within));
    let tangents = if has_tangents(&their_corners) {
        ", with tangents"
    } else {
        ""
    };
    let listed = format!("{off:.1e}{tangents}");
    match off <= MOST_OFF {
        true => Outcome::Near(listed),
        false => Outcome::Wrong(listed),
    }
}

#[test]
fn vertices_have_what_ufbx_gives_them() {
    compare_all(OTHER_CORNERS, compare);
}

#[test]
fn tangents_are_on_the_side_that_ufbx_has_them_on() {
    let found = super::files("files")
        .into_iter()
        .filter(|(name, _)| name.starts_with("maya_tangent_sign"));
    for (name, bytes) in found {
        let Ok((model, scene)) = super::both(&bytes) else {
            panic!("{name} is read by both")
        };
        let theirs = their_corners(&scene);
        let side = |corner: &Corner| {
            let [tangent, bitangent] = corner.tangent?;
            Some(corner.normal?.cross(tangent).dot(bitangent) > 0.0)
        };
        let sides = |wanted: bool| theirs.iter().filter(|corner| side(corner) == Some(wanted)).count();
        // Both sides are there, so that no constant passes.
        assert!(
            sides(true) > 0 && sides(false) > 0,
            "{name}: {} and {}",
            sides(true),
            sides(false)
        );
        assert!(matches!(compare(&name, &model, &scene), Outcome::Near(_)), "{name}");
    }
}
