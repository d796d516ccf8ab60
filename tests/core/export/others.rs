//! Files for the programs of others: `tests/browser/exported.js` gives them to Khronos' validator and to three.js.

use std::fs;
use std::path::{Path, PathBuf};

use bindpose::anim::{CompiledClip, PoseBuffers, skin_positions};
use bindpose::check::book::{Book, Known, verdict};
use bindpose::edit::{Edits, apply};
use bindpose::export::{MapImages, glb, m3d};
use bindpose::format::{Dialect, LineMap};
use bindpose::import::import;
use bindpose::import::m3d::from_document;
use bindpose::model::{Clip, JointNames, MapSlot, Model, world_from_model};
use bindpose::session::{File, Maps};
use glam::{Mat4, Vec3};
use proptest::strategy::{Strategy as _, ValueTree as _};
use proptest::test_runner::TestRunner;
use serde_json::json;

use super::both_ways::characters;
use super::glb::models;
use crate::documents::{REAL_FILES, figure, real_file, shared_bytes};
use crate::format::written_documents;
use crate::gltf::{banner, four_objects, four_still_objects};
use crate::gltf_files::glb as glb_file;
use crate::shared::shared;

/// Times of a clip at which positions are compared.
const TIMES: u8 = 20;

/// Vertices of a model that are compared, at most.
const MOST_VERTICES: usize = 400;

fn folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("exported");
    fs::create_dir_all(&folder).expect("the folder can be made");
    folder
}

fn write(name: &str, model: &Model, maps: &Maps) {
    let images = images(maps);
    let exported = glb(model, &JointNames::default(), &images).expect("it can be written");
    fs::write(folder().join(format!("{name}.glb")), exported.bytes).expect("the file can be written");
}

/// The decoded maps, by who uses them.
fn images(maps: &Maps) -> MapImages<'_> {
    let by_material = maps.images().enumerate();
    by_material
        .flat_map(|(material, images)| {
            let slots = MapSlot::ALL.into_iter().zip(images);
            slots.filter_map(move |(slot, image)| Some(((material, slot), &**image?)))
        })
        .collect()
}

/// Positions of some triangles' first corners at some times of each clip, in glTF's space. A triangle is told by its primitive and its place
/// there: a primitive may have vertices of its own.
fn posed(model: &Model) -> serde_json::Value {
    let gltf_from_model = world_from_model(model.handedness, model.up_axis, model.front);
    let in_gltf = |position: Vec3| (gltf_from_model.transform_point3(position) * Vec3::new(1.0, 1.0, -1.0)).to_array();
    let drawn = model.mesh.submeshes.iter().filter(|submesh| submesh.triangle_count > 0);
    let all = drawn.enumerate().flat_map(|(primitive, submesh)| {
        let triangles = submesh.triangle_start as usize..(submesh.triangle_start + submesh.triangle_count) as usize;
        let place = move |(place, triangle): (usize, usize)| ([primitive, place], triangle);
        triangles.enumerate().map(place)
    });
    let all: Vec<_> = all.collect();
    let step = all.len().div_ceil(MOST_VERTICES).max(1);
    let some = all.into_iter().step_by(step);
    let (triangles, vertices): (Vec<_>, Vec<_>) = some
        .map(|(place, triangle)| (place, model.mesh.indices[3 * triangle] as usize))
        .unzip();
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    let mut positions = Vec::new();
    let clips: Vec<_> = model
        .clips
        .iter()
        .map(|clip| {
            let compiled = CompiledClip::new(clip);
            let shift_secs = clip.start_secs.min(0.0);
            let poses: Vec<_> = (0..TIMES)
                .map(|step| {
                    let part = f32::from(step) / f32::from(TIMES - 1);
                    let time_secs = clip.start_secs + clip.duration_secs() * part;
                    pose.evaluate(&model.skeleton, &compiled, time_secs);
                    skin_positions(&model.mesh, &pose.palette, &mut positions);
                    let positions: Vec<_> = vertices.iter().map(|&vertex| in_gltf(positions[vertex])).collect();
                    json!({ "time_secs": time_secs - shift_secs, "positions": positions })
                })
                .collect();
            json!({ "name": clip.name, "poses": poses })
        })
        .collect();
    json!({
        "size": model.bind_bounds().size().length(),
        "triangles": triangles,
        "bones": model.skeleton.joint_count(),
        "clips": clips,
    })
}

#[test]
fn files_are_written_for_others() {
    let _ = fs::remove_dir_all(folder());
    write_models();
    write_with_maps();
    write_random();
    write_read_gltf();
    write_for_book();
}

