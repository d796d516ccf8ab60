//! The figure's maps: one atlas of colours and one of normals and gloss.
//!
//! Only + − × ÷ √, in a fixed order: the bytes are the same on every machine.

mod letters;
mod marks;
mod relief;

use glam::DVec2;

use crate::atlas::{Atlas, SIDE};
use crate::parts::Kit;
pub(crate) use marks::Mark;

/// Names of the diffuse and the normal map.
pub(crate) const NAMES: [&str; 2] = ["figure_diff.png", "figure_norm.png"];

/// A map that the figure's materials name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SampleMap {
    /// The file's name, as the materials have it.
    pub name: &'static str,
    /// Texels a side.
    pub side: u32,
    /// Red, green, blue and alpha, rows from the top. The diffuse map is sRGB, near white, and opaque. The normal map has green
    /// pointing down the picture, as in DirectX, and in alpha how polished the place is: a factor of the material's shininess.
    pub rgba: Vec<u8>,
}

/// Both maps of the figure.
pub(crate) fn maps(kit: &Kit<'_>) -> Vec<SampleMap> {
    let atlas = Atlas::new(&kit.charts);
    let mut tones = vec![[u8::MAX; 4]; SIDE * SIDE];
    let mut normals = vec![[128, 128, 255, u8::MAX]; SIDE * SIDE];
    let texel = 1.0 / atlas.texels_per_metre;
    for (chart, to) in kit.charts.iter().zip(&atlas.places) {
        if chart.marks.is_empty() {
            continue;
        }
        // Beyond its border a chart goes on a little, for filters that look there.
        let margin = 2;
        let [left, top] = to.min.to_array().map(|min| min as usize - margin);
        let [right, bottom] = (to.min + to.size).to_array().map(|max| max as usize + margin);
        for y in top..bottom {
            for x in left..right {
                let at = (DVec2::new(x as f64 + 0.5, y as f64 + 0.5) - to.min) / to.size * chart.size;
                let place = marks::surface(chart, at);
                let height = |dx: f64, dy: f64| marks::surface(chart, at + DVec2::new(dx, dy) * texel).height;
                // Heights are millimetres.
                let two_texels_mm = 2.0 * texel * 1000.0;
                let rise_u = (height(1.0, 0.0) - height(-1.0, 0.0)) / two_texels_mm;
                let rise_v = (height(0.0, 1.0) - height(0.0, -1.0)) / two_texels_mm;
                let length = (rise_u * rise_u + rise_v * rise_v + 1.0).sqrt();
                let [nx, ny, nz] = [-rise_u, -rise_v, 1.0].map(|part| byte(part / length * 0.5 + 0.5));
                let [r, g, b] = place.tone.map(byte);
                tones[y * SIDE + x] = [r, g, b, u8::MAX];
                normals[y * SIDE + x] = [nx, ny, nz, byte(place.polish)];
            }
        }
    }
    let map = |name, texels: Vec<[u8; 4]>| SampleMap {
        name,
        side: SIDE as u32,
        rgba: texels.into_flattened(),
    };
    vec![map(NAMES[0], tones), map(NAMES[1], normals)]
}

/// 0…1 to 0…255.
fn byte(value: f64) -> u8 {
    (value * 255.0).round().clamp(0.0, 255.0) as u8
}
