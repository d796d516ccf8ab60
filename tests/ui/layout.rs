//! Where things are: inside the window, off each other, large enough, and still while values change.

use bindpose::anim::SkinView;
use bindpose::model::JointIndex;
use bindpose::session::{FileCommand, JointCommand, LookCommand, PlayCommand, SubmeshCommand};
use bindpose::ui::{Chrome, DrawerPage};
use egui::{Rect, Vec2, pos2, vec2};

use crate::models::{self, broken, moving, still};
use crate::page::{PHONE, Page, WIDE, Window, phone, touch_window, window};

const LONG: &str = "a_name_that_somebody_gave_to_a_model_without_thinking_of_panels_at_all_and_then_some.m3d";

fn long_clip() -> Vec<bindpose::session::File> {
    vec![models::file(
        "c.m3d",
        &models::skinned(&[(LONG, 0.0, 500), ("b", 0.0, 2)]),
    )]
}

/// A panel's clips may cut a widget of a scrolled list; these models are short.
#[track_caller]
pub(crate) fn assert_inside(window: &Window, size: Vec2) {
    let page = Rect::from_min_size(egui::Pos2::ZERO, size);
    for (name, rect) in window.widgets() {
        assert!(
            page.contains_rect(rect),
            "{name:?} at {rect} leaves the window of {size}"
        );
    }
}

/// As a click on their row does, which in a small window has to be scrolled to.
fn show_findings(window: &mut Window) {
    window.harness.state_mut().state.diagnostics_open = true;
    window.pass_on();
    assert!(window.shows("Close"));
}

/// Lists may go on below, where they can be scrolled to, but not beside.
#[track_caller]
pub(crate) fn assert_between_sides(window: &Window, size: Vec2) {
    for (name, rect) in window.widgets() {
        assert!(
            rect.min.x >= 0.0 && rect.max.x <= size.x,
            "{name:?} at {rect} leaves the window of {size}"
        );
    }
}

/// Rectangles of the panels that the layout opened.
fn panels(window: &Window) -> Vec<(&'static str, Rect)> {
    let names = "title toolbar model inspector findings timeline drawer page help error legend greeting";
    let area = |name: &'static str| {
        let id = egui::Id::unique(("panel", name));
        let visible = window
            .harness
            .ctx
            .memory(|memory| memory.areas().visible_layer_ids().iter().any(|layer| layer.id == id));
        let rect = window.harness.ctx.memory(|memory| memory.area_rect(id))?;
        visible.then_some((name, rect))
    };
    names.split(' ').filter_map(area).collect()
}

#[track_caller]
pub(crate) fn panel(window: &Window, wanted: &str) -> Rect {
    shown_panel(window, wanted).unwrap_or_else(|| panic!("no panel {wanted}"))
}

pub(crate) fn shown_panel(window: &Window, wanted: &str) -> Option<Rect> {
    let found = panels(window).into_iter().find(|(name, _)| *name == wanted);
    found.map(|(_, rect)| rect)
}

#[track_caller]
pub(crate) fn assert_apart(window: &Window, expected: &[&str]) {
    let panels = panels(window);
    assert_eq!(panels.iter().map(|(name, _)| *name).collect::<Vec<_>>(), expected);
    for (index, (name, rect)) in panels.iter().enumerate() {
        for (other, other_rect) in &panels[index + 1..] {
            assert!(
                !rect.intersects(*other_rect),
                "{name} {rect} lies on {other} {other_rect}"
            );
        }
    }
}

#[test]
fn in_a_wide_window_nothing_is_cut_and_no_panel_lies_on_another() {
    for size in [WIDE, vec2(900.0, 600.0), vec2(1920.0, 1080.0), vec2(1200.0, 480.0)] {
        for files in [
            vec![moving("a.m3d")],
            vec![moving(LONG), still("other.m3d")],
            long_clip(),
        ] {
            let mut window = window(size, files);
            assert_inside(&window, size);
            assert_apart(&window, &["title", "toolbar", "model", "timeline"]);
            if size.y >= 600.0 {
                window.click("Findings");
                assert_inside(&window, size);
                assert_apart(&window, &["title", "toolbar", "model", "findings", "timeline"]);
                window.apply(SubmeshCommand::Select(Some(0)));
                assert_inside(&window, size);
                let all = ["title", "toolbar", "model", "inspector", "findings", "timeline"];
                assert_apart(&window, &all);
            }
        }
        assert_apart(&window(size, vec![still("a.m3d")]), &["title", "toolbar", "model"]);
        assert_apart(&window(size, vec![]), &["title", "toolbar"]);
    }
}

