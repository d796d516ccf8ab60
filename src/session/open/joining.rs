//! Clips of other files with the same bones join those of the open model: bones find each other by their names where both files have such, else by
//! their order.
//!
//! Clips take the places of those that a file of the same name brought before: a file that is exported again and again does not pile up.

use std::sync::Arc;

use glam::Affine3A;

use super::files::{File, FileSet};
use super::load::{LoadError, load_among};
use super::open_model::{ClipFacts, JoinedFile, OpenModel};
use crate::anim::CompiledClip;
use crate::diagnostic::collect::{counted, few};
use crate::diagnostic::{Diagnostic, Severity, Subject, codes};
use crate::edit::{self, Retargeted};
use crate::model::{Skeleton, unique_names};
use crate::slices::Slices;
use crate::sorting;

/// Numbers of two bone offsets that differ by less are the same: lengths as fractions of the model's size, axes as they are.
/// Two exports of one rig differ in the last of six digits; a thousandth of the size is hardly seen.
const OFFSET_TOLERANCE: f32 = 1e-3;

impl JoinedFile {
    /// A file of a drop whose clips shall join.
    pub(in crate::session) fn of(file: &File, files: &FileSet) -> Self {
        Self {
            file: file.clone(),
            files: Arc::new(files.needed_by(file)),
            noted: None,
        }
    }
}

impl OpenModel {
    /// Adds the clips of another model that was read from a file by itself, and notes what did not fit.
    ///
    /// # Errors
    /// When the other has no clips, or its bones are not those of this model.
    pub fn add_clips(&mut self, other: Self) -> Result<(), Box<LoadError>> {
        let files = FileSet::new([other.file.clone()]);
        self.join_clips(other, &files, false)?;
        let noted = self.joined.last().and_then(|joined| joined.noted.clone());
        self.diagnostics.extend(noted);
        Ok(())
    }

    /// Adds the clips of another model, read from one of some files, to the list, under names that are free. With `replaces` they take the
    /// place of clips that files of this name brought before, if there are any; then it is true.
    ///
    /// # Errors
    /// When the other has no clips, or its bones are not those of this model; then nothing is added.
    pub(in crate::session) fn join_clips(
        &mut self,
        mut other: Self,
        files: &FileSet,
        replaces: bool,
    ) -> Result<bool, Box<LoadError>> {
        let file = &other.file.clone();
        let refuse = |code, message| Err(Box::new(LoadError::refused(file, code, message)));
        let (ours, theirs) = (self.file.base_name(), file.base_name());
        if other.model.clips.is_empty() {
            return refuse(&codes::CLIPS_NONE, format!("{theirs} has no clips to add."));
        }
        let (our_bones, their_bones) = (&self.model.skeleton, &other.model.skeleton);
        let noted;
        if edit::has_names(our_bones) && edit::has_names(their_bones) {
            match edit::retarget(our_bones, their_bones, &other.model.clips) {
                Ok(Some(retargeted)) => {
                    noted = by_names(&retargeted, theirs, ours);
                    other.compiled = CompiledClip::all(&retargeted.clips);
                    other.model.clips = retargeted.clips;
                }
                Ok(None) => {
                    let message =
                        format!("Fewer than half of the bones that {theirs} moves have a name that {ours} knows.");
                    return refuse(&codes::CLIPS_BONES_DIFFER, message);
                }
                Err(fault) => return refuse(&codes::CLIPS_BONES_DIFFER, format!("{theirs}: {}", fault.message)),
            }
        } else if let Some(difference) = difference(our_bones, ours, their_bones, theirs) {
            return refuse(&codes::CLIPS_BONES_DIFFER, difference);
        } else {
            noted = self.offsets_diagnostic(&other);
        }
        for clip in &mut other.model.clips {
            if says_nothing(&clip.name) {
                let stem = theirs.rsplit_once('.').map_or(theirs, |(stem, _)| stem);
                clip.name = stem.to_owned();
            }
        }
        let replaced = if replaces { self.remove_joined(theirs) } else { None };
        let kept = self.model.clips.len();
        let first = replaced.map_or(kept, |(first, _)| first);
        let all = self.model.clips.iter().chain(&other.model.clips);
        let names = unique_names(all.map(|clip| clip.name.as_str()), "clip", |_, _| {});
        self.move_clip_diagnostics(first, other.model.clips.len());
        if let Some((first, before)) = replaced {
            let diagnostic = replaced_diagnostic(theirs, first, other.model.clips.len(), before);
            self.diagnostics.push(diagnostic);
        }
        self.diagnostics.extend(
            other
                .diagnostics
                .into_iter()
                .filter_map(|diagnostic| joined_diagnostic(diagnostic, theirs, first)),
        );
        let mut clips = other.model.clips;
        for (clip, name) in clips.iter_mut().zip(names.into_iter().skip(kept)) {
            clip.name = name;
        }
        let facts: Vec<_> = clips.iter().map(|_| ClipFacts::joined_from(theirs)).collect();
        self.clip_facts.splice(first..first, facts);
        self.model.clips.splice(first..first, clips);
        self.compiled.splice(first..first, other.compiled);
        let is_same = |joined: &JoinedFile| joined.file.base_name() == theirs;
        let place = self.joined.iter().position(is_same).filter(|_| replaced.is_some());
        if replaced.is_some() {
            self.joined.retain(|joined| !is_same(joined));
        }
        let joined = JoinedFile {
            noted,
            ..JoinedFile::of(file, files)
        };
        self.joined.insert(place.unwrap_or(self.joined.len()), joined);
        Ok(replaced.is_some())
    }

