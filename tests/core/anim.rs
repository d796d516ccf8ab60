//! Tests of `anim`.

mod activity;
mod bind_weight;
mod blend;
mod bounds;
mod crowd;
mod curve;
mod drift;
mod explain;
mod files;
mod inspect;
mod keys;
mod loop_gap;
mod palette;
mod playback;
mod pose;
mod random;
mod range;
mod sample;
mod skin;
mod skin_view;
mod straight;
mod trails;
