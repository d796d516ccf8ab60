//! Pictures beside a model, and pictures that come later.

use bindpose::format::Document;
use bindpose::image::encode_png;
use bindpose::session::{Command, File, MapSlot, Session};

use super::models;

/// A picture of one colour.
fn picture(path: &str, color: [u8; 4]) -> File {
    let pixels = color.repeat(4);
    File::new(path, encode_png(&pixels, 2, 2).expect("two by two pixels"))
}

/// The box, whose one material names these maps.
fn mapped(path: &str, diffuse: &str, normal: &str) -> File {
    let mut document: Document = models::document();
    let material = &mut document.materials[0];
    material.diffuse_map = Some(diffuse.to_owned());
    material.normal_map = Some(normal.to_owned());
    models::file(path, &document)
}

fn opened(files: Vec<File>) -> Session {
    let mut session = Session::new(false);
    session.apply(Command::AddFiles(files));
    assert!(session.error().is_none(), "{:?}", session.error());
    session
}

/// Colour of the first pixel of a material's map.
fn first_pixel(session: &Session, slot: MapSlot) -> Option<Vec<u8>> {
    Some(session.maps().image(0, slot)?.to_rgba8(0, 0)?[..4].to_vec())
}

#[test]
fn maps_of_the_same_drop_are_found_at_any_depth_without_case_and_extension() {
    let session = opened(vec![
        mapped("model/box.m3d", "C:\\Textures\\Skin_Diff.dds", "skin_norm.dds"),
        picture("model/maps/skin_diff.png", [10, 20, 30, 255]),
        picture("elsewhere/unused.png", [1, 2, 3, 255]),
    ]);
    assert_eq!(first_pixel(&session, MapSlot::Diffuse), Some(vec![10, 20, 30, 255]));
    assert_eq!(first_pixel(&session, MapSlot::Normal), None);
    let checklist = session.maps().checklist();
    assert_eq!(
        (checklist.named, checklist.missing.as_slice()),
        (2, ["skin_norm.dds".to_owned()].as_slice())
    );
    let used: Vec<_> = session
        .maps()
        .used()
        .map(|map| (map.file.base_name().to_owned(), map.users))
        .collect();
    assert_eq!(used, [("skin_diff.png".to_owned(), vec![(0, MapSlot::Diffuse)])]);
}

#[test]
fn pictures_dropped_later_join_the_open_model() {
    let mut session = opened(vec![mapped("box.m3d", "a.png", "b.png")]);
    let (model, maps, picture_before) = (
        session.model_revision(),
        session.maps_revision(),
        session.picture_revision(),
    );
    session.apply(Command::AddFiles(vec![picture("b.png", [128, 128, 255, 255])]));
    assert!(session.error().is_none());
    assert_eq!(session.model_revision(), model, "the model is not opened again");
    assert!(session.maps_revision() > maps && session.picture_revision() > picture_before);
    assert_eq!(session.maps().checklist().missing, ["a.png"]);

    let maps = session.maps_revision();
    session.apply(Command::AddFiles(vec![picture("unrelated.png", [0; 4])]));
    assert_eq!(
        session.maps_revision(),
        maps,
        "a picture that nobody names changes nothing"
    );
    session.apply(Command::AddFiles(vec![picture("b.png", [1, 2, 3, 255])]));
    assert!(
        session.maps_revision() > maps,
        "a picture with other contents is another map"
    );
    assert_eq!(first_pixel(&session, MapSlot::Normal), Some(vec![1, 2, 3, 255]));
}

#[test]
fn pictures_join_whatever_notes_come_with_them() {
    let mut session = opened(vec![mapped("box.m3d", "a.png", "b.png")]);
    let model = session.model_revision();
    session.apply(Command::AddFiles(vec![
        File::new("readme.txt", *b"Maps by somebody."),
        File::new("source.psd", *b"8BPS and layers"),
        picture("a.png", [1, 2, 3, 255]),
    ]));
    assert_eq!((session.error(), session.model_revision()), (None, model));
    assert_eq!(first_pixel(&session, MapSlot::Diffuse), Some(vec![1, 2, 3, 255]));

    session.apply(Command::AddFiles(vec![File::new("readme.txt", *b"Maps by somebody.")]));
    let error = session.error().expect("alone it is told what it is");
    assert_eq!(
        (error.diagnostic.code, error.file_name.as_str()),
        ("not-m3d", "readme.txt")
    );

    let renamed = models::still("model.txt");
    session.apply(Command::AddFiles(vec![renamed, picture("a.png", [1, 2, 3, 255])]));
    assert_eq!(session.error(), None);
    assert!(session.model_revision() > model, "a renamed model opens with its maps");
}

#[test]
fn a_picture_that_cannot_be_read_is_a_finding_and_the_model_shows_on() {
    let mut file = picture("a.png", [9; 4]);
    file.bytes = file.bytes[..20].into();
    let session = opened(vec![mapped("box.m3d", "a.png", "a.png"), file]);
    assert!(session.maps().image(0, MapSlot::Diffuse).is_none());
    let findings: Vec<_> = session
        .notices()
        .filter(|notice| notice.message.contains("a.png"))
        .collect();
    assert_eq!(findings.len(), 1, "{findings:?}");
}

#[test]
fn the_model_alone_dropped_again_keeps_its_maps_and_another_model_does_not() {
    let mut session = opened(vec![
        mapped("box.m3d", "a.png", "b.png"),
        picture("a.png", [7, 7, 7, 255]),
    ]);
    session.apply(Command::AddFiles(vec![mapped("box.m3d", "a.png", "b.png")]));
    assert!(session.maps().image(0, MapSlot::Diffuse).is_some());
    session.apply(Command::AddFiles(vec![mapped("other.m3d", "a.png", "b.png")]));
    assert!(session.maps().image(0, MapSlot::Diffuse).is_none());
    assert_eq!(session.maps().checklist().missing.len(), 2);
}