    /// Adds the clips of a file that joined a model that this one replaces. If they no longer fit, a diagnostic says so.
    pub(in crate::session) async fn join_again(&mut self, joined: &JoinedFile, slices: &Slices) {
        let other = load_among(&joined.file, &joined.files, slices).await;
        if let Err(error) = other.and_then(|other| self.join_clips(other, &joined.files, false)) {
            self.diagnostics.push(Diagnostic {
                severity: Severity::Warning,
                position: None,
                places: Vec::new(),
                length: 0,
                subject: None,
                ..error.diagnostic
            });
        }
    }

    /// What is noted of the files whose clips joined, beside what is noted of the clips.
    pub(in crate::session) fn joined_diagnostics(&self) -> impl Iterator<Item = &Diagnostic> {
        self.joined.iter().filter_map(|joined| joined.noted.as_ref())
    }

    /// Removes the clips that a file of this name brought, and their diagnostics. Returns the index of the first and how many
    /// there were.
    fn remove_joined(&mut self, file_name: &str) -> Option<(usize, usize)> {
        let is_gone = |facts: &ClipFacts| facts.joined && facts.file_name == file_name;
        let gone: Vec<bool> = self.clip_facts.iter().map(is_gone).collect();
        let first = gone.iter().position(|&gone| gone)?;
        let count = gone.iter().filter(|&&gone| gone).count();
        let mut keeps = gone.iter().map(|gone| !gone);
        self.model.clips.retain(|_| keeps.next().unwrap_or(true));
        let mut keeps = gone.iter().map(|gone| !gone);
        self.compiled.retain(|_| keeps.next().unwrap_or(true));
        self.clip_facts.retain(|facts| !is_gone(facts));
        let place_of = |clip: u32| gone.iter().take(clip as usize).filter(|&&gone| !gone).count() as u32;
        self.diagnostics.retain_mut(|diagnostic| {
            let Some(Subject::Clip(clip)) = diagnostic.subject else {
                return true;
            };
            diagnostic.subject = Some(Subject::Clip(place_of(clip)));
            gone.get(clip as usize) != Some(&true)
        });
        Some((first, count))
    }

    /// Adds `by` to the clip index of each diagnostic about a clip at index `from` or later.
    fn move_clip_diagnostics(&mut self, from: usize, by: usize) {
        for diagnostic in &mut self.diagnostics {
            if let Some(Subject::Clip(clip)) = &mut diagnostic.subject
                && *clip as usize >= from
            {
                *clip = clip.saturating_add(by as u32);
            }
        }
    }

    /// A note when the other model was skinned in another pose, or in other proportions.
    fn offsets_diagnostic(&self, other: &Self) -> Option<Diagnostic> {
        let size = self.size();
        let (ours, theirs) = (&self.model.skeleton, &other.model.skeleton);
        let pairs = ours.joint_from_bind().iter().zip(theirs.joint_from_bind());
        let mut differing: Vec<u32> = pairs
            .zip(ours.file_bones())
            .filter(|((ours, theirs), _)| !are_same(ours, theirs, size))
            .map(|(_, &bone)| bone)
            .collect();
        sorting::sort(&mut differing);
        let &first = differing.first()?;
        let message = format!(
            "{} of the {} bone offsets of {} differ from those of {}, the first that of bone {first}: its clips were made for \
             other proportions.",
            differing.len(),
            ours.joint_count(),
            other.file.base_name(),
            self.file.base_name(),
        );
        Some(Diagnostic {
            subject: Some(Subject::Bone(first)),
            ..codes::CLIPS_OFFSETS_DIFFER.says(message)
        })
    }
}

