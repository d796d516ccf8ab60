//! Tests of `format`.

mod damage;
mod excerpt;
mod fixtures;
mod likeness;
mod limits;
mod numbers;
mod real_files;
mod text_model;
mod values;
mod write;

pub(crate) use write::document as written_documents;

use std::path::{Path, PathBuf};

use bindpose::diagnostic::Diagnostic;

/// A fixture, by its folder (`good` or `bad`) and its name without the extension.
pub(crate) struct Fixture {
    pub(crate) name: String,
    pub(crate) path: PathBuf,
    pub(crate) bytes: Vec<u8>,
}

/// All fixtures of a folder, in the order of their names.
pub(crate) fn fixtures(folder: &str) -> Vec<Fixture> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/fixtures")
        .join(folder);
    let mut fixtures: Vec<_> = std::fs::read_dir(&folder)
        .expect("the fixtures are there")
        .map(|entry| entry.expect("the folder can be read").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "m3d"))
        .map(|path| {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let bytes = std::fs::read(&path).expect("the fixture can be read");
            Fixture { name, path, bytes }
        })
        .collect();
    assert!(!fixtures.is_empty(), "{} holds no fixtures", folder.display());
    fixtures.sort_by(|a, b| a.name.cmp(&b.name));
    fixtures
}

/// The bytes of one good fixture.
fn good(name: &str) -> Vec<u8> {
    let fixture = fixtures("good").into_iter().find(|fixture| fixture.name == name);
    fixture.unwrap_or_else(|| panic!("no fixture good/{name}.m3d")).bytes
}

/// The bytes of a real file, where those are at hand.
fn real_file(path: &str) -> Option<Vec<u8>> {
    crate::documents::shared_bytes(path)
}

/// `severity[code] line:column: message`
pub(crate) fn one_line(diagnostic: &Diagnostic) -> String {
    let place = diagnostic
        .position
        .map_or_else(String::new, |place| format!("{}:{}: ", place.line, place.column));
    format!(
        "{}[{}] {place}{}",
        diagnostic.severity, diagnostic.code, diagnostic.message
    )
}
