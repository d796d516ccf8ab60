//! Cube maps that are dropped become the sky.

use bindpose::image::ImageKind;
use bindpose::scene::Background;
use bindpose::session::{File, FileCommand, LookCommand, Session};

use super::models::{self, still};
use super::opened;
use crate::documents::shared_bytes;

/// A cube map of one colour, 32 bits a texel.
pub(super) fn cube(path: &str, side: u32, color: [u8; 4]) -> File {
    let mut words = [0_u32; 31];
    words[0] = 124;
    words[1] = 0x1007;
    (words[2], words[3]) = (side, side);
    words[18] = 32;
    // Colour and alpha by masks.
    words[19] = 0x41;
    words[21] = 32;
    words[22..26].copy_from_slice(&[0xff, 0xff00, 0xff_0000, 0xff00_0000]);
    // A cube with all of its faces.
    words[27] = 0xfe00;
    let mut bytes = b"DDS ".to_vec();
    bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
    bytes.extend(color.repeat(6 * (side * side) as usize));
    File::new(path, bytes)
}

fn cut(mut file: File) -> File {
    file.bytes = file.bytes[..200].into();
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

#[test]
fn a_cube_beside_a_model_is_the_sky_and_stays_for_the_next_model() {
    let mut session = Session::new(false);
    session.apply(FileCommand::Add(vec![still("a.m3d"), cube("sky.dds", 4, [9; 4])]));
    assert!(session.open_model().is_some());
    assert_eq!(sky_name(&session), Some("sky.dds"));
    assert!(session.maps().pictures().is_empty());
    let revision = session.sky_revision();
    session.apply(LookCommand::SetBackground(Background::Backdrop));
    session.apply(FileCommand::Add(vec![still("a.m3d"), cube("sky.dds", 4, [9; 4])]));
    assert_eq!(
        session.look().background,
        Background::Backdrop,
        "the same again changes nothing"
    );
    session.apply(FileCommand::Add(vec![still("b.m3d")]));
    assert_eq!(
        (sky_name(&session), session.sky_revision()),
        (Some("sky.dds"), revision)
    );

    session.apply(FileCommand::Add(vec![
        models::broken("c.m3d"),
        cube("other.dds", 4, [8; 4]),
    ]));
    assert!(session.error().is_some());
    assert_eq!(sky_name(&session), Some("sky.dds"), "a drop that fails changes nothing");
}

#[test]
fn a_cube_needs_no_model_and_flat_pictures_do() {
    let mut session = Session::new(false);
    session.apply(FileCommand::Add(vec![cube("sky.dds", 4, [9; 4])]));
    assert_eq!((session.error(), sky_name(&session)), (None, Some("sky.dds")));
    session.apply(FileCommand::Add(vec![
        File::new("flat.png", *b"not looked at"),
        cube("other.dds", 4, [9; 4]),
    ]));
    assert_eq!(session.error().map(|error| error.diagnostic.code), Some("no-model"));
    assert_eq!(sky_name(&session), Some("other.dds"));
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
