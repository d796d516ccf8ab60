//! Where the panels are: around the view in a wide window, a bar and a drawer in a narrow one. In a low window, such as a phone on its
//! side, what was opened stands beside the model instead of below it.
//!
//! One pass goes from the edges inwards. Each panel gets the room that the panels before it left, and what all of them leave is where
//! the model is framed.

use egui::{Align, Align2, Layout, Margin, Rangef, Rect, Role, Sense, Ui, UiBuilder, Vec2, pos2, vec2};

use super::arrangement::Arrangement;
use super::drawer::Heights;
use super::panel::{self, Free, LEAST_ROOM, Panel, mark_transport, scrolled};
use super::{pages, toolbar};
use crate::actions;
use crate::session::{Command, LoadError, Session};
use crate::ui::cx::Cx;
use crate::ui::kit::TextButton;
use crate::ui::kit::icons::Icon;
use crate::ui::kit::theme::{MARGIN, Tokens};
use crate::ui::kit::wording::grouped;
use crate::ui::panels::skeleton::state::SidePage;
use crate::ui::panels::skeleton::{self, LegendShape};
use crate::ui::panels::{error_card, findings, help, model_panel};
use crate::ui::state::{Chrome, DrawerPage, UiState};
use crate::ui::{kit, timeline};

/// Width of the panel on the left.
const SIDE_WIDTH: f32 = 246.0;
const INSPECTOR_WIDTH: f32 = 288.0;
/// Width of the list of diagnostics, where there is room for it.
const DIAGNOSTICS_WIDTH: f32 = 456.0;
/// Width of the card that tells why a file was not opened, where there is room for it.
const ERROR_WIDTH: f32 = 562.0;
/// Height of the middle of that card, as a fraction of the window.
const ERROR_AT: f32 = 0.38;
/// In a narrow window a figure in the middle reaches about so far to either side.
const FIGURE_REACH: f32 = 80.0;
/// The least width beside the diagnostics in which something of a model is seen.
const LEAST_BESIDE_DIAGNOSTICS: f32 = 200.0;
/// The least sides of the room in which the button to frame the model stands.
const LEAST_WITH_FRAME: f32 = 84.0;
/// The least width of the selection's name, and the room that it leaves to the button that frames.
const LEAST_SELECTION: f32 = 88.0;
const BESIDE_SELECTION: f32 = 110.0;
/// The least height of the panel that has a legend as a card below it.
const LEAST_WITH_CARD: f32 = 220.0;
/// The least height of the view that has a legend as a card beside it.
const LEAST_BESIDE_CARD: f32 = 80.0;
/// The least height of the model that has a legend as a strip below it.
const LEAST_WITH_STRIP: f32 = 180.0;

/// Shows all panels. Returns what they leave free for the model, and what of that no panel covers.
pub(in crate::ui) fn show(ui: &Ui, cx: &mut Cx<'_, UiState>) -> (Rect, Rect) {
    let window = ui.max_rect();
    if cx.state.chrome != Chrome::Full {
        let free = embedded(ui, cx, Free::new(window));
        return (free.rect, free.room());
    }
    let (free, uncovered) = match Arrangement::of(window) {
        Arrangement::Wide => wide(ui, cx, Free::new(window)),
        arrangement => {
            let low = arrangement == Arrangement::Low;
            narrow(ui, cx, Free::new(window), low)
        }
    };
    (free.rect, uncovered.room())
}

/// On another page: the timeline or nothing, and what tells that a file cannot be opened. Returns what is free for the model.
fn embedded(ui: &Ui, cx: &mut Cx<'_, UiState>, mut free: Free) -> Free {
    if cx.state.chrome == Chrome::Transport && cx.session.clip().is_some() {
        let room = free.room();
        let arrangement = Arrangement::of(ui.max_rect());
        let timeline = Panel::new("timeline", "Timeline", Align2::LEFT_BOTTOM)
            .margin(Margin::symmetric(9, 8))
            .width(room.width())
            .show(ui, room, |ui| match arrangement {
                Arrangement::Wide => timeline::wide(ui, cx),
                _ => timeline::narrow(ui, cx, arrangement == Arrangement::Low),
            });
        free.cut_bottom(timeline);
    }
    show_on_top(ui, cx, &free);
    free
}

