//! Cube maps: dropped by themselves they become the sky, beside other files they can.

use bindpose::image::ImageKind;
use bindpose::scene::Background;
use bindpose::session::{File, FileCommand, HistoryCommand, LookCommand, News, Session};

use super::loading::shortest;
use super::models::{self, cube, still};
use super::{dropped, opened};
use crate::documents::shared_bytes;
use crate::radiance::{header, panorama};

fn cut(mut file: File) -> File {
    file.bytes = file.bytes.slice(..200);
    file
}

fn sky_name(session: &Session) -> Option<&str> {
    session.sky_file().map(File::base_name)
}

fn first_texel(session: &Session) -> Option<Vec<u8>> {
    Some(session.sky()?.to_rgba8(0, 0)?[..4].to_vec())
}

fn codes(session: &Session) -> Vec<&'static str> {
    session.diagnostics().map(|notice| notice.code).collect()
}

#[test]
fn a_cube_dropped_later_becomes_the_sky_and_is_shown() {
    let mut session = opened(still("a.m3d"));
    let (sky, model, maps, picture) = (
        session.sky_revision(),
        session.model_revision(),
        session.maps_revision(),
        session.picture_revision(),
    );
    session.apply(FileCommand::Add(vec![cube("skies/Dusk.dds", 4, [250, 120, 30, 255])]));
    assert_eq!((session.error(), sky_name(&session)), (None, Some("Dusk.dds")));
    assert_eq!(first_texel(&session), Some(vec![250, 120, 30, 255]));
    assert_eq!(session.sky().map(|image| image.kind()), Some(ImageKind::Cube));
    assert!(session.sky_revision() > sky && session.picture_revision() > picture);
    assert_eq!((session.model_revision(), session.maps_revision()), (model, maps));
    assert_eq!(session.look().background, Background::Sky);
    assert!(session.maps().pictures().is_empty(), "it is no map");
}

#[test]
fn taking_the_sky_away_brings_back_what_was_behind() {
    let white = Background::Color([255; 3]);
    let mut session = opened(still("a.m3d"));
    session.apply(LookCommand::SetBackground(white));
    session.apply(FileCommand::Add(vec![cube("a.dds", 4, [1; 4])]));
    session.apply(FileCommand::Add(vec![cube("b.dds", 4, [2; 4])]));
    let revision = session.sky_revision();
    session.apply(FileCommand::ClearSky);
    assert!(session.sky().is_none() && session.sky_revision() > revision);
    assert_eq!(session.look().background, white);

    session.apply(FileCommand::Add(vec![cube("a.dds", 4, [1; 4])]));
    session.apply(LookCommand::SetBackground(Background::None));
    let picture = session.picture_revision();
    session.apply(FileCommand::ClearSky);
    assert_eq!(session.look().background, Background::None, "chosen since");
    assert!(session.picture_revision() > picture, "it lit the model");
    let (revision, picture) = (session.sky_revision(), session.picture_revision());
    session.apply(FileCommand::ClearSky);
    assert_eq!(
        (session.sky_revision(), session.picture_revision()),
        (revision, picture)
    );
}

fn found(session: &Session) -> Vec<&str> {
    session.skies().iter().map(|file| file.path.as_str()).collect()
}

#[test]
fn a_cube_beside_a_model_or_among_pictures_is_offered_and_not_put_in_place_of_the_studio() {
    let mut session = Session::new(false);
    let drop = || {
        vec![
            still("a.m3d"),
            cube("in/small.dds", 2, [1; 4]),
            cube("in/sky.dds", 4, [9; 4]),
        ]
    };
    session.apply(FileCommand::Add(drop()));
    assert_eq!(
        (sky_name(&session), session.look().background),
        (None, Background::Backdrop)
    );
    assert_eq!(found(&session), ["in/sky.dds", "in/small.dds"], "the largest first");
    assert_eq!(session.take_news(), [News::SkyFound("in/sky.dds".to_owned())]);
    session.apply(FileCommand::Add(drop()));
    session.apply(FileCommand::Open("a.m3d".to_owned()));
    assert!(session.take_news().is_empty(), "it is known");

    session.apply(FileCommand::Add(vec![
        File::new("flat.png", *b"not looked at"),
        cube("other.dds", 4, [8; 4]),
    ]));
    assert_eq!((sky_name(&session), found(&session).len()), (None, 3));
    assert_eq!(session.take_news(), [News::SkyFound("other.dds".to_owned())]);

    session.apply(FileCommand::UseSky("none.dds".to_owned()));
    assert_eq!(sky_name(&session), None);
    assert!(session.apply(FileCommand::UseSky("in/sky.dds".to_owned())).sky);
    assert_eq!(
        (sky_name(&session), session.look().background),
        (Some("sky.dds"), Background::Sky)
    );
    assert_eq!(session.take_news(), [News::SkyUsed("sky.dds".to_owned())]);
    session.apply(LookCommand::SetBackground(Background::Backdrop));
    session.apply(FileCommand::Add(drop()));
    assert_eq!(
        session.look().background,
        Background::Backdrop,
        "the same again changes nothing"
    );
    session.apply(FileCommand::Add(vec![still("b.m3d")]));
    assert_eq!(sky_name(&session), Some("sky.dds"), "it belongs to no model");

    session.apply(FileCommand::Add(vec![still("a.m3d"), cube("in/sky.dds", 4, [7; 4])]));
    assert_eq!(first_texel(&session), Some(vec![7; 4]), "it was read again");
    session.apply(FileCommand::Add(vec![
        models::broken("c.m3d"),
        cube("last.dds", 4, [8; 4]),
    ]));
    assert!(session.error().is_some() && !found(&session).contains(&"last.dds"));
}

