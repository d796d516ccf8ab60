//! `bindpose convert`: a model as a file of another format, changed on the way.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::codes::{self, SCHEMA_VERSION};
use super::failure::{Failure, Outcome};
use super::input::{self, one_of};
use super::paths;
use super::text::{Plain, grouped};
use super::textures::{Folders, Textures};
use crate::check::book::Book;
use crate::edit::{Change, Edits};
use crate::export::Loss;
use crate::format::Dialect;
use crate::model::{Front, Handedness, JointNames, Model, UpAxis};
use crate::session::{self, ExportFormat, ExportJob, ExportPlan, File, Maps, OpenModel, ToExport, WrittenModel};

/// Write a model as another file, changed as asked.
///
/// The ends of the names say the formats: .m3d is the text of the books, .glb is binary glTF. What changes and what the format cannot
/// hold is told; all losses are known before anything is written.
#[derive(Debug, clap::Args)]
#[command(after_long_help = OUTPUT)]
pub(super) struct Arguments {
    /// Model to read, or - for standard input.
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// File to write: .m3d or .glb.
    #[arg(value_name = "OUT")]
    output: PathBuf,
    /// Which book's .m3d is written [default: that of IN, else d3d12].
    #[arg(long, value_name = "BOOK", value_parser = one_of(&Book::ALL, Book::name))]
    dialect: Option<Book>,
    /// Keep these clips only, named with commas between.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    clips: Option<Vec<String>>,
    /// Mend what check names and can be mended without a choice.
    ///
    /// Triangles without area and repeated ones go, and vertices that nothing uses; signs of tangents follow the texture coordinates;
    /// bones that keep still have one key.
    #[arg(long)]
    fix: bool,
    /// Keep this part of the only clip, in seconds of its own time. The cuts get keys.
    #[arg(long, value_name = "IN..OUT", value_parser = range, allow_hyphen_values = true)]
    range: Option<[f32; 2]>,
    /// Ease the end of each clip back into its first pose, over so many seconds.
    ///
    /// The way from the last pose to the first is added bone by bone, first little, then all of it (3u² − 2u³).
    #[arg(long, value_name = "SECS", value_parser = input::seconds, allow_negative_numbers = true)]
    close_loop: Option<f32>,
    /// Leave keys out while all joints and their tips stay within this fraction of the model's size.
    ///
    /// The size is the diagonal of the bind pose; they are compared in the model's space at all old keys and half-way between
    /// them. 0.1 is the most.
    #[arg(long, value_name = "TOLERANCE", value_parser = number, allow_negative_numbers = true)]
    reduce: Option<f32>,
    /// Multiply all lengths.
    #[arg(long, value_name = "S", value_parser = number, allow_negative_numbers = true)]
    scale: Option<f32>,
    /// Which axis points up in OUT [default for .m3d: y].
    #[arg(long, value_name = "AXIS", value_parser = one_of(&UpAxis::ALL, UpAxis::name))]
    up: Option<UpAxis>,
    /// Handedness of OUT [default for .m3d: right for a skinned model, left for others, as in the books].
    #[arg(long, value_name = "HAND", value_parser = one_of(&Handedness::ALL, Handedness::name))]
    hand: Option<Handedness>,
    /// Rename a clip; may be given more than once.
    #[arg(long, value_name = "OLD=NEW", value_parser = renamed)]
    rename: Vec<(String, String)>,
    /// Name a bone by its number; may be given more than once.
    #[arg(long, value_name = "N=NAME", value_parser = named_bone)]
    rename_bone: Vec<(u32, String)>,
    /// Bring it into the shape that the books' demo shows.
    ///
    /// Right-handed, y up, of a height that is seen; one root as bone 0, children after their parents, 96 bones at most; keys for each
    /// bone from 0 s on; names of one word, and a clip Take1. Maps are written as DDS with mips into --textures-out.
    #[arg(long)]
    for_book: bool,
    /// Leave bones without keys as they are; the books' programs stop at one.
    ///
    /// Without this each has a key at rest in every clip of a .m3d.
    #[arg(long, conflicts_with = "for_book")]
    keep_empty: bool,
    /// Look for maps in this folder and in those in it, links to folders included; may be given more than once.
    #[arg(long, value_name = "DIR")]
    textures: Vec<PathBuf>,
    /// Write the maps that were found into this folder, and name them so in the .m3d.
    ///
    /// As they are, or as DDS with mips with --for-book. The green of glTF's normal maps, which points up, is turned to point down, as in
    /// the books.
    #[arg(long, value_name = "DIR")]
    textures_out: Option<PathBuf>,
    /// What makes the exit code 1, with nothing written: losses, or codes of changes and losses, with commas between.
    #[arg(long, value_name = "WHAT", value_delimiter = ',', value_parser = denied)]
    deny: Vec<&'static str>,
    /// Codes that --deny does not count, with commas between; for example joint-names,double-sided.
    #[arg(long, value_name = "CODES", value_delimiter = ',', value_parser = codes::known, requires = "deny")]
    allow: Vec<&'static str>,
    /// Write over files that are marked as read-only too.
    #[arg(long)]
    force: bool,
    /// Print JSON; see below for its keys.
    #[arg(long)]
    json: bool,
}

/// What --deny calls all losses.
const LOSSES: &str = "losses";

const OUTPUT: &str = "\
Edits are made in this order: clips, fix, range, close-loop, reduce, scale, up and hand, rename.

JSON: an object
  schemaVersion   1; it grows when a key changes its meaning or goes
  input, output   the paths as given
  format          \"m3d\" or \"glb\"
  dialect         \"d3d11\" or \"d3d12\"; null for .glb
  changes         array: what is otherwise than in IN, in the order of the edits; code and message of each
  losses          array: what OUT does not hold, or holds otherwise; code, message and count of each
  bytes           size of OUT; 0 where nothing was written

