//! Exporting what is open: what is known before, the file, and its slices.

use std::io::{Cursor, Read as _};

use bindpose::edit::{self, Edits};
use bindpose::export;
use bindpose::format::Dialect;
use bindpose::image::encode_png;
use bindpose::import::import;
use bindpose::model::{Handedness, JointNames, MapSlot, UpAxis};
use bindpose::session::{
    Command, ExportCommand, ExportFormat, ExportOptions, ExportRange, ExportedFile, File, FileCommand, HistoryCommand,
    LookCommand, MaterialCommand, NameCommand, PlayCommand, Session,
};
use bindpose::slices::{Sliced, Slices, Stage};

use image::{ImageFormat, Rgb, RgbImage};
use serde_json::json;

use super::models::{document, file, moving, skinned, still};
use super::{dropped, opened};
use crate::gltf_files::Gltf;
use crate::rigs;

fn options(format: ExportFormat) -> ExportOptions {
    ExportOptions {
        format,
        ..ExportOptions::default()
    }
}

fn written(session: &Session, options: &ExportOptions) -> ExportedFile {
    let job = session.export_job(options).expect("a model is open");
    job.run().expect("it can be written")
}

fn plan(session: &mut Session, options: ExportOptions) {
    session.apply(ExportCommand::Plan(Some(Box::new(options))));
    while session.step_export() {}
}

fn only(clip: &str) -> Option<Vec<String>> {
    Some(vec![clip.to_owned()])
}

/// A box with a map of one red texel.
fn mapped() -> Session {
    let mut document = document();
    document.materials[0].diffuse_map = Some("coats/red.dds".to_owned());
    let png = encode_png(&[255, 0, 0, 255], 1, 1).expect("a picture");
    let mut session = Session::new(false);
    let files = vec![file("box.m3d", &document), File::new("somewhere/RED.png", png)];
    session.apply(FileCommand::Add(files));
    assert_eq!(session.maps().used().count(), 1);
    session
}

#[test]
fn a_glb_has_pictures_that_gltf_takes_as_they_are_and_others_as_png() {
    let mut document = document();
    document.materials[0].diffuse_map = Some("red.jpg".to_owned());
    let picture = RgbImage::from_pixel(8, 8, Rgb([200, 30, 10]));
    let mut jpeg = Cursor::new(Vec::new());
    picture.write_to(&mut jpeg, ImageFormat::Jpeg).expect("a picture");
    let jpeg = jpeg.into_inner();
    let mut tga = Cursor::new(Vec::new());
    picture.write_to(&mut tga, ImageFormat::Tga).expect("a picture");
    for (bytes, mime, is_kept) in [(jpeg, "image/jpeg", true), (tga.into_inner(), "image/png", false)] {
        let name = if is_kept { "red.jpg" } else { "red.tga" };
        let session = dropped(vec![file("box.m3d", &document), File::new(name, bytes.clone())]);
        let glb = written(&session, &options(ExportFormat::Glb)).bytes;
        let has = |part: &[u8]| glb.windows(part.len()).any(|window| window == part);
        assert!(has(mime.as_bytes()), "{name}");
        assert_eq!(has(&bytes), is_kept, "{name}");
    }
}

#[test]
fn a_job_writes_what_edits_and_formats_write_by_themselves() {
    let session = opened(moving("a.m3d"));
    let model = session.open_model().expect("a model").model.clone();
    let names = JointNames::default();
    let edits = Edits {
        clips: only("Turn"),
        range_secs: Some([0.75, 1.5]),
        close_loop_secs: Some(0.25),
        reduce: Some(0.01),
        ..Edits::default()
    };
    let asked = |format| ExportOptions {
        in_place: false,
        format,
        clips: only("Turn"),
        range: ExportRange::Secs([0.75, 1.5]),
        close_loop_secs: Some(0.25),
        reduce: Some(0.01),
        for_book: false,
    };
    let edited = edit::apply(model.clone(), &names, &edits).expect("it can be edited");
    let glb = export::glb(&edited.model, &edited.names, &export::MapImages::new()).expect("it can be written");
    let file = written(&session, &asked(ExportFormat::Glb));
    assert_eq!((file.name.as_str(), file.bytes), ("a.glb", glb.bytes));
    assert_eq!((file.plan.losses, file.plan.changes), (glb.losses, edited.changes));

    let edits = edits.in_space_of_the_books(&model);
    let edited = edit::apply(model, &names, &edits).expect("it can be edited");
    for (format, dialect) in [
        (ExportFormat::D3d12, Dialect::D3d12),
        (ExportFormat::D3d11, Dialect::D3d11),
    ] {
        let m3d = export::m3d(&edited.model, &edited.names, dialect).expect("it can be written");
        let file = written(&session, &asked(format));
        let name = format!("a-{}.m3d", format.name());
        assert_eq!((file.name, file.bytes), (name, m3d.bytes));
        assert_eq!(file.plan.losses, m3d.losses);
    }
}

