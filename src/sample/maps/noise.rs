//! Chance that is the same every time.

/// 0…1 out of three whole numbers.
pub(super) fn chance(x: u32, y: u32, seed: u32) -> f64 {
    // Spread with primes of xxHash, mixed as MurmurHash3 ends.
    let mut bits = x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77) ^ seed.wrapping_mul(0xC2B2_AE3D);
    bits = (bits ^ (bits >> 16)).wrapping_mul(0x85EB_CA6B);
    bits = (bits ^ (bits >> 13)).wrapping_mul(0xC2B2_AE35);
    bits ^= bits >> 16;
    f64::from(bits) / f64::from(u32::MAX)
}

/// Smooth noise, −1…1, over the unit square, `cells` a side, that repeats.
pub(super) fn noise(u: f64, v: f64, cells: u32, seed: u32) -> f64 {
    let (x, y) = (u * f64::from(cells), v * f64::from(cells));
    let (column, row) = (x.floor(), y.floor());
    let (s, t) = (smooth(x - column), smooth(y - row));
    let wrapped = |index: f64| (index as i64).rem_euclid(i64::from(cells)) as u32;
    let at = |dx: f64, dy: f64| chance(wrapped(column + dx), wrapped(row + dy), seed);
    let above = at(0.0, 0.0) + (at(1.0, 0.0) - at(0.0, 0.0)) * s;
    let below = at(0.0, 1.0) + (at(1.0, 1.0) - at(0.0, 1.0)) * s;
    (above + (below - above) * t) * 2.0 - 1.0
}

/// Three octaves of noise, −1…1.
pub(super) fn clouds(u: f64, v: f64, cells: u32, seed: u32) -> f64 {
    (noise(u, v, cells, seed) * 4.0 + noise(u, v, 2 * cells, seed + 1) * 2.0 + noise(u, v, 4 * cells, seed + 2)) / 7.0
}

fn smooth(t: f64) -> f64 {
    t * t * (3.0 - 2.0 * t)
}
