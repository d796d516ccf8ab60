//! Pictures beside a model, and pictures that come later.

use std::sync::Arc;

use bindpose::format::Document;
use bindpose::image::encode_png;
use bindpose::model::{AlphaMode, MapSlot, Material};
use bindpose::session::{File, FileCommand, Maps, Session};

use super::dropped;
use super::models;
use crate::documents::shared_bytes;

/// A picture of one colour.
pub(super) fn picture(path: &str, color: [u8; 4]) -> File {
    let pixels = color.repeat(4);
    File::new(path, encode_png(&pixels, 2, 2).expect("two by two pixels"))
}

/// The box, whose one material names these maps.
pub(super) fn mapped(path: &str, diffuse: &str, normal: &str) -> File {
    let mut document: Document = models::document();
    let material = &mut document.materials[0];
    material.diffuse_map = Some(diffuse.to_owned());
    material.normal_map = Some(normal.to_owned());
    models::file(path, &document)
}

fn opened(files: Vec<File>) -> Session {
    let session = dropped(files);
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
        .map(|map| (map.file.base_name().to_owned(), map.users.to_vec()))
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
    session.apply(FileCommand::Add(vec![picture("b.png", [128, 128, 255, 255])]));
    assert!(session.error().is_none());
    assert_eq!(session.model_revision(), model, "the model is not opened again");
    assert!(session.maps_revision() > maps && session.picture_revision() > picture_before);
    assert_eq!(session.maps().checklist().missing, ["a.png"]);

    let maps = session.maps_revision();
    session.apply(FileCommand::Add(vec![picture("unrelated.png", [0; 4])]));
    assert_eq!(
        session.maps_revision(),
        maps,
        "a picture that nobody names changes nothing"
    );
    session.apply(FileCommand::Add(vec![picture("b.png", [1, 2, 3, 255])]));
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
    session.apply(FileCommand::Add(vec![
        File::new("readme.txt", *b"Maps by somebody."),
        File::new("source.psd", *b"8BPS and layers"),
        picture("a.png", [1, 2, 3, 255]),
    ]));
    assert_eq!((session.error(), session.model_revision()), (None, model));
    assert_eq!(first_pixel(&session, MapSlot::Diffuse), Some(vec![1, 2, 3, 255]));

    session.apply(FileCommand::Add(vec![File::new("readme.txt", *b"Maps by somebody.")]));
    let error = session.error().expect("alone it is told what it is");
    assert_eq!(
        (error.diagnostic.code, error.file_name.as_str()),
        ("not-m3d", "readme.txt")
    );

    let renamed = models::still("model.txt");
    session.apply(FileCommand::Add(vec![renamed, picture("a.png", [1, 2, 3, 255])]));
    assert_eq!(session.error(), None);
    assert!(session.model_revision() > model, "a renamed model opens with its maps");
}

#[test]
fn a_picture_that_cannot_be_read_is_a_finding_and_the_model_shows_on() {
    let mut file = picture("a.png", [9; 4]);
    file.bytes = file.bytes.slice(..20);
    let session = opened(vec![mapped("box.m3d", "a.png", "a.png"), file]);
    assert!(session.maps().image(0, MapSlot::Diffuse).is_none());
    let findings: Vec<_> = session
        .diagnostics()
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
    session.apply(FileCommand::Add(vec![mapped("box.m3d", "a.png", "b.png")]));
    assert!(session.maps().image(0, MapSlot::Diffuse).is_some());
    session.apply(FileCommand::Add(vec![mapped("other.m3d", "a.png", "b.png")]));
    assert!(session.maps().image(0, MapSlot::Diffuse).is_none());
    assert_eq!(session.maps().checklist().missing.len(), 2);
}

fn messages(session: &Session, code: &str) -> Vec<String> {
    let notices = session.diagnostics().filter(|notice| notice.code == code);
    notices.map(|notice| notice.message.clone()).collect()
}

fn drop_pictures(session: &mut Session, pictures: Vec<File>) {
    session.apply(FileCommand::Add(pictures));
    assert_eq!(session.error(), None);
}

