//! From what is open to a file of another format, in steps, without a session.

use std::sync::Arc;

use super::export_files::Archive;
use super::export_maps::{KnownMaps, MapFiles, MapsAsked, plan_maps, unreadable_maps};
use super::export_plan::ExportPlan;
use crate::edit::{Change, EditError, EditJob, Edited, Edits};
use crate::export::{self, EncodedMaps, ExportError, Exported, Loss};
use crate::format::Dialect;
use crate::model::{JointNames, MapSlot, Model};
use crate::modes::modes;
use crate::session::open::maps::Maps;

modes! {
    /// What a model is written as.
    #[derive(Default)]
    pub enum ExportFormat {
        #[default]
        Glb = "glb", "GLB";
        /// The format of the DirectX 12 book.
        D3d12 = "d3d12", ".m3d D3D12";
        /// The format of the DirectX 11 book.
        D3d11 = "d3d11", ".m3d D3D11";
    }
}

impl ExportFormat {
    /// The dialect of a format of the books.
    pub fn dialect(self) -> Option<Dialect> {
        match self {
            Self::Glb => None,
            Self::D3d12 => Some(Dialect::D3d12),
            Self::D3d11 => Some(Dialect::D3d11),
        }
    }

    /// The extension of its files.
    pub fn extension(self) -> &'static str {
        if self == Self::Glb { "glb" } else { "m3d" }
    }
}

/// How far a job is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Steps that are done.
    pub done: usize,
    /// All steps that are known of.
    pub total: usize,
}

impl Progress {
    /// How much is done, rounded down.
    pub fn percent(self) -> usize {
        100 * self.done / self.total.max(1)
    }
}

/// A model that was written, and the pictures beside it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrittenModel {
    /// The bytes of its file.
    pub bytes: Vec<u8>,
    /// Pictures that its materials name: the name and the bytes of each.
    pub maps: Vec<(String, bytes::Bytes)>,
    /// What is otherwise in it.
    pub plan: ExportPlan,
}

/// A file that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportedFile {
    /// Its name: `soldier.glb`, `soldier-d3d12.m3d`, or `soldier-d3d12.zip` where pictures come along.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// What is otherwise in it.
    pub plan: ExportPlan,
}

impl ExportedFile {
    /// Its media type.
    pub fn media_type(&self) -> &'static str {
        match self.name.rsplit_once('.') {
            Some((_, "glb")) => "model/gltf-binary",
            Some((_, "zip")) => "application/zip",
            _ => "text/plain",
        }
    }
}

