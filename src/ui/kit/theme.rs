//! Colours, type and metrics of the interface.

use std::sync::Arc;

use egui::{
    Color32, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Margin, Shadow, Stroke, TextStyle, vec2,
};

use crate::contact_sheet::INTER_REGULAR;

/// Distance of panels from the window's edges and from each other.
pub const MARGIN: f32 = 12.0;
/// Height of a row of text in panels.
pub const ROW_HEIGHT: f32 = 23.0;
pub const PANEL_RADIUS: u8 = 10;
pub const CONTROL_RADIUS: u8 = 6;
/// Below this width the panels become one drawer.
pub const NARROW_WIDTH: f32 = 900.0;
/// Below this height a drawer would cover the model. What it shows stands beside the model instead …
pub const LOW_HEIGHT: f32 = 480.0;
/// … if the window is at least this wide.
pub const LOW_WIDTH: f32 = 600.0;

/// Semibold family, for titles.
pub const SEMIBOLD: &str = "semibold";

/// How much contrast the person asks for. The page around sets it.
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

impl Contrast {
    fn of(ctx: &egui::Context) -> Self {
        ctx.data(|data| data.get_temp(Self::id())).unwrap_or_default()
    }

    fn id() -> egui::Id {
        egui::Id::unique("contrast")
    }

