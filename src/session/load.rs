//! From one file's bytes to a model that can be shown, or to an error that can be.

use glam::Vec3;

use crate::anim;
use crate::diagnostic::{Diagnostic, Severity};
use crate::format::{self, Dialect, Excerpt};
use crate::model::Model;
use crate::scene::Aabb;

use super::clips::ClipFacts;
use super::files::{File, FileSet};
use super::joining::JoinedFile;

/// A model that is on screen, with the file it came from.
#[derive(Clone, Debug)]
pub struct OpenModel {
    /// The file.
    pub file: File,
    /// Spelling of the file.
    pub dialect: Dialect,
    /// The model, in the file's space.
    pub model: Model,
    /// What was mended or is worth knowing, in the order of the file.
    pub notices: Vec<Diagnostic>,
    /// Box of the bind pose, in the file's space.
    pub bind_bounds: Aabb,
    bind_points: Vec<Vec3>,
    /// One for each clip of the model.
    pub(super) clip_facts: Vec<ClipFacts>,
    /// Files whose clips joined, in their order.
    pub(super) joined: Vec<JoinedFile>,
}

impl OpenModel {
    /// The space that a clip needs; the bind pose's without a clip.
    pub fn extent(&self, clip: Option<usize>) -> (Aabb, &[Vec3]) {
        let index = clip.unwrap_or(usize::MAX);
        match (self.model.clips.get(index), self.clip_facts.get(index)) {
            (Some(clip), Some(facts)) => facts.extent(&self.model, clip),
            _ => (self.bind_bounds, &self.bind_points),
        }
    }

    /// Lines of the file around a finding.
    pub fn excerpt(&self, diagnostic: &Diagnostic) -> Option<Excerpt> {
        let position = diagnostic.position?;
        Some(format::excerpt(&self.file.bytes, position, diagnostic.length))
    }
}

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
        let files = files.files();
        let message = match files.len() {
            0 => "No file was dropped.",
            1 => "No .m3d model was dropped: the file is a picture. Drop it together with its model.",
            _ if files.iter().all(File::is_image) => {
                "No .m3d model was dropped: the files are all pictures. Drop them together with their model."
            }
            _ => {
                "No .m3d model was dropped: there are pictures, and no other file begins like a model. Drop them together \
                 with their model."
            }
        }
        .to_owned();
        Self {
            file_name: String::new(),
            diagnostic: Diagnostic::without_place(Severity::Error, "no-model", message),
            excerpt: None,
        }
    }

    /// The whole finding as text, for the clipboard: `file:line:column: error[code]: message` and the excerpt.
    pub fn to_text(&self) -> String {
        let Diagnostic {
            severity,
            code,
            message,
            position,
            ..
        } = &self.diagnostic;
        let place = position
            .map(|p| format!(":{}:{}", p.line, p.column))
            .unwrap_or_default();
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
/// When the text is not the format, or what it says makes no model.
pub fn load(file: &File) -> Result<OpenModel, Box<LoadError>> {
    let fail = |diagnostic: Diagnostic| {
        let excerpt = diagnostic
            .position
            .map(|at| format::excerpt(&file.bytes, at, diagnostic.length));
        Box::new(LoadError {
            file_name: file.base_name().to_owned(),
            diagnostic,
            excerpt,
        })
    };
    let parsed = format::parse(&file.bytes).map_err(|error| fail(error.diagnostic()))?;
    let (model, model_notices) =
        Model::from_document(&parsed.document, &parsed.lines).map_err(|error| fail(error.diagnostic()))?;
    let mut notices = parsed.notices;
    notices.extend(model_notices);
    notices.sort_by_key(|notice| notice.position);
    let bind_bounds = model.bind_bounds();
    let bind_points = anim::extreme_points(&model, None);
    let clip_facts = vec![ClipFacts::of_file(file.base_name()); model.clips.len()];
    Ok(OpenModel {
        file: file.clone(),
        dialect: parsed.document.dialect,
        model,
        notices,
        bind_bounds,
        bind_points,
        clip_facts,
        joined: Vec::new(),
    })
}
