//! Tests of the core: they need neither GPU nor UI.

mod actions;
mod anim;
#[path = "../common/binary_fbx.rs"]
mod binary_fbx;
mod book;
mod chains;
mod check;
mod codes;
mod documents;
mod edit;
mod export;
mod fbx;
mod format;
mod gestures;
mod gltf;
#[path = "../common/gltf.rs"]
mod gltf_files;
mod image;
mod light;
mod model;
mod order;
mod properties;
#[path = "../common/radiance.rs"]
mod radiance;
mod rigs;
mod scene;
mod script;
mod session;
mod shaders;
#[path = "../common/shared.rs"]
mod shared;
mod sorting;
mod textbook;
#[path = "../common/twins/mod.rs"]
mod twins;
