//! What the books' demo needs of a model, beside its axes: see [`check::book`](crate::check::book).

use glam::Affine3A;

use super::edited::{Change, Edited, counted, with_tracks};
use super::error::EditError;
use super::space;
use crate::anim::{CompiledClip, PoseBuffers, skin_positions, straight};
use crate::check::book::{DEMO_CLIP, DEMO_MATERIALS, DEMO_SCALE, MOST_BONES, MOST_VERTICES, SEEN_HEIGHTS};
use crate::diagnostic::collect::{few, quoted};
use crate::diagnostic::{Code, Fault, codes};
use crate::model::{Aabb, Clip, Influences, JointIndex, JointNames, LocalJoint, Model, Skeleton, Track, unique_words};

/// So many nodes that keep still stand above an armature at most: it, and what it was put into. More are not folded, since each takes a pass
/// over the model.
const MOST_FOLDED: usize = 8;

const SOLDIER_HEIGHT: f32 = 72.0;

/// What no edit makes small enough for the books' demo: too many bones or vertices, each with its code and a sentence.
pub fn too_large_for_book(model: &Model) -> Vec<(&'static Code, String)> {
    if !(1..=MOST_FOLDED).contains(&bone_count(model).saturating_sub(MOST_BONES)) {
        return too_large(model);
    }
    let mut edited = Edited {
        model: model.clone(),
        names: JointNames::default(),
        changes: Vec::new(),
    };
    fold_still_roots(&mut edited).map_or_else(|_| too_large(model), |()| too_large(&edited.model))
}

/// Folds what keeps still above a model of too many bones into the bone below, and refuses what no edit makes small enough.
pub(super) fn check_size(edited: &mut Edited) -> Result<(), EditError> {
    fold_still_roots(edited)?;
    let why = too_large(&edited.model);
    if why.is_empty() {
        return Ok(());
    }
    let sentences: Vec<String> = why.into_iter().map(|(_, sentence)| sentence).collect();
    Err(EditError::TooLarge(sentences.join(" ")))
}

fn too_large(model: &Model) -> Vec<(&'static Code, String)> {
    let (bones, vertices) = (bone_count(model), model.mesh.vertex_count());
    let mut why = Vec::new();
    if bones > MOST_BONES {
        let with_root = if needs_root(model) {
            " with the root that all hang from"
        } else {
            ""
        };
        let sentence = format!("The model has {bones} bones{with_root}; the books' demo has room for {MOST_BONES}.");
        why.push((&codes::MANY_BONES, sentence));
    }
    if vertices > MOST_VERTICES {
        let sentence = format!("The model has {vertices} vertices; the books' demo can number {MOST_VERTICES}.");
        why.push((&codes::MANY_VERTICES, sentence));
    }
    why
}

/// How many bones it has for the demo, with the root that it may lack.
fn bone_count(model: &Model) -> usize {
    model.skeleton.joint_count() + usize::from(needs_root(model))
}

fn fold_still_roots(edited: &mut Edited) -> Result<(), Fault> {
    let excess = bone_count(&edited.model).saturating_sub(MOST_BONES);
    if excess > MOST_FOLDED {
        return Ok(());
    }
    for _ in 0..excess {
        let Some(joint) = still_root(&edited.model) else { break };
        fold(edited, joint)?;
    }
    Ok(())
}

/// A root with one child that moves no vertex and has no keys, such as the object of an armature. It scales evenly, so that the child can do
/// what it does.
fn still_root(model: &Model) -> Option<usize> {
    let skeleton = &model.skeleton;
    let mut children = vec![0; skeleton.joint_count()];
    for parent in skeleton.parents().iter().flatten() {
        children[parent.index()] += 1;
    }
    let mut moves = vec![false; skeleton.joint_count()];
    for influences in &model.mesh.influences {
        for (&joint, &weight) in influences.joints.iter().zip(&influences.weights) {
            moves[joint as usize] |= weight > 0.0;
        }
    }
    let mut joints = 0..skeleton.joint_count();
    joints.find(|&joint| {
        let scale = skeleton.rest()[joint].scale;
        let is_still = model.clips.iter().all(|clip| !clip.tracks[joint].has_keys());
        skeleton.parents()[joint].is_none()
            && (children[joint], moves[joint], is_still) == (1, false, true)
            && scale.min_element() > 0.0
            && scale.max_element() - scale.min_element() <= 1e-6 * scale.max_element()
    })
}

