//! Tests of `edit`: what an edit promises, on models made by rule, random ones and real ones.

mod closing;
mod fixing;
mod for_book;
mod in_place;
mod naming;
mod orders;
mod ranges;
mod reducing;
mod retargeting;
mod spaces;

use bindpose::anim::{CompiledClip, PoseBuffers, SkinnedVertices, skin};
use bindpose::edit::{EditError, Edited, Edits, apply};
use bindpose::format::{AnimationClip, Document};
use bindpose::model::{Channel, Clip, JointNames, LocalJoint, Model, Track, world_from_model};
use glam::{EulerRot, Quat, Vec3};

use crate::documents::{key, material, model_of, offset, subset, track, vertex, with_rotation, with_translation};

/// One edit, without names of a person.
fn edit(model: &Model, edits: &Edits) -> Edited {
    try_edit(model, edits).expect("the edit can be made")
}

fn try_edit(model: &Model, edits: &Edits) -> Result<Edited, EditError> {
    let edited = apply(model.clone(), &JointNames::default(), edits)?;
    edited.model.clone().checked().expect("an edit leaves a sound model");
    Ok(edited)
}

/// The model as the world sees it at a time.
fn seen(model: &Model, clip: usize, secs: f32) -> SkinnedVertices {
    let clip = model.clips.get(clip).map(CompiledClip::new);
    seen_in(model, clip.as_ref(), secs)
}

/// The same with a clip that was compiled before, for many times.
fn seen_in(model: &Model, clip: Option<&CompiledClip>, secs: f32) -> SkinnedVertices {
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    if let Some(clip) = clip {
        pose.evaluate(&model.skeleton, clip, secs);
    }
    let mut skinned = SkinnedVertices::default();
    skin(&model.mesh, &pose.palette, &mut skinned);
    let world = world_from_model(model.handedness, model.up_axis, model.front);
    for position in &mut skinned.positions {
        *position = world.transform_point3(*position);
    }
    for normal in &mut skinned.normals {
        *normal = world.transform_vector3(*normal);
    }
    for tangent in &mut skinned.tangents {
        // The sign goes with the space: a mirror turns it round.
        let sign = tangent.w * world.matrix3.determinant().signum();
        *tangent = world.transform_vector3(tangent.truncate()).extend(sign);
    }
    skinned
}

/// The farthest that two lists of points are apart.
fn apart(a: &[Vec3], b: &[Vec3]) -> f32 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
}

/// The diagonal of the bind pose.
fn size(model: &Model) -> f32 {
    model.bind_bounds().size().length()
}

/// All key times of a clip.
fn key_times(clip: &Clip) -> Vec<f32> {
    let keyed = clip.tracks.iter().filter(|track| track.has_keys());
    let mut times: Vec<f32> = keyed.flat_map(|track| track.times_secs()).copied().collect();
    times.sort_by(f32::total_cmp);
    times.dedup();
    times
}

/// Times all over a clip, its ends among them.
fn spread(clip: &Clip) -> impl Iterator<Item = f32> {
    let (start, end) = (clip.start_secs, clip.end_secs);
    (0..=40).map(move |step| (start + (end - start) * step as f32 / 40.0).min(end))
}

/// The sample figure.
fn figure() -> Model {
    crate::documents::read_parsed(&crate::documents::figure()).0
}

/// A chain of bones whose keys sway smoothly, thirty a second, with a vertex on each and triangles between them.
pub(crate) fn swaying(bones: u32, secs: f32) -> Document {
    let keys_of = |bone: u32| {
        let one = |index: u32| {
            let time_secs = index as f32 / 30.0;
            let phase = time_secs * (1.0 + bone as f32 * 0.3);
            let turn = Quat::from_euler(
                EulerRot::XYZ,
                0.3 * phase.sin(),
                0.2 * phase.cos(),
                0.4 * (2.0 * phase).sin(),
            );
            bindpose::format::Keyframe {
                rotation: turn.to_array(),
                ..key(time_secs, [0.0, if bone == 0 { 0.1 * phase.sin() } else { 0.5 }, 0.0])
            }
        };
        track((0..=(secs * 30.0) as u32).map(one).collect::<Vec<_>>())
    };
    let corner = |bone: u32, x: f32, z: f32| {
        let mut corner = vertex(x, bone as f32 * 0.5);
        corner.position[2] = z;
        corner.normal = [0.0, 1.0, 0.0];
        corner.tangent = [1.0, 0.0, 0.0, -1.0];
        corner.tex_coords = [x, z];
        corner.blend_weights = [0.75, 0.25, 0.0, 0.0];
        corner.blend_indices = [bone, bone.saturating_sub(1), 0, 0];
        corner
    };
    Document {
        materials: vec![material("skin")],
        subsets: vec![subset(0, bones)],
        vertices: (0..bones)
            .flat_map(|bone| [corner(bone, 0.0, 0.0), corner(bone, 0.1, 0.3), corner(bone, 0.3, 0.05)])
            .collect(),
        triangles: (0..bones).map(|bone| [bone * 3, bone * 3 + 1, bone * 3 + 2]).collect(),
        bone_offsets: (0..bones).map(|bone| offset([0.0, bone as f32 * 0.5, 0.0])).collect(),
        bone_parents: (0..bones as i32).map(|bone| bone - 1).collect(),
        clips: vec![AnimationClip {
            name: "sway".to_owned(),
            bones: (0..bones).map(keys_of).collect(),
        }],
        ..Document::default()
    }
}

/// A chain of three joints of which one goes along cubic splines and one is held from key to key.
fn curved() -> Model {
    let (mut model, _) = model_of(&swaying(3, 2.0));
    let joint = |lift: f32, angle: f32, stretch: f32| LocalJoint {
        translation: Vec3::new(lift, 0.5, -lift),
        rotation: Quat::from_euler(EulerRot::XYZ, angle, 0.5 * angle, -angle),
        scale: Vec3::new(1.0, 1.0 + stretch, 1.0 - 0.5 * stretch),
    };
    let keys = [
        (0.25, joint(0.0, 0.0, 0.0)),
        (0.75, joint(0.4, 0.9, 0.2)),
        (1.5, joint(-0.2, -0.5, 0.1)),
    ];
    let slope = |key: usize| Vec3::new(key as f32 * 0.4 - 0.5, 0.3, 0.2);
    let turn_slope = |key: usize| Quat::from_xyzw(0.4, 0.1 * key as f32, -0.3, 0.05);
    let rows = Track::new(keys).expect("keys in order");
    let bent = (0..3).map(|key| (keys[key].0, keys[key].1.translation, [slope(key), slope(key + 1)]));
    let turned = (0..3).map(|key| {
        (
            keys[key].0,
            rows.key(key).rotation,
            [turn_slope(key), turn_slope(key + 1)],
        )
    });
    let mut tracks = model.clips[0].tracks.clone();
    tracks[1] = with_rotation(&with_translation(&rows, Channel::spline(bent)), Channel::spline(turned));
    tracks[2] = Track::of_channels(
        rows.translation().clone(),
        Channel::held(keys.map(|(secs, joint)| (secs, joint.rotation))).expect("keys in order"),
        Channel::held(keys.map(|(secs, joint)| (secs, joint.scale))).expect("keys in order"),
    );
    model.clips[0] = Clip::new("sway", tracks);
    model
}
