//! `bindpose info`: what is in a file.

use std::io::{self, Write};
use std::path::PathBuf;

use serde::Serialize;

use super::codes::SCHEMA_VERSION;
use super::diagnostic::worded_place;
use super::failure::Failure;
use super::input;
use super::text::{Plain, column_width, counted, grouped};
use super::textures::{Folders, MapState, NamedMap, Textures, by_name, named_maps};
use crate::diagnostic::{Diagnostic, Severity, codes};
use crate::model::{Aabb, Handedness, Model, UpAxis};
use crate::session::summary::{self, Bounds, Finding};
use crate::session::{Maps, OpenModel};

/// Print what is in a model.
#[derive(Debug, clap::Args)]
#[command(after_long_help = JSON)]
pub(super) struct Arguments {
    /// Model to read, or - for standard input.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Print JSON; see below for its keys.
    #[arg(long)]
    json: bool,
    /// Look in a folder for the maps that the materials name, folders and links in it included; may be given several times.
    #[arg(long, value_name = "DIR")]
    textures: Vec<PathBuf>,
}

const JSON: &str = "\
JSON: an object
  schemaVersion     1; it grows when a key changes its meaning or goes
  file              the path as given
  dialect           \"d3d12\", \"d3d11\", \"imm\" or \"txt\"; \"glb\" or \"gltf\"; \"fbx\" or \"fbx-text\"
  handedness        \"left\" or \"right\", found from the triangles
  up_axis           \"y\" or \"z\", as the dialect suggests
  counts            materials, vertices, triangles, bones, clips
  bones             array, in the order in which `pose` prints them
    name            as the file has it, or null
    parent          index of the parent in this array, or null
  materials         array of names
  maps              array: each map that a material names, in the order of the materials
    material        name of the material
    slot            \"diffuse\" or \"normal\"
    name            as the file has it
    state           \"found\", \"missing\" or \"unreadable\"; null without --textures
    path            of the picture that fits the name; null when there is none
    problem         why it is unreadable, one sentence; else null
  clips             array
    name
    start_secs      least and
    end_secs        greatest time of its keys
    keys_per_sec    keys a second of the densest track
    keys            number of keys in the file
  bind_bounds       box of all vertices as the file has them: min and max, each [x, y, z];
                    null without vertices
  animated_bounds   box of all that the clips reach, likewise; bind_bounds without clips;
                    null when a clip overflows, which notices say (pose-overflows)
  notices           array: what was mended or is worth knowing, in the order of the file
    severity        \"note\" or \"warning\"
    code            stable name of the kind of finding
    message         one sentence
    line, column    place, both from 1; null when it is about the whole file
    json_pointer    what of a glTF file's JSON it is about, or null
    byte_offset     place in a .glb or binary .fbx file, in bytes from its start, or null
    expected, found   what belonged there and what stood there, in a few words, or null
    subject           the part of the model that it is about, or null: kind (\"material\", \"subset\", \"vertex\",
                      \"triangle\", \"bone\" or \"clip\") and index, its number in the file from 0
    time_secs, bone   of a finding about a clip: when it is, in the clip's own time, and the bone's number; or null
    count             how many alike things it tells of, 1 or more
    places            line and column of the first four of them; empty when it is about the whole file

A file with errors has no such output: the error is told on standard error, with exit code 1. Missing maps are no errors;
what is skipped in the folders is told on standard error.";

/// The result.
#[derive(Debug, Serialize)]
struct Info<'a> {
    #[serde(rename = "schemaVersion")]
    schema_version: u32,
    file: String,
    #[serde(flatten)]
    model: summary::Model<'a>,
    maps: Vec<Map<'a>>,
    animated_bounds: Option<Bounds>,
    notices: Vec<Finding<'a>>,
}

#[derive(Debug, Serialize)]
struct Map<'a> {
    material: &'a str,
    slot: &'static str,
    name: &'a str,
    state: Option<&'static str>,
    path: Option<String>,
    problem: Option<&'a str>,
}