/// Wide windows. Returns what is free for the model, and what of that is not covered.
fn wide(ui: &Ui, cx: &mut Cx<'_, UiState>, mut free: Free) -> (Free, Free) {
    let room = free.room();
    let toolbar = Panel::new("toolbar", "Toolbar", Align2::RIGHT_TOP)
        .margin(Margin::same(3))
        .show(ui, room, |ui| {
            ui.set_height(kit::control_size(ui));
            toolbar::show(ui, cx);
        });
    let beside = room.with_max_x(toolbar.min.x - MARGIN).with_max_y(toolbar.max.y);
    Panel::new(panel::TITLE, "Title", Align2::LEFT_TOP)
        .margin(Margin::symmetric(12, 3))
        .show(ui, beside, |ui| {
            ui.take_available_height();
            toolbar::title(ui, cx.session, Some(cx.state), cx.commands);
        });
    free.cut_top(toolbar);
    if cx.session.clip().is_some() {
        let room = free.room();
        let timeline = Panel::new("timeline", "Timeline", Align2::LEFT_BOTTOM)
            .margin(Margin::symmetric(9, 8))
            .width(room.width())
            .show(ui, room, |ui| timeline::wide(ui, cx));
        free.cut_bottom(timeline);
    }
    if cx.session.open_model().is_some() {
        let mut column = free;
        let room = free.room();
        if room.height() >= LEAST_WITH_CARD
            && let Some(legend) = show_legend(ui, cx.session, cx.state, room, LegendShape::Card)
        {
            column.cut_bottom(legend);
        }
        let width = skeleton::side_width(ui, cx.state.side_width.unwrap_or(SIDE_WIDTH), SIDE_WIDTH);
        let side = Panel::new("model", pages::side_label(cx.state), Align2::LEFT_TOP)
            .width(width)
            .show(ui, column.room(), |ui| {
                pages::side_panel(ui, "model", cx);
            });
        if let Some(width) = skeleton::show_width_handle(ui, side, SIDE_WIDTH) {
            cx.state.side_width = Some(width);
        }
        free.cut_left(side);
    }
    if let Some(greeting) = help::greet(ui, cx.state, free.room()) {
        free.cut_bottom(greeting);
    }
    show_on_top(ui, cx, &free);

    let mut beside = free;
    if pages::has_selection(cx.session) {
        let inspector = Panel::new("inspector", "Inspector", Align2::RIGHT_TOP)
            .width(INSPECTOR_WIDTH)
            .show(ui, free.room(), |ui| {
                scrolled("inspector", ui.available_height()).show(ui, |ui| pages::show_selection(ui, cx));
            });
        beside.cut_right(inspector);
    }
    if cx.state.diagnostics_open {
        let room = beside.room();
        let list = Panel::new(panel::FINDINGS, "Findings", Align2::LEFT_TOP)
            .width(DIAGNOSTICS_WIDTH.min(room.width()))
            .show(ui, room, |ui| findings::show(ui, cx));
        beside.cut_left(list);
        // A click on a diagnostic shows its subject, so the list does not cover it. If the list leaves too little room, it does.
        if beside.rect.width() >= LEAST_BESIDE_DIAGNOSTICS {
            free = beside;
        }
    }
    frame_button(ui, cx, &beside);
    // The model stays where it is when an inspector opens.
    (free, beside)
}