#[test]
fn in_a_narrow_window_a_bar_and_a_sheet_share_the_height() {
    for size in [PHONE, vec2(320.0, 568.0), vec2(899.0, 700.0)] {
        for files in [
            vec![moving("a.m3d")],
            vec![moving(LONG)],
            vec![still("a.m3d")],
            long_clip(),
        ] {
            let mut window = window(size, files);
            assert_inside(&window, size);
            assert_apart(&window, &["title", "drawer"]);
            window.click("Model facts");
            assert_apart(&window, &["title", "drawer"]);
            let dialect = window.rect("Dialect");
            assert!(dialect.max.y < size.y - 100.0, "what was opened can be seen: {dialect}");
            assert_between_sides(&window, size);
            show_findings(&mut window);
            assert_between_sides(&window, size);
            window.click("Close the sheet");
            assert!(!window.shows("Dialect D3D12 book"));
        }
    }
    // By touch all is larger.
    for size in [PHONE, vec2(360.0, 640.0), vec2(320.0, 568.0), vec2(480.0, 320.0)] {
        for files in [vec![moving("a.m3d")], vec![moving(LONG)], long_clip()] {
            let mut window = touch_window(size, files);
            assert_inside(&window, size);
            window.click("Model facts");
            assert_between_sides(&window, size);
            assert_apart(&window, &["title", "drawer"]);
            show_findings(&mut window);
            assert_between_sides(&window, size);
        }
    }
}

#[test]
fn in_a_low_window_what_was_opened_stands_beside_the_model() {
    for (size, touch) in [
        (vec2(844.0, 390.0), true),
        (vec2(932.0, 430.0), true),
        (vec2(667.0, 375.0), true),
        (vec2(600.0, 320.0), true),
        (vec2(1200.0, 470.0), false),
    ] {
        let open = if touch { touch_window } else { window };
        for files in [
            vec![moving("a.m3d")],
            vec![moving(LONG)],
            vec![still("a.m3d")],
            long_clip(),
        ] {
            let has_clip = !matches!(files.as_slice(), [file] if *file == still("a.m3d"));
            let mut window = open(size, files);
            assert_inside(&window, size);
            assert_apart(&window, &["title", "drawer"]);
            assert_model_is_free(&mut window, size);
            window.click("Model facts");
            assert_between_sides(&window, size);
            assert_apart(&window, &["title", "drawer", "page"]);
            assert!(panel(&window, "page").contains_rect(window.rect("Dialect")));
            assert_model_is_free(&mut window, size);
            window.apply(LookCommand::SetSkinView(Some(SkinView::Stretch)));
            assert_model_is_free(&mut window, size);
            window.apply(LookCommand::SetSkinView(None));
            show_findings(&mut window);
            assert_between_sides(&window, size);
            window.click("Close the sheet");
            assert!(!window.shows("Dialect D3D12 book"));
            if has_clip {
                window.click("Dope sheet and");
                assert_between_sides(&window, size);
                assert_apart(&window, &["title", "drawer", "page"]);
                assert_model_is_free(&mut window, size);
            }
        }
    }
}