/// Takes a root out; its only child does what it did.
fn fold(edited: &mut Edited, root: usize) -> Result<(), Fault> {
    let model = &mut edited.model;
    let old = &model.skeleton;
    let (bone, still) = (old.file_bones()[root], old.rest()[root]);
    let folded = |joint: LocalJoint| LocalJoint {
        rotation: still.rotation * joint.rotation,
        translation: still.rotation * (still.scale * joint.translation) + still.translation,
        scale: still.scale * joint.scale,
    };
    let is_child = |joint: usize| old.parents()[joint].is_some_and(|parent| parent.index() == root);
    let kept: Vec<usize> = (0..old.joint_count()).filter(|&joint| joint != root).collect();
    let place = |joint: u32| joint - u32::from(joint as usize > root);
    let parents = kept.iter().map(|&joint| {
        let parent = old.parents()[joint].filter(|_| !is_child(joint));
        parent.map(|parent| JointIndex(place(parent.0)))
    });
    let bones = kept.iter().map(|&joint| old.file_bones()[joint]);
    let rest: Vec<LocalJoint> = kept
        .iter()
        .map(|&joint| {
            if is_child(joint) {
                folded(old.rest()[joint])
            } else {
                old.rest()[joint]
            }
        })
        .collect();
    let all_names: Vec<String> = space::names_of(old).collect();
    let name = &all_names[root];
    let new = Skeleton::new(
        parents.collect(),
        kept.iter().map(|&joint| old.joint_from_bind()[joint]).collect(),
        bones.map(|other| other - u32::from(other > bone)).collect(),
    )?;
    let names = kept.iter().map(|&joint| all_names[joint].clone());
    let new = space::rested(new, old, &rest).with_names(names.collect());
    for clip in &mut model.clips {
        let tracks = kept.iter().map(|&joint| {
            let track = &clip.tracks[joint];
            if !is_child(joint) {
                return Ok(track.clone());
            }
            if !track.has_keys() {
                return Ok(Track::at_rest(folded(track.key(0))));
            }
            Track::new(straight(track).keys().map(|(secs, joint)| (secs, folded(joint))))
        });
        *clip = with_tracks(clip, tracks.collect::<Result<_, _>>()?);
    }
    for influences in &mut model.mesh.influences {
        // A slot without weight names any joint.
        influences.joints = influences.joints.map(place);
    }
    let name = if name.is_empty() {
        String::new()
    } else {
        format!(", \"{name}\",")
    };
    let message = format!(
        "Bone {bone}{name} keeps still and moves nothing: the one below does what it did, and bones have other numbers."
    );
    model.skeleton = new;
    edited.names = renumbered(&edited.names, |other| {
        (other != bone).then_some(other - u32::from(other > bone))
    });
    edited.changes.push(Change::new("bones-folded", message));
    Ok(())
}

/// The factor that makes a model as high as the books' soldier, where it is too small or too large to be seen. Its y is up. The height is
/// that of its first pose: the bind pose of other programs may lie down, or be of another size.
pub(super) fn scale(model: &Model) -> Option<f32> {
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    if let Some(clip) = model.clips.first() {
        pose.evaluate(&model.skeleton, &CompiledClip::new(clip), clip.start_secs);
    }
    let mut positions = Vec::new();
    skin_positions(&model.mesh, &pose.palette, &mut positions);
    let height = Aabb::from_points(positions).size().y;
    let is_seen = SEEN_HEIGHTS[0]..=SEEN_HEIGHTS[1];
    let factor = SOLDIER_HEIGHT / height;
    let is_small_or_large = model.skeleton.joint_count() > 0 && !is_seen.contains(&(height * DEMO_SCALE));
    (is_small_or_large && height > 0.0 && factor.is_finite()).then_some(factor)
}

