//! The panel at the bottom: transport and bar, and above them, when it is open, the dope sheet or curves of a joint.

pub(super) mod axis;
pub(super) mod curves;
pub(super) mod loop_gap;
pub(super) mod marks;
pub(super) mod sheet;
pub(super) mod state;
pub(super) mod strip;
pub(super) mod time_area;

pub(super) use sheet::page;
pub(super) use strip::transport::{narrow, wide};
