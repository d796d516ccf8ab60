//! What `bindpose convert` is asked for.

use std::path::{Path, PathBuf};

use crate::check::book::Book;
use crate::cli::codes;
use crate::cli::failure::Failure;
use crate::cli::input::{self, one_of};
use crate::edit::Edits;
use crate::format::Dialect;
use crate::model::{Handedness, Model, UpAxis};
use crate::session::{ExportFormat, ExportPlan};

/// Write a model as another file, changed as asked.
///
/// The ends of the names say the formats: .m3d is the text of the books, .txt that of their static models, .glb is binary glTF. What changes and what the format cannot
/// hold is told; all losses are known before anything is written.
#[derive(Debug, clap::Args)]
#[command(after_long_help = OUTPUT)]
pub(in crate::cli) struct Arguments {
    /// Model to read, or - for standard input.
    #[arg(value_name = "IN")]
    pub(super) input: PathBuf,
    /// File to write: .m3d, .glb or .txt.
    #[arg(value_name = "OUT")]
    pub(super) output: PathBuf,
    /// Which book's .m3d is written [default: that of IN, else d3d12].
    #[arg(long, value_name = "BOOK", value_parser = one_of(&Book::ALL, Book::name))]
    pub(super) dialect: Option<Book>,
    /// Keep these clips only, named with commas between.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(super) clips: Option<Vec<String>>,
    /// Add the clips of another file, whose bones have the same names; may be given more than once.
    ///
    /// Names are compared without what stands before a colon, so that mixamorig:Hips and mixamorig1:Hips are one. Files of the books have no names: their
    /// bones are taken in order. A clip that is called mixamo.com, Take 001 or Scene, also behind a |, or has no name gets
    /// that of its file.
    #[arg(long, value_name = "FILE")]
    pub(super) add_clips: Vec<PathBuf>,
    /// Keep this clip over where it starts: what walks away walks on the spot; may be given more than once.
    ///
    /// The topmost bone that goes over the ground is held; up and down it goes as before. One that --add-clips adds is called as there: where the clip is called
    /// mixamo.com, Take 001 or Scene, by the name of its file.
    #[arg(long, value_name = "CLIP")]
    pub(super) in_place: Vec<String>,
    /// Mend what check names and can be mended without a choice.
    ///
    /// Triangles without area and repeated ones go, and vertices that nothing uses; signs of tangents follow the texture coordinates;
    /// bones that keep still have one key.
    #[arg(long)]
    pub(super) fix: bool,
    /// Keep this part of the only clip, in seconds of its own time. The cuts get keys.
    #[arg(long, value_name = "IN..OUT", value_parser = range, allow_hyphen_values = true)]
    pub(super) range: Option<[f32; 2]>,
    /// Ease the end of each clip back into its first pose, over so many seconds.
    ///
    /// The way from the last pose to the first is added bone by bone, first little, then all of it (3u² − 2u³).
    #[arg(long, value_name = "SECS", value_parser = input::seconds, allow_negative_numbers = true)]
    pub(super) close_loop: Option<f32>,
    /// Leave keys out while all joints and their tips stay within this fraction of the model's size.
    ///
    /// The size is the diagonal of the bind pose; they are compared in the model's space at all old keys and half-way between
    /// them. 0.1 is the most.
    #[arg(long, value_name = "TOLERANCE", value_parser = number, allow_negative_numbers = true)]
    pub(super) reduce: Option<f32>,
    /// Multiply all lengths.
    #[arg(long, value_name = "S", value_parser = number, allow_negative_numbers = true)]
    pub(super) scale: Option<f32>,
    /// Which axis points up in OUT [default for .m3d: y].
    #[arg(long, value_name = "AXIS", value_parser = one_of(&UpAxis::ALL, UpAxis::name))]
    pub(super) up: Option<UpAxis>,
    /// Handedness of OUT [default for .m3d: right for a skinned model, left for others, as in the books].
    #[arg(long, value_name = "HAND", value_parser = one_of(&Handedness::ALL, Handedness::name))]
    pub(super) hand: Option<Handedness>,
    /// Rename a clip; may be given more than once.
    #[arg(long, value_name = "OLD=NEW", value_parser = renamed)]
    pub(super) rename: Vec<(String, String)>,
    /// Name a bone by its number; may be given more than once.
    #[arg(long, value_name = "N=NAME", value_parser = named_bone)]
    pub(super) rename_bone: Vec<(u32, String)>,
    /// Bring it into the shape that the books' demo shows.
    ///
    /// Right-handed, y up, of a height that is seen; one root as bone 0, children after their parents, 96 bones at most; keys for each
    /// bone from 0 s on; names of one word, and a clip Take1. Maps are written as DDS with mips into --textures-out.
    #[arg(long)]
    pub(super) for_book: bool,
    /// Leave bones without keys as they are; the books' programs stop at one.
    ///
    /// Without this each has a key at rest in every clip of a .m3d.
    #[arg(long, conflicts_with = "for_book")]
    pub(super) keep_empty: bool,
    /// Look for maps in this folder and in those in it, links to folders included; may be given more than once.
    #[arg(long, value_name = "DIR")]
    pub(super) textures: Vec<PathBuf>,
    /// Write the maps that were found into this folder, and name them so in the .m3d.
    ///
    /// As they are, or as DDS with mips with --for-book. The green of glTF's normal maps, which points up, is turned to point down, as in
    /// the books.
    #[arg(long, value_name = "DIR")]
    pub(super) textures_out: Option<PathBuf>,
    /// What makes the exit code 1, with nothing written: losses, or codes of changes and losses, with commas between.
    #[arg(long, value_name = "WHAT", value_delimiter = ',', value_parser = denied)]
    pub(super) deny: Vec<&'static str>,
    /// Codes that --deny does not count, with commas between; for example joint-names,double-sided.
    #[arg(long, value_name = "CODES", value_delimiter = ',', value_parser = codes::known, requires = "deny")]
    pub(super) allow: Vec<&'static str>,
    /// Write over files that are marked as read-only too.
    #[arg(long)]
    pub(super) force: bool,
    /// Print JSON; see below for its keys.
    #[arg(long)]
    pub(super) json: bool,
}