#[test]
fn a_sky_is_a_step_that_undo_takes_back_with_its_background() {
    let white = Background::Color([255; 3]);
    let mut session = opened(still("a.m3d"));
    session.apply(LookCommand::SetBackground(white));
    for (name, color) in [("a.dds", [1; 4]), ("b.dds", [2; 4])] {
        session.apply(FileCommand::Add(vec![cube(name, 4, color)]));
    }
    assert_eq!(session.history().undo_label(), Some("use b.dds as the sky"));
    session.apply(FileCommand::ClearSky);
    assert_eq!(session.history().undo_label(), Some("remove the sky"));
    let now = |session: &Session| (sky_name(session).map(str::to_owned), session.look().background);
    let [a, b] = ["a.dds", "b.dds"].map(|name| (Some(name.to_owned()), Background::Sky));
    for (command, expected) in [
        (HistoryCommand::Undo, &b),
        (HistoryCommand::Undo, &a),
        (HistoryCommand::Undo, &(None, white)),
        (HistoryCommand::Redo, &a),
        (HistoryCommand::Redo, &b),
        (HistoryCommand::Redo, &(None, white)),
    ] {
        let revision = session.sky_revision();
        assert!(session.apply(command).sky && session.sky_revision() > revision);
        assert_eq!(&now(&session), expected);
    }
}

#[test]
fn a_cube_needs_no_model_and_flat_pictures_do() {
    let mut session = dropped(vec![cube("sky.dds", 4, [9; 4])]);
    assert_eq!((session.error(), sky_name(&session)), (None, Some("sky.dds")));
    assert_eq!(session.take_news(), [News::SkyUsed("sky.dds".to_owned())]);
    session.apply(FileCommand::Add(vec![
        File::new("flat.png", *b"not looked at"),
        cube("other.dds", 4, [9; 4]),
    ]));
    assert_eq!(session.error().map(|error| error.diagnostic.code), Some("no-model"));
    assert_eq!(
        (sky_name(&session), found(&session)),
        (Some("sky.dds"), vec!["sky.dds", "other.dds"])
    );
}

#[test]
fn pictures_of_environments_that_cannot_be_read_are_refused_in_words() {
    let words = "studio.exr cannot be read; a panorama as Radiance (.hdr) or a cube map as .dds can.";
    let exr = || File::new("in/studio.exr", *b"\x76\x2f\x31\x01");
    for mut session in [Session::new(false), opened(still("a.m3d"))] {
        session.apply(FileCommand::Add(vec![exr()]));
        let error = session.error().expect("it is refused");
        assert_eq!((error.diagnostic.code, &*error.diagnostic.message), ("no-model", words));
        assert!(session.maps().pictures().is_empty(), "it is no map");
    }
    let session = dropped(vec![still("a.m3d"), exr()]);
    let noted: Vec<_> = session.diagnostics().map(|notice| &*notice.message).collect();
    assert_eq!(
        (session.error(), noted),
        (None, vec![words]),
        "beside a model it is a finding"
    );
    assert!(session.models().len() == 1 && session.skies().is_empty());
}