/// All the project's own models and the real ones, with the positions that three.js is to find.
fn write_models() {
    let real = REAL_FILES
        .iter()
        .filter_map(|name| Some((name.replace('/', "-"), real_file(name)?)));
    let documents = real.chain([("figure".to_owned(), figure())]).map(|(name, parsed)| {
        let (model, _) = from_document(&parsed.document, &parsed.lines).expect("it is sound");
        (name, model)
    });
    for (name, model) in documents.chain(models()) {
        write(&name, &model, &Maps::default());
        let poses = folder().join(format!("{name}.json"));
        fs::write(poses, posed(&model).to_string()).expect("the file can be written");
    }
}

/// Models with their maps: PNG, and DDS of several kinds.
fn write_with_maps() {
    let sample = Path::new(env!("CARGO_MANIFEST_DIR")).join("web/sample");
    let soldier = real_file("d3d12/soldier").and_then(|parsed| Some((parsed, shared("textures/soldier")?)));
    for (name, (parsed, textures)) in [("figure", Some((figure(), sample))), ("soldier", soldier)]
        .into_iter()
        .filter_map(|(name, found)| Some((name, found?)))
    {
        let (model, _) = from_document(&parsed.document, &parsed.lines).expect("it is sound");
        let mut maps = Maps::default();
        let files = fs::read_dir(&textures).expect("the folder can be read");
        let pictures = files.filter_map(|entry| {
            let path = entry.expect("the folder can be read").path();
            let bytes = fs::read(&path).ok()?;
            Some(File::new(&path.to_string_lossy(), bytes)).filter(File::is_image)
        });
        maps.add(&model.materials, pictures);
        assert!(maps.images().flatten().flatten().count() > 3, "{name} has maps");
        write(&format!("{name}-with-maps"), &model, &maps);
    }
}

/// Random models, the same each time: any numbers, and characters, of which some are posed by three.js too.
fn write_random() {
    let mut runner = TestRunner::deterministic();
    for written in 0..40 {
        let document = characters().new_tree(&mut runner).expect("a document").current();
        let (model, _) = from_document(&document, &LineMap::default()).expect("it is sound");
        let name = format!("character-{written}");
        write(&name, &model, &Maps::default());
        if written < 10 {
            fs::write(folder().join(format!("{name}.json")), posed(&model).to_string())
                .expect("the file can be written");
        }
    }
    let mut written = 0;
    while written < 60 {
        let document = written_documents().new_tree(&mut runner).expect("a document").current();
        if let Ok((model, _)) = from_document(&document, &LineMap::default()) {
            write(&format!("random-{written}"), &model, &Maps::default());
            written += 1;
        }
    }
}

/// glTF files of others and the project's own, with what each is called and where it lies.
fn gltf_files() -> Vec<(&'static str, Vec<u8>)> {
    let real = ["CesiumMan", "Fox", "RiggedSimple", "RobotExpressive"];
    let real = real
        .into_iter()
        .filter_map(|name| Some((name, shared_bytes(&format!("gltf/models/{name}.glb"))?)));
    real.chain([("banner", banner().glb())]).collect()
}

/// What was read of glTF is written as glTF again, with its pictures.
fn write_read_gltf() {
    fs::write(folder().join("banner.glb"), banner().glb()).expect("the file can be written");
    for (name, file) in [("objects", four_objects()), ("still-objects", four_still_objects())] {
        let model = import(&file.glb()).expect("it makes a model").model;
        write(name, &model, &Maps::default());
        fs::write(folder().join(format!("{name}.json")), posed(&model).to_string()).expect("the file can be written");
    }
    for (name, bytes) in gltf_files() {
        let imported = import(&bytes).expect("it makes a model");
        let mut maps = Maps::default();
        let pictures = imported
            .pictures
            .iter()
            .map(|picture| File::new(&picture.name, &*picture.bytes));
        maps.add(&imported.model.materials, pictures);
        let name = format!("{name}-again");
        write(&name, &imported.model, &maps);
        // Without pictures, which need a browser to be read.
        let name = format!("{name}-bare");
        write(&name, &imported.model, &Maps::default());
        fs::write(
            folder().join(format!("{name}.json")),
            posed(&imported.model).to_string(),
        )
        .expect("the file can be written");
    }
}

