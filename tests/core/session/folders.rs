//! Folders with very many files: what is looked at grows with the files, not with their square.

use std::time::{Duration, Instant};

use bindpose::format::Document;
use bindpose::image::encode_png;
use bindpose::session::{File, FileCommand, Session};

use super::models;
use super::{dropped, noted};

const FILES: usize = 20_000;

/// Each of these takes some 0.2 s without optimisation, and half a minute or more where every file is compared with every
/// other one. A busy machine has room in between.
const SOON: Duration = Duration::from_secs(10);

fn soon<T>(what: &str, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let done = work();
    let took = start.elapsed();
    assert!(took < SOON, "{what}: {took:?}");
    done
}

/// Pictures of one pixel in folders of a hundred, under names of their own.
fn pictures(count: usize) -> impl Iterator<Item = File> {
    let png = bytes::Bytes::from(encode_png(&[9; 4], 1, 1).expect("one pixel"));
    (0..count).map(move |index| File::sharing(&format!("art/{}/map_{index}.png", index / 100), png.clone()))
}

/// The box with this many materials, each of which names two maps.
fn mapped(materials: usize) -> File {
    let mut document: Document = models::document();
    let plain = document.materials[0].clone();
    document.materials = (0..materials)
        .map(|index| {
            let mut material = plain.clone();
            material.diffuse_map = Some(format!("MAP_{}.dds", 2 * index));
            material.normal_map = Some(format!("map_{}.png", 2 * index + 1));
            material
        })
        .collect();
    models::file("art/box.m3d", &document)
}

#[test]
fn a_folder_of_twenty_thousand_pictures_opens_soon_and_decodes_what_the_model_names() {
    let mut files: Vec<File> = pictures(FILES).collect();
    files.push(mapped(50));
    let mut session = Session::new(false);
    soon("a folder", || session.apply(FileCommand::Add(files.clone())));
    let count = |session: &Session| (session.maps().pictures().len(), session.maps().used().count());
    assert_eq!(count(&session), (FILES, 100));
    soon("the same folder again", || session.apply(FileCommand::Add(files)));
    assert_eq!(count(&session), (FILES, 100));
}

#[test]
fn twenty_thousand_pictures_without_a_model_join_the_open_one_soon() {
    let mut session = dropped(vec![mapped(50)]);
    soon("named and strange", || {
        session.apply(FileCommand::Add(pictures(FILES).collect()))
    });
    assert_eq!(session.maps().checklist().found(), 100);

    let strange = |index: usize| {
        File::new(
            &format!("strange_{index}.png"),
            encode_png(&[0; 4], 1, 1).expect("one pixel"),
        )
    };
    soon("strange alone", || {
        session.apply(FileCommand::Add((0..FILES).map(strange).collect()))
    });
    let unused = noted(&session, "map-unused");
    assert_eq!(
        unused.message,
        "strange_0.png, strange_1.png, strange_2.png and 19997 more fit no name of the model's maps."
    );

    let damaged = |index: usize| File::new(&format!("damaged_{index}.png"), *b"\x89PNG\r\n\x1a\n");
    soon("damaged", || {
        session.apply(FileCommand::Add((0..FILES).map(damaged).collect()))
    });
    let unreadable = session.diagnostics().filter(|notice| notice.code.starts_with("image-"));
    assert_eq!(unreadable.count(), FILES);
}

#[test]
fn a_model_of_many_materials_finds_its_maps_soon() {
    let mut files: Vec<File> = pictures(FILES).collect();
    files.push(mapped(FILES / 20));
    let mut session = Session::new(false);
    soon("many materials", || session.apply(FileCommand::Add(files)));
    assert_eq!(session.maps().checklist().found(), FILES / 10);
}

#[test]
fn one_name_in_twenty_thousand_folders_is_found_soon_and_the_note_spells_out_a_few() {
    let png = bytes::Bytes::from(encode_png(&[9; 4], 1, 1).expect("one pixel"));
    let mut document: Document = models::document();
    document.materials[0].diffuse_map = Some("skin.dds".to_owned());
    document.materials[0].normal_map = None;
    document.materials = vec![document.materials[0].clone(); 500];
    let copies = (0..FILES).map(|index| File::sharing(&format!("{index:05}/skin.png"), png.clone()));
    let files: Vec<File> = copies.chain([models::file("box.m3d", &document)]).collect();
    let mut session = Session::new(false);
    soon("rivals", || session.apply(FileCommand::Add(files)));
    assert_eq!(session.maps().used().count(), 1);
    let ambiguous = noted(&session, "map-ambiguous");
    let name = &session.open_model().expect("open").model.materials[0].name;
    assert_eq!(
        ambiguous.message,
        format!(
            "the diffuse map of material \"{name}\" could be several files: 00000/skin.png is taken, not 00001/skin.png, \
             00002/skin.png, 00003/skin.png, 19996 more"
        )
    );
}

#[test]
fn twenty_thousand_models_of_one_drop_are_listed_soon() {
    let bytes = models::still("a.m3d").bytes;
    let files = (0..FILES).map(|index| File::sharing(&format!("{index}/a.m3d"), bytes.clone()));
    let mut session = Session::new(false);
    soon("models", || session.apply(FileCommand::Add(files.collect())));
    assert_eq!(session.files().models().len(), FILES);
    soon("opening each of a hundred", || {
        for index in 0..100 {
            session.apply(FileCommand::Open(format!("{}/a.m3d", FILES - index - 1)));
        }
    });
}