#[test]
fn a_panorama_is_a_sky_that_is_read_in_slices_and_that_undo_takes_back() {
    let hdr = || File::new("in/Studio.HDR", panorama(64, |towards| towards.abs()));
    let mut session = opened(still("a.m3d"));
    session.open_in(&shortest());
    session.apply(FileCommand::Add(vec![hdr()]));
    assert_eq!(sky_name(&session), None, "not yet");
    let mut slices = 0;
    while session.is_opening() {
        session.advance_opening();
        slices += 1;
    }
    assert!(slices > 64, "{slices}: a row of a face or of the panorama each");
    assert_eq!((session.error(), sky_name(&session)), (None, Some("Studio.HDR")));
    let levels = session.sky().map(|image| (image.width(), image.level_count()));
    assert_eq!(levels, Some((16, 5)), "with what is seen of it from afar");
    assert_eq!(session.history().undo_label(), Some("use Studio.HDR as the sky"));
    assert!(session.apply(HistoryCommand::Undo).sky && session.sky().is_none());

    // One that is damaged behind its header: what was there stays.
    let mut session = opened(still("a.m3d"));
    session.apply(FileCommand::Add(vec![hdr()]));
    session.apply(FileCommand::Add(vec![File::new("cut.hdr", header(64, 32))]));
    assert_eq!(
        (sky_name(&session), codes(&session)),
        (Some("Studio.HDR"), vec!["image-cut"])
    );
}

#[test]
fn a_sky_that_is_being_read_comes_behind_another_model_and_never_once_it_was_removed() {
    let hdr = || File::new("studio.hdr", panorama(64, |towards| towards.abs()));
    let begun = || {
        let mut session = opened(still("a.m3d"));
        session.open_in(&shortest());
        session.apply(FileCommand::Add(vec![hdr()]));
        for _ in 0..8 {
            session.advance_opening();
        }
        assert!(session.is_opening() && sky_name(&session).is_none());
        session
    };
    let ended = |mut session: Session| {
        while session.is_opening() {
            session.advance_opening();
        }
        let model = session.open_model().map(|open| open.file.path.clone());
        (model.expect("open"), sky_name(&session).map(str::to_owned))
    };
    let mut replaced = begun();
    replaced.apply(FileCommand::Add(vec![still("b.m3d")]));
    assert_eq!(ended(replaced), ("b.m3d".to_owned(), Some("studio.hdr".to_owned())));
    for given_up in [FileCommand::ClearSky, FileCommand::CancelOpening] {
        let mut session = begun();
        session.apply(given_up);
        assert_eq!(ended(session), ("a.m3d".to_owned(), None));
    }
    let mut fetched = begun();
    fetched.begin_fetching("c.m3d".to_owned(), 10, true);
    fetched.end_fetching();
    assert_eq!(ended(fetched), ("a.m3d".to_owned(), Some("studio.hdr".to_owned())));
}

#[test]
fn of_several_cubes_the_largest_that_can_be_read_is_taken() {
    let mut session = opened(still("a.m3d"));
    session.apply(FileCommand::Add(vec![
        cube("small.dds", 2, [1; 4]),
        cube("large.dds", 8, [2; 4]),
        cut(cube("broken.dds", 16, [3; 4])),
        cube("middle.dds", 4, [4; 4]),
        cut(cube("unwanted.dds", 7, [3; 4])),
    ]));
    assert_eq!(sky_name(&session), Some("large.dds"));
    let noted: Vec<_> = session
        .diagnostics()
        .map(|notice| (notice.code, &notice.message[..6]))
        .collect();
    assert_eq!(
        noted,
        [("image-cut", "broken"), ("image-cut", "unwant")],
        "what could not be read is a finding"
    );
}

#[test]
fn a_cube_that_cannot_be_read_is_a_finding_and_the_old_sky_stays() {
    let mut session = opened(still("a.m3d"));
    session.apply(FileCommand::Add(vec![cube("sky.dds", 4, [9; 4])]));
    let revision = session.sky_revision();
    session.apply(FileCommand::Add(vec![cut(cube("broken.dds", 16, [3; 4]))]));
    assert_eq!(
        (sky_name(&session), session.sky_revision()),
        (Some("sky.dds"), revision)
    );
    assert_eq!((session.error(), codes(&session)), (None, vec!["image-cut"]));
    session.apply(FileCommand::Add(vec![cube("sky.dds", 4, [9; 4])]));
    assert!(codes(&session).is_empty(), "and goes with the next sky");
}

#[test]
fn real_cube_maps_become_the_sky_the_largest_first() {
    let names = [
        "LobbyCube_DXT1_256_nomips.dds",
        "skybox02_BGRX_256_nomips.dds",
        "Atrium_diffuseIBL_BC6H_128_8mips.dds",
    ];
    let files: Option<Vec<_>> = names
        .iter()
        .map(|name| Some(File::new(name, shared_bytes(&format!("textures/cube/{name}"))?)))
        .collect();
    let Some(files) = files else { return };
    let mut session = opened(still("a.m3d"));
    for file in &files {
        session.apply(FileCommand::Add(vec![file.clone()]));
        assert_eq!(sky_name(&session), Some(file.base_name()));
        assert!(codes(&session).is_empty());
    }
    session.apply(FileCommand::Add(files));
    assert_eq!(
        sky_name(&session),
        Some(names[1]),
        "of equal sides, the one with more bytes"
    );
}
