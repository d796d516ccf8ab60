//! What ufbx, a C library that reads FBX, makes of the same files: where all vertices are, at rest and in each clip.
//! `cargo test --test core oracle -- --nocapture` lists how far each file is off, and of what.
#![expect(clippy::print_stdout, reason = "the list is for people")]

mod corners;
mod joints;

use bindpose::anim::{CompiledClip, PoseBuffers, skin_positions};
use bindpose::import::import;
use bindpose::model::{Clip, Model};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use ufbx::{AnimStack, CoordinateAxis, EvaluateOpts, LoadOpts, Mesh, Node, Scene, SceneRoot};

use super::files;

/// Of the model's size at rest.
const TOLERANCE: f64 = 1e-4;

/// Parts of a clip at which it is compared: the quarters, and others that no key of whole frames is at.
const PARTS: [f64; 12] = [
    0.0, 0.25, 0.5, 0.75, 1.0, 0.0713, 0.1871, 0.3347, 0.4129, 0.5839, 0.6917, 0.9431,
];

/// Files of which ufbx makes something else, each with the reason.
type Table = &'static [(&'static str, &'static str)];

const NO_NUMBERS: (&str, &str) = (
    "synthetic_bad_inf_nan_7700_ascii.fbx",
    "positions that are no numbers are 0 here",
);

const CYCLE: (&str, &str) = (
    "synthetic_node_cycle_fail_7700_ascii.fbx",
    "ufbx refuses it; here nodes that lie in themselves hang on the scene",
);

const OTHER_POINTS: Table = &[NO_NUMBERS, CYCLE];

/// Starts of names of files that go so far that their way is the measure: the straight pieces of a clip stray by a part of what its values range over.
const FAR: [&str; 4] = [
    "maya_extrapolate_cube_",
    "maya_null_pivots_",
    "motionbuilder_tangent_auto_bias_absolute_simple_",
    "motionbuilder_tangent_auto_bias_absolute_split_",
];

/// A way is so many times the size at rest at least where it is the measure.
const LEAST_WAY: f64 = 10.0;

/// What comes of comparing a file.
enum Outcome {
    /// How near it is.
    Near(String),
    /// Why there is nothing to compare.
    Nothing(&'static str),
    Wrong(String),
}

/// Compares all files. Those of the table must be wrong, and no others.
fn compare_all(table: Table, compare: impl Fn(&str, &Model, &Scene) -> Outcome) {
    let (mut wrong, mut count) = (Vec::new(), 0);
    let shared = files("files");
    let is_there = |file: &str| shared.is_empty() || shared.iter().any(|(name, _)| name == file);
    for (file, _) in table.iter().filter(|(file, _)| !is_there(file)) {
        wrong.push(format!("{file} is listed, and not there"));
    }
    for (name, bytes) in shared.iter().chain(&files("mixamo")).chain(&own()) {
        let outcome = both(bytes).map_or_else(|none| none, |(model, scene)| compare(name, &model, &scene));
        let reason = table.iter().find(|(file, _)| file == name).map(|(_, reason)| reason);
        count += usize::from(matches!(outcome, Outcome::Near(_)));
        match (outcome, reason) {
            (Outcome::Near(near), None) => println!("{name}: {near}"),
            (Outcome::Nothing(why), None) => println!("{name}: {why}"),
            (Outcome::Wrong(why), None) => wrong.push(format!("{name}: {why}")),
            (Outcome::Wrong(why), Some(reason)) => println!("{name}: {why}; as listed: {reason}"),
            (_, Some(reason)) => wrong.push(format!("{name} is as ufbx has it, and listed: {reason}")),
        }
    }
    println!("{count} files were compared");
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
    assert!(count >= if shared.is_empty() { 1 } else { 60 }, "{count} files");
}

/// A file as both read it.
fn both(bytes: &[u8]) -> Result<(Model, SceneRoot), Outcome> {
    match (import(bytes), ufbx::load_memory(bytes, in_metres())) {
        (Ok(imported), Ok(scene)) => Ok((imported.model, scene)),
        (Err(_), Err(_)) => Err(Outcome::Nothing("both refuse it")),
        (Err(refused), Ok(_)) if refused.error.code == "fbx-version" => {
            Err(Outcome::Nothing("of a version that is not read here"))
        }
        (Err(refused), Ok(_)) => Err(Outcome::Wrong(format!("refused: {}", refused.error.message))),
        (Ok(_), Err(error)) => Err(Outcome::Wrong(format!(
            "ufbx does not read it: {}",
            &*error.description
        ))),
    }
}

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

/// What brings a vertex of a node's mesh into the world: its bones, by the four greatest weights, or the node.
fn world_from_vertex(node: &Node, mesh: &Mesh, index: usize) -> DAffine3 {
    let skin = mesh.skin_deformers.iter().next();
    if let Some(skin) = skin.filter(|skin| !skin.clusters.is_empty()) {
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
            let mut blended = [0.0; 12];
            for (weight, cluster) in weights {
                let columns = matrix(&skin.clusters[cluster as usize].geometry_to_world).to_cols_array();
                for (blended, number) in blended.iter_mut().zip(columns) {
                    *blended += number * weight / sum;
                }
            }
            return DAffine3::from_cols_array(&blended);
        }
    }
    matrix(&node.geometry_to_world)
}

