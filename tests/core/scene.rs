//! Tests of `scene`: bones and colours as plain data.

mod bones;
mod skin_colors;
