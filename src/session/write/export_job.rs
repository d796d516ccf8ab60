//! From what is open to a file of another format, in slices, without a session.

use std::sync::Arc;

use super::export_files::pack;
use super::export_maps::{KnownMaps, MapFiles, MapsAsked, plan_maps, unreadable_maps};
use super::export_plan::ExportPlan;
use crate::edit::{Change, EditError, Edited, Edits, apply_in};
use crate::export::{self, ExportError, Loss};
use crate::format::Dialect;
use crate::model::{JointNames, MapSlot, Model};
use crate::modes::modes;
use crate::session::open::maps::Maps;
use crate::slices::{Slices, Stage, at_once};

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
        /// The static models of the books, positions and normals alone.
        Text = "txt", ".txt static";
    }
}

impl ExportFormat {
    /// The dialect of a format of the books.
    pub fn dialect(self) -> Option<Dialect> {
        match self {
            Self::Glb => None,
            Self::D3d12 => Some(Dialect::D3d12),
            Self::D3d11 => Some(Dialect::D3d11),
            Self::Text => Some(Dialect::Text),
        }
    }

    /// Whether the books' programs for skinned models read it.
    pub fn is_m3d(self) -> bool {
        matches!(self, Self::D3d12 | Self::D3d11)
    }

    /// The extension of its files.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Glb => "glb",
            Self::D3d12 | Self::D3d11 => "m3d",
            Self::Text => "txt",
        }
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

/// A model on its way to a file. What is written was taken when it began, whatever happens to the session meanwhile.
#[derive(Debug)]
pub struct ExportJob {
    stem: String,
    format: ExportFormat,
    model: Model,
    names: JointNames,
    edits: Edits,
    /// What was changed and lost before.
    before: ExportPlan,
    maps: KnownMaps,
    asked: MapsAsked,
}

/// A model as it will be written, with all edits made.
#[derive(Debug)]
pub struct PlannedExport {
    stem: String,
    format: ExportFormat,
    edited: Edited,
    maps: KnownMaps,
    files: MapFiles,
    plan: ExportPlan,
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
            names: names.clone(),
            before: ExportPlan {
                changes,
                losses,
                maps: 0,
            },
            model,
            edits,
        }
    }

    /// Makes all edits, and finds out what will be otherwise in the file.
    ///
    /// # Errors
    /// When an edit cannot be made.
    pub async fn plan(self, slices: &Slices) -> Result<PlannedExport, ExportRefusal> {
        let Self {
            stem,
            format,
            model,
            names,
            edits,
            before: mut plan,
            maps,
            asked,
        } = self;
        let mut edited = apply_in(model, &names, &edits, slices).await?;
        slices.pause_at(Stage::Writing, 0, 1).await;
        plan.changes.append(&mut edited.changes);
        let files = match format.dialect() {
            None => {
                plan_glb(&edited.model, &maps, &mut plan);
                MapFiles::default()
            }
            Some(dialect) => {
                let files = match dialect {
                    // It names no maps.
                    Dialect::Text => MapFiles::default(),
                    _ => plan_maps(&mut edited.model, &maps, asked, &mut plan),
                };
                plan.maps = files.waiting.len();
                let of_format = export::m3d_losses(&edited.model, &edited.names, dialect);
                plan.losses.extend(of_format);
                files
            }
        };
        Ok(PlannedExport {
            stem,
            format,
            edited,
            maps,
            files,
            plan,
        })
    }

    /// Plans and writes it at once.
    ///
    /// # Errors
    /// When an edit cannot be made, or the format cannot hold what comes out.
    pub fn run(self) -> Result<ExportedFile, ExportRefusal> {
        at_once(async { self.plan(&Slices::ENDLESS).await?.write(&Slices::ENDLESS).await })
    }

    /// The same, and packs nothing.
    ///
    /// # Errors
    /// As [`ExportJob::run`].
    pub fn run_apart(self) -> Result<WrittenModel, ExportRefusal> {
        at_once(async { self.plan(&Slices::ENDLESS).await?.write_apart(&Slices::ENDLESS).await })
    }
}

impl PlannedExport {
    /// What will be otherwise in the file.
    pub fn plan(&self) -> &ExportPlan {
        &self.plan
    }

    /// The name of the file that it writes.
    pub fn file_name(&self) -> String {
        let packs = self.plan.maps > 0;
        let extension = if packs { "zip" } else { self.format.extension() };
        format!("{}.{extension}", self.stem)
    }

    /// Writes the file: an archive, where pictures come along.
    ///
    /// # Errors
    /// When the format cannot hold it.
    pub async fn write(self, slices: &Slices) -> Result<ExportedFile, ExportRefusal> {
        let name = self.file_name();
        let of_model = format!("{}.{}", self.stem, self.format.extension());
        let WrittenModel { bytes, maps, plan } = self.write_apart(slices).await?;
        let bytes = if maps.is_empty() {
            bytes
        } else {
            let files: Vec<_> = [(of_model, bytes.into())].into_iter().chain(maps).collect();
            pack(&files, slices).await?
        };
        Ok(ExportedFile { name, bytes, plan })
    }

    /// Writes the model and the pictures beside it.
    ///
    /// # Errors
    /// When the format cannot hold it.
    pub async fn write_apart(self, slices: &Slices) -> Result<WrittenModel, ExportRefusal> {
        let Edited { model, names, .. } = &self.edited;
        let mut maps = Vec::new();
        let exported = match self.format.dialect() {
            None => {
                let pictures = self.maps.pictures.iter();
                let sources = pictures.map(|(&place, file)| (place, file.bytes.clone()));
                export::glb_in(model, names, &self.maps.lent(), &sources.collect(), slices).await?
            }
            Some(dialect) => {
                let count = self.files.waiting.len();
                for (name, content) in self.files.waiting {
                    slices.pause_at(Stage::Writing, maps.len(), 1 + count).await;
                    maps.push((name, content.bytes()?));
                }
                slices.pause_at(Stage::Writing, count, 1 + count).await;
                export::m3d_in(model, names, dialect, &self.files.looks, slices).await?
            }
        };
        Ok(WrittenModel {
            bytes: exported.bytes,
            maps,
            plan: self.plan,
        })
    }
}

/// `soldier-d3d12`: files for both books can lie in one folder.
fn stem_of(stem: &str, format: ExportFormat) -> String {
    if matches!(format, ExportFormat::Glb | ExportFormat::Text) {
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
