//! Why a document cannot become a model.

use crate::diagnostic::{Code, Diagnostic, Position, Subject, codes};

/// A document that names what does not exist, or a hierarchy that has no order.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{kind}", self.position.map(|position| format!("{position}: ")).unwrap_or_default())]
pub struct ModelError {
    /// Where the file says it, when the document was read from a file.
    pub position: Option<Position>,
    /// Which rule it breaks.
    pub kind: ModelErrorKind,
}

/// The rules of a model. Bones carry the file's numbers, joints those of the skeleton.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelErrorKind {
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
    /// A triangle names a vertex that is not there.
    #[error("Triangle {triangle} names vertex {vertex}, but there are {vertex_count} vertices.")]
    VertexOutOfRange {
        /// Index of the triangle in the file.
        triangle: u32,
        /// The vertex it names.
        vertex: u32,
        /// Number of vertices.
        vertex_count: u32,
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
    /// [`Skeleton::new`](super::Skeleton::new): a child stands before its parent.
    #[error("Joint {joint} lists joint {parent} as its parent; a parent must come before its children.")]
    ParentNotBefore {
        /// The child.
        joint: u32,
        /// Its parent.
        parent: u32,
    },
    /// [`Skeleton::new`](super::Skeleton::new): the lists do not pair up.
    #[error(
        "{parents} parents, {matrices} inverse bind matrices and {file_bones} file bones; every joint has one of each."
    )]
    JointCountMismatch {
        /// Length of `parents`.
        parents: usize,
        /// Length of `joint_from_bind`.
        matrices: usize,
        /// Length of `file_bones`.
        file_bones: usize,
    },
    /// [`Skeleton::new`](super::Skeleton::new): two joints carry one file number, or a number is out of range.
    #[error("File bone {bone} of joint {joint} is out of range or taken; the file bones are an order of all joints.")]
    FileBoneNotUnique {
        /// The joint.
        joint: u32,
        /// Its file number.
        bone: u32,
    },
    /// [`Skeleton::new`](super::Skeleton::new): NaN or infinity in a matrix.
    #[error("The inverse bind matrix of joint {joint} holds a number that is not finite.")]
    MatrixNotFinite {
        /// The joint.
        joint: u32,
    },
    /// [`Track::new`](super::Track::new): no key.
    #[error("A track needs at least one key.")]
    NoKeys,
    /// [`Track::new`](super::Track::new): a time that is not after the one before.
    #[error("Key {key} is not after the key before it; key times must increase.")]
    KeyNotAfter {
        /// Index of the key.
        key: usize,
    },
    /// [`Track::new`](super::Track::new): NaN, infinity, or a rotation of zero length.
    #[error("Key {key} holds a number that is not finite, or a rotation without a direction.")]
    KeyNotFinite {
        /// Index of the key.
        key: usize,
    },
}

impl ModelError {
    /// The row of the table of codes.
    pub fn code(&self) -> &'static Code {
        match self.kind {
            ModelErrorKind::ParentOutOfRange { .. } => &codes::PARENT_OUT_OF_RANGE,
            ModelErrorKind::ParentCycle { .. } => &codes::PARENT_CYCLE,
            ModelErrorKind::BoneCountMismatch { .. } => &codes::BONE_COUNT_MISMATCH,
            ModelErrorKind::VertexOutOfRange { .. } => &codes::VERTEX_OUT_OF_RANGE,
            ModelErrorKind::InfluenceOutOfRange { .. } => &codes::INFLUENCE_OUT_OF_RANGE,
            ModelErrorKind::ParentNotBefore { .. } => &codes::PARENT_NOT_BEFORE,
            ModelErrorKind::JointCountMismatch { .. } => &codes::JOINT_COUNT_MISMATCH,
            ModelErrorKind::FileBoneNotUnique { .. } => &codes::FILE_BONE_NOT_UNIQUE,
            ModelErrorKind::MatrixNotFinite { .. } => &codes::MATRIX_NOT_FINITE,
            ModelErrorKind::NoKeys => &codes::NO_KEYS,
            ModelErrorKind::KeyNotAfter { .. } => &codes::KEY_NOT_AFTER,
            ModelErrorKind::KeyNotFinite { .. } => &codes::KEY_NOT_FINITE,
        }
    }

    /// The same as a diagnostic, for panels and outputs.
    pub fn diagnostic(&self) -> Diagnostic {
        let subject = match self.kind {
            ModelErrorKind::ParentOutOfRange { bone, .. } => Some(Subject::Bone(bone)),
            ModelErrorKind::ParentCycle { ref bones } => bones.first().map(|&bone| Subject::Bone(bone)),
            ModelErrorKind::VertexOutOfRange { triangle, .. } => Some(Subject::Triangle(triangle)),
            ModelErrorKind::InfluenceOutOfRange { vertex, .. } => Some(Subject::Vertex(vertex)),
            _ => None,
        };
        let (expected, found) = match self.kind {
            ModelErrorKind::ParentOutOfRange { parent, bone_count, .. } => (
                Some(format!("−1 or a bone below {bone_count}")),
                Some(parent.to_string()),
            ),
            ModelErrorKind::VertexOutOfRange {
                vertex, vertex_count, ..
            } => (Some(format!("a vertex below {vertex_count}")), Some(vertex.to_string())),
            ModelErrorKind::InfluenceOutOfRange { bone, bone_count, .. } => {
                (Some(format!("a bone below {bone_count}")), Some(bone.to_string()))
            }
            _ => (None, None),
        };
        Diagnostic {
            expected,
            found,
            position: self.position,
            places: self.position.into_iter().collect(),
            subject,
            ..self.code().says(self.kind.to_string())
        }
    }
}

/// A broken rule without a place in a file.
impl From<ModelErrorKind> for ModelError {
    fn from(kind: ModelErrorKind) -> Self {
        Self { position: None, kind }
    }
}

impl ModelErrorKind {
    /// This rule, broken on a line of the file; `None` for a document that was not read from one.
    pub(super) fn on_line(self, line: Option<u32>) -> ModelError {
        ModelError {
            position: line.map(crate::diagnostic::collect::line_start),
            kind: self,
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
