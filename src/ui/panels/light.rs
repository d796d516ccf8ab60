//! The light, the background, the passes that cost time, and how fine a moving picture is.

use egui::{FontId, Pos2, Response, RichText, Role, Ui, vec2};

use super::cost::SteadyCost;
use crate::actions::{self, Control};
use crate::scene::{Background, Detail, Ground, Light, Pass, TimedPass};
use crate::session::{
    FileCommand, LookCommand, Lowered, MAX_EXPOSURE_STOPS, MAX_GROUND_OFFSET, PassChoice, PassState, QualityCommand,
    QualityMode, Session,
};
use crate::ui::cx::Cx;
use crate::ui::kit::icons::Icon;
use crate::ui::kit::theme::Tokens;
use crate::ui::kit::wording::{measured, milliseconds, shortened};
use crate::ui::kit::{
    MenuLine, Row, Slider, color_picker, control_size, keyed_section_name, menu_item, named, noted_switch_row,
    push_button, section_name, segmented, switch_row, tell_node, value_row,
};
use crate::ui::window::panel::popover_gap;

/// The first colour of a plain background: the middle of the backdrop.
const FIRST_COLOR_DARK: [u8; 3] = [0x33, 0x38, 0x42];
const FIRST_COLOR_LIGHT: [u8; 3] = [0xEB, 0xED, 0xF0];

/// The button's label: the light that is on. With a sky the studio's light is the sky's.
pub(in crate::ui) fn label(session: &Session) -> &'static str {
    match (session.look().split, session.look().light) {
        (Some(_), _) => "Split",
        (None, Light::Studio) if session.sky().is_some() => "Sky",
        (None, light) => light.label(),
    }
}

/// Puts a dot at the button's icon while the device is too slow for all the detail, and says so below the tooltip's words.
pub(in crate::ui) fn mark_button(ui: &Ui, session: &Session, button: Response, icon: Pos2, words: &str) -> Response {
    let quality = session.quality();
    let lowered = quality.lowered().filter(|_| quality.mode() == QualityMode::Auto);
    let Some(lowered) = lowered else {
        return button.on_hover_text(words);
    };
    let note = format!("While it moves: {}", lowered_words(&lowered));
    ui.painter()
        .circle_filled(icon + vec2(7.0, -7.0), 3.0, Tokens::of(ui).warning);
    // The note changes while one listens.
    tell_node(&button, |node| node.set_description(words));
    button.on_hover_text(format!("{words}\n{note}"))
}

pub(in crate::ui) fn show(ui: &mut Ui, cx: &mut Cx<'_, SteadyCost>) {
    let look = cx.session.look();
    keyed_section_name(ui, "Light", actions::OTHER_LIGHT.key());
    let lights = Light::ALL.map(|light| (light, light.label()));
    let in_force = look.split.is_none().then_some(look.light);
    if let Some(light) = segmented(ui, "Light", &lights, in_force) {
        cx.push(LookCommand::SetSplit(None));
        cx.push(LookCommand::SetLight(light));
    }
    ui.add_space(4.0);
    let split = look.split.is_some();
    let response = switch_row(ui, "Split: both side by side", "", split);
    if named(response, Control::new("split")).clicked() {
        let middle = (!split).then_some(0.5);
        cx.push(LookCommand::SetSplit(middle));
    }
    if split || look.light == Light::Studio {
        exposure(ui, cx);
    }
    environment_turn(ui, cx);
    ground(ui, cx);
    popover_gap(ui);
    background(ui, cx);
    popover_gap(ui);
    section_name(ui, "Green of normal maps");
    let directions = [(false, "DirectX ↓"), (true, "OpenGL ↑")];
    if let Some(flipped) = segmented(ui, "Normal maps", &directions, Some(look.normal_green_flipped)) {
        cx.push(LookCommand::SetNormalGreenFlipped(flipped));
    }
    popover_gap(ui);
    passes(ui, cx);
    popover_gap(ui);
    quality(ui, cx);
    pass_times(ui, cx);
}

fn exposure<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let stops = cx.session.look().exposure_stops;
    // A true minus sign, as wide as the plus.
    let text = format!("{}{:.1} EV", if stops < -0.04 { '−' } else { '+' }, stops.abs());
    let slider = Slider::new(
        ("Exposure", Control::new("exposure")),
        stops,
        -MAX_EXPOSURE_STOPS..=MAX_EXPOSURE_STOPS,
        &text,
    );
    if let Some(stops) = slider.reset_to(0.0).show(ui) {
        cx.push(LookCommand::SetExposure(stops));
    }
}

/// Where the ground lies: its height in the world, and how far it was moved.
fn ground<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let offset = cx.session.look().ground_offset;
    let Ground { height, cell } = cx.session.ground();
    // A rounding error of a sole is no height.
    let height = if height.abs() < 1e-3 * cell { 0.0 } else { height };
    let height = format!("y {}", measured(height));
    let slider = Slider::new(
        ("Ground", Control::new("ground")),
        offset,
        -MAX_GROUND_OFFSET..=MAX_GROUND_OFFSET,
        &height,
    );
    if let Some(heights) = slider.reset_to(0.0).show(ui) {
        cx.push(LookCommand::SetGroundOffset(heights));
    }
}

fn environment_turn<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let degrees = cx.session.look().environment_turn_radians.to_degrees();
    let text = format!("{degrees:.0}°");
    let slider = Slider::new(
        ("Environment", Control::new("environment")),
        degrees,
        0.0..=360.0,
        &text,
    );
    if let Some(degrees) = slider.show(ui) {
        // 360° would come back as 0°, and the knob would jump to the other end.
        cx.push(LookCommand::SetEnvironmentTurn(degrees.min(359.9).to_radians()));
    }
}

