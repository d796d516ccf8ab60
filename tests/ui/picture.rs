//! Pictures of the whole window, drawn by the app itself on a software GPU, that somebody looked at.
//! `BLESS=1 cargo test --test ui picture` draws them anew.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use bindpose::anim::SkinView;
use bindpose::app::App;
use bindpose::model::JointIndex;
use bindpose::session::{
    Command, File, FileCommand, JointCommand, LookCommand, NameCommand, PlayCommand, Session, SubmeshCommand,
};
use bindpose::ui;
use bindpose::ui::theme::Contrast;
use egui::{Theme, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::NodeT as _;
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};
use image::RgbaImage;
use image::imageops::{self, FilterType};

use crate::models::broken;
use crate::page::{PHONE, WIDE, new_app, tab, whole_window};
use crate::rigs::chain;

/// Drivers round and antialias differently: a channel may be off by this much anywhere …
const TOLERANCE: u8 = 10;
/// … and by more in this share of the pixels, those on edges. The smallest panel, the title, covers 0.7 % of the window.
const SHARE: f64 = 0.001;

/// The figure as the page opens it.
pub(crate) fn sample_with_its_maps() -> Vec<File> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("web/sample");
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    paths.sort();
    paths
        .iter()
        .map(|path| {
            let bytes = std::fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            File::new(&path.file_name().expect("a file").to_string_lossy(), bytes)
        })
        .collect()
}

/// Which of the sample's clips is `Walk`.
const WALK: usize = 1;

/// Shows the sample's walk at a time.
pub(crate) fn show_walk(session: &mut Session, time_secs: f32) {
    let open = session.open_model().expect("the sample opens");
    assert_eq!(open.model.clips[WALK].name, "Walk");
    session.apply(PlayCommand::SelectClip(WALK));
    session.apply(PlayCommand::Seek { time_secs });
}

/// The window as it looks once it has settled, with the sample at a moment of its walk.
fn draw(size: Vec2, theme: Theme, coarse_pointer: bool, then: Vec<Command>) -> RgbaImage {
    draw_after(size, theme, coarse_pointer, then, &[])
}

/// Among clicks: the key.
const TAB: &str = "Tab";
/// Among clicks, before the beginning of a name: scrolled into view.
const SCROLLED: &str = "Scrolled: ";

/// The same after clicks on controls, by the beginnings of their names.
fn draw_after(size: Vec2, theme: Theme, coarse_pointer: bool, then: Vec<Command>, clicks: &[&str]) -> RgbaImage {
    draw_with(Contrast::Normal, size, theme, coarse_pointer, then, clicks)
}

/// The same with a contrast.
fn draw_with(
    contrast: Contrast,
    size: Vec2,
    theme: Theme,
    coarse_pointer: bool,
    then: Vec<Command>,
    clicks: &[&str],
) -> RgbaImage {
    let gpu = create_render_state(default_wgpu_setup(), egui_wgpu::RendererOptions::PREDICTABLE);
    let session = Rc::new(RefCell::new(Session::new(true)));
    session.borrow_mut().apply(FileCommand::Add(sample_with_its_maps()));
    show_walk(&mut session.borrow_mut(), 0.4);
    for command in then {
        session.borrow_mut().apply(command);
    }
    let mut app: Option<App> = None;
    let of_app = gpu.clone();
    let mut harness = Harness::builder()
        .with_size(size)
        .with_theme(theme)
        .with_max_steps(12)
        .with_render_cursor(false)
        .with_context_setup(ui::install)
        .renderer(WgpuTestRenderer::from_render_state(gpu))
        .build_ui(move |ui| {
            let app = app.get_or_insert_with(|| new_app(ui.ctx(), &of_app, &session, coarse_pointer));
            app.set_contrast(contrast);
            app.ui(&mut whole_window(ui));
            while app.step_export().0 {
                ui.ctx().request_repaint();
            }
        });
    harness.run();
    for start in clicks {
        if *start == TAB {
            harness.event(tab(&harness.ctx, false));
            harness.run();
            continue;
        }
        if let Some(start) = start.strip_prefix(SCROLLED) {
            node_of(&harness, start).scroll_to_me();
            harness.run();
            continue;
        }
        let at = rect_of(&harness, start).center();
        harness.hover_at(at);
        harness.drag_at(at);
        harness.drop_at(at);
        harness.run();
    }
    harness.render().unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
fn rect_of(harness: &Harness<'_>, start: &str) -> egui::Rect {
    node_of(harness, start).rect()
}

#[track_caller]
fn node_of<'h>(harness: &'h Harness<'_>, start: &str) -> egui_kittest::Node<'h> {
    let named = |node: &egui_kittest::Node<'_>| {
        node.accesskit_node()
            .label()
            .is_some_and(|name| name.starts_with(start))
    };
    let node = harness.root().children_recursive().find(named);
    node.unwrap_or_else(|| panic!("no {start:?}"))
}

