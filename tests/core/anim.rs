//! Tests of `anim`.

mod activity;
mod blend;
mod bounds;
mod curve;
mod drift;
mod files;
mod keys;
mod palette;
mod playback;
mod pose;
mod random;
mod range;
mod sample;
mod seam;
mod skin;