/// Bones, keys and names as the demo takes them.
pub(super) fn shape(edited: &mut Edited) -> Result<(), EditError> {
    if edited.model.skeleton.joint_count() == 0 {
        name_materials(edited);
        return Ok(());
    }
    // Which clip the demo plays is told first.
    name_clips(edited);
    name_materials(edited);
    if needs_root(&edited.model) {
        add_root(edited)?;
    }
    order_bones(edited)?;
    add_clip(edited)?;
    give_keys(edited, true)
}

/// Whether there are several roots, or vertices that no bone moves: the demo's shader gives these to bone 0.
fn needs_root(model: &Model) -> bool {
    let roots = model
        .skeleton
        .parents()
        .iter()
        .filter(|parent| parent.is_none())
        .count();
    roots > 0 && (roots > 1 || model.mesh.influences.iter().any(is_free))
}

/// Whether no bone moves a vertex.
fn is_free(influences: &Influences) -> bool {
    influences.weights == [0.0; 4]
}

/// Hangs all roots from a bone 0 that keeps still, and gives it the vertices that nothing moves.
fn add_root(edited: &mut Edited) -> Result<(), Fault> {
    let model = &mut edited.model;
    let old = &model.skeleton;
    let roots = old.parents().iter().filter(|parent| parent.is_none()).count();
    let below = |joint: &Option<JointIndex>| Some(JointIndex(joint.map_or(0, |joint| joint.0 + 1)));
    let parents = [None].into_iter().chain(old.parents().iter().map(below));
    let joint_from_bind = [Affine3A::IDENTITY]
        .into_iter()
        .chain(old.joint_from_bind().iter().copied());
    let file_bones = [0].into_iter().chain(old.file_bones().iter().map(|bone| bone + 1));
    let rest: Vec<LocalJoint> = [LocalJoint::IDENTITY]
        .into_iter()
        .chain(old.rest().iter().copied())
        .collect();
    let names = [String::new()].into_iter().chain(space::names_of(old));
    let new = Skeleton::new(parents.collect(), joint_from_bind.collect(), file_bones.collect())?;
    model.skeleton = space::rested(new, old, &rest).with_names(names.collect());
    for clip in &mut model.clips {
        let root = Track::at_rest(LocalJoint::IDENTITY);
        *clip = with_tracks(clip, [root].into_iter().chain(clip.tracks.iter().cloned()).collect());
    }
    let mut freed = 0;
    for influences in &mut model.mesh.influences {
        if is_free(influences) {
            freed += 1;
            *influences = Influences {
                joints: [0; 4],
                weights: [1.0, 0.0, 0.0, 0.0],
            };
            continue;
        }
        for (joint, &weight) in influences.joints.iter_mut().zip(&influences.weights) {
            *joint = if weight > 0.0 { *joint + 1 } else { 0 };
        }
    }
    edited.names = renumbered(&edited.names, |bone| Some(bone + 1));
    let roots = counted(roots, "root hangs", "roots hang");
    edited.changes.push(Change::new(
        codes::BOOK_ROOTS.name,
        format!("There is a new bone 0 that keeps still; {roots} from it, and all bones have another number."),
    ));
    if freed > 0 {
        edited.changes.push(Change::new(
            codes::WEIGHTS_ALL_ZERO.name,
            format!(
                "{} on bone 0, since no other moved {}.",
                counted(freed, "vertex hangs", "vertices hang"),
                if freed == 1 { "it" } else { "them" }
            ),
        ));
    }
    Ok(())
}

/// Numbers the bones with parents first, where they are not.
fn order_bones(edited: &mut Edited) -> Result<(), Fault> {
    let old = &edited.model.skeleton;
    let bones = old.file_bones();
    let is_before = |(joint, parent): (usize, &Option<JointIndex>)| {
        parent.is_none_or(|parent| bones[parent.index()] < bones[joint])
    };
    if old.parents().iter().enumerate().all(is_before) {
        return Ok(());
    }
    let joint_of_bone = old.joint_of_bone().to_vec();
    let new = Skeleton::new(
        old.parents().to_vec(),
        old.joint_from_bind().to_vec(),
        (0..old.joint_count() as u32).collect(),
    )?;
    let new = space::rested(new, old, old.rest()).with_names(space::names_of(old).collect());
    edited.names = renumbered(&edited.names, |bone| {
        joint_of_bone.get(bone as usize).map(|joint| joint.0)
    });
    edited.model.skeleton = new;
    edited.changes.push(Change::new(
        codes::BONES_REORDERED.name,
        "Bones are numbered anew, so that parents come first.",
    ));
    Ok(())
}

