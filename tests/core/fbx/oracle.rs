//! What ufbx, a C library that reads FBX, makes of the same files: where all vertices are, at rest and in each clip.
//! `cargo test --test core oracle -- --nocapture` lists how far each file is off.
#![expect(clippy::print_stdout, reason = "the list is for people")]

use bindpose::anim::{CompiledClip, PoseBuffers, skin_positions};
use bindpose::import::{Imported, import};
use bindpose::model::Model;
use glam::{DAffine3, DMat3, DVec3, Vec3};
use ufbx::{Anim, CoordinateAxis, EvaluateOpts, LoadOpts, Mesh, Node, Scene};

use super::files;

/// Of the model's size.
const TOLERANCE: f64 = 1e-4;

/// Parts of a clip at which it is compared: the quarters, and others that no key of whole frames is at.
const PARTS: [f64; 12] = [
    0.0, 0.25, 0.5, 0.75, 1.0, 0.0713, 0.1871, 0.3347, 0.4129, 0.5839, 0.6917, 0.9431,
];

/// Files that are not compared, each with its reason.
const OUT_OF_SCOPE: &[(&str, &str)] = &[
    (
        "synthetic_bad_inf_nan_7700_ascii.fbx",
        "positions that are no numbers are 0 here",
    ),
    (
        "synthetic_node_cycle_fail_7700_ascii.fbx",
        "ufbx refuses it; here nodes that lie in themselves hang on the scene",
    ),
];

/// Files whose layers name values that are not there: ufbx takes others then, and here there are none.
const WITHOUT_VALUES: [&str; 2] = [
    "synthetic_by_vertex_overflow_7500_ascii.fbx",
    "synthetic_unsafe_cube_7500_binary.fbx",
];

/// Models are in metres.
fn in_metres() -> LoadOpts<'static> {
    LoadOpts {
        target_unit_meters: 1.0,
        ..LoadOpts::default()
    }
}

fn matrix(matrix: &ufbx::Matrix) -> DAffine3 {
    DAffine3::from_cols_array(&[
        matrix.m00, matrix.m10, matrix.m20, matrix.m01, matrix.m11, matrix.m21, matrix.m02, matrix.m12, matrix.m22,
        matrix.m03, matrix.m13, matrix.m23,
    ])
}

/// The file's axes -> right, up, front.
fn axes(scene: &Scene) -> DMat3 {
    let axis = |axis: CoordinateAxis| match axis {
        CoordinateAxis::PositiveX => Some(DVec3::X),
        CoordinateAxis::NegativeX => Some(DVec3::NEG_X),
        CoordinateAxis::PositiveY => Some(DVec3::Y),
        CoordinateAxis::NegativeY => Some(DVec3::NEG_Y),
        CoordinateAxis::PositiveZ => Some(DVec3::Z),
        CoordinateAxis::NegativeZ => Some(DVec3::NEG_Z),
        CoordinateAxis::Unknown => None,
    };
    let axes = &scene.settings.axes;
    let all = [axis(axes.right), axis(axes.up), axis(axes.front)];
    match all {
        [Some(right), Some(up), Some(front)] => DMat3::from_cols(right, up, front).transpose(),
        _ => DMat3::IDENTITY,
    }
}

/// Where the points of a node's mesh are that faces use, with the four greatest weights.
fn points(scene: &Scene, node: &Node, mesh: &Mesh, out: &mut Vec<DVec3>) {
    let axes = axes(scene);
    let geometry_to_world = matrix(&node.geometry_to_world);
    let skin = mesh
        .skin_deformers
        .iter()
        .next()
        .filter(|skin| !skin.clusters.is_empty());
    let mut is_used = vec![false; mesh.num_vertices];
    for face in mesh.faces.iter().filter(|face| face.num_indices >= 3) {
        for corner in face.index_begin..face.index_begin + face.num_indices {
            is_used[mesh.vertex_indices[corner as usize] as usize] = true;
        }
    }
    for (index, position) in mesh.vertices.iter().enumerate().filter(|(index, _)| is_used[*index]) {
        let position = DVec3::new(position.x, position.y, position.z);
        let mut placed = geometry_to_world.transform_point3(position);
        if let Some(skin) = skin {
            let vertex = &skin.vertices[index];
            let first = vertex.weight_begin as usize;
            let mut weights: Vec<(f64, u32)> = (first..first + vertex.num_weights as usize)
                .map(|weight| (skin.weights[weight].weight, skin.weights[weight].cluster_index))
                .filter(|(weight, _)| *weight > 0.0)
                .collect();
            weights.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            weights.truncate(4);
            let sum: f64 = weights.iter().map(|(weight, _)| weight).sum();
            if sum > 0.0 {
                placed = weights
                    .iter()
                    .map(|&(weight, cluster)| {
                        matrix(&skin.clusters[cluster as usize].geometry_to_world).transform_point3(position)
                            * (weight / sum)
                    })
                    .sum();
            }
        }
        out.push(axes * placed);
    }
}

