//! One pass of the window after another: what a frame costs, and what is done while nothing moves.

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::time::Duration;

use bindpose::app::{App, AppOptions, ContactSheetFailure, ContactSheetJob};
use bindpose::scene::Theme;
use bindpose::session::{
    CameraCommand, ExportCommand, ExportOptions, File, FileCommand, LookCommand, PlayCommand, QualityCommand, Session,
};
use bindpose::ui::{self, ContactSheetRequest, UiState};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};

use crate::models::{moving, still};
use crate::page::{WIDE, whole_window};

/// More passes than there are pipelines, and pieces of work on the light. By this clock a pass does one of them.
const MANY: usize = 800;
/// As many as a window draws while it moves.
const SOME: usize = 60;

thread_local! {
    static NOW_SECS: Cell<f64> = const { Cell::new(100.0) };
}

/// A clock that goes on by a quarter of a second each time that somebody looks at it.
fn now_secs() -> f64 {
    NOW_SECS.set(NOW_SECS.get() + 0.25);
    NOW_SECS.get()
}

type Shared<T> = Rc<RefCell<T>>;

fn window(file: File) -> (Harness<'static>, Shared<Session>, Shared<Option<App>>) {
    let session = Rc::new(RefCell::new(Session::new(true)));
    session.borrow_mut().apply(FileCommand::Add(vec![file]));
    let (harness, app) = start(&session, &Rc::default());
    (harness, session, app)
}

/// A start on a GPU and a context of its own.
fn start(session: &Shared<Session>, state: &Shared<UiState>) -> (Harness<'static>, Shared<Option<App>>) {
    let gpu = create_render_state(default_wgpu_setup(), egui_wgpu::RendererOptions::PREDICTABLE);
    // The CPU draws: nothing is refined unless a test asks for it.
    if !session.borrow().quality().samples_are_chosen() {
        session.borrow_mut().apply(QualityCommand::SetSamples(Some(1)));
    }
    let (session, state) = (Rc::clone(session), Rc::clone(state));
    let app: Shared<Option<App>> = Rc::default();
    let (of_window, of_app) = (Rc::clone(&app), gpu.clone());
    let options = AppOptions {
        coarse_pointer: false,
        now_secs,
    };
    let harness = Harness::builder()
        .with_size(WIDE)
        .with_max_steps(30)
        .with_context_setup(ui::install)
        .renderer(WgpuTestRenderer::from_render_state(gpu))
        .build_ui(move |ui| {
            let mut app = of_window.borrow_mut();
            let app =
                app.get_or_insert_with(|| App::new(ui.ctx(), &of_app, Rc::clone(&session), Rc::clone(&state), options));
            app.ui(&mut whole_window(ui));
        });
    (harness, app)
}

/// Passes until no other is due at any time. Returns how many.
fn passes_until_at_rest(harness: &mut Harness<'static>) -> usize {
    harness.run();
    let mut passes = 0;
    let delay = |harness: &Harness<'_>| harness.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay;
    while delay(harness) < Duration::from_secs(1) {
        harness.step();
        passes += 1;
        assert!(passes < MANY, "{:?}", harness.ctx.repaint_causes());
    }
    passes
}

/// What the page does between passes, until nothing is left. Returns how many turns had something to do.
fn prepare(harness: &mut Harness<'static>, app: &Shared<Option<App>>) -> usize {
    for turns in 0..MANY {
        let is_left = {
            let mut app = app.borrow_mut();
            let app = app.as_mut().expect("it ran");
            assert_eq!(app.take_turn(), None, "no file is written");
            app.next_turn_in_secs().is_some()
        };
        if harness.ctx.has_requested_repaint() {
            passes_until_at_rest(harness);
        }
        if !is_left {
            return turns;
        }
    }
    panic!("there is no end to it");
}

#[test]
fn a_window_at_rest_builds_pipelines_and_then_costs_nothing() {
    let (mut harness, session, app) = window(still("a.m3d"));
    let frames = || app.borrow().as_ref().expect("it ran").frames_rendered();
    passes_until_at_rest(&mut harness);
    let (drawn, passed) = (frames(), harness.ctx.cumulative_pass_nr());
    assert!(prepare(&mut harness, &app) > 4, "one pipeline in a turn");
    assert_eq!(
        frames(),
        drawn + 1,
        "no picture is drawn for them, but one for the light, which is then finer"
    );
    let passes = harness.ctx.cumulative_pass_nr() - passed;
    assert!(
        passes <= 6,
        "{passes} passes: the panels are drawn for that picture alone"
    );
    session.borrow_mut().apply(LookCommand::ToggleLight);
    harness.ctx.request_repaint();
    harness.step();
    assert_eq!(frames(), drawn + 2);
    passes_until_at_rest(&mut harness);
    assert!(prepare(&mut harness, &app) <= 1, "all are built");
}

