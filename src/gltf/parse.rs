//! From JSON text to the document, or to what is wrong with it.

use super::places::{offset_of, pointer_at};
use super::{Container, Fault, Root, fault};
use crate::diagnostic::{Diagnostic, Position, codes};

const KNOWN: [&str; 10] = [
    "EXT_texture_webp",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// Reads the JSON of a file.
///
/// # Errors
/// When it is no JSON, or a value is of another kind than glTF gives it.
pub fn parse(container: &Container<'_>) -> Result<Root, Fault> {
    // Always from bytes: were text read by `from_str` too, the program would hold the readers of all these types twice.
    serde_json::from_slice(container.json).map_err(|error: serde_json::Error| {
        if !error.is_data() {
            let message = format!("The JSON cannot be read: {}.", words(&error));
            return Box::new(placed(codes::GLTF_NOT_JSON.says(message), &error, container));
        }
        // A column counts the bytes of its line that were read.
        let offset = line_start(&error, container) + error.column();
        let pointer = pointer_at(container.json, offset);
        let words = words(&error);
        let value = ["invalid type: ", "invalid value: "].map(|start| words.strip_prefix(start));
        let says = |message: String| codes::GLTF_WRONG_TYPE.says(message).pointing_at(&*pointer);
        let diagnostic = match (value, words.strip_prefix("duplicate field ")) {
            ([Some(value), _] | [_, Some(value)], _) => says(format!("Found {value}.")),
            // Its pointer is that of the object.
            (_, Some(key)) => return Box::new(placed(says(format!("The key {key} stands twice.")), &error, container)),
            _ => says(format!("The JSON lacks what glTF needs here: {words}.")),
        };
        // serde tells of a value when it has read it: the mark belongs at its beginning. In a text its pointer says where that is.
        let offset = offset_of(container.json, &pointer).filter(|_| container.is_binary);
        Box::new(Diagnostic {
            byte_offset: offset.map(|offset| (container.json_offset + offset) as u64),
            ..diagnostic
        })
    })
}

/// Whether the document is of a version and asks for extensions that are read here.
///
/// # Errors
/// When it is not, or does not.
pub fn check_asset(root: &Root, diagnostics: &mut Vec<Diagnostic>) -> Result<(), Fault> {
    let Some(asset) = &root.asset else {
        let message = "The JSON does not say that it is a glTF asset: there is no \"asset\".";
        return Err(fault(&codes::GLTF_WRONG_TYPE, "", message));
    };
    let least = asset.min_version.as_deref();
    if !asset.version.starts_with("2.") || least.is_some_and(|least| least != "2.0") {
        let (key, asked) = match least {
            Some(least) if asset.version.starts_with("2.") => ("minVersion", least),
            _ => ("version", asset.version.as_str()),
        };
        let message = format!("The file is of glTF {asked}; glTF 2.0 is read.");
        return Err(fault(&codes::GLTF_VERSION, format!("/asset/{key}"), message));
    }
    for (index, name) in root.extensions_required.iter().flatten().enumerate() {
        if !KNOWN.contains(&name.as_str()) {
            let message = format!(
                "The model needs the extension {name}, which is not read here{}.",
                remedy(name)
            );
            return Err(fault(
                &codes::GLTF_EXTENSION_REQUIRED,
                format!("/extensionsRequired/{index}"),
                message,
            ));
        }
    }
    let unknown = root
        .extensions_used
        .iter()
        .flatten()
        .filter(|name| !KNOWN.contains(&name.as_str()));
    let names: Vec<&str> = unknown.map(String::as_str).collect();
    if !names.is_empty() {
        let extensions = if names.len() == 1 {
            "The extension"
        } else {
            "The extensions"
        };
        let are = if names.len() == 1 { "is" } else { "are" };
        let message = format!(
            "{extensions} {} {are} not read; the model is shown without.",
            names.join(", ")
        );
        diagnostics.push(Diagnostic {
            count: u32::try_from(names.len()).unwrap_or(u32::MAX),
            ..codes::GLTF_EXTENSION_UNKNOWN
                .says(message)
                .pointing_at("/extensionsUsed")
        });
    }
    Ok(())
}

/// What a person can do about an extension that many files need. gltf-transform is <https://gltf-transform.dev/cli>.
fn remedy(name: &str) -> &'static str {
    match name {
        "KHR_draco_mesh_compression" | "EXT_meshopt_compression" => {
            ": export it without compression, or unpack it with `gltf-transform copy IN.glb OUT.glb`"
        }
        "KHR_meshopt_compression" => ": export it without compression",
        "KHR_texture_basisu" => {
            ": export its textures as PNG or JPEG, or unpack them with `gltf-transform ktxdecompress IN.glb OUT.glb`"
        }
        "EXT_texture_avif" => {
            ": export its textures as PNG or JPEG, or unpack them with `gltf-transform png IN.glb OUT.glb`"
        }
        _ => "",
    }
}

/// The place of an error: line and column of a text, the offset in a binary file.
fn placed(diagnostic: Diagnostic, error: &serde_json::Error, container: &Container<'_>) -> Diagnostic {
    if error.line() == 0 {
        return diagnostic;
    }
    if container.is_binary {
        let offset = container.json_offset + line_start(error, container) + error.column().saturating_sub(1);
        return Diagnostic {
            byte_offset: Some(offset as u64),
            ..diagnostic
        };
    }
    let number = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
    let mark = if error.line() == 1 { container.json_offset } else { 0 };
    let position = Position {
        line: number(error.line()),
        column: number(error.column().max(1) + mark),
    };
    Diagnostic {
        position: Some(position),
        places: vec![position],
        ..diagnostic
    }
}

/// Where the line of an error begins in the JSON.
fn line_start(error: &serde_json::Error, container: &Container<'_>) -> usize {
    let ends = memchr::memchr_iter(b'\n', container.json);
    let starts = std::iter::once(0).chain(ends.map(|end| end + 1));
    starts.take(error.line()).last().unwrap_or_default()
}

/// serde's words without the place, which is told apart.
fn words(error: &serde_json::Error) -> String {
    let words = error.to_string();
    words.split(" at line ").next().unwrap_or(&words).to_owned()
}