fn compare(name: &str, actual: &RgbaImage) {
    let beside = |what: &str| PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("window-{name}-{what}.png"));
    actual.save(beside("actual")).expect("writes a PNG");
    // Half the size is a sixth of the bytes, and still shows every word.
    let actual = imageops::resize(actual, actual.width() / 2, actual.height() / 2, FilterType::Triangle);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/ui/golden/{name}.png"));
    if std::env::var_os("BLESS").is_some() {
        std::fs::create_dir_all(path.parent().expect("in a folder")).expect("makes the folder");
        actual.save(&path).expect("writes a PNG");
        return;
    }
    let expected = image::open(&path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
        .into_rgba8();
    let differs = share_that_differs(&actual, &expected, TOLERANCE);
    assert!(
        differs <= SHARE,
        "{:.2} % of {name} differ by more than {TOLERANCE}; see {}. \
         If the new picture is right: BLESS=1 cargo test --test ui picture",
        differs * 100.0,
        beside("actual").display()
    );
}

/// Draws what a picture's name tells of, and compares it: the window's size, its theme, whether it is for fingers.
fn shows(name: &str, then: Vec<Command>, clicks: &[&str]) {
    let mut words = name.split('-');
    let (size, coarse_pointer) = match words.next() {
        Some("wide") => (WIDE, false),
        Some("phone") => (PHONE, true),
        Some("low") => (Vec2::new(844.0, 390.0), true),
        _ => (Vec2::new(900.0, 700.0), false),
    };
    let theme = match words.next() {
        Some("light") => Theme::Light,
        _ => Theme::Dark,
    };
    compare(name, &draw_after(size, theme, coarse_pointer, then, clicks));
}

/// The part of the pixels, 0…1, of which a channel differs by more than `tolerance`.
pub(crate) fn share_that_differs(a: &RgbaImage, b: &RgbaImage, tolerance: u8) -> f64 {
    assert_eq!(a.dimensions(), b.dimensions());
    let differs =
        |(a, b): &(&image::Rgba<u8>, &image::Rgba<u8>)| a.0.iter().zip(&b.0).any(|(a, b)| a.abs_diff(*b) > tolerance);
    a.pixels().zip(b.pixels()).filter(differs).count() as f64 / f64::from(a.width() * a.height())
}

#[test]
fn wide_and_dark() {
    shows("wide-dark", vec![], &[]);
}

#[test]
fn the_menu_of_view_modes() {
    shows("wide-light-menu", vec![], &["View mode"]);
}

#[test]
fn wide_and_light_with_an_error() {
    let text = "***************m3d-File-Header***************\n#Materials 1\n#Vertices 3\n#Triangles many\n#Bones 0\n";
    let bad = File::new("soldier.m3d", text.as_bytes());
    shows("wide-light-error", vec![FileCommand::Add(vec![bad]).into()], &[]);
}

#[test]
fn phone_and_light() {
    shows("phone-light", vec![], &[]);
}

#[test]
fn both_lights_and_what_is_chosen_about_them() {
    let split = Command::Look(LookCommand::SetSplit(Some(0.5)));
    shows("wide-dark-light", vec![split], &["Lighting"]);
}

#[test]
fn what_is_saved_as_a_picture_and_as_a_contact_sheet() {
    shows("wide-light-picture", vec![], &["Picture"]);
    // Nobody draws it here.
    shows(
        "phone-dark-sheet",
        vec![],
        &["More", "Picture", "Scrolled: Save contact sheet", "Save contact sheet"],
    );
}