pub(super) fn run(arguments: &Arguments, out: &mut dyn Write, err: &mut dyn Write) -> Result<(), Failure> {
    let open = input::load(&arguments.file)?;
    let materials = &open.model.materials;
    let mut found = Maps::without_mips();
    let mut textures;
    let maps = if arguments.textures.is_empty() && open.format.dialect().is_some() {
        named_maps(materials).collect()
    } else {
        let folders = Folders::walk(&arguments.textures, err)?;
        textures = Textures::of(&folders, materials);
        textures.write_warnings(err)?;
        let pictures = std::mem::take(&mut textures.pictures).into_iter();
        found.add(materials, pictures.chain(open.pictures.iter().cloned()));
        textures.states(materials, &found)
    };
    let info = Info::new(arguments.file.display().to_string(), &open, &maps);
    if arguments.json {
        serde_json::to_writer_pretty(&mut *out, &info)?;
        writeln!(out)?;
    } else {
        write_text(out, &info, &open, &maps)?;
    }
    Ok(())
}

impl<'a> Info<'a> {
    fn new(file: String, open: &'a OpenModel, maps: &'a [NamedMap<'a>]) -> Self {
        Self {
            schema_version: SCHEMA_VERSION,
            file,
            model: open.into(),
            maps: maps.iter().map(Map::from).collect(),
            animated_bounds: bounds_of_all_clips(open).and_then(|bounds| Bounds::of(&bounds)),
            notices: open.diagnostics.iter().map(Finding::from).collect(),
        }
    }
}

impl<'a> From<&'a NamedMap<'_>> for Map<'a> {
    fn from(map: &'a NamedMap<'_>) -> Self {
        let (path, problem) = match &map.state {
            Some(MapState::Found(path)) => (Some(*path), None),
            Some(MapState::Unreadable(path, diagnostic)) => (Some(*path), Some(diagnostic.message.as_str())),
            Some(MapState::Missing) | None => (None, None),
        };
        Self {
            material: map.material,
            slot: map.slot.name(),
            name: map.name,
            state: map.state.as_ref().map(MapState::as_str),
            path: path.map(|path| path.display().to_string()),
            problem,
        }
    }
}

/// `None` when a clip overflows, since no box holds it then.
fn bounds_of_all_clips(open: &OpenModel) -> Option<Aabb> {
    let overflows = |diagnostic: &Diagnostic| diagnostic.code == codes::POSE_OVERFLOWS.name;
    if open.diagnostics.iter().any(overflows) {
        return None;
    }
    let of_clips = (0..open.compiled.len()).map(|clip| open.extent(Some(clip)).bounds);
    Some(of_clips.reduce(Aabb::union).unwrap_or_else(|| open.extent(None).bounds))
}

fn write_text(out: &mut dyn Write, info: &Info<'_>, open: &OpenModel, maps: &[NamedMap<'_>]) -> io::Result<()> {
    let dialect = open.format.label();
    let hand = match open.model.handedness {
        Handedness::Left => "left-handed",
        Handedness::Right => "right-handed",
    };
    let up = match open.model.up_axis {
        UpAxis::Y => "y up",
        UpAxis::Z => "z up",
    };
    writeln!(out, "{}", Plain(&info.file))?;
    writeln!(out, "{dialect}, {hand}, {up}\n")?;

    let counts = [
        ("Vertices", info.model.counts.vertices),
        ("Triangles", info.model.counts.triangles),
        ("Bones", info.model.counts.bones),
    ];
    for (name, count) in counts {
        writeln!(out, "{name:<10}{:>12}", grouped(count))?;
    }
    write_bounds(out, info)?;
    write_materials(out, &open.model)?;
    write_maps(out, maps)?;
    write_clips(out, info)?;
    write_diagnostics(out, open)
}

