//! What needs a GPU. Everything runs on Vulkan and on GL; a software adapter is enough, and without any the tests fail and say
//! what to install.

/// Makes a module for each test, with one test for each backend in it.
macro_rules! on_both_backends {
    ($($(#[doc = $doc:literal])* fn $name:ident($gpu:ident) $body:block)*) => {
        $(
            mod $name {
                use super::*;

                fn on($gpu: &crate::gpu::Gpu) $body

                #[test]
                fn vulkan() {
                    on(crate::gpu::vulkan());
                }

                #[test]
                fn gl() {
                    on(crate::gpu::gl());
                }
            }
        )*
    };
}

mod alpha_clip;
mod at_rest;
mod big_picture;
mod book_light;
mod chart;
mod contact_sheet;
mod crowd;
mod cut_out;
mod exported;
#[path = "../common/gltf.rs"]
mod gltf_files;
mod gltf_materials;
mod golden;
mod gpu;
mod kept_maps;
mod lamp;
mod layers;
mod light;
mod lines;
mod looks;
mod map_uploads;
mod maps;
mod normal_maps;
mod painter;
mod parts;
mod passes;
mod performance;
mod picture;
mod prepared;
mod robust;
mod scenes;
mod seen_through;
mod sets;
mod shadows;
#[path = "../common/shared.rs"]
mod shared;
mod sides;
mod skinning;
mod sky;
mod still_life;
mod studio_light;
mod submeshes;
mod textures;
mod timing;
#[path = "../common/twins/mod.rs"]
mod twins;
mod view_modes;
