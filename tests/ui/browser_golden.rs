//! The pictures that browsers draw, drawn by the same app on a native device: one set of committed files for all of them.

use std::cell::RefCell;
use std::path::Path;
use std::rc::Rc;

use bindpose::app::App;
use bindpose::render::Picture;
use bindpose::scene::{Background, FrameOptions, Light, Overlay, Overlays, ViewMode};
use bindpose::session::{FileCommand, Session};
use bindpose::ui;
use egui::{Theme, Vec2};
use egui_kittest::Harness;
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};
use image::RgbaImage;

use crate::page::{new_app, whole_window};
use crate::picture::{sample_with_its_maps, share_that_differs, show_walk};

/// The window of the browser tests, and the size of their pictures: the camera stands where that window's panels let it.
const WINDOW: Vec2 = Vec2::new(960.0, 600.0);
const SIZE: [u32; 2] = [192, 144];
/// The ground of most of them.
const PLAIN_SRGB: [u8; 3] = [0x30, 0x34, 0x3c];

/// Another rasteriser, with other sums: a channel may be off by this much anywhere …
const TOLERANCE: u8 = 8;
/// … and by more in this share of the pixels: those on edges, where a sample falls to the other side, and in what mirrors, since the page has
/// filtered its light anew from more texels by then.
const SHARE: f64 = 0.02;
/// Of lines alone, which cover few pixels, devices choose others more often; and so they do of the texels that cast a soft shadow, and of
/// normals, which turn at each edge of a plate.
const SHARE_OF_LINES: f64 = 0.06;

fn plain(options: &mut FrameOptions) {
    options.background = Background::Color(PLAIN_SRGB);
    options.overlays = Overlays::none();
}

#[test]
fn a_native_device_draws_what_browsers_draw() {
    let gpu = create_render_state(default_wgpu_setup(), egui_wgpu::RendererOptions::PREDICTABLE);
    let session = Rc::new(RefCell::new(Session::new(true)));
    session.borrow_mut().apply(FileCommand::Add(sample_with_its_maps()));
    let opened = Rc::clone(&session);
    let app: Rc<RefCell<Option<App>>> = Rc::default();
    let (of_window, of_app) = (Rc::clone(&app), gpu.clone());
    let mut harness = Harness::builder()
        .with_size(WINDOW)
        .with_theme(Theme::Dark)
        .with_max_steps(12)
        .with_context_setup(ui::install)
        .renderer(WgpuTestRenderer::from_render_state(gpu.clone()))
        .build_ui(move |ui| {
            let mut app = of_window.borrow_mut();
            let app = app.get_or_insert_with(|| new_app(ui.ctx(), &of_app, &opened, false));
            app.ui(&mut whole_window(ui));
        });
    // As on the page: the camera stands where the first clip is seen whole.
    harness.run();
    show_walk(&mut session.borrow_mut(), 0.25);
    harness.run();

    let mut differing = Vec::new();
    let mut compare = |name: &str, adjust: &dyn Fn(&mut FrameOptions)| {
        let drawn = app
            .borrow_mut()
            .as_mut()
            .expect("it ran")
            .draw_snapshot(SIZE, Some(1), adjust);
        let pixels = drawn.and_then(Picture::pixels_blocking).expect("a small picture");
        let drawn = RgbaImage::from_raw(SIZE[0], SIZE[1], pixels).expect("as large as asked");
        let beside = format!("{}/browser-{name}-native.png", env!("CARGO_TARGET_TMPDIR"));
        drawn.save(&beside).expect("writes a PNG");
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/browser/golden/{name}.png"));
        let browsers = image::open(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let share = share_that_differs(&drawn, &browsers.into_rgba8(), TOLERANCE);
        if share
            > if ["lines", "mode-normal", "mode-shadow"].contains(&name) {
                SHARE_OF_LINES
            } else {
                SHARE
            }
        {
            differing.push(format!("{:.2} % of {beside}", 100.0 * share));
        }
    };
    for light in Light::ALL {
        compare(light.name(), &|options| options.light = light);
    }
    for mode in ViewMode::ALL.into_iter().skip(1) {
        compare(&format!("mode-{}", mode.name()), &|options| {
            plain(options);
            options.view_mode = mode;
        });
    }
    compare("sky", &|options| options.background = Background::Sky);
    compare("nothing", &|options| options.background = Background::None);
    compare("lines", &|options| {
        plain(options);
        options.view_mode = ViewMode::Material;
        for overlay in [Overlay::Wireframe, Overlay::Bounds, Overlay::Axes] {
            options.overlays.set(overlay, true);
        }
    });
    assert!(differing.is_empty(), "other than in browsers: {differing:#?}");
}
