//! The skeleton and the skin: tree, numbers, marks in the view.

mod in_view;
mod joint_panel;
mod naming;
pub(in crate::ui) mod numbers;
pub(in crate::ui) mod state;
mod tree;
mod vertex_panel;
mod width;

pub(in crate::ui) use in_view::{LegendShape, STRIP_MARGIN, colored_view, show_legend, show_marks};
pub(in crate::ui) use joint_panel::show as show_inspector;
pub(in crate::ui) use tree::show as show_tree;
pub(in crate::ui) use width::{show_handle as show_width_handle, side_width};
