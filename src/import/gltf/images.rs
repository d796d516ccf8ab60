//! Pictures inside the file, and the names by which materials find them and those beside it.

use std::borrow::Cow;
use std::collections::HashMap;

use crate::diagnostic::codes;
use crate::diagnostic::collect::{Diagnostics, Place};
use crate::gltf::{Buffers, Fault, FindFile, Reader, Root, Uri};
use crate::import::Picture;
use crate::model::unique_names;

/// What is known of the images of a document.
pub(super) struct Images {
    /// The name of each image, by which its picture is found; `None` for one that is not read.
    pub(super) names: Vec<Option<String>>,
    /// Those inside the file, and those beside it that were given.
    pub(super) pictures: Vec<Picture>,
}

/// An image as the document has it.
enum Found<'a> {
    Beside(String),
    /// Bytes in the file, of a kind with this extension.
    Inside {
        bytes: Cow<'a, [u8]>,
        extension: &'static str,
        stem: String,
    },
    /// The same bytes or the same path as an earlier image.
    Same(usize),
    None,
}

impl Images {
    /// Reads the images that textures use.
    ///
    /// # Errors
    /// When they are far more together than the file holds.
    pub(super) fn read(
        root: &Root,
        reader: &Reader<'_>,
        find_file: FindFile<'_>,
        diagnostics: &mut Diagnostics,
    ) -> Result<Self, Fault> {
        let mut is_used = vec![false; root.images().len()];
        for texture in root.textures() {
            let source = texture.image().and_then(|source| usize::try_from(source.0).ok());
            if let Some(used) = source.and_then(|source| is_used.get_mut(source)) {
                *used = true;
            }
        }
        let mut known = Known::default();
        let mut found = Vec::with_capacity(is_used.len());
        for (index, is_used) in is_used.into_iter().enumerate() {
            let image = if is_used {
                find(root, reader.buffers(), index, &mut known, diagnostics)
            } else {
                Found::None
            };
            if let Found::Inside { bytes, .. } = &image {
                reader.keep(bytes.len() as u64, format_args!("/images/{index}"))?;
            }
            found.push(image);
        }
        let wished = found.iter().map(|found| match found {
            Found::Inside { extension, stem, .. } => format!("{stem}.{extension}"),
            // They are found by their base names, which no picture inside the file should have.
            Found::Beside(path) => path.rsplit('/').next().unwrap_or(path).to_owned(),
            Found::Same(_) | Found::None => String::new(),
        });
        let stems: Vec<String> = wished.map(|name| stem(&name).to_lowercase()).collect();
        let unique = unique_names(stems.iter().map(String::as_str), "image", |_, _| ());
        let mut images = Self {
            names: Vec::with_capacity(found.len()),
            pictures: Vec::new(),
        };
        for ((found, wish), unique) in found.into_iter().zip(&stems).zip(unique) {
            let (name, bytes) = match found {
                Found::Beside(path) => {
                    let bytes = find_file(&path);
                    (Some(path), bytes)
                }
                Found::Same(other) => (images.names.get(other).cloned().flatten(), None),
                Found::None => (None, None),
                Found::Inside { bytes, extension, stem } => {
                    // What makes it unique follows the name as it is spelt.
                    let number = unique.strip_prefix(wish.as_str()).unwrap_or_default();
                    (
                        Some(format!("{stem}{number}.{extension}")),
                        Some(bytes.into_owned().into()),
                    )
                }
            };
            let picture = name.clone().zip(bytes).map(|(name, bytes)| Picture { name, bytes });
            images.pictures.extend(picture);
            images.names.push(name);
        }
        Ok(images)
    }
}

/// The first image of each buffer view and of each path.
#[derive(Default)]
struct Known {
    views: HashMap<u64, usize>,
    paths: HashMap<String, usize>,
}

fn find<'a>(
    root: &'a Root,
    buffers: &'a Buffers<'_>,
    index: usize,
    known: &mut Known,
    diagnostics: &mut Diagnostics,
) -> Found<'a> {
    let image = &root.images()[index];
    let pointer = format!("/images/{index}");
    let not_read = |diagnostics: &mut Diagnostics, key: &str, why: &str| {
        let place = Place::pointer(format!("{pointer}{key}"));
        let message = format!("Image {index} is not read: {why}.");
        diagnostics.add(&codes::GLTF_IMAGE_NOT_READ, place, message);
        Found::None
    };
    // What a data URI says that it is.
    let mut kind = "image/png";
    let (bytes, key) = match (&image.uri, image.buffer_view) {
        (None, None) => return not_read(diagnostics, "", "it has neither an address nor data"),
        (Some(uri), _) => match Uri::parse(uri) {
            Ok(Uri::Path(path)) => match *known.paths.entry(path.clone()).or_insert(index) {
                first if first < index => return Found::Same(first),
                _ => return Found::Beside(path),
            },
            Ok(Uri::Data { media_type, bytes }) => {
                kind = media_type;
                (Cow::Owned(bytes), "/uri")
            }
            Err(error) => return not_read(diagnostics, "/uri", &error.to_string()),
        },
        (None, Some(view)) => {
            let first = *known.views.entry(view.0).or_insert(index);
            if first < index {
                return Found::Same(first);
            }
            match buffers.view(view, format_args!("{pointer}/bufferView")) {
                Ok((bytes, _)) => (Cow::Borrowed(bytes), "/bufferView"),
                Err(fault) => return not_read(diagnostics, "/bufferView", fault.message.trim_end_matches('.')),
            }
        }
    };
    let extension = extension_of(&bytes);
    if extension.is_some() && !["image/png", "image/jpeg", "image/webp"].contains(&kind) {
        let message = format!("\"{kind}\" is no kind of picture that glTF has; it is read by its bytes.");
        diagnostics.add(
            &codes::GLTF_RULE_BROKEN,
            Place::pointer(format!("{pointer}/uri")),
            message,
        );
    }
    let Some(extension) = extension else {
        return not_read(diagnostics, key, "it is none of PNG, JPEG and WebP");
    };
    let name = image.name.as_deref().unwrap_or_default().replace(['/', '\\'], "_");
    let stem = match stem(name.trim()) {
        "" => format!("image {index}"),
        stem => stem.to_owned(),
    };
    Found::Inside { bytes, extension, stem }
}

/// By the first bytes: what a file says of its pictures is often wrong.
fn extension_of(bytes: &[u8]) -> Option<&'static str> {
    let kinds: [(&[u8], &str); 4] = [
        (b"\x89PNG\r\n\x1a\n", "png"),
        (b"\xff\xd8\xff", "jpg"),
        (b"DDS ", "dds"),
        (b"BM", "bmp"),
    ];
    let kind = kinds.into_iter().find(|(magic, _)| bytes.starts_with(magic));
    let webp = (bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP")).then_some("webp");
    kind.map(|(_, extension)| extension).or(webp)
}

/// A name without the extension of a picture.
fn stem(name: &str) -> &str {
    match name.rsplit_once('.') {
        Some((stem, extension))
            if ["png", "jpg", "jpeg", "webp", "dds", "bmp", "tga"]
                .contains(&extension.to_ascii_lowercase().as_str()) =>
        {
            stem
        }
        _ => name,
    }
}