#[test]
fn a_map_that_comes_later_wins_whatever_its_folder_and_still_does_when_all_is_read_again() {
    let model = || mapped("model/box.m3d", "a.png", "b.png");
    let (first, later) = (
        picture("model/a.png", [1, 1, 1, 255]),
        picture("a/longer/path/a.png", [2, 2, 2, 255]),
    );
    let mut session = opened(vec![model(), first.clone()]);
    let maps = session.maps_revision();
    drop_pictures(&mut session, vec![later.clone()]);
    assert_eq!(first_pixel(&session, MapSlot::Diffuse), Some(vec![2, 2, 2, 255]));
    assert!(session.maps_revision() > maps);
    assert!(messages(&session, "map-ambiguous").is_empty(), "it was meant to win");

    session.apply(FileCommand::Add(vec![model(), first.clone(), later]));
    assert_eq!(first_pixel(&session, MapSlot::Diffuse), Some(vec![2, 2, 2, 255]));
    drop_pictures(&mut session, vec![first]);
    assert_eq!(
        first_pixel(&session, MapSlot::Diffuse),
        Some(vec![1, 1, 1, 255]),
        "dropped by itself it is meant too"
    );
    let used: Vec<_> = session.maps().used().map(|map| map.file.path.clone()).collect();
    assert_eq!(used, ["model/a.png"], "what lost its place is not in use");
}

#[test]
fn what_cannot_be_read_is_noted_used_or_not_until_a_sound_one_takes_its_place() {
    let broken = |path: &str| {
        let mut file = picture(path, [9; 4]);
        file.bytes = file.bytes.slice(..20);
        file
    };
    let mut session = opened(vec![mapped("box.m3d", "a.png", "b.png")]);
    drop_pictures(
        &mut session,
        vec![broken("in/a.png"), broken("stray.png"), File::new("empty.tga", [])],
    );
    let found = |session: &Session| -> Vec<String> {
        let images = session.diagnostics().filter(|notice| notice.code.starts_with("image-"));
        images
            .map(|notice| notice.message.split(':').next().unwrap_or_default().to_owned())
            .collect()
    };
    assert_eq!(found(&session), ["a.png", "stray.png", "empty.tga"]);
    assert!(
        messages(&session, "map-unused").is_empty(),
        "each has a note of its own"
    );
    let checklist = session.maps().checklist();
    assert_eq!((checklist.found(), checklist.missing.len()), (0, 1));
    assert_eq!(checklist.unreadable, ["a.png"]);
    let unreadable: Vec<_> = session
        .maps()
        .unreadable()
        .map(|map| (map.file.path.clone(), map.diagnostic.code, map.users.to_vec()))
        .collect();
    let users = vec![(0, MapSlot::Diffuse)];
    assert_eq!(unreadable, [("in/a.png".to_owned(), "image-undecodable", users)]);

    drop_pictures(&mut session, vec![picture("out/A.png", [3, 3, 3, 255])]);
    assert_eq!(first_pixel(&session, MapSlot::Diffuse), Some(vec![3, 3, 3, 255]));
    assert_eq!(found(&session), ["stray.png", "empty.tga"]);
    assert_eq!(
        (session.maps().checklist().found(), session.maps().unreadable().count()),
        (1, 0)
    );
}

