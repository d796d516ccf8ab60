//! What the arguments name: a file, its model, a clip, a time.

use std::path::Path;

use clap::builder::{PossibleValuesParser, TypedValueParser};

use super::failure::Failure;
use super::paths;
use crate::import;
use crate::model::Model;
use crate::session::{self, File, FileKind, OpenModel};

/// A file's bytes, or those of standard input. It is read as a model whatever its name is, so that a picture is refused with a message
/// about its content.
pub(super) fn read(path: &Path) -> Result<File, Failure> {
    Ok(File::new("model.m3d", paths::read(path)?))
}

/// The same with the files beside it that it names, as far as they are there.
pub(super) fn read_all(path: &Path) -> Result<Vec<File>, Failure> {
    let model = read(path)?;
    let named = import::files_beside(&model.bytes).into_iter();
    let beside = named.filter_map(|name| Some(File::sharing(&name, beside(path, &name)?)));
    let beside: Vec<File> = beside.collect();
    Ok(std::iter::once(model).chain(beside).collect())
}

/// The bytes of a file that a model names by a relative path, or else that of its base name in the folder `NAME.fbm`, into which programs unpack the
/// pictures of `NAME.fbx`. Only regular files are opened: opening a pipe would wait for a writer.
pub(super) fn beside(model: &Path, name: &str) -> Option<bytes::Bytes> {
    let unpacked = model.with_extension("fbm").join(Path::new(name).file_name()?);
    let mut places = [model.parent()?.join(name), unpacked].into_iter();
    let path = places.find(|path| path.is_file())?;
    Some(paths::read_file(&path).ok()?.into())
}

/// A model that can be shown. It has its name where that is a model's.
pub(super) fn load(path: &Path) -> Result<OpenModel, Failure> {
    let mut file = read(path)?;
    let name = path
        .file_name()
        .map(|name| File::sharing(&name.to_string_lossy(), file.bytes.clone()));
    if let Some(named) = name.filter(|named| named.kind() == Some(FileKind::Model)) {
        file = named;
    }
    session::load_beside(&file, &|name| beside(path, name)).map_err(|error| Failure::Refused {
        path: path.to_owned(),
        error,
    })
}

/// The index of the clip named `asked`, or of the only clip when no name is given. `None` for a model without clips.
pub(super) fn choose_clip(model: &Model, path: &Path, asked: Option<&str>) -> Result<Option<usize>, Failure> {
    let known = || model.clips.iter().map(|clip| clip.name.clone()).collect();
    match (asked, model.clips.len()) {
        (Some(asked), _) => {
            let index = model.clips.iter().position(|clip| clip.name == asked);
            index.map(Some).ok_or_else(|| Failure::UnknownClip {
                path: path.to_owned(),
                asked: asked.to_owned(),
                known: known(),
            })
        }
        (None, 0) => Ok(None),
        (None, 1) => Ok(Some(0)),
        (None, _) => Err(Failure::ClipNotNamed {
            path: path.to_owned(),
            known: known(),
        }),
    }
}

/// Two whole numbers above 0: `1280x720`.
pub(super) fn sides(text: &str) -> Option<[u32; 2]> {
    let (width, height) = text.split_once(['x', 'X', '×'])?;
    let sides = [width.parse().ok()?, height.parse().ok()?];
    (!sides.contains(&0)).then_some(sides)
}

/// Seconds of a clip, as an argument.
pub(super) fn seconds(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(time_secs) if time_secs.is_finite() => Ok(time_secs),
        _ => Err("a time is a number of seconds".into()),
    }
}

/// Reads one of some modes by its name. Help and errors list the names.
pub(super) fn one_of<T: Copy + Send + Sync + 'static>(
    modes: &'static [T],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(modes.iter().map(move |mode| name(*mode))).try_map(move |text| {
        let named = modes.iter().find(|mode| name(**mode) == text);
        named.copied().ok_or("no such name")
    })
}
