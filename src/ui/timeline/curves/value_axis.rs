//! Values along a height, and round values to draw lines at.

use egui::Rangef;

/// Room above and below the curves, as a fraction of their height.
const HEADROOM: f32 = 0.08;
/// The least distance of lines, in points.
const LINE_SPACING: f32 = 34.0;

/// A range of values along a height, the greatest at the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValueAxis {
    height: Rangef,
    values: [f32; 2],
}

impl ValueAxis {
    /// An axis on which all values fit, with headroom. NaN is ignored. The span is at least a thousandth of the largest
    /// absolute value, so that noise is not magnified.
    pub fn fitted(height: Rangef, values: impl Iterator<Item = f32>) -> Self {
        let finite = values.filter(|value| value.is_finite());
        let (least, most) = finite.fold((f32::INFINITY, f32::NEG_INFINITY), |(least, most), value| {
            (least.min(value), most.max(value))
        });
        let (least, most) = if least <= most { (least, most) } else { (0.0, 0.0) };
        let middle = 0.5 * (least + most);
        let least_half = (1e-3 * least.abs().max(most.abs())).max(1e-3);
        let half = (0.5 * (most - least)).max(least_half) * (1.0 + 2.0 * HEADROOM);
        Self {
            height,
            values: [middle - half, middle + half],
        }
    }

    pub fn y_of(&self, value: f32) -> f32 {
        let fraction = (value - self.values[0]) / (self.values[1] - self.values[0]);
        self.height.max - fraction * self.height.span()
    }

    /// Round values with room between them, and the decimals that tell them apart.
    pub fn lines(&self) -> (Vec<f32>, usize) {
        let [least, most] = self.values;
        let count = (self.height.span() / LINE_SPACING).max(1.0);
        let step = round_up((most - least) / count);
        let decimals = (-step.log10().floor()).clamp(0.0, 6.0) as usize;
        let [first, last] = [(least / step).ceil(), (most / step).floor()];
        // Counted, so that rounding loses no line.
        let lines = (0..=(last - first).clamp(0.0, 100.0) as u32).map(|line| (first + line as f32) * step);
        (lines.collect(), decimals)
    }
}

/// The next of 1, 2 and 5 times a power of ten.
pub fn round_up(step: f32) -> f32 {
    let power = 10.0_f32.powf(step.max(1e-9).log10().floor());
    let part = step / power;
    let round = [1.0, 2.0, 5.0].into_iter().find(|&round| part <= round * 1.0001);
    power * round.unwrap_or(10.0)
}
