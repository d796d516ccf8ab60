//! `bindpose convert`: a model as a file of another format, changed on the way.

mod arguments;

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

pub(super) use arguments::Arguments;
use arguments::check_use;

use super::codes::SCHEMA_VERSION;
use super::failure::{Failure, Outcome};
use super::input;
use super::paths;
use super::text::{Plain, grouped};
use super::textures::{Folders, Textures};
use crate::edit::Change;
use crate::export::Loss;
use crate::format::Dialect;
use crate::model::{Front, JointNames};
use crate::session::{ExportFormat, ExportJob, Maps, ToExport, WrittenModel};

/// The result.
#[derive(Debug, Serialize)]
struct Converted<'a> {
    #[serde(rename = "schemaVersion")]
    schema_version: u32,
    input: String,
    output: String,
    format: &'static str,
    dialect: Option<&'static str>,
    changes: Vec<Told<'a>>,
    losses: Vec<Lost<'a>>,
    bytes: usize,
}

#[derive(Debug, Serialize)]
struct Told<'a> {
    code: &'a str,
    message: &'a str,
}

#[derive(Debug, Serialize)]
struct Lost<'a> {
    code: &'a str,
    message: &'a str,
    count: usize,
}

pub(super) fn run(arguments: &Arguments, out: &mut dyn Write, err: &mut dyn Write) -> Result<Outcome, Failure> {
    check_use(arguments)?;
    let inputs = || {
        std::iter::once(&arguments.input)
            .chain(&arguments.add_clips)
            .map(PathBuf::as_path)
    };
    refuse_own_input(&arguments.output, inputs())?;
    paths::check_writable(&arguments.output, arguments.force)?;
    let mut open = input::load(&arguments.input)?;
    for path in &arguments.add_clips {
        let added = open.add_clips(input::load(path)?);
        added.map_err(|error| Failure::Refused {
            path: path.clone(),
            error,
        })?;
    }
    let format = arguments.format(open.format.dialect());
    let is_glb = format == ExportFormat::Glb;
    let folders = Folders::walk(&arguments.textures, err)?;
    let mut textures = Textures::of(&folders, &open.model.materials);
    textures.write_warnings(err)?;
    // What is not written beside the file is only named; of what lies inside the input that is a loss.
    let pictures = match std::mem::take(&mut textures.pictures) {
        found if is_glb || arguments.textures_out.is_some() => found,
        _ => Vec::new(),
    };
    let mut maps = Maps::without_mips();
    maps.add(
        &open.model.materials,
        pictures.into_iter().chain(open.pictures.iter().cloned()),
    );
    let clips = arguments.clips.as_deref();
    let what = ToExport {
        model: open.model.clone(),
        names: &JointNames::default(),
        changes: open.mended(clips).collect(),
        losses: open.left_out(clips, is_glb).collect(),
        edits: arguments.edits(format, &open.model),
        maps: &maps,
        format,
        writes_maps: arguments.textures_out.is_some(),
        turns_green: open.model.front == Front::Positive,
    };
    let WrittenModel {
        bytes,
        maps: map_files,
        plan,
    } = ExportJob::new("", what)
        .run_apart()
        .map_err(|refusal| Failure::export(&arguments.input, refusal))?;
    if let Some(folder) = &arguments.textures_out {
        let beside = arguments.input.parent().unwrap_or(Path::new(""));
        let sources = maps.pictures().iter();
        let sources: Vec<PathBuf> = sources
            .flat_map(|file| [textures.path(file).to_owned(), beside.join(&file.path)])
            .chain([arguments.input.clone()])
            .collect();
        for (name, _) in &map_files {
            refuse_own_input(&folder.join(name), sources.iter().map(PathBuf::as_path))?;
        }
    }
    let denied = arguments.denied(&plan);
    let is_denied = !denied.is_empty();
    if !is_denied {
        let mut files: Vec<(PathBuf, &[u8])> = Vec::new();
        let is_new = arguments.textures_out.as_ref().filter(|folder| !folder.exists());
        if let Some(folder) = &arguments.textures_out {
            let unwritable = |reason| Failure::Unwritable {
                path: folder.clone(),
                reason,
            };
            fs::create_dir_all(folder).map_err(unwritable)?;
            files.extend(map_files.iter().map(|(name, bytes)| (folder.join(name), &**bytes)));
        }
        files.push((arguments.output.clone(), &bytes));
        write_all(&files, arguments.force).inspect_err(|_| {
            // One that was made for them goes as they do.
            let _ = is_new.map(fs::remove_dir);
        })?;
    }
    let converted = Converted {
        schema_version: SCHEMA_VERSION,
        input: arguments.input.display().to_string(),
        output: arguments.output.display().to_string(),
        format: format.extension(),
        dialect: format.dialect().map(Dialect::as_str),
        changes: plan.changes.iter().map(Told::from).collect(),
        losses: plan.losses.iter().map(Lost::from).collect(),
        bytes: if is_denied { 0 } else { bytes.len() },
    };
    if arguments.json {
        serde_json::to_writer_pretty(&mut *out, &converted)?;
        writeln!(out)?;
    } else {
        write_text(out, &converted)?;
    }
    if is_denied {
        out.flush()?;
        writeln!(err, "error: nothing was written; denied: {}", denied.join(", "))?;
        return Ok(Outcome::FileHasErrors);
    }
    Ok(Outcome::Fine)
}

/// Refuses to write one of the files that were read.
fn refuse_own_input<'a>(output: &Path, inputs: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
    // A file that is not there is none of them.
    let Ok(there) = fs::canonicalize(output) else {
        return Ok(());
    };
    let is_input = inputs
        .into_iter()
        .any(|input| fs::canonicalize(input).is_ok_and(|input| input == there));
    if is_input {
        return Err(Failure::OwnInput {
            path: output.to_owned(),
        });
    }
    Ok(())
}

/// Writes files, each whole or not at all. Where one cannot be written, those go again that were made for it.
fn write_all(files: &[(PathBuf, &[u8])], force: bool) -> Result<(), Failure> {
    files
        .iter()
        .try_for_each(|(path, _)| paths::check_writable(path, force))?;
    let mut made = Vec::new();
    for (path, bytes) in files {
        let is_new = !path.exists();
        paths::write(path, bytes, force).inspect_err(|_| {
            for path in &made {
                // It may have gone meanwhile.
                let _ = fs::remove_file(path);
            }
        })?;
        made.extend(is_new.then_some(path));
    }
    Ok(())
}

impl<'a> From<&'a Change> for Told<'a> {
    fn from(change: &'a Change) -> Self {
        Self {
            code: change.code,
            message: &change.message,
        }
    }
}

impl<'a> From<&'a Loss> for Lost<'a> {
    fn from(loss: &'a Loss) -> Self {
        Self {
            code: loss.code,
            message: &loss.message,
            count: loss.count,
        }
    }
}

fn write_text(out: &mut dyn Write, converted: &Converted<'_>) -> io::Result<()> {
    for change in &converted.changes {
        writeln!(out, "change[{}]: {}", change.code, Plain(change.message))?;
    }
    for loss in &converted.losses {
        writeln!(out, "loss[{}]: {}", loss.code, Plain(loss.message))?;
    }
    if converted.bytes > 0 {
        writeln!(out, "{}: {} bytes", converted.output, grouped(converted.bytes))?;
    }
    Ok(())
}