#[test]
fn a_model_of_the_books_comes_out_as_it_went_in() {
    let session = opened(still("a.m3d"));
    let file = written(&session, &options(ExportFormat::D3d12));
    let again = opened(File::new("a.m3d", file.bytes));
    let [before, after] = [&session, &again].map(|session| &session.open_model().expect("a model").model);
    assert_eq!(format!("{before:?}"), format!("{after:?}"));
    assert_eq!(file.plan.changes, []);
}

#[test]
fn losses_and_changes_are_known_before_anything_is_written() {
    let mut session = opened(moving("a.m3d"));
    assert!(session.export().is_none(), "nobody asked");
    let asked = ExportOptions {
        clips: only("Bend"),
        ..options(ExportFormat::D3d11)
    };
    plan(&mut session, asked.clone());
    let export = session.export().expect("it is planned");
    assert_eq!((export.options, export.refusal, export.saving), (&asked, None, None));
    let plan = export.plan.expect("all is known").clone();
    assert_eq!(plan.changes[0].message, "2 clips are left out.");
    assert!(!plan.losses.is_empty(), "the D3D11 book has other materials");
    assert_eq!(session.take_exported(), None);
    assert_eq!(session.export_name().as_deref(), Some("a-d3d11.m3d"));

    session.apply(ExportCommand::Save);
    while session.step_export() {}
    let file = session.take_exported().expect("it was written");
    assert_eq!(file.plan, plan);
    assert_eq!(file, written(&session, &asked));
    let export = session.export().expect("it is planned anew");
    assert_eq!((export.plan, export.saving), (Some(&plan), None));
}

#[test]
fn a_plan_follows_what_is_open_and_asks_for_no_step_at_rest() {
    let mut session = opened(moving("a.m3d"));
    plan(&mut session, ExportOptions::default());
    assert!(!session.step_export(), "all is known");
    let changes = |session: &Session| {
        let export = session.export().expect("it is planned");
        let plan = export.plan.expect("all is known");
        plan.changes
            .iter()
            .map(|change| change.message.clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(changes(&session), [""; 0]);
    let mut material = session.materials()[0].clone();
    material.diffuse = [1.0, 0.0, 0.0];
    let material = Box::new(material);
    session.apply(MaterialCommand::Edit { index: 0, material });
    while session.step_export() {}
    assert_eq!(changes(&session), ["1 material is written as it was edited here."]);
    session.apply(PlayCommand::Seek { time_secs: 0.5 });
    assert!(!session.step_export(), "the time changes no file");
    session.apply(FileCommand::Add(vec![still("b.m3d")]));
    while session.step_export() {}
    assert_eq!(changes(&session), [""; 0]);
    assert_eq!(session.export_name().as_deref(), Some("b.glb"));
    session.apply(ExportCommand::Plan(None));
    assert!(session.export().is_none() && !session.step_export());
}

#[test]
fn what_was_edited_and_named_here_is_in_the_file() {
    let mut session = opened(moving("a.m3d"));
    let mut material = session.materials()[0].clone();
    material.diffuse = [1.0, 0.5, 0.25];
    let wanted = Box::new(material.clone());
    session.apply(MaterialCommand::Edit {
        index: 0,
        material: wanted,
    });
    session.apply(NameCommand::Rename {
        joint: bindpose::model::JointIndex(1),
        name: "Neck".to_owned(),
    });
    let again = opened(File::new(
        "a.m3d",
        written(&session, &options(ExportFormat::D3d12)).bytes,
    ));
    assert_eq!(again.materials()[0].diffuse, material.diffuse);
    let glb = written(&session, &options(ExportFormat::Glb));
    assert!(String::from_utf8_lossy(&glb.bytes).contains("\"Neck\""));
}

#[test]
fn the_range_is_the_timelines_where_its_clip_is_the_only_one() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::SetRangeStart(Some(0.25)));
    session.apply(PlayCommand::SetRangeEnd(Some(0.75)));
    let span = |clips, range| {
        let file = written(
            &session,
            &ExportOptions {
                clips,
                range,
                ..options(ExportFormat::D3d12)
            },
        );
        let again = opened(File::new("a.m3d", file.bytes));
        let clip = &again.open_model().expect("a model").model.clips[0];
        clip.duration_secs()
    };
    assert_eq!(span(only("Bend"), ExportRange::Timeline), 0.5);
    assert_eq!(span(only("Bend"), ExportRange::Whole), 1.0);
    assert_eq!(
        span(only("Turn"), ExportRange::Timeline),
        2.0,
        "the range is of another clip"
    );
    assert_eq!(span(None, ExportRange::Timeline), 1.0);
    assert_eq!(span(only("Turn"), ExportRange::Secs([1.0, 1.5])), 0.5);
}