#[test]
fn maps_that_are_missing_and_one_that_is_damaged() {
    let mut files = sample_with_its_maps();
    // As another model, so that the maps of the first do not stay.
    let model = files
        .iter_mut()
        .find(|file| file.extension() == "m3d")
        .expect("a model");
    *model = File::new("other.m3d", model.bytes.clone());
    let mut maps = files.iter_mut().filter(|file| file.is_image());
    let damaged = maps.next().expect("a map");
    damaged.bytes = damaged.bytes.slice(..30);
    let kept = maps.next().expect("another map").path.clone();
    let damaged = damaged.path.clone();
    files.retain(|file| !file.is_image() || [&kept, &damaged].contains(&&file.path));
    let then = vec![
        FileCommand::Add(files).into(),
        PlayCommand::SelectClip(WALK).into(),
        PlayCommand::Seek { time_secs: 0.4 }.into(),
    ];
    shows("wide-light-maps", then, &[]);
}

#[test]
fn modes_that_are_on_and_a_message() {
    let then = || -> Vec<Command> {
        let mut files = sample_with_its_maps();
        files.push(crate::models::still("sketches/box.m3d"));
        vec![
            FileCommand::Add(files).into(),
            PlayCommand::SelectClip(WALK).into(),
            PlayCommand::Seek { time_secs: 0.4 }.into(),
            PlayCommand::SetRangeStart(Some(0.3)).into(),
            PlayCommand::SetRangeEnd(Some(0.9)).into(),
            PlayCommand::SetSpeed(0.5).into(),
            PlayCommand::ToggleBindPose.into(),
            SubmeshCommand::Solo(0).into(),
        ]
    };
    shows("wide-dark-modes", then(), &[]);
    shows("phone-light-modes", then(), &[]);
}

#[test]
fn a_blended_material_of_gltf() {
    let then = vec![FileCommand::Add(vec![crate::submeshes::leaf_and_glass()]).into()];
    shows("wide-dark-gltf-material", then, &["Glass, 1 triangle"]);
}

#[test]
fn a_finding_that_leads_to_a_vertex() {
    let clicks = ["Findings: ", "warning weights-not-normalized"];
    let then = || vec![FileCommand::Add(crate::findings::files()).into()];
    for (name, open) in [
        ("wide-dark-finding", &[][..]),
        ("phone-light-finding", &["Model facts"]),
    ] {
        shows(name, then(), &[open, &clicks].concat());
    }
}

#[test]
fn the_findings_with_the_lines_of_a_book() {
    let clicks = ["Findings: ", "D3D11 demo: "];
    let then = || vec![FileCommand::Add(crate::findings::files()).into()];
    let by_touch = ["Model facts", "Scrolled: Findings: "];
    for (name, open, clicks) in [
        ("wide-light-findings", &[][..], &clicks[..]),
        ("phone-dark-findings", &by_touch, &clicks[..1]),
        ("low-dark-findings", &by_touch, &clicks[..1]),
    ] {
        shows(name, then(), &[open, clicks].concat());
    }
}

#[test]
fn nothing_found() {
    let clicks = ["Findings: ", "D3D12 demo: "];
    shows("wide-dark-no-findings", vec![], &clicks);
}

#[test]
fn the_bytes_of_a_file_that_is_no_text() {
    let bytes = include_bytes!("../fixtures/bad/png.m3d").to_vec();
    let then = vec![FileCommand::Add(vec![File::new("soldier.m3d", bytes)]).into()];
    shows("wide-dark-bytes", then, &[]);
}

#[test]
fn a_subset_inspected_in_a_small_window() {
    let hidden = SubmeshCommand::SetVisible {
        submesh: 3,
        visible: false,
    };
    let then = vec![hidden.into()];
    shows("small-light-inspector", then, &["Trim, "]);
}

#[test]
fn overlays_in_the_sheet_of_a_phone() {
    let clicks = ["More", "Lines over", "Vertex normals"];
    shows("phone-dark-overlays", vec![], &clicks);
}

#[test]
fn the_dope_sheet() {
    let clicks = ["Dope sheet and", "Bone 2, "];
    shows("wide-dark-keys", vec![], &clicks);
}

#[test]
fn the_dope_sheet_with_folded_branches() {
    let joint = JointIndex(2);
    let folded = JointCommand::SetFolded { joint, folded: true };
    let frames: [&[usize]; 5] = [
        &[0, 60],
        &[0, 30, 60],
        &[0, 20, 40, 60],
        &[5, 15, 20, 25, 60],
        &[3, 33, 47],
    ];
    let then = || vec![FileCommand::Add(vec![chain(&frames)]).into(), folded.into()];
    for name in ["wide-dark-folded", "phone-light-folded"] {
        shows(name, then(), &["Dope sheet and"]);
    }
}

