//! Tests of `anim`.

mod activity;
mod bind_weight;
mod blend;
mod bounds;
mod curve;
mod drift;
mod explain;
mod files;
mod inspect;
mod keys;
mod palette;
mod playback;
mod pose;
mod random;
mod range;
mod sample;
mod seam;
mod skin;
mod skin_view;
mod trails;