#[test]
fn what_cannot_be_written_says_why_and_saves_nothing() {
    let mut session = opened(moving("a.m3d"));
    let asked = ExportOptions {
        close_loop_secs: Some(99.0),
        clips: only("Bend"),
        ..ExportOptions::default()
    };
    plan(&mut session, asked);
    let refusal = session.export().and_then(|export| export.refusal);
    assert_eq!(
        refusal,
        Some("\"Bend\" is 1 s long; its end cannot be eased over 99 s.")
    );
    session.apply(ExportCommand::Save);
    while session.step_export() {}
    assert_eq!(session.take_exported(), None);
    assert_eq!(session.export().expect("it is planned").saving, None);
}

#[test]
fn it_goes_in_slices_and_can_be_dropped_between_two() {
    let mut session = mapped();
    let asked = options(ExportFormat::D3d12);
    let at_once = written(&session, &asked);
    let job = session.export_job(&asked).expect("a model is open");
    let mut work = Sliced::new(&Slices::new(|| true), async move |slices| {
        job.plan(&slices).await?.write(&slices).await
    });
    let mut told = Vec::new();
    let file = loop {
        match work.advance() {
            None => told.push(work.progress()),
            Some(file) => break file.expect("it can be written"),
        }
    };
    assert_eq!(file, at_once);
    let mut stages: Vec<_> = told.iter().map(|told| told.stage).collect();
    stages.dedup();
    assert_eq!(stages, [Stage::Editing, Stage::Writing, Stage::Packing]);
    assert!(told.is_sorted_by_key(|told| told.percent()), "{told:?}");

    plan(&mut session, asked);
    session.apply(ExportCommand::Save);
    assert!(session.step_export());
    assert!(session.export().expect("it is written").saving.is_some());
    session.apply(ExportCommand::Cancel);
    while session.step_export() {}
    assert_eq!(session.take_exported(), None);
    assert_eq!(
        session
            .export()
            .expect("it is still planned")
            .plan
            .map(|plan| plan.maps),
        Some(1)
    );
}

#[test]
fn another_model_ends_what_is_written_of_the_one_before() {
    let mut session = mapped();
    plan(&mut session, options(ExportFormat::D3d12));
    session.apply(ExportCommand::Save);
    assert!(session.step_export());
    session.apply(FileCommand::Add(vec![still("b.m3d")]));
    while session.step_export() {}
    assert_eq!(session.take_exported(), None);
}

#[test]
fn pictures_come_along_with_a_file_of_the_books_and_are_inside_a_glb() {
    let session = mapped();
    let file = written(&session, &options(ExportFormat::D3d12));
    assert_eq!(
        (file.name.as_str(), file.plan.maps, file.media_type()),
        ("box-d3d12.zip", 1, "application/zip")
    );
    let again = written(&session, &options(ExportFormat::D3d12));
    assert_eq!(file, again, "the time of day is not in it");
    let mut archive = zip::ZipArchive::new(Cursor::new(file.bytes)).expect("a sound archive");
    let mut files = Vec::new();
    for index in 0..archive.len() {
        let mut entry = archive.by_index(index).expect("an entry");
        let mut bytes = Vec::new();
        entry.read_to_end(&mut bytes).expect("sound bytes");
        files.push(File::new(&entry.name().expect("a name in UTF-8"), bytes));
    }
    let names: Vec<&str> = files.iter().map(|file| file.path.as_str()).collect();
    assert_eq!(names, ["box-d3d12.m3d", "red.png"]);
    let reopened = dropped(files);
    assert_eq!(reopened.maps().used().count(), 1, "the picture is found by its name");

    let glb = written(&session, &options(ExportFormat::Glb));
    assert_eq!(
        (glb.name.as_str(), glb.plan.maps, glb.media_type()),
        ("box.glb", 0, "model/gltf-binary")
    );
    assert!(glb.bytes.windows(4).any(|bytes| bytes == b"\x89PNG"));
}