    /// Gives a context the styles of this contrast, unless it has them.
    pub(in crate::ui) fn apply(self, ctx: &egui::Context) {
        if Self::of(ctx) != self {
            ctx.data_mut(|data| data.insert_temp(Self::id(), self));
            set_styles(ctx, self);
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Tokens {
    pub text: Color32,
    pub muted: Color32,
    pub faint: Color32,
    pub panel: Color32,
    /// Borders and rules.
    pub hairline: Color32,
    pub field: Color32,
    /// Ground of a control under the pointer.
    pub field_hovered: Color32,
    /// Border of controls. Without a colour they are told by their ground alone.
    pub border: Color32,
    pub accent: Color32,
    pub accent_ground: Color32,
    pub on_accent: Color32,
    pub warning: Color32,
    pub error: Color32,
    pub shadow: Color32,
    pub axes: [Color32; 3],
    /// Width of the ring round the focused control.
    pub ring_width: f32,
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
    pub fn new(dark: bool, contrast: Contrast) -> Self {
        match (dark, contrast) {
            (true, Contrast::Normal) => Self::dark(),
            (false, Contrast::Normal) => Self::light(),
            (true, Contrast::More) => Self::dark_with_more_contrast(),
            (false, Contrast::More) => Self::light_with_more_contrast(),
            (true, Contrast::Forced) => Self::forced(rgb(0xFFFFFF), rgb(0x000000), rgb(0x1AEBFF), rgb(0x003A40)),
            (false, Contrast::Forced) => Self::forced(rgb(0x000000), rgb(0xFFFFFF), rgb(0x37006E), rgb(0xE6D9F5)),
        }
    }

    fn dark() -> Self {
        Self {
            text: rgb(0xE7EAF0),
            muted: rgb(0x98A1B0),
            faint: rgb(0x667080),
            panel: over(0x181B21, 94.0),
            hairline: over(0xFFFFFF, 7.5),
            field: over(0xFFFFFF, 5.5),
            field_hovered: over(0xFFFFFF, 10.0),
            border: Color32::TRANSPARENT,
            accent: rgb(0x5AA9FF),
            accent_ground: over(0x5AA9FF, 16.0),
            on_accent: rgb(0x0C1622),
            warning: rgb(0xFFB454),
            error: rgb(0xFF6B6B),
            shadow: over(0x000000, 34.0),
            axes: [rgb(0xF24D57), rgb(0x80CC33), rgb(0x4D97FF)],
            ring_width: 2.0,
        }
    }

    fn light() -> Self {
        Self {
            text: rgb(0x1B2029),
            muted: rgb(0x5B6574),
            faint: rgb(0x8A94A3),
            panel: over(0xFCFDFE, 96.0),
            hairline: over(0x1B2029, 10.0),
            field: over(0x1B2029, 5.0),
            field_hovered: over(0x1B2029, 9.0),
            border: Color32::TRANSPARENT,
            accent: rgb(0x1769D2),
            accent_ground: over(0x1769D2, 12.0),
            on_accent: rgb(0xFFFFFF),
            warning: rgb(0xC26A00),
            error: rgb(0xC83232),
            shadow: over(0x1B2029, 17.0),
            axes: [rgb(0xD63A45), rgb(0x4F8F0E), rgb(0x2A6FE0)],
            ring_width: 2.0,
        }
    }

    fn dark_with_more_contrast() -> Self {
        Self {
            text: rgb(0xFFFFFF),
            muted: rgb(0xD3DAE5),
            faint: rgb(0xB4BECC),
            panel: rgb(0x101318),
            hairline: over(0xFFFFFF, 40.0),
            field: over(0xFFFFFF, 9.0),
            field_hovered: over(0xFFFFFF, 18.0),
            border: over(0xFFFFFF, 40.0),
            accent: rgb(0x8FC6FF),
            accent_ground: over(0x5AA9FF, 20.0),
            on_accent: rgb(0x000000),
            warning: rgb(0xFFC575),
            error: rgb(0xFFA6A6),
            ..Self::dark()
        }
    }

    fn light_with_more_contrast() -> Self {
        Self {
            text: rgb(0x000000),
            muted: rgb(0x333A45),
            faint: rgb(0x454D59),
            panel: rgb(0xFFFFFF),
            hairline: over(0x000000, 45.0),
            field: over(0x000000, 5.0),
            field_hovered: over(0x000000, 12.0),
            border: over(0x000000, 45.0),
            accent: rgb(0x0A4494),
            accent_ground: over(0x1769D2, 10.0),
            warning: rgb(0x743F00),
            error: rgb(0x96140F),
            ..Self::light()
        }
    }

    /// Two colours and an accent, nothing translucent.
    fn forced(text: Color32, ground: Color32, accent: Color32, accent_ground: Color32) -> Self {
        let dark = ground == rgb(0x000000);
        Self {
            text,
            muted: text,
            faint: text,
            panel: ground,
            hairline: text,
            field: ground,
            field_hovered: accent_ground,
            border: text,
            accent,
            accent_ground,
            on_accent: ground,
            warning: if dark { rgb(0xFFFF00) } else { rgb(0x6B3A00) },
            error: if dark { rgb(0xFFB0B0) } else { rgb(0x8A0000) },
            shadow: Color32::TRANSPARENT,
            ring_width: 3.0,
            ..if dark { Self::dark() } else { Self::light() }
        }
    }

    /// The colour of an icon: muted, and full under the pointer.
    pub fn muted_to_text(&self, hovered: bool) -> Color32 {
        if hovered { self.text } else { self.muted }
    }

    pub fn track(&self) -> Color32 {
        if self.border == Color32::TRANSPARENT {
            self.field_hovered
        } else {
            self.border
        }
    }

    /// The tokens of the style in force.
    pub fn of(ui: &egui::Ui) -> Self {
        Self::new(ui.visuals().dark_mode, Contrast::of(ui.ctx()))
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
    set_styles(ctx, Contrast::Normal);
}

fn set_styles(ctx: &egui::Context, contrast: Contrast) {
    for (theme, visuals) in [
        (egui::Theme::Dark, egui::Visuals::dark()),
        (egui::Theme::Light, egui::Visuals::light()),
    ] {
        let tokens = Tokens::new(theme == egui::Theme::Dark, contrast);
        ctx.set_style_of(theme, style(&tokens, visuals));
    }
}

fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    let mut add = |name: &str, bytes: &'static [u8]| {
        fonts
            .font_data
            .insert(name.to_owned(), Arc::new(FontData::from_static(bytes)));
    };
    add("inter", INTER_REGULAR);
    add(
        "inter-semibold",
        include_bytes!("../../../assets/fonts/Inter-SemiBold.otf"),
    );
    add(
        "mono",
        include_bytes!("../../../assets/fonts/JetBrainsMono-Regular.ttf"),
    );
    let family = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
    fonts.families.insert(FontFamily::Proportional, family(&["inter"]));
    fonts.families.insert(FontFamily::Monospace, family(&["mono", "inter"]));
    fonts
        .families
        .insert(FontFamily::Name(SEMIBOLD.into()), family(&["inter-semibold", "inter"]));
    fonts
}

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
    // Menus and tooltips lie over text.
    visuals.window_fill = tokens.panel.to_opaque();
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
        widget.bg_stroke = if tokens.border == Color32::TRANSPARENT {
            Stroke::NONE
        } else {
            Stroke::new(1.0, tokens.border)
        };
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
