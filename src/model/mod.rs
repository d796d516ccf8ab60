//! A model in our words, every index and order proved.
//!
//! [`Model::from_document`] translates what a file says: bones become joints with parents first, weights sum to 1, keys
//! are sorted and finite, missing normals and tangents are computed, ranges lie inside the mesh. What was mended comes
//! back as findings; what names something that does not exist is a [`ModelError`].
//!
//! # Codes
//!
//! The same as [`CODES`]; those of the parser are in [`format`](crate::format). A [`ModelError`] that only a constructor
//! gives, such as [`Track::new`], never comes from a file and is not listed.
//!
//! | code | severity | meaning |
//! |---|---|---|
//! | `parent-out-of-range` | error | a bone's parent is neither −1 nor a bone |
//! | `parent-cycle` | error | bones are their own ancestors |
//! | `bone-count-mismatch` | error | the numbers of bone offsets and of parents differ |
//! | `vertex-out-of-range` | error | a triangle names a vertex that is not there |
//! | `influence-out-of-range` | error | a vertex gives weight to a bone that is not there |
//! | `duplicate-material-name` | note | another material has the same name; shown with a number |
//! | `no-subsets` | warning | triangles but no subset; all are drawn with the first material |
//! | `subset-without-material` | warning | more subsets than materials; the rest is drawn in a default grey |
//! | `subset-out-of-range` | warning | a subset asks for triangles that are not there; left out |
//! | `triangles-undrawn` | warning | triangles that belong to no subset |
//! | `triangles-shared` | note | triangles that belong to more than one subset |
//! | `indices-look-relative` | note | the indices of a subset look counted from its VertexStart; taken as they stand |
//! | `bones-reordered` | note | a bone stands before its parent; sorted |
//! | `many-bones` | note | more bones than the books' shaders hold |
//! | `offset-not-finite` | warning | a bone offset with a number that is not finite; the identity stands in |
//! | `offset-not-affine` | warning | a bone offset whose fourth column is not 0 0 0 1; that column was left out |
//! | `offset-singular` | warning | a bone offset without an inverse; the bone's place in the bind pose is unknown |
//! | `many-vertices` | note | more vertices than the books' 16-bit indices name |
//! | `vertex-not-finite` | warning | a position or texture coordinate that is not finite; taken as 0 |
//! | `handedness-unclear` | note | triangles wind both ways; the majority decides |
//! | `normals-missing` | warning | normals that are zero or not finite; computed from the triangles |
//! | `weights-invalid` | warning | a blend weight that is negative or not finite; taken as 0 |
//! | `weights-not-normalized` | warning | blend weights whose sum is not 1; normalised |
//! | `weights-all-zero` | warning | a vertex without blend weight in a skinned model; not moved |
//! | `bone-index-above-byte` | note | an influence names a bone above 255, which the books' loaders cannot hold |
//! | `tangents-missing` | warning | tangents that are zero or not finite; computed from the texture coordinates |
//! | `tangent-sign` | warning | a tangent whose fourth number is not 1 or −1; its sign is kept |
//! | `duplicate-clip-name` | note | another clip has the same name; shown with a number |
//! | `clip-unnamed` | note | a clip has no name; shown with its number |
//! | `clip-bones-missing` | warning | a clip has fewer tracks than there are bones; the rest is at rest |
//! | `clip-bones-extra` | warning | a clip has more tracks than there are bones; left out |
//! | `track-empty` | warning | a bone has no keys in a clip; at rest |
//! | `keys-not-finite` | warning | a key with a number that is not finite or a time beyond 10⁹ s; left out |
//! | `keys-not-sorted` | warning | keys that are not in the order of time; sorted |
//! | `keys-at-equal-times` | warning | keys of one bone at the same time; the first and the last are kept as a jump |
//! | `rotation-not-unit` | warning | a rotation that is not of unit length; normalised |
//! | `rotation-zero` | warning | a rotation of length 0; taken as no rotation |
//! | `exploded` | warning | the keys of a clip do not belong to the bone offsets: the mesh flies apart |
//! | `pose-overflows` | warning | a clip takes a bone or what hangs on it beyond 10³⁷, where numbers overflow |

mod bounds;
mod clip;
mod codes;
mod error;
mod exploded;
mod geometry;
mod handedness;
mod hierarchy;
mod influences;
mod joint_lanes;
mod joint_names;
mod local_joint;
mod material;
mod mesh;
mod mirror;
mod motion;
mod names;
mod normals;
mod notes;
mod overflow;
mod skeleton;
mod space;
mod subsets;
mod surface;
mod tangents;
mod track;
mod track_group;
mod tracks;
mod tree;

pub use bounds::Aabb;
pub use clip::Clip;
pub use codes::CODES;
pub use error::{ModelError, ModelErrorKind};
pub use joint_lanes::{JointLanes, MatrixLanes};
pub use joint_names::{JointNames, SavedNames, hierarchy_fingerprint};
pub use local_joint::LocalJoint;
pub use material::{Material, Reflectance};
pub use mesh::{Influences, Mesh, Submesh};
pub use mirror::{MirrorPair, mirror_pairs};
pub(crate) use names::unique as unique_names;
pub use overflow::Overflow;
pub use skeleton::{JointIndex, Skeleton};
pub use space::{Handedness, UpAxis, world_from_model};
pub use track::Track;
pub(crate) use track_group::{KeyLanes, TrackGroup};
pub use tracks::Tracks;
pub use tree::{JointTree, VertexCounts};

use crate::diagnostic::Diagnostic;
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
    /// What a document means, and what had to be mended for it. `lines` places the findings; it may be empty.
    ///
    /// # Errors
    /// When a parent, a triangle's vertex or an influence names what does not exist, or the bones form a circle.
    pub fn from_document(document: &Document, lines: &LineMap) -> Result<(Self, Vec<Diagnostic>), ModelError> {
        let mut notes = notes::Notes::default();
        let mut materials = surface::materials_from_document(document, lines, &mut notes);
        let submeshes = subsets::submeshes_from_document(document, lines, &mut materials, &mut notes);
        let skeleton = hierarchy::skeleton_from_document(document, lines, &mut notes)?;
        let (mut mesh, handedness) = geometry::mesh_from_document(document, lines, &skeleton, &mut notes)?;
        mesh.submeshes = submeshes;
        let mut clips = motion::clips_from_document(document, lines, &skeleton, &mut notes)?;
        exploded::note_exploded(&mesh, &skeleton, &clips, lines, &mut notes);
        overflow::note_overflows(&mesh, &skeleton, &mut clips, lines, &mut notes);
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
        Ok((model, notes.into_diagnostics()))
    }

    /// The model of a parsed file. The findings of both stages, the parser's first.
    ///
    /// # Errors
    /// As [`Model::from_document`].
    pub fn from_parsed(parsed: &Parsed) -> Result<(Self, Vec<Diagnostic>), ModelError> {
        let (model, notices) = Self::from_document(&parsed.document, &parsed.lines)?;
        let all = parsed.notices.iter().cloned().chain(notices).collect();
        Ok((model, all))
    }

    /// Box of all vertices in bind space, also those that no triangle uses.
    pub fn bind_bounds(&self) -> Aabb {
        Aabb::from_points(self.mesh.positions.iter().copied())
    }
}
