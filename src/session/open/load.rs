//! From the files of a drop to a model that can be shown, or to an error that can be.

use std::sync::Arc;

use super::files::{File, FileSet};
use super::maps::Maps;
use super::open_model::{JoinedFile, OpenModel};
use crate::diagnostic::{Code, Diagnostic, codes};
use crate::format::{self, Excerpt};
use crate::import;
use crate::session::published::verdicts::Verdicts;

/// A file that could not be opened.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadError {
    /// Base name of the file; empty when there was none.
    pub file_name: String,
    /// What is wrong.
    pub diagnostic: Diagnostic,
    /// The lines it is about, when it has a place.
    pub excerpt: Option<Excerpt>,
}

impl LoadError {
    /// A drop without any file that could be a model.
    pub fn no_model(files: &FileSet) -> Self {
        let unread = files.unread().next().map(File::unread_words);
        let files = files.files();
        let message = match files.len() {
            0 => "No file was dropped.",
            1 => "No model was dropped: the file is a picture. Drop it together with its model.",
            _ if files.iter().all(File::is_image) => {
                "No model was dropped: the files are all pictures. Drop them together with their model."
            }
            _ => {
                "No model was dropped: there are pictures, and no other file begins like a model. Drop them together \
                 with their model."
            }
        };
        Self {
            file_name: String::new(),
            diagnostic: codes::NO_MODEL.says(unread.unwrap_or_else(|| message.to_owned())),
            excerpt: None,
        }
    }

    /// A file that is sound, but not for what it was wanted for.
    pub(in crate::session) fn refused(file: &File, code: &Code, message: String) -> Self {
        Self {
            file_name: file.base_name().to_owned(),
            diagnostic: code.says(message),
            excerpt: None,
        }
    }

    /// The whole diagnostic as text, for the clipboard: `file:line:column: error[code]: message` and the excerpt.
    pub fn to_text(&self) -> String {
        let Diagnostic {
            severity,
            code,
            message,
            ..
        } = &self.diagnostic;
        let place = self.diagnostic.place_in_file();
        let mut text = format!("{}{place}: {severity}[{code}]: {message}\n", self.file_name);
        if let Some(excerpt) = &self.excerpt {
            text.push_str(&excerpt.to_string());
        }
        text
    }
}

/// Reads a model file.
///
/// # Errors
/// When the file is of no format that is known here, or what it says makes no model.
pub fn load(file: &File) -> Result<OpenModel, Box<LoadError>> {
    load_beside(file, &|_| None)
}

/// Reads a model file that may name others, which `find` gives.
///
/// # Errors
/// As [`load`], and when a file that it needs is not there.
pub fn load_beside(file: &File, find: &dyn Fn(&str) -> Option<Arc<[u8]>>) -> Result<OpenModel, Box<LoadError>> {
    if let Some(Err(reason)) = file.unpacked() {
        let message = format!("{} cannot be unpacked: {reason}.", file.base_name());
        return Err(Box::new(LoadError::refused(file, &codes::ARCHIVE_UNREADABLE, message)));
    }
    let imported = import::import_beside(&file.bytes, find);
    imported
        .map(|imported| OpenModel::new(file, imported))
        .map_err(|refused| {
            let diagnostic = refused.error;
            let excerpt = diagnostic
                .position
                .map(|at| format::excerpt(&file.bytes, at, diagnostic.length));
            Box::new(LoadError {
                file_name: file.base_name().to_owned(),
                diagnostic,
                excerpt,
            })
        })
}

/// Reads a model of a drop, which may name others of its files.
pub(in crate::session) fn load_among(file: &File, files: &FileSet) -> Result<OpenModel, Box<LoadError>> {
    load_beside(file, &|path| {
        files.data_beside(file, path).map(|file| Arc::clone(&file.bytes))
    })
}

/// Makes what can be shown of the files of a drop, in steps, without a session: it can run anywhere, tell how far it is, and be
/// dropped between two steps.
#[derive(Clone, Debug)]
pub struct LoadJob {
    files: Arc<FileSet>,
    file: File,
    maps: Maps,
    joined: Vec<JoinedFile>,
    state: State,
}