/// Names of clips that programs give to all of them: Mixamo's, that of a first take, and Blender's where it exports what plays.
fn says_nothing(name: &str) -> bool {
    let name = name.rsplit('|').next().unwrap_or(name).trim();
    ["", "mixamo.com", "Take 001", "Scene"].contains(&name)
}

/// A note of what did not fit where bones found each other by their names.
fn by_names(retargeted: &Retargeted, theirs: &str, ours: &str) -> Option<Diagnostic> {
    let Retargeted {
        without_place,
        at_rest,
        is_relative,
        ..
    } = retargeted;
    let mut parts = Vec::new();
    if !without_place.is_empty() {
        parts.push(format!(
            "{} of {theirs} {} not in {ours}: {}",
            counted(without_place.len(), "bone", "bones"),
            are(without_place.len()),
            few(without_place)
        ));
    }
    if !at_rest.is_empty() {
        parts.push(format!(
            "{} of {ours} {} not in {theirs} and at rest: {}",
            counted(at_rest.len(), "bone", "bones"),
            are(at_rest.len()),
            few(at_rest)
        ));
    }
    if *is_relative {
        parts.push(format!(
            "the bones of {theirs} lie otherwise, so its motion is kept relative to the rest pose"
        ));
    }
    let mut message = parts.join("; ");
    if let Some(first) = message.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    (!message.is_empty()).then(|| codes::CLIPS_BY_NAMES.says(message + "."))
}

fn are(count: usize) -> &'static str {
    if count == 1 { "is" } else { "are" }
}

/// The first difference of two hierarchies in words, by the files' numbers; `None` when they are the same.
fn difference(ours: &Skeleton, our_file: &str, theirs: &Skeleton, their_file: &str) -> Option<String> {
    let (our_count, their_count) = (ours.joint_count(), theirs.joint_count());
    if our_count != their_count {
        let bones = |count| if count == 1 { "bone" } else { "bones" };
        return Some(format!(
            "{their_file} has {their_count} {} and {our_file} has {our_count}; clips can only be added from a file with the \
             same bones.",
            bones(their_count),
        ));
    }
    (0..our_count).find_map(|bone| {
        let (our_parent, their_parent) = (parent_of_bone(ours, bone), parent_of_bone(theirs, bone));
        let parent = |parent: Option<u32>| parent.map_or("no parent".to_owned(), |parent| format!("bone {parent} as its parent"));
        (our_parent != their_parent).then(|| {
            format!(
                "Bone {bone} has {} in {their_file} and {} in {our_file}; clips can only be added from a file with the same \
                 bones.",
                parent(their_parent),
                parent(our_parent),
            )
        })
    })
}

/// The parent of a bone of the file, as a bone of the file.
fn parent_of_bone(skeleton: &Skeleton, bone: usize) -> Option<u32> {
    let joint = skeleton.joint_of_bone()[bone];
    let parent = skeleton.parents()[joint.index()]?;
    Some(skeleton.file_bones()[parent.index()])
}

fn are_same(ours: &Affine3A, theirs: &Affine3A, size: f32) -> bool {
    // The columns of a matrix in a file of other units are of other lengths.
    let unit = ours.matrix3.x_axis.abs().max_element().max(f32::MIN_POSITIVE);
    let tolerance = OFFSET_TOLERANCE * unit;
    ours.matrix3.abs_diff_eq(theirs.matrix3, tolerance)
        && ours.translation.abs_diff_eq(theirs.translation, tolerance * size)
}

/// What a diagnostic about a clip of another file says in the list of this one. Diagnostics about the rest of that file are of
/// no interest here.
fn joined_diagnostic(diagnostic: Diagnostic, file_name: &str, first: usize) -> Option<Diagnostic> {
    let Some(Subject::Clip(clip)) = diagnostic.subject else {
        return None;
    };
    // Names were made free anew for this list.
    if diagnostic.code == codes::DUPLICATE_CLIP_NAME.name {
        return None;
    }
    Some(Diagnostic {
        message: format!("{file_name}: {}", diagnostic.message),
        position: None,
        places: Vec::new(),
        length: 0,
        subject: Some(Subject::Clip(clip.saturating_add(first as u32))),
        ..diagnostic
    })
}

/// A note that clips took the places of others.
fn replaced_diagnostic(file_name: &str, first: usize, count: usize, before: usize) -> Diagnostic {
    let clips = |count: usize| format!("{count} clip{}", if count == 1 { "" } else { "s" });
    let replace = if count == 1 { "replaces" } else { "replace" };
    let (now, before) = (clips(count), clips(before));
    let message = format!("{file_name} was added before; its {now} {replace} the {before} from then.");
    Diagnostic {
        subject: Some(Subject::Clip(first as u32)),
        ..codes::CLIPS_REPLACED.says(message)
    }
}
