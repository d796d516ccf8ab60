//! Files for the programs of others: `tests/browser/exported.js` gives them to Khronos' validator and to three.js.

use std::fs;
use std::path::{Path, PathBuf};

use bindpose::anim::{CompiledClip, PoseBuffers, skin_positions};
use bindpose::export::{MapImages, glb};
use bindpose::format::LineMap;
use bindpose::import::m3d::from_document;
use bindpose::model::{JointNames, MapSlot, Model, world_from_model};
use bindpose::session::{File, Maps};
use glam::Vec3;
use proptest::strategy::{Strategy as _, ValueTree as _};
use proptest::test_runner::TestRunner;
use serde_json::json;

use super::glb::models;
use crate::documents::{REAL_FILES, figure, real_file};
use crate::format::written_documents;
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

/// Positions of some vertices at some times of each clip, in glTF's space.
fn posed(model: &Model) -> serde_json::Value {
    let gltf_from_model = world_from_model(model.handedness, model.up_axis, model.front);
    let in_gltf = |position: Vec3| (gltf_from_model.transform_point3(position) * Vec3::new(1.0, 1.0, -1.0)).to_array();
    let step = model.mesh.vertex_count().div_ceil(MOST_VERTICES).max(1);
    let vertices: Vec<usize> = (0..model.mesh.vertex_count()).step_by(step).collect();
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
        "vertices": vertices,
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

/// Random models, the same each time.
fn write_random() {
    let mut runner = TestRunner::deterministic();
    let mut written = 0;
    while written < 60 {
        let document = written_documents().new_tree(&mut runner).expect("a document").current();
        if let Ok((model, _)) = from_document(&document, &LineMap::default()) {
            write(&format!("random-{written}"), &model, &Maps::default());
            written += 1;
        }
    }
}