fn background<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let in_force = cx.session.look().background;
    section_name(ui, "Background");
    let first_color = if ui.visuals().dark_mode {
        FIRST_COLOR_DARK
    } else {
        FIRST_COLOR_LIGHT
    };
    let color = match in_force {
        Background::Color(color) => color,
        _ => first_color,
    };
    let choices = [
        (Background::Backdrop, "Backdrop"),
        (Background::Sky, "Sky"),
        (Background::Color(color), "Colour"),
        (Background::None, "None"),
    ];
    if let Some(background) = segmented(ui, "Background", &choices, Some(in_force)) {
        cx.push(LookCommand::SetBackground(background));
    }
    if let Some(file) = cx.session.sky_file() {
        sky_row(ui, cx, file.base_name());
    }
    for file in cx.session.skies() {
        let words = format!("Use {} as sky", shortened(file.base_name(), 30));
        if cx.session.sky_file() != Some(file) && menu_item(ui, &words, MenuLine::Action).clicked() {
            cx.push(FileCommand::UseSky(file.path.clone()));
        }
    }
    if let Background::Color(color) = in_force {
        ui.add_space(8.0);
        if let Some(color) = color_picker(ui, "Background colour", color) {
            cx.push(LookCommand::SetBackground(Background::Color(color)));
        }
    }
}

/// The name of the sky that was dropped, and a button that takes it away.
fn sky_row<S>(ui: &mut Ui, cx: &mut Cx<'_, S>, name: &str) {
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        let tokens = Tokens::of(ui);
        let height = control_size(ui);
        let width = ui.available_width() - height - 6.0;
        let mut row = Row::sized(ui, vec2(width, height));
        row.left("Sky", tokens.muted);
        row.left += 10.0;
        row.name(name, tokens.text);
        row.told(Role::Label, format!("Sky {name}"));
        if push_button(ui, Icon::Close, "Remove the sky").clicked() {
            cx.push(FileCommand::ClearSky);
        }
    });
}

/// The passes: which are on, and for which the device is too slow.
fn passes<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    section_name(ui, "Passes");
    let quality = cx.session.quality();
    for pass in Pass::ALL {
        let state = quality.state(pass);
        let (choice, hint) = match state {
            PassState::Drawn => (PassChoice::Off, "Leave it out"),
            PassState::Off => (PassChoice::Auto, "Draw it"),
            PassState::TooSlow => (
                PassChoice::On,
                "Too slow here while the picture moves, so it is drawn at rest. Draw it always, however long frames take",
            ),
        };
        let too_slow = state == PassState::TooSlow;
        let note = if too_slow { "only at rest" } else { "" };
        let note_style = (note, FontId::proportional(12.0), Tokens::of(ui).warning);
        let row = noted_switch_row(ui, pass.label(), note_style, state != PassState::Off);
        if too_slow {
            tell_node(&row, |node| node.set_description("Drawn only at rest"));
        }
        if named(row, Control::new(pass.name())).on_hover_text(hint).clicked() {
            cx.push(QualityCommand::SetPass(pass, choice));
        }
    }
}

/// How finely the picture is drawn while it moves: what was chosen, and what is lowered.
fn quality<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    section_name(ui, "While it moves");
    let quality = cx.session.quality();
    let choices = QualityMode::ALL.map(|mode| (mode, mode.label()));
    if let Some(mode) = segmented(ui, "Quality while it moves", &choices, Some(quality.mode())) {
        cx.push(QualityCommand::SetMode(mode));
    }
    if let Some(lowered) = quality.lowered() {
        ui.add_space(4.0);
        let small = RichText::new(lowered_words(&lowered)).font(FontId::proportional(12.0));
        let color = if quality.mode() == QualityMode::Auto {
            Tokens::of(ui).warning
        } else {
            Tokens::of(ui).muted
        };
        ui.label(small.color(color));
    }
}

/// `50 % of the pixels each way, coarser ambient occlusion: frames took 83 ms`.
fn lowered_words(lowered: &Lowered) -> String {
    let mut parts = Vec::new();
    if lowered.scale < 1.0 {
        parts.push(format!("{:.0} % of the pixels each way", lowered.scale * 100.0));
    }
    if lowered.without_smooth_edges {
        parts.push("no smooth edges".to_owned());
    }
    if lowered.without_occlusion {
        parts.push("no ambient occlusion".to_owned());
    } else if lowered.occlusion == Detail::Low {
        parts.push("coarser ambient occlusion".to_owned());
    }
    if lowered.shadow == Detail::Low {
        parts.push("coarser shadows".to_owned());
    }
    let parts = parts.join(", ");
    if lowered.frame_secs > 0.0 {
        format!("{parts}: frames took {:.0} ms", lowered.frame_secs * 1e3)
    } else {
        parts
    }
}

/// What the GPU spent on each pass of a frame, where it tells that.
fn pass_times(ui: &mut Ui, cx: &mut Cx<'_, SteadyCost>) {
    let Some(gpu_secs) = cx.state.read(ui, cx.session).gpu_secs else {
        return;
    };
    popover_gap(ui);
    section_name(ui, "GPU time of a frame");
    for (pass, secs) in TimedPass::ALL.into_iter().zip(gpu_secs) {
        value_row(ui, pass.label(), &milliseconds(secs));
    }
    value_row(ui, "Together", &milliseconds(gpu_secs.iter().sum()));
}
