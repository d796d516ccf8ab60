//! Writing what is open as a file of another format: what would be otherwise, and the work, which somebody does piece by piece.

use super::export::{Export, ExportCommand, ExportOptions, ExportRange, Exporting, Made, Stamp};
use super::export_job::{ExportJob, ExportRefusal, ExportedFile, ToExport};
use crate::check::book::DEMO_CLIP;
use crate::edit::{Change, Edits};
use crate::model::{Front, Material};
use crate::session::Session;
use crate::slices::{Sliced, Slices, Stage, StageProgress};

impl Session {
    pub(in crate::session) fn apply_to_export(&mut self, command: ExportCommand) {
        match command {
            ExportCommand::Plan(options) => {
                let options = options.map(|options| *options);
                if self.exporting.options != options {
                    self.exporting = Exporting {
                        options,
                        ..Exporting::default()
                    };
                }
            }
            ExportCommand::Save => self.exporting.saves = self.exporting.options.is_some(),
            ExportCommand::Cancel => {
                let exporting = &mut self.exporting;
                if std::mem::take(&mut exporting.saves) {
                    (exporting.made, exporting.of) = (Made::Nothing, None);
                }
            }
        }
    }

    /// What is planned or written; `None` when nobody asked for it, and without a model.
    pub fn export(&self) -> Option<Export<'_>> {
        let Exporting {
            options, made, saves, ..
        } = &self.exporting;
        self.open_model()?;
        let progress = match made {
            Made::Planning(work) => work.progress(),
            Made::Writing { work, .. } => work.progress(),
            Made::Nothing | Made::Planned(_) | Made::Refused(_) => StageProgress::new(Stage::Editing, 0, 1),
        };
        Some(Export {
            options: options.as_ref()?,
            plan: made.plan().map(|(plan, _)| plan),
            refusal: match made {
                Made::Refused(refusal) => Some(refusal),
                _ => None,
            },
            saving: saves.then_some(progress),
        })
    }

    /// The name of the file that is planned.
    pub fn export_name(&self) -> Option<String> {
        self.exporting.made.plan().map(|(_, name)| name)
    }

    /// Does one piece of what is planned or written, for what is open now. Whether there was one to do.
    pub fn step_export(&mut self) -> bool {
        let Some(options) = self.exporting.options.clone() else {
            return false;
        };
        let stamp = self.stamp(&options);
        let exporting = &mut self.exporting;
        let is_known = exporting.of == stamp;
        // What is being written was taken when that began, but it ends with its model.
        let model = |stamp: &Option<Stamp>| stamp.as_ref().map(|stamp| stamp.revisions[0]);
        let is_saved_from_it = exporting.saves && model(&exporting.of) == model(&stamp);
        if !is_known && !is_saved_from_it {
            (exporting.made, exporting.saves) = (Made::Nothing, false);
        }
        // Each slice is one piece of work: who calls this has the clock.
        let slices = Slices::new(|| true);
        let made = match std::mem::take(&mut exporting.made) {
            Made::Nothing => {
                let Some(job) = self.export_job(&options) else {
                    return false;
                };
                self.exporting.of = stamp;
                Made::Planning(Sliced::new(&slices, async move |slices| job.plan(&slices).await))
            }
            Made::Planned(planned) if exporting.saves => Made::Writing {
                name: planned.file_name(),
                plan: Box::new(planned.plan().clone()),
                work: Sliced::new(&slices, async move |slices| planned.write(&slices).await),
            },
            idle @ (Made::Planned(_) | Made::Refused(_)) => {
                (exporting.made, exporting.saves) = (idle, false);
                return false;
            }
            underway => underway,
        };
        let exporting = &mut self.exporting;
        exporting.made = match made {
            Made::Planning(mut work) => match work.advance() {
                None => Made::Planning(work),
                Some(Ok(planned)) => Made::Planned(Box::new(planned)),
                Some(Err(refusal)) => exporting.refused(&refusal),
            },
            Made::Writing { name, plan, mut work } => match work.advance() {
                None => Made::Writing { name, plan, work },
                Some(Ok(file)) => {
                    // A job ends with its file. What the next one would be is planned anew.
                    (exporting.written, exporting.saves) = (Some(file), false);
                    Made::Nothing
                }
                Some(Err(refusal)) => exporting.refused(&refusal),
            },
            idle => idle,
        };
        true
    }

    /// The file that was written since the last call.
    pub fn take_exported(&mut self) -> Option<ExportedFile> {
        self.exporting.written.take()
    }

    /// A job that writes what is open as one sees it: with the materials that were edited, the names that were given, and the handedness,
    /// up axis and green of normal maps that were chosen. `None` without a model.
    pub fn export_job(&self, options: &ExportOptions) -> Option<ExportJob> {
        let open = self.open_model()?;
        let mut model = open.model.clone();
        let edited = (0..model.materials.len())
            .filter(|&material| self.is_edited(material))
            .count();
        model.materials = self.materials().to_vec();
        if self.handedness() != model.handedness {
            // Space is mirrored, and the fronts stay where they were.
            model.mesh.turn_triangles();
        }
        (model.handedness, model.up_axis) = (self.handedness(), self.up_axis());
        let words = ["material is written as it was", "materials are written as they were"];
        let edited = Change::counted("materials-edited", edited, words, "edited here.");
        let materials = model.materials.iter();
        let is_mapped: Vec<bool> = materials.map(Material::has_normal_map).collect();
        let green_flipped = self.look().normal_green_flipped && is_mapped.contains(&true);
        if green_flipped {
            model.turn_bitangents(|material| is_mapped[material]);
        }
        let flipped = green_flipped.then(|| Change {
            code: "normal-green-flipped",
            message: "Green of normal maps is taken as it was chosen here.".to_owned(),
        });
        let (name, clips) = (open.file.base_name(), options.clips.as_deref());
        let is_written = |name: &String| clips.is_none_or(|clips| clips.contains(name));
        let in_place = open.kept_in_place().filter(|(name, _)| is_written(name));
        let what = ToExport {
            turns_green: green_flipped || model.front == Front::Positive,
            model,
            names: self.joint_names(),
            changes: open
                .mended(clips)
                .chain(edited)
                .chain(flipped)
                .chain(in_place.map(|(_, change)| change.clone()))
                .collect(),
            losses: open.left_out(clips, options.format.dialect().is_none()).collect(),
            edits: self.edits(options),
            maps: self.maps(),
            format: options.format,
            writes_maps: true,
        };
        Some(ExportJob::new(
            name.rsplit_once('.').map_or(name, |(stem, _)| stem),
            what,
        ))
    }

    /// What is edited before it is written.
    fn edits(&self, options: &ExportOptions) -> Edits {
        let is_of_book = options.format.dialect().is_some();
        let all = || self.content.clips().iter().map(|clip| clip.name.clone());
        let chosen = || options.clips.clone().unwrap_or_else(|| all().collect());
        // What is in place as it is shown stays as it is.
        let is_kept = |name: &String| {
            self.open_model()
                .is_some_and(|open| open.kept_in_place().any(|(kept, _)| kept == name))
        };
        let to_keep = || chosen().into_iter().filter(|name| !is_kept(name)).collect();
        let for_book = options.for_book && options.format.is_m3d();
        // The first of them gets the demo's name by itself.
        let first = self.kept_clips(options).next();
        let watched = self.demo_clip(options).filter(|_| for_book);
        let watched = watched.filter(|name| Some(*name) != first && *name != DEMO_CLIP);
        let edits = Edits {
            clips: options.clips.clone(),
            in_place: if options.in_place { to_keep() } else { Vec::new() },
            range_secs: match options.range {
                ExportRange::Timeline => self.timeline_range(options.clips.as_deref()),
                ExportRange::Whole => None,
                ExportRange::Secs(range_secs) => Some(range_secs),
            },
            close_loop_secs: options.close_loop_secs,
            reduce: options.reduce,
            for_book,
            clip_names: watched
                .map(|name| (name.to_owned(), DEMO_CLIP.to_owned()))
                .into_iter()
                .collect(),
            ..Edits::default()
        };
        match self.open_model() {
            Some(open) if is_of_book => edits.in_space_of_the_books(&open.model),
            _ => edits,
        }
    }

    /// The clip that the books' demo plays of a file that is made for it: `Take1` where one that is kept has that name, else the clip on show,
    /// else the first that is kept.
    pub fn demo_clip<'a>(&'a self, options: &'a ExportOptions) -> Option<&'a str> {
        let mut kept = self.kept_clips(options);
        let shown = self.clip().map(|clip| clip.name.as_str());
        let shown = shown.filter(|shown| self.kept_clips(options).any(|name| name == *shown));
        let first = self.kept_clips(options).next();
        kept.find(|name| *name == DEMO_CLIP).or(shown).or(first)
    }

    /// The clips that are written, in the model's order.
    fn kept_clips<'a>(&'a self, options: &'a ExportOptions) -> impl Iterator<Item = &'a str> {
        let names = self.content.clips().iter().map(|clip| clip.name.as_str());
        let is_kept = |name: &&str| {
            options
                .clips
                .as_ref()
                .is_none_or(|kept| kept.iter().any(|kept| kept == name))
        };
        names.filter(is_kept)
    }

    /// The timeline's range, where its clip is the only one of these.
    pub fn timeline_range(&self, clips: Option<&[String]>) -> Option<[f32; 2]> {
        let shown = self.clip()?;
        let is_only = match clips {
            Some(names) => names == [shown.name.as_str()],
            None => self.content.clip_count() == 1,
        };
        self.playback().range_secs().filter(|_| is_only)
    }

    fn stamp(&self, options: &ExportOptions) -> Option<Stamp> {
        self.open_model()?;
        let revisions = &self.revisions;
        Some(Stamp {
            format: options.format,
            edits: self.edits(options),
            space: (self.handedness(), self.up_axis()),
            green_flipped: self.look().normal_green_flipped,
            revisions: [
                revisions.model,
                revisions.clips,
                revisions.materials,
                revisions.maps,
                revisions.names,
            ],
            clip_count: self.content.clip_count(),
        })
    }
}

impl Exporting {
    fn refused(&mut self, refusal: &ExportRefusal) -> Made {
        self.saves = false;
        Made::Refused(refusal.to_string())
    }
}
