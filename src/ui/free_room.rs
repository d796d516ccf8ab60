//! What the panels leave free of the window: there the model is framed, and beside it stands the legend of the skin's colours.

use egui::{Pos2, Rect, Ui, pos2};

use super::panel::{Arrangement, INSPECTOR_WIDTH, SIDE_WIDTH, bar_height, shown_rect, strip_height};
use super::skeleton::state::is_inspected;
use super::skeleton::{self, LegendShape};
use super::state::{SheetPage, UiState};
use super::theme::MARGIN;
use super::timeline;
use super::widgets::SHEET_HANDLE_HEIGHT;
use crate::scene::Insets;
use crate::session::Session;

/// Fraction of a low window's width that a page beside the model has, and one with keys over time; and the greatest width.
const BESIDE_FRACTION: f32 = 0.44;
const TIMELINE_BESIDE_FRACTION: f32 = 0.62;
const MOST_BESIDE: f32 = 560.0;
/// Margin in the sheet, but for its upper edge.
pub(super) const SHEET_MARGIN: i8 = 14;
/// In a narrow window a figure in the middle reaches about so far to either side.
const FIGURE_REACH: f32 = 80.0;
/// The least width beside the findings in which something of a model is seen.
const LEAST_BESIDE_FINDINGS: f32 = 200.0;
/// The least height in which a legend leaves something to see: of the panel above a card, of the model above a strip.
const LEAST_WITH_CARD: f32 = 220.0;
const LEAST_WITH_STRIP: f32 = 180.0;

/// Fractions of the window that are covered.
pub(super) fn insets(ui: &Ui, session: &Session, state: &UiState, window: Rect, arrangement: Arrangement) -> Insets {
    let top = (bar_height(ui) + MARGIN) / window.height();
    let strip = match legend_place(ui, session, state, window, arrangement) {
        Some((_, LegendShape::Strip { .. })) => skeleton::STRIP_HEIGHT + MARGIN,
        Some((_, LegendShape::Card)) | None => 0.0,
    };
    let bottom = (covered_below(ui, session, state, window, arrangement) + strip) / window.height();
    let left = match arrangement {
        Arrangement::Wide => (free_left(window, arrangement) - window.min.x) / window.width(),
        Arrangement::Narrow | Arrangement::Low => 0.0,
    };
    let right = covered_beside(state, window, arrangement) / window.width();
    let (left, right) = beside_findings(ui, session, state, window, arrangement).unwrap_or((left, right));
    Insets {
        left,
        right,
        top: top.clamp(0.0, 0.3),
        bottom: bottom.clamp(0.0, 0.75),
    }
}

/// What the list of findings leaves of a wide window, with an inspector at its right: a finding is clicked to see what it is
/// about. Where that is next to nothing the list covers the model as ever.
fn beside_findings(
    ui: &Ui,
    session: &Session,
    state: &UiState,
    window: Rect,
    arrangement: Arrangement,
) -> Option<(f32, f32)> {
    let open = state.diagnostics_open && arrangement == Arrangement::Wide;
    let list = shown_rect(ui, "diagnostics").filter(|_| open)?;
    let inspects = session.subsets().selected().is_some() || is_inspected(session);
    let inspector = if inspects { INSPECTOR_WIDTH + 2.0 * MARGIN } else { 0.0 };
    let left = list.max.x + MARGIN - window.min.x;
    let free = window.width() - left - inspector;
    (free >= LEAST_BESIDE_FINDINGS).then_some((left / window.width(), inspector / window.width()))
}

/// Where the panel on the left ends, with a margin.
pub(super) fn free_left(window: Rect, arrangement: Arrangement) -> f32 {
    let side = match arrangement {
        Arrangement::Wide => SIDE_WIDTH + MARGIN,
        Arrangement::Narrow | Arrangement::Low => 0.0,
    };
    window.min.x + MARGIN + side
}