#[test]
fn for_the_books_demo_all_maps_come_along_as_dds_with_mips() {
    let mut document = document();
    document.materials[0].diffuse_map = Some("coats/red.dds".to_owned());
    let texels = [255, 0, 0, 255].repeat(4 * 4);
    let png = encode_png(&texels, 4, 4).expect("a picture");
    let mut session = dropped(vec![file("box.m3d", &document), File::new("RED.png", png)]);
    let asked = ExportOptions {
        for_book: true,
        ..options(ExportFormat::D3d12)
    };
    plan(&mut session, asked.clone());
    let told = session.export().expect("it is planned").plan.expect("all is known");
    let codes: Vec<_> = told.changes.iter().map(|change| change.code).collect();
    assert!(
        codes.contains(&"maps-written") && codes.contains(&"maps-added"),
        "{codes:?}"
    );
    assert_eq!(session.export_name().as_deref(), Some("box-d3d12.zip"));
    let job = session.export_job(&asked).expect("a model is open");
    let written = job.run_apart().expect("it can be written");
    let names: Vec<&str> = written.maps.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(
        (names.as_slice(), told.maps),
        (["red.dds", "flat_normal.dds"].as_slice(), 2)
    );
    for (name, bytes) in &written.maps {
        let picture = bindpose::image::decode(bytes, name).expect("a picture");
        assert_eq!((picture.file_level_count(), picture.width()), (3, 4), "{name}");
    }
    let again = opened(File::new("box.m3d", written.bytes));
    let material = &again.materials()[0];
    let map = |slot| material.map_name(slot);
    assert_eq!(map(MapSlot::Diffuse), Some("red.dds"));
    assert_eq!(map(MapSlot::Normal), Some("flat_normal.dds"));
}

#[test]
fn what_was_mended_on_reading_is_a_change() {
    let mut document = document();
    document.clips.clear();
    document.vertices[0].normal = [0.0; 3];
    let mut session = opened(file("a.m3d", &document));
    plan(&mut session, options(ExportFormat::D3d12));
    let plan = session.export().expect("it is planned").plan.expect("all is known");
    assert!(
        plan.changes.iter().any(|change| change.code == "normals-missing"),
        "{:?}",
        plan.changes
    );
}

#[test]
fn a_job_that_encodes_pictures_one_by_one_writes_the_same_glb() {
    let session = mapped();
    let model = &session.open_model().expect("a model").model;
    let mut images = export::MapImages::new();
    for (material, slots) in session.maps().images().enumerate() {
        for (slot, image) in MapSlot::ALL.into_iter().zip(slots) {
            images.extend(image.map(|image| ((material, slot), &**image)));
        }
    }
    assert_eq!(images.len(), 1);
    let whole = export::glb(model, &JointNames::default(), &images).expect("it can be written");
    assert_eq!(written(&session, &options(ExportFormat::Glb)).bytes, whole.bytes);
}

