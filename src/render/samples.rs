//! Where the samples of a picture at rest lie: it is drawn again and again, each time from another place within the pixel and under
//! another point of the lamp.

use std::f32::consts::{FRAC_PI_4, PI};

/// The filter's radius, pixels.
const FILTER_RADIUS: f32 = 1.5;
/// Strata along each side of the lamp's square.
const STRATA: u32 = 4;

/// Where sample `index` lies from the pixel's middle, pixels: as dense as a Blackman-Harris window is high, in the order of the R2 sequence
/// (Roberts 2018), which covers the plane evenly wherever it ends.
pub fn pixel_offset(index: u32) -> [f32; 2] {
    [0.754_877_7, 0.569_840_3].map(|step: f64| {
        let share = (0.5 + f64::from(index) * step).fract() as f32;
        FILTER_RADIUS * window_place(share)
    })
}

/// The place in −1…1 below which this share of the window's area lies.
fn window_place(share: f32) -> f32 {
    const TERMS: [f32; 4] = [0.358_75, 0.488_29, 0.141_28, 0.011_68];
    let area_below = |place: f32| {
        let wave = |order: f32| (order * PI * place).sin() / (order * PI);
        let waves = TERMS[1] * wave(1.0) + TERMS[2] * wave(2.0) + TERMS[3] * wave(3.0);
        0.5 + (TERMS[0] * place + waves) / (2.0 * TERMS[0])
    };
    let (mut below, mut above) = (-1.0, 1.0);
    for _ in 0..24 {
        let middle = 0.5 * (below + above);
        if area_below(middle) < share {
            below = middle;
        } else {
            above = middle;
        }
    }
    0.5 * (below + above)
}

/// The point of the lens through which sample `index` is seen, in the unit disc.
pub fn lens_offset(index: u32) -> [f32; 2] {
    let across = (0.5 + f64::from(index) * 0.618_033_988_75).fract();
    let down = f64::from(index.reverse_bits()) / f64::from(u32::MAX);
    on_disc([across, down].map(|share| share as f32 * 2.0 - 1.0))
}

/// The point of the lamp under which sample `index` is drawn, in the unit disc: the middles of 4 × 4 strata of equal area, neighbours far
/// apart in time.
pub fn lamp_offset(index: u32) -> [f32; 2] {
    let stratum = index.wrapping_mul(7) % (STRATA * STRATA);
    let along = |step: u32| (step as f32 + 0.5) / STRATA as f32 * 2.0 - 1.0;
    on_disc([along(stratum % STRATA), along(stratum / STRATA)])
}

/// Brings the square -1…1 to the unit disc, area for area (Shirley and Chiu 1997).
fn on_disc([x, y]: [f32; 2]) -> [f32; 2] {
    if [x, y] == [0.0; 2] {
        return [0.0; 2];
    }
    let (radius, angle) = if x.abs() > y.abs() {
        (x, FRAC_PI_4 * y / x)
    } else {
        (y, 2.0 * FRAC_PI_4 - FRAC_PI_4 * x / y)
    };
    [radius * angle.cos(), radius * angle.sin()]
}

/// How far the noise of sample `index` is turned, 0…1: evenly over any run of samples.
pub(super) fn noise_turn(index: u32) -> f32 {
    (f64::from(index) * 0.618_033_988_75).fract() as f32
}
