//! Colours, type and metrics of the interface.

use std::sync::Arc;

use egui::{
    Color32, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Margin, Shadow, Stroke, TextStyle, vec2,
};

/// Distance of panels from the window's edges and from each other.
pub const MARGIN: f32 = 12.0;
/// Height of a row of text in panels.
pub const ROW_HEIGHT: f32 = 23.0;
/// Corner radius of panels.
pub const PANEL_RADIUS: u8 = 10;
/// Corner radius of controls.
pub const CONTROL_RADIUS: u8 = 6;
/// Below this width the panels become one bottom sheet.
pub const NARROW_WIDTH: f32 = 900.0;
/// Below this height a sheet would cover the model. What it shows stands beside the model instead …
pub const LOW_HEIGHT: f32 = 480.0;
/// … if the window is at least this wide.
pub const LOW_WIDTH: f32 = 600.0;

/// Semibold family, for titles.
pub const SEMIBOLD: &str = "semibold";

/// How much contrast the person asks the system for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Contrast {
    /// Quiet panels that let a little of the view through.
    #[default]
    Normal,
    /// Opaque panels, stronger lines, all text at 7 : 1.
    More,
    /// Few colours, as the system forces them: text on its opposite, and a border on every control.
    Forced,
}

/// The tokens of one theme.
#[derive(Clone, Copy, Debug)]
pub struct Tokens {
    /// Words and numbers.
    pub text: Color32,
    /// Labels.
    pub muted: Color32,
    /// Hints and ticks.
    pub faint: Color32,
    /// Ground of panels, nearly opaque.
    pub panel: Color32,
    /// Borders and rules.
    pub hairline: Color32,
    /// Ground of controls.
    pub field: Color32,
    /// Ground of a control under the pointer.
    pub field_hovered: Color32,
    /// The one accent.
    pub accent: Color32,
    /// Ground of what is on.
    pub accent_ground: Color32,
    /// Words on the accent.
    pub on_accent: Color32,
    /// Skeleton and warnings.
    pub warning: Color32,
    /// Errors.
    pub error: Color32,
    /// Shadow under panels.
    pub shadow: Color32,
    /// The x, y and z axes.
    pub axes: [Color32; 3],
}

const fn rgb(hex: u32) -> Color32 {
    Color32::from_rgb((hex >> 16) as u8, (hex >> 8) as u8, hex as u8)
}

/// A colour over what is behind it, `alpha` in percent.
fn over(hex: u32, percent: f32) -> Color32 {
    let [r, g, b, _] = rgb(hex).to_array();
    Color32::from_rgba_unmultiplied(r, g, b, (percent * 2.55).round() as u8)
}

impl Tokens {
    /// Light words on dark ground.
    pub fn dark() -> Self {
        Self {
            text: rgb(0xE7EAF0),
            muted: rgb(0x98A1B0),
            faint: rgb(0x667080),
            panel: over(0x181B21, 94.0),
            hairline: over(0xFFFFFF, 7.5),
            field: over(0xFFFFFF, 5.5),
            field_hovered: over(0xFFFFFF, 10.0),
            accent: rgb(0x5AA9FF),
            accent_ground: over(0x5AA9FF, 16.0),
            on_accent: rgb(0x0C1622),
            warning: rgb(0xFFB454),
            error: rgb(0xFF6B6B),
            shadow: over(0x000000, 34.0),
            axes: [rgb(0xF24D57), rgb(0x80CC33), rgb(0x4D97FF)],
        }
    }

    /// Dark words on light ground.
    pub fn light() -> Self {
        Self {
            text: rgb(0x1B2029),
            muted: rgb(0x5B6574),
            faint: rgb(0x8A94A3),
            panel: over(0xFCFDFE, 96.0),
            hairline: over(0x1B2029, 10.0),
            field: over(0x1B2029, 5.0),
            field_hovered: over(0x1B2029, 9.0),
            accent: rgb(0x1769D2),
            accent_ground: over(0x1769D2, 12.0),
            on_accent: rgb(0xFFFFFF),
            warning: rgb(0xC26A00),
            error: rgb(0xC83232),
            shadow: over(0x1B2029, 17.0),
            axes: [rgb(0xD63A45), rgb(0x4F8F0E), rgb(0x2A6FE0)],
        }
    }

    /// The colour of an icon: muted, and full under the pointer.
    pub fn muted_to_text(&self, hovered: bool) -> Color32 {
        if hovered { self.text } else { self.muted }
    }

    /// The tokens of the style in force.
    pub fn of(ui: &egui::Ui) -> Self {
        if ui.visuals().dark_mode {
            Self::dark()
        } else {
            Self::light()
        }
    }
}

/// Ground, border and shadow of a floating panel, without margins.
pub fn panel_frame(tokens: &Tokens) -> egui::Frame {
    egui::Frame::new()
        .fill(tokens.panel)
        .stroke(Stroke::new(1.0, tokens.hairline))
        .corner_radius(PANEL_RADIUS)
        .shadow(Shadow {
            offset: [0, 6],
            blur: 22,
            spread: 0,
            color: tokens.shadow,
        })
}

