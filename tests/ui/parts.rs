//! Parts of the interface that are rules of their own, without a window.

mod aria;
mod axis;
mod color;
mod drawer;
mod goal;
mod input;
mod keys;
mod loop_gap;
mod marks;
mod numbers;
mod rows;
mod theme;
mod thumbnails;
mod time_area;
mod typed;
mod value_axis;
mod wording;
