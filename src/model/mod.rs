//! A model in our words, every index and order proved.
//!
//! [`Model::from_document`] translates what a file says: bones become joints with parents first, weights sum to 1, keys
//! are sorted and finite, missing normals and tangents are computed, ranges lie inside the mesh. What was mended comes
//! back as diagnostics; what names something that does not exist is a [`ModelError`].
//!
//! The codes of both are [`codes::OF_MODEL`](crate::diagnostic::codes::OF_MODEL).

mod bounds;
mod clip;
mod error;
mod geometry;
mod hierarchy;
mod influences;
mod joint_names;
mod local_joint;
mod material;
mod mesh;
mod mirror;
mod motion;
mod names;
mod normals;
mod skeleton;
mod space;
mod surfaces;
mod tangents;
mod track;
mod tree;

pub use bounds::Aabb;
pub use clip::Clip;
pub use error::{ModelError, ModelErrorKind};
pub use joint_names::{JointNames, SavedNames, hierarchy_fingerprint};
pub use local_joint::LocalJoint;
pub use material::{Material, Reflectance};
pub use mesh::{Influences, Mesh, Submesh};
pub use mirror::{MirrorPair, mirror_pairs};
pub(crate) use names::unique as unique_names;
pub use skeleton::{JointIndex, Skeleton};
pub use space::{Handedness, UpAxis, world_from_model};
pub use track::Track;
pub use tree::{JointTree, VertexCounts};

use crate::diagnostic::Diagnostic;
use crate::diagnostic::collect::Diagnostics;
use crate::format::{Dialect, Document, LineMap, Parsed};

/// A model that can be animated and drawn: after it exists no later stage can fail.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// At least as many as the submeshes name; may be empty when there are no submeshes.
    pub materials: Vec<Material>,
    /// Vertices and triangles, in the file's order and in the file's space (bind space).
    pub mesh: Mesh,
    /// Joints, parents first. Empty for a static model.
    pub skeleton: Skeleton,
    /// Named motions; none for a static model.
    pub clips: Vec<Clip>,
    /// The handedness of the file's space, found by the winding test.
    pub handedness: Handedness,
    /// The up axis of the file's space, as the dialect suggests.
    pub up_axis: UpAxis,
}

impl Model {
    /// What a document means, and what had to be mended for it. `lines` gives the diagnostics their places; it may be empty.
    ///
    /// # Errors
    /// When a parent, a triangle's vertex or an influence names what does not exist, or the bones form a circle.
    pub fn from_document(document: &Document, lines: &LineMap) -> Result<(Self, Vec<Diagnostic>), ModelError> {
        let mut diagnostics = Diagnostics::default();
        let mut materials = surfaces::materials_from_document(document, lines, &mut diagnostics);
        let submeshes = surfaces::submeshes_from_document(document, lines, &mut materials, &mut diagnostics);
        let skeleton = hierarchy::skeleton_from_document(document, lines, &mut diagnostics)?;
        let (mut mesh, handedness) = geometry::mesh_from_document(document, lines, &skeleton, &mut diagnostics)?;
        mesh.submeshes = submeshes;
        let clips = motion::clips_from_document(document, lines, &skeleton, &mut diagnostics)?;
        let up_axis = match document.dialect {
            Dialect::Imm => UpAxis::Z,
            Dialect::D3d11 | Dialect::D3d12 => UpAxis::Y,
        };
        let model = Self {
            materials,
            mesh,
            skeleton,
            clips,
            handedness,
            up_axis,
        };
        Ok((model, diagnostics.into_vec()))
    }

    /// The model of a parsed file, and the diagnostics of both stages, the parser's first.
    ///
    /// # Errors
    /// As [`Model::from_document`].
    pub fn from_parsed(parsed: &Parsed) -> Result<(Self, Vec<Diagnostic>), ModelError> {
        let (model, diagnostics) = Self::from_document(&parsed.document, &parsed.lines)?;
        let all = parsed.diagnostics.iter().cloned().chain(diagnostics).collect();
        Ok((model, all))
    }

    /// Box of all vertices in bind space, also those that no triangle uses.
    pub fn bind_bounds(&self) -> Aabb {
        Aabb::from_points(self.mesh.positions.iter().copied())
    }
}
