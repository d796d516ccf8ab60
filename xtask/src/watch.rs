//! Waiting until a source file changes.

use std::fs;
use std::path::Path;
use std::thread;
use std::time::{Duration, SystemTime};

/// Often enough to feel at once, seldom enough to cost nothing.
const INTERVAL: Duration = Duration::from_millis(400);

/// What the wasm is built from, in the repository's folder. The files of `web/` are read afresh for each request.
const WATCHED: [&str; 4] = ["src", "shaders", "Cargo.toml", "Cargo.lock"];

/// Remembers how the sources were when they were last looked at.
#[derive(Debug)]
pub(crate) struct Watch {
    seen: State,
}

/// How many files there are and when the youngest was written: an edit, a new and a removed file all change it.
type State = (usize, Option<SystemTime>);

impl Watch {
    /// Starts from the sources as they are now.
    pub(crate) fn new() -> Self {
        Self { seen: look() }
    }

    /// Returns when the sources differ from how they were at the last return.
    pub(crate) fn wait(&mut self) {
        loop {
            thread::sleep(INTERVAL);
            let now = look();
            if now != self.seen {
                self.seen = now;
                return;
            }
        }
    }
}

fn look() -> State {
    let mut state = (0, None);
    for name in WATCHED {
        add(&crate::root().join(name), &mut state);
    }
    state
}

fn add(path: &Path, state: &mut State) {
    // A file that vanished between the listing and here counts as gone.
    let Ok(metadata) = fs::metadata(path) else { return };
    if metadata.is_dir() {
        for entry in fs::read_dir(path).into_iter().flatten().flatten() {
            add(&entry.path(), state);
        }
    } else {
        state.0 += 1;
        state.1 = state.1.max(metadata.modified().ok());
    }
}