fn renumbered(names: &JointNames, new: impl Fn(u32) -> Option<u32>) -> JointNames {
    let mut renumbered = JointNames::default();
    for (&bone, name) in names.all() {
        if let Some(bone) = u32::try_from(bone).ok().and_then(&new) {
            renumbered.set(bone, name);
        }
    }
    renumbered
}

/// A model without clips gets one that keeps still.
fn add_clip(edited: &mut Edited) -> Result<(), Fault> {
    let model = &mut edited.model;
    if model.clips.is_empty() {
        let still = model.skeleton.rest().iter().map(|&rest| Track::new([(0.0, rest)]));
        model.clips.push(Clip::new(DEMO_CLIP, still.collect::<Result<_, _>>()?));
        edited.changes.push(Change::new(
            codes::BOOK_CLIP_NAME.name,
            format!("There is a clip \"{DEMO_CLIP}\" now, in which it stands still; there was none."),
        ));
    }
    Ok(())
}

/// At least one key for each bone, without which the books' programs stop; where asked, the first at 0 s, where the demo begins.
pub(super) fn give_keys(edited: &mut Edited, begins_at_zero: bool) -> Result<(), EditError> {
    let (mut least, mut most, mut names) = (usize::MAX, 0, Vec::new());
    for clip in &mut edited.model.clips {
        let start_secs = clip.start_secs;
        let shift_secs = if begins_at_zero { start_secs } else { 0.0 };
        let resting = clip.tracks.iter().filter(|track| !track.has_keys()).count();
        if shift_secs == 0.0 && resting == 0 {
            continue;
        }
        let keyed = |track: &Track| match track.has_keys() {
            true => track.shifted_earlier(shift_secs),
            false => Track::new([(start_secs - shift_secs, track.key(0))]),
        };
        let tracks = clip.tracks.iter().map(keyed).collect::<Result<_, _>>()?;
        *clip = with_tracks(clip, tracks);
        if resting > 0 {
            (least, most) = (least.min(resting), most.max(resting));
            names.push(quoted(&clip.name));
        }
        if shift_secs != 0.0 {
            edited.changes.push(Change::new(
                "clip-shifted",
                format!("\"{}\" begins at 0 s, not at {start_secs} s.", clip.name),
            ));
        }
    }
    if most > 0 {
        let who = counted(most, "bone gets", "bones get");
        let who = if least < most { format!("Up to {who}") } else { who };
        edited.changes.push(Change::new(
            codes::TRACK_EMPTY.name,
            format!("{who} a key at rest in {}.", few(&names)),
        ));
    }
    Ok(())
}

/// A word for each clip, and the demo's for one of them.
fn name_clips(edited: &mut Edited) {
    let clips = &mut edited.model.clips;
    let mut names = unique_words(clips.iter().map(|clip| clip.name.as_str()));
    if let (false, Some(first)) = (names.iter().any(|name| name == DEMO_CLIP), names.first_mut()) {
        DEMO_CLIP.clone_into(first);
    }
    for (clip, name) in clips.iter_mut().zip(names) {
        if clip.name != name {
            let message = format!("Clip \"{}\" is named \"{name}\".", clip.name);
            edited.changes.push(Change::new(codes::BOOK_CLIP_NAME.name, message));
            clip.name = name;
        }
    }
}

fn name_materials(edited: &mut Edited) {
    let materials = &mut edited.model.materials;
    // One of the demo's own names would take the place of its material.
    let free = |name: &str| format!("{name}{}", if DEMO_MATERIALS.contains(&name) { "_2" } else { "" });
    let free: Vec<String> = materials.iter().map(|material| free(&material.name)).collect();
    let names = unique_words(free.iter().map(String::as_str));
    for (material, name) in materials.iter_mut().zip(names) {
        if material.name != name {
            let message = format!("Material \"{}\" is named \"{name}\".", material.name);
            edited.changes.push(Change::new("material-renamed", message));
            material.name = name;
        }
    }
}
