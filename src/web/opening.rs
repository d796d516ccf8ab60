//! Opening files: those of a drop, clips for the open model, and beginning anew.

use std::rc::Rc;
use std::sync::Arc;

use js_sys::{Array, Promise, Uint8Array};
use wasm_bindgen::prelude::*;

use super::shared::Shared;
use super::viewer::Viewer;
use super::{abort_error, field, next_task, promise, reduced_motion};
use crate::session::{File, FileCommand, LoadJob, LoadStep};

/// Why an opening failed that was followed by another one, or by the viewer's end.
const OVERTAKEN: &str = "another opening came after this one";

#[wasm_bindgen]
impl Viewer {
    /// Opens files: an array of `{name, bytes}` with relative paths as names. The largest model opens, in steps between which the
    /// page goes on; what was open stays until then. Resolves with the state, which has a failure in its `error`. Rejects when
    /// something else was opened meanwhile, or the viewer was freed.
    ///
    /// # Errors
    /// When an entry is not of that shape.
    pub fn open(&self, files: &Array) -> Result<Promise, JsError> {
        let opening = self.shared.begin_opening(files_of(files)?);
        let shared = Rc::clone(&self.shared);
        Ok(promise(async move {
            if let Some(opening) = opening {
                shared.end_opening(opening).await?;
            }
            Ok::<_, JsValue>(shared.state())
        }))
    }

    /// Adds the clips of models with the same bones to the open one: an array as [`Viewer::open`] takes it. Without an open model it
    /// opens them. A failure is in the state's `error`. Returns the state.
    ///
    /// # Errors
    /// When an entry is not of that shape.
    #[wasm_bindgen(js_name = addClips)]
    pub fn add_clips(&self, files: &Array) -> Result<JsValue, JsError> {
        self.shared.apply(FileCommand::AddClips(files_of(files)?));
        Ok(self.state())
    }

    /// Opens one of the state's `models` again, by its path. Returns whether it is listed.
    ///
    /// # Errors
    /// When the path is no text.
    #[wasm_bindgen(js_name = openModel)]
    pub fn open_model(&self, path: &JsValue) -> Result<bool, JsValue> {
        self.shared.apply_to_listed("openModel", path, FileCommand::Open)
    }

    /// Closes one of the state's `models`, by its path, unless it is the only one. Returns whether it is listed.
    ///
    /// # Errors
    /// When the path is no text.
    #[wasm_bindgen(js_name = closeModel)]
    pub fn close_model(&self, path: &JsValue) -> Result<bool, JsValue> {
        self.shared.apply_to_listed("closeModel", path, FileCommand::Close)
    }

    /// Begins anew, as a new viewer does: every choice is forgotten and these files are opened, an array as [`Viewer::open`] takes
    /// it. What the GPU has compiled stays. Returns the state.
    ///
    /// # Errors
    /// When an entry is not of that shape.
    #[wasm_bindgen(js_name = startOver)]
    pub fn start_over(&self, files: &Array) -> Result<JsValue, JsError> {
        let files = files_of(files)?;
        self.shared.session.borrow_mut().start_over(reduced_motion());
        if let Some(running) = &*self.shared.running.borrow()
            && let Some(app) = running.app.borrow_mut().as_mut()
        {
            app.start_over(&running.ctx);
        }
        if files.is_empty() {
            self.shared.tell_of_changes();
        } else {
            self.shared.apply(FileCommand::Add(files));
        }
        Ok(self.state())
    }
}

/// A drop that is being opened, and its number among the openings of its session.
struct Opening {
    job: LoadJob,
    number: u64,
}

impl Shared {
    /// Applies a command with the path of a listed model.
    fn apply_to_listed(&self, call: &str, path: &JsValue, command: fn(String) -> FileCommand) -> Result<bool, JsValue> {
        let is_listed = |path: &str| self.session.borrow().models().iter().any(|file| file.path == path);
        self.apply_named(call, path, |path| is_listed(path).then(|| path.to_owned()), command)
    }

    /// Begins to open a drop, at once. A drop without a model is taken whole, and nothing is left to do.
    fn begin_opening(&self, files: Vec<File>) -> Option<Opening> {
        let job = self.session.borrow_mut().begin_opening(files.clone());
        if job.is_none() {
            self.apply(FileCommand::Add(files));
        }
        let number = self.session.borrow().openings();
        job.map(|job| Opening { job, number })
    }

    /// Does the steps of an opening, each in a task of its own. The session is borrowed only for a moment, never across a step.
    async fn end_opening(&self, Opening { mut job, number }: Opening) -> Result<(), JsValue> {
        let outcome = loop {
            next_task().await;
            if self.is_silenced() || self.session.borrow().openings() != number {
                return Err(abort_error(OVERTAKEN));
            }
            match job.step() {
                LoadStep::Working(next) => job = *next,
                LoadStep::Ended(outcome) => break outcome,
            }
        };
        self.session.borrow_mut().end_opening(outcome);
        self.tell_of_changes();
        Ok(())
    }
}

/// Copies bytes of the page into the program's memory, once.
fn copied(bytes: &Uint8Array) -> Arc<[u8]> {
    let mut copy: Arc<[u8]> = std::iter::repeat_n(0, bytes.length() as usize).collect();
    if let Some(copy) = Arc::get_mut(&mut copy) {
        bytes.copy_to(copy);
    }
    copy
}

/// Files of `{name, bytes}` records.
fn files_of(records: &Array) -> Result<Vec<File>, JsError> {
    let mut files = Vec::new();
    for record in records.iter() {
        let name = field(&record, "name")
            .as_string()
            .ok_or_else(|| JsError::new("a file needs a name"))?;
        let bytes: Uint8Array = field(&record, "bytes")
            .dyn_into()
            .map_err(|_| JsError::new(&format!("{name} needs its bytes as Uint8Array")))?;
        files.push(File::new(&name, copied(&bytes)));
    }
    Ok(files)
}