/// Where the points of a node's mesh are that faces use.
fn points(scene: &Scene, node: &Node, mesh: &Mesh, out: &mut Vec<DVec3>) {
    let axes = axes(scene);
    let mut is_used = vec![false; mesh.num_vertices];
    for face in mesh.faces.iter().filter(|face| face.num_indices >= 3) {
        for corner in face.index_begin..face.index_begin + face.num_indices {
            is_used[mesh.vertex_indices[corner as usize] as usize] = true;
        }
    }
    for (index, position) in mesh.vertices.iter().enumerate().filter(|(index, _)| is_used[*index]) {
        let position = DVec3::new(position.x, position.y, position.z);
        out.push(axes * world_from_vertex(node, mesh, index).transform_point3(position));
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

/// Which of theirs each of ours may be: all that are so near at rest.
fn candidates(ours: &[DVec3], theirs: &[DVec3], within: f64) -> Vec<Vec<u32>> {
    let mut order: Vec<u32> = (0..theirs.len() as u32).collect();
    order.sort_by(|a, b| theirs[*a as usize].x.total_cmp(&theirs[*b as usize].x));
    let near = |point: &DVec3| {
        let start = order.partition_point(|&index| theirs[index as usize].x < point.x - within);
        order[start..]
            .iter()
            .copied()
            .take_while(|&index| theirs[index as usize].x <= point.x + within)
            .filter(|&index| theirs[index as usize].distance(*point) <= within)
            .collect()
    };
    ours.iter().map(near).collect()
}

/// The greatest way from one of ours to the nearest of those that it may be, and from one of theirs to the nearest that may be it.
fn apart(ours: &[DVec3], theirs: &[DVec3], candidates: &[Vec<u32>]) -> f64 {
    let mut of_theirs = vec![f64::INFINITY; theirs.len()];
    let mut worst = 0f64;
    for (point, candidates) in ours.iter().zip(candidates) {
        let mut nearest = f64::INFINITY;
        for &index in candidates {
            let way = theirs[index as usize].distance(*point);
            nearest = nearest.min(way);
            of_theirs[index as usize] = of_theirs[index as usize].min(way);
        }
        worst = worst.max(nearest);
    }
    of_theirs.into_iter().fold(worst, f64::max)
}

fn size(points: &[DVec3]) -> f64 {
    let least = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let greatest = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    least.distance(greatest).max(1e-9)
}

/// The stacks with the clips that were made of them.
fn stacks<'a>(model: &'a Model, scene: &'a Scene) -> Result<Vec<(&'a AnimStack, Option<&'a Clip>)>, String> {
    let stacks: Vec<&AnimStack> = scene.anim_stacks.iter().map(|stack| &**stack).collect();
    let is_of = |clip: &Clip, stack: &AnimStack| *clip.name == *stack.element.name;
    if let Some(clip) = model
        .clips
        .iter()
        .find(|clip| !stacks.iter().any(|stack| is_of(clip, stack)))
    {
        return Err(format!("clip {} is of no stack", clip.name));
    }
    let with_clip = |stack: &'a AnimStack| (stack, model.clips.iter().find(|clip| is_of(clip, stack)));
    Ok(stacks.into_iter().map(with_clip).collect())
}

/// When a stack is compared: in its clip's span where it has one, else in its own.
fn times(stack: &AnimStack, clip: Option<&Clip>) -> [f32; PARTS.len()] {
    let [start, end] = span(stack, clip);
    PARTS.map(|part| (start + (end - start) * part) as f32)
}

fn span(stack: &AnimStack, clip: Option<&Clip>) -> [f64; 2] {
    clip.map_or([stack.time_begin, stack.time_end], |clip| {
        [clip.start_secs, clip.end_secs].map(f64::from)
    })
}

fn evaluated(scene: &Scene, stack: &AnimStack, secs: f64) -> SceneRoot {
    ufbx::evaluate_scene(scene, &stack.anim, secs, EvaluateOpts::default()).expect("it is evaluated")
}

/// What a stack's distances are parts of: the size at rest, or that of the way where the file goes far.
fn measure(name: &str, (stack, clip): (&AnimStack, Option<&Clip>), scene: &Scene, rest: f64) -> f64 {
    if !FAR.iter().any(|start| name.starts_with(start)) {
        return rest;
    }
    let [start, end] = span(stack, clip);
    let way = (0..=64).flat_map(|step| {
        let secs = start + (end - start) * f64::from(step) / 64.0;
        all_points(&evaluated(scene, stack, secs))
    });
    size(&way.collect::<Vec<_>>()).max(rest)
}

/// A stack in the printout.
fn told(stack: &AnimStack, clip: Option<&Clip>, of_rest: f64) -> String {
    let missing = if clip.is_none() { " (no clip)" } else { "" };
    let far = if of_rest > 1.0 {
        format!(" of its way, {of_rest:.0} times the size,")
    } else {
        String::new()
    };
    format!("{}{missing}{far}", &*stack.element.name)
}

/// How far the points of a file are off at rest and in each clip, as a part of the model's size at rest, or of its way.
fn compare(name: &str, model: &Model, scene: &Scene) -> Outcome {
    let theirs = all_points(scene);
    match [theirs.len(), model.mesh.positions.len()] {
        [0, 0] => return Outcome::Nothing("no points"),
        [0, _] | [_, 0] => {
            return Outcome::Wrong(format!("{} points, not {}", model.mesh.positions.len(), theirs.len()));
        }
        _ => (),
    }
    let rest_size = size(&theirs);
    let rest = ours(model, None);
    let candidates = candidates(&rest, &theirs, 20.0 * TOLERANCE * rest_size);
    let mut off = vec![("rest".to_owned(), apart(&rest, &theirs, &candidates) / rest_size)];
    let stacks = match stacks(model, scene) {
        Ok(stacks) => stacks,
        Err(why) => return Outcome::Wrong(why),
    };
    for (stack, clip) in stacks {
        let compiled = clip.map(CompiledClip::new);
        let apart = |secs: f32| {
            let posed = all_points(&evaluated(scene, stack, f64::from(secs)));
            // What moves nothing is no clip.
            apart(
                &ours(model, compiled.as_ref().map(|clip| (clip, secs))),
                &posed,
                &candidates,
            )
        };
        let worst = times(stack, clip).map(apart).into_iter().fold(0.0, f64::max);
        let measure = measure(name, (stack, clip), scene, rest_size);
        let is_far = worst > TOLERANCE * rest_size && measure > LEAST_WAY * rest_size;
        assert!(
            measure == rest_size || is_far,
            "{name} does not go far, or needs no other measure"
        );
        off.push((told(stack, clip, measure / rest_size), worst / measure));
    }
    let listed: Vec<String> = off.iter().map(|(clip, off)| format!("{clip} {off:.1e}")).collect();
    let listed = format!("of {rest_size:.2e} m at rest: {}", listed.join(", "));
    match off.iter().all(|(_, off)| *off <= TOLERANCE) {
        true => Outcome::Near(listed),
        false => Outcome::Wrong(listed),
    }
}

#[test]
fn vertices_are_where_ufbx_has_them() {
    compare_all(OTHER_POINTS, compare);
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
