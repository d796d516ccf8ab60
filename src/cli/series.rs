//! Arguments for many pictures instead of one: through the clip, around the model, in files of their own or on a sheet.

use std::path::Path;

use super::failure::Failure;
use super::input::{self, sides};
use super::paths;
use crate::anim::{GHOST_STEP_FRAMES, GhostPlan, MOST_GHOSTS};
use crate::scene::{Frames, MOST_SHOTS, Shot};
use crate::session::{LookCommand, PlayCommand, Session};

/// Many pictures, and poses beside that of the picture.
#[derive(Debug, clap::Args)]
pub(super) struct SeriesArguments {
    /// Seconds in the clip's own time, kept inside the clip [default: where the clip starts].
    #[arg(long, value_name = "SECS", value_parser = input::seconds, allow_negative_numbers = true)]
    time: Option<f32>,
    /// Draw N pictures of the whole clip into the folder that -o names: frame-0000.png, frame-0001.png and so on.
    ///
    /// Picture i is at START + i * LENGTH / N. The end is left out, so that a film that is repeated has no picture twice.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_SHOTS)), conflicts_with_all = ["fps", "time"])]
    frames: Option<u32>,
    /// The same with F pictures for each second of the clip.
    #[arg(long, value_name = "F", value_parser = rate, conflicts_with = "time")]
    fps: Option<f64>,
    /// Draw N views around the model, in equal steps, beginning at --view; into a folder as --frames does.
    ///
    /// With --frames or --fps the clip plays while the camera turns, as many pictures as the larger number says: when the clip is at its
    /// end, or the camera once around, it goes on from its beginning.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_SHOTS)))]
    turntable: Option<u32>,
    /// Draw all pictures on one, in C columns and R rows, each labelled with time and frame or with the turn.
    ///
    /// --size is then that of the whole sheet. Without --frames, --fps and --turntable it has C times R pictures of the clip.
    #[arg(long, value_name = "CxR", value_parser = cells)]
    sheet: Option<[u32; 2]>,
    /// Ghosts, as the viewer shows them: N poses before and N after that of the picture, where the clip has them.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_GHOSTS)))]
    ghosts: Option<u32>,
    /// Frames of the clip from one ghost to the next.
    #[arg(long, value_name = "FRAMES", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_SHOTS)), requires = "ghosts", default_value_t = GHOST_STEP_FRAMES)]
    ghost_step: u32,
}

/// `4x3`.
fn cells(text: &str) -> Result<[u32; 2], String> {
    let cells = sides(text).filter(|[columns, rows]| u64::from(*columns) * u64::from(*rows) <= u64::from(MOST_SHOTS));
    cells.ok_or_else(|| "a sheet has columns and rows of pictures, such as 4x3".into())
}

fn rate(text: &str) -> Result<f64, String> {
    let rate: Option<f64> = text.parse().ok();
    rate.filter(|rate| rate.is_finite() && *rate > 0.0)
        .ok_or_else(|| "a rate is a number of pictures a second above 0".into())
}

impl SeriesArguments {
    /// Columns and rows of the sheet that is asked for.
    pub(super) fn sheet(&self) -> Option<[u32; 2]> {
        self.sheet
    }

    /// Whether each picture has a file of its own, in a folder.
    pub(super) fn fills_folder(&self) -> bool {
        self.sheet.is_none() && (self.frames.is_some() || self.fps.is_some() || self.turntable.is_some())
    }

    /// Refuses arguments that make no sense together, whatever the model is.
    pub(super) fn check(&self, output: &Path) -> Result<(), Failure> {
        let is_png = output
            .extension()
            .is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
        if self.fills_folder() && is_png && !output.is_dir() {
            return Err(Failure::WrongUse(format!(
                "several pictures need a folder, and -o {} names a picture; --sheet puts them on one",
                output.display()
            )));
        }
        if !self.fills_folder() && !is_png && !paths::is_special(output) {
            return Err(Failure::WrongUse(format!(
                "-o {} is no name of a picture: PNG is written, so it ends in .png",
                output.display()
            )));
        }
        if self.time.is_some() && self.sheet.is_some() && self.turntable.is_none() {
            let told = "--sheet shows the whole clip, and --time one moment of it; together they need --turntable";
            return Err(Failure::WrongUse(told.into()));
        }
        Ok(())
    }

    /// Brings the session to the time and the ghosts that are asked for, and gives the pictures to draw: one or more.
    pub(super) fn shots(&self, session: &mut Session, model: &Path) -> Result<Vec<Shot>, Failure> {
        let no_clip = |what| Failure::NoClip {
            path: model.to_owned(),
            what,
        };
        if let Some(time_secs) = self.time {
            session.apply(PlayCommand::Seek { time_secs });
        }
        if let Some(count) = self.ghosts {
            let clip = session.clip();
            clip.ok_or_else(|| no_clip("--ghosts"))?;
            session.apply(LookCommand::SetGhosts(Some(GhostPlan {
                before: count,
                after: count,
                step_frames: self.ghost_step,
            })));
        }
        let asked = match (self.frames, self.fps, self.sheet, self.turntable) {
            (Some(count), ..) => Some((Frames::Count(count), "--frames")),
            (_, Some(rate), ..) => Some((Frames::PerSec(rate), "--fps")),
            (.., Some([columns, rows]), None) => Some((Frames::Count(columns * rows), "--sheet without --turntable")),
            _ => None,
        };
        let mut times_secs = Vec::new();
        if let Some((frames, name)) = asked {
            let clip = session.clip().ok_or_else(|| no_clip(name))?;
            let span_secs = [clip.start_secs, clip.end_secs];
            let count = frames.count(span_secs);
            if count > MOST_SHOTS {
                let told = format!("{name} makes {count} pictures of this clip, and there are {MOST_SHOTS} at most");
                return Err(Failure::WrongUse(told));
            }
            times_secs = frames.times_secs(span_secs);
        }
        let mut shots = Shot::series(&times_secs, self.turntable.unwrap_or(0));
        if let Some([columns, rows]) = self.sheet
            && shots.len() > (columns * rows) as usize
        {
            let told = format!("{} pictures have no room on a sheet of {columns}x{rows}", shots.len());
            return Err(Failure::WrongUse(told));
        }
        if shots.is_empty() {
            shots.push(Shot::default());
        }
        Ok(shots)
    }
}
