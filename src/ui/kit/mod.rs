//! The controls that panels are made of.

mod button;
pub(super) mod color;
mod control;
mod heading;
pub(super) mod icons;
mod kept;
mod keys;
mod list;
mod named;
mod number;
mod row;
mod search;
mod slider;
pub mod theme;
pub(super) mod wording;

pub(super) use button::{
    ICON_SIZE, MenuLine, TextButton, action_button, action_switch, bare_icon_button, choices, choose,
    explained_segmented, icon_button, keyed_menu_item, menu_item, noted_switch_row, push_action, push_button,
    segmented, switch_row, valued_choice, valued_menu_item,
};
pub(super) use color::{color_button, color_picker, gradient_shape, paint_swatch};
pub(super) use control::{
    by_finger, chip, chip_size, control_size, elided_name, explained, focus_ring, hint_beside, hint_of_name, in_force,
    is_touch, paint_chip, paint_elided, paint_focus_ring, paint_fold_mark, paint_list_ground, paint_name,
    paint_row_ground, pressed_chip, pressed_row_height, size_for_touch, tell_node, tell_open, tell_popup, tell_push,
};
pub(super) use heading::{
    closable_heading, explained_section, heading_with_close, keyed_section_name, section_name, section_with_action,
    section_with_labelled_action, selected_heading,
};
pub(super) use kept::Kept;
pub(super) use keys::{SliderNode, arrow_steps, focused_keys, retain_plain_keys, slider_keys, walked};
pub(super) use list::{DrawnRows, RowList, focus_row, labelled, row_sense, rows_in_view, tell_folds, tell_row};
pub(super) use named::{Label, named};
pub(super) use number::{TypedValue, leading_number, number_field, number_within, select_all};
pub(super) use row::{Row, choice_row, drawer_handle, progress_bar, row_icon, rule, value_row};
pub(super) use search::search_field;
pub(super) use slider::Slider;
