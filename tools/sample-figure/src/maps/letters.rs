//! Letters as strokes.

use glam::DVec2;

use super::relief::from_stretch;

/// From one letter to the next, where letters are one high.
const PITCH: f64 = 0.86;

/// Distance from the nearest stroke of a word about the origin, y down, where letters are one high.
pub(crate) fn distance(word: &str, at: DVec2) -> f64 {
    let first = -0.5 * PITCH * (word.len() as f64 - 1.0);
    let letters = word.chars().enumerate().map(|(index, letter)| {
        let at = at - DVec2::new(first + PITCH * index as f64, 0.0);
        let line = strokes(letter)
            .windows(2)
            .filter(|pair| pair[0] != PEN_UP && pair[1] != PEN_UP);
        let distances = line.map(|pair| from_stretch(at, place(pair[0]), place(pair[1])));
        distances.fold(f64::INFINITY, f64::min)
    });
    letters.fold(f64::INFINITY, f64::min)
}

const PEN_UP: u8 = b' ';

/// The places of a letter that its line runs through, named as on a keypad of three columns and three rows:
///
/// ```text
/// 7 8 9
/// 4 5 6
/// 1 2 3
/// ```
fn strokes(letter: char) -> &'static [u8] {
    match letter {
        'B' => b"179654 631",
        'D' => b"1786217",
        'E' => b"97413 46",
        'I' => b"82",
        'N' => b"1739",
        'O' | '0' => b"71397",
        'P' => b"17964",
        'S' => b"974631",
        '7' => b"792",
        _ => b"",
    }
}

fn place(key: u8) -> DVec2 {
    let index = key - b'1';
    DVec2::new(f64::from(index % 3) - 1.0, 1.0 - f64::from(index / 3)) * DVec2::new(0.28, 0.5)
}
