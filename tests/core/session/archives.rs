//! A `.zip` among dropped files is its folder.

use std::io::{Cursor, Write as _};

use bindpose::image::encode_png;
use bindpose::session::{ExportFormat, ExportOptions, File, FileCommand, Session};
use proptest::prelude::*;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::dropped;
use super::models::{broken, document, file, still};

/// An archive of these files.
pub(super) fn zipped(path: &str, method: CompressionMethod, files: &[(&str, &[u8])]) -> File {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(method);
    for (name, bytes) in files {
        if name.ends_with('/') {
            writer.add_directory(*name, options).expect("a folder");
            continue;
        }
        writer.start_file(*name, options).expect("a file");
        writer.write_all(bytes).expect("its bytes");
    }
    File::new(path, writer.finish().expect("an archive").into_inner())
}

/// A model with a map in a folder beside it, as [`zipped`] takes it.
fn model_and_map() -> [(String, Vec<u8>); 2] {
    let mut document = document();
    document.materials[0].diffuse_map = Some("coats/red.png".to_owned());
    let png = encode_png(&[255, 0, 0, 255], 1, 1).expect("a picture");
    let model = file("box.m3d", &document);
    [
        ("art/box.m3d".to_owned(), model.bytes.to_vec()),
        ("art/coats/red.png".to_owned(), png),
    ]
}

/// The code and the message of the error on show.
fn error(session: &Session) -> (&str, &str) {
    let error = session.error().expect("it is refused");
    (error.diagnostic.code, &error.diagnostic.message)
}

#[test]
fn an_archive_is_opened_as_its_folder() {
    let files = model_and_map();
    let hidden: [(&str, &[u8]); 4] = [
        ("art/", b""),
        ("__MACOSX/art/._box.m3d", b"not a model"),
        (".DS_Store", b"nothing"),
        ("art/notes.txt", b"By somebody."),
    ];
    for method in [CompressionMethod::Stored, CompressionMethod::Deflated] {
        let entries = files.iter().map(|(name, bytes)| (name.as_str(), &bytes[..]));
        let entries: Vec<_> = hidden.into_iter().chain(entries).collect();
        let session = dropped(vec![zipped("drop/box.ZIP", method, &entries)]);
        assert_eq!(session.error(), None);
        let open = session.open_model().expect("the model in it");
        assert_eq!(open.file.path, "drop/art/box.m3d");
        assert_eq!(session.models().len(), 1);
        assert_eq!(session.maps().used().count(), 1);
    }
}

#[test]
fn what_is_exported_with_its_maps_is_opened_again() {
    let files = model_and_map();
    let session = dropped(files.map(|(name, bytes)| File::new(&name, bytes)).to_vec());
    let options = ExportOptions {
        format: ExportFormat::D3d11,
        ..ExportOptions::default()
    };
    let exported = session.export_job(&options).expect("a model is open").run();
    let exported = exported.expect("it can be written");
    assert_eq!(exported.name, "box-d3d11.zip");
    let again = dropped(vec![File::new(&exported.name, exported.bytes)]);
    assert_eq!(again.error(), None);
    let [before, after] = [&session, &again].map(|session| session.open_model().expect("a model"));
    assert_eq!(before.model.mesh.positions, after.model.mesh.positions);
    assert_eq!(after.file.base_name(), "box-d3d11.m3d");
    assert_eq!(again.maps().used().count(), 1);
}

#[test]
fn an_archive_beside_a_model_brings_its_maps() {
    let [(_, model), (map, picture)] = model_and_map();
    let coats = zipped("coats.zip", CompressionMethod::Deflated, &[(&map, &picture)]);
    let session = dropped(vec![File::new("box.m3d", model), coats]);
    assert_eq!((session.error(), session.maps().used().count()), (None, 1));
}

#[test]
fn an_archive_that_cannot_be_unpacked_is_refused_with_its_reason() {
    let files: [(&str, &[u8]); 1] = [("box.m3d", &still("box.m3d").bytes)];
    let sound = zipped("box.zip", CompressionMethod::Deflated, &files);
    // Flags and method stand 6 and 8 bytes after the beginning of a local header, and 2 more in the directory at the end.
    let patched = |place: usize, value: u8| {
        let mut bytes = sound.bytes.to_vec();
        let directory = bytes
            .windows(4)
            .rposition(|four| four == b"PK\x01\x02")
            .expect("a directory");
        bytes[place] = value;
        bytes[directory + place + 2] = value;
        File::new("box.zip", bytes)
    };
    let mut damaged = sound.bytes.to_vec();
    for byte in &mut damaged[60..70] {
        *byte ^= 0x55;
    }
    let nothing = zipped("box.zip", CompressionMethod::Stored, &[("art/", b"")]);
    for (archive, reason) in [
        (patched(6, 1), "box.zip cannot be unpacked: box.m3d in it is encrypted."),
        (
            patched(8, 14),
            "box.m3d in it is packed by method 14, which is not read.",
        ),
        (File::new("box.zip", damaged), "box.m3d in it is damaged: "),
        (
            File::new("box.zip", sound.bytes[..200].to_vec()),
            "box.zip cannot be unpacked: it is damaged: ",
        ),
        (nothing, "box.zip cannot be unpacked: there is no file in it."),
    ] {
        let mut session = dropped(vec![still("open.m3d")]);
        session.apply(FileCommand::Add(vec![archive]));
        let (code, message) = error(&session);
        assert_eq!(code, "archive-unreadable");
        assert!(message.contains(reason), "{message}");
        let open = session.open_model().expect("what was open stays");
        assert_eq!(open.file.path, "open.m3d");
    }
}

#[test]
fn files_in_an_archive_are_refused_as_other_files() {
    let bad = broken("bad.m3d");
    let archive = zipped("a.zip", CompressionMethod::Deflated, &[("bad.m3d", &bad.bytes)]);
    let session = dropped(vec![archive]);
    let refused = dropped(vec![bad]);
    assert_eq!(error(&session), error(&refused));
    let pictures = zipped("a.zip", CompressionMethod::Stored, &[("a.dds", b"-"), ("b.png", b"-")]);
    assert_eq!(error(&dropped(vec![pictures])).0, "no-model");
    // Other formats are archives too, but no folders of models.
    let sheet = zipped("a.xlsx", CompressionMethod::Stored, &[("a.xml", b"-")]);
    assert!(error(&dropped(vec![sheet])).1.contains("ZIP archive"));
}

proptest! {
    #![proptest_config(crate::properties::cases(300))]

    #[test]
    fn no_damage_to_an_archive_breaks_anything(
        places in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        length in any::<prop::sample::Index>(),
        is_cut in any::<bool>(),
    ) {
        let files = model_and_map();
        let entries: Vec<_> = files.iter().map(|(name, bytes)| (name.as_str(), &bytes[..])).collect();
        let mut bytes = zipped("a.zip", CompressionMethod::Deflated, &entries).bytes.to_vec();
        for (place, value) in places {
            let place = place.index(bytes.len());
            bytes[place] = value;
        }
        if is_cut {
            bytes.truncate(length.index(bytes.len()));
        }
        let session = dropped(vec![File::new("a.zip", bytes)]);
        prop_assert!(session.error().is_some() != session.open_model().is_some());
    }
}