#[derive(Clone, Debug)]
enum State {
    Model,
    Maps(Box<OpenModel>),
    Verdicts(Box<OpenModel>),
}

/// A model with all that belongs to it, ready to be shown.
#[derive(Clone, Debug)]
pub struct Loaded {
    pub(in crate::session) files: Arc<FileSet>,
    pub(in crate::session) open: OpenModel,
    pub(in crate::session) maps: Maps,
    pub(in crate::session) verdicts: Verdicts,
}

impl Loaded {
    /// The model.
    pub fn model(&self) -> &OpenModel {
        &self.open
    }

    /// Its maps.
    pub fn maps(&self) -> &Maps {
        &self.maps
    }
}

/// How far a job is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Steps that are done.
    pub done: usize,
    /// All steps that are known of. Images are, once the model has been read.
    pub total: usize,
}

impl Progress {
    /// How much is done, rounded down.
    pub fn percent(self) -> usize {
        100 * self.done / self.total.max(1)
    }
}

/// What became of a job in a step.
#[derive(Debug)]
pub enum LoadStep {
    /// There is more to do.
    Working(Box<LoadJob>),
    Ended(Result<Box<Loaded>, Box<LoadError>>),
}

impl LoadJob {
    /// A job that opens one file of a drop, which is one of [`FileSet::models`].
    pub fn new(files: Arc<FileSet>, file: File) -> Self {
        Self {
            files,
            file,
            maps: Maps::default(),
            joined: Vec::new(),
            state: State::Model,
        }
    }

    /// Uses what an open model of the same file has: decoded images, and files whose clips joined.
    pub(in crate::session) fn reusing(mut self, maps: Maps, joined: Vec<JoinedFile>) -> Self {
        self.maps = maps;
        self.joined = joined;
        self
    }

    /// Base name of the file that it opens.
    pub fn file_name(&self) -> &str {
        self.file.base_name()
    }

    /// How far it is.
    pub fn progress(&self) -> Progress {
        // Reading the model, saying what is missing, and the books' verdicts are a step each.
        let (done, left) = match &self.state {
            State::Model => (0, 2),
            State::Maps(_) => (1, self.maps.waiting_count() + 2),
            State::Verdicts(_) => (2, 1),
        };
        let done = done + self.maps.decoded_count();
        Progress {
            done,
            total: done + left,
        }
    }

    /// Reads the model, decodes one image, or works out the books' verdicts.
    pub fn step(mut self) -> LoadStep {
        match self.state {
            State::Model => match load_among(&self.file, &self.files) {
                Err(error) => LoadStep::Ended(Err(error)),
                Ok(mut open) => {
                    open.join_again(&self.joined);
                    let pictures = self.files.images().chain(&open.pictures).cloned();
                    self.maps.begin(&open.model.materials, pictures);
                    self.state = State::Maps(Box::new(open));
                    LoadStep::Working(Box::new(self))
                }
            },
            State::Maps(open) => {
                let is_last = !self.maps.decode_next();
                if is_last {
                    self.maps.conclude(&open.model.materials);
                }
                self.state = if is_last {
                    State::Verdicts(open)
                } else {
                    State::Maps(open)
                };
                LoadStep::Working(Box::new(self))
            }
            State::Verdicts(mut open) => {
                let verdicts = Verdicts::default();
                verdicts.of(&open, &self.maps);
                open.source.forget();
                LoadStep::Ended(Ok(Box::new(Loaded {
                    files: self.files,
                    open: *open,
                    maps: self.maps,
                    verdicts,
                })))
            }
        }
    }

    /// Does all steps.
    ///
    /// # Errors
    /// As [`load`] has them: images that cannot be read are no reason to fail.
    pub fn run(mut self) -> Result<Box<Loaded>, Box<LoadError>> {
        loop {
            match self.step() {
                LoadStep::Working(job) => self = *job,
                LoadStep::Ended(outcome) => return outcome,
            }
        }
    }
}
