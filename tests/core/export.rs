//! Models as files.

mod both_ways;
mod codes;
mod glb;
mod growth;
mod keys;
mod looks;
mod m3d;
mod others;
