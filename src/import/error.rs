//! Why what a file says makes no model.

use crate::diagnostic::collect::line_start;
use crate::diagnostic::{Diagnostic, Position, Subject, codes};
use crate::model::ModelError;

/// A file that names what does not exist, or a hierarchy that has no order.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{kind}", self.position.map(|position| format!("{position}: ")).unwrap_or_default())]
pub struct ImportError {
    /// Where the file says it, when there is a file.
    pub position: Option<Position>,
    /// Which rule it breaks.
    pub kind: ImportErrorKind,
}

/// The rules that a reader of files proves. Bones carry the file's numbers.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ImportErrorKind {
    /// A parent that is neither −1 nor a bone.
    #[error("Bone {bone} lists {parent} as its parent; a parent is −1 or a bone below {bone_count}.")]
    ParentOutOfRange {
        /// The child.
        bone: u32,
        /// What the file gives as its parent.
        parent: i32,
        /// Number of bones.
        bone_count: u32,
    },
    /// Bones that are their own ancestors.
    #[error("Bones form a circle: {}.", circle(.bones))]
    ParentCycle {
        /// Each bone is the child of the next, the last of the first.
        bones: Vec<u32>,
    },
    /// Offsets and parents do not pair up.
    #[error("{offsets} bone offsets but {parents} parents; every bone has one of each.")]
    BoneCountMismatch {
        /// Rows of `BoneOffsets`.
        offsets: usize,
        /// Rows of `BoneHierarchy`.
        parents: usize,
    },
    /// A vertex gives weight to a bone that is not there.
    #[error("Vertex {vertex} gives weight to bone {bone}, but there are {bone_count} bones.")]
    InfluenceOutOfRange {
        /// Index of the vertex in the file.
        vertex: u32,
        /// The bone it names.
        bone: u32,
        /// Number of bones.
        bone_count: u32,
    },
    /// A rule of the model itself.
    #[error(transparent)]
    Model(#[from] ModelError),
}

impl ImportError {
    /// The same as a diagnostic, for panels and outputs.
    pub fn diagnostic(&self) -> Diagnostic {
        Diagnostic {
            position: self.position,
            places: self.position.into_iter().collect(),
            ..self.kind.diagnostic()
        }
    }
}

/// A broken rule without a place in a file.
impl From<ModelError> for ImportError {
    fn from(rule: ModelError) -> Self {
        ImportErrorKind::from(rule).on_line(None)
    }
}

impl ImportErrorKind {
    /// This rule, broken on a line of the file; `None` where there is no file.
    pub(super) fn on_line(self, line: Option<u32>) -> ImportError {
        ImportError {
            position: line.map(line_start),
            kind: self,
        }
    }

    fn diagnostic(&self) -> Diagnostic {
        let (code, subject, expected, found) = match *self {
            Self::ParentOutOfRange {
                bone,
                parent,
                bone_count,
            } => (
                &codes::PARENT_OUT_OF_RANGE,
                Some(Subject::Bone(bone)),
                Some(format!("−1 or a bone below {bone_count}")),
                Some(parent.to_string()),
            ),
            Self::ParentCycle { ref bones } => {
                let subject = bones.first().map(|&bone| Subject::Bone(bone));
                (&codes::PARENT_CYCLE, subject, None, None)
            }
            Self::BoneCountMismatch { .. } => (&codes::BONE_COUNT_MISMATCH, None, None, None),
            Self::InfluenceOutOfRange {
                vertex,
                bone,
                bone_count,
            } => (
                &codes::INFLUENCE_OUT_OF_RANGE,
                Some(Subject::Vertex(vertex)),
                Some(format!("a bone below {bone_count}")),
                Some(bone.to_string()),
            ),
            Self::Model(ref rule) => return rule.diagnostic(),
        };
        Diagnostic {
            expected,
            found,
            subject,
            ..code.says(self.to_string())
        }
    }
}

/// How many bones of a circle are named before the rest is only counted.
const NAMED_BONES: usize = 8;

fn circle(bones: &[u32]) -> String {
    let named: Vec<String> = bones.iter().take(NAMED_BONES).map(u32::to_string).collect();
    let rest = match bones.len().checked_sub(NAMED_BONES) {
        Some(more) if more > 0 => format!(" → … ({more} more)"),
        _ => String::new(),
    };
    let back = bones.first().map(|bone| format!(" → {bone}")).unwrap_or_default();
    format!("{}{rest}{back}; each lists the next as its parent", named.join(" → "))
}
