//! What the panels leave free of the window: there the model is framed, and beside it stands the legend of the skin's colours.

use egui::{Pos2, Rect, Ui, pos2};

use super::layout::{SIDE_WIDTH, bar_height};
use super::panel::shown_rect;
use super::skeleton::{self, LegendShape};
use super::state::UiState;
use super::theme::MARGIN;
use super::timeline;
use crate::scene::Insets;
use crate::session::Session;

/// In a narrow window a figure in the middle reaches about so far to either side.
const FIGURE_REACH: f32 = 80.0;
/// The least height in which a legend leaves something to see: of the panel above a card, of the model above a strip.
const LEAST_WITH_CARD: f32 = 220.0;
const LEAST_WITH_STRIP: f32 = 180.0;

/// Shares of the window that are covered.
pub(super) fn insets(ui: &Ui, session: &Session, state: &UiState, window: Rect, narrow: bool) -> Insets {
    let top = (bar_height(ui) + MARGIN) / window.height();
    let strip = match legend_place(ui, session, state, window, narrow) {
        Some((_, LegendShape::Strip { .. })) => skeleton::STRIP_HEIGHT + MARGIN,
        Some((_, LegendShape::Card)) | None => 0.0,
    };
    let bottom = (covered_below(ui, session, state, window, narrow) + strip) / window.height();
    let left = if narrow {
        0.0
    } else {
        (MARGIN * 2.0 + SIDE_WIDTH) / window.width()
    };
    Insets {
        left,
        top: top.clamp(0.0, 0.3),
        bottom: bottom.clamp(0.0, 0.75),
        ..Insets::default()
    }
}

/// Where the lower left corner of the legend is, and its shape. A card stands below the panel on the left, and in a narrow
/// window beside a figure; where there is no room for it a strip stands below the model. None where neither has room, or
/// there is nothing to say.
pub(super) fn legend_place(
    ui: &Ui,
    session: &Session,
    state: &UiState,
    window: Rect,
    narrow: bool,
) -> Option<(Pos2, LegendShape)> {
    if !skeleton::has_legend(session) {
        return None;
    }
    let left = window.min.x + MARGIN;
    let bottom = match shown_rect(ui, "sheet").filter(|_| narrow) {
        Some(sheet) => sheet.min.y - MARGIN,
        None => window.max.y - covered_below(ui, session, state, window, narrow).max(MARGIN),
    };
    let room = bottom - (window.min.y + 2.0 * MARGIN + bar_height(ui));
    let (shape, least) = if !narrow {
        (LegendShape::Card, LEAST_WITH_CARD)
    } else if left + SIDE_WIDTH + FIGURE_REACH <= window.center().x {
        (LegendShape::Card, skeleton::CARD_HEIGHT)
    } else {
        let width = window.width() - 2.0 * MARGIN;
        (LegendShape::Strip { width }, LEAST_WITH_STRIP)
    };
    (room >= least).then_some((pos2(left, bottom), shape))
}

/// Room that the legend takes from the panel on the left, with the margin between them.
pub(super) fn covered_by_card(ui: &Ui, session: &Session, state: &UiState, window: Rect) -> f32 {
    let shown = legend_place(ui, session, state, window, false);
    shown.map_or(0.0, |_| {
        shown_rect(ui, "legend").map_or(skeleton::CARD_HEIGHT, |card| card.height()) + MARGIN
    })
}

/// Room that timeline and sheet take from the window's lower edge, with a margin.
fn covered_below(ui: &Ui, session: &Session, state: &UiState, window: Rect, narrow: bool) -> f32 {
    let timeline = timeline::covered_height(ui, session, &state.timeline, narrow);
    // As it was shown last: the contents of its page say how high it is.
    let sheet = shown_rect(ui, "sheet").filter(|_| narrow && state.sheet.is_some());
    timeline.max(sheet.map_or(0.0, |sheet| window.max.y - sheet.min.y + MARGIN))
}
