//! Loading in steps, without a session.

use std::sync::Arc;

use bindpose::model::MapSlot;
use bindpose::session::{File, FileSet, LoadJob, LoadStep, Progress};

use super::maps::{mapped, picture};
use super::models::broken;

fn job(files: Vec<File>) -> LoadJob {
    let files = Arc::new(FileSet::new(files));
    let file = files.models().first().copied().cloned().expect("a model");
    LoadJob::new(files, file)
}

#[test]
fn each_step_does_one_thing_and_the_way_to_the_end_never_grows_once_the_model_is_read() {
    let mut job = job(vec![
        mapped("a.m3d", "a.png", "none.png"),
        picture("a.png", [255, 0, 0, 255]),
        picture("stranger.png", [0, 255, 0, 255]),
    ]);
    let mut told = Vec::new();
    let loaded = loop {
        told.push(job.progress());
        match job.step() {
            LoadStep::Working(next) => job = *next,
            LoadStep::Ended(outcome) => break outcome.expect("sound files"),
        }
    };
    let [before, after_model] = [told[0], told[1]];
    assert_eq!(before.done, 0);
    // The model, two images, the end of the images, the books' verdicts.
    assert_eq!(after_model, Progress { done: 1, total: 5 });
    assert!(
        told[1..]
            .windows(2)
            .all(|two| two[0].total == two[1].total && two[0].done < two[1].done)
    );
    assert_eq!(loaded.model().file.base_name(), "a.m3d");
    assert!(loaded.maps().image(0, MapSlot::Diffuse).is_some());
}

#[test]
fn a_file_that_is_no_model_ends_the_job_in_its_first_step() {
    let LoadStep::Ended(Err(error)) = job(vec![broken("b.m3d"), picture("a.png", [0; 4])]).step() else {
        panic!("it cannot be read");
    };
    assert_eq!(error.file_name, "b.m3d");
    assert!(error.excerpt.is_some());
}
