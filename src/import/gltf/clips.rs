//! From animations to clips: a track for each joint, with the channels that move it.

use std::collections::HashMap;

use glam::{Quat, Vec3};

use super::skeleton::Rig;
use crate::diagnostic::collect::{Diagnostics, Moments, Place, counted};
use crate::diagnostic::{Code, Fault, Subject, codes};
use crate::gltf::{Animation, Interpolation, Path, Reader, Root, Wanted, fault, out_of_range};
use crate::import::keys::{self, Mended};
use crate::model::{Channel, ChannelValue, Clip, LocalJoint, Track, unique_names};
use crate::slices::Slices;

/// More tracks than this do not come from a file of a character.
const MAX_TRACKS: usize = 1_000_000;

/// The clips of a document for its skeleton, and the animation of each. Animations that move no joint are none.
///
/// # Errors
/// When a channel names what is not there, or its numbers are of the wrong kind.
pub(super) async fn clips(
    root: &Root,
    reader: &Reader<'_>,
    rig: &Rig,
    diagnostics: &mut Diagnostics,
    slices: &Slices,
) -> Result<(Vec<Clip>, Vec<u32>), Fault> {
    let joint_count = rig.skeleton.joint_count();
    if root.animations().len().saturating_mul(joint_count) > MAX_TRACKS {
        let message = format!(
            "{} animations of {joint_count} joints do not fit into memory.",
            root.animations().len()
        );
        return Err(fault(&codes::GLTF_TOO_LARGE, "/animations", message));
    }
    let mut read = Vec::new();
    for (index, animation) in root.animations().iter().enumerate() {
        let mut clip = ClipReader {
            index,
            clip: read.len() as u32,
            root,
            reader,
            rig,
            diagnostics,
            noted: Noted::default(),
        };
        if let Some(tracks) = clip.read(animation, slices).await? {
            read.push((index, tracks));
        }
    }
    let name = |&(index, _): &(usize, Vec<Track>)| root.animations()[index].name.as_deref().unwrap_or_default();
    let names = unique_names(read.iter().map(name), "clip", |index, name| {
        let message = format!("Another clip has the same name; this one is shown as \"{name}\".");
        let animation = read[index as usize].0;
        let place = Place::pointer(format!("/animations/{animation}/name")).about(Subject::Clip(index));
        diagnostics.add(&codes::DUPLICATE_CLIP_NAME, place, message);
    });
    let clips = names.into_iter().zip(read);
    Ok(clips
        .map(|(name, (animation, tracks))| (Clip::new(name, tracks), animation as u32))
        .unzip())
}

/// What moves a joint.
#[derive(Default)]
struct Channels {
    translation: Option<Channel<Vec3>>,
    rotation: Option<Channel<Quat>>,
    scale: Option<Channel<Vec3>>,
}

impl Channels {
    fn is_empty(&self) -> bool {
        self.translation.is_none() && self.rotation.is_none() && self.scale.is_none()
    }

    fn track(self, rest: LocalJoint) -> Track {
        Track::of_channels(
            self.translation.unwrap_or_else(|| Channel::at_rest(rest.translation)),
            self.rotation.unwrap_or_else(|| Channel::at_rest(rest.rotation)),
            self.scale.unwrap_or_else(|| Channel::at_rest(rest.scale)),
        )
    }
}

/// What is noted of a clip, counted over its channels.
#[derive(Default)]
struct Noted {
    mended: Mended,
    negative: Moments,
    overflowing: usize,
    elsewhere: usize,
    morphs: usize,
}

struct ClipReader<'a> {
    index: usize,
    clip: u32,
    root: &'a Root,
    reader: &'a Reader<'a>,
    rig: &'a Rig,
    diagnostics: &'a mut Diagnostics,
    noted: Noted,
}

