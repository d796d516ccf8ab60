//! Palettes against the textbook for files that come with the project: every good fixture with clips, and the figure.

use std::collections::BTreeSet;
use std::path::Path;

use bindpose::format::{Parsed, parse};

use super::palette::{SMALL_TOLERANCE, greatest_error, times_of};
use crate::documents::{figure, read_parsed};

/// What f32 loses through the dozen joints from the pelvis to a finger, with rotations written to a few digits, in a figure 72 units high.
const FIGURE_TOLERANCE: f64 = 4e-4;

/// Fixtures whose keys are mended, whose clips lack bones or whose poses overflow, which the textbook does not do.
const MENDED: [&str; 5] = [
    "key_times_not_finite",
    "keys_none",
    "keys_unsorted",
    "names_repeated",
    "pose_overflows",
];

/// Findings after which the keys, or the poses, are no longer those of the textbook.
fn is_about_keys(code: &str) -> bool {
    ["key", "track-", "rotation-", "clip-bones-", "pose-overflows"]
        .iter()
        .any(|start| code.starts_with(start))
}

/// Greatest error over all clips of a file; `None` when its keys were mended.
fn error_of(parsed: &Parsed, steps: u16) -> Option<f64> {
    let (model, findings) = read_parsed(parsed);
    if findings.iter().any(|finding| is_about_keys(finding.code)) {
        return None;
    }
    let document = &parsed.document;
    let errors = (0..model.clips.len()).map(|clip| {
        let times_secs = times_of(document, clip, steps);
        greatest_error(document, &model, clip, times_secs.into_iter())
    });
    Some(errors.fold(0.0, f64::max))
}

#[test]
fn good_fixtures_pose_as_in_the_textbook() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/good");
    let mut mended = BTreeSet::new();
    let mut compared = 0;
    for entry in std::fs::read_dir(folder).expect("the fixtures are there") {
        let path = entry.expect("the folder can be read").path();
        if path.extension().is_none_or(|extension| extension != "m3d") {
            continue;
        }
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let parsed = parse(&std::fs::read(&path).expect("the fixture can be read")).expect("the fixture is good");
        if parsed.document.clips.is_empty() {
            continue;
        }
        match error_of(&parsed, 100) {
            Some(error) => {
                compared += 1;
                assert!(error <= SMALL_TOLERANCE, "{name}: {error}");
            }
            None => drop(mended.insert(name)),
        }
    }
    assert_eq!(mended, MENDED.map(str::to_owned).into());
    assert!(compared >= 10, "only {compared} fixtures have clips");
}

#[test]
fn the_figure_poses_as_in_the_textbook() {
    let parsed = figure();
    assert!(parsed.document.clips.len() > 1);
    let error = error_of(&parsed, 100).expect("its keys need no mending");
    assert!(error <= FIGURE_TOLERANCE, "{error}");
}
