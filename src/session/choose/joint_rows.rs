//! The tree of joints as rows of a list, folded or searched.

use super::joints::Joints;
use crate::model::{JointIndex, JointNames, Skeleton};

/// One row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointRow {
    /// Which joint.
    pub joint: JointIndex,
    /// Its number in the file.
    pub bone: u32,
    /// Its distance from its root.
    pub depth: u32,
    /// Whether joints hang from it.
    pub has_children: bool,
    /// Whether these are left out.
    pub folded: bool,
    /// Whether a search found it itself, and not only something below it. Without a search false.
    pub found: bool,
    /// Vertices that it moves.
    pub own_vertices: u32,
    /// Vertices that it or something below it moves.
    pub branch_vertices: u32,
}

/// The rows of the tree, depth first, at the end of the caller's buffer.
pub(in crate::session) fn joint_rows(
    skeleton: &Skeleton,
    joints: &Joints,
    names: &JointNames,
    query: &str,
    rows: &mut Vec<JointRow>,
) {
    let bones = skeleton.file_bones();
    let (tree, counts) = (joints.tree(), joints.vertex_counts());
    let query = Query::new(query);
    let row = |joint: JointIndex, folded: bool, found: bool| JointRow {
        joint,
        bone: bones[joint.index()],
        depth: tree.depth(joint),
        has_children: tree.branch(joint).len() > 1,
        folded,
        found,
        own_vertices: counts.own[joint.index()],
        branch_vertices: counts.of_branch[joint.index()],
    };
    let Some(query) = query else {
        let mut rest = tree.order();
        while let Some(&joint) = rest.first() {
            let branch = tree.branch(joint).len();
            let folded = branch > 1 && joints.is_folded(joint);
            rows.push(row(joint, folded, false));
            rest = &rest[if folded { branch } else { 1 }..];
        }
        return;
    };
    let found = |joint: JointIndex| {
        let bone = bones[joint.index()];
        query.is_met_by(bone, names.get(bone).or_else(|| skeleton.name(joint)))
    };
    // From the end, so that what is below a joint is known before it.
    let mut has_found = vec![false; bones.len()];
    let parents = skeleton.parents();
    for &joint in tree.order().iter().rev() {
        let found = found(joint);
        if found || has_found[joint.index()] {
            rows.push(row(joint, false, found));
            if let Some(parent) = parents[joint.index()] {
                has_found[parent.index()] = true;
            }
        }
    }
    rows.reverse();
}

struct Query {
    lowercase: String,
    bone: Option<u32>,
}

impl Query {
    /// None when there are no words.
    fn new(text: &str) -> Option<Self> {
        let lowercase = text.trim().to_lowercase();
        if lowercase.is_empty() {
            return None;
        }
        let number = lowercase.strip_prefix("bone").or(lowercase.strip_prefix('#'));
        let bone = number.unwrap_or(&lowercase).trim().parse().ok();
        Some(Self { lowercase, bone })
    }

    fn is_met_by(&self, bone: u32, name: Option<&str>) -> bool {
        self.bone == Some(bone) || name.is_some_and(|name| name.to_lowercase().contains(&self.lowercase))
    }
}