fn all_points(scene: &Scene) -> Vec<DVec3> {
    let mut all = Vec::new();
    for node in scene.nodes.iter() {
        if let Some(mesh) = &node.mesh {
            points(scene, node, mesh, &mut all);
        }
    }
    all
}

fn at(scene: &Scene, anim: &Anim, secs: f64) -> Vec<DVec3> {
    let opts = EvaluateOpts::default();
    let evaluated = ufbx::evaluate_scene(scene, anim, secs, opts).expect("it is evaluated");
    all_points(&evaluated)
}

/// Ours at rest, or at a time of a clip.
fn ours(model: &Model, clip: Option<(&CompiledClip, f32)>) -> Vec<DVec3> {
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    match clip {
        Some((clip, secs)) => pose.evaluate(&model.skeleton, clip, secs),
        None => pose.set_rest_pose(&model.skeleton),
    }
    let mut positions: Vec<Vec3> = model.mesh.positions.clone();
    if model.skeleton.joint_count() > 0 {
        skin_positions(&model.mesh, &pose.palette, &mut positions);
    }
    positions.into_iter().map(Vec3::as_dvec3).collect()
}

/// Which of theirs each of ours may be: the nearest at rest, and all that are as near.
fn matches(ours: &[DVec3], theirs: &[DVec3], within: f64) -> (Vec<Vec<u32>>, f64) {
    let mut order: Vec<u32> = (0..theirs.len() as u32).collect();
    order.sort_by(|a, b| theirs[*a as usize].x.total_cmp(&theirs[*b as usize].x));
    let mut worst = 0f64;
    let mut is_met = vec![false; theirs.len()];
    let found = ours.iter().map(|&point| {
        let start = order.partition_point(|&index| theirs[index as usize].x < point.x - within);
        let near: Vec<u32> = order[start..]
            .iter()
            .take_while(|&&index| theirs[index as usize].x <= point.x + within)
            .copied()
            .filter(|&index| theirs[index as usize].distance(point) <= within)
            .collect();
        let nearest = near
            .iter()
            .map(|&index| theirs[index as usize].distance(point))
            .fold(f64::INFINITY, f64::min);
        worst = worst.max(nearest);
        near.iter().for_each(|&index| is_met[index as usize] = true);
        near
    });
    let found = found.collect();
    if is_met.contains(&false) {
        worst = f64::INFINITY;
    }
    (found, worst)
}

fn size(points: &[DVec3]) -> f64 {
    let least = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let greatest = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    least.distance(greatest).max(1e-9)
}

/// How far a file is off, as a part of its size: at rest, and in each clip.
fn compare(bytes: &[u8], imported: &Imported) -> Result<Vec<(String, f64)>, String> {
    let scene = ufbx::load_memory(bytes, in_metres())
        .map_err(|error| format!("ufbx does not read it: {}", &*error.description))?;
    let model = &imported.model;
    let theirs = all_points(&scene);
    if theirs.is_empty() || model.mesh.positions.is_empty() {
        return match (theirs.len(), model.mesh.positions.len()) {
            (0, 0) => Ok(Vec::new()),
            counts => Err(format!("{counts:?} points")),
        };
    }
    let size = size(&theirs);
    let (candidates, at_rest) = matches(&ours(model, None), &theirs, 20.0 * TOLERANCE * size);
    let mut off = vec![("rest".to_owned(), at_rest / size)];
    if at_rest.is_infinite() {
        return Ok(off);
    }
    for stack in scene.anim_stacks.iter() {
        let within = |[start, end]: [f64; 2]| PARTS.map(|part| (start + (end - start) * part) as f32);
        let Some(clip) = model.clips.iter().find(|clip| *clip.name == *stack.element.name) else {
            // What moves nothing is no clip.
            let moves = |secs: f32| {
                let posed = at(&scene, &stack.anim, f64::from(secs));
                posed
                    .iter()
                    .zip(&theirs)
                    .any(|(posed, rest)| posed.distance(*rest) > TOLERANCE * size)
            };
            if within([stack.time_begin, stack.time_end]).into_iter().any(moves) {
                return Err(format!("clip {} is missing", &*stack.element.name));
            }
            continue;
        };
        let compiled = CompiledClip::new(clip);
        let mut worst = 0f64;
        let times = within([clip.start_secs, clip.end_secs].map(f64::from));
        let posed = times.map(|secs| at(&scene, &stack.anim, f64::from(secs)));
        // What moves far is as large as its way, also between those times.
        let way = (0..=64).flat_map(|step| {
            let secs = clip.start_secs + (clip.end_secs - clip.start_secs) * step as f32 / 64.0;
            ours(model, Some((&compiled, secs)))
        });
        let size = self::size(&way.collect::<Vec<_>>()).max(size);
        for (secs, theirs) in times.into_iter().zip(posed) {
            for (point, candidates) in ours(model, Some((&compiled, secs))).iter().zip(&candidates) {
                let nearest = candidates
                    .iter()
                    .map(|&index| theirs[index as usize].distance(*point))
                    .fold(f64::INFINITY, f64::min);
                worst = worst.max(nearest);
            }
        }
        off.push((clip.name.clone(), worst / size));
    }
    Ok(off)
}