IN is never overwritten. OUT is written beside its place and then put there, so it is whole or not there.

Exit codes:
  0  OUT was written
  1  IN has errors or is too large for --for-book; or there is what --deny names: nothing was written
  2  wrong use, or a file cannot be read or written";

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
    refuse_own_input(&arguments.output, [arguments.input.as_path()])?;
    paths::check_writable(&arguments.output, arguments.force)?;
    let open = read(&arguments.input)?;
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

impl Arguments {
    fn writes_glb(&self) -> bool {
        has_extension(&self.output, "glb")
    }

    /// The codes in a plan that are denied and not allowed, each once.
    fn denied(&self, plan: &ExportPlan) -> Vec<&'static str> {
        let changes = plan.changes.iter().map(|change| (change.code, false));
        let losses = plan.losses.iter().map(|loss| (loss.code, true));
        let is_denied = |code, is_loss| self.deny.contains(&code) || (is_loss && self.deny.contains(&LOSSES));
        let mut codes: Vec<_> = changes
            .chain(losses)
            .filter(|&(code, is_loss)| is_denied(code, is_loss) && !self.allow.contains(&code))
            .map(|(code, _)| code)
            .collect();
        codes.sort_unstable();
        codes.dedup();
        codes
    }

    fn format(&self, of_input: Option<Dialect>) -> ExportFormat {
        if self.writes_glb() {
            return ExportFormat::Glb;
        }
        match (self.dialect, of_input) {
            (Some(Book::D3d11), _) | (None, Some(Dialect::D3d11)) => ExportFormat::D3d11,
            _ => ExportFormat::D3d12,
        }
    }

    fn edits(&self, format: ExportFormat, model: &Model) -> Edits {
        let edits = Edits {
            clips: self.clips.clone(),
            fix: self.fix,
            range_secs: self.range,
            close_loop_secs: self.close_loop,
            reduce: self.reduce,
            scale: self.scale,
            up_axis: self.up,
            handedness: self.hand,
            front: None,
            clip_names: self.rename.clone(),
            bone_names: self.rename_bone.clone(),
            for_book: self.for_book,
            keys_for_all: false,
        };
        // A .glb is brought into its one space as it is written.
        match format {
            ExportFormat::Glb => edits,
            ExportFormat::D3d12 | ExportFormat::D3d11 => Edits {
                keys_for_all: !self.keep_empty,
                ..edits.in_space_of_the_books(model)
            },
        }
    }
}

/// Refuses what does not go together.
fn check_use(arguments: &Arguments) -> Result<(), Failure> {
    let refused = |is_one: bool, why: &str| {
        if is_one {
            Err(Failure::WrongUse(why.to_owned()))
        } else {
            Ok(())
        }
    };
    let writes_glb = arguments.writes_glb();
    refused(
        !writes_glb && !has_extension(&arguments.output, "m3d"),
        "OUT ends in .m3d or .glb, which says its format",
    )?;
    let only_m3d = [
        (arguments.dialect.is_some(), "--dialect"),
        (arguments.for_book, "--for-book"),
        (arguments.keep_empty, "--keep-empty"),
        (arguments.textures_out.is_some(), "--textures-out"),
        (arguments.up == Some(UpAxis::Z), "--up z"),
        (arguments.hand == Some(Handedness::Left), "--hand left"),
    ];
    for (is_given, option) in only_m3d {
        refused(
            writes_glb && is_given,
            &format!("{option} is for .m3d; a .glb is right-handed, has y up and holds its maps"),
        )?;
    }
    let of_book = [
        (arguments.up == Some(UpAxis::Z), "--up z"),
        (arguments.hand == Some(Handedness::Left), "--hand left"),
    ];
    for (is_given, option) in of_book {
        refused(
            arguments.for_book && is_given,
            &format!("{option} does not go with --for-book, whose demo has one space"),
        )?;
    }
    Ok(())
}

fn has_extension(path: &Path, wanted: &str) -> bool {
    path.extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case(wanted))
}

/// The model and the files beside it that it names.
fn read(path: &Path) -> Result<OpenModel, Failure> {
    let bytes = paths::read(path)?;
    let file = File::new("model.m3d", bytes);
    session::load_beside(&file, &|name| input::beside(path, name)).map_err(|error| Failure::Refused {
        path: path.to_owned(),
        error,
    })
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

/// `0.5..2`, as an argument.
fn range(text: &str) -> Result<[f32; 2], String> {
    let wrong = || "a range is two numbers of seconds, such as 0.5..2".to_owned();
    let (from, to) = text.split_once("..").ok_or_else(wrong)?;
    let [from, to] = [from, to].map(input::seconds);
    match (from, to) {
        (Ok(from), Ok(to)) if from < to => Ok([from, to]),
        _ => Err(wrong()),
    }
}

/// A number above 0, as an argument.
fn number(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("it is a number above 0".into()),
    }
}

fn denied(text: &str) -> Result<&'static str, String> {
    codes::known_or(text, &[LOSSES])
}

fn renamed(text: &str) -> Result<(String, String), String> {
    let names = text
        .split_once('=')
        .filter(|(old, new)| !old.is_empty() && !new.is_empty());
    let (old, new) = names.ok_or("it is OLD=NEW")?;
    Ok((old.to_owned(), new.to_owned()))
}

fn named_bone(text: &str) -> Result<(u32, String), String> {
    let parts = text
        .split_once('=')
        .and_then(|(bone, name)| Some((bone.parse().ok()?, name)))
        .filter(|(_, name)| !name.trim().is_empty());
    let (bone, name) = parts.ok_or("it is N=NAME, with the number of the bone in the file")?;
    Ok((bone, name.to_owned()))
}