impl ClipReader<'_> {
    /// The tracks; `None` for an animation that moves no joint.
    async fn read(&mut self, animation: &Animation, slices: &Slices) -> Result<Option<Vec<Track>>, Fault> {
        let mut joints: HashMap<u32, Channels> = HashMap::new();
        for (channel, of_file) in animation.channels.iter().enumerate() {
            slices.pause().await;
            let pointer = format!("/animations/{}/channels/{channel}", self.index);
            let Some(node) = of_file.target.node else {
                self.noted.elsewhere += 1;
                continue;
            };
            let nodes = self.root.nodes().len();
            let Some(index) = usize::try_from(node.0).ok().filter(|&node| node < nodes) else {
                return Err(out_of_range(&format!("{pointer}/target/node"), "node", node.0, nodes));
            };
            let joint = match (of_file.target.path, self.rig.joint_of_node[index]) {
                (Path::Translation | Path::Rotation | Path::Scale, Some(joint)) => joint,
                (Path::Weights, _) => {
                    self.noted.morphs += 1;
                    continue;
                }
                _ => {
                    self.noted.elsewhere += 1;
                    continue;
                }
            };
            let channels = joints.entry(joint).or_default();
            let sampler = of_file.sampler.0;
            let overflows = match of_file.target.path {
                Path::Translation => set(
                    &mut channels.translation,
                    || self.keys(animation, sampler, &pointer, joint, Wanted::Floats),
                    Vec3::from_array,
                )?,
                Path::Scale => set(
                    &mut channels.scale,
                    || self.keys(animation, sampler, &pointer, joint, Wanted::Floats),
                    Vec3::from_array,
                )?,
                _ => set(
                    &mut channels.rotation,
                    || self.keys(animation, sampler, &pointer, joint, Wanted::Rotations),
                    Quat::from_array,
                )?,
            };
            self.noted.overflowing += usize::from(overflows);
        }
        self.note();
        if joints.values().all(Channels::is_empty) {
            return Ok(None);
        }
        let rest = (0u32..).zip(self.rig.skeleton.rest());
        let tracks = rest.map(|(joint, &rest)| joints.remove(&joint).unwrap_or_default().track(rest));
        Ok(Some(tracks.collect()))
    }

    /// The keys of a sampler: finite, in strictly increasing time. `pointer` is its channel.
    fn keys<const N: usize>(
        &mut self,
        animation: &Animation,
        sampler: u64,
        pointer: &str,
        joint: u32,
        wanted: Wanted,
    ) -> Result<Keys<N>, Fault> {
        let samplers = &animation.samplers;
        let Some((index, of_file)) = usize::try_from(sampler)
            .ok()
            .and_then(|index| Some((index, samplers.get(index)?)))
        else {
            return Err(out_of_range(
                &format!("{pointer}/sampler"),
                "sampler",
                sampler,
                samplers.len(),
            ));
        };
        let at = format!("/animations/{}/samplers/{index}", self.index);
        let reader = self.reader;
        let times = reader.floats::<1>(of_file.input, Wanted::Floats, &format!("{at}/input"))?;
        let values: Vec<[f32; N]> = reader.floats(of_file.output, wanted, &format!("{at}/output"))?;
        let each = if of_file.interpolation == Interpolation::CubicSpline {
            3
        } else {
            1
        };
        let slopes = |group: &[[f32; N]]| match *group {
            [into, value, out] => (value, [into, out]),
            _ => (group[0], [[0.0; N]; 2]),
        };
        let mut rows = Vec::with_capacity(times.len());
        let bone = self.rig.skeleton.file_bones()[joint as usize];
        for (&[time_secs], group) in times.iter().zip(values.chunks_exact(each)) {
            let (mut value, slopes) = slopes(group);
            let is_sound = group.as_flattened().iter().all(|number| number.is_finite());
            if !is_sound || !keys::is_time(time_secs) {
                add(&mut self.noted.mended.not_finite, bone, time_secs);
                continue;
            }
            if time_secs < 0.0 {
                add(&mut self.noted.negative, bone, time_secs);
            }
            if let (Wanted::Rotations, Some(stored)) = (wanted, value.first_chunk()) {
                let count = |moments: &mut Moments| add(moments, bone, time_secs);
                let rotation = self.noted.mended.rotation(Quat::from_array(*stored), count);
                value.copy_from_slice(&rotation.to_array());
            }
            // Adding 0 makes −0 and 0 the same time for the sort as well.
            rows.push((time_secs + 0.0, (value, slopes)));
        }
        Ok(Keys {
            interpolation: if rows.len() == 1 {
                Interpolation::Linear
            } else {
                of_file.interpolation
            },
            rows: self
                .noted
                .mended
                .in_order(rows, |moments, key| add(moments, bone, key.0)),
        })
    }

    fn note(&mut self) {
        let noted = std::mem::take(&mut self.noted);
        let place = Place::pointer(format!("/animations/{}", self.index)).about(Subject::Clip(self.clip));
        let mut tell = |code: &Code, moments: &Moments, message| {
            self.diagnostics.add(code, place.clone().at(moments.first()), message);
        };
        noted.mended.tell(["sampler has", "samplers have"], &mut tell);
        if noted.negative.count > 0 {
            let (who, what) = (["key has", "keys have"], "a time below 0, which glTF does not have");
            let message = keys::in_words(&noted.negative, who, what, "kept where they are");
            tell(&codes::GLTF_RULE_BROKEN, &noted.negative, message);
        }
        let mut note = |code: &Code, count: usize, [one, many]: [&str; 2], what: &str| {
            if count > 0 {
                let message = format!("{} {what}.", counted(count, one, many));
                self.diagnostics.add(code, place.clone(), message);
            }
        };
        let move_what = ["channel moves", "channels move"];
        note(
            &codes::GLTF_RULE_BROKEN,
            noted.overflowing,
            ["channel follows", "channels follow"],
            "a spline whose numbers overflow between its keys; taken as straight",
        );
        note(
            &codes::GLTF_CHANNEL_LEFT_OUT,
            noted.elsewhere,
            move_what,
            "something that is not shown; left out",
        );
        note(
            &codes::GLTF_MORPH_ANIMATION_LEFT_OUT,
            noted.morphs,
            move_what,
            "shape keys (morph targets); left out",
        );
    }
}

