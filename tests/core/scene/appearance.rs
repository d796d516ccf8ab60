//! What a view shows: modes, lights, overlays, passes.

use bindpose::scene::{Background, Light, Overlay, Overlays, Pass, Passes, ViewMode, srgb8_from_linear};

#[test]
fn view_modes_follow_each_other_around_the_end() {
    assert_eq!(ViewMode::Lit.cycled(1), ViewMode::BaseColor);
    assert_eq!(ViewMode::Lit.cycled(-1), ViewMode::Shadow);
    assert_eq!(ViewMode::Shadow.cycled(1), ViewMode::Lit);
}

#[test]
fn shader_and_menu_number_view_modes_alike() {
    let shader = include_str!("../../../shaders/mesh_inspect.wgsl");
    let expected: Vec<String> = ViewMode::ALL
        .iter()
        .enumerate()
        .skip(1)
        .map(|(index, mode)| {
            format!(
                "const VIEW_{}: u32 = {index}u;",
                mode.name().to_uppercase().replace('-', "_")
            )
        })
        .collect();
    let numbered: Vec<&str> = shader.lines().filter(|line| line.contains(": u32 = ")).collect();
    assert_eq!(numbered, expected, "all but the lit one, which has programs of its own");
}

#[test]
fn every_name_leads_back_to_what_it_names() {
    for mode in ViewMode::ALL {
        assert_eq!(ViewMode::from_name(mode.name()), Some(mode));
    }
    for light in Light::ALL {
        assert_eq!(Light::from_name(light.name()), Some(light));
    }
    for overlay in Overlay::ALL {
        assert_eq!(Overlay::from_name(overlay.name()), Some(overlay));
    }
    for pass in Pass::ALL {
        assert_eq!(Pass::from_name(pass.name()), Some(pass));
    }
    let colored = Background::Color([0x20, 0x0a, 0xff]);
    for background in [Background::Backdrop, Background::Sky, Background::None, colored] {
        assert_eq!(Background::from_name(&background.name()), Some(background));
    }
    for wrong in ["", "#", "#20262", "20262e", "#20262g", "#ääää", "#+12-34", "Sky"] {
        assert_eq!(Background::from_name(wrong), None, "{wrong}");
    }
}

#[test]
fn overlays_and_passes_are_switched_one_by_one() {
    let mut overlays = Overlays::none();
    for overlay in Overlay::ALL {
        overlays.set(overlay, true);
        assert!(overlays.has(overlay));
        overlays.set(overlay, false);
        assert!(overlays == Overlays::none());
    }
    for pass in Pass::ALL {
        let without = Passes::all().with(pass, false);
        assert!(Pass::ALL.into_iter().all(|other| without.has(other) == (other != pass)));
    }
}

/// IEC 61966-2-1, as the library has it.
fn linear(srgb: f32) -> f32 {
    if srgb <= 0.040_45 {
        srgb / 12.92
    } else {
        ((srgb + 0.055) / 1.055).powf(2.4)
    }
}

#[test]
fn a_byte_of_srgb_ends_exactly_half_way_to_the_next() {
    for byte in 0..u8::MAX {
        let bound = linear((f32::from(byte) + 0.5) / 255.0);
        assert_eq!([bound.next_down(), bound].map(srgb8_from_linear), [byte, byte + 1]);
    }
    let odd = [f32::NAN, f32::NEG_INFINITY, -1.0, -0.0, 1.0, 2.0, f32::INFINITY];
    assert_eq!(odd.map(srgb8_from_linear), [0, 0, 0, 0, 255, 255, 255]);
}
