//! Why something is no model.

use crate::diagnostic::{Code, Diagnostic, Subject, codes};

/// A rule of a model that was broken. It has no place in a file: that is for who read one.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// [`Mesh::check`](super::Mesh::check): a triangle names a vertex that is not there.
    #[error("Triangle {triangle} names vertex {vertex}, but there are {vertex_count} vertices.")]
    VertexOutOfRange {
        /// Index of the triangle.
        triangle: u32,
        /// The vertex it names.
        vertex: u32,
        /// Number of vertices.
        vertex_count: u32,
    },
    /// [`Mesh::check`](super::Mesh::check): a stream does not fit the positions.
    #[error("There are {length} {stream} for {vertex_count} vertices; every vertex has one.")]
    StreamLength {
        /// Its entries, in the plural.
        stream: &'static str,
        /// Number of them.
        length: usize,
        /// Number of positions.
        vertex_count: usize,
    },
    /// [`Mesh::check`](super::Mesh::check): NaN or infinity in a position.
    #[error("The position of vertex {vertex} holds a number that is not finite.")]
    PositionNotFinite {
        /// Index of the vertex.
        vertex: usize,
    },
    /// [`Mesh::check`](super::Mesh::check): the last triangle has less than three vertices.
    #[error("There are {index_count} indices; three make a triangle.")]
    IncompleteTriangle {
        /// Number of indices.
        index_count: usize,
    },
    /// [`Model::checked`](super::Model::checked): a submesh has triangles or a material that are not there.
    #[error("Submesh {submesh} names triangles or a material that are not there.")]
    SubmeshOutOfRange {
        /// Index of the submesh.
        submesh: usize,
    },
    /// [`Model::checked`](super::Model::checked): a vertex follows a joint that is not there.
    #[error("Vertex {vertex} names joint {joint}, but there are {joint_count} joints.")]
    JointOutOfRange {
        /// Index of the vertex.
        vertex: usize,
        /// The joint it names.
        joint: u32,
        /// Number of joints.
        joint_count: usize,
    },
    /// [`Model::checked`](super::Model::checked): a clip has not one track for each joint.
    #[error("Clip {clip} has {tracks} tracks for {joint_count} joints; every joint has one.")]
    TrackCount {
        /// Index of the clip.
        clip: usize,
        /// Number of its tracks.
        tracks: usize,
        /// Number of joints.
        joint_count: usize,
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
        match self {
            Self::VertexOutOfRange { .. } => &codes::VERTEX_OUT_OF_RANGE,
            Self::StreamLength { .. } => &codes::STREAM_LENGTH,
            Self::PositionNotFinite { .. } => &codes::POSITION_NOT_FINITE,
            Self::IncompleteTriangle { .. } => &codes::INCOMPLETE_TRIANGLE,
            Self::SubmeshOutOfRange { .. } => &codes::SUBMESH_OUT_OF_RANGE,
            Self::JointOutOfRange { .. } => &codes::JOINT_OUT_OF_RANGE,
            Self::TrackCount { .. } => &codes::TRACK_COUNT,
            Self::ParentNotBefore { .. } => &codes::PARENT_NOT_BEFORE,
            Self::JointCountMismatch { .. } => &codes::JOINT_COUNT_MISMATCH,
            Self::FileBoneNotUnique { .. } => &codes::FILE_BONE_NOT_UNIQUE,
            Self::MatrixNotFinite { .. } => &codes::MATRIX_NOT_FINITE,
            Self::NoKeys => &codes::NO_KEYS,
            Self::KeyNotAfter { .. } => &codes::KEY_NOT_AFTER,
            Self::KeyNotFinite { .. } => &codes::KEY_NOT_FINITE,
        }
    }

    /// The same as a diagnostic, for panels and outputs.
    pub fn diagnostic(&self) -> Diagnostic {
        let diagnostic = self.code().says(self.to_string());
        match *self {
            Self::VertexOutOfRange {
                triangle,
                vertex,
                vertex_count,
            } => Diagnostic {
                expected: Some(format!("a vertex below {vertex_count}")),
                found: Some(vertex.to_string()),
                subject: Some(Subject::Triangle(triangle)),
                ..diagnostic
            },
            _ => diagnostic,
        }
    }
}