/// The keys of a channel: time in seconds, value, and the slopes of a spline.
struct Keys<const N: usize> {
    interpolation: Interpolation,
    rows: Vec<Row<N>>,
}

type Row<const N: usize> = (f32, ([f32; N], [[f32; N]; 2]));

/// Sets a channel of a joint that has none yet. Whether it is a spline that overflows between its keys, and was set straight.
fn set<T: ChannelValue, const N: usize>(
    channel: &mut Option<Channel<T>>,
    keys: impl FnOnce() -> Result<Keys<N>, Fault>,
    value: impl Fn([f32; N]) -> T,
) -> Result<bool, Fault> {
    if channel.is_some() {
        return Ok(false);
    }
    let Keys { interpolation, rows } = keys()?;
    if rows.is_empty() {
        return Ok(false);
    }
    let keys = || rows.iter().map(|&(time_secs, (stored, _))| (time_secs, value(stored)));
    let splines = rows
        .iter()
        .map(|&(time_secs, (stored, slopes))| (time_secs, value(stored), slopes.map(&value)));
    // The keys were mended before: only a spline can still be none.
    let (read, overflows) = match interpolation {
        Interpolation::Linear | Interpolation::Unknown => (Channel::straight(keys())?, false),
        Interpolation::Step => (Channel::held(keys())?, false),
        Interpolation::CubicSpline => match Channel::spline(splines) {
            Ok(spline) => (spline, false),
            Err(_) => (Channel::straight(keys())?, true),
        },
    };
    *channel = Some(read);
    Ok(overflows)
}

fn add(moments: &mut Moments, bone: u32, time_secs: f32) {
    keys::add(moments, bone, time_secs, || None);
}
