//! Pages: what the panel on the left of a wide window shows, and what is opened in a narrow one.

use egui::{Id, Rect, RichText, Ui, vec2};

use super::panel::scrolled;
use super::{focus, toolbar};
use crate::actions::Control;
use crate::session::Session;
use crate::ui::cx::Cx;
use crate::ui::kit::icons::Icon;
use crate::ui::kit::theme::Tokens;
use crate::ui::panels::skeleton::state::{SidePage, has_joints, is_inspected};
use crate::ui::panels::{export, findings, light, model_panel, overlays, picture, skeleton, submesh_panel};
use crate::ui::state::{DrawerPage, UiState};
use crate::ui::{kit, timeline};

/// Fraction of a low window's width that a page beside the model has, and one with keys over time; and the greatest width.
const BESIDE_FRACTION: f32 = 0.44;
const TIMELINE_BESIDE_FRACTION: f32 = 0.62;
const MOST_BESIDE: f32 = 560.0;

/// What the panel on the left shows.
pub(super) fn side_label(state: &UiState) -> &'static str {
    match state.skeleton.page {
        SidePage::Model => "Model",
        SidePage::Skeleton => "Skeleton",
    }
}

/// Facts or the tree of joints below the switch between them; each scrolls by itself.
pub(super) fn side_panel(ui: &mut Ui, id: &'static str, cx: &mut Cx<'_, UiState>) {
    if has_joints(cx.session) {
        show_tabs(ui, cx.session, cx.state, false);
        ui.add_space(8.0);
    }
    side_page(ui, id, cx);
}

/// The switch between the pages of the panel on the left, and in the drawer what is selected.
fn show_tabs(ui: &mut Ui, session: &Session, state: &mut UiState, in_drawer: bool) {
    let tabs = [
        (Some(SidePage::Model), "Model"),
        (Some(SidePage::Skeleton), "Skeleton"),
        (None, "Selection"),
    ];
    let is_there = |tab: &(Option<SidePage>, _)| match tab.0 {
        Some(page) => page == SidePage::Model || has_joints(session),
        None => in_drawer,
    };
    let tabs: Vec<_> = tabs.into_iter().filter(is_there).collect();
    let shown = if in_drawer {
        side_tab(state)
    } else {
        Some(state.skeleton.page)
    };
    match kit::segmented(ui, ("Panel", Control::new("page")), &tabs, Some(shown)) {
        Some(Some(page)) => {
            state.skeleton.page = page;
            state.drawer = state.drawer.map(|_| DrawerPage::Model);
        }
        Some(None) => state.drawer = Some(DrawerPage::Selection),
        None => {}
    }
}

/// The tab of the drawer: a page of the panel on the left, or none for what is selected. A bone is named in the tree.
pub(super) fn side_tab(state: &UiState) -> Option<SidePage> {
    let selection = state.drawer == Some(DrawerPage::Selection) && !state.skeleton.is_naming();
    (!selection).then_some(state.skeleton.page)
}

fn side_page(ui: &mut Ui, id: &'static str, cx: &mut Cx<'_, UiState>) {
    if cx.state.skeleton.page == SidePage::Skeleton {
        skeleton::show_tree(ui, &mut cx.part(|state| &mut state.skeleton));
    } else {
        scrolled(id, ui.available_height()).show(ui, |ui| model_panel::show(ui, cx));
    }
}

/// Whether there is something to inspect: a bone, a vertex or a subset.
pub(super) fn has_selection(session: &Session) -> bool {
    is_inspected(session) || session.submeshes().selected().is_some()
}

/// The inspector of what is selected.
pub(super) fn show_selection(ui: &mut Ui, cx: &mut Cx<'_, UiState>) {
    if is_inspected(cx.session) {
        skeleton::show_inspector(ui, &mut cx.part(|state| &mut state.skeleton));
    } else {
        submesh_panel::show(ui, cx);
    }
}

/// Width of a page beside the model.
pub(super) fn page_width(page: DrawerPage, window: Rect) -> f32 {
    let fraction = if page == DrawerPage::Timeline {
        TIMELINE_BESIDE_FRACTION
    } else {
        BESIDE_FRACTION
    };
    (fraction * window.width()).min(MOST_BESIDE)
}

pub(super) fn page_title(page: DrawerPage, state: &UiState) -> &'static str {
    match page {
        page if page.is_tab() && state.diagnostics_open => "Findings",
        DrawerPage::Model | DrawerPage::Selection => match side_tab(state) {
            Some(_) => side_label(state),
            None => "Inspector",
        },
        page => page.label(),
    }
}

/// A page of the drawer below its title, no higher than what is available.
pub(super) fn show_page(ui: &mut Ui, page: DrawerPage, cx: &mut Cx<'_, UiState>) {
    let is_tab = page.is_tab();
    if is_tab && cx.state.diagnostics_open {
        findings::show(ui, cx);
        return;
    }
    let title = page_title(page, cx.state);
    let close = if is_tab {
        // The switch between the pages is their title.
        ui.horizontal(|ui| {
            let size = vec2(
                ui.available_width() - kit::control_size(ui) - 6.0,
                kit::control_size(ui),
            );
            ui.allocate_ui(size, |ui| show_tabs(ui, cx.session, cx.state, true));
            kit::push_button(ui, Icon::Close, "Close")
        })
        .inner
    } else {
        kit::heading_with_close(ui, title)
    };
    ui.add_space(4.0);
    focus::note_page(ui, Id::unique(("page", page)), close.id);
    if close.clicked() {
        cx.state.drawer = None;
    }
    if is_tab && side_tab(cx.state).is_some() {
        side_page(ui, "drawer", cx);
        return;
    }
    if page == DrawerPage::Timeline {
        timeline::page(ui, cx);
        return;
    }
    if page == DrawerPage::Export {
        export::show(ui, ui.available_height(), cx);
        return;
    }
    // Each page begins at its top, and so does what is inspected next.
    let salt = ("drawer", page as u8, cx.state.shown_selection);
    let area = scrolled("drawer", ui.available_height()).id_salt(salt);
    area.show(ui, |ui| match page {
        DrawerPage::Selection if has_selection(cx.session) => show_selection(ui, cx),
        DrawerPage::Selection => {
            let words = "Nothing is selected. Tap a part of the model, or choose a bone under Skeleton.";
            ui.label(RichText::new(words).color(Tokens::of(ui).muted));
        }
        DrawerPage::ViewMode => {
            kit::choices(ui, title, |ui| toolbar::view_mode_items(ui, cx));
        }
        DrawerPage::Light => light::show(ui, &mut cx.part(|state| &mut state.cost)),
        DrawerPage::Overlays => overlays::show(ui, &mut cx.part(|state| &mut state.skeleton)),
        DrawerPage::ViewFrom => {
            toolbar::view_from_items(ui, cx);
        }
        DrawerPage::Picture => picture::show(ui, cx.session, cx.state),
        DrawerPage::Model | DrawerPage::Export | DrawerPage::Timeline => {}
    });
}
