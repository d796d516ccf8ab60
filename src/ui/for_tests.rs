//! Parts that tests look at one by one.

pub use super::findings::goal::Goal;
pub use super::input::first_pass;
pub use super::keys::{action_of, shortcut};
pub use super::mirror::aria::{Branch, settle as settle_roles};
pub use super::sheet::{Heights, Rest, settle as settle_sheet};
pub use super::skeleton::numbers::{Digits, fitted};
pub use super::thumbnails::{rebuilt_z, small_picture};
pub use super::timeline::axis::{END_ROOM, TimeAxis, TimeWindow};
pub use super::timeline::loop_gap::{distance_told, precision};
pub use super::timeline::marks::{MERGE_POINTS, MOST_RADIUS, Mark, marks};
pub use super::timeline::rows::{FoldedBranch, FoldedBranches, RowKeys, sort_by_motion};
pub use super::timeline::time_area::{label_step, seconds};
pub use super::timeline::typed::{Unit, number_and_unit, speed, time};
pub use super::timeline::value_axis::{ValueAxis, round_up};
pub use super::viewport::DragTrail;
pub use super::widgets::color::{from_hex, hex, hsv_from_srgb, srgb_from_hsv};
pub use super::wording::{bytes, grouped, measured, milliseconds};
