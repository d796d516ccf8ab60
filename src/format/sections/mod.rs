//! One file for each section. Each reads from behind its ruler to the ruler of the next one.

mod bones;
mod clips;
mod header;
mod materials;
mod subsets;
mod triangles;
mod vertices;

pub(super) use bones::{hierarchy, offsets};
pub(super) use clips::{clips, close, open};
pub(super) use header::header;
pub(super) use materials::materials;
pub(super) use subsets::subsets;
pub(super) use triangles::triangles;
pub(super) use vertices::vertices;
