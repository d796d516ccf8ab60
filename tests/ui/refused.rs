//! A model that the GPU cannot take, in the app on a software GPU.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use bindpose::app::App;
use bindpose::diagnostic::codes;
use bindpose::format::{Document, Vertex};
use bindpose::render::Picture;
use bindpose::session::{FileCommand, Session};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};
use egui_wgpu::{RendererOptions, WgpuSetup, wgpu};

use crate::models;
use crate::page::{WIDE, new_app, whole_window};

/// Bytes of the largest buffer of the device: room for 29 000 vertices.
const LARGEST_BUFFER: u64 = 1 << 20;

fn small_device() -> egui_wgpu::RenderState {
    let WgpuSetup::CreateNew(mut setup) = default_wgpu_setup() else {
        unreachable!("the harness makes its own device")
    };
    let of_harness = Arc::clone(&setup.device_descriptor);
    setup.device_descriptor = Arc::new(move |adapter: &wgpu::Adapter| {
        let mut descriptor = of_harness(adapter);
        descriptor.required_limits.max_buffer_size = LARGEST_BUFFER;
        descriptor.required_limits.max_storage_buffer_binding_size = LARGEST_BUFFER;
        descriptor
    });
    create_render_state(WgpuSetup::CreateNew(setup), RendererOptions::PREDICTABLE)
}

/// The box with another material and more vertices than the device holds; triangles use the first ones.
fn large() -> Document {
    let mut document = models::document();
    document.materials[0].diffuse = [1.0, 0.0, 0.0];
    let vertex: Vertex = document.vertices[0];
    document.vertices.resize(30_000, vertex);
    for subset in &mut document.subsets {
        subset.vertex_count = 30_000;
    }
    document
}

#[test]
fn a_model_that_the_gpu_refuses_leaves_the_one_before_drawn_picked_and_told() {
    let gpu = small_device();
    let session = Rc::new(RefCell::new(Session::new(true)));
    let app: Rc<RefCell<Option<App>>> = Rc::default();
    let (of_window, of_app, of_session) = (Rc::clone(&app), gpu.clone(), Rc::clone(&session));
    let mut harness = Harness::builder()
        .with_size(WIDE)
        .with_max_steps(30)
        .with_context_setup(bindpose::ui::theme::install)
        .renderer(WgpuTestRenderer::from_render_state(gpu.clone()))
        .build_ui(move |ui| {
            let mut app = of_window.borrow_mut();
            let app = app.get_or_insert_with(|| new_app(ui.ctx(), &of_app, &of_session, false));
            app.ui(&mut whole_window(ui));
        });
    let picture = || {
        let drawn = app
            .borrow_mut()
            .as_mut()
            .expect("it ran")
            .draw_snapshot([96, 64], None, |_| {});
        drawn.and_then(Picture::pixels_blocking).expect("a small picture")
    };
    session
        .borrow_mut()
        .apply(FileCommand::Add(vec![models::moving("small.m3d")]));
    harness.run();
    let (before, triangles) = (
        picture(),
        session.borrow().open_model().expect("open").model.mesh.indices.len(),
    );
    assert!(harness.query_by_label_contains("could not be").is_none());

    session
        .borrow_mut()
        .apply(FileCommand::Add(vec![models::file("large.m3d", &large())]));
    assert_eq!(session.borrow().error(), None, "it is sound");
    harness.run();
    {
        let session = session.borrow();
        let open = session.open_model().expect("open");
        assert_eq!(
            (open.file.base_name(), open.model.mesh.indices.len()),
            ("small.m3d", triangles)
        );
        let error = session.error().expect("shown");
        assert_eq!(
            (error.file_name.as_str(), error.diagnostic.code),
            ("large.m3d", codes::GPU_REFUSED.name)
        );
        assert_eq!(
            error.diagnostic.message,
            "This cannot be drawn here: the model's vertices need 1080000 bytes; this device holds 1048576 in one buffer."
        );
    }
    assert!(
        harness.query_by_label("large.m3d could not be drawn").is_some(),
        "a card"
    );
    assert!(
        picture() == before,
        "the mesh, its materials and its pose are those from before"
    );

    session
        .borrow_mut()
        .apply(FileCommand::Add(vec![models::still("next.m3d")]));
    harness.run();
    assert_eq!(session.borrow().error(), None);
    assert!(picture() != before);
}
