//! From the file's bones in any order to joints with parents first.

use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::limits::MOST_BONES;
use crate::diagnostic::{Fault, Subject, codes};
use crate::format::{Document, LineMap};
use crate::import::offsets::{self, Words};
use crate::import::scene;
use crate::model::{JointIndex, Skeleton};

const OFFSETS: Words = Words {
    one_has: "bone offset has",
    many_have: "bone offsets have",
    not_affine: ("a fourth column that is not 0 0 0 1; that column was left out.", 0.0),
    singular: "no inverse; the bone's place in the bind pose is unknown.",
};

/// The skeleton of a document. A file whose order is already valid keeps it; otherwise each bone follows its parent as
/// soon as the bones with lower numbers allow.
pub(super) fn skeleton_from_document(
    document: &Document,
    lines: &LineMap,
    diagnostics: &mut Diagnostics,
) -> Result<Skeleton, Fault> {
    let bone_count = document.bone_parents.len();
    if document.bone_offsets.len() != bone_count {
        let message = format!(
            "{} bone offsets but {bone_count} parents; every bone has one of each.",
            document.bone_offsets.len()
        );
        let line = lines.bone_parents.first().or(lines.bone_offsets.first());
        return Err(codes::BONE_COUNT_MISMATCH.says(message).on_line(line.copied()).into());
    }
    let bone_parents = parents_in_range(&document.bone_parents, lines)?;
    let file_bones = parents_first(&bone_parents, lines)?;
    note_order(&file_bones, &bone_parents, lines, diagnostics);
    if bone_count > MOST_BONES {
        diagnostics.add(
            &codes::MANY_BONES,
            Place::default(),
            format!("There are {bone_count} bones; the books' shaders hold {MOST_BONES}."),
        );
    }

    let mut joint_of_bone = vec![JointIndex(0); bone_count];
    for (joint, &bone) in (0u32..).zip(&file_bones) {
        joint_of_bone[bone as usize] = JointIndex(joint);
    }
    let parents = file_bones
        .iter()
        .map(|&bone| bone_parents[bone as usize].map(|parent| joint_of_bone[parent as usize]))
        .collect();
    // Row vectors, row by row, are the columns of our column-vector matrix.
    let place = |tally: &Tally| Place::of_rows(tally, Subject::Bone, &lines.bone_offsets);
    let offsets = offsets::mended(&document.bone_offsets, &OFFSETS, place, diagnostics);
    let joint_from_bind = file_bones.iter().map(|&bone| offsets[bone as usize].as_affine3a());
    let joint_from_bind = joint_from_bind.collect();
    Skeleton::new(parents, joint_from_bind, file_bones)
}

/// The file's parents: −1 is a root, anything else must be a bone.
fn parents_in_range(parents: &[i32], lines: &LineMap) -> Result<Vec<Option<u32>>, Fault> {
    let bone_count = parents.len() as u32;
    (0u32..)
        .zip(parents)
        .map(|(bone, &parent)| match u32::try_from(parent) {
            _ if parent == -1 => Ok(None),
            Ok(number) if number < bone_count => Ok(Some(number)),
            _ => {
                let expected = format!("−1 or a bone below {bone_count}");
                let message = format!("Bone {bone} lists {parent} as its parent; a parent is {expected}.");
                let fault = codes::PARENT_OUT_OF_RANGE.says(message).about(Subject::Bone(bone));
                let fault = fault.expected(expected).found(parent.to_string());
                Err(fault.on_line(lines.bone_parents.get(bone as usize).copied()).into())
            }
        })
        .collect()
}

/// File bones in an order in which parents come first: of the bones that may stand next, always the lowest number.
fn parents_first(parents: &[Option<u32>], lines: &LineMap) -> Result<Vec<u32>, Fault> {
    let order = scene::parents_first(parents, Some);
    if order.len() == parents.len() {
        return Ok(order);
    }
    let bones = circle_of(parents, &order);
    let fault = codes::PARENT_CYCLE.says(format!("Bones form a circle: {}.", circle_in_words(&bones)));
    Err(match bones.first() {
        Some(&bone) => fault
            .about(Subject::Bone(bone))
            .on_line(lines.bone_parents.get(bone as usize).copied()),
        None => fault,
    }
    .into())
}

/// A circle among the bones that no root reaches, from its lowest number on.
fn circle_of(parents: &[Option<u32>], placed: &[u32]) -> Vec<u32> {
    let mut reached = vec![false; parents.len()];
    for &bone in placed {
        reached[bone as usize] = true;
    }
    let Some(outside) = reached.iter().position(|reached| !reached) else {
        return Vec::new();
    };
    // Every bone that no root reaches has a parent of the same kind, so this walk must meet itself.
    let step = |bone: u32| parents[bone as usize].unwrap_or(bone);
    let mut bone = outside as u32;
    for _ in 0..parents.len() {
        bone = step(bone);
    }
    let mut circle = vec![bone];
    let mut next = step(bone);
    while next != bone {
        circle.push(next);
        next = step(next);
    }
    let lowest = (0..circle.len()).min_by_key(|&place| circle[place]).unwrap_or(0);
    circle.rotate_left(lowest);
    circle
}

fn circle_in_words(bones: &[u32]) -> String {
    const MOST_NAMED: usize = 8;
    let named: Vec<String> = bones.iter().take(MOST_NAMED).map(u32::to_string).collect();
    let rest = match bones.len().checked_sub(MOST_NAMED) {
        Some(more) if more > 0 => format!(" → … ({more} more)"),
        _ => String::new(),
    };
    let back = bones.first().map(|bone| format!(" → {bone}")).unwrap_or_default();
    format!("{}{rest}{back}; each lists the next as its parent", named.join(" → "))
}

fn note_order(file_bones: &[u32], parents: &[Option<u32>], lines: &LineMap, diagnostics: &mut Diagnostics) {
    if file_bones.is_sorted() {
        return;
    }
    let mut late = Tally::default();
    for (bone, parent) in (0u32..).zip(parents) {
        if parent.is_some_and(|parent| parent > bone) {
            late.add(bone);
        }
    }
    let stand = counted(late.count, "bone stands", "bones stand");
    diagnostics.add(
        &codes::BONES_REORDERED,
        Place::of_rows(&late, Subject::Bone, &lines.bone_parents),
        format!("{stand} before the parent; the joints are sorted and keep the file's numbers for display."),
    );
}
