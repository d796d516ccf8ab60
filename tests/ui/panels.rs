//! Model facts, diagnostics, error card, the buttons of the bars.

use bindpose::anim::SkinView;
use bindpose::format::{Material, Subset};
use bindpose::model::{Handedness, JointIndex, UpAxis};
use bindpose::scene::{Light, Projection, Theme, ViewMode, ViewPreset};
use bindpose::session::{CameraCommand, ExportOptions, File, FileCommand, JointCommand, LookCommand};
use bindpose::ui::Request;
use egui::{Key, Modifiers, OutputCommand};

use crate::joint_tree::drawn;
use crate::models::{self, broken, moving, still};
use crate::page::{PHONE, WIDE, Window, phone, window};

/// A model with findings: a weight of 0.5 in all, and triangles out of winding.
fn odd() -> File {
    let mut document = models::skinned(&models::CLIPS);
    for vertex in &mut document.vertices {
        vertex.blend_weights = vertex.blend_weights.map(|weight| weight * 0.5);
    }
    models::file("odd.m3d", &document)
}

#[test]
fn the_model_panel_says_what_is_open() {
    let window = window(WIDE, vec![moving("in/a.m3d")]);
    for words in [
        "Bindpose",
        "a.m3d",
        "Dialect D3D12 book",
        "Vertices 24",
        "Triangles 12",
        "Bones 2",
        "Clips 3",
        "Size 2.00 × 4.00 × 1.00",
        "Painted, 12 triangles",
        "Handedness: Left found",
        "Up axis: Y found",
    ] {
        assert!(window.shows(words), "{words}");
    }
}

#[test]
fn handedness_and_up_axis_can_be_chosen_and_given_back() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.click("Handedness");
    window.click("Right-handed");
    assert_eq!(window.session().handedness_override(), Some(Handedness::Right));
    assert!(window.shows("Handedness: Right chosen"));
    window.click("Up axis");
    window.click("Z up");
    assert_eq!(window.session().up_axis_override(), Some(UpAxis::Z));
    assert!(window.shows("Up axis: Z chosen"));
    for row in ["Handedness", "Up axis"] {
        window.click(row);
        window.click("As found");
    }
    assert_eq!(
        (
            window.session().handedness_override(),
            window.session().up_axis_override()
        ),
        (None, None)
    );
    assert!(window.shows("Handedness: Left found") && window.shows("Up axis: Y found"));
}

fn findings(window: &Window) -> Vec<String> {
    let named = window.named(|name| name.starts_with("warning ") || name.starts_with("note "));
    named.into_iter().map(|(name, _)| name).collect()
}

#[test]
fn a_click_on_a_finding_shows_its_lines() {
    for mut window in [window(WIDE, vec![odd()]), phone(vec![odd()])] {
        if !window.named(|name| name == "Model facts").is_empty() {
            window.click("Model facts");
        }
        let notices = window.session().open_model().expect("open").diagnostics.clone();
        assert!(!notices.is_empty(), "the fixture is odd");
        window.click("Findings: ");
        let shown = findings(&window);
        assert_eq!(shown.len(), notices.len());
        let notice = notices
            .iter()
            .position(|notice| notice.position.is_some())
            .expect("one has a place");
        let line = notices[notice].position.expect("found by it").line.to_string();
        let lines = |window: &Window| window.named(|name| name.contains(" | ") && name.contains(&line)).len();
        assert_eq!(lines(&window), 0);
        window.click(&shown[notice]);
        assert_eq!(lines(&window), 1, "{shown:?} {line} {:?}", window.widgets());
        window.click(&shown[notice]);
        assert_eq!(lines(&window), 0);
        window.click("Close");
        assert!(findings(&window).is_empty());
    }
}

