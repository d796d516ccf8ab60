//! The panel at the bottom: transport and bar, and above them, when it is open, the dope sheet or curves of a joint.

mod axis;
mod bar;
mod clips;
mod controls;
mod curve_keys;
mod curve_plot;
mod curves;
mod dope_sheet;
mod joint_row;
mod key_cursor;
mod loop_gap;
mod marks;
mod options;
mod rows;
mod sheet;
pub(super) mod state;
mod time_area;
mod transport;
mod typed;
mod value_axis;

pub(super) use sheet::page;
pub(super) use transport::{narrow, wide};
