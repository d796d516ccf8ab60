//! Models as files.

mod glb;
mod m3d;
mod others;
