//! Where each chart lies in the atlas.

use glam::DVec2;

use crate::parts::{Chart, PLAIN};

/// Texels a side.
pub(crate) const SIDE: usize = 1024;
/// Texels between charts.
const GAP: f64 = 6.0;
/// Side of the plain patch, texels.
const PLAIN_SIDE: f64 = 48.0;

/// A chart's place, texels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) min: DVec2,
    pub(crate) size: DVec2,
}

/// The places of charts in a square, and how dense it is.
pub(crate) struct Atlas {
    pub(crate) places: Vec<Place>,
    pub(crate) texels_per_metre: f64,
}

impl Atlas {
    /// As dense as fits.
    pub(crate) fn new(charts: &[Chart]) -> Atlas {
        let mut density = 2_000.0;
        loop {
            if let Some(places) = packed(charts, density) {
                return Atlas {
                    places,
                    texels_per_metre: density,
                };
            }
            density *= 0.98;
        }
    }

    /// The texture coordinates of a place in a chart of this size.
    pub(crate) fn tex_coords(&self, chart: usize, place: DVec2, size: DVec2) -> DVec2 {
        let to = self.places[chart];
        let scale = if chart == PLAIN {
            DVec2::splat((PLAIN_SIDE - 4.0) / size.max_element())
        } else {
            to.size / size
        };
        let inside = if chart == PLAIN { DVec2::splat(2.0) } else { DVec2::ZERO };
        (to.min + inside + place * scale) / SIDE as f64
    }
}

/// Charts on shelves, the highest first.
fn packed(charts: &[Chart], density: f64) -> Option<Vec<Place>> {
    let size = |index: usize| match index {
        PLAIN => DVec2::splat(PLAIN_SIDE),
        index => (charts[index].size * density).ceil(),
    };
    let mut order: Vec<usize> = (0..charts.len()).collect();
    // The plain patch comes first.
    order[PLAIN + 1..].sort_by(|a, b| size(*b).y.total_cmp(&size(*a).y));
    let mut places = vec![None; charts.len()];
    let mut at = DVec2::splat(GAP / 2.0);
    let mut shelf = 0.0;
    let side = SIDE as f64 - GAP / 2.0;
    for index in order {
        let size = size(index);
        if at.x + size.x > side {
            at = DVec2::new(GAP / 2.0, at.y + shelf + GAP);
            shelf = 0.0;
        }
        if at.x + size.x > side || at.y + size.y > side {
            return None;
        }
        shelf = f64::max(shelf, size.y);
        places[index] = Some(Place { min: at, size });
        at.x += size.x + GAP;
    }
    places.into_iter().collect()
}