/// What a vertex has besides its place: normal, texture coordinates, colour.
type Corner = ([f64; 3], [f64; 3], [f64; 2], [f64; 4]);

/// What corners of faces have at rest; what a mesh lacks is 0, and white.
fn corners(scene: &Scene) -> Vec<Corner> {
    let axes = axes(scene);
    let mut all = Vec::new();
    for node in scene.nodes.iter() {
        let Some(mesh) = &node.mesh else { continue };
        let geometry_to_world = matrix(&node.geometry_to_world);
        let normal_matrix = geometry_to_world.matrix3.inverse().transpose();
        for face in mesh.faces.iter().filter(|face| face.num_indices >= 3) {
            for corner in (face.index_begin..face.index_begin + face.num_indices).map(|corner| corner as usize) {
                let position = mesh.vertices[mesh.vertex_indices[corner] as usize];
                let position = geometry_to_world.transform_point3(DVec3::new(position.x, position.y, position.z));
                let normal = mesh.vertex_normal.exists.then(|| mesh.vertex_normal[corner]);
                let normal = normal.map_or(DVec3::ZERO, |normal| {
                    (normal_matrix * DVec3::new(normal.x, normal.y, normal.z)).normalize_or_zero()
                });
                let uv = if mesh.vertex_uv.exists {
                    mesh.vertex_uv[corner]
                } else {
                    ufbx::Vec2 { x: 0.0, y: 1.0 }
                };
                let color = if mesh.vertex_color.exists {
                    mesh.vertex_color[corner]
                } else {
                    ufbx::Vec4 {
                        x: 1.0,
                        y: 1.0,
                        z: 1.0,
                        w: 1.0,
                    }
                };
                let clamped = [color.x, color.y, color.z, color.w].map(|number| number.clamp(0.0, 1.0));
                all.push((
                    (axes * position).to_array(),
                    (axes * normal).to_array(),
                    [uv.x, 1.0 - uv.y],
                    clamped,
                ));
            }
        }
    }
    all
}

/// The greatest way from what one of our vertices has to the nearest of theirs.
fn corners_off(model: &Model, scene: &Scene) -> f64 {
    let theirs = corners(scene);
    let mesh = &model.mesh;
    let size = size(&all_points(scene));
    let mut order: Vec<usize> = (0..theirs.len()).collect();
    order.sort_by(|a, b| theirs[*a].0[0].total_cmp(&theirs[*b].0[0]));
    let rest = ours(model, None);
    let off = |vertex: usize| {
        let (place, within) = (rest[vertex], TOLERANCE * size);
        let uv = mesh
            .tex_coords
            .get(vertex)
            .copied()
            .unwrap_or_default()
            .as_dvec2()
            .to_array();
        let color = mesh
            .colors
            .get(vertex)
            .map_or([1.0; 4], |color| color.as_dvec4().to_array());
        let start = order.partition_point(|&index| theirs[index].0[0] < place.x - within);
        let near = order[start..]
            .iter()
            .take_while(|&&index| theirs[index].0[0] <= place.x + within)
            .map(|&index| &theirs[index]);
        let near = near.filter(|their| DVec3::from_array(their.0).distance(place) <= within);
        let ways = near.map(|(_, normal, their_uv, their_color)| {
            let has_normal = *normal != [0.0; 3] && normal.iter().all(|number| number.is_finite());
            let turned = if has_normal {
                mesh.normals[vertex].as_dvec3().distance(DVec3::from_array(*normal))
            } else {
                0.0
            };
            let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            turned.max(apart(&uv, their_uv)).max(apart(&color, their_color))
        });
        ways.fold(f64::INFINITY, f64::min)
    };
    (0..rest.len()).map(off).fold(0.0, f64::max)
}