#[test]
fn the_error_card_and_the_keys_fit_the_window() {
    for (mut window, size) in [
        (window(WIDE, vec![moving("a.m3d")]), WIDE),
        (window(vec2(900.0, 600.0), vec![]), vec2(900.0, 600.0)),
        (window(vec2(900.0, 700.0), vec![moving("a.m3d")]), vec2(900.0, 700.0)),
        (
            touch_window(vec2(844.0, 390.0), vec![moving("a.m3d")]),
            vec2(844.0, 390.0),
        ),
        (phone(vec![moving("a.m3d")]), PHONE),
    ] {
        window.apply(FileCommand::Add(vec![broken(LONG)]));
        let card = panels(&window)
            .into_iter()
            .find(|(name, _)| *name == "error")
            .expect("the card")
            .1;
        assert!(
            Rect::from_min_size(egui::Pos2::ZERO, size).contains_rect(card),
            "{card}"
        );
        assert_off(&window, card, &["model"]);
        for button in ["Copy the error", "Dismiss (Esc)"] {
            assert!(card.contains_rect(window.rect(button)), "{button}");
        }
        let [title, copy] = ["a_name_that", "Copy the error"].map(|start| {
            window
                .named(|name| name.starts_with(start) && !name.contains(':'))
                .iter()
                .find(|(name, rect)| !name.contains(".m3d:") && card.contains(rect.center()))
                .expect(start)
                .1
        });
        assert!(!title.intersects(copy), "the title lies under the buttons");
        window.click("Dismiss");
        window.type_text("?");
        assert_between_sides(&window, size);
        let help = panels(&window)
            .into_iter()
            .find(|(name, _)| *name == "help")
            .expect("the table")
            .1;
        assert!(
            Rect::from_min_size(egui::Pos2::ZERO, size).contains_rect(help),
            "{help}"
        );
        assert_off(&window, help, &["title", "toolbar", "model", "timeline", "drawer"]);
    }
}

/// Those panels that are there stay to be read beside what came last.
#[track_caller]
pub(crate) fn assert_off(window: &Window, rect: Rect, names: &[&str]) {
    for (name, covered) in panels(window).into_iter().filter(|(name, _)| names.contains(name)) {
        assert!(!rect.intersects(covered), "{rect} lies on {name} {covered}");
    }
}

/// Where the model is in the window, by the corners of the box that it keeps inside of.
fn model_rect(window: &mut Window, size: Vec2) -> Rect {
    let session = &mut window.harness.state_mut().session;
    let bounds = session.world_bounds();
    let camera = session.camera();
    let clip_from_world = camera.clip_from_view(size.x / size.y, &bounds) * camera.view_from_world();
    let corners = bounds.corners().map(|corner| {
        let clip = clip_from_world.project_point3(corner);
        pos2((0.5 + 0.5 * clip.x) * size.x, (0.5 - 0.5 * clip.y) * size.y)
    });
    Rect::from_points(&corners)
}

#[test]
fn the_legend_lies_on_no_panel_and_not_on_the_model() {
    for (size, touch) in [
        (PHONE, true),
        (vec2(320.0, 700.0), true),
        (vec2(844.0, 390.0), true),
        (vec2(900.0, 700.0), false),
        (vec2(1100.0, 700.0), false),
        (WIDE, false),
    ] {
        for view in SkinView::ALL {
            let open = if touch { touch_window } else { window };
            let mut window = open(size, vec![moving("a.m3d")]);
            window.apply(LookCommand::SetSkinView(Some(view)));
            let narrow = size.x < 900.0;
            let base: &[&str] = if narrow {
                &["title", "drawer", "legend"]
            } else {
                &["title", "toolbar", "model", "timeline", "legend"]
            };
            assert_apart(&window, base);
            assert_inside(&window, size);
            assert_model_is_free(&mut window, size);

            if narrow {
                window.click("Model facts");
            }
            window.apply(JointCommand::Select(Some(JointIndex(0))));
            assert_model_is_free(&mut window, size);
        }
    }
}

#[test]
fn chips_leave_the_models_head_free_on_phones() {
    for (size, sheet) in [(PHONE, Some(DrawerPage::Model)), (vec2(844.0, 390.0), None)] {
        let mut window = touch_window(size, vec![moving("a.m3d")]);
        window.harness.state_mut().state.drawer = sheet;
        window.wait(1.0);
        let free = model_rect(&mut window, size);
        window.apply(PlayCommand::SetSpeed(0.5));
        window.wait(1.0);
        let chip = window.rect("Leave speed 0.5×");
        // It is drawn 24 points high, whatever the target.
        let lower_edge = chip.center().y + 12.0;
        let model = model_rect(&mut window, size);
        assert!(model.min.y >= lower_edge, "{chip} lies on {model} in {size}");
        assert!(free.min.y < lower_edge, "without a chip the model has the room");
        window.click("Leave speed 0.5×");
        window.wait(1.0);
        assert!((model_rect(&mut window, size).min - free.min).length() < 1.0);
    }
}

