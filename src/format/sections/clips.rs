//! Clips: `AnimationClip NAME { Bone0 #Keyframes: N { Time: t Pos: … Scale: … Quat: … } }`

use crate::diagnostic::Fault;
use crate::format::document::{AnimationClip, BoneAnimation, ClipLines, KeyRun, Keyframe};
use crate::format::error::{Value, quoted, row_count};
use crate::format::kind::DiagnosticKind;
use crate::format::label::{is_ruler, same, same_as_any, split_number};
use crate::format::quick::{self, QuickRun};
use crate::format::reader::Reader;

/// The fields of a key, in order, with their other spellings.
const FIELDS: [(&str, &[&str]); 4] = [
    ("Time", &["time", "t"]),
    ("Pos", &["pos", "position", "translation", "p"]),
    ("Scale", &["scale", "s"]),
    ("Quat", &["quat", "quaternion", "rotation", "q"]),
];

const BONE: &[&str] = &["bone", "b"];

/// Of the bones of a clip, which keys are as the books' exporter writes them.
pub(in crate::format) type QuickTracks = Vec<Option<QuickRun>>;

pub(in crate::format) struct Clips {
    pub(in crate::format) clips: Vec<AnimationClip>,
    pub(in crate::format) lines: Vec<ClipLines>,
    pub(in crate::format) quick: Vec<QuickTracks>,
}

/// Reads the clips.
pub(in crate::format) async fn clips(reader: &mut Reader<'_>, count: u32, bones: u32) -> Result<Clips, Fault> {
    const SMALLEST: usize = 16;
    let room = reader.room_for(count, SMALLEST);
    let (mut clips, mut lines, mut quick) = (Vec::with_capacity(room), Vec::with_capacity(room), Vec::new());
    for index in 0..count {
        reader.pause_every(index as usize).await;
        pass_surplus_braces(reader);
        let before = reader.cursor;
        let Some((label, behind)) = reader.peek_label() else {
            return Err(reader.end(format!("clip {} of {count}", index + 1)));
        };
        if is_ruler(label.text) {
            return Err(reader.section_row_count("clips", count, clips.len()));
        }
        if !is_clip(label.text) {
            return Err(Reader::wrong_label(label, "AnimationClip"));
        }
        reader.cursor = behind;
        if !label.text.ends_with(b":") {
            // A colon that stands apart belongs to the name.
            reader.cursor = before;
            reader.cursor.token();
        }
        let (clip, of_bones, quick_tracks) = clip(reader, bones).await?;
        quick.push(quick_tracks);
        lines.push(ClipLines {
            clip: label.position.line,
            ..of_bones
        });
        clips.push(clip);
    }
    pass_surplus_braces(reader);
    if reader.peek_label().is_some_and(|(label, _)| is_clip(label.text)) {
        let surplus = reader.count_lines(is_clip).await;
        return Err(reader.section_row_count("clips", count, clips.len() + surplus));
    }
    Ok(Clips { clips, lines, quick })
}

fn is_clip(label: &[u8]) -> bool {
    same(label, "AnimationClip")
}

/// Reads a clip from behind its label, with the lines of its bones and keys.
async fn clip(reader: &mut Reader<'_>, bones: u32) -> Result<(AnimationClip, ClipLines, QuickTracks), Fault> {
    /// `B0 0 {}` and a blank.
    const SMALLEST: usize = 7;
    let name = reader.cursor.rest_of_line();
    let (name, opened) = match name.text.strip_suffix(b"{") {
        Some(name) => (name.trim_ascii_end(), true),
        None => (name.text, false),
    };
    let name = String::from_utf8_lossy(name).into_owned();
    if !opened {
        open(reader)?;
    }
    let room = reader.room_for(bones, SMALLEST);
    let (mut animations, mut quick) = (Vec::with_capacity(room), Vec::with_capacity(room));
    let mut lines = ClipLines {
        bones: Vec::with_capacity(room),
        key_runs: Vec::with_capacity(room),
        ..ClipLines::default()
    };
    for bone in 0..bones {
        reader.pause_every(bone as usize).await;
        let (animation, quick_track) = bone_animation(reader, &name, bone, bones, &mut lines).await?;
        animations.push(animation);
        quick.push(quick_track);
    }
    if is_bone(reader) {
        let surplus = reader
            .count_lines(|label| same_as_any(split_number(label).0, BONE))
            .await;
        return Err(bone_count(reader, &name, bones, bones as usize + surplus));
    }
    close(reader)?;
    Ok((
        AnimationClip {
            name,
            bones: animations,
        },
        lines,
        quick,
    ))
}

