//! A model that is open: its file, and what is known of it and of each clip beside what they hold. Most of it is computed when it
//! is first asked for.

use std::collections::{HashMap, HashSet};
use std::sync::{Arc, OnceLock};

use super::files::{File, FileSet};
use crate::anim::{self, CompiledClip, Extent, JointActivity, LoopGap, VertexGroups};
use crate::check;
use crate::diagnostic::{Diagnostic, Position, Severity, Subject, codes};
use crate::edit::{self, Change};
use crate::export::Loss;
use crate::format::{self, Excerpt};
use crate::import::{FileFormat, Imported, Source};
use crate::model::{Clip, JointIndex, Model};
use crate::scene::Aabb;
use crate::slices::{Slices, Stage, at_once};
use crate::sorting;

/// A model that is on screen, with the file it came from.
#[derive(Clone, Debug)]
pub struct OpenModel {
    /// The file.
    pub file: File,
    /// What kind of file it was.
    pub format: FileFormat,
    /// Pictures that came with the file, as its materials name them.
    pub pictures: Vec<File>,
    /// The model, in the file's space.
    pub model: Model,
    /// What was mended or is worth knowing, in the order of the file.
    pub diagnostics: Vec<Diagnostic>,
    /// What only the file's format knows; of a book's format what the file says, until the books' verdicts are worked out of it.
    pub(in crate::session) source: Source,
    /// A name for each submesh: that of its material, with a number where several have the same.
    pub(in crate::session) submesh_names: Vec<String>,
    /// Box of the bind pose, in the file's space.
    pub bind_bounds: Aabb,
    /// The model's clips, compiled for sampling, in their order.
    pub compiled: Vec<CompiledClip>,
    /// The space that it needs without a clip.
    vertex_groups: OnceLock<VertexGroups>,
    at_rest: OnceLock<Extent>,
    /// One for each clip of the model.
    pub(in crate::session) clip_facts: Vec<ClipFacts>,
    /// Files whose clips joined, in their order.
    pub(in crate::session) joined: Vec<JoinedFile>,
}

/// A file whose clips joined the open model.
#[derive(Clone, Debug)]
pub(in crate::session) struct JoinedFile {
    pub(in crate::session) file: File,
    pub(in crate::session) files: Arc<FileSet>,
    /// What is noted of it when its bones stand elsewhere than the model's. It goes with the file.
    pub(in crate::session) noted: Option<Diagnostic>,
}

/// One row of the list of clips.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipSummary<'a> {
    /// Name to show, unique in the list.
    pub name: &'a str,
    /// Base name of the file that it came from.
    pub file_name: &'a str,
    /// First key time, seconds.
    pub start_secs: f32,
    /// Last key time, seconds.
    pub end_secs: f32,
    /// Number of keys that the file has for it.
    pub key_count: usize,
    /// Keys a second: the unit of a frame.
    pub keys_per_sec: f32,
    /// Number of its last frame, counted from 0.
    pub last_frame: u32,
    /// Whether it is kept over where it starts.
    pub in_place: bool,
}

/// What is known of one clip beside its keys.
#[derive(Clone, Debug, Default)]
pub(in crate::session) struct ClipFacts {
    pub(in crate::session) file_name: String,
    /// Whether it came from another file than the model.
    pub(in crate::session) joined: bool,
    /// The clip as its file has it, where it is kept in place, and what is otherwise since.
    pub(in crate::session) leading_away: Option<Arc<(Clip, Change)>>,
    extent: OnceLock<Extent>,
    key_times: OnceLock<Vec<f32>>,
    loop_gap: OnceLock<LoopGap>,
    activity: OnceLock<Vec<JointActivity>>,
    leads_away: OnceLock<bool>,
}

impl ClipFacts {
    /// A clip of the model's file, of which nothing else was asked yet.
    pub(in crate::session) fn of_file(file_name: &str) -> Self {
        Self {
            file_name: file_name.to_owned(),
            ..Self::default()
        }
    }