/// Phones, slim and low windows: one bar above, one drawer below; in a low window what is opened stands between them. Returns the same as
/// [`wide`].
fn narrow(ui: &Ui, cx: &mut Cx<'_, UiState>, mut free: Free, low: bool) -> (Free, Free) {
    let room = free.room();
    let mut opens = Vec::new();
    let bar = Panel::new(panel::TITLE, "Title", Align2::LEFT_TOP)
        .margin(Margin::same(4))
        .width(room.width())
        .show(ui, room, |ui| {
            let size = vec2(ui.available_width(), kit::control_size(ui));
            let (bar, _) = ui.allocate_exact_size(size, Sense::hover());
            let split = bar.max.x - toolbar::narrow_width(ui);
            let left = bar.min.x + 8.0..=split - ui.spacing().item_spacing.x;
            let [mut left, mut right] = [left, split..=bar.max.x].map(|x| {
                let part = UiBuilder::new().max_rect(Rect::from_x_y_ranges(x, bar.y_range()));
                ui.new_child(part.layout(Layout::left_to_right(Align::Center)))
            });
            toolbar::title(&mut left, cx.session, None, &mut opens);
            toolbar::show_narrow(&mut right, cx);
        });
    cx.commands.append(&mut opens);
    free.cut_top(bar);
    if cx.session.open_model().is_some() || !matches!(cx.state.drawer, None | Some(DrawerPage::Model)) {
        let drawer = drawer(ui, cx, &free, low);
        free.cut_bottom(drawer);
        if let Some(page) = cx.state.drawer.filter(|_| low) {
            let room = free.room();
            let label = pages::page_title(page, cx.state);
            let page = Panel::new(panel::PAGE, label, Align2::RIGHT_TOP)
                .width(pages::page_width(page, ui.max_rect()))
                .show(ui, room, |ui| pages::show_page(ui, page, cx));
            free.cut_right(page);
        }
    }
    if cx.state.drawer.is_none()
        && let Some(greeting) = help::greet(ui, cx.state, free.room())
    {
        free.cut_bottom(greeting);
    }
    show_on_top(ui, cx, &free);

    // A card stands beside a figure. Where there is no room for it, a strip stands below the model.
    let mut beside_card = None;
    let room = free.room();
    if room.min.x + SIDE_WIDTH + FIGURE_REACH <= free.rect.center().x {
        if room.height() >= LEAST_BESIDE_CARD {
            beside_card = show_legend(ui, cx.session, cx.state, room, LegendShape::Card);
        }
    } else if room.height() >= LEAST_WITH_STRIP
        && let Some(strip) = show_legend(ui, cx.session, cx.state, room, LegendShape::Strip)
    {
        free.cut_bottom(strip);
    }
    let room = free.room();
    let room = beside_card.map_or(room, |card| room.with_min_x(card.max.x + MARGIN));
    let chips = shortcuts(ui, cx.session, cx.state, room);
    let uncovered = free;
    if !cx.state.messages.is_shown() {
        frame_button(ui, cx, &free);
    }
    // A figure stands on them, unless they are beside it.
    if let Some(chips) = chips.filter(|chips| chips.max.x + FIGURE_REACH > room.center().x)
        && chips.min.y - room.min.y >= LEAST_WITH_STRIP
    {
        free.cut_bottom(chips);
    }
    (free, uncovered)
}

/// What the colours of the skin mean, if they mean something, in the lower left corner of a room.
fn show_legend(ui: &Ui, session: &Session, state: &mut UiState, room: Rect, shape: LegendShape) -> Option<Rect> {
    let view = skeleton::colored_view(session)?;
    let panel = Panel::new("legend", "Legend", Align2::LEFT_BOTTOM);
    let panel = match shape {
        LegendShape::Card => panel.width(SIDE_WIDTH),
        LegendShape::Strip => panel.margin(skeleton::STRIP_MARGIN),
    };
    let tree_shown = shows_side_page(ui.max_rect(), state) && state.skeleton.page == SidePage::Skeleton;
    Some(panel.show(ui, room, |ui| {
        if skeleton::show_legend(ui, session, view, shape, tree_shown) {
            state.skeleton.show_page(session, SidePage::Skeleton);
            state.drawer = Some(DrawerPage::Model);
        }
    }))
}

