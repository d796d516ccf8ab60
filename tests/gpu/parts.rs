//! Parts of the renderer that need no GPU.

mod blending;
mod instances;
mod light_fit;
mod maps;
mod read_back;
mod samples;
mod timing;
mod triangles;
mod uniforms;
