//! Parts that tests look at one by one.

pub use super::input::first_pass;
pub use super::keys::{action_of, shortcut};
pub use super::timeline::axis::{END_ROOM, SeenTime, TimeAxis};
pub use super::timeline::loop_gap::{distance_told, precision};
pub use super::timeline::marks::{MERGE_POINTS, MOST_RADIUS, Mark, marks};
pub use super::timeline::time_area::{label_step, seconds};
pub use crate::ui::kit::color::{from_hex, hex, hsv_from_srgb, srgb_from_hsv};
pub use crate::ui::kit::wording::{bytes, grouped, measured, milliseconds};
pub use crate::ui::panels::findings::goal::Goal;
pub use crate::ui::panels::skeleton::numbers::{Digits, fitted};
pub use crate::ui::panels::thumbnails::{rebuilt_z, small_picture};
pub use crate::ui::rim::mirror::aria::{Branch, settle as settle_roles};
pub use crate::ui::timeline::curves::value_axis::{ValueAxis, round_up};
pub use crate::ui::timeline::sheet::rows::{FoldedBranch, FoldedBranches, RowKeys, sort_by_motion};
pub use crate::ui::timeline::strip::typed::{Unit, number_and_unit, speed, time};
pub use crate::ui::window::drawer::{Heights, Rest, settle as settle_drawer};
