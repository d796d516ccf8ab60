//! What is drawn on charts: grooves between panels, rivets, words.

use glam::DVec2;

use super::letters;
use super::relief::{Place, bead, from_stretch, off_whole, ramp};
use crate::parts::Chart;

/// Something on a chart. Parts are 0…1 of the chart's width or height; lengths are metres.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Mark {
    /// The shade in the gap round a plate.
    Gap,
    /// A groove across at a part of the height.
    LineV(f64),
    /// A groove inside of a plate, this far from its outline.
    Border(f64),
    /// Rivets across at a part of the height: how many fit the chart's width.
    Rivets(f64, f64),
    /// A painted word about a middle (parts), its letters this high; less than zero where the chart's v runs down the figure.
    Word {
        middle: [f64; 2],
        word: &'static str,
        height: f64,
        tone: [f64; 3],
    },
}

/// Half the width of a groove, metres.
const GROOVE: f64 = 0.0022;
const GROOVE_MM: f64 = 1.3;

/// The surface at a place of a chart, metres.
pub(crate) fn surface(chart: &Chart, at: DVec2) -> Place {
    let mut place = Place {
        height: 0.0,
        tone: [1.0; 3],
        polish: 1.0,
    };
    let part = at / chart.size;
    let border = (!chart.outline.is_empty()).then(|| from_outline(&chart.outline, at));
    for mark in chart.marks {
        match *mark {
            Mark::Gap => {
                let outside = ramp(0.001, 0.006, -border.unwrap_or(0.0));
                place.tone = place.tone.map(|tone| tone * (1.0 - 0.45 * outside));
                place.polish *= 1.0 - 0.5 * outside;
            }
            Mark::LineV(v) => groove(&mut place, (part.y - v).abs() * chart.size.y),
            Mark::Border(inset) => groove(&mut place, (border.unwrap_or(1.0) - inset).abs()),
            Mark::Rivets(v, count) => {
                let x = off_whole(part.x * count - 0.5) / count * chart.size.x;
                let y = (part.y - v) * chart.size.y;
                rivet(&mut place, (x * x + y * y).sqrt());
            }
            Mark::Word {
                middle,
                word,
                height,
                tone,
            } => {
                // Charts have their v upwards on the figure.
                let from_middle = (DVec2::from_array(middle) * chart.size - at) / height;
                let ink = 0.075 - letters::distance(word, from_middle);
                paint(&mut place, tone, ramp(-0.03, 0.03, ink));
            }
        }
    }
    place
}

fn paint(place: &mut Place, tone: [f64; 3], amount: f64) {
    for (own, tone) in place.tone.iter_mut().zip(tone) {
        *own += (tone - *own) * amount;
    }
}

fn groove(place: &mut Place, distance: f64) {
    let depth = bead(distance, GROOVE);
    place.height -= GROOVE_MM * depth;
    place.polish *= 1.0 - 0.7 * depth;
    place.tone = place.tone.map(|tone| tone * (1.0 - 0.72 * depth));
}

fn rivet(place: &mut Place, distance: f64) {
    let head = bead(distance, 0.0042).sqrt();
    let sunk = bead(distance - 0.0048, 0.0016);
    place.height += 0.9 * head - 0.4 * sunk;
    place.tone = place.tone.map(|tone| tone * (1.0 - 0.45 * sunk));
    place.polish *= 1.0 - 0.5 * sunk;
}

/// Distance inwards from a closed outline, negative outside.
fn from_outline(outline: &[DVec2], at: DVec2) -> f64 {
    let edges = || outline.iter().zip(outline.iter().cycle().skip(1));
    let nearest = edges()
        .map(|(from, to)| from_stretch(at, *from, *to))
        .fold(f64::INFINITY, f64::min);
    let crossed = edges().filter(|(a, b)| {
        let is_across = (a.y > at.y) != (b.y > at.y);
        is_across && at.x < a.x + (b.x - a.x) * (at.y - a.y) / (b.y - a.y)
    });
    if crossed.count() % 2 == 1 { nearest } else { -nearest }
}
