//! Files that are damaged: reading them takes memory by their size.

use std::hint::black_box;

use bindpose::import::import;

use crate::measured;
use crate::shared::shared;

/// How many times the file reading it may hold at once, beside what a model of one triangle takes.
const MOST_GROWTH: u64 = 20;
const LEAST: u64 = 1 << 16;

#[test]
fn damaged_fbx_takes_no_more_memory_than_twenty_times_the_file() {
    let Some(folder) = shared("fbx/damaged") else { return };
    let paths = std::fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path());
    let mut told = Vec::new();
    let mut count = 0;
    for path in paths.filter(|path| path.extension().is_some_and(|extension| extension == "fbx")) {
        let bytes = std::fs::read(&path).expect("a file");
        let held = measured(|| match black_box(import(&bytes)) {
            Ok(imported) => assert!(imported.model.mesh.indices.len().is_multiple_of(3)),
            Err(refused) => assert!(!refused.error.message.is_empty(), "{}", path.display()),
        });
        count += 1;
        if held.peak_bytes > LEAST + MOST_GROWTH * bytes.len() as u64 {
            told.push(format!("{}: {} for {}", path.display(), held.peak_bytes, bytes.len()));
        }
    }
    assert!(told.is_empty(), "{} of {count}:\n{}", told.len(), told.join("\n"));
    assert!(count > 50, "{count}");
}
