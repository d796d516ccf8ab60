//! `bindpose pose`: the matrix palette at a time, and the vertices it moves.

use std::io::{self, Write};
use std::path::PathBuf;

use glam::{Mat4, Vec3};
use serde::Serialize;

use super::codes::SCHEMA_VERSION;
use super::failure::Failure;
use super::input;
use super::text::Plain;
use crate::anim::{CompiledClip, Palette, PoseBuffers, skin_positions};
use crate::model::{Model, Skeleton};

/// Print the matrix palette of a clip at a time.
///
/// Bones come in the file's order. Each matrix is the books' final transform, offset * toRoot, as the file writes its bone
/// offsets: for row vectors, row by row, with the translation in the last four of its sixteen numbers.
#[derive(Debug, clap::Args)]
#[command(after_long_help = JSON)]
pub(super) struct Arguments {
    /// Model to read, or - for standard input.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Clip by its name; may be left out when there is only one.
    #[arg(long, value_name = "NAME")]
    clip: Option<String>,
    /// Seconds in the clip's own time [default: where the clip starts].
    ///
    /// Before its first and after its last key a bone holds still.
    #[arg(long, value_name = "SECS", value_parser = input::seconds, allow_negative_numbers = true)]
    time: Option<f32>,
    /// Print JSON; see below for its keys.
    #[arg(long)]
    json: bool,
    /// Print the position of every vertex too.
    #[arg(long)]
    positions: bool,
}

const JSON: &str = "\
JSON: an object
  schemaVersion  1; it grows when a key changes its meaning or goes
  clip        name of the clip; null for a model without clips, which is shown at rest: as it was bound, or as its
              glTF or FBX file has it
  time_secs   the time as asked for
  palette     array: for each bone, in the file's order, sixteen numbers, row by row, for row vectors
  positions   only with --positions: for each vertex, in the file's order, [x, y, z] after skinning,
              in the file's own space

A pose with a number that overflows has no output: standard error names the bone or the vertex and the time, with
exit code 1.";

/// The result.
#[derive(Debug, Serialize)]
struct Posed<'a> {
    #[serde(rename = "schemaVersion")]
    schema_version: u32,
    clip: Option<&'a str>,
    time_secs: f32,
    palette: Vec<[f32; 16]>,
    #[serde(skip)]
    at_rest: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    positions: Option<Vec<[f32; 3]>>,
}

pub(super) fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let open = input::load(&arguments.file)?;
    let model = &open.model;
    let clip =
        input::choose_clip(model, &arguments.file, arguments.clip.as_deref())?.and_then(|index| model.clips.get(index));
    let time_secs = arguments.time.unwrap_or(clip.map_or(0.0, |clip| clip.start_secs));
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    if let Some(clip) = clip {
        pose.evaluate(&model.skeleton, &CompiledClip::new(clip), time_secs);
    }
    let clip = clip.map(|clip| clip.name.as_str());
    let overflows = |what, number| Failure::Overflows {
        path: arguments.file.clone(),
        clip: clip.unwrap_or_default().to_owned(),
        time_secs,
        what,
        number,
    };
    let palette = in_file_order(&model.skeleton, &pose.palette);
    if let Some(bone) = not_finite(&palette) {
        return Err(overflows("bone", bone));
    }
    let positions = arguments.positions.then(|| positions(model, &pose.palette));
    if let Some(vertex) = positions.as_deref().and_then(not_finite) {
        return Err(overflows("vertex", vertex));
    }
    let posed = Posed {
        schema_version: SCHEMA_VERSION,
        clip,
        time_secs,
        palette,
        at_rest: !model.skeleton.rests_in_bind_pose(),
        positions,
    };
    if arguments.json {
        serde_json::to_writer(&mut *out, &posed)?;
        writeln!(out)?;
    } else {
        write_text(out, &posed)?;
    }
    Ok(())
}

/// The first row with a number that overflowed and cannot be written.
fn not_finite<const N: usize>(rows: &[[f32; N]]) -> Option<usize> {
    rows.iter().position(|row| !row.iter().all(|number| number.is_finite()))
}

/// Sixteen numbers for each bone of the file. The columns of our matrices, for column vectors, are the rows of the
/// books'.
fn in_file_order(skeleton: &Skeleton, palette: &Palette) -> Vec<[f32; 16]> {
    let of_bones = skeleton
        .joint_of_bone()
        .iter()
        .filter_map(|joint| palette.0.get(joint.index()));
    of_bones
        .map(|&model_from_bind| Mat4::from(model_from_bind).to_cols_array())
        .collect()
}

fn positions(model: &Model, palette: &Palette) -> Vec<[f32; 3]> {
    let mut positions = Vec::new();
    skin_positions(&model.mesh, palette, &mut positions);
    positions.iter().map(Vec3::to_array).collect()
}

fn write_text(out: &mut dyn Write, posed: &Posed<'_>) -> io::Result<()> {
    match posed.clip {
        Some(clip) => writeln!(out, "{} at {} s", Plain(clip), posed.time_secs)?,
        None if posed.at_rest => writeln!(out, "at rest")?,
        None => writeln!(out, "bind pose")?,
    }
    for (bone, matrix) in posed.palette.iter().enumerate() {
        writeln!(out, "bone {bone}")?;
        for row in matrix.chunks_exact(4) {
            write_row(out, row)?;
        }
    }
    for (vertex, position) in posed.positions.iter().flatten().enumerate() {
        write!(out, "vertex {vertex:<9}")?;
        write_row(out, position)?;
    }
    Ok(())
}

fn write_row(out: &mut dyn Write, numbers: &[f32]) -> io::Result<()> {
    for number in numbers {
        write!(out, " {number:>13.6}")?;
    }
    writeln!(out)
}
