//! FBX, binary or as text: what its objects mean ([`crate::fbx`] reads the file).
//!
//! All of the scene becomes one model: right-handed, y up, in metres. Nodes get the transform that FBX computes of twelve parts; geometries become
//! triangles over vertices that differ in something; skins, joints and meshes go through the one [`scene`](super::scene). What was mended or left out comes
//! back as diagnostics.

mod clips;
mod curves;
mod ears;
mod file;
mod geometry;
mod images;
mod left_out;
mod materials;
mod meshes;
mod nodes;
mod objects;
pub(super) mod places;
mod settings;
mod skins;
mod transform;

use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet, HashMap};

use glam::DAffine3;

use self::clips::Stack;
use self::file::{File, in_object};
use self::images::Images;
use self::materials::Materials;
use self::meshes::Meshes;
use self::nodes::Nodes;
use self::objects::{ObjectIndex, Objects};
use self::places::Places;
use self::settings::Settings;
use super::scene::Rig;
use super::{Imported, Refused, Source};
use crate::diagnostic::collect::Diagnostics;
use crate::diagnostic::{Diagnostic, Fault, codes};
use crate::fbx::{self, Budget};
use crate::gltf::FindFile;
use crate::model::{Aabb, Front, Handedness, Model, Skeleton, UpAxis};
use crate::slices::{Slices, Stage};

pub(super) use crate::fbx::begins_like_fbx as begins_like_model;

pub(super) async fn import(bytes: &[u8], find: FindFile<'_>, slices: &Slices) -> Result<Imported, Box<Refused>> {
    slices.pause_at(Stage::Reading, 0, 1).await;
    let refused = |error: Fault, diagnostics: Vec<Diagnostic>| {
        Box::new(Refused {
            error: *error,
            diagnostics,
        })
    };
    let document = fbx::parse_in(bytes, slices)
        .await
        .map_err(|error| refused(error, Vec::new()))?;
    slices.pause_at(Stage::Building, 0, 1).await;
    let mut file = File {
        document: &document,
        budget: Budget::of_file(bytes.len()),
        settings: Settings::of(&document),
        // A key takes four bytes or more, and is asked for by some dozen evaluations of its channel.
        evaluations_left: Cell::new(8_000_000 + 16 * bytes.len() as u64),
        ear_tests_left: Cell::new(8_000_000 + 16 * bytes.len() as u64),
        bind_pose: HashMap::new(),
        disagreeing: BTreeSet::new(),
        noted: Vec::new(),
        told: BTreeMap::new(),
    };
    let mut diagnostics = Diagnostics::default();
    let read = model(&mut file, find, &mut diagnostics, slices).await;
    file.note_rest();
    let mut noted = file.noted;
    noted.extend(diagnostics.into_vec());
    match read {
        Ok((model, images, places)) => Ok(Imported {
            model,
            diagnostics: noted,
            pictures: images.pictures,
            source: Source::fbx(document.is_binary, places),
        }),
        Err(error) => Err(refused(error, noted)),
    }
}

/// Whether it has curves of bones, and no polygon. Names of records are never compressed, so that a search for their bytes finds them.
pub(super) fn is_motion(bytes: &[u8]) -> bool {
    let has = |name: &str| memchr::memmem::find(bytes, name.as_bytes()).is_some();
    (has("AnimationCurveNode") || has("KeyCount")) && !has("PolygonVertexIndex")
}

/// The paths of pictures beside a file that it names; none for a file that cannot be read.
pub(super) fn files_beside(bytes: &[u8]) -> Vec<String> {
    let document = fbx::parse(bytes);
    document.map_or_else(|_| Vec::new(), |document| images::beside(&Objects::of(&document)))
}

async fn model(
    file: &mut File<'_, '_>,
    find: FindFile<'_>,
    diagnostics: &mut Diagnostics,
    slices: &Slices,
) -> Result<(Model, Images, Places), Fault> {
    let objects = Objects::of(file.document);
    file.bind_pose = bind_pose(file, &objects)?;
    let mut nodes = Nodes::of(file.settings, &objects);
    let images = Images::read(&objects, find);
    let mut materials = Materials::read(file, &objects, &images);
    let stacks = Stack::all(file, &objects, &nodes)?;
    let uneven = clips::uneven(&stacks, &nodes, &file.evaluations_left);
    nodes.build_scene(&objects, &uneven);
    clips::mark_moved(&stacks, &mut nodes);
    let meshes = Meshes::read(file, &objects, &mut nodes, slices).await?;
    let rig = Rig::new(&nodes.scene)?;
    check_count(&rig)?;
    let meshed = meshes
        .mesh(&nodes, (&objects, &materials), &rig, diagnostics, slices)
        .await?;
    let size = size(&meshed.mesh.positions, &rig.skeleton);
    let (clips, of_clips) = clips::clips(file, &nodes, &stacks, &rig, size, slices).await?;
    left_out::note(file, &objects, &nodes);
    if meshed.mesh.positions.is_empty() && rig.skeleton.joint_count() == 0 {
        file.note(&codes::FBX_EMPTY, codes::FBX_EMPTY.sentence.to_owned());
    }
    // The last one is for what has none.
    let last = materials.objects.len();
    if !meshed
        .mesh
        .submeshes
        .iter()
        .any(|submesh| submesh.material as usize == last)
    {
        materials.materials.pop();
    }
    let of_materials = materials
        .objects
        .iter()
        .map(|&index| objects.get(index).record.place)
        .collect();
    let places = Places::of(&objects, &nodes, &rig, [of_materials, meshed.places, of_clips]);
    let model = Model {
        materials: materials.materials,
        mesh: meshed.mesh,
        objects: meshed.objects.into_iter().map(|(_, object)| object).collect(),
        skeleton: rig.skeleton,
        clips,
        handedness: Handedness::Right,
        up_axis: UpAxis::Y,
        front: Front::Positive,
        copyright: None,
    };
    let model = model.checked()?;
    Ok((model, images, places))
}

/// Where the poses for binding have their nodes.
fn bind_pose(file: &File<'_, '_>, objects: &Objects<'_, '_>) -> Result<HashMap<ObjectIndex, DAffine3>, Fault> {
    let mut posed = HashMap::new();
    for (_, pose) in objects.of_class("Pose") {
        for node in pose.record.all("PoseNode") {
            let object = node.find("Node").and_then(|named| objects.by_key(named, 0));
            let name = object.map_or(&pose.name, |object| &objects.get(object).name);
            let matrix = skins::matrix(node, "Matrix", file).map_err(in_object(name))?;
            posed.extend(object.zip(matrix));
        }
    }
    Ok(posed)
}

/// Refuses more joints than a vertex can name.
fn check_count(rig: &Rig) -> Result<(), Fault> {
    let (joints, most) = (rig.skeleton.joint_count(), Skeleton::MOST_NAMED);
    if joints <= most {
        return Ok(());
    }
    let message = format!("The skeleton has {joints} joints; vertices can name {most} at most.");
    Err(Box::new(codes::FBX_DAMAGED.says(message)))
}

/// The diagonal of what there is: vertices, or joints.
fn size(positions: &[glam::Vec3], skeleton: &Skeleton) -> f64 {
    let joints = skeleton
        .bind_model_from_joint()
        .iter()
        .map(|joint| joint.translation.into());
    let bounds = match positions {
        [] => Aabb::from_points(joints),
        positions => Aabb::from_points(positions.iter().copied()),
    };
    let size = f64::from(bounds.size().length());
    if size > 0.0 && size.is_finite() { size } else { 1.0 }
}
