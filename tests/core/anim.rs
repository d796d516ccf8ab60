//! Tests of `anim`.

mod bounds;
mod palette;
mod playback;
mod random;
mod sample;
mod skin;
