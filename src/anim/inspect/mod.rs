//! What there is to read about one joint, one track, one vertex: numbers, and the same as text to copy.

mod joint;
mod keys;
mod parts;
mod table;
mod vertex;

pub use joint::JointReadout;
pub use keys::{KeyRow, key_rows, key_table};
pub use parts::TransformParts;
pub use table::RowMatrix;
pub use vertex::{ExplainedInfluence, VertexExplanation, explain_vertex};
