//! What a view shows: modes, lights, overlays, passes.

use bindpose::scene::{Background, Light, Overlay, Overlays, Pass, Passes, ViewMode};

#[test]
fn view_modes_follow_each_other_around_the_end() {
    assert_eq!(ViewMode::Lit.cycled(1), ViewMode::BaseColor);
    assert_eq!(ViewMode::Lit.cycled(-1), ViewMode::Shadow);
    assert_eq!(ViewMode::Shadow.cycled(1), ViewMode::Lit);
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
