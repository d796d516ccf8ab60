//! The panel at the bottom: transport and bar, and above them, when it is open, the dope sheet or curves of a joint.

pub(super) mod axis;
mod bar;
mod clips;
mod controls;
mod curve_keys;
mod curve_plot;
mod curves;
mod dope_sheet;
mod joint_row;
mod key_cursor;
pub(super) mod loop_gap;
pub(super) mod marks;
mod options;
pub(super) mod rows;
mod sheet;
pub(super) mod state;
pub(super) mod time_area;
mod transport;
pub(super) mod typed;
pub(super) mod value_axis;

pub(super) use sheet::page;
pub(super) use transport::{narrow, wide};
