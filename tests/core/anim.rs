//! Tests of `anim`.

mod bind_share;
mod bounds;
mod explain;
mod files;
mod inspect;
mod palette;
mod playback;
mod pose;
mod random;
mod sample;
mod skin;
mod skin_view;
mod trails;
