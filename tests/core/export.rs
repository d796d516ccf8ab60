//! Models as files.

mod codes;
mod glb;
mod m3d;
mod others;
