//! Models as files.

mod both_ways;
mod glb;
mod m3d;
mod others;