#[test]
fn every_malformed_texture_is_noted_though_no_material_names_it() {
    let names = [
        "invalid-006b3057-841d-4c47-8af3-c352fd511b8d",
        "invalid-3f308164-3aa4-4095-8fec-f48fa90ff471",
        "invalid-4d9b027e-ab8b-4412-ae66-a49fe7e7120e",
        "invalid-676e6dcc-38ae-42b6-bda7-da30d1ccdc4b",
        "invalid-7bf16981-845f-4095-af74-bbb1244cd105",
        "invalid-adc8f63c-279f-4f25-9641-3324b3838a12",
        "invalid-dc141355-6459-4a70-b8f0-e3fcefbb2e39",
        "unsupported-daab5194-837d-4578-932d-423a7338f4c4",
    ];
    let files = names.map(|name| {
        Some(File::new(
            name,
            shared_bytes(&format!("textures/malformed/{name}.dds"))?,
        ))
    });
    let Some(files) = files.into_iter().collect::<Option<Vec<_>>>() else {
        return;
    };
    let files = files
        .into_iter()
        .map(|file| File::new(&format!("{}.dds", file.path), file.bytes));
    let mut session = opened(vec![mapped("box.m3d", "a.png", "b.png")]);
    drop_pictures(&mut session, files.collect());
    for name in names {
        let noted = session
            .diagnostics()
            .filter(|notice| notice.message.contains(name))
            .count();
        assert_eq!(noted, 1, "{name}");
    }
}

#[test]
fn maps_are_there_again_after_another_model_of_the_drop_or_the_one_before_it() {
    let mut session = opened(vec![
        mapped("first.m3d", "a.png", "b.png"),
        picture("a.png", [9, 9, 9, 255]),
    ]);
    session.apply(FileCommand::Add(vec![
        mapped("in/box.m3d", "a.png", "b.png"),
        models::still("in/bare.m3d"),
        picture("in/a.png", [1, 2, 3, 255]),
    ]));
    session.apply(FileCommand::Add(vec![picture("b.png", [4, 5, 6, 255])]));
    assert_eq!(session.maps().checklist().found(), 2);
    for path in ["in/bare.m3d", "in/box.m3d", "first.m3d", "in/box.m3d"] {
        session.apply(FileCommand::Open(path.to_owned()));
        let [diffuse, normal] = [MapSlot::Diffuse, MapSlot::Normal].map(|slot| first_pixel(&session, slot));
        let expected = match path {
            "in/box.m3d" => [Some(vec![1, 2, 3, 255]), Some(vec![4, 5, 6, 255])],
            "first.m3d" => [Some(vec![9, 9, 9, 255]), None],
            _ => [None, None],
        };
        assert_eq!([diffuse, normal], expected, "{path}");
    }
}

#[test]
fn pictures_that_fit_nothing_are_noted_until_the_next_drop() {
    let mut session = opened(vec![mapped("box.m3d", "a.png", "b.png")]);
    let stray = |names: &[&str]| names.iter().map(|name| picture(name, [5; 4])).collect::<Vec<_>>();
    for (names, message) in [
        (vec!["in/coat2.png"], "coat2.png fits no name of the model's maps."),
        (
            vec!["c.png", "d.png"],
            "c.png and d.png fit no name of the model's maps.",
        ),
        (
            vec!["c.png", "d.png", "e.png", "f.png", "g.png"],
            "c.png, d.png, e.png and 2 more fit no name of the model's maps.",
        ),
    ] {
        drop_pictures(&mut session, stray(&names));
        assert_eq!(messages(&session, "map-unused"), [message]);
    }
    drop_pictures(&mut session, stray(&["h.png", "a.png"]));
    assert!(messages(&session, "map-unused").is_empty(), "one of them is used");
    drop_pictures(&mut session, stray(&["a.tga", "a.jpg"]));
    assert_eq!(
        messages(&session, "map-unused"),
        ["a.tga and a.jpg are not used: there is a picture with the very name that the model gives."]
    );
    drop_pictures(&mut session, vec![super::models::cube("sky.dds", 4, [9; 4])]);
    assert!(messages(&session, "map-unused").is_empty(), "another drop came");

    let session = opened(vec![mapped("box.m3d", "a.png", "b.png"), picture("stray.png", [5; 4])]);
    assert!(
        messages(&session, "map-unused").is_empty(),
        "a folder has more in it than one model's maps"
    );
}

