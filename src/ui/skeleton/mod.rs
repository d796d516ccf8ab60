//! The skeleton and the skin: tree, numbers, marks in the view.

mod in_view;
mod joint_panel;
mod naming;
pub(super) mod numbers;
pub(super) mod state;
mod tree;
mod vertex_panel;
mod walk;
mod width;

pub(super) use in_view::{LegendShape, STRIP_MARGIN, colored_view, show_legend, show_marks};
pub(super) use joint_panel::show as show_inspector;
pub(super) use tree::show as show_tree;
pub(super) use width::{show_handle as show_width_handle, side_width};
