//! What is selected, hovered, hidden and named: bones, vertices and subsets.

pub(super) mod joint_rows;
pub(super) mod joints;
pub(super) mod naming;
pub(super) mod picking;
pub(super) mod selecting;
pub(super) mod submeshes;