/// Why no file was written.
#[derive(Debug, thiserror::Error)]
pub enum ExportRefusal {
    /// An edit cannot be made.
    #[error(transparent)]
    Edit(#[from] EditError),
    /// The format cannot hold it.
    #[error(transparent)]
    Write(#[from] ExportError),
    #[error("The archive could not be written: {0}.")]
    Archive(#[from] std::io::Error),
}

/// Writes a model as a file, in steps: it can tell how far it is and be dropped between two of them. What it writes was taken when it
/// began, whatever happens to the session meanwhile.
#[derive(Debug)]
pub struct ExportJob {
    stem: String,
    format: ExportFormat,
    maps: KnownMaps,
    asked: MapsAsked,
    state: State,
}

#[derive(Debug)]
enum State {
    /// What was changed and lost before, and the edits.
    Edit(ExportPlan, Box<EditJob>),
    /// The pictures of a `.glb` are encoded one by one first.
    Glb(Box<Edited>, EncodedMaps, ExportPlan),
    /// So are those beside a file of the books.
    M3d(Box<Edited>, MapFiles, ExportPlan),
    Pack(Box<Archive>, ExportPlan),
}

/// What is written, and how.
#[derive(Debug)]
pub struct ToExport<'a> {
    /// The model.
    pub model: Model,
    /// Names that a person gave to its bones.
    pub names: &'a JointNames,
    /// What was changed before.
    pub changes: Vec<Change>,
    /// What was lost before.
    pub losses: Vec<Loss>,
    /// What is to be changed.
    pub edits: Edits,
    /// Its maps. A `.glb` has them inside.
    pub maps: &'a Maps,
    /// The format.
    pub format: ExportFormat,
    /// Pictures are written beside a file of the books. Otherwise its materials keep their names for them.
    pub writes_maps: bool,
    /// Green of normal maps may point up, and is turned where a picture is written beside a file of the books.
    pub turns_green: bool,
}

/// What became of a job in a step.
#[derive(Debug)]
pub enum ExportStep {
    /// There is more to do.
    Working(Box<ExportJob>),
    Ended(Result<Box<ExportedFile>, ExportRefusal>),
}

impl ExportJob {
    /// A job that has done nothing yet. `stem` is the file's name without its extension; a file of the books has the book behind it.
    pub fn new(stem: &str, what: ToExport<'_>) -> Self {
        let ToExport {
            model,
            names,
            changes,
            losses,
            edits,
            maps,
            format,
            writes_maps,
            turns_green,
        } = what;
        let places = || (0..model.materials.len()).flat_map(|material| MapSlot::ALL.map(|slot| (material, slot)));
        let images = places().filter_map(|place| Some((place, Arc::clone(maps.image(place.0, place.1)?))));
        let pictures = places().filter_map(|place| Some((place, maps.file(place.0, place.1)?.clone())));
        Self {
            stem: stem_of(stem, format),
            format,
            maps: KnownMaps {
                images: images.collect(),
                pictures: pictures.collect(),
            },
            asked: MapsAsked {
                are_written: writes_maps,
                for_book: edits.for_book,
                dialect: format.dialect().unwrap_or(Dialect::D3d12),
                turns_green,
            },
            state: State::Edit(
                ExportPlan {
                    changes,
                    losses,
                    maps: 0,
                },
                Box::new(EditJob::new(model, names, edits)),
            ),
        }
    }

    /// What will be otherwise in the file, once all edits are made.
    pub fn plan(&self) -> Option<&ExportPlan> {
        match &self.state {
            State::Edit(..) => None,
            State::Glb(_, _, plan) | State::M3d(_, _, plan) | State::Pack(_, plan) => Some(plan),
        }
    }

    /// The name of the file that it writes; that of the model alone until it is planned.
    pub fn file_name(&self) -> String {
        let packs = self.plan().is_some_and(|plan| plan.maps > 0);
        let extension = if packs { "zip" } else { self.format.extension() };
        format!("{}.{extension}", self.stem)
    }

    /// How far it is.
    pub fn progress(&self) -> Progress {
        let parts = |done: usize, more: usize| Progress {
            done,
            total: done + more,
        };
        match &self.state {
            State::Edit(_, edits) => {
                let [done, total] = edits.progress();
                parts(done, total - done + 1)
            }
            State::Glb(_, encoded, _) => {
                let done = encoded.count();
                parts(1 + done, 1 + self.maps.images.len().saturating_sub(done))
            }
            State::M3d(_, files, _) => {
                let [done, waiting] = files.progress();
                parts(1 + done, 1 + waiting)
            }
            State::Pack(archive, _) => {
                let [done, total] = archive.progress();
                parts(done, total - done)
            }
        }
    }

    /// Makes an edit, thins the keys of a clip, makes a picture, writes the model, or packs a part.
    pub fn step(mut self) -> ExportStep {
        match self.next() {
            Ok(None) => ExportStep::Working(Box::new(self)),
            Ok(Some(file)) => ExportStep::Ended(Ok(Box::new(file))),
            Err(refusal) => ExportStep::Ended(Err(refusal)),
        }
    }

    /// Does all steps.
    ///
    /// # Errors
    /// When an edit cannot be made, or the format cannot hold what comes out.
    pub fn run(mut self) -> Result<ExportedFile, ExportRefusal> {
        loop {
            if let Some(file) = self.next()? {
                return Ok(file);
            }
        }
    }

    /// Does all steps, and packs nothing.
    ///
    /// # Errors
    /// As [`ExportJob::run`].
    pub fn run_apart(mut self) -> Result<WrittenModel, ExportRefusal> {
        loop {
            if let Some(written) = self.write_next()? {
                return Ok(written);
            }
        }
    }

    fn next(&mut self) -> Result<Option<ExportedFile>, ExportRefusal> {
        if let State::Pack(archive, plan) = &mut self.state {
            let Some(bytes) = archive.step()? else { return Ok(None) };
            let plan = std::mem::take(plan);
            return Ok(Some(ExportedFile {
                name: format!("{}.zip", self.stem),
                bytes,
                plan,
            }));
        }
        let Some(WrittenModel { bytes, maps, plan }) = self.write_next()? else {
            return Ok(None);
        };
        let name = format!("{}.{}", self.stem, self.format.extension());
        if maps.is_empty() {
            return Ok(Some(ExportedFile { name, bytes, plan }));
        }
        let files = [(name, bytes.into())].into_iter().chain(maps);
        self.state = State::Pack(Box::new(Archive::new(files)), plan);
        Ok(None)
    }

    /// A step up to the model's file, but for those that pack it.
    fn write_next(&mut self) -> Result<Option<WrittenModel>, ExportRefusal> {
        let images = self.maps.lent();
        match &mut self.state {
            State::Edit(before, edits) => {
                if !edits.step()? {
                    let mut edited = edits.clone().finish();
                    let mut plan = std::mem::take(before);
                    plan.changes.append(&mut edited.changes);
                    self.state = match self.format.dialect() {
                        None => {
                            plan_glb(&edited.model, &self.maps, &mut plan);
                            let mut encoded = EncodedMaps::default();
                            for (place, image) in &self.maps.images {
                                if let Some(file) = self.maps.pictures.get(place) {
                                    encoded.add_file(image, file.bytes.clone());
                                }
                            }
                            State::Glb(Box::new(edited), encoded, plan)
                        }
                        Some(dialect) => {
                            let files = plan_maps(&mut edited.model, &self.maps, self.asked, &mut plan);
                            plan.maps = files.count();
                            let of_format = export::m3d_losses(&edited.model, &edited.names, dialect);
                            plan.losses.extend(of_format);
                            State::M3d(Box::new(edited), files, plan)
                        }
                    };
                }
                Ok(None)
            }
            State::Glb(edited, encoded, plan) => {
                let Edited { model, names, .. } = &**edited;
                if export::encode_map(model, &images, encoded)? {
                    return Ok(None);
                }
                let Exported { bytes, .. } = export::glb_with(model, names, &images, std::mem::take(encoded))?;
                Ok(Some(WrittenModel {
                    bytes,
                    maps: Vec::new(),
                    plan: std::mem::take(plan),
                }))
            }
            State::M3d(edited, files, plan) => {
                if files.make_next()? {
                    return Ok(None);
                }
                let dialect = self.format.dialect().unwrap_or(Dialect::D3d12);
                let Exported { bytes, .. } = export::m3d_with(&edited.model, &edited.names, dialect, &files.looks)?;
                Ok(Some(WrittenModel {
                    bytes,
                    maps: std::mem::take(&mut files.made),
                    plan: std::mem::take(plan),
                }))
            }
            // What is packed was written before.
            State::Pack(..) => Ok(None),
        }
    }
}

/// `soldier-d3d12`: files for both books can lie in one folder.
fn stem_of(stem: &str, format: ExportFormat) -> String {
    if format.dialect().is_none() {
        return stem.to_owned();
    }
    let endings = ExportFormat::ALL.map(|other| format!("-{}", other.name()));
    let plain = endings.iter().find_map(|ending| stem.strip_suffix(ending.as_str()));
    format!("{}-{}", plain.unwrap_or(stem), format.name())
}

fn plan_glb(model: &Model, known: &KnownMaps, plan: &mut ExportPlan) {
    let images = &known.lent();
    let turned = export::turned_materials(model, images);
    let count = turned.iter().filter(|turned| **turned).count();
    plan.changes.extend(Change::counted(
        "normal-green-turned",
        count,
        ["normal map has", "normal maps have"],
        "green up, as glTF has it, and the tangents' sign follows.",
    ));
    let unreadable = known.unreadable(&MapSlot::ALL);
    plan.losses.extend(export::glb_losses(model, images, &unreadable));
    plan.losses.extend(unreadable_maps(unreadable.len()));
}
