//! glTF 2.0, as `.glb` or as `.gltf` with its data in place or beside it.
//!
//! The scene that the file shows first becomes one model: right-handed, y up, facing +z, one skeleton of all nodes that move
//! something, one mesh of all primitives. What was mended comes back as diagnostics; what names something that is not there, or
//! reaches beyond its data, ends the reading.
//!
//! The file's names of nodes are the names of the joints until a person gives others.

mod clips;
mod images;
mod influences;
mod layers;
mod left_out;
mod materials;
mod meshes;
mod nodes;
pub(super) mod places;
mod skeleton;
mod vertices;

use self::images::Images;
use self::meshes::{Meshed, Primitives};
use self::places::Places;
use super::{Imported, Refused, Source};
use crate::diagnostic::collect::{Diagnostics, Place};
use crate::diagnostic::{Diagnostic, Position, Severity, codes};
use crate::gltf::{self, Buffers, Container, Fault, FindFile, Reader, Root, Uri};
use crate::model::{Front, Handedness, Model, UpAxis};
use crate::slices::{Slices, Stage};
use crate::sorting;

pub(super) use crate::gltf::begins_like_gltf as begins_like_model;

pub(super) async fn import(bytes: &[u8], find: FindFile<'_>, slices: &Slices) -> Result<Imported, Box<Refused>> {
    let mut diagnostics = Vec::new();
    slices.pause_at(Stage::Reading, 0, 1).await;
    let read = read(bytes, find, &mut diagnostics, slices).await;
    let placed = |diagnostic: Diagnostic| placed(diagnostic, bytes);
    let diagnostics = diagnostics.into_iter().map(placed).collect();
    match read {
        Ok(imported) => Ok(Imported {
            diagnostics,
            ..imported
        }),
        Err(error) => Err(Box::new(Refused {
            error: placed(*error),
            diagnostics,
        })),
    }
}

/// The same with line and column, where the file is text and only a pointer is known.
fn placed(diagnostic: Diagnostic, bytes: &[u8]) -> Diagnostic {
    let pointer = diagnostic.pointer.as_deref().filter(|_| diagnostic.position.is_none());
    let position = match gltf::open(bytes, &mut Vec::new()) {
        Ok(container) if !container.is_binary => {
            let found = pointer.and_then(|pointer| gltf::position_of(container.json, pointer));
            // A mark of the encoding stands before the first line.
            let mark = |line| if line == 1 { container.json_offset as u32 } else { 0 };
            found.map(|Position { line, column }| Position {
                line,
                column: column + mark(line),
            })
        }
        _ => None,
    };
    Diagnostic {
        places: position.into_iter().chain(diagnostic.places).collect(),
        position: position.or(diagnostic.position),
        ..diagnostic
    }
}

/// Whether it has animations, and no mesh.
pub(super) fn is_motion(bytes: &[u8]) -> bool {
    let container = gltf::open(bytes, &mut Vec::new());
    let has = |json: &[u8], key: &str| memchr::memmem::find(json, key.as_bytes()).is_some();
    container.is_ok_and(|container| has(container.json, "\"animations\"") && !has(container.json, "\"meshes\""))
}

/// The paths of the files beside a glTF file that it names, percent-decoded; none for a file that cannot be read.
pub(super) fn files_beside(bytes: &[u8]) -> Vec<String> {
    let mut diagnostics = Vec::new();
    let root = gltf::open(bytes, &mut diagnostics).and_then(|container| gltf::parse(&container));
    let Ok(root) = root else { return Vec::new() };
    let buffers = root.buffers().iter().filter_map(|buffer| buffer.uri.as_deref());
    let images = root.images().iter().filter_map(|image| image.uri.as_deref());
    let mut paths: Vec<String> = buffers
        .chain(images)
        .filter_map(|uri| match Uri::parse(uri) {
            Ok(Uri::Path(path)) => Some(path),
            _ => None,
        })
        .collect();
    sorting::sort(&mut paths);
    paths.dedup();
    paths
}

async fn read(
    bytes: &[u8],
    find: FindFile<'_>,
    diagnostics: &mut Vec<Diagnostic>,
    slices: &Slices,
) -> Result<Imported, Fault> {
    let container = gltf::open(bytes, diagnostics)?;
    let root = gltf::parse(&container)?;
    gltf::check_asset(&root, diagnostics)?;
    slices.pause_at(Stage::Building, 0, 1).await;
    let buffers = Buffers::new(&root, &container, find);
    let mut noted = Diagnostics::default();
    let read = model(&root, &buffers, &container, find, &mut noted, slices).await;
    if read.is_ok() {
        gltf::note_broken_rules(&root, &mut noted);
    }
    diagnostics.extend(noted.into_vec());
    let (model, images, places) = read.map_err(|fault| match buffers.first_missing() {
        Some(missing) if fault.code == missing.code => missing,
        _ => fault,
    })?;
    // What the model needs of them was there.
    diagnostics.extend(buffers.faults().map(|fault| Diagnostic {
        severity: Severity::Warning,
        ..Diagnostic::clone(fault)
    }));
    Ok(Imported {
        model,
        diagnostics: Vec::new(),
        pictures: images.pictures,
        source: Source::gltf(container.is_binary, places),
    })
}

async fn model(
    root: &Root,
    buffers: &Buffers<'_>,
    container: &Container<'_>,
    find: FindFile<'_>,
    diagnostics: &mut Diagnostics,
    slices: &Slices,
) -> Result<(Model, Images, Places), Fault> {
    let reader = Reader::new(root, buffers, container.json.len() as u64);
    let mut scene = nodes::scene(root, diagnostics)?;
    let images = Images::read(root, &reader, find, diagnostics)?;
    let mut materials = materials::materials(root, &images, diagnostics)?;
    skeleton::find_meshes(root, &mut scene, diagnostics)?;
    let rig = skeleton::rig(root, &reader, &mut scene, diagnostics)?;
    let source = Primitives {
        root,
        reader: &reader,
        scene: &scene,
        rig: &rig,
        second_tex_coords: materials::take_second_tex_coords(&materials),
        normal_maps: materials::have_normal_maps(&materials),
    };
    let Meshed { mesh, objects, places } = meshes::mesh(&source, diagnostics, slices).await?;
    // The last one is for primitives without any.
    if !mesh
        .submeshes
        .iter()
        .any(|submesh| submesh.material as usize == root.materials().len())
    {
        materials.pop();
    }
    let (clips, animations) = clips::clips(root, &reader, &rig, diagnostics, slices).await?;
    left_out::note(root, &scene, &rig, &objects, source.second_tex_coords, diagnostics);
    if mesh.positions.is_empty() && rig.skeleton.joint_count() == 0 {
        let message = codes::GLTF_EMPTY.sentence.to_owned();
        diagnostics.add(&codes::GLTF_EMPTY, Place::default(), message);
    }
    let places = Places::of(root, &rig, (places, animations), reader.effort());
    let model = Model {
        materials,
        mesh,
        objects: objects.into_iter().map(|(_, object)| object).collect(),
        skeleton: rig.skeleton,
        clips,
        handedness: Handedness::Right,
        up_axis: UpAxis::Y,
        front: Front::Positive,
        copyright: root.asset.as_ref().and_then(|asset| asset.copyright.clone()),
    };
    let model = model.checked()?;
    Ok((model, images, places))
}