#[test]
fn a_window_that_moves_builds_no_pipeline_for_later() {
    let (mut harness, session, app) = window(moving("a.m3d"));
    // Each pass draws a frame, on a GPU of software.
    harness.set_size(egui::vec2(240.0, 180.0));
    session.borrow_mut().apply(PlayCommand::Play);
    harness.run_steps(SOME);
    let is_left = || app.borrow().as_ref().expect("it ran").next_turn_in_secs().is_some();
    assert!(!is_left(), "not while it moves");
    session.borrow_mut().apply(PlayCommand::Pause);
    harness.run();
    assert!(is_left() && prepare(&mut harness, &app) > 4);
}

#[test]
fn a_frame_is_told_what_the_cpu_spent_on_it() {
    let (mut harness, session, _app) = window(still("a.m3d"));
    harness.run();
    let cost = session.borrow().frame_cost();
    assert_eq!(cost.cpu_secs, Some(0.25), "the clock was looked at before and after");
}

const SHEET: ContactSheetRequest = ContactSheetRequest {
    size: [300, 200],
    cells: [2, 2],
    turntable: false,
    transparent: false,
};

/// Draws the next picture of a sheet into its place.
fn draw_next(app: &Shared<Option<App>>, job: &mut ContactSheetJob) -> Result<(), ContactSheetFailure> {
    let picture = app.borrow_mut().as_mut().expect("it ran").draw_next(job)?;
    job.place(&picture.pixels_blocking()?);
    Ok(())
}

fn begin(app: &Shared<Option<App>>, wanted: &ContactSheetRequest) -> ContactSheetJob {
    let app = app.borrow();
    app.as_ref()
        .expect("it ran")
        .begin_contact_sheet(wanted)
        .expect("has room")
}

#[test]
fn a_contact_sheet_shows_the_view_as_it_was_while_the_window_goes_on() {
    let (mut harness, session, app) = window(moving("a.m3d"));
    harness.run();
    let [undisturbed, disturbed] = [false, true].map(|disturbs| {
        let mut job = begin(&app, &SHEET);
        while job.progress()[0] < job.progress()[1] {
            draw_next(&app, &mut job).expect("draws");
            if disturbs {
                let mut session = session.borrow_mut();
                session.apply(PlayCommand::Seek { time_secs: 0.5 });
                session.apply(LookCommand::ToggleLight);
                session.apply(CameraCommand::Orbit {
                    yaw_radians: 1.0,
                    pitch_radians: 0.1,
                });
                drop(session);
                harness.step();
            }
        }
        assert_eq!(job.progress(), [4, 4]);
        job.into_png().expect("encodes")
    });
    assert!(undisturbed == disturbed);
    let sheet = image::load_from_memory(&undisturbed).expect("a picture");
    assert_eq!((sheet.width(), sheet.height()), (300, 200));
    let time_secs = session.borrow().playback().time_secs();
    assert_eq!(time_secs, 0.5, "the window's time is its own");
    // The next one begins from what is seen now.
    let mut job = begin(&app, &SHEET);
    (0..4).for_each(|_| draw_next(&app, &mut job).expect("draws"));
    assert!(job.into_png().expect("encodes") != undisturbed);
}

#[test]
fn a_contact_sheet_ends_when_another_model_is_opened() {
    let (mut harness, session, app) = window(moving("a.m3d"));
    harness.run();
    let mut job = begin(&app, &SHEET);
    draw_next(&app, &mut job).expect("draws");
    session.borrow_mut().apply(FileCommand::Add(vec![still("b.m3d")]));
    let failure = draw_next(&app, &mut job).expect_err("the GPU has another model");
    assert!(matches!(failure, ContactSheetFailure::Changed), "{failure}");
    assert_eq!(
        session.borrow().open_model().map(|open| open.file.base_name()),
        Some("b.m3d")
    );
    // A model without a clip is seen from all sides.
    let mut job = begin(&app, &SHEET);
    (0..4).for_each(|_| draw_next(&app, &mut job).expect("draws"));
}

#[test]
fn a_contact_sheet_without_room_is_refused() {
    let (mut harness, _session, app) = window(still("a.m3d"));
    harness.run();
    let app = app.borrow();
    let wanted = ContactSheetRequest {
        cells: [50, 50],
        ..SHEET
    };
    let refused = app.as_ref().expect("it ran").begin_contact_sheet(&wanted).err();
    let told = refused.expect("it is refused").to_string();
    assert_eq!(
        told,
        "a sheet of 300 × 200 pixels has no room for 50 × 50 pictures of 8 × 8 pixels"
    );
}

