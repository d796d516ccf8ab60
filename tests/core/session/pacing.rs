//! How much is drawn on a device that is slow.

use bindpose::scene::Detail;
use bindpose::session::for_tests::{Pacer, Step};

/// All is drawn.
const FULL: Step = Pacer::FINEST;
/// How many steps there are, and how long the pacer waits before it tries a finer one for the first time.
const STEPS: f32 = 9.0;
const FIRST_WAIT_SECS: f32 = 2.0;
/// A frame that takes longer is late.
const LATE_SECS: f32 = 1.25 / 60.0;

/// A device: what a frame costs whatever is drawn, and what the pixels of a full picture cost, seconds.
#[derive(Clone, Copy)]
struct Device {
    fixed_secs: f32,
    pixels_secs: f32,
    display_secs: f32,
}

impl Device {
    fn frame_secs(self, step: Step) -> f32 {
        let samples = match (step.draws_occlusion, step.occlusion) {
            (false, _) => 0.5,
            (true, Detail::Low) => 0.8,
            (true, Detail::Full) => 1.0,
        };
        let edges = if step.smooths_edges { 1.0 } else { 0.8 };
        let drawn = self.fixed_secs + self.pixels_secs * step.scale * step.scale * samples * edges;
        // The display shows whole frames.
        (drawn / self.display_secs).ceil() * self.display_secs
    }

    /// A clip that plays for a time.
    fn play(self, pacer: &mut Pacer, secs: f32) {
        let mut played = 0.0;
        while played < secs {
            let frame_secs = self.frame_secs(pacer.step());
            pacer.note_frame(frame_secs, None);
            played += frame_secs;
        }
    }
}

fn device(pixels_secs: f32, display: f32) -> (Device, Pacer) {
    let device = Device {
        fixed_secs: 0.001,
        pixels_secs,
        display_secs: 1.0 / display,
    };
    let mut pacer = Pacer::default();
    pacer.set_display_secs(device.display_secs);
    (device, pacer)
}

#[test]
fn a_device_that_keeps_up_draws_all() {
    for display in [30.0, 60.0, 144.0] {
        let (device, mut pacer) = device(0.005, display);
        device.play(&mut pacer, 30.0);
        assert_eq!(pacer.step(), FULL, "{display} Hz");
    }
}

#[test]
fn a_device_of_20_frames_draws_fewer_pixels_and_no_fewer_than_it_needs() {
    let (device, mut pacer) = device(0.045, 60.0);
    device.play(&mut pacer, 3.0);
    assert!(pacer.step().scale < 0.65 && pacer.step().draws_occlusion, "{pacer:?}");
    let mut late = 0.0;
    for _ in 0..60 {
        device.play(&mut pacer, 1.0);
        late += if device.frame_secs(pacer.step()) > LATE_SECS {
            1.0
        } else {
            0.0
        };
    }
    assert!(
        late < 10.0,
        "a finer step is tried seldom: {late} of 60 seconds were late"
    );
}

#[test]
fn one_sample_a_pixel_comes_before_fewer_pixels() {
    let (device, mut pacer) = device(0.019, 60.0);
    device.play(&mut pacer, 3.0);
    let plain = Step {
        smooths_edges: false,
        ..FULL
    };
    assert_eq!(pacer.step(), plain);
}

#[test]
fn a_device_of_5_frames_comes_to_the_coarsest_step_in_seconds() {
    let (device, mut pacer) = device(0.2, 60.0);
    device.play(&mut pacer, 4.0);
    assert_eq!(pacer.step(), Pacer::COARSEST);
}

#[test]
fn a_display_of_30_hertz_is_not_a_slow_device() {
    let (device, mut pacer) = device(0.02, 30.0);
    device.play(&mut pacer, 10.0);
    assert_eq!(pacer.step(), FULL);
}

#[test]
fn stalls_and_hidden_tabs_are_not_judged() {
    let (device, mut pacer) = device(0.005, 60.0);
    for stall_secs in [0.3, 1.0, 3.0, 60.0, f32::NAN] {
        device.play(&mut pacer, 0.5);
        pacer.note_frame(stall_secs, None);
        pacer.note_frame(0.1, None);
    }
    device.play(&mut pacer, 1.0);
    assert_eq!(pacer.step(), FULL);
}

#[test]
fn what_became_easier_is_drawn_finer_again() {
    let (hard, mut pacer) = device(0.2, 60.0);
    hard.play(&mut pacer, 4.0);
    let easy = Device {
        pixels_secs: 0.004,
        ..hard
    };
    easy.play(&mut pacer, STEPS * (FIRST_WAIT_SECS + 1.0));
    assert_eq!(pacer.step(), FULL);
}

#[test]
fn a_picture_is_not_made_coarser_for_nothing() {
    let busy = Device {
        fixed_secs: 0.05,
        pixels_secs: 0.001,
        display_secs: 1.0 / 60.0,
    };
    let mut pacer = Pacer::default();
    busy.play(&mut pacer, 20.0);
    assert_eq!(pacer.step(), FULL, "the time goes elsewhere");
}

#[test]
fn a_slow_device_begins_with_few_pixels_and_returns_there_with_another_model() {
    let mut pacer = Pacer::default();
    pacer.set_slow_device(true);
    let first = Step {
        scale: 0.5,
        shadow: Detail::Low,
        smooths_edges: false,
        ..FULL
    };
    assert_eq!(pacer.step(), first);
    let (device, _) = device(1.5, 60.0);
    device.play(&mut pacer, 10.0);
    assert_eq!(pacer.step(), Pacer::COARSEST);
    pacer.restart();
    assert_eq!(pacer.step(), first);
    let easy = Device {
        pixels_secs: 0.004,
        ..device
    };
    easy.play(&mut pacer, STEPS * (FIRST_WAIT_SECS + 1.0));
    let all_but_taps = Step {
        shadow: Detail::Low,
        ..FULL
    };
    assert_eq!(
        pacer.step(),
        all_but_taps,
        "edges too, and few taps of shadows all the while"
    );
}

#[test]
fn slow_frames_of_short_motions_add_up() {
    let mut pacer = Pacer::default();
    let mut motions = 0;
    while pacer.step() == FULL {
        pacer.begin_motion();
        (0..5).for_each(|_| pacer.note_frame(0.1, None));
        motions += 1;
        assert!(motions < 10);
    }
    assert_eq!(motions, 3);
}
