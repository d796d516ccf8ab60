//! View modes, light, background, overlays, passes: each control does what it says.

use bindpose::image::{Image, encode_png};
use bindpose::scene::{Background, FrameCost, Light, Overlay, Pass, ViewMode};
use bindpose::session::{FileCommand, LookCommand, PassChoice, PassState, PlayCommand, QualityMode};
use egui::accesskit::{Role, Toggled};
use egui::{Key, Modifiers, pos2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::models::moving;
use crate::page::{WIDE, Window, window};

fn open() -> Window {
    window(WIDE, vec![moving("a.m3d")])
}

#[test]
fn the_menu_lists_all_view_modes_and_shows_one() {
    let mut window = open();
    window.click("View mode: Lit");
    for mode in ViewMode::ALL {
        assert!(window.shows(mode.label()), "{mode:?}");
    }
    window.click("Roughness");
    assert_eq!(window.session().look().view_mode, ViewMode::Roughness);
    assert!(
        window.shows("View mode: Roughness") && !window.shows("Depth"),
        "the menu is shut"
    );
}

#[test]
fn the_light_is_chosen_and_exposure_belongs_to_the_studio() {
    let mut window = open();
    window.click("Lighting: Studio");
    assert!(window.shows("Exposure"));
    window.click("Light: Book");
    assert_eq!(window.session().look().light, Light::Book);
    assert!(window.shows("Lighting: Book") && !window.shows("Exposure"));
    window.click("Split");
    assert_eq!(window.session().look().split, Some(0.5));
    assert!(
        window.shows("Lighting: Split") && window.shows("Exposure"),
        "half of it is the studio's"
    );
    window.click("Light: Studio");
    let look = window.session().look();
    assert_eq!((look.light, look.split), (Light::Studio, None));
}

/// Presses a slider at a share of its track.
fn press_slider(window: &mut Window, label: &str, share: f32) {
    let track = window.rect(label);
    let at = pos2(track.min.x + 6.0 + share * (track.width() - 12.0), track.center().y);
    window.click_at(at);
    // The next press is not the second of a double click.
    window.wait(0.6);
}

#[test]
fn sliders_follow_the_pointer_and_the_arrows_and_go_back_with_a_double_click() {
    let mut window = open();
    window.click("Lighting");
    press_slider(&mut window, "Exposure", 0.75);
    assert!((window.session().look().exposure_stops - 2.0).abs() < 0.05);
    press_slider(&mut window, "Environment", 0.5);
    assert!((window.session().look().environment_turn_radians - std::f32::consts::PI).abs() < 0.05);
    press_slider(&mut window, "Environment", 1.0);
    assert!(
        window.session().look().environment_turn_radians > 6.2,
        "a whole turn stays at its end"
    );

    let stops = window.session().look().exposure_stops;
    while window.focused().as_deref() != Some("Exposure") {
        window.tab(false);
    }
    window.press(Modifiers::NONE, Key::ArrowRight);
    assert!(window.session().look().exposure_stops > stops);
    assert_eq!(window.time_secs(), 0.0, "and no frame was stepped");

    let at = window.rect("Exposure").center();
    for _ in 0..2 {
        window.harness.hover_at(at);
        window.harness.drag_at(at);
        window.harness.drop_at(at);
    }
    window.pass_on();
    assert_eq!(window.session().look().exposure_stops, 0.0);
}

/// The panel tells where the ground lies, and its slider moves it by heights of the model.
#[test]
fn the_ground_is_told_and_moved() {
    let mut window = open();
    window.click("Lighting");
    let before = window.session().ground().height;
    let told = |window: &Window| {
        let slider = window.harness.get_by_role_and_label(Role::Slider, "Ground");
        slider.accesskit_node().data().value().map(str::to_owned)
    };
    assert_eq!(told(&window).as_deref(), Some("y 0"), "the model stands on it");
    press_slider(&mut window, "Ground", 0.75);
    let moved = window.session().look().ground_offset;
    let height = window.session().ground().height;
    assert!(moved > 0.0 && height > before, "{moved}: {height}");
    assert_ne!(told(&window).as_deref(), Some("y 0"));
    press_slider(&mut window, "Ground", 0.25);
    assert!(window.session().ground().height < before);
    let at = window.rect("Ground").center();
    for _ in 0..2 {
        window.harness.hover_at(at);
        window.harness.drag_at(at);
        window.harness.drop_at(at);
    }
    window.pass_on();
    assert_eq!(window.session().look().ground_offset, 0.0);
}

#[test]
fn the_background_is_chosen_and_its_colour_typed() {
    let mut window = open();
    window.click("Lighting");
    for (label, background) in [
        ("Background: Sky", Background::Sky),
        ("Background: None", Background::None),
        ("Background: Backdrop", Background::Backdrop),
    ] {
        window.click(label);
        assert_eq!(window.session().look().background, background);
    }
    window.click("Background: Colour");
    assert!(matches!(window.session().look().background, Background::Color(_)));
    window.click("Background colour: number");
    window.press(Modifiers::COMMAND, Key::A);
    window.type_text("#ff8000");
    assert_eq!(
        window.session().look().background,
        Background::Color([0xFF, 0x80, 0x00])
    );
    window.click("Background colour: saturation");
    let Background::Color(color) = window.session().look().background else {
        panic!("a colour")
    };
    assert_eq!(
        color.map(|channel| i32::from(channel) / 10),
        [12, 9, 6],
        "the middle of the square"
    );
}

#[test]
fn the_green_of_normal_maps_is_turned() {
    let mut window = open();
    window.click("Lighting");
    window.click("Normal maps: OpenGL");
    assert!(window.session().look().normal_green_flipped);
    window.click("Normal maps: DirectX");
    assert!(!window.session().look().normal_green_flipped);
}

#[test]
fn each_overlay_has_its_switch_and_lines_have_a_length() {
    let mut window = open();
    window.click("Lines over the model");
    for overlay in Overlay::ALL {
        let before = window.session().look().overlays.has(overlay);
        window.click(overlay.label());
        assert_eq!(window.session().look().overlays.has(overlay), !before, "{overlay:?}");
    }
    press_slider(&mut window, "Line length", 0.5);
    let length = window.session().look().overlays.line_length;
    assert!((length - 0.125).abs() < 0.01, "{length}");
    window.click("Vertex normals");
    assert!(window.shows("Line length"), "tangents are on");
    window.click("Vertex tangents");
    assert!(!window.shows("Line length"));
}

#[test]
fn passes_are_switches() {
    let mut window = open();
    window.click("Lighting");
    for pass in Pass::ALL {
        let toggled = |window: &Window| window.node(pass.label()).toggled();
        for (is_on, choice) in [(Toggled::False, PassChoice::Off), (Toggled::True, PassChoice::Auto)] {
            window.click(pass.label());
            assert_eq!(window.session().quality().choice(pass), choice);
            assert_eq!(toggled(&window), Some(is_on));
        }
    }
}

#[test]
fn what_is_less_fine_for_speed_is_said_and_can_be_insisted_on() {
    let mut window = open();
    let slow_frames = |window: &mut Window, count: usize| {
        for _ in 0..count {
            let session = &mut window.harness.state_mut().session;
            session.begin_pass(0.2);
            session.frame_drawn(FrameCost::default());
        }
    };
    window.apply(PlayCommand::Play);
    slow_frames(&mut window, 8);
    let at = window.rect("Lighting").center();
    window.harness.hover_at(at);
    window.wait(0.6);
    let note = "50 % of the pixels each way, no smooth edges: frames took 200 ms";
    assert!(
        window
            .named(|name| name.starts_with("Light and background") && name.ends_with(&format!("While it moves: {note}")))
            .len()
            == 1,
        "the dot is explained where it is seen, in the button's one tooltip"
    );
    window.click("Lighting");
    assert!(window.shows(note));
    slow_frames(&mut window, 24);
    window.pass_on();
    assert!(window.shows(
        "50 % of the pixels each way, no smooth edges, no ambient occlusion, coarser shadows: frames took 200 ms"
    ));
    assert_eq!(
        window.node("Ambient occlusion").data().description(),
        Some("Drawn only at rest")
    );
    window.click("Ambient occlusion");
    let quality = window.session().quality();
    assert_eq!(quality.choice(Pass::AmbientOcclusion), PassChoice::On);
    assert_eq!(quality.state(Pass::AmbientOcclusion), PassState::Drawn);
    slow_frames(&mut window, 8);
    window.click("Quality while it moves: Full");
    assert_eq!(window.session().quality().mode(), QualityMode::Full);
    assert!(!window.shows(note));
}

#[test]
fn the_time_of_each_pass_is_told_where_the_gpu_tells_it() {
    let mut window = open();
    window.click("Lighting");
    let of_passes = |window: &Window| window.named(|name| name.ends_with(" ms"));
    assert!(of_passes(&window).is_empty());
    let gpu_secs = Some([0.000_5, 0.000_25, 0.001, 0.0, 0.012]);
    let session = &mut window.harness.state_mut().session;
    session.frame_drawn(FrameCost {
        gpu_secs,
        ..FrameCost::default()
    });
    window.pass_on();
    for row in [
        "Shadow map 0.50 ms",
        "Normals and depth 0.25 ms",
        "Ambient occlusion 1.00 ms",
        "Ground contact 0.00 ms",
        "Picture 12.0 ms",
        "Together 13.8 ms",
    ] {
        assert!(window.shows(row), "{row} of {:?}", of_passes(&window));
    }
}

#[test]
fn numbers_stand_still_while_they_change() {
    let mut window = open();
    window.apply(LookCommand::SetOverlay(Overlay::Normals, true));
    window.click("Lighting");
    let places = |window: &Window| {
        let mut widgets = window.widgets();
        widgets.retain(|(name, _)| !name.starts_with("Light"));
        widgets.into_iter().map(|(_, rect)| rect).collect::<Vec<_>>()
    };
    let before = places(&window);
    for command in [
        LookCommand::SetExposure(-3.3),
        LookCommand::SetExposure(3.9),
        LookCommand::SetEnvironmentTurn(6.0),
        LookCommand::SetLight(Light::Studio),
    ] {
        window.apply(command);
        assert_eq!(places(&window), before, "{command:?}");
    }
}

#[test]
fn a_click_beside_a_popover_shuts_it_and_selects_nothing() {
    let mut window = open();
    window.click("Lighting");
    let middle = pos2(WIDE.x * 0.5, WIDE.y * 0.5);
    let click = |window: &mut Window| {
        window.click_at(middle);
        window.wait(0.6);
    };
    click(&mut window);
    assert!(!window.shows("Exposure") && window.session().submeshes().selected().is_none());
    click(&mut window);
    assert_eq!(
        window.session().submeshes().selected(),
        Some(0),
        "the model is in the middle"
    );
}

#[test]
fn a_picture_that_is_no_cube_is_no_sky() {
    let mut window = open();
    let image = Image::from_rgba8(1, 1, vec![0; 4], "PNG").expect("a picture");
    let png = encode_png(image.data(), 1, 1).expect("a PNG");
    window.apply(FileCommand::Add(vec![bindpose::session::File::new("flat.png", png)]));
    window.click("Lighting");
    assert!(!window.shows("Remove the sky"));
}
