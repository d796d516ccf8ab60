//! Files of a drop: their paths, which is what by its name, and which of them are models.

use std::path::Path;

use bindpose::session::{FILE_KINDS, File, FileCommand, FileKind, FileSet};

use super::models;

fn source(path: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("a file of the page")
}

#[test]
fn the_page_and_the_program_have_one_table_of_kinds() {
    let rows: Vec<String> = FILE_KINDS
        .iter()
        .map(|(kind, extensions)| {
            let extensions: Vec<String> = extensions.iter().map(|extension| format!("\"{extension}\"")).collect();
            format!("  {}: [{}],", format!("{kind:?}").to_lowercase(), extensions.join(", "))
        })
        .collect();
    let table = format!("const KINDS = {{\n{}\n}};\n", rows.join("\n"));
    assert!(source("web/files.js").contains(&table), "web/files.js has not\n{table}");
}

#[test]
fn no_other_place_of_the_page_lists_extensions() {
    let (_, extensions) = FILE_KINDS[0];
    for path in [
        "index.html",
        "web/api.js",
        "web/boot.js",
        "web/drop.js",
        "web/sources.js",
    ] {
        let text = source(path);
        assert!(!text.contains("accept=\""), "{path}");
        for extension in extensions.iter().filter(|&&extension| extension != "m3d") {
            assert!(
                !text.contains(&format!("|{extension}")) && !text.contains(&format!(".{extension},")),
                "{path}"
            );
        }
    }
}

#[test]
fn a_name_says_what_a_file_is() {
    for (name, kind) in [
        ("in/Soldier.M3D", Some(FileKind::Model)),
        ("fox.gltf", Some(FileKind::Model)),
        ("fox.bin", Some(FileKind::Buffer)),
        ("Pack.ZIP", Some(FileKind::Archive)),
        ("skin.JPeg", Some(FileKind::Picture)),
        ("studio.hdr", Some(FileKind::Picture)),
        ("studio.exr", Some(FileKind::Unread)),
        ("readme.txt", Some(FileKind::Text)),
        ("readme.md", None),
        ("m3d", None),
    ] {
        assert_eq!(File::new(name, []).kind(), kind, "{name}");
    }
}

fn file(path: &str, len: usize) -> File {
    File::new(path, vec![0; len])
}

#[test]
fn paths_have_one_form_and_names_are_their_last_part() {
    let file = file("\\media\\Soldier.M3D", 1);
    assert_eq!(
        (file.path.as_str(), file.base_name()),
        ("media/Soldier.M3D", "Soldier.M3D")
    );
    assert_eq!(file.extension(), "m3d");
    assert_eq!(File::new("./a", []).path, "a");
    assert_eq!(File::new("README", []).extension(), "");
}

#[test]
fn models_come_largest_first_and_pictures_are_none() {
    let set = FileSet::new([
        file("a.m3d", 3),
        file("t/b.dds", 100),
        file("c.m3d", 9),
        file("notes.txt", 50),
    ]);
    assert_eq!(
        set.models().iter().map(|f| f.base_name()).collect::<Vec<_>>(),
        ["c.m3d", "a.m3d"]
    );
    assert_eq!(set.images().count(), 1);
}

#[test]
fn a_text_is_a_model_where_it_begins_like_one_and_without_any_all_but_pictures_is_tried() {
    let names = |files: &[File]| {
        let set = FileSet::new(files.iter().cloned());
        set.models()
            .iter()
            .map(|f| f.base_name().to_owned())
            .collect::<Vec<_>>()
    };
    let model = File::new("model.txt", *b"***m3d-File-Header***\n#Materials 1\n");
    let (picture, notes, named) = (file("a.png", 3), file("notes.txt", 100), file("a.m3d", 3));
    assert_eq!(names(&[notes.clone(), model.clone()]), ["model.txt"]);
    assert_eq!(
        names(std::slice::from_ref(&notes)),
        ["notes.txt"],
        "it is told what it is"
    );
    assert_eq!(
        names(&[notes.clone(), named.clone(), model.clone()]),
        ["model.txt", "a.m3d"]
    );
    let renamed = File::new("model.old", model.bytes.to_vec());
    assert_eq!(names(&[named, renamed.clone()]), ["a.m3d"]);
    assert_eq!(names(&[notes.clone(), renamed.clone()]), ["notes.txt", "model.old"]);
    assert_eq!(names(&[picture.clone(), notes.clone(), renamed]), ["model.old"]);
    assert_eq!(names(&[picture.clone(), notes.clone(), model]), ["model.txt"]);
    assert!(names(&[picture.clone(), notes]).is_empty());
    assert!(names(&[picture]).is_empty());
}

#[test]
fn when_the_last_model_of_a_drop_is_closed_no_other_file_of_it_is_taken_for_one() {
    let renamed = File::new("model.old", models::still("a.m3d").bytes);
    let mut session = super::opened(models::still("b.m3d"));
    session.apply(FileCommand::Add(vec![
        models::still("a.m3d"),
        file("a.png", 3),
        renamed,
    ]));
    session.apply(FileCommand::Close("a.m3d".to_owned()));
    assert_eq!(
        session.models().iter().map(|file| file.base_name()).collect::<Vec<_>>(),
        ["b.m3d"]
    );
}

#[test]
fn the_later_of_two_files_with_one_path_is_kept() {
    let set = FileSet::new([file("a.m3d", 3), file("a.m3d", 4)]);
    assert_eq!(set.files().len(), 1);
    assert_eq!(set.get("a.m3d").map(|f| f.bytes.len()), Some(4));
}
