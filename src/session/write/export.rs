//! What is asked about writing a file of another format, and how far that is.

use super::export_job::{ExportFormat, ExportRefusal, ExportedFile, PlannedExport};
use super::export_plan::ExportPlan;
use crate::edit::Edits;
use crate::model::{Handedness, UpAxis};
use crate::slices::{Sliced, StageProgress};

/// How a model is to be written.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExportOptions {
    /// The format.
    pub format: ExportFormat,
    /// Names of the clips to keep; `None` keeps all.
    pub clips: Option<Vec<String>>,
    /// Keeps all over where they start.
    pub in_place: bool,
    /// The part of the only clip to keep.
    pub range: ExportRange,
    /// Seconds at the end of each clip over which it is brought back to its first pose.
    pub close_loop_secs: Option<f32>,
    /// How far joints may be moved by keys that are left out, as a fraction of the bind pose's diagonal.
    pub reduce: Option<f32>,
    /// Brings it into the shape that the books' demo needs. A format of the books alone can have it.
    pub for_book: bool,
}

/// The part of a clip that is kept.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ExportRange {
    /// The timeline's, where one is set and its clip is the only one; else all of it.
    #[default]
    Timeline,
    Whole,
    /// From and to, in seconds.
    Secs([f32; 2]),
}

/// A command about writing a file.
#[derive(Clone, Debug, PartialEq)]
pub enum ExportCommand {
    /// Works out what a file of these options would be. `None` ends that, and what is being written.
    Plan(Option<Box<ExportOptions>>),
    Save,
    /// Stops writing; what would be otherwise stays known.
    Cancel,
}

/// What is planned or written. A copy of a session writes nothing.
#[derive(Debug, Default)]
pub(in crate::session) struct Exporting {
    pub(in crate::session) options: Option<ExportOptions>,
    pub(in crate::session) made: Made,
    pub(in crate::session) of: Option<Stamp>,
    pub(in crate::session) saves: bool,
    pub(in crate::session) written: Option<ExportedFile>,
}

impl Clone for Exporting {
    fn clone(&self) -> Self {
        Self::default()
    }
}

#[derive(Debug, Default)]
pub(in crate::session) enum Made {
    #[default]
    Nothing,
    Planning(Sliced<Result<PlannedExport, ExportRefusal>>),
    Planned(Box<PlannedExport>),
    Writing {
        name: String,
        plan: Box<ExportPlan>,
        work: Sliced<Result<ExportedFile, ExportRefusal>>,
    },
    Refused(String),
}

impl Made {
    /// The plan and the name of its file, once they are known.
    pub(in crate::session) fn plan(&self) -> Option<(&ExportPlan, String)> {
        match self {
            Self::Planned(planned) => Some((planned.plan(), planned.file_name())),
            Self::Writing { name, plan, .. } => Some((plan, name.clone())),
            Self::Nothing | Self::Planning(_) | Self::Refused(_) => None,
        }
    }
}

/// What a file depends on, to compare.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::session) struct Stamp {
    pub(in crate::session) format: ExportFormat,
    pub(in crate::session) edits: Edits,
    pub(in crate::session) space: (Handedness, UpAxis),
    pub(in crate::session) green_flipped: bool,
    pub(in crate::session) revisions: [u64; 5],
    pub(in crate::session) clip_count: usize,
}

/// What is known of a file that is planned or written.
#[derive(Clone, Copy, Debug)]
pub struct Export<'a> {
    /// What is asked.
    pub options: &'a ExportOptions,
    /// What would be otherwise; `None` while it is worked out.
    pub plan: Option<&'a ExportPlan>,
    /// Why it cannot be written.
    pub refusal: Option<&'a str>,
    /// How far it is, while it is written.
    pub saving: Option<StageProgress>,
}
