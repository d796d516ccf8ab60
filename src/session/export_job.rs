//! From what is open to a file of another format, in steps, without a session.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::export_files::Archive;
use super::files::File;
use super::load::Progress;
use crate::edit::{Change, EditError, EditJob, Edited};
use crate::export::{self, EncodedMaps, ExportError, Exported, Loss};
use crate::format::Dialect;
use crate::image::Image;
use crate::model::MapSlot;
use crate::modes::modes;

modes! {
    /// What a model is written as.
    #[derive(Default)]
    pub enum ExportFormat {
        /// glTF's binary form.
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

/// What will be otherwise in a file, known before it is written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ExportPlan {
    /// What was edited, in the order of the edits.
    pub changes: Vec<Change>,
    /// What the format does not hold, or holds otherwise.
    pub losses: Vec<Loss>,
    /// Pictures that come along in an archive.
    pub maps: usize,
}

/// A file that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportedFile {
    /// Its name: `soldier.glb`, or `soldier.zip` where pictures come along.
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
    /// The archive would be too large.
    #[error("The archive could not be written: {0}.")]
    Archive(#[from] std::io::Error),
}

/// Writes a model as a file, in steps: it can tell how far it is and be dropped between two of them. What it writes was taken when it
/// began, whatever happens to the session meanwhile.
#[derive(Debug)]
pub struct ExportJob {
    pub(super) stem: String,
    pub(super) format: ExportFormat,
    /// Decoded maps of the materials.
    pub(super) images: BTreeMap<(usize, MapSlot), Arc<Image>>,
    /// The files that they came from.
    pub(super) pictures: BTreeMap<(usize, MapSlot), File>,
    pub(super) state: State,
}

#[derive(Debug)]
pub(super) enum State {
    /// What was changed before, and the edits.
    Edit(Vec<Change>, Box<EditJob>),
    /// The pictures of a `.glb` are encoded one by one first.
    Write(Box<Edited>, EncodedMaps, ExportPlan),
    Pack(Box<Archive>, ExportPlan),
}

/// What became of a job in a step.
#[derive(Debug)]
pub enum ExportStep {
    /// There is more to do.
    Working(Box<ExportJob>),
    /// It has ended.
    Ended(Result<Box<ExportedFile>, ExportRefusal>),
}

impl ExportJob {
    /// What will be otherwise in the file, once all edits are made.
    pub fn plan(&self) -> Option<&ExportPlan> {
        match &self.state {
            State::Edit(..) => None,
            State::Write(_, _, plan) | State::Pack(_, plan) => Some(plan),
        }
    }

    /// The name of the file that it writes.
    pub fn file_name(&self) -> String {
        let packs = self.format.dialect().is_some() && self.pictures.keys().any(|&(_, slot)| is_of_book(slot));
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
            State::Write(_, encoded, _) => {
                let done = encoded.count();
                parts(1 + done, 1 + self.images.len().saturating_sub(done))
            }
            State::Pack(archive, _) => {
                let [done, total] = archive.progress();
                parts(done, total - done)
            }
        }
    }

    /// Makes an edit, thins the keys of a clip, writes the model, or packs a part of a picture.
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

    fn next(&mut self) -> Result<Option<ExportedFile>, ExportRefusal> {
        match &mut self.state {
            State::Edit(changes, edits) => {
                if !edits.step()? {
                    let edited = edits.clone().finish();
                    changes.extend(edited.changes.iter().cloned());
                    let plan = self.planned(&edited);
                    self.state = State::Write(Box::new(edited), EncodedMaps::default(), plan);
                }
                Ok(None)
            }
            State::Write(edited, encoded, plan) => {
                let is_glb = self.format.dialect().is_none();
                if is_glb && export::encode_map(&edited.model, &lent(&self.images), encoded)? {
                    return Ok(None);
                }
                let (plan, encoded) = (std::mem::take(plan), std::mem::take(encoded));
                let Exported { bytes, .. } = match self.format.dialect() {
                    Some(dialect) => export::m3d(&edited.model, &edited.names, dialect)?,
                    None => export::glb_with(&edited.model, &edited.names, &lent(&self.images), encoded)?,
                };
                if plan.maps == 0 {
                    let name = self.file_name();
                    return Ok(Some(ExportedFile { name, bytes, plan }));
                }
                let model = (format!("{}.{}", self.stem, self.format.extension()), bytes.into());
                let pictures = beside(edited, &self.pictures);
                self.state = State::Pack(Box::new(Archive::new([model].into_iter().chain(pictures))), plan);
                Ok(None)
            }
            State::Pack(archive, plan) => Ok(match archive.step()? {
                None => None,
                Some(bytes) => {
                    let plan = std::mem::take(plan);
                    let name = self.file_name();
                    Some(ExportedFile { name, bytes, plan })
                }
            }),
        }
    }

    fn planned(&self, edited: &Edited) -> ExportPlan {
        let changes = match &self.state {
            State::Edit(changes, _) => changes.clone(),
            _ => Vec::new(),
        };
        let (losses, maps) = match self.format.dialect() {
            Some(dialect) => (
                export::m3d_losses(&edited.model, &edited.names, dialect),
                beside(edited, &self.pictures).count(),
            ),
            None => (export::glb_losses(&edited.model, &lent(&self.images)), 0),
        };
        ExportPlan { changes, losses, maps }
    }
}

fn lent(images: &BTreeMap<(usize, MapSlot), Arc<Image>>) -> export::MapImages<'_> {
    images.iter().map(|(&place, image)| (place, &**image)).collect()
}

/// Whether the books' materials have such a map.
fn is_of_book(slot: MapSlot) -> bool {
    matches!(slot, MapSlot::Diffuse | MapSlot::Normal)
}

/// The pictures that a file of the books names, each once, under the name that it gives.
fn beside(edited: &Edited, pictures: &BTreeMap<(usize, MapSlot), File>) -> impl Iterator<Item = (String, Arc<[u8]>)> {
    let named = pictures.iter().filter_map(|(&(material, slot), file)| {
        let name = edited.model.materials.get(material)?.map_name(slot)?;
        let name = name_in_archive(&export::one_word(name), file);
        (is_of_book(slot) && !name.is_empty()).then(|| (name, Arc::clone(&file.bytes)))
    });
    named.collect::<BTreeMap<_, _>>().into_iter()
}

/// The name that a material gives, as a path that stays inside a folder. Where the picture is of another kind than the name says, it has
/// the ending of its own.
fn name_in_archive(name: &str, file: &File) -> String {
    let parts = name.split(['/', '\\']).map(str::trim);
    let inside = |part: &&str| !part.is_empty() && !part.contains(':') && part.chars().any(|letter| letter != '.');
    let path = parts.filter(inside).collect::<Vec<_>>().join("/");
    let named = File::new(&path, Vec::new());
    let extension = file.extension();
    if extension.is_empty() || named.extension() == extension {
        return path;
    }
    let stem_len = path.len() - named.extension().len();
    format!("{}.{extension}", path[..stem_len].trim_end_matches('.'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_keeps_the_name_of_its_material_and_stays_inside() {
        let named = |name: &str, file: &str| name_in_archive(name, &File::new(file, Vec::new()));
        assert_eq!(named("head_diff.dds", "maps/HEAD_DIFF.DDS"), "head_diff.dds");
        assert_eq!(named("head_diff.dds", "head_diff.png"), "head_diff.png");
        assert_eq!(named("C:\\art\\..\\head.dds", "head.dds"), "art/head.dds");
        assert_eq!(named("skin", "skin.png"), "skin.png");
        assert_eq!(named("..", "x.png"), ".png");
    }
}