/// Reads the keys of one bone, and adds its lines.
async fn bone_animation(
    reader: &mut Reader<'_>,
    clip: &str,
    bone: u32,
    bones: u32,
    lines: &mut ClipLines,
) -> Result<(BoneAnimation, Option<QuickRun>), Fault> {
    /// Four labels of a letter, eleven digits, blanks and a line end.
    const SMALLEST: usize = 30;
    let begins_bone = |label: &[u8]| same_as_any(split_number(label).0, BONE);
    let (label, behind) = loop {
        let Some((label, behind)) = reader.peek_label() else {
            return Err(reader.end(format!(
                "bone {} of {bones} in clip \"{}\"",
                bone + 1,
                quoted(clip.as_bytes())
            )));
        };
        if label.text != b"}" || !follows_brace(reader, begins_bone) {
            break (label, behind);
        }
        reader.note(label, DiagnosticKind::BraceSurplus);
        reader.cursor.token();
    };
    let (name, mut number) = split_number(label.text);
    if !same_as_any(name, BONE) {
        if label.text == b"}" || is_clip(label.text) || is_ruler(label.text) {
            return Err(bone_count(reader, clip, bones, bone as usize));
        }
        return Err(Reader::wrong_label(label, "Bone"));
    }
    reader.cursor = behind;
    // `Bone 0 #Keyframes: N`: the number may stand apart.
    if number.is_none()
        && let Some(token) = reader.cursor.peek_token()
        && let (b"", Some(apart)) = split_number(token.text)
    {
        reader.cursor.token();
        number = Some(apart);
    }
    if number.is_some_and(|number| number != bone) {
        reader.note(label, DiagnosticKind::BoneNumber);
    }
    pass_number_sign(reader);
    reader.label("#Keyframes", &["keyframes", "keys", "k"])?;
    let count = reader.count(Value::KeyframeCount)?;
    open(reader)?;
    let mut keyframes = Vec::with_capacity(reader.room_for(count, SMALLEST));
    let mut next_line = None;
    let (first, mut all_quick) = (reader.cursor, true);
    for key in 0..count {
        reader.pause_every(key as usize).await;
        let quick = quick::keyframe::<false>(&mut reader.cursor);
        all_quick &= quick.is_some();
        let (keyframe, line) = match quick.or_else(|| quick::keyframe::<true>(&mut reader.cursor)) {
            Some(read) => read,
            None => keyframe(reader, bone, key, count)?,
        };
        if next_line != Some(line) {
            lines.key_runs.push(KeyRun { bone, key, line });
        }
        next_line = Some(line.saturating_add(1));
        keyframes.push(keyframe);
    }
    let quick = all_quick.then(|| QuickRun::between(first, reader.cursor));
    let is_key = |label: &[u8]| same_as_any(label.split(|&byte| byte == b':').next().unwrap_or(label), FIELDS[0].1);
    if reader.peek_label().is_some_and(|(label, _)| is_key(label.text)) {
        let mut counted = keyframes.len();
        while reader.peek_label().is_some_and(|(label, _)| is_key(label.text)) {
            reader.cursor.skip_space();
            reader.cursor.rest_of_line();
            counted += 1;
        }
        return Err(key_count(reader, bone, count, counted));
    }
    close(reader)?;
    lines.bones.push(label.position.line);
    Ok((BoneAnimation { keyframes }, quick))
}