#[test]
fn passes_go_on_until_the_mean_of_a_picture_at_rest_is_complete() {
    let session = Rc::new(RefCell::new(Session::new(true)));
    session.borrow_mut().apply(FileCommand::Add(vec![moving("a.m3d")]));
    session.borrow_mut().apply(QualityCommand::SetSamples(Some(12)));
    let (mut harness, app) = start(&session, &Rc::default());
    // Ends when no pass is asked for.
    harness.run();
    let drawn = |app: &Shared<Option<App>>| app.borrow().as_ref().map(|app| (app.samples(), app.frames_rendered()));
    let (samples, frames) = drawn(&app).expect("it runs");
    assert_eq!(samples, 12);
    session.borrow_mut().apply(CameraCommand::Orbit {
        yaw_radians: 0.3,
        pitch_radians: 0.0,
    });
    harness.step();
    assert_eq!(drawn(&app), Some((1, frames + 1)));
    harness.run();
    assert_eq!(drawn(&app), Some((12, frames + 1)));
}

#[test]
fn another_start_has_the_theme_and_the_panels_of_the_one_before() {
    let session = Rc::new(RefCell::new(Session::new(true)));
    session.borrow_mut().apply(FileCommand::Add(vec![moving("a.m3d")]));
    let state: Shared<UiState> = Rc::default();
    let (mut harness, first) = start(&session, &state);
    harness.run();
    for button in ["Light theme", "Help (?)", "Dope sheet and curves"] {
        harness.get_by_label(button).click();
        harness.run();
    }
    let shows = |harness: &Harness<'static>| {
        ["Dark theme", "Space: play or pause", "Close the dope sheet"]
            .map(|label| harness.query_by_label(label).is_some())
    };
    let before = shows(&harness);
    assert!(before[0] && before[1], "{before:?}");
    drop((harness, first));
    let (mut harness, _second) = start(&session, &state);
    harness.step();
    assert!(
        !harness.ctx.global_style().visuals.dark_mode,
        "light from the first frame on"
    );
    harness.run();
    assert_eq!(shows(&harness), before);
    assert_eq!(
        session.borrow().open_model().map(|open| open.file.base_name()),
        Some("a.m3d")
    );
    assert_eq!(state.borrow().theme, Some(Theme::Light));
}

#[test]
fn an_export_goes_on_between_passes_until_it_waits_for_a_command() {
    let (mut harness, session, app) = window(still("a.m3d"));
    passes_until_at_rest(&mut harness);
    session
        .borrow_mut()
        .apply(ExportCommand::Plan(Some(Box::new(ExportOptions::default()))));
    let go_on = || {
        let mut files = 0;
        for _ in 0..MANY {
            let mut app = app.borrow_mut();
            let app = app.as_mut().expect("it ran");
            if app.next_turn_in_secs() != Some(0.0) {
                return files;
            }
            files += usize::from(app.take_turn().is_some());
        }
        panic!("there is no end to it");
    };
    assert_eq!(go_on(), 0, "planned");
    let plan = |session: &Session| session.export().is_some_and(|export| export.plan.is_some());
    assert!(plan(&session.borrow()));
    session.borrow_mut().apply(ExportCommand::Save);
    harness.ctx.request_repaint();
    passes_until_at_rest(&mut harness);
    assert_eq!(go_on(), 1, "it was written");
}

thread_local! {
    static MILLISECONDS: Cell<f64> = const { Cell::new(0.0) };
}

/// A clock that goes on by 50 milliseconds each time that somebody looks at it, as if a step took so long.
fn a_step_later() -> f64 {
    MILLISECONDS.set(MILLISECONDS.get() + 50.0);
    MILLISECONDS.get() * 1e-3
}

#[test]
fn an_export_goes_on_by_time_however_long_frames_take() {
    let figure = include_bytes!("../../web/sample/figure.m3d").to_vec();
    let session = Rc::new(RefCell::new(Session::new(true)));
    session
        .borrow_mut()
        .apply(FileCommand::Add(vec![File::new("figure.m3d", figure)]));
    let options = ExportOptions {
        reduce: Some(0.001),
        ..ExportOptions::default()
    };
    session.borrow_mut().apply(ExportCommand::Plan(Some(Box::new(options))));
    let gpu = create_render_state(default_wgpu_setup(), egui_wgpu::RendererOptions::PREDICTABLE);
    let options = AppOptions {
        coarse_pointer: false,
        now_secs: a_step_later,
    };
    let mut app = App::new(
        &egui::Context::default(),
        &gpu,
        Rc::clone(&session),
        Rc::default(),
        options,
    );
    let mut steps_after = |frame_ms: f64| {
        MILLISECONDS.set(MILLISECONDS.get() + frame_ms);
        let begun = MILLISECONDS.get();
        assert!(app.step_export().0, "there is more to do");
        // It looks at the clock as it begins and as it ends, too.
        (MILLISECONDS.get() - begun) / 50.0 - 2.0
    };
    assert_eq!(steps_after(500.0), 1.0, "what came before it was no frame");
    assert_eq!(steps_after(2.0), 2.0, "a quick frame");
    assert_eq!(steps_after(70.0), 3.0, "half of the time");
    assert_eq!(steps_after(5000.0), 6.0, "it answers");
}
