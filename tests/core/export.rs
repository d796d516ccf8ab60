//! Models as files.

mod both_ways;
mod codes;
mod glb;
mod keys;
mod m3d;
mod others;