    /// The same of a clip that came from another file.
    pub(in crate::session) fn joined_from(file_name: &str) -> Self {
        Self {
            joined: true,
            ..Self::of_file(file_name)
        }
    }
}

/// The materials' names; the second that would have one is `Body (2)`, unless a material has that name itself.
fn submesh_names(model: &Model) -> Vec<String> {
    let of_materials: HashSet<&str> = model.materials.iter().map(|material| material.name.as_str()).collect();
    let mut last_numbers: HashMap<&str, usize> = HashMap::new();
    let submeshes = model.mesh.submeshes.iter();
    let names = submeshes.map(|submesh| {
        let material = model.materials.get(submesh.material as usize);
        let name = material.map_or("", |material| &material.name);
        let number = last_numbers.entry(name).or_default();
        loop {
            *number += 1;
            if *number == 1 {
                return name.to_owned();
            }
            let numbered = format!("{name} ({number})");
            if !of_materials.contains(numbered.as_str()) {
                return numbered;
            }
        }
    });
    names.collect()
}

impl OpenModel {
    /// A model that has just been read from a file.
    pub(in crate::session) async fn new(file: &File, imported: Imported, slices: &Slices) -> Self {
        let Imported {
            model,
            mut diagnostics,
            pictures,
            source,
        } = imported;
        let compiled = CompiledClip::all_in(&model.clips, slices).await;
        diagnostics.extend(check::model_in(&model, &compiled, &*source.places(&file.bytes), slices).await);
        sorting::sort_by_key(&mut diagnostics, |diagnostic| diagnostic.position);
        Self {
            file: file.clone(),
            format: source.format,
            pictures: pictures
                .iter()
                .map(|picture| File::sharing(&picture.name, picture.bytes.clone()))
                .collect(),
            diagnostics,
            source,
            compiled,
            submesh_names: submesh_names(&model),
            bind_bounds: model.bind_bounds(),
            vertex_groups: OnceLock::new(),
            at_rest: OnceLock::new(),
            clip_facts: vec![ClipFacts::of_file(file.base_name()); model.clips.len()],
            joined: Vec::new(),
            model,
        }
    }

    /// The space that a clip needs; that of rest without such a clip. In the file's space.
    pub fn extent(&self, clip: Option<usize>) -> &Extent {
        at_once(self.extent_in(clip, &Slices::ENDLESS))
    }

    /// [`OpenModel::extent`] in slices. By that of the first clip the model is framed.
    pub(in crate::session) async fn extent_in(&self, clip: Option<usize>, slices: &Slices) -> &Extent {
        let index = clip.unwrap_or(usize::MAX);
        let clip = self.compiled.get(index).zip(self.clip_facts.get(index));
        let kept = clip.map_or(&self.at_rest, |(_, facts)| &facts.extent);
        if let Some(extent) = kept.get() {
            return extent;
        }
        slices.pause_at(Stage::Measuring, 0, 1).await;
        let groups = match self.vertex_groups.get() {
            Some(groups) => groups,
            None => {
                let groups = VertexGroups::new(&self.model.mesh, slices).await;
                self.vertex_groups.get_or_init(|| groups)
            }
        };
        let extent = Extent::of(&self.model, groups, clip.map(|(clip, _)| clip), slices).await;
        kept.get_or_init(|| extent)
    }

    /// What was mended while the file was read, as changes: it is written as mended. Findings of the checks are none. Where only some clips
    /// are written, it is theirs; `None` is all.
    pub fn mended(&self, clips: Option<&[String]>) -> impl Iterator<Item = Change> {
        let is_check = |name: &str| {
            let groups = [codes::OF_MESH_AND_RIG, codes::OF_MOTION];
            groups.iter().any(|group| group.iter().any(|row| row.name == name))
        };
        let is_change = move |finding: &Diagnostic| {
            finding.severity == Severity::Warning && !is_check(finding.code) && !is_loss(finding)
        };
        self.of_reading(clips, is_change)
            .map(|Loss { code, message, .. }| Change { code, message })
    }

