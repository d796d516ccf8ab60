//! From the files of a drop to a model that can be shown, or to an error that can be.

use std::sync::Arc;

use super::files::{File, FileSet};
use super::maps::Maps;
use super::open_model::{JoinedFile, OpenModel};
use crate::diagnostic::{Code, Diagnostic, codes};
use crate::format::{self, Excerpt};
use crate::import;
use crate::session::published::verdicts::{Verdicts, missing_maps};
use crate::slices::{Slices, Stage, at_once};
use crate::sorting;

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
pub fn load_beside(file: &File, find: &dyn Fn(&str) -> Option<bytes::Bytes>) -> Result<OpenModel, Box<LoadError>> {
    let alone = FileSet::new([file.clone()]);
    at_once(load_in(file, &alone, find, &Slices::ENDLESS))
}

async fn load_in(
    file: &File,
    files: &FileSet,
    find: &dyn Fn(&str) -> Option<bytes::Bytes>,
    slices: &Slices,
) -> Result<OpenModel, Box<LoadError>> {
    if let Some(reason) = files.damage(file) {
        let message = format!("{} cannot be unpacked: {reason}.", file.base_name());
        return Err(Box::new(LoadError::refused(file, &codes::ARCHIVE_UNREADABLE, message)));
    }
    match import::import_in(&file.bytes, find, slices).await {
        Ok(imported) => Ok(OpenModel::new(file, imported, slices).await),
        Err(refused) => {
            let diagnostic = refused.of_extension(&file.extension()).error;
            let excerpt = diagnostic
                .position
                .map(|at| format::excerpt(&file.bytes, at, diagnostic.length));
            Err(Box::new(LoadError {
                file_name: file.base_name().to_owned(),
                diagnostic,
                excerpt,
            }))
        }
    }
}

/// Reads a model of a drop, which may name others of its files.
pub(in crate::session) async fn load_among(
    file: &File,
    files: &FileSet,
    slices: &Slices,
) -> Result<OpenModel, Box<LoadError>> {
    let find = |path: &str| files.data_beside(file, path).map(|file| file.bytes.clone());
    load_in(file, files, &find, slices).await
}

/// A model with all that belongs to it: what is open, or what can be shown.
#[derive(Clone, Debug)]
pub(in crate::session) struct Loaded {
    /// The files that it came with.
    pub(in crate::session) files: Arc<FileSet>,
    pub(in crate::session) open: Arc<OpenModel>,
    pub(in crate::session) maps: Maps,
    pub(in crate::session) verdicts: Verdicts,
}

impl Loaded {
    /// Whether reading a file would give the same model once more: it is the same by its bytes, and so is all that it names.
    async fn is_same(&self, files: &FileSet, file: &File, slices: &Slices) -> bool {
        let open = &self.open;
        let is_alone = open.joined.is_empty();
        if !is_alone || open.file.path != file.path || !are_same(&open.file.bytes, &file.bytes, slices).await {
            return false;
        }
        for path in import::files_beside(&file.bytes) {
            let bytes = [&self.files, files].map(|files| Some(&*files.data_beside(file, &path)?.bytes));
            let [Some(before), Some(now)] = bytes else { return false };
            if !are_same(before, now, slices).await {
                return false;
            }
        }
        true
    }
}

async fn are_same(a: &[u8], b: &[u8], slices: &Slices) -> bool {
    if std::ptr::eq(a, b) {
        return true;
    }
    let mut are_same = a.len() == b.len();
    for (a, b) in a.chunks(1 << 20).zip(b.chunks(1 << 20)) {
        slices.pause().await;
        are_same = are_same && a == b;
    }
    are_same
}

/// The motions of a drop, as Mixamo gives them, join after those of before; one of the same name takes its place.
fn join_motions(files: &FileSet, joined: &mut Vec<JoinedFile>) {
    let mut motions = files.motions();
    sorting::sort_by_key(&mut motions, |motion| motion.path.to_lowercase());
    for motion in motions {
        let now = JoinedFile::of(motion, files);
        let same = |joined: &&mut JoinedFile| joined.file.base_name() == motion.base_name();
        match joined.iter_mut().find(same) {
            Some(before) => *before = now,
            None => joined.push(now),
        }
    }
}

async fn read_whole(
    files: &FileSet,
    file: &File,
    joined: &[JoinedFile],
    slices: &Slices,
) -> Result<OpenModel, Box<LoadError>> {
    let of_clips = joined
        .iter()
        .map(|joined| (Some(Stage::Joining), joined.file.bytes.len()));
    let sizes: Vec<_> = [(None, file.bytes.len())].into_iter().chain(of_clips).collect();
    let of_files = slices.for_files(
        Stage::Reading..=Stage::Checking,
        Stage::Reading..=Stage::Joining,
        &sizes,
    );
    let mut open = load_among(file, files, &of_files[0]).await?;
    for (joined, slices) in joined.iter().zip(&of_files[1..]) {
        open.join_again(joined, slices).await;
    }
    open.extent_in(open.first_clip(), slices).await;
    Ok(open)
}

/// Opens one file of a drop, which is one of [`FileSet::models`], with all that belongs to it. Of what was open before of the same file, joined
/// clips stay, and all that would be the same again. `maps` has pictures that are there, some of them decoded.
pub(in crate::session) async fn load_whole(
    files: Arc<FileSet>,
    file: &File,
    mut maps: Maps,
    before: Option<Loaded>,
    slices: &Slices,
) -> Result<Box<Loaded>, Box<LoadError>> {
    let mut joined = before.as_ref().map_or(Vec::new(), |before| before.open.joined.clone());
    join_motions(&files, &mut joined);
    let (mut open, same) = match &before {
        Some(before) if joined.is_empty() && before.is_same(&files, file, slices).await => {
            (Arc::clone(&before.open), Some(before))
        }
        _ => (Arc::new(read_whole(&files, file, &joined, slices).await?), None),
    };
    let pictures = files.images().chain(&open.pictures).cloned();
    maps.add_in(&open.model.materials, pictures, slices).await;
    let of_same = same.filter(|before| missing_maps(&before.maps) == missing_maps(&maps));
    let verdicts = of_same.map_or_else(Verdicts::default, |before| before.verdicts.clone());
    verdicts.of_in(&open, &maps, slices).await;
    if let Some(open) = Arc::get_mut(&mut open) {
        open.source.forget();
    }
    Ok(Box::new(Loaded {
        files,
        open,
        maps,
        verdicts,
    }))
}