/// Models that were brought to the books' demo, and the glTF that they were made of. three.js poses that one, and its vertices,
/// brought into the book's space, are where the book's palettes have them.
fn write_for_book() {
    let folder = folder().join("book");
    fs::create_dir_all(&folder).expect("the folder can be made");
    for (name, bytes) in gltf_files() {
        let source = import(&bytes).expect("it makes a model").model;
        let edits = Edits {
            for_book: true,
            ..Edits::default()
        };
        let edited = apply(source.clone(), &JointNames::default(), &edits)
            .expect("it has room")
            .model;
        let written = m3d(&edited, &JointNames::default(), Dialect::D3d12).expect("it can be written");
        for (book, dialect) in [(Book::D3d11, Dialect::D3d11), (Book::D3d12, Dialect::D3d12)] {
            let bytes = m3d(&edited, &JointNames::default(), dialect)
                .expect("it can be written")
                .bytes;
            let verdict = verdict(book, &bytes, &Known::default());
            assert!(
                verdict.reads() && verdict.trouble.is_none(),
                "{name} for {book:?}: {:?}",
                verdict.trouble
            );
        }
        let of_book = import(&written.bytes).expect("what was written is read").model;
        fs::write(folder.join(format!("{name}.glb")), without_pictures(&bytes)).expect("the file can be written");
        let poses = book_poses(&source, &edited, &of_book).to_string();
        fs::write(folder.join(format!("{name}.json")), poses).expect("the file can be written");
    }
}

/// Where the palettes of the books' file have some vertices, at every key of the source and between them, and the matrix that brings
/// glTF's space into that of the file: axes exchanged, and one scale.
fn book_poses(source: &Model, edited: &Model, of_book: &Model) -> serde_json::Value {
    let [source_size, size] = [source, edited].map(|model| model.bind_bounds().size().length());
    let world_from = |model: &Model| world_from_model(model.handedness, model.up_axis, model.front);
    let book_from_gltf = Mat4::from(world_from(edited).inverse() * world_from(source))
        * Mat4::from_scale(Vec3::splat(size / source_size));
    let vertices = telling_vertices(source);
    let mut pose = PoseBuffers::for_skeleton(&of_book.skeleton);
    let mut positions = Vec::new();
    let clips: Vec<_> = source
        .clips
        .iter()
        .zip(&of_book.clips)
        .map(|(clip, written)| {
            let compiled = CompiledClip::new(written);
            let poses: Vec<_> = keys_and_between(clip)
                .into_iter()
                .map(|secs| {
                    // Clips of the books begin at 0.
                    pose.evaluate(&of_book.skeleton, &compiled, secs - clip.start_secs);
                    skin_positions(&of_book.mesh, &pose.palette, &mut positions);
                    let positions: Vec<_> = vertices.iter().map(|&vertex| positions[vertex].to_array()).collect();
                    json!({ "time_secs": secs, "positions": positions })
                })
                .collect();
            json!({ "name": clip.name, "poses": poses })
        })
        .collect();
    assert_eq!(source.clips.len(), of_book.clips.len());
    json!({ "size": size, "vertices": vertices, "book_from_gltf": book_from_gltf.to_cols_array(), "clips": clips })
}

/// All key times of a clip, and times between them.
fn keys_and_between(clip: &Clip) -> Vec<f32> {
    let mut times: Vec<f32> = clip
        .tracks
        .iter()
        .flat_map(|track| track.times_secs())
        .copied()
        .collect();
    times.sort_by(f32::total_cmp);
    times.dedup();
    times.retain(|&secs| (clip.start_secs..=clip.end_secs).contains(&secs));
    let between = times.windows(2).map(|pair| pair[0] * 0.6 + pair[1] * 0.4);
    let between: Vec<f32> = between.collect();
    times.extend(between);
    times
}

/// For each joint the vertex that it moves most, so that no matrix of the palette goes unseen.
fn telling_vertices(model: &Model) -> Vec<usize> {
    let mut most = vec![(0.0, None); model.skeleton.joint_count()];
    for (vertex, influences) in model.mesh.influences.iter().enumerate() {
        for (&joint, &weight) in influences.joints.iter().zip(&influences.weights) {
            let most = &mut most[joint as usize];
            if weight > most.0 {
                *most = (weight, Some(vertex));
            }
        }
    }
    most.into_iter().filter_map(|(_, vertex)| vertex).collect()
}

/// The file without what three.js needs a browser for, and without morphs in motion, which are not read.
fn without_pictures(bytes: &[u8]) -> Vec<u8> {
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")) as usize;
    let (json, bin) = (&bytes[20..20 + word(12)], &bytes[28 + word(12)..]);
    let mut root: serde_json::Value = serde_json::from_slice(json).expect("it is JSON");
    let file = root.as_object_mut().expect("an object");
    for list in ["images", "textures", "samplers", "materials"] {
        file.remove(list);
    }
    for mesh in root["meshes"].as_array_mut().into_iter().flatten() {
        for primitive in mesh["primitives"].as_array_mut().into_iter().flatten() {
            primitive.as_object_mut().expect("an object").remove("material");
        }
    }
    for animation in root["animations"].as_array_mut().into_iter().flatten() {
        let channels = animation["channels"].as_array_mut().expect("a list");
        channels.retain(|channel| channel["target"]["path"] != "weights");
    }
    let mut json = root.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    glb_file(&[(b"JSON", &json), (b"BIN\0", bin)])
}