#[test]
fn a_sound_model_has_no_findings_and_says_so() {
    let mut document = models::document();
    for material in &mut document.materials {
        material.diffuse_map = Some("skin.dds".to_owned());
        material.normal_map = Some("bumps.dds".to_owned());
    }
    let mut window = window(WIDE, vec![models::file("a.m3d", &document)]);
    window.click("Findings: none");
    let said = "Nothing found; the D3D12 demo shows it, if these 2 maps lie beside it.";
    window.assert_shows(said);
    assert!(window.shows("Looked at: 24 vertices, 12 triangles, 0 bones, 0 clips, 0 keys."));
    window.click("Findings: none");
    assert!(!window.shows(said));
}

#[test]
fn of_a_glb_it_is_said_that_the_books_read_their_own_format_only() {
    let plain = window(WIDE, vec![still("a.m3d")]);
    let job = plain.session().export_job(&ExportOptions::default()).expect("a model");
    let glb = job.run().expect("it can be written");
    let mut window = window(WIDE, vec![File::new("a.glb", glb.bytes)]);
    window.click("Findings: none");
    window.assert_shows("Nothing found; the books' demos read .m3d only.");
}

#[test]
fn the_error_card_says_what_and_where_and_copies_it() {
    for mut window in [window(WIDE, vec![moving("a.m3d")]), phone(vec![moving("a.m3d")])] {
        window.apply(FileCommand::Add(vec![broken("in/bad.m3d")]));
        let error = window.session().error().cloned().expect("broken");
        let at = error.diagnostic.position.expect("somewhere");
        let place = format!("bad.m3d:{}:{}", at.line, at.column);
        let excerpt = window.named(|name| name.contains(&format!("{} | ", at.line)) && name.contains('^'));
        assert_eq!(excerpt.len(), 1, "{place}");
        for words in [
            &place,
            "bad.m3d could not be read",
            &error.diagnostic.message,
            error.diagnostic.code,
        ] {
            assert!(window.shows(words), "{words}");
        }
        assert!(window.shows("The model that was open stays open.") && window.shows("a.m3d"));

        let at = window.rect("Copy the error").center();
        window.harness.hover_at(at);
        window.harness.drag_at(at);
        let button = egui::PointerButton::Primary;
        window.button(at, button, false, Modifiers::NONE);
        window.harness.step();
        let at_once = copied_text(&window);
        window.pass_on();
        assert_eq!(at_once.as_deref(), Some(error.to_text().as_str()));

        assert!(window.session().error().is_some(), "it stays");
        window.click("Dismiss (Esc)");
        assert!(window.session().error().is_none() && !window.shows("bad.m3d could not be read"));
    }
}

fn copied_text(window: &Window) -> Option<String> {
    window
        .harness
        .output()
        .platform_output
        .commands
        .iter()
        .find_map(|command| match command {
            OutputCommand::CopyText(text) => Some(text.clone()),
            _ => None,
        })
}

#[test]
fn the_error_card_shows_what_is_no_text_byte_by_byte_on_one_line() {
    for mut window in [window(WIDE, vec![]), phone(vec![])] {
        let png = include_bytes!("../fixtures/bad/png.m3d").to_vec();
        window.apply(FileCommand::Add(vec![File::new("in/skin.m3d", png)]));
        assert!(window.shows("skin.m3d:1:1"));
        assert!(
            !window
                .named(|name| name.starts_with("Expected an m3d file header"))
                .is_empty()
        );
        let excerpt = window.named(|name| name.contains(" | ") && name.contains('^'));
        let (text, rect) = &excerpt[0];
        assert!(
            text.contains("00 | 89 50 4e 47 0d 0a 1a 0a 00 00 00 0d 49 48 44 52  .PNG........IHDR"),
            "{text}"
        );
        assert!(text.ends_with(" | ^^"), "{text}");
        // Bytes and mark, each on a line of its own even where it is wider than the card.
        assert!((30.0..45.0).contains(&rect.height()), "{rect}");
    }
}