/// The timeline at the window's lower edge, and above it what was opened, unless it stands beside the model. The transport stays in its
/// place whatever opens. Returns the rect that it has at rest.
fn drawer(ui: &Ui, cx: &mut Cx<'_, UiState>, free: &Free, low: bool) -> Rect {
    let window = ui.max_rect();
    let margin = Margin {
        left: 14,
        right: 14,
        top: 0,
        bottom: 14,
    };
    // How much higher the drawer will be when it comes to rest.
    let mut rises = 0.0;
    let rect = Panel::new(panel::DRAWER, "Sheet", Align2::LEFT_BOTTOM)
        .drawer()
        .margin(margin)
        .width(window.width())
        .show(ui, window.with_min_y(free.room().min.y), |ui| {
            let shows_facts = !cx.state.diagnostics_open && pages::side_tab(cx.state) == Some(SidePage::Model);
            let label = match cx.state.drawer {
                Some(_) => "Close the sheet",
                None if shows_facts => "Model facts",
                None => pages::page_title(DrawerPage::Model, cx.state),
            };
            let handle = kit::drawer_handle(ui, label);
            if handle.clicked() {
                cx.state.drawer = cx.state.drawer.is_none().then_some(DrawerPage::Model);
            }
            if !low {
                let most = ui.available_height() - cx.state.drawer_height.strip;
                let of_timeline = cx.state.drawer == Some(DrawerPage::Timeline);
                let heights = Heights::new(of_timeline, window.height(), most);
                let (height, page) = (&mut cx.state.drawer_height, cx.state.drawer);
                let open = height.drag(ui, &handle, heights, page.is_some());
                cx.state.drawer = open.then(|| page.unwrap_or(DrawerPage::Model));
                match cx.state.drawer {
                    Some(page) => {
                        let still = cx.session.reduced_motion();
                        let (height, at_rest) = cx.state.drawer_height.now(ui.ctx(), heights, still);
                        let label = pages::page_title(page, cx.state);
                        let region = UiBuilder::new()
                            .accessibility_role(Role::Region)
                            .accessibility_label(label);
                        let shown = ui.scope_builder(region, |ui| {
                            ui.set_max_height(height);
                            pages::show_page(ui, page, cx);
                        });
                        if shown.response.rect.height() >= height - 0.5 {
                            rises = at_rest - height;
                        }
                    }
                    None => cx.state.drawer_height.shut(ui.ctx()),
                }
            }
            // Whole points above it, so that the strip stays where it is.
            let above = ui.cursor().min.y - ui.max_rect().min.y;
            ui.add_space(above.ceil() - above);
            let top = ui.cursor().min.y;
            if cx.session.clip().is_some() {
                if cx.state.drawer.is_some() && !low {
                    ui.add_space(10.0);
                }
                let region = UiBuilder::new()
                    .accessibility_role(Role::Region)
                    .accessibility_label("Timeline");
                let strip = ui.scope_builder(region, |ui| timeline::narrow(ui, cx, low));
                mark_transport(ui, strip.response.rect);
            }
            cx.state.drawer_height.strip = ui.min_rect().max.y - top;
        });
    rect.with_min_y(rect.min.y - rises)
}

/// Whether a drawer lies over the view. A tap on the view shuts it.
pub(in crate::ui) fn drawer_covers_view(window: Rect, state: &UiState) -> bool {
    Arrangement::of(window) == Arrangement::Narrow && state.drawer.is_some()
}

/// Whether facts or the tree of joints are seen.
pub(in crate::ui) fn shows_side_page(window: Rect, state: &UiState) -> bool {
    Arrangement::of(window) == Arrangement::Wide || state.drawer == Some(DrawerPage::Model)
}

/// Help and the error card: over other panels, but not over the bars, the panel on the left and the timeline.
fn show_on_top(ui: &Ui, cx: &mut Cx<'_, UiState>, free: &Free) {
    let window = ui.max_rect();
    if cx.state.help_open {
        let room = free.room();
        // A phone's drawer may leave too little.
        let room = if room.height() < LEAST_ROOM {
            room.with_max_y(window.max.y - MARGIN)
        } else {
            room
        };
        Panel::new("help", "Help", Align2::RIGHT_TOP)
            .role(Role::Dialog)
            .on_top()
            .show(ui, room, |ui| help::show(ui, cx.session, cx.state));
    }
    if let Some(error) = cx.session.error() {
        show_error(ui, cx.session, error, free.room(), cx.commands);
    }
}

