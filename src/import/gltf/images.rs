//! Pictures inside the file, and the names by which materials find them and those beside it.

use std::collections::HashMap;
use std::sync::Arc;

use crate::diagnostic::codes;
use crate::diagnostic::collect::{Diagnostics, Place};
use crate::gltf::{Buffers, FindFile, Root, Uri};
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
enum Found {
    /// A path beside the file, and its bytes where they were asked for.
    Beside(String, Option<Arc<[u8]>>),
    /// Bytes in the file, of a kind with this extension. `same_as` is an earlier image with the same bytes.
    Inside {
        bytes: Vec<u8>,
        extension: &'static str,
        stem: String,
    },
    /// The same bytes as an earlier image.
    Same(usize),
    None,
}

impl Images {
    /// Reads the images that textures use.
    pub(super) fn read(
        root: &Root,
        buffers: &Buffers<'_>,
        find_file: FindFile<'_>,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        let mut is_used = vec![false; root.images().len()];
        for texture in root.textures() {
            let source = texture.source.and_then(|source| usize::try_from(source.0).ok());
            if let Some(used) = source.and_then(|source| is_used.get_mut(source)) {
                *used = true;
            }
        }
        let mut views = HashMap::new();
        let found: Vec<Found> = (0..root.images().len())
            .map(|index| match find(root, buffers, index, &mut views, diagnostics) {
                _ if !is_used[index] => Found::None,
                Found::Beside(path, _) => Found::Beside(path.clone(), find_file(&path)),
                found => found,
            })
            .collect();
        let wished = found.iter().map(|found| match found {
            Found::Inside { extension, stem, .. } => format!("{stem}.{extension}"),
            // They are found by their base names, which no picture inside the file should have.
            Found::Beside(path, _) => path.rsplit('/').next().unwrap_or(path).to_owned(),
            Found::Same(_) | Found::None => String::new(),
        });
        let stems: Vec<String> = wished.map(|name| stem(&name).to_lowercase()).collect();
        let unique = unique_names(stems.iter().map(String::as_str), "image", |_, _| ());
        let mut images = Self {
            names: Vec::with_capacity(found.len()),
            pictures: Vec::new(),
        };
        for ((found, wish), unique) in found.into_iter().zip(&stems).zip(unique) {
            let name = match found {
                Found::Beside(path, bytes) => {
                    images.pictures.extend(bytes.map(|bytes| Picture {
                        name: path.clone(),
                        bytes,
                    }));
                    Some(path)
                }
                Found::Same(other) => images.names.get(other).cloned().flatten(),
                Found::None => None,
                Found::Inside { bytes, extension, stem } => {
                    // What makes it unique follows the name as it is spelt.
                    let number = unique.strip_prefix(wish.as_str()).unwrap_or_default();
                    let name = format!("{stem}{number}.{extension}");
                    images.pictures.push(Picture {
                        name: name.clone(),
                        bytes: bytes.into(),
                    });
                    Some(name)
                }
            };
            images.names.push(name);
        }
        images
    }
}

fn find(
    root: &Root,
    buffers: &Buffers<'_>,
    index: usize,
    views: &mut HashMap<u64, usize>,
    diagnostics: &mut Diagnostics,
) -> Found {
    let image = &root.images()[index];
    let pointer = format!("/images/{index}");
    let not_read = |diagnostics: &mut Diagnostics, key: &str, why: String| {
        let place = Place::pointer(format!("{pointer}{key}"));
        let message = format!("Image {index} is not read: {why}.");
        diagnostics.add(&codes::GLTF_IMAGE_NOT_READ, place, message);
        Found::None
    };
    // What a data URI says that it is.
    let mut kind = "image/png";
    let (bytes, key) = match (&image.uri, image.buffer_view) {
        (None, None) => return not_read(diagnostics, "", "it has neither an address nor data".to_owned()),
        (Some(uri), _) => match Uri::parse(uri) {
            Ok(Uri::Path(path)) => return Found::Beside(path, None),
            Ok(Uri::Data { media_type, bytes }) => {
                kind = media_type;
                (bytes, "/uri")
            }
            Err(error) => return not_read(diagnostics, "/uri", error.to_string()),
        },
        (None, Some(view)) => {
            if let Some(&other) = views.get(&view.0) {
                return Found::Same(other);
            }
            views.insert(view.0, index);
            match buffers.view(view, format_args!("{pointer}/bufferView")) {
                Ok((bytes, _)) => (bytes.to_vec(), "/bufferView"),
                Err(fault) => {
                    return not_read(
                        diagnostics,
                        "/bufferView",
                        fault.message.trim_end_matches('.').to_owned(),
                    );
                }
            }
        }
    };
    let extension = extension_of(&bytes);
    if extension.is_some() && !["image/png", "image/jpeg"].contains(&kind) {
        let message = format!("\"{kind}\" is no kind of picture that glTF has; it is read by its bytes.");
        diagnostics.add(
            &codes::GLTF_RULE_BROKEN,
            Place::pointer(format!("{pointer}/uri")),
            message,
        );
    }
    let Some(extension) = extension else {
        return not_read(diagnostics, key, "it is neither PNG nor JPEG".to_owned());
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
    kind.map(|(_, extension)| extension)
}

/// A name without the extension of a picture.
fn stem(name: &str) -> &str {
    match name.rsplit_once('.') {
        Some((stem, extension))
            if ["png", "jpg", "jpeg", "dds", "bmp", "tga"].contains(&extension.to_ascii_lowercase().as_str()) =>
        {
            stem
        }
        _ => name,
    }
}