#[test]
fn the_error_card_goes_with_escape_and_with_the_next_model() {
    let mut window = window(WIDE, vec![]);
    window.apply(FileCommand::Add(vec![broken("bad.m3d")]));
    assert!(window.shows("Nothing is open yet."));
    window.press(Modifiers::NONE, Key::Escape);
    assert!(!window.shows("bad.m3d could not be read"));
    window.apply(FileCommand::Add(vec![File::new("skin.dds", *b"x")]));
    assert!(window.shows("Nothing to open"));
    window.apply(FileCommand::Add(vec![moving("a.m3d")]));
    assert!(!window.shows("Nothing to open") && window.shows("a.m3d"));
}

#[test]
fn opening_is_asked_of_the_page_and_the_theme_is_another() {
    let mut wide = window(WIDE, vec![]);
    wide.click("Open files");
    wide.click("Light theme");
    assert_eq!(wide.harness.state().requests, [Request::PickFiles]);
    assert_eq!(wide.harness.state().state.theme, Some(Theme::Light));
    assert!(wide.shows("Dark theme"), "it is in force");

    let mut narrow = phone(vec![]);
    narrow.click("Open files");
    narrow.click("More");
    narrow.click("Light theme");
    assert_eq!(narrow.harness.state().requests, [Request::PickFiles]);
    assert_eq!(narrow.harness.state().state.theme, Some(Theme::Light));
}

#[test]
fn the_bar_looks_from_a_side_frames_and_turns() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let framed = *window.session().camera();
    window.click("View from");
    window.click("Left");
    let camera = window.session().camera();
    assert_eq!(
        (camera.yaw_radians, camera.pitch_radians),
        ViewPreset::Left.yaw_pitch_radians()
    );
    window.click("View from");
    window.click("Orthographic");
    assert_eq!(window.session().camera().projection, Projection::Orthographic);
    window.apply(CameraCommand::Reset);
    window.apply(CameraCommand::Pan { drag: glam::Vec2::ONE });
    window.click("Frame the model");
    assert_eq!(window.session().camera(), &framed);
    window.click("Turntable");
    assert!(window.session().turntable());
    window.click("Turntable");
    assert!(!window.session().turntable());
}

#[test]
fn behind_the_dots_of_a_phone_is_all_that_the_bar_has() {
    let mut window = phone(vec![moving("a.m3d")]);
    window.click("More");
    window.click("Lines over");
    window.click("Ground grid");
    assert!(!window.session().grid_visible());
    window.click("More");
    window.click("View from");
    window.click("Back");
    assert_eq!(window.session().camera().yaw_radians, std::f32::consts::PI);
    window.click("More");
    window.click("View mode");
    window.drag_sheet(-300.0);
    window.click("Depth");
    assert_eq!(window.session().look().view_mode, ViewMode::Depth);
    window.click("Lighting");
    window.click("Light: Book");
    assert_eq!(window.session().look().light, Light::Book);
    window.click("More");
    window.click("Picture");
    window.click("Save PNG");
    let size = [390, 844];
    let transparent = false;
    let picture = Request::SavePicture {
        size,
        transparent,
        aperture: 0.0,
    };
    assert_eq!(window.harness.state().requests, [picture]);
    window.click("More");
    window.click("Turntable");
    assert!(window.session().turntable());
    window.click("More");
    window.click("Help");
    assert!(window.shows("Space: play or pause"));
}

#[test]
fn the_menu_of_a_phone_copies_links() {
    let mut window = phone(vec![moving("a.m3d")]);
    for (name, embed) in [("Copy link", false), ("Copy embed", true)] {
        window.click("More");
        window.click(name);
        assert!(!window.shows(name), "the menu is shut");
        let last = window.harness.state().requests.last();
        assert_eq!(last, Some(&Request::CopyLink { embed }));
    }
}