/// Offers to frame the model after the camera was moved by hand and the panels changed: the camera does not move by itself then.
fn frame_button(ui: &Ui, cx: &mut Cx<'_, UiState>, free: &Free) {
    let room = free.room();
    if !cx.state.offers_frame || room.size().min_elem() < LEAST_WITH_FRAME {
        return;
    }
    Panel::new("offer-frame", "Frame", Align2::RIGHT_BOTTOM)
        .margin(Margin::same(3))
        .show(ui, room, |ui| {
            let action = &actions::FRAME_MODEL;
            let button = kit::TextButton::new("Frame", action.label).icon(Icon::Frame);
            if button.show(ui).on_hover_text(action.hint()).clicked() {
                cx.act(action);
            }
        });
}

/// While the drawer is shut: how many findings there are, and what is selected. Each opens its page. A message takes
/// their place.
fn shortcuts(ui: &Ui, session: &Session, state: &mut UiState, room: Rect) -> Option<Rect> {
    if state.drawer.is_some() {
        return None;
    }
    let joints = session.joints();
    let submesh = session.submeshes().selected();
    let name = joints.selected().map(|joint| session.joint_label(joint));
    let name = name.or_else(|| Some(format!("Vertex {}", grouped(joints.selected_vertex()?.vertex as usize))));
    let name = name.or_else(|| Some(session.submesh_name(submesh?).to_owned()));
    let has_findings = session.open_model().is_some() && session.diagnostics().next().is_some();
    if name.is_none() && !has_findings {
        return None;
    }
    if state.messages.is_shown() {
        // The model stays where it is.
        return ui.memory(|memory| memory.area_rect(panel::id_of("shortcuts")));
    }
    let shown = Panel::new("shortcuts", "Findings and selection", Align2::LEFT_BOTTOM)
        .margin(Margin::same(3))
        .show(ui, room, |ui| {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 4.0;
                if has_findings {
                    let (count, color) = model_panel::summary(session, &Tokens::of(ui));
                    if toolbar::findings_chip(ui, false, &count, color) {
                        state.diagnostics_open = true;
                        state.drawer = Some(DrawerPage::Model);
                    }
                }
                let Some(name) = name else { return };
                let label = format!("Show {name}");
                let most = (room.width() - BESIDE_SELECTION - ui.min_rect().width()).max(LEAST_SELECTION);
                let width = Rangef::new(LEAST_SELECTION, most);
                if TextButton::new(&name, &label).width(width).show(ui).clicked() {
                    state.diagnostics_open = false;
                    state.drawer = Some(DrawerPage::Selection);
                }
            });
        });
    Some(shown)
}

/// Why a file was not opened: in the middle of the window, or so far to the right that the panel on the left can be read. It scrolls
/// rather than cover the bars, and covers the page of a drawer rather than be too low, but never the transport.
fn show_error(ui: &Ui, session: &Session, error: &LoadError, room: Rect, commands: &mut Vec<Command>) {
    let window = ui.max_rect();
    let within = window.shrink(MARGIN);
    let width = ERROR_WIDTH.min(within.width());
    let x = window.center().x.max(room.min.x + 0.5 * width);
    let x = x.min(within.max.x - 0.5 * width);
    let mut room = room;
    if room.height() < LEAST_ROOM {
        let transport = ui.ctx().read_response(panel::id_of("transport"));
        room.max.y = transport.map_or(within.max.y, |transport| transport.rect.min.y - MARGIN);
    }
    let mut y = window.min.y + ERROR_AT * window.height();
    let mut half = (y - room.min.y).min(room.max.y - y);
    if half < 0.5 * LEAST_ROOM {
        (y, half) = (room.center().y, 0.5 * room.height());
    }
    let around = Rect::from_center_size(pos2(x, y), Vec2::new(width, 2.0 * half.max(0.0)));
    Panel::new("error", &error.diagnostic.message, Align2::CENTER_CENTER)
        .role(Role::AlertDialog)
        .on_top()
        .width(width)
        .show(ui, around, |ui| error_card::show(ui, session, error, commands));
}