#[track_caller]
fn assert_model_is_free(window: &mut Window, size: Vec2) {
    let model = model_rect(window, size).shrink(4.0);
    let panels = panels(window);
    let covering = panels
        .iter()
        .filter(|(name, _)| ["legend", "drawer", "page", "timeline", "model"].contains(name));
    for (name, rect) in covering {
        assert!(
            !rect.intersects(model),
            "{name} {rect} of {size} lies on the model, {model}"
        );
    }
}

#[test]
fn an_open_dope_sheet_leaves_the_better_half_to_the_model() {
    for (size, height) in [(vec2(900.0, 700.0), 184.0), (vec2(900.0, 600.0), 144.0), (WIDE, 264.0)] {
        let mut window = window(size, vec![moving("a.m3d")]);
        let before = panel(&window, "timeline").height();
        window.click("Dope sheet and");
        let timeline = panel(&window, "timeline");
        assert_eq!(timeline.height() - before, height + 8.0, "{size}");
        let model = model_rect(&mut window, size);
        assert!(model.max.y < timeline.min.y + 2.0, "{model} under {timeline}");
        assert!(model.height() > 0.48 * size.y, "{model} is small in {size}");
    }
}

/// What opens changes the sizes of panels, which are known only once they were laid out.
#[test]
fn what_opens_stands_in_its_place_from_its_first_frame_on() {
    for size in [WIDE, vec2(900.0, 700.0), PHONE, vec2(844.0, 390.0)] {
        let mut window = window(size, vec![moving("a.m3d")]);
        let mut assert_in_place = |what: &str, open: &dyn Fn(&mut Page)| {
            open(window.harness.state_mut());
            window.harness.step();
            let first = window.widgets();
            window.pass_on();
            assert_eq!(window.widgets(), first, "{what} of {size}");
        };
        assert_in_place("inspector", &|page| {
            page.session.apply(SubmeshCommand::Select(Some(0)));
        });
        assert_in_place("legend", &|page| {
            page.session.apply(LookCommand::SetSkinView(Some(SkinView::Stretch)));
        });
        assert_in_place("drawer", &|page| page.state.drawer = Some(DrawerPage::Light));
        assert_in_place("findings", &|page| page.state.diagnostics_open = true);
        assert_in_place("keys", &|page| page.state.help_open = true);
        assert_in_place("error", &|page| {
            page.session.apply(FileCommand::Add(vec![broken("bad.m3d")]));
        });
        assert_in_place("no findings", &|page| page.state.diagnostics_open = false);
        assert_in_place("no sheet", &|page| page.state.drawer = None);
    }
}

#[test]
fn tiny_windows_are_drawn_with_everything_open() {
    for size in [
        vec2(200.0, 150.0),
        vec2(320.0, 100.0),
        vec2(700.0, 100.0),
        vec2(700.0, 160.0),
        vec2(901.0, 90.0),
    ] {
        let mut window = window(size, vec![models::file(LONG, &models::skinned(&[(LONG, 0.0, 31)]))]);
        let page = window.harness.state_mut();
        page.session.apply(SubmeshCommand::Select(Some(0)));
        page.session.apply(LookCommand::SetSkinView(Some(SkinView::Stretch)));
        page.session.apply(FileCommand::Add(vec![broken("bad.m3d")]));
        page.state.drawer = Some(DrawerPage::Timeline);
        page.state.diagnostics_open = true;
        page.state.help_open = true;
        window.pass_on();
        assert!(window.shows("Bindpose"), "{size}");
    }
}

#[test]
fn names_are_shortened_to_their_room_and_kept_for_readers() {
    let window = window(WIDE, vec![models::file(LONG, &models::skinned(&[(LONG, 0.0, 31)]))]);
    assert!(
        window.shows(LONG) && window.shows(&format!("Clip {LONG}")),
        "all of it for a reader"
    );
    let [toolbar, title] = ["toolbar", "title"].map(|name| panel(&window, name));
    assert!(title.contains_rect(window.rect(LONG)) && title.max.x < toolbar.min.x);
    assert!(window.rect("Clip ").width() < 240.0);
}