#[test]
fn missing_and_damaged_maps_are_listed_with_the_materials_that_want_them() {
    let mut document = models::document();
    let painted = document.materials[0].clone();
    document.materials = (0..10)
        .map(|number| Material {
            name: format!("Part {number}"),
            diffuse_map: Some(format!("part{number}.png")),
            normal_map: (number < 3).then(|| "shared.png".to_owned()),
            ..painted.clone()
        })
        .collect();
    let damaged = File::new("in/part0.png", *b"\x89PNG\r\n\x1a\n");
    let mut window = window(WIDE, vec![models::file("a.m3d", &document), damaged]);
    let names = |window: &Window| window.named(|name| name.contains(".png is missing\n"));
    assert!(names(&window).is_empty(), "folded");
    window.click("Maps: 0 of 11, 10 missing, 1 unreadable");
    assert!(window.shows("part1.png is missing\ndiffuse map of Part 1"));
    assert_eq!(
        drawn(&window, "missing · ")[0],
        "missing · diffuse map of Part 1",
        "it is seen too"
    );
    let rows = names(&window);
    assert_eq!(rows.len(), 10, "no list that scrolls inside the panel: {rows:?}");
    let unreadable = window.named(|name| name.starts_with("in/part0.png could not be read\npart0.png: the PNG file"));
    assert_eq!(unreadable.len(), 1);
    assert!(unreadable[0].0.ends_with("\ndiffuse map of Part 0"), "{unreadable:?}");
    let panel = rows.iter().chain(&unreadable).all(|(_, rect)| rect.width() < 240.0);
    assert!(panel, "rows are as wide as the panel");

    let picture = bindpose::image::encode_png(&[255; 16], 2, 2).expect("two by two pixels");
    window.apply(FileCommand::Add(vec![File::new("shared.png", picture)]));
    window.click("Maps: 1 of 11, 9 missing, 1 unreadable");
    assert!(names(&window).is_empty());
    window.click("Show 1 warning");
    let finding = window.named(|name| name.starts_with("warning ") && name.contains("part0.png"));
    assert_eq!(finding.len(), 1, "it is a finding too");
    assert!(finding[0].0.ends_with("Go to Material Part 0"), "{finding:?}");
}

/// A model of these many subsets, each with a map that is missing.
fn without_maps(count: u32) -> File {
    let mut document = models::skinned(&models::CLIPS);
    let (painted, whole) = (document.materials[0].clone(), document.subsets[0]);
    let of_each = document.triangles.len() as u32 / count;
    document.materials = (0..count)
        .map(|number| Material {
            name: format!("Part {number}"),
            diffuse_map: Some(format!("part{number}.png")),
            ..painted.clone()
        })
        .collect();
    document.subsets = (0..count)
        .map(|id| Subset {
            id,
            face_start: id * of_each,
            face_count: of_each,
            ..whole
        })
        .collect();
    models::file("a.m3d", &document)
}

#[test]
fn the_first_screen_of_the_panel_has_facts_findings_clips_and_subsets_however_many_maps_are_missing() {
    let files = || vec![without_maps(4)];
    for (mut window, height) in [(window(WIDE, files()), WIDE.y), (phone(files()), PHONE.y)] {
        if !window.named(|name| name == "Model facts").is_empty() {
            window.click("Model facts");
        }
        let on_the_phone = height == PHONE.y;
        for words in [
            "Vertices 24",
            "Clips 3",
            "Findings: ",
            "Part 0, 3 triangles",
            "Maps: 0 of 4, 4 missing",
        ] {
            // The maps come last on the phone.
            if on_the_phone && words.starts_with("Maps") {
                continue;
            }
            let rect = window.rect(words);
            assert!(rect.max.y <= height, "{words} at {rect} of {height}");
        }
        assert!(window.named(|name| name.contains("is missing")).is_empty());
    }
    let mut window = window(WIDE, files());
    for is_open in [true, false] {
        window.click("Maps: ");
        assert_eq!(window.shows("part0.png is missing\ndiffuse map of Part 0"), is_open);
    }
}

#[test]
fn the_line_of_the_maps_is_whole_while_a_legend_is_open() {
    let mut window = window(WIDE, vec![without_maps(4)]);
    window.apply(JointCommand::Select(Some(JointIndex(0))));
    window.apply(LookCommand::SetSkinView(Some(SkinView::Weight)));
    let legend = window.rect("Legend: ");
    assert!(window.rect("Maps: ").max.y < legend.min.y);
}