    /// What of the file was left out while it was read, as losses: no file that is written has it. A format that `keeps_objects` has them
    /// apart again. `clips` as for [`OpenModel::mended`].
    pub fn left_out(&self, clips: Option<&[String]>, keeps_objects: bool) -> impl Iterator<Item = Loss> {
        let is_kept = move |finding: &Diagnostic| {
            keeps_objects && [codes::GLTF_OBJECTS_MERGED.name, codes::FBX_OBJECTS_MERGED.name].contains(&finding.code)
        };
        self.of_reading(clips, move |finding| is_loss(finding) && !is_kept(finding))
    }

    fn of_reading(
        &self,
        clips: Option<&[String]>,
        is_wanted: impl Fn(&Diagnostic) -> bool,
    ) -> impl Iterator<Item = Loss> {
        let is_written = move |subject: &&Subject| match (clips, subject) {
            (Some(names), Subject::Clip(clip)) => {
                let clip = self.model.clips.get(*clip as usize);
                clip.is_some_and(|clip| names.contains(&clip.name))
            }
            _ => true,
        };
        let wanted = self.diagnostics.iter().filter(move |finding| is_wanted(finding));
        wanted.filter_map(move |warning| {
            let known = warning.subjects.len();
            let written = warning.subjects.iter().filter(is_written).count();
            let loss = |count, message| Loss {
                code: warning.code,
                message,
                count,
            };
            let sentence = || codes::named(warning.code).map_or("", |code| code.sentence);
            match written {
                _ if written == known => Some(loss(warning.count as usize, warning.message.clone())),
                // Of very many not all are known.
                0 if known < Diagnostic::MOST_PLACES => None,
                0 | 1 => Some(loss(1, sentence().to_owned())),
                _ => Some(loss(written, format!("{} It is so in {written} clips.", sentence()))),
            }
        })
    }

    /// Lines of the file around a diagnostic.
    pub fn excerpt(&self, diagnostic: &Diagnostic) -> Option<Excerpt> {
        Some(self.excerpt_at(diagnostic.position?, diagnostic.length))
    }

    /// Lines of the file around some bytes.
    pub fn excerpt_at(&self, position: Position, length: u32) -> Excerpt {
        format::excerpt(&self.file.bytes, position, length)
    }