#[test]
fn nothing_moves_while_time_goes_by() {
    let clips = [("Long", 0.0, 400)];
    for mut window in [
        window(WIDE, vec![models::file("a.m3d", &models::skinned(&clips))]),
        phone(vec![models::file("a.m3d", &models::skinned(&clips))]),
    ] {
        let strip = ["Clip ", "Time", "Time ", "Frame ", "Speed ", "At the end: loops"];
        let rects = |window: &Window| {
            strip.map(|start| {
                let found = window.named(|name| {
                    (name.starts_with(start) && start != "Time" || name == start) && !name.starts_with("Frame the")
                });
                assert_eq!(found.len(), 1, "{start}: {found:?}");
                found[0].1
            })
        };
        let before = rects(&window);
        for time_secs in [0.5, 1.111, 9.99, 10.0, 13.3] {
            window.apply(PlayCommand::Seek { time_secs });
            assert_eq!(rects(&window), before, "{time_secs}");
        }
        for command in [PlayCommand::SetSpeed(0.25), PlayCommand::Play] {
            window.apply(command);
            assert_eq!(rects(&window), before);
        }
    }
}

#[test]
fn targets_are_large_enough_for_fingers() {
    let mut window = phone(vec![moving("a.m3d"), still("b.m3d")]);
    window.click("Model facts");
    let buttons = [
        "More",
        "Open files",
        "Play",
        "Clip ",
        "Speed ",
        "At the end: loops",
        "Time",
        "Handedness",
        "Up axis",
        "Findings",
    ];
    for start in buttons {
        let rect = window.rect(start);
        assert!(rect.height() >= 44.0 && rect.width() >= 44.0, "{start}: {rect}");
    }
    for (opener, item) in [
        ("Clip ", "Turn, "),
        ("More", "Turntable"),
        ("Speed ", "Speed: 0.5×"),
        ("Handedness", "As found"),
    ] {
        window.click(opener);
        let rect = window.rect(item);
        assert!(rect.height() >= 44.0, "{item}: {rect}");
        window.press(egui::Modifiers::NONE, egui::Key::Escape);
        assert!(!window.shows(item));
    }
    window.apply(FileCommand::Add(vec![broken("bad.m3d")]));
    for start in ["Copy the error", "Dismiss (Esc)"] {
        let rect = window.rect(start);
        assert!(rect.height() >= 44.0 && rect.width() >= 44.0, "{start}: {rect}");
    }
    window.click("Dismiss");
    let rect = window.rect("Close the sheet");
    assert!(rect.height() >= 44.0, "the grip: {rect}");
}

#[test]
fn the_button_that_frames_covers_no_panel() {
    for size in [vec2(1280.0, 800.0), WIDE] {
        let mut window = window(size, vec![moving("a.m3d")]);
        let drag = glam::Vec2::new(0.1, 0.0);
        window.apply(bindpose::session::CameraCommand::Pan { drag });
        window.apply(JointCommand::Select(Some(JointIndex(1))));
        show_findings(&mut window);
        window.apply(JointCommand::SelectVertex(Some(0)));
        let button = window.rect("Frame the model");
        let buttons = window.named(|name| name == "Frame the model");
        assert_eq!(buttons.len(), 1, "{size}: {buttons:?}");
        for (name, rect) in panels(&window) {
            assert!(!button.intersects(rect), "{size}: it lies on {name}");
        }
    }
}