/// What --deny calls all losses.
const LOSSES: &str = "losses";

const OUTPUT: &str = "\
Edits are made in this order: add-clips, clips, in-place, fix, range, close-loop, reduce, scale, up and hand, rename.

JSON: an object
  schemaVersion   1; it grows when a key changes its meaning or goes
  input, output   the paths as given
  format          \"m3d\", \"glb\" or \"txt\"
  dialect         \"d3d11\" or \"d3d12\"; \"txt\" for .txt; null for .glb
  changes         array: what is otherwise than in IN, in the order of the edits; code and message of each
  losses          array: what OUT does not hold, or holds otherwise; code, message and count of each
  bytes           size of OUT; 0 where nothing was written

IN is never overwritten. OUT is written beside its place and then put there, so it is whole or not there.

Exit codes:
  0  OUT was written
  1  IN has errors or is too large for --for-book; or there is what --deny names: nothing was written
  2  wrong use, or a file cannot be read or written";

impl Arguments {
    pub(super) fn writes_glb(&self) -> bool {
        has_extension(&self.output, "glb")
    }

    /// The codes in a plan that are denied and not allowed, each once.
    pub(super) fn denied(&self, plan: &ExportPlan) -> Vec<&'static str> {
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

    pub(super) fn format(&self, of_input: Option<Dialect>) -> ExportFormat {
        if self.writes_glb() {
            return ExportFormat::Glb;
        }
        if has_extension(&self.output, "txt") {
            return ExportFormat::Text;
        }
        match (self.dialect, of_input) {
            (Some(Book::D3d11), _) | (None, Some(Dialect::D3d11)) => ExportFormat::D3d11,
            _ => ExportFormat::D3d12,
        }
    }

    pub(super) fn edits(&self, format: ExportFormat, model: &Model) -> Edits {
        let edits = Edits {
            clips: self.clips.clone(),
            in_place: self.in_place.clone(),
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
            ExportFormat::D3d12 | ExportFormat::D3d11 | ExportFormat::Text => Edits {
                keys_for_all: !self.keep_empty,
                ..edits.in_space_of_the_books(model)
            },
        }
    }
}

/// Refuses what does not go together.
pub(super) fn check_use(arguments: &Arguments) -> Result<(), Failure> {
    let refused = |is_one: bool, why: &str| {
        if is_one {
            Err(Failure::WrongUse(why.to_owned()))
        } else {
            Ok(())
        }
    };
    let writes_glb = arguments.writes_glb();
    let writes_text = has_extension(&arguments.output, "txt");
    refused(
        !writes_glb && !writes_text && !has_extension(&arguments.output, "m3d"),
        "OUT ends in .m3d, .glb or .txt, which says its format",
    )?;
    let not_for_text = [
        (arguments.dialect.is_some(), "--dialect"),
        (arguments.for_book, "--for-book"),
        (arguments.textures_out.is_some(), "--textures-out"),
    ];
    for (is_given, option) in not_for_text {
        refused(
            writes_text && is_given,
            &format!("{option} is for .m3d; a .txt has positions, normals and triangles alone"),
        )?;
    }
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