fn write_bounds(out: &mut dyn Write, info: &Info<'_>) -> io::Result<()> {
    let Some(bind) = info.model.bind_bounds else {
        return Ok(());
    };
    writeln!(out, "\nBounds {:>18} {:>12} {:>12}", "x", "y", "z")?;
    let mut row = |name: &str, [x, y, z]: [f32; 3]| writeln!(out, "  {name:<10}{x:>13.4} {y:>12.4} {z:>12.4}");
    row("bind min", bind.min)?;
    row("bind max", bind.max)?;
    match info.animated_bounds {
        _ if info.model.clips.is_empty() => Ok(()),
        Some(animated) => {
            row("clips min", animated.min)?;
            row("clips max", animated.max)
        }
        None => writeln!(out, "  clips     beyond what numbers hold; see pose-overflows below"),
    }
}

fn write_materials(out: &mut dyn Write, model: &Model) -> io::Result<()> {
    writeln!(out, "\n{}", counted(model.materials.len(), "material"))?;
    let width = column_width(model.materials.iter().map(|material| material.name.as_str()));
    let mut triangles = vec![0; model.materials.len()];
    for submesh in &model.mesh.submeshes {
        if let Some(triangles) = triangles.get_mut(submesh.material as usize) {
            *triangles += submesh.triangle_count as usize;
        }
    }
    for (material, triangles) in model.materials.iter().zip(triangles) {
        let name = Plain(&material.name).to_string();
        writeln!(out, "  {name:<width$}  {:>10} triangles", grouped(triangles))?;
    }
    Ok(())
}

/// Each name once, and what was found for it.
fn write_maps(out: &mut dyn Write, maps: &[NamedMap<'_>]) -> io::Result<()> {
    let maps = by_name(maps);
    if maps.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n{}", counted(maps.len(), "map"))?;
    let width = column_width(maps.iter().map(|(map, _)| map.name));
    for (map, _) in maps {
        let name = Plain(map.name).to_string();
        match &map.state {
            None => writeln!(out, "  {name}")?,
            Some(state) => {
                let path = match state {
                    MapState::Found(path) | MapState::Unreadable(path, _) => path.display().to_string(),
                    MapState::Missing => String::new(),
                };
                let line = format!("{name:<width$}  {:<10}  {path}", state.as_str());
                writeln!(out, "  {}", Plain(line.trim_end()))?;
            }
        }
    }
    Ok(())
}

fn write_clips(out: &mut dyn Write, info: &Info<'_>) -> io::Result<()> {
    if info.model.clips.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n{}", counted(info.model.clips.len(), "clip"))?;
    let width = column_width(info.model.clips.iter().map(|clip| clip.name));
    for clip in &info.model.clips {
        let name = Plain(clip.name).to_string();
        let (start_secs, end_secs) = (clip.start_secs, clip.end_secs);
        let keys = grouped(clip.keys);
        writeln!(
            out,
            "  {name:<width$}  {start_secs:>8.3} … {end_secs:.3} s  {keys:>8} keys"
        )?;
    }
    Ok(())
}

fn write_diagnostics(out: &mut dyn Write, open: &OpenModel) -> io::Result<()> {
    if open.diagnostics.is_empty() {
        return Ok(());
    }
    let count = |severity| {
        open.diagnostics
            .iter()
            .filter(|diagnostic| diagnostic.severity == severity)
            .count()
    };
    let parts: Vec<String> = [(Severity::Warning, "warning"), (Severity::Note, "note")]
        .into_iter()
        .map(|(severity, word)| (count(severity), word))
        .filter(|(count, _)| *count > 0)
        .map(|(count, word)| counted(count, word))
        .collect();
    writeln!(out, "\n{}", parts.join(", "))?;
    for diagnostic in &open.diagnostics {
        writeln!(out, "  {}", Plain(&worded_place(diagnostic)))?;
    }
    Ok(())
}
