//! Pictures of textures: inside the file, or beside it.

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use glam::{Affine2, DAffine3, DVec3, Vec2};

use super::objects::{Object, ObjectIndex, Objects};
use super::transform::RotationOrder;
use crate::fbx::Record;
use crate::gltf::FindFile;
use crate::import::Picture;
use crate::model::{MaterialMap, Sampling, Wrap, unique_names};

/// What is known of the textures of a file.
pub(super) struct Images {
    /// The names of pictures.
    names: Vec<String>,
    /// Of each texture: its picture, and how it is sampled.
    textures: HashMap<ObjectIndex, (usize, Sampling)>,
    /// Those inside the file, and those beside it that were given.
    pub(super) pictures: Vec<Picture>,
}

impl Images {
    pub(super) fn read(objects: &Objects<'_, '_>, find_file: FindFile<'_>) -> Self {
        // Textures of one picture share it.
        let mut paths: Vec<String> = Vec::new();
        let mut inside: Vec<Option<Cow<'_, [u8]>>> = Vec::new();
        let mut known: HashMap<Result<ObjectIndex, String>, usize> = HashMap::new();
        let mut of_textures = HashMap::new();
        for (index, path, video) in textures(objects) {
            // What lies in the file is one picture, whatever its textures call it.
            let key = video.map(|(video, _)| video).ok_or_else(|| path.to_lowercase());
            let place = *known.entry(key).or_insert(paths.len());
            if place == paths.len() {
                inside.push(video.and_then(|(_, record)| content(record)));
                paths.push(path);
            }
            of_textures.insert(index, (place, sampling(objects.get(index))));
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
            names,
            textures: of_textures,
            pictures,
        }
    }

    /// The map of a texture.
    pub(super) fn map(&self, texture: ObjectIndex) -> Option<MaterialMap> {
        let &(place, sampling) = self.textures.get(&texture)?;
        let name = self.names[place].clone();
        Some(MaterialMap { name, sampling })
    }
}

/// The paths of pictures that are not in the file.
pub(super) fn beside(objects: &Objects<'_, '_>) -> Vec<String> {
    let without = textures(objects).filter(|(_, _, video)| video.is_none());
    let paths: BTreeSet<String> = without.map(|(_, path, _)| path).collect();
    paths.into_iter().collect()
}

/// The object that has the bytes of a picture in the file, and the record of them.
type Inside<'f, 'a> = (ObjectIndex, &'f Record<'a>);

/// The textures that have a picture, with its path beside the file and where it is in the file.
fn textures<'s, 'f, 'a>(
    objects: &'s Objects<'f, 'a>,
) -> impl Iterator<Item = (ObjectIndex, String, Option<Inside<'f, 'a>>)> + 's {
    // Many textures may have one of them.
    let video = |(index, video): (ObjectIndex, &Object<'f, 'a>)| {
        let content = video.record.find("Content");
        let content = content.filter(|record| record.bytes(0).is_some_and(|bytes| !bytes.is_empty()));
        (index, (content, path(video.record)))
    };
    let videos: HashMap<_, _> = objects.of_class("Video").map(video).collect();
    objects.of_class("Texture").filter_map(move |(index, texture)| {
        let hanging = || objects.hanging(texture, "Video").iter().map(|child| child.to);
        let path = path(texture.record).or_else(|| hanging().find_map(|video| videos[&video].1.clone()));
        let inside = hanging().find_map(|video| Some((video, videos[&video].0?)));
        Some((index, path?, inside))
    })
}

/// A picture's path beside the file, with `/`. What leads out of the folder is of another machine: its name alone counts then.
fn path(record: &Record<'_>) -> Option<String> {
    /// Of a longer one the name alone counts: few systems open such.
    const MOST_BYTES: usize = 1024;
    let short = |text: &'_ [u8]| {
        let start = text
            .iter()
            .rposition(|byte| matches!(byte, b'/' | b'\\'))
            .map_or(0, |at| at + 1);
        let text = if text.len() > MOST_BYTES { &text[start..] } else { text };
        (text.len() <= MOST_BYTES).then(|| String::from_utf8_lossy(text).into_owned())
    };
    let names = ["RelativeFilename", "FileName", "Filename"].into_iter();
    let mut texts = names.filter_map(|name| short(record.find(name)?.bytes(0)?));
    let found = texts.find(|text| !text.trim().is_empty())?;
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

fn sampling(texture: &Object<'_, '_>) -> Sampling {
    let vector = |name: &str, default| {
        texture
            .vector(name)
            .filter(|vector| vector.is_finite())
            .unwrap_or(default)
    };
    let [rotation_pivot, scaling_pivot] =
        ["TextureRotationPivot", "TextureScalingPivot"].map(|name| vector(name, DVec3::ZERO));
    let at = DAffine3::from_translation;
    let rotation = DAffine3::from_quat(RotationOrder::default().rotation(vector("Rotation", DVec3::ZERO)));
    let tex_coords_from_map = at(vector("Translation", DVec3::ZERO) + rotation_pivot)
        * rotation
        * at(scaling_pivot - rotation_pivot)
        * DAffine3::from_scale(vector("Scaling", DVec3::ONE))
        * at(-scaling_pivot);
    let inverse = tex_coords_from_map.inverse();
    let [x, y, origin] =
        [inverse.matrix3.x_axis, inverse.matrix3.y_axis, inverse.translation].map(|column| column.truncate().as_vec2());
    let upright = Affine2::from_cols(x, y, origin);
    // v runs upwards in FBX.
    let turned = Affine2::from_cols(Vec2::X, Vec2::NEG_Y, Vec2::Y);
    let map_from_mesh = turned * upright * turned;
    let wrap = |name: &str| {
        if texture.integer(name) == Some(1) {
            Wrap::Clamp
        } else {
            Wrap::Repeat
        }
    };
    Sampling {
        map_from_mesh: if map_from_mesh.is_finite() {
            map_from_mesh
        } else {
            Affine2::IDENTITY
        },
        wrap: [wrap("WrapModeU"), wrap("WrapModeV")],
        ..Sampling::default()
    }
}
