//! The Khronos validator's own test files: what it calls an error is refused, or mended with a finding.

use std::fs;

use bindpose::diagnostic::Severity;
use bindpose::import::import_beside;

use crate::shared::shared;

/// Files in which the validator of 2.0.0-dev.3.10 finds no error, or only one of something that is not read here.
const SOUND: [&str; 5] = [
    "accessor-custom_property.gltf accessor_data-get_elements.gltf animation-custom_property.gltf \
     animation-valid.gltf asset-valid.gltf buffer-custom_property.gltf buffer_view-valid.gltf glb-extra_data.glb \
     glb-valid.glb image-custom_property.gltf image-data_uri.glb image-invalid_image_data.gltf image-not_found.gltf \
     image-png_eos.gltf image-valid.gltf material-alpha_modes.gltf material-multiple_extensions.gltf \
     material-valid.gltf mesh-invalid_tangent.gltf mesh-primitive_no_position.gltf mesh-valid.gltf \
     node-custom_property.gltf node-node_empty.gltf node-node_skinned_mesh_without_skin.gltf \
     node-node_weights_override.gltf root-extras_non_object.gltf sampler-custom_property.gltf sampler-valid.gltf \
     scene-custom_property.gltf scene-valid.gltf skin-custom_property.gltf skin-ignored_local_transform.gltf \
     skin-ignored_parent_transform.gltf texture-empty_object.gltf texture-valid.gltf",
    // Cameras are counted and not read.
    "camera-empty_objects.gltf camera-extra_type.gltf camera-infinite_znear.gltf camera-perspective_z.gltf",
    // Nor are lists of nothing, extensions that are not known, and pictures that no texture uses.
    "buffer_view-empty_array.gltf material-empty_array.gltf node-empty_array.gltf texture-empty_array.gltf \
     scene-empty_array.gltf node-empty_children_array.gltf image-invalid_data_uri_mime_type.gltf \
     root-extensions_non_objects.gltf accessor-empty_array.gltf animation-empty_array.gltf buffer-empty_array.gltf",
    // What is wrong with these changes nothing that one sees: numbers of morph targets, steps and offsets that nothing reads,
    // a camera and the root of a skin that are not there.
    "accessor-byteoffset_no_bufferview.gltf accessor-float_normalized.gltf buffer_view-invalid_stride_multiple.gltf \
     buffer_view-invalid_stride_too_big.gltf image-empty_object.gltf image-invalid_data_uri.gltf \
     mesh-morph_weights_wrong_count.gltf node-node_weights_invalid.gltf node-unresolved_camera.gltf \
     skin-unresolved_skeleton.gltf",
    // Their buffer is not there, which is told.
    "accessor_data-out_of_range_elements_float.gltf accessor_data-out_of_range_elements_sint16.gltf \
     accessor_data-out_of_range_elements_uint32.gltf accessor_data-out_of_range_elements_uint8.gltf \
     buffer-not_found.gltf buffer-non_relative_uri.gltf mesh_data-index_buffer_degenerate_triangle.gltf \
     mesh_data-index_buffer_primitive_restart.gltf",
];

#[test]
fn what_the_validator_calls_an_error_is_refused_or_told() {
    let Some(folder) = shared("gltf/validator") else { return };
    let mut wrong = Vec::new();
    let mut count = 0;
    for entry in fs::read_dir(&folder).expect("it can be listed") {
        let path = entry.expect("it can be listed").path();
        let name = path.file_name().expect("a file").to_string_lossy().into_owned();
        let bytes = fs::read(&path).expect("it can be read");
        let find = |beside: &str| fs::read(folder.join(beside)).ok().map(Into::into);
        let found = import_beside(&bytes, &find);
        let told = match &found {
            Err(refused) => vec![refused.error.code],
            Ok(imported) => {
                let worth = imported
                    .diagnostics
                    .iter()
                    .filter(|finding| finding.severity >= Severity::Warning);
                worth
                    .map(|finding| finding.code)
                    .filter(|&code| code != "gltf-empty")
                    .collect()
            }
        };
        let rules = ["gltf-rule-broken", "glb-damaged", "gltf-wrong-type"];
        let is_as_expected = if SOUND.iter().any(|names| names.split(' ').any(|sound| sound == name)) {
            !told.iter().any(|code| rules.contains(code))
        } else {
            !told.is_empty()
        };
        if !is_as_expected {
            wrong.push(format!("{name}: {told:?}"));
        }
        count += 1;
    }
    assert!(count > 100, "{count} files");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