#[test]
fn what_was_left_out_on_reading_is_a_loss_and_no_change() {
    let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    let mut gltf = Gltf::new(&json!({ "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }] }));
    let attributes = json!({ "POSITION": gltf.floats(&positions) });
    gltf.json["meshes"] =
        json!([{ "primitives": [{ "attributes": attributes }, { "attributes": attributes, "mode": 0 }] }]);
    let session = opened(File::new("points.glb", gltf.glb()));
    for format in [ExportFormat::Glb, ExportFormat::D3d11] {
        let plan = written(&session, &options(format)).plan;
        let code = "gltf-primitive-left-out";
        let losses: Vec<_> = plan.losses.iter().filter(|loss| loss.code == code).collect();
        let [loss] = losses[..] else {
            panic!("one loss, not {losses:?}");
        };
        assert!(loss.message.contains("is of points") && loss.count == 1, "{loss:?}");
        assert!(plan.changes.iter().all(|change| change.code != code));
    }
}

/// The files of a drop that was exported: an archive opens as what is in it.
fn reopened(file: ExportedFile) -> Session {
    opened(File::new(&file.name, file.bytes))
}

/// Where green of the normal map's first texel leads on the surface of each vertex, as it is drawn.
fn drawn_green(session: &Session) -> Vec<f32> {
    let model = &session.open_model().expect("a model").model;
    let image = session.maps().image(0, MapSlot::Normal).expect("a normal map");
    let texel = image.to_rgba8(0, 0).expect("texels");
    let green = f32::from(texel[1]) / 127.5 - 1.0;
    let flip = if session.look().normal_green_flipped { -1.0 } else { 1.0 };
    let tangents = model.mesh.tangents.iter();
    tangents.map(|tangent| tangent.w * green * flip).collect()
}

#[test]
fn green_of_normal_maps_is_written_as_it_was_chosen() {
    let mut document = document();
    document.materials[0].normal_map = Some("bumps.png".to_owned());
    let bumps = encode_png(&[128, 200, 230, 255], 1, 1).expect("a picture");
    let mut session = dropped(vec![file("box.m3d", &document), File::new("bumps.png", bumps)]);
    let written_as = |session: &mut Session, format, flipped| {
        session.apply(LookCommand::SetNormalGreenFlipped(flipped));
        let file = written(session, &options(format));
        let told = file
            .plan
            .changes
            .iter()
            .any(|change| change.code == "normal-green-flipped");
        assert_eq!(told, flipped, "{format:?}");
        drawn_green(&reopened(file))
    };
    for format in [ExportFormat::Glb, ExportFormat::D3d12, ExportFormat::D3d11] {
        let [plain, flipped] = [false, true].map(|flipped| written_as(&mut session, format, flipped));
        let differ = |(plain, flipped): (&f32, &f32)| (plain + flipped).abs() < 0.01 && plain.abs() > 0.5;
        assert!(
            plain.iter().zip(&flipped).all(differ),
            "{format:?} {plain:?} {flipped:?}"
        );
        // glTF's space is mirrored.
        if format != ExportFormat::Glb {
            assert!(
                flipped
                    .iter()
                    .zip(drawn_green(&session))
                    .all(|(now, seen)| (now - seen).abs() < 0.01)
            );
        }
    }
    // The books' demo reads no sign, so the picture is turned for it and the sign is as before.
    let again = reopened(written(&session, &options(ExportFormat::D3d12)));
    let texel = again
        .maps()
        .image(0, MapSlot::Normal)
        .and_then(|image| image.to_rgba8(0, 0));
    assert_eq!(texel.map(|texel| texel[1]), Some(55));
}

#[test]
fn a_plan_is_made_anew_when_one_sees_the_model_otherwise() {
    let others: [Command; 3] = [
        Command::SetHandedness(Some(Handedness::Right)),
        Command::SetUpAxis(Some(UpAxis::Z)),
        LookCommand::SetNormalGreenFlipped(true).into(),
    ];
    for other in others {
        let mut session = opened(still("a.m3d"));
        let before = written(&session, &ExportOptions::default());
        session.apply(other.clone());
        plan(&mut session, ExportOptions::default());
        session.apply(HistoryCommand::Undo);
        assert!(session.step_export(), "{other:?}: there is another plan to make");
        session.apply(other.clone());
        plan(&mut session, ExportOptions::default());
        session.apply(HistoryCommand::Undo);
        while session.step_export() {}
        session.apply(ExportCommand::Save);
        while session.step_export() {}
        assert_eq!(session.take_exported(), Some(before), "{other:?}");
    }
}

#[test]
fn a_file_of_a_book_has_the_book_in_its_name_once() {
    let session = opened(still("a-d3d12.m3d"));
    for (format, name) in [
        (ExportFormat::D3d11, "a-d3d11.m3d"),
        (ExportFormat::D3d12, "a-d3d12.m3d"),
        (ExportFormat::Glb, "a-d3d12.glb"),
    ] {
        assert_eq!(written(&session, &options(format)).name, name);
    }
}

#[test]
fn what_is_told_of_one_clip_does_not_speak_of_others() {
    let names = ["A", "B", "C", "D", "E", "F", "Fine"];
    let mut document = skinned(&names.map(|name| (name, 0.0, 9)));
    for clip in document.clips.iter_mut().filter(|clip| clip.name != "Fine") {
        clip.bones[1].keyframes.reverse();
    }
    let session = opened(file("a.m3d", &document));
    let told = |clips: Option<&[&str]>| {
        let options = ExportOptions {
            clips: clips.map(|clips| clips.iter().map(|&name| name.to_owned()).collect()),
            ..options(ExportFormat::Glb)
        };
        let changes = written(&session, &options).plan.changes.into_iter();
        let of_keys: Vec<_> = changes.filter(|change| change.code == "keys-not-sorted").collect();
        assert!(of_keys.len() < 2, "{of_keys:?}");
        of_keys.first().map(|change| change.message.clone())
    };
    assert!(told(None).is_some_and(|words| words.ends_with("The same holds for 5 more clips.")));
    let one = told(Some(&["C"])).expect("its keys were sorted");
    assert!(!one.contains("more clips"), "{one}");
    assert!(told(Some(&["C", "D", "Fine"])).is_some_and(|words| words.ends_with("It is so in 2 clips.")));
    assert_eq!(told(Some(&["Fine"])), None);
}

/// A box with maps of these names in a `.gltf`, whose pictures are inside; damaged where they have no bytes.
fn with_pictures(pictures: &[(&str, Vec<u8>)]) -> Session {
    let mut file = Gltf::new(&json!({ "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }] }));
    let positions = file.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let tex_coords = file.floats(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    let primitive = |material: usize| {
        json!({
            "attributes": { "POSITION": positions, "TEXCOORD_0": tex_coords }, "material": material,
        })
    };
    file.json["meshes"] = json!([{ "primitives": (0..pictures.len()).map(primitive).collect::<Vec<_>>() }]);
    let numbers = 0..pictures.len();
    let material =
        |number| json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": number }, "metallicFactor": 0.0 } });
    file.json["materials"] = numbers.clone().map(material).collect();
    file.json["textures"] = numbers.map(|number| json!({ "source": number })).collect();
    let images: Vec<_> = pictures
        .iter()
        .map(|(name, bytes)| {
            let mime = if bytes.starts_with(b"\xFF\xD8") {
                "image/jpeg"
            } else {
                "image/png"
            };
            json!({ "bufferView": file.view(bytes, None), "mimeType": mime, "name": name })
        })
        .collect();
    file.json["images"] = json!(images);
    opened(File::new("box.glb", file.glb()))
}

fn red() -> Vec<u8> {
    encode_png(&[255, 0, 0, 255], 1, 1).expect("a picture")
}

fn for_book(format: ExportFormat) -> ExportOptions {
    ExportOptions {
        for_book: true,
        ..options(format)
    }
}

#[test]
fn names_of_pictures_become_names_that_every_system_takes() {
    let long = "ü".repeat(300);
    let names = [
        "nul",
        "CON.png",
        "a\0b",
        "c\u{1b}[2Jd",
        long.as_str(),
        "com1",
        "what?",
        "x<y>|z",
        "..",
        "Nul",
        "../../up",
        "lpt9.color",
    ];
    let mut blue = 0;
    let pictures = names.map(|name| {
        blue += 10;
        (name, encode_png(&[0, 0, blue, 255], 1, 1).expect("a picture"))
    });
    let session = with_pictures(&pictures);
    for asked in [options(ExportFormat::D3d12), for_book(ExportFormat::D3d12)] {
        let written = session.export_job(&asked).expect("a model is open").run_apart();
        let written = written.expect("it can be written");
        let text = String::from_utf8(written.bytes).expect("text");
        let found: Vec<&str> = written.maps.iter().map(|(name, _)| name.as_str()).collect();
        assert!(found.len() >= names.len(), "{found:?}");
        let mut seen = std::collections::HashSet::new();
        for name in found {
            let stem = name.split('.').next().expect("a first part").to_lowercase();
            let is_device = ["con", "prn", "aux", "nul"].contains(&stem.as_str())
                || (stem.len() == 4 && (stem.starts_with("com") || stem.starts_with("lpt")));
            assert!(!is_device, "{name}");
            assert!(name.len() <= 200 && !name.starts_with('.'), "{name}");
            assert!(
                !name.contains(|letter: char| letter.is_control() || "<>:\"|?*/\\".contains(letter)),
                "{name:?}"
            );
            assert!(seen.insert(name.to_lowercase()), "{name} is there twice");
            assert!(
                text.contains(&format!("DiffuseMap: {name}")) || name == "flat_normal.dds",
                "{name}"
            );
        }
        assert!(!text.contains(|letter: char| letter.is_control() && !"\r\n\t".contains(letter)));
    }
}

#[test]
fn a_damaged_picture_is_not_told_as_missing() {
    let session = with_pictures(&[("red", red()), ("torn", red()[..40].to_vec())]);
    for asked in [
        options(ExportFormat::Glb),
        options(ExportFormat::D3d12),
        for_book(ExportFormat::D3d12),
    ] {
        let job = session.export_job(&asked).expect("a model is open");
        let plan = job.run_apart().expect("it can be written").plan;
        let told: Vec<_> = plan.losses.iter().map(|loss| (loss.code, loss.count)).collect();
        assert!(told.contains(&("maps-unreadable", 1)), "{told:?}");
        let is_missing = |(code, _): &(&str, usize)| ["map-missing", "maps-missing"].contains(code);
        assert!(!told.iter().any(is_missing), "{told:?}");
    }
}

fn jpeg(picture: &image::DynamicImage) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Jpeg).expect("a picture");
    bytes.into_inner()
}

#[test]
fn only_a_jpeg_that_a_strict_reader_takes_goes_into_a_glb_as_it_is() {
    let color = jpeg(&RgbImage::from_pixel(8, 8, Rgb([200, 30, 10])).into());
    let grey = jpeg(&image::GrayImage::from_pixel(8, 8, image::Luma([90])).into());
    // Bytes between two segments, which decoders pass over.
    let mut stray = color.clone();
    stray.splice(20..20, [1, 2, 3]);
    // A comment is no harm.
    let mut commented = color.clone();
    commented.splice(2..2, [0xFF, 0xFE, 0, 4, b'h', b'i']);
    for (name, bytes, is_kept) in [
        ("color", color, true),
        ("grey", grey, true),
        ("commented", commented, true),
        ("stray", stray, false),
    ] {
        let session = with_pictures(&[(name, bytes.clone())]);
        assert_eq!(session.maps().used().count(), 1, "{name} can be decoded");
        let glb = written(&session, &options(ExportFormat::Glb)).bytes;
        let has = |wanted: &[u8]| glb.windows(wanted.len()).any(|window| window == wanted);
        assert_eq!(has(&bytes), is_kept, "{name}");
        assert_eq!(has(b"\x89PNG"), !is_kept, "{name}");
    }
}

/// The demo opens two maps for each material, and has plain ones of its own.
#[test]
fn without_pictures_the_demos_plain_maps_are_named() {
    let session = opened(file("box.m3d", &document()));
    let maps = bindpose::session::Maps::without_mips();
    let job = |format, for_book| {
        let model = session.open_model().expect("a model is open").model.clone();
        let what = bindpose::session::ToExport {
            model,
            names: &JointNames::default(),
            changes: Vec::new(),
            losses: Vec::new(),
            edits: Edits {
                for_book,
                ..Edits::default()
            },
            maps: &maps,
            format,
            writes_maps: false,
            turns_green: false,
        };
        bindpose::session::ExportJob::new("box", what)
            .run_apart()
            .expect("it can be written")
    };
    let written = job(ExportFormat::D3d12, true);
    let maps_in = |bytes: &[u8]| {
        let material = bindpose::format::parse(bytes)
            .expect("it is sound")
            .document
            .materials
            .remove(0);
        [material.diffuse_map, material.normal_map]
    };
    let plain_maps = ["white1x1.dds", "default_nmap.dds"].map(|name| Some(name.to_owned()));
    assert_eq!(maps_in(&written.bytes), plain_maps);
    assert!(written.plan.changes.iter().any(|change| change.code == "maps-added"));
    assert_eq!(written.maps, [], "they lie beside the demo");
    let reading = bindpose::check::book::read(
        bindpose::check::book::Book::D3d12,
        &written.bytes,
        &bindpose::check::book::Known::default(),
    );
    assert!(
        reading.document.vertices.iter().all(|vertex| vertex.tangent[3] < 0.0),
        "the sign that the demo takes all to have"
    );
    // The other demo has none; without the option nothing is named.
    let told = job(ExportFormat::D3d11, true).plan.losses;
    assert!(
        told.iter()
            .any(|loss| loss.code == "book-map-format" && loss.count == 2),
        "{told:?}"
    );
    assert_eq!(maps_in(&job(ExportFormat::D3d12, false).bytes), [None, None]);
}

#[test]
fn metalness_of_a_picture_comes_along_in_the_diffuse_map_and_is_told() {
    let mut file = Gltf::new(&json!({
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "materials": [{ "name": "Full", "pbrMetallicRoughness": { "metallicRoughnessTexture": { "index": 0 } } }],
        "textures": [{ "source": 0 }],
    }));
    let positions = file.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let tex_coords = file.floats(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    file.json["meshes"] = json!([{ "primitives": [{
        "attributes": { "POSITION": positions, "TEXCOORD_0": tex_coords }, "material": 0,
    }] }]);
    let texels = [[0, 128, 0, 255], [0, 128, 255, 255]];
    let png = encode_png(texels.as_flattened(), 2, 1).expect("a picture");
    let view = file.view(&png, None);
    file.json["images"] = json!([{ "bufferView": view, "mimeType": "image/png", "name": "shine" }]);
    let session = opened(File::new("box.glb", file.glb()));
    for (asked, name) in [
        (options(ExportFormat::D3d12), "shine.png"),
        (for_book(ExportFormat::D3d12), "shine.dds"),
        (options(ExportFormat::D3d11), "shine.png"),
    ] {
        let written = session.export_job(&asked).expect("a model is open").run_apart();
        let written = written.expect("it can be written");
        let told = written
            .plan
            .changes
            .iter()
            .find(|change| change.code == "metalness-from-picture");
        assert_eq!(
            told.map(|told| told.message.as_str()),
            Some(
                "Averages of pictures are written. \"Full\": metalness is multiplied into its diffuse map, roughness is 0.50."
            )
        );
        let (_, bytes) = written.maps.iter().find(|(map, _)| map == name).expect("it is written");
        let image = bindpose::image::decode(bytes, name).expect("a picture");
        let texels = image.to_rgba8(0, 0).expect("texels");
        assert_eq!(texels[..4], [255; 4], "what is no metal keeps its colour");
        if asked.format == ExportFormat::D3d12 {
            assert_eq!(texels[4..], [0, 0, 0, 255]);
        }
    }
}

#[test]
fn the_demo_plays_the_clip_that_is_watched_where_it_is_written() {
    let clips = |names: &[&str]| {
        let all = names.iter().map(|name| rigs::even(name, 12, 0.0, 9, 4.0));
        file("hero.m3d", &rigs::rig(12, all.collect()))
    };
    for (names, watched, kept, played) in [
        (["walk", "run"], 0, None, "walk"),
        (["walk", "run"], 1, None, "run"),
        (["walk", "run"], 1, only("walk"), "walk"),
        // As a script may name them.
        (
            ["walk", "run"],
            1,
            Some(vec!["run".to_owned(), "walk".to_owned()]),
            "run",
        ),
        (["walk", "Take1"], 0, None, "Take1"),
    ] {
        let mut session = opened(clips(&names));
        session.apply(PlayCommand::SelectClip(watched));
        let options = ExportOptions {
            clips: kept,
            ..for_book(ExportFormat::D3d12)
        };
        assert_eq!(session.demo_clip(&options), Some(played), "{names:?} {watched}");
        let job = session.export_job(&options).expect("a model is open");
        let written = job.run_apart().expect("it can be written");
        let model = import(&written.bytes).expect("it is read").model;
        let place = |name: &str| model.clips.iter().position(|clip| clip.name == name);
        let wanted = match &options.clips {
            Some(kept) if kept.len() == 1 => 0,
            _ => names.iter().position(|name| *name == played).expect("it is one"),
        };
        assert_eq!(place("Take1"), Some(wanted), "{names:?} {watched}");
    }
    let none = ExportOptions {
        clips: Some(Vec::new()),
        ..for_book(ExportFormat::D3d12)
    };
    assert_eq!(opened(clips(&["walk"])).demo_clip(&none), None);
}
