//! Texture coordinates: how far maps are stretched, and where they are cut.

use std::collections::BTreeMap;

use super::{FIGURE, position, welded};

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
fn maps_are_stretched_little_and_evenly_dense() {
    for (subset, material) in FIGURE.subsets.iter().zip(&FIGURE.materials) {
        let faces = subset.face_start as usize..(subset.face_start + subset.face_count) as usize;
        let (mut stretches, mut densities) = (Vec::new(), Vec::new());
        for &triangle in &FIGURE.triangles[faces] {
            let [a, b, c] = triangle.map(position);
            let area = (b - a).cross(c - a).length() / 2.0;
            let [most, least] = repeats_per_metre(triangle);
            stretches.push((most / least, area));
            densities.push(((most * least).sqrt(), area));
        }
        let name = &material.name;
        let (median, most) = (quantile(&mut stretches, 0.5), quantile(&mut stretches, 0.9));
        assert!(
            median < 1.35 && most < 2.2,
            "{name}: stretched {median:.2}, at most {most:.2}"
        );
        let (thin, dense) = (quantile(&mut densities, 0.05), quantile(&mut densities, 0.95));
        assert!(dense / thin < 2.2, "{name}: {thin:.2} … {dense:.2} repeats a metre");
    }
}

#[test]
fn seams_are_few() {
    // Skin edges whose two triangles share no vertices: there a map is cut, or wraps.
    let (_, point_of) = welded(&FIGURE);
    let mut sides = BTreeMap::<[usize; 2], Vec<[u32; 2]>>::new();
    for triangle in &FIGURE.triangles {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let mut ends = [triangle[a], triangle[b]];
            ends.sort_by_key(|corner| point_of[*corner as usize]);
            sides
                .entry(ends.map(|corner| point_of[corner as usize]))
                .or_default()
                .push(ends);
        }
    }
    let cut = sides.values().filter(|ends| ends[0] != ends[1]).count();
    let part = cut as f64 / sides.len() as f64;
    assert!(part < 0.12, "{:.1} % of the edges are cut", part * 100.0);
}