    /// The list of clips, in the order of their indices.
    pub fn clip_list(&self) -> impl ExactSizeIterator<Item = ClipSummary<'_>> {
        self.model
            .clips
            .iter()
            .zip(&self.clip_facts)
            .map(|(clip, facts)| ClipSummary {
                name: &clip.name,
                file_name: &facts.file_name,
                start_secs: clip.start_secs,
                end_secs: clip.end_secs,
                key_count: clip.key_count,
                keys_per_sec: clip.keys_per_sec,
                last_frame: clip.last_frame(),
                in_place: facts.leading_away.is_some(),
            })
    }

    /// The clip that is shown first: the first that moves of those that joined, which somebody gave for their own sake, else of all; else the
    /// first. One that stands still looks as if the others had failed.
    pub fn first_clip(&self) -> Option<usize> {
        let clips = || self.model.clips.iter().zip(&self.clip_facts);
        let joined = clips().position(|(clip, facts)| facts.joined && !clip.is_still());
        let moving = joined.or_else(|| clips().position(|(clip, _)| !clip.is_still()));
        moving.or(clips().next().map(|_| 0))
    }

    /// Whether a clip leads away from where it starts.
    pub fn leads_away(&self, clip: usize) -> bool {
        let known = self.clip_facts[clip]
            .leads_away
            .get_or_init(|| edit::leads_away(&self.model, &self.model.clips[clip]));
        *known
    }

    /// The names of the clips that are kept in place, with what is otherwise in each.
    pub(in crate::session) fn kept_in_place(&self) -> impl Iterator<Item = (&String, &Change)> {
        let clips = self.model.clips.iter().zip(&self.clip_facts);
        clips.filter_map(|(clip, facts)| Some((&clip.name, &facts.leading_away.as_ref()?.1)))
    }

    /// Length of the model's diagonal in the bind pose, in its own units: a mesh's, or else that of its joints; 1 where both
    /// are a point.
    pub fn size(&self) -> f32 {
        let joints = self.model.skeleton.bind_model_from_joint();
        let of_joints = || Aabb::from_points(joints.iter().map(|joint| joint.translation.into()));
        let diagonal = |bounds: Aabb| {
            if bounds.is_empty() {
                0.0
            } else {
                bounds.min.distance(bounds.max)
            }
        };
        let sizes = [diagonal(self.bind_bounds), diagonal(of_joints()), 1.0];
        sizes
            .into_iter()
            .find(|&size| size > 0.0 && size.is_finite())
            .unwrap_or(1.0)
    }

    /// A clip, as authored and as compiled.
    pub(in crate::session) fn clip(&self, index: usize) -> Option<(&Clip, &CompiledClip)> {
        self.model.clips.get(index).zip(self.compiled.get(index))
    }

    /// How the last pose of a clip differs from the first; `None` without such a clip.
    pub fn loop_gap(&self, clip: usize) -> Option<&LoopGap> {
        let (clip, facts) = (self.compiled.get(clip)?, self.clip_facts.get(clip)?);
        Some(
            facts
                .loop_gap
                .get_or_init(|| self.loop_gap_between(clip, [clip.start_secs(), clip.end_secs()])),
        )
    }

    pub(in crate::session) fn loop_gap_between(&self, clip: &CompiledClip, span_secs: [f32; 2]) -> LoopGap {
        anim::loop_gap(&self.model.skeleton, clip, span_secs, self.size())
    }

    /// How much each joint moves in a clip, in the skeleton's order; `None` without such a clip.
    pub fn activity(&self, clip: usize) -> Option<&[JointActivity]> {
        let (clip, facts) = (self.model.clips.get(clip)?, self.clip_facts.get(clip)?);
        let activity = || anim::activity(&self.model.skeleton, clip, self.size());
        Some(facts.activity.get_or_init(activity))
    }

    /// Key times of a clip, in order: of one joint, or of all. Empty without such a clip or joint.
    pub fn key_times(&self, clip: usize, joint: Option<JointIndex>) -> &[f32] {
        let (Some(clip), Some(facts)) = (self.model.clips.get(clip), self.clip_facts.get(clip)) else {
            return &[];
        };
        match joint {
            Some(joint) => anim::key_times(clip, joint),
            None => facts.key_times.get_or_init(|| anim::merged_key_times(clip)),
        }
    }
}

/// Whether a part of the file is not in the model.
fn is_loss(finding: &Diagnostic) -> bool {
    let losses = [
        &codes::GLTF_EXTENSION_UNKNOWN,
        &codes::GLTF_PRIMITIVE_LEFT_OUT,
        &codes::GLTF_MORPH_ANIMATION_LEFT_OUT,
        &codes::GLTF_MORPH_TARGETS_LEFT_OUT,
        &codes::GLTF_OBJECTS_MERGED,
        &codes::GLTF_NODES_LEFT_OUT,
        &codes::GLTF_SCENE_LEFT_OUT,
        &codes::GLTF_EXTRAS_LEFT_OUT,
        &codes::GLTF_ATTRIBUTE_LEFT_OUT,
        &codes::GLTF_MAP_LEFT_OUT,
        &codes::GLTF_CHANNEL_LEFT_OUT,
        &codes::GLTF_IMAGE_NOT_READ,
        &codes::FBX_LEFT_OUT,
        &codes::FBX_OBJECTS_MERGED,
        &codes::WEIGHTS_CUT,
    ];
    losses.iter().any(|code| code.name == finding.code)
}