#[test]
fn vertices_have_what_ufbx_gives_them() {
    let mut wrong = Vec::new();
    for (name, bytes) in files("files") {
        let (Ok(imported), Ok(scene)) = (import(&bytes), ufbx::load_memory(&bytes, in_metres())) else {
            continue;
        };
        // Normals of what is skinned are turned by its bones.
        let is_skinned = scene.meshes.iter().any(|mesh| !mesh.skin_deformers.is_empty());
        if is_skinned
            || WITHOUT_VALUES.contains(&&*name)
            || imported.model.mesh.positions.is_empty()
            || OUT_OF_SCOPE.iter().any(|(file, _)| *file == name)
        {
            continue;
        }
        let off = corners_off(&imported.model, &scene);
        println!("{name}: {off:.1e}");
        if off > 1e-3 {
            wrong.push(format!("{name}: {off}"));
        }
    }
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn vertices_are_where_ufbx_has_them() {
    let mut wrong = Vec::new();
    for (name, bytes) in files("files").into_iter().chain(files("mixamo")) {
        if let Some((_, reason)) = OUT_OF_SCOPE.iter().find(|(file, _)| *file == name) {
            println!("{name}: not compared: {reason}");
            continue;
        }
        let imported = match import(&bytes) {
            Ok(imported) => imported,
            Err(refused) => {
                println!("{name}: {}", refused.error.message);
                if ufbx::load_memory(&bytes, in_metres()).is_ok() && refused.error.code != "fbx-version" {
                    wrong.push(format!("{name}: refused: {}", refused.error.message));
                }
                continue;
            }
        };
        match compare(&bytes, &imported) {
            Ok(off) => {
                let listed: Vec<String> = off.iter().map(|(clip, off)| format!("{clip} {off:.1e}")).collect();
                println!("{name}: {}", listed.join(", "));
                if off.iter().any(|(_, off)| off.is_nan() || *off > TOLERANCE) {
                    wrong.push(format!("{name}: {}", listed.join(", ")));
                }
            }
            Err(why) => wrong.push(format!("{name}: {why}")),
        }
    }
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
}

/// The files of the repository's own.
fn own() -> Vec<(String, Vec<u8>)> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/fbx");
    let entries = std::fs::read_dir(folder)
        .expect("it is there")
        .map(|entry| entry.expect("a file").path());
    entries
        .map(|path| {
            (
                path.file_name().expect("a name").to_string_lossy().into_owned(),
                std::fs::read(&path).expect("a file"),
            )
        })
        .collect()
}

#[test]
fn joints_are_where_ufbx_has_them() {
    let mut wrong = Vec::new();
    let mut count = 0;
    for (name, bytes) in files("files").into_iter().chain(files("mixamo")).chain(own()) {
        let (Ok(imported), Ok(scene)) = (import(&bytes), ufbx::load_memory(&bytes, in_metres())) else {
            continue;
        };
        let model = &imported.model;
        let skeleton = &model.skeleton;
        let axes = DAffine3::from_mat3(axes(&scene));
        // Those whose name is theirs alone.
        let alone = |wanted: &str| scene.nodes.iter().filter(|node| *node.element.name == *wanted).count() == 1;
        let joints: Vec<(usize, &str)> = (0..skeleton.joint_count())
            .filter_map(|joint| Some((joint, skeleton.name(bindpose::model::JointIndex(joint as u32))?)))
            .filter(|(_, name)| alone(name))
            .collect();
        for clip in &model.clips {
            let Some(stack) = scene.anim_stacks.iter().find(|stack| *stack.element.name == *clip.name) else {
                continue;
            };
            let compiled = CompiledClip::new(clip);
            let mut pose = PoseBuffers::for_skeleton(skeleton);
            let (mut worst, mut reach) = (0f64, 1e-9f64);
            for part in PARTS {
                let secs = clip.start_secs + (clip.end_secs - clip.start_secs) * part as f32;
                pose.evaluate(skeleton, &compiled, secs);
                let evaluated = ufbx::evaluate_scene(&scene, &stack.anim, f64::from(secs), EvaluateOpts::default())
                    .expect("it is evaluated");
                let places: Vec<[DVec3; 2]> = joints
                    .iter()
                    .map(|&(joint, name)| {
                        let node = evaluated
                            .nodes
                            .iter()
                            .find(|node| *node.element.name == *name)
                            .expect("it is there");
                        let theirs = (axes * matrix(&node.node_to_world)).translation;
                        [pose.model.0[joint].translation.as_dvec3(), theirs]
                    })
                    .collect();
                for [ours, theirs] in &places {
                    worst = worst.max(ours.distance(*theirs));
                    reach = reach.max(theirs.distance(places[0][1]));
                }
            }
            count += 1;
            println!("{name}, {}: {} joints, {:.1e}", clip.name, joints.len(), worst / reach);
            if joints.len() > 1 && worst > TOLERANCE * reach {
                wrong.push(format!("{name}, {}: {}", clip.name, worst / reach));
            }
        }
    }
    assert!(wrong.is_empty() && count >= 2, "{}:\n{}", wrong.len(), wrong.join("\n"));
}