#[test]
fn curves_of_a_bone() {
    let clicks = ["Dope sheet and", "Bone 2, ", "Sheet: Curves"];
    shows("wide-light-curves", vec![], &clicks);
}

#[test]
fn the_dope_sheet_of_a_small_window_with_a_range() {
    let range = [0.3, 0.9].map(Some);
    let then = vec![
        PlayCommand::SetRangeStart(range[0]).into(),
        PlayCommand::SetRangeEnd(range[1]).into(),
    ];
    let clicks = ["Dope sheet and", "Sort by motion"];
    shows("small-light-keys", then, &clicks);
}

#[test]
fn the_dope_sheet_of_a_phone() {
    let clicks = ["Dope sheet and", "Bone 2, "];
    shows("phone-dark-keys", vec![], &clicks);
}

#[test]
fn curves_on_a_phone() {
    let clicks = ["Dope sheet and", "Bone 2, ", "Sheet: Curves"];
    shows("phone-light-curves", vec![], &clicks);
}

#[test]
fn clips_and_how_they_are_mixed() {
    let then = vec![PlayCommand::SetBlend { clip: 2, weight: 0.5 }.into()];
    shows("wide-dark-clips", then, &["Clip"]);
}

#[test]
fn how_a_clip_plays_on_a_phone() {
    shows("phone-light-playing", vec![], &["Speed"]);
}

#[test]
fn the_loop_gap_of_a_range() {
    let then = || {
        [
            PlayCommand::SetRangeStart(Some(0.3)).into(),
            PlayCommand::SetRangeEnd(Some(0.9)).into(),
        ]
    };
    // On a phone the list is scrolled to.
    for (name, clicks) in [
        ("wide-dark-loop-gap", &["Speed", "Loop gap of Bone "][..]),
        ("phone-light-loop-gap", &["Speed"]),
    ] {
        shows(name, then().into(), clicks);
    }
}

/// The bone over whose weights and numbers the pictures are taken: it moves and has children.
fn inspected() -> Vec<Command> {
    let bone = JointIndex(7);
    let named = |joint: u32, name: &str| NameCommand::Rename {
        joint: JointIndex(joint),
        name: name.to_owned(),
    };
    vec![
        named(0, "Hips").into(),
        named(7, "L clavicle").into(),
        JointCommand::Select(Some(bone)).into(),
        LookCommand::SetBonesVisible(true).into(),
        LookCommand::SetSkinView(Some(SkinView::Weight)).into(),
    ]
}

#[test]
fn the_tree_and_a_joint_on_dark_and_light() {
    for name in ["wide-dark-joint", "wide-light-joint"] {
        let mut then = inspected();
        then.push(LookCommand::SetLabelsVisible(true).into());
        shows(name, then, &["Panel: Skeleton"]);
    }
}

/// A vertex of the sample that both bones move, each by a third at least.
fn vertex_between(bones: [u32; 2]) -> u32 {
    let files = sample_with_its_maps();
    let model = files.iter().find(|file| file.extension() == "m3d").expect("a model");
    let document = bindpose::format::parse(&model.bytes)
        .expect("the sample is sound")
        .document;
    let is_between = |vertex: &bindpose::format::Vertex| {
        let influences = || vertex.blend_indices.into_iter().zip(vertex.blend_weights);
        bones
            .iter()
            .all(|bone| influences().any(|(index, weight)| index == *bone && weight > 0.33))
    };
    document.vertices.iter().position(is_between).expect("a vertex") as u32
}

#[test]
fn a_vertex_explained_in_a_small_window() {
    let mut then = inspected();
    then.retain(|command| !matches!(command, Command::Joint(JointCommand::Select(_))));
    then.push(JointCommand::SelectVertex(Some(vertex_between([10, 15]))).into());
    let clicks = ["Panel: Skeleton", "Explain"];
    shows("small-light-vertex", then, &clicks);
}

#[test]
fn a_vertex_explained_with_the_matrices_of_a_bone() {
    let then = vec![
        LookCommand::SetBonesVisible(true).into(),
        JointCommand::SelectVertex(Some(vertex_between([10, 15]))).into(),
    ];
    let clicks = ["Explain", "Unfold the matrices of Bone 10"];
    shows("wide-dark-vertex", then, &clicks);
}