#[test]
fn what_stands_over_the_view_of_a_phone_counts_when_the_model_is_framed() {
    let mut window = phone(vec![moving("a.m3d")]);
    let top_of_model = |window: &mut Window| {
        let session = &mut window.harness.state_mut().session;
        let bounds = session.open_model().expect("open").bind_bounds;
        let places = bounds
            .corners()
            .map(|corner| session.place_in_picture(corner).expect("in view"));
        let [low, high] = [f32::min, f32::max].map(|pick| places.map(|at| at.y).into_iter().reduce(pick).expect("8"));
        [high, low].map(|y| 0.5 * (1.0 - y) * PHONE.y)
    };
    window.apply(JointCommand::Select(Some(JointIndex(1))));
    window.apply(LookCommand::SetSkinView(Some(SkinView::Weight)));
    window.apply(PlayCommand::SetSpeed(0.5));
    window.wait(1.0);
    for sheet in [None, Some(DrawerPage::Model)] {
        window.harness.state_mut().state.drawer = sheet;
        window.wait(1.0);
        let [top, bottom] = top_of_model(&mut window);
        let chip = window.rect("Leave speed 0.5×");
        assert!(chip.center().y <= top, "{sheet:?}: {chip} over {top}");
        for below in ["legend", "shortcuts", "drawer"] {
            let id = egui::Id::unique(("panel", below));
            let shown = window.harness.ctx.memory(|memory| {
                let is_shown = memory.areas().visible_layer_ids().iter().any(|layer| layer.id == id);
                memory.area_rect(id).filter(|_| is_shown)
            });
            if let Some(rect) = shown {
                assert!(rect.min.y >= bottom, "{sheet:?}: {below} {rect} over {bottom}");
            }
        }
    }
}

/// Whether a control is shown whose name begins so.
fn has(window: &Window, start: &str) -> bool {
    !window.named(|name| name.starts_with(start)).is_empty()
}

#[test]
fn on_another_page_there_is_the_timeline_or_nothing_and_no_button_without_use() {
    for mut window in [window(WIDE, vec![moving("a.m3d")]), phone(vec![moving("a.m3d")])] {
        window.apply(PlayCommand::SetSpeed(0.5));
        for chrome in Chrome::ALL {
            window.harness.state_mut().state.chrome = chrome;
            window.pass_on();
            let whole = chrome == Chrome::Full;
            assert_eq!(has(&window, "Open files"), whole, "{chrome:?}");
            assert_eq!(has(&window, "Play"), chrome != Chrome::None, "{chrome:?}");
            assert_eq!(
                has(&window, "Leave speed 0.5"),
                whole,
                "{chrome:?}: a chip over the picture"
            );
            assert_inside(&window, window.harness.ctx.content_rect().size());
        }
    }
    let mut small = phone(vec![moving("a.m3d")]);
    assert!(has(&small, "Dope sheet"));
    small.harness.state_mut().state.chrome = Chrome::Transport;
    small.pass_on();
    assert!(!has(&small, "Dope sheet"), "there is no drawer for it");
    small.harness.state_mut().state.chrome = Chrome::None;
    small.apply(FileCommand::Add(vec![broken("b.m3d")]));
    assert!(has(&small, "Dismiss"));
}

#[test]
fn a_link_to_panels_opens_them_and_draws_no_bones() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    for opens_another in [false, true] {
        let Page { session, state, .. } = window.harness.state_mut();
        if opens_another {
            // The link is followed before the first pass with the model.
            session.apply(FileCommand::Add(vec![moving("b.m3d")]));
        }
        let names = ["skeleton", "findings"].map(str::to_owned);
        assert_eq!(state.open_these_panels(session, &names), [""; 0]);
        window.pass_on();
        let Page { session, state, .. } = window.harness.state();
        assert_eq!(state.open_panels(), names);
        assert!(!session.look().bones_visible, "{opens_another}");
    }
}

#[test]
fn panels_that_are_open_are_opened_again_by_their_names() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    for names in [
        vec!["skeleton", "keys"],
        vec!["findings", "curves"],
        vec!["explained", "sheet-light"],
        vec![],
    ] {
        let names: Vec<String> = names.into_iter().map(str::to_owned).collect();
        let Page { session, state, .. } = window.harness.state_mut();
        assert_eq!(state.open_these_panels(session, &names), [""; 0]);
        window.pass_on();
        assert_eq!(window.harness.state().state.open_panels(), names);
    }
    let Page { session, state, .. } = window.harness.state_mut();
    assert_eq!(state.open_these_panels(session, &["newer".to_owned()]), ["newer"]);
}