/// Reads a key of any layout. Also gives its line.
fn keyframe(reader: &mut Reader<'_>, bone: u32, key: u32, count: u32) -> Result<(Keyframe, u32), Fault> {
    let Some((label, _)) = reader.peek_label() else {
        return Err(reader.end(format!("key {} of {count} of bone {bone}", key + 1)));
    };
    if label.text == b"}" || is_clip(label.text) || is_ruler(label.text) || is_bone(reader) {
        return Err(key_count(reader, bone, count, key as usize));
    }
    // A time that is no number must not become another time: the model leaves the key out, and says so.
    let [time_secs] = field(reader, 0, [f32::INFINITY])?;
    let translation = field(reader, 1, [0.0; 3])?;
    let scale = field(reader, 2, [1.0; 3])?;
    let rotation = field(reader, 3, [0.0, 0.0, 0.0, 1.0])?;
    let keyframe = Keyframe {
        time_secs,
        translation,
        scale,
        rotation,
    };
    Ok((keyframe, label.position.line))
}

fn field<const N: usize>(reader: &mut Reader<'_>, field: usize, defaults: [f32; N]) -> Result<[f32; N], Fault> {
    let (label, names) = FIELDS[field];
    reader.label(label, names)?;
    reader
        .numbers(Value::Number(label), N, defaults)
        .map(|(numbers, _)| numbers)
}

fn is_bone(reader: &Reader<'_>) -> bool {
    reader
        .peek_label()
        .is_some_and(|(label, _)| same_as_any(split_number(label.text).0, BONE))
}

/// `# Keyframes: N`: the sign may stand apart.
fn pass_number_sign(reader: &mut Reader<'_>) {
    if reader.cursor.peek_token().is_some_and(|token| token.text == b"#") {
        reader.cursor.token();
    }
}

/// Passes a `{`, or notes that it is missing.
pub(in crate::format) fn open(reader: &mut Reader<'_>) -> Result<(), Fault> {
    brace(reader, '{')
}

/// Passes a `}`, or notes that it is missing. At the end of the file that is an error, since more may be missing.
pub(in crate::format) fn close(reader: &mut Reader<'_>) -> Result<(), Fault> {
    brace(reader, '}')
}

fn brace(reader: &mut Reader<'_>, brace: char) -> Result<(), Fault> {
    let Some(token) = reader.cursor.peek_token() else {
        return Err(reader.end(format!("\"{brace}\"")));
    };
    if token.text == [brace as u8] {
        reader.cursor.token();
    } else {
        reader.kinds.add(DiagnosticKind::BraceMissing(brace), token.position, 0);
    }
    Ok(())
}

fn pass_surplus_braces(reader: &mut Reader<'_>) {
    while let Some(token) = reader.cursor.peek_token()
        && token.text == b"}"
    {
        reader.note(token, DiagnosticKind::BraceSurplus);
        reader.cursor.token();
    }
}

/// True when a label that `is` accepts stands behind the brace that comes next.
fn follows_brace(reader: &Reader<'_>, is: impl Fn(&[u8]) -> bool) -> bool {
    let mut ahead = reader.clone();
    ahead.cursor.token();
    ahead.peek_label().is_some_and(|(label, _)| is(label.text))
}

fn bone_count(reader: &Reader<'_>, clip: &str, announced: u32, counted: usize) -> Fault {
    let holder = format!("clip \"{}\"", quoted(clip.as_bytes()));
    reader.where_rows_end(row_count("The header", "bones", &holder, announced, counted))
}

fn key_count(reader: &Reader<'_>, bone: u32, announced: u32, counted: usize) -> Fault {
    let announcer = format!("Bone {bone}");
    reader.where_rows_end(row_count(&announcer, "keyframes", "its block", announced, counted))
}
