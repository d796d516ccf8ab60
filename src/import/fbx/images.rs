//! Pictures of textures: inside the file, or beside it.

use std::borrow::Cow;
use std::collections::HashMap;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;

use super::objects::{Object, ObjectIndex, Objects};
use crate::fbx::Record;
use crate::gltf::FindFile;
use crate::import::Picture;
use crate::model::unique_names;

/// What is known of the textures of a file.
pub(super) struct Images {
    /// The name of the picture of each texture.
    names: HashMap<ObjectIndex, String>,
    /// Those inside the file, and those beside it that were given.
    pub(super) pictures: Vec<Picture>,
}

impl Images {
    pub(super) fn read(objects: &Objects<'_, '_>, find_file: FindFile<'_>) -> Self {
        let textures: Vec<_> = objects.of_class("Texture").collect();
        // Textures of one picture share it.
        let mut paths: Vec<String> = Vec::new();
        let mut inside: Vec<Option<Cow<'_, [u8]>>> = Vec::new();
        let mut known: HashMap<Result<ObjectIndex, String>, usize> = HashMap::new();
        let mut of_texture = Vec::with_capacity(textures.len());
        for (index, texture) in textures {
            let Some(path) = path(objects, texture) else { continue };
            // What lies in the file is one picture, whatever its textures call it.
            let video = with_content(objects, texture);
            let key = video.map(|(video, _)| video).ok_or_else(|| path.to_lowercase());
            let place = *known.entry(key).or_insert(paths.len());
            if place == paths.len() {
                inside.push(video.and_then(|(_, record)| content(record)));
                paths.push(path);
            }
            of_texture.push((index, place));
        }
        let bases: Vec<String> = paths.iter().map(|path| base(path).to_owned()).collect();
        let stems = bases
            .iter()
            .map(|name| name.rsplit_once('.').map_or(&**name, |(stem, _)| stem));
        let lower: Vec<String> = stems.map(str::to_lowercase).collect();
        let unique = unique_names(lower.iter().map(String::as_str), "image", |_, _| ());
        let mut names = Vec::with_capacity(paths.len());
        let mut pictures = Vec::new();
        for (place, bytes) in inside.into_iter().enumerate() {
            let number = unique[place].strip_prefix(lower[place].as_str()).unwrap_or_default();
            let name = match (bases[place].rsplit_once('.'), &bytes) {
                (Some((stem, extension)), Some(_)) => format!("{stem}{number}.{extension}"),
                _ => bases[place].clone(),
            };
            let bytes = bytes
                .map(|bytes| bytes.into_owned().into())
                .or_else(|| find_file(&paths[place]));
            pictures.extend(bytes.map(|bytes| Picture {
                name: name.clone(),
                bytes,
            }));
            names.push(name);
        }
        Self {
            names: of_texture
                .into_iter()
                .map(|(index, place)| (index, names[place].clone()))
                .collect(),
            pictures,
        }
    }

    pub(super) fn name(&self, texture: ObjectIndex) -> Option<&str> {
        self.names.get(&texture).map(String::as_str)
    }
}

/// The paths of pictures that are not in the file.
pub(super) fn beside(objects: &Objects<'_, '_>) -> Vec<String> {
    let textures = objects
        .of_class("Texture")
        .filter(|(_, texture)| with_content(objects, texture).is_none());
    let mut paths: Vec<String> = textures.filter_map(|(_, texture)| path(objects, texture)).collect();
    paths.sort();
    paths.dedup();
    paths
}

/// A texture's path beside the file, with `/`. What leads out of the folder is of another machine: its name alone counts then.
fn path(objects: &Objects<'_, '_>, texture: &Object<'_, '_>) -> Option<String> {
    let of = |record: &Record<'_>| {
        let names = ["RelativeFilename", "FileName", "Filename"].into_iter();
        let mut texts = names.filter_map(|name| Some(record.find(name)?.text(0)?.into_owned()));
        texts.find(|text| !text.trim().is_empty())
    };
    let found = of(texture.record).or_else(|| {
        objects
            .children(texture, "Video")
            .find_map(|(_, video)| of(video.record))
    })?;
    let path = found.trim().replace('\\', "/");
    let is_away = path.starts_with('/') || path.contains(':') || path.split('/').any(|part| part == "..");
    let path = if is_away {
        base(&path).to_owned()
    } else {
        path.trim_start_matches("./").to_owned()
    };
    (!path.is_empty()).then_some(path)
}

fn base(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}

/// The object that has the bytes of a texture's picture in the file, and the record of them.
fn with_content<'f, 'a>(objects: &Objects<'f, 'a>, texture: &Object<'f, 'a>) -> Option<(ObjectIndex, &'f Record<'a>)> {
    let mut videos = objects.children(texture, "Video");
    videos.find_map(|(index, video)| {
        let record = video.record.find("Content")?;
        let has_bytes = record.bytes(0).is_some_and(|bytes| !bytes.is_empty());
        has_bytes.then_some((index, record))
    })
}

/// The bytes of a picture. Text has them in base 64, in pieces; one value that is none are the bytes themselves.
fn content<'f>(record: &'f Record<'_>) -> Option<Cow<'f, [u8]>> {
    let mut decoded = Vec::new();
    for index in 0..record.values.len() {
        match BASE64_STANDARD.decode(record.bytes(index)?) {
            Ok(piece) => decoded.extend(piece),
            Err(_) if record.values.len() == 1 => return record.bytes(0).map(Cow::Borrowed),
            Err(_) => (),
        }
    }
    (!decoded.is_empty()).then_some(Cow::Owned(decoded))
}
