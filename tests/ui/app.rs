//! One pass of the window after another: what a frame costs, and what is done while nothing moves.

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::time::Duration;

use bindpose::app::{App, AppOptions, SheetFailure, SheetJob};
use bindpose::session::{CameraCommand, File, FileCommand, LookCommand, PlayCommand, Session};
use bindpose::ui::{self, SheetRequest};
use egui_kittest::Harness;
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};

use crate::models::{moving, still};
use crate::page::{WIDE, whole_window};

/// More passes than there are pipelines.
const MANY: usize = 60;

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
    let gpu = create_render_state(default_wgpu_setup(), egui_wgpu::RendererOptions::PREDICTABLE);
    let session = Rc::new(RefCell::new(Session::new(true)));
    session.borrow_mut().apply(FileCommand::Add(vec![file]));
    let app: Shared<Option<App>> = Rc::default();
    let (of_window, of_app, of_session) = (Rc::clone(&app), gpu.clone(), Rc::clone(&session));
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
            let app = app.get_or_insert_with(|| App::new(ui.ctx(), &of_app, Rc::clone(&of_session), options));
            app.ui(&mut whole_window(ui));
        });
    (harness, session, app)
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

#[test]
fn a_window_at_rest_builds_pipelines_and_then_costs_nothing() {
    let (mut harness, session, app) = window(still("a.m3d"));
    let frames = || app.borrow().as_ref().expect("it ran").frames_rendered();
    harness.run();
    let drawn = frames();
    assert!(passes_until_at_rest(&mut harness) > 4, "one pipeline in a pass");
    assert_eq!(frames(), drawn, "no picture is drawn for them");
    session.borrow_mut().apply(LookCommand::ToggleLight);
    harness.ctx.request_repaint();
    harness.step();
    assert_eq!(frames(), drawn + 1);
    assert!(passes_until_at_rest(&mut harness) <= 2, "all are built");
}

#[test]
fn a_window_that_moves_builds_no_pipeline_for_later() {
    let (mut harness, session, _app) = window(moving("a.m3d"));
    // Each pass draws a frame, on a GPU of software.
    harness.set_size(egui::vec2(240.0, 180.0));
    session.borrow_mut().apply(PlayCommand::Play);
    harness.run_steps(MANY);
    session.borrow_mut().apply(PlayCommand::Pause);
    assert!(passes_until_at_rest(&mut harness) > 4);
}

#[test]
fn a_frame_is_told_what_the_cpu_spent_on_it() {
    let (mut harness, session, _app) = window(still("a.m3d"));
    harness.run();
    let cost = session.borrow().frame_cost();
    assert_eq!(cost.cpu_secs, Some(0.25), "the clock was looked at before and after");
}

const SHEET: SheetRequest = SheetRequest {
    size: [300, 200],
    cells: [2, 2],
    turntable: false,
    transparent: false,
};

/// Draws the next picture of a sheet into its place.
fn draw_next(app: &Shared<Option<App>>, job: &mut SheetJob) -> Result<(), SheetFailure> {
    let picture = app.borrow_mut().as_mut().expect("it ran").draw_next(job)?;
    job.place(&picture.pixels_blocking()?);
    Ok(())
}

fn begin(app: &Shared<Option<App>>, wanted: &SheetRequest) -> SheetJob {
    let app = app.borrow();
    app.as_ref().expect("it ran").begin_sheet(wanted).expect("has room")
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
    assert!(matches!(failure, SheetFailure::Changed), "{failure}");
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
    let wanted = SheetRequest {
        cells: [50, 50],
        ..SHEET
    };
    let refused = app.as_ref().expect("it ran").begin_sheet(&wanted).err();
    let told = refused.expect("it is refused").to_string();
    assert_eq!(
        told,
        "a sheet of 300 × 200 pixels has no room for 50 × 50 pictures of 8 × 8 pixels"
    );
}
