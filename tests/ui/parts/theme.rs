//! Colours.

use bindpose::ui::Contrast;
use bindpose::ui::theme::Tokens;
use egui::Color32;

fn rgb(hex: u32) -> Color32 {
    let [_, red, green, blue] = hex.to_be_bytes();
    Color32::from_rgb(red, green, blue)
}

/// Relative luminance, as WCAG 2 defines it.
fn luminance(color: Color32) -> f32 {
    let linear = |channel: u8| {
        let value = f32::from(channel) / 255.0;
        if value <= 0.04045 {
            value / 12.92
        } else {
            ((value + 0.055) / 1.055).powf(2.4)
        }
    };
    0.2126 * linear(color.r()) + 0.7152 * linear(color.g()) + 0.0722 * linear(color.b())
}

fn ratio(a: Color32, b: Color32) -> f32 {
    let (a, b) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

/// The ends of the backdrop behind a panel.
fn backdrops(dark: bool) -> [Color32; 2] {
    if dark {
        [rgb(0x333842), rgb(0x14161A)]
    } else {
        [rgb(0xEBEDF0), rgb(0xCFD4DC)]
    }
}

#[test]
fn words_of_every_palette_can_be_read_on_its_panel() {
    for (contrast, least, least_faint) in [
        (Contrast::Normal, 4.5, 2.7),
        (Contrast::More, 7.0, 7.0),
        (Contrast::Forced, 7.0, 7.0),
    ] {
        for dark in [true, false] {
            let tokens = Tokens::new(dark, contrast);
            for backdrop in backdrops(dark) {
                let panel = backdrop.blend(tokens.panel);
                for (name, color, least) in [
                    ("text", tokens.text, least),
                    ("muted", tokens.muted, least),
                    ("accent", tokens.accent, least),
                    ("faint", tokens.faint, least_faint),
                ] {
                    let found = ratio(color, panel);
                    assert!(found >= least, "{name} of {contrast:?}, dark {dark}: {found:.2}");
                }
                if contrast != Contrast::Normal {
                    assert_eq!(tokens.panel.a(), 255, "nothing shows through");
                    for (name, color) in [("warning", tokens.warning), ("error", tokens.error)] {
                        let found = ratio(color, panel);
                        assert!(found >= 7.0, "{name} of {contrast:?}, dark {dark}: {found:.2}");
                    }
                    // The current choice of a menu.
                    let on = ratio(tokens.accent, panel.blend(tokens.accent_ground));
                    assert!(on >= 4.5, "on, of {contrast:?}, dark {dark}: {on:.2}");
                    // Lines that tell a control from its panel.
                    let border = ratio(panel.blend(tokens.border), panel);
                    assert!(border >= 3.0, "borders of {contrast:?}, dark {dark}: {border:.2}");
                }
            }
        }
    }
}
