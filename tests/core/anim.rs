//! Tests of `anim`.

mod bounds;
mod files;
mod palette;
mod playback;
mod pose;
mod random;
mod sample;
mod skin;
