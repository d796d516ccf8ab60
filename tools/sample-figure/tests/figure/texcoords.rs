//! Texture coordinates: where the atlas lies on the figure.

use super::{FIGURE, position};

/// Repeats per metre along the directions in which a triangle's texture is densest and thinnest.
fn repeats_per_metre(triangle: [u32; 3]) -> [f64; 2] {
    let [a, b, c] = triangle.map(position);
    let [ta, tb, tc] = triangle.map(|corner| FIGURE.vertices[corner as usize].tex_coords.map(f64::from));
    // The triangle laid flat with its first edge along x, and the texture's change along x and y.
    let (ab, ac) = (b - a, c - a);
    let length = ab.length();
    let (along, across) = (ac.dot(ab) / length, ab.cross(ac).length() / length);
    let change = |axis: usize| {
        let x = (tb[axis] - ta[axis]) / length;
        (x, (tc[axis] - ta[axis] - x * along) / across)
    };
    let ((ux, uy), (vx, vy)) = (change(0), change(1));
    // Singular values of a 2 × 2 matrix.
    let (sum, product) = (ux * ux + uy * uy + vx * vx + vy * vy, (ux * vy - uy * vx).abs());
    let root = (sum * sum - 4.0 * product * product).max(0.0).sqrt();
    [((sum + root) / 2.0).sqrt(), ((sum - root) / 2.0).max(0.0).sqrt()]
}

/// Value below which a part of the skin lies, by area.
fn quantile(values: &mut [(f64, f64)], part: f64) -> f64 {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let area: f64 = values.iter().map(|value| value.1).sum();
    let mut below = 0.0;
    let found = values.iter().find(|value| {
        below += value.1;
        below >= part * area
    });
    found.expect("the parts sum to the whole").0
}

#[test]
fn texture_coordinates_lie_in_the_atlas() {
    for vertex in &FIGURE.vertices {
        let inside = vertex
            .tex_coords
            .iter()
            .all(|coordinate| (0.0..=1.0).contains(coordinate));
        assert!(inside, "{:?}", vertex.tex_coords);
    }
}

#[test]
fn the_atlas_is_as_dense_on_all_that_is_drawn_on() {
    // Pieces with nothing on them share a patch, and are denser or thinner as they fit.
    let plain = |corner: u32| {
        FIGURE.vertices[corner as usize]
            .tex_coords
            .iter()
            .all(|coordinate| *coordinate < 0.06)
    };
    let mut densities: Vec<(f64, f64)> = Vec::new();
    for triangle in FIGURE
        .triangles
        .iter()
        .filter(|triangle| !triangle.iter().all(|corner| plain(*corner)))
    {
        let [a, b, c] = triangle.map(position);
        let area = (b - a).cross(c - a).length() / 2.0;
        let [most, least] = repeats_per_metre(*triangle);
        densities.push(((most * least).sqrt(), area));
    }
    let (thin, dense) = (quantile(&mut densities, 0.1), quantile(&mut densities, 0.9));
    assert!(dense / thin < 2.2, "{thin:.2} … {dense:.2} repeats a metre");
}