#[test]
fn a_map_that_comes_later_is_decoded_alone_and_the_others_stay() {
    let mut session = opened(vec![
        mapped("box.m3d", "a.png", "b.png"),
        picture("a.png", [1, 2, 3, 255]),
    ]);
    let image = |session: &Session, slot| session.maps().image(0, slot).map(Arc::clone);
    let first = image(&session, MapSlot::Diffuse).expect("there");
    drop_pictures(&mut session, vec![picture("b.png", [128, 128, 255, 255])]);
    let is_same = |session: &Session| Arc::ptr_eq(&first, &image(session, MapSlot::Diffuse).expect("there"));
    assert!(is_same(&session) && image(&session, MapSlot::Normal).is_some());
    session.apply(FileCommand::Add(vec![mapped("box.m3d", "a.png", "b.png")]));
    assert!(is_same(&session), "the model again");
}

#[test]
fn maps_come_with_the_mips_of_what_they_are_used_for() {
    // Two texels that lie opposite each other as directions, and are far apart as colours.
    let texels = [[255, 128, 128, 255], [0, 127, 127, 255]].concat();
    let png = || File::new("a.png", encode_png(&texels, 2, 1).expect("two by one"));
    let levels = |session: &Session, slot| {
        let image = session.maps().image(0, slot)?;
        let counts = [image.level_count(), image.file_level_count()];
        Some((counts, image.to_rgba8(0, 1)?))
    };
    let as_colour = Some(([2, 1], vec![188, 128, 128, 255]));
    let as_direction = Some(([2, 1], vec![128, 128, 128, 255]));

    let both = opened(vec![mapped("box.m3d", "a.png", "a.png"), png()]);
    assert_eq!(levels(&both, MapSlot::Diffuse), as_colour);
    assert_eq!(levels(&both, MapSlot::Normal), as_direction);

    // When the model comes again and names it for more, what is there stays.
    let mut session = opened(vec![mapped("box.m3d", "a.png", "none.png"), png()]);
    assert_eq!(levels(&session, MapSlot::Normal), None);
    let before = Arc::clone(session.maps().image(0, MapSlot::Diffuse).expect("it is there"));
    session.apply(FileCommand::Add(vec![mapped("box.m3d", "a.png", "a.png")]));
    assert_eq!(levels(&session, MapSlot::Normal), as_direction);
    let after = session.maps().image(0, MapSlot::Diffuse).expect("it is there");
    assert!(Arc::ptr_eq(&before, after));
}

/// Leaves on an eighth of the texels: their mean alpha is below half at nearly all of each smaller level.
#[test]
fn mips_of_what_alpha_cuts_leave_as_much_of_it() {
    // A hash of 32 bits (Wellons, "Hash Function Prospector").
    let leaf = |index: u32| {
        let hash = (index ^ (index >> 16)).wrapping_mul(0x7feb_352d);
        let hash = (hash ^ (hash >> 15)).wrapping_mul(0x846c_a68b);
        (hash ^ (hash >> 16)).is_multiple_of(8)
    };
    let texels: Vec<u8> = (0..64 * 64)
        .flat_map(|index| [20, 90, 30, if leaf(index) { 255 } else { 0 }])
        .collect();
    let png = encode_png(&texels, 64, 64).expect("it can be encoded");
    let material = |alpha| Material {
        name: "leaves".to_owned(),
        alpha,
        diffuse_map: Some("leaves.png".into()),
        ..Material::default()
    };
    let left = |alpha, level| {
        let mut maps = Maps::default();
        maps.add(&[material(alpha)], [File::new("leaves.png", png.clone())]);
        let image = maps.image(0, MapSlot::Diffuse).expect("it is decoded").clone();
        let texels = image.to_rgba8(0, level).expect("the level is there");
        let alphas = texels.iter().skip(3).step_by(4);
        alphas.clone().filter(|&&alpha| alpha >= 128).count() as f32 / alphas.count() as f32
    };
    let cut = AlphaMode::Mask { cutoff: 0.5 };
    let all = left(cut, 0);
    // In the level before, four texels have one of five alphas.
    for level in 2..5 {
        let part = left(cut, level);
        assert!((part - all).abs() < 0.06, "level {level}: {part} of {all}");
    }
    assert!(left(AlphaMode::Blend, 3) < 0.01, "blended, it fades");
}