/// Where the lower left corner of the legend is, and its shape. A card stands below the panel on the left, and in a narrow
/// window beside a figure; where there is no room for it a strip stands below the model. None where neither has room, or
/// there is nothing to say.
pub(super) fn legend_place(
    ui: &Ui,
    session: &Session,
    state: &UiState,
    window: Rect,
    arrangement: Arrangement,
) -> Option<(Pos2, LegendShape)> {
    if !skeleton::has_legend(session) {
        return None;
    }
    let left = window.min.x + MARGIN;
    let bottom = match shown_rect(ui, "sheet").filter(|_| arrangement != Arrangement::Wide) {
        Some(sheet) => sheet.min.y - MARGIN,
        None => window.max.y - covered_below(ui, session, state, window, arrangement).max(MARGIN),
    };
    let room = bottom - (window.min.y + 2.0 * MARGIN + bar_height(ui));
    let free = window.with_max_x(window.max.x - covered_beside(state, window, arrangement));
    let (shape, least) = if arrangement == Arrangement::Wide {
        (LegendShape::Card, LEAST_WITH_CARD)
    } else if left + SIDE_WIDTH + FIGURE_REACH <= free.center().x {
        (LegendShape::Card, skeleton::CARD_HEIGHT)
    } else {
        let width = free.width() - 2.0 * MARGIN;
        (LegendShape::Strip { width }, LEAST_WITH_STRIP)
    };
    (room >= least).then_some((pos2(left, bottom), shape))
}

/// Room that the legend takes from the panel on the left, with the margin between them.
pub(super) fn covered_by_card(ui: &Ui, session: &Session, state: &UiState, window: Rect) -> f32 {
    let shown = legend_place(ui, session, state, window, Arrangement::Wide);
    shown.map_or(0.0, |_| {
        shown_rect(ui, "legend").map_or(skeleton::CARD_HEIGHT, |card| card.height()) + MARGIN
    })
}

/// Room that timeline and sheet take from the window's lower edge, with a margin.
fn covered_below(ui: &Ui, session: &Session, state: &UiState, window: Rect, arrangement: Arrangement) -> f32 {
    let timeline = covered_by_timeline(ui, session, state, arrangement);
    // As it was shown last: the contents of its page say how high it is.
    let sheet = shown_rect(ui, "sheet").filter(|_| arrangement != Arrangement::Wide && state.sheet.is_some());
    timeline.max(sheet.map_or(0.0, |sheet| window.max.y - sheet.min.y + MARGIN))
}

/// Room that the timeline alone takes from the window's lower edge, with a margin.
pub(super) fn covered_by_timeline(ui: &Ui, session: &Session, state: &UiState, arrangement: Arrangement) -> f32 {
    match arrangement {
        Arrangement::Wide => timeline::covered_height(ui, session, &state.timeline),
        Arrangement::Narrow | Arrangement::Low => shut_sheet_height(ui, session, arrangement) + MARGIN,
    }
}

/// Room that a page beside the model takes from the window's right side, with its margins.
fn covered_beside(state: &UiState, window: Rect, arrangement: Arrangement) -> f32 {
    let page = state.sheet.filter(|_| arrangement == Arrangement::Low);
    page.map_or(0.0, |page| page_width(page, window) + 2.0 * MARGIN)
}

/// Height of the sheet while nothing is open in it, with its border.
pub(super) fn shut_sheet_height(ui: &Ui, session: &Session, arrangement: Arrangement) -> f32 {
    let strip = session.clip().map_or(0.0, |_| strip_height(ui, arrangement));
    SHEET_HANDLE_HEIGHT + strip + f32::from(SHEET_MARGIN) + 2.0
}

/// Width of a page beside the model.
pub(super) fn page_width(page: SheetPage, window: Rect) -> f32 {
    let fraction = if page == SheetPage::Timeline {
        TIMELINE_BESIDE_FRACTION
    } else {
        BESIDE_FRACTION
    };
    (fraction * window.width()).min(MOST_BESIDE)
}