/// Gives a context the interface's fonts and both styles.
pub fn install(ctx: &egui::Context) {
    ctx.set_fonts(fonts());
    ctx.set_style_of(egui::Theme::Dark, style(&Tokens::dark(), egui::Visuals::dark()));
    ctx.set_style_of(egui::Theme::Light, style(&Tokens::light(), egui::Visuals::light()));
}

fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    let mut add = |name: &str, bytes: &'static [u8]| {
        fonts
            .font_data
            .insert(name.to_owned(), Arc::new(FontData::from_static(bytes)));
    };
    add("inter", include_bytes!("../../assets/fonts/Inter-Regular.otf"));
    add(
        "inter-semibold",
        include_bytes!("../../assets/fonts/Inter-SemiBold.otf"),
    );
    add("mono", include_bytes!("../../assets/fonts/JetBrainsMono-Regular.ttf"));
    let family = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
    fonts.families.insert(FontFamily::Proportional, family(&["inter"]));
    fonts.families.insert(FontFamily::Monospace, family(&["mono", "inter"]));
    fonts
        .families
        .insert(FontFamily::Name(SEMIBOLD.into()), family(&["inter-semibold", "inter"]));
    fonts
}

/// Semibold text of a size.
pub fn semibold(size: f32) -> FontId {
    FontId::new(size, FontFamily::Name(SEMIBOLD.into()))
}

/// Monospace text of a size, for numbers that change.
pub fn mono(size: f32) -> FontId {
    FontId::new(size, FontFamily::Monospace)
}

fn style(tokens: &Tokens, mut visuals: egui::Visuals) -> egui::Style {
    visuals.weak_text_color = Some(tokens.muted);
    visuals.panel_fill = Color32::TRANSPARENT;
    visuals.window_fill = tokens.panel;
    visuals.window_stroke = Stroke::new(1.0, tokens.hairline);
    visuals.window_corner_radius = CornerRadius::same(PANEL_RADIUS);
    visuals.menu_corner_radius = CornerRadius::same(8);
    visuals.window_shadow = Shadow {
        offset: [0, 6],
        blur: 22,
        spread: 0,
        color: tokens.shadow,
    };
    visuals.popup_shadow = visuals.window_shadow;
    visuals.extreme_bg_color = tokens.field;
    visuals.code_bg_color = tokens.field;
    visuals.hyperlink_color = tokens.accent;
    visuals.warn_fg_color = tokens.warning;
    visuals.error_fg_color = tokens.error;
    visuals.selection.bg_fill = tokens.accent_ground;
    visuals.selection.stroke = Stroke::new(1.4, tokens.accent);
    let radius = CornerRadius::same(CONTROL_RADIUS);
    // Icons and words of controls are muted until they are hovered or focused.
    let looks = [
        (&mut visuals.widgets.noninteractive, Color32::TRANSPARENT, tokens.text),
        (&mut visuals.widgets.inactive, tokens.field, tokens.muted),
        (&mut visuals.widgets.hovered, tokens.field_hovered, tokens.text),
        (&mut visuals.widgets.active, tokens.field_hovered, tokens.text),
        (&mut visuals.widgets.open, tokens.field_hovered, tokens.text),
    ];
    for (widget, fill, text) in looks {
        widget.bg_fill = fill;
        widget.weak_bg_fill = fill;
        widget.bg_stroke = Stroke::NONE;
        widget.fg_stroke = Stroke::new(1.4, text);
        widget.corner_radius = radius;
        widget.expansion = 0.0;
    }
    visuals.widgets.noninteractive.bg_stroke = Stroke::new(1.0, tokens.hairline);

    let mut style = egui::Style {
        visuals,
        animation_time: 0.12,
        ..egui::Style::default()
    };
    style.text_styles = [
        (TextStyle::Small, FontId::proportional(11.0)),
        (TextStyle::Body, FontId::proportional(13.0)),
        (TextStyle::Button, FontId::proportional(13.0)),
        (TextStyle::Heading, semibold(13.0)),
        (TextStyle::Monospace, mono(12.0)),
    ]
    .into();
    style.spacing.item_spacing = vec2(6.0, 0.0);
    style.spacing.button_padding = vec2(8.0, 5.0);
    style.spacing.interact_size = vec2(28.0, 28.0);
    style.spacing.menu_margin = Margin::same(6);
    style.spacing.tooltip_width = 320.0;
    // The scroll bar stands in the panel's margin. Over the list it would take clicks on icons at the end of a row.
    style.spacing.scroll.bar_width = 6.0;
    style.spacing.scroll.bar_outer_margin = -9.0;
    style.interaction.selectable_labels = false;
    style.interaction.tooltip_delay = 0.35;
    style
}