#[test]
fn a_vertex_explained_in_the_sheet_of_a_phone() {
    let then = vec![JointCommand::SelectVertex(Some(vertex_between([10, 15]))).into()];
    let clicks = ["Show Vertex", "Explain", "Unfold the matrices of Bone 15"];
    // Higher than a phone, so that all of it is seen without scrolling.
    let size = Vec2::new(PHONE.x, 1_800.0);
    compare(
        "phone-light-vertex",
        &draw_after(size, Theme::Light, true, then, &clicks),
    );
}

#[test]
fn weights_and_what_their_colours_mean_on_a_phone() {
    shows("phone-dark-weights", inspected(), &[]);
}

#[test]
fn what_is_opened_on_a_phone_on_its_side() {
    shows("low-light-weights", inspected(), &["Show L clavicle"]);
    let then = vec![JointCommand::Select(Some(JointIndex(2))).into()];
    let clicks = ["Dope sheet and", "Sheet: Curves"];
    shows("low-dark-curves", then, &clicks);
}

#[test]
fn the_tree_in_the_sheet_of_a_phone() {
    let mut then = inspected();
    then.retain(|command| !matches!(command, Command::Joint(JointCommand::Select(_))));
    let clicks = ["Model facts", "Panel: Skeleton"];
    shows("phone-dark-tree", then, &clicks);
}

#[test]
fn windows_with_more_and_with_forced_contrast() {
    let size = Vec2::new(1100.0, 700.0);
    for (name, contrast, theme) in [
        ("more-dark", Contrast::More, Theme::Dark),
        ("more-light", Contrast::More, Theme::Light),
        ("forced-dark", Contrast::Forced, Theme::Dark),
        ("forced-light", Contrast::Forced, Theme::Light),
    ] {
        let mut then = inspected();
        then.truncate(3);
        compare(name, &draw_with(contrast, size, theme, false, then, &["Lighting"]));
    }
}

#[test]
fn the_ring_round_the_focused_control() {
    let size = Vec2::new(900.0, 600.0);
    let clicks = ["Lighting", TAB, TAB, TAB, TAB];
    compare(
        "small-light-focus",
        &draw_after(size, Theme::Light, false, vec![], &clicks),
    );
}

#[test]
fn the_menu_of_a_phone_on_its_side() {
    shows("low-dark-menu", vec![], &["More"]);
}

#[test]
fn an_error_on_a_phone_on_its_side() {
    let then = || vec![FileCommand::Add(vec![broken("soldier.m3d")]).into()];
    shows("low-light-error", then(), &[]);
    shows("phone-dark-error", then(), &[]);
}

#[test]
fn the_table_of_keys_with_what_is_on() {
    shows("small-dark-help", inspected(), &["Help (?)"]);
}

/// A golden that would let a panel go missing proves nothing.
#[test]
fn a_missing_panel_would_be_seen() {
    let with = draw(WIDE, Theme::Dark, false, vec![]);
    let mut without = with.clone();
    // The title's place, filled with the backdrop beside it.
    for y in 12..48 {
        for x in 12..280 {
            let backdrop = *with.get_pixel(x + 300, y);
            without.put_pixel(x, y, backdrop);
        }
    }
    assert!(share_that_differs(&with, &without, TOLERANCE) > 2.0 * SHARE);
}

#[test]
fn the_panel_that_exports() {
    let edits = ["Export… (E)", "Format: .m3d D3D11", "Close the loop", "Reduce keys"];
    shows("wide-dark-export", vec![], &edits);
    let page = ["More", "Export…"];
    shows("phone-light-export", vec![], &page);
}

#[test]
fn ghosts_and_trails_with_their_chips() {
    let then = || -> Vec<Command> {
        let plan = bindpose::anim::GhostPlan {
            before: 3,
            after: 3,
            step_frames: 5,
        };
        vec![
            LookCommand::SetGhosts(Some(plan)).into(),
            LookCommand::ToggleTrail(JointIndex(12)).into(),
            LookCommand::ToggleTrail(JointIndex(38)).into(),
        ]
    };
    shows("wide-light-ghosts", then(), &["Lines over"]);
    shows("phone-dark-ghosts", then(), &[]);
}
