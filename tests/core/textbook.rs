//! The books' animation in f64, obvious and slow: row vectors, plain arrays, offset · toRoot. It shares nothing with the
//! library but the document, so that a mistake in one is not made in both.

use bindpose::format::{Document, Keyframe};

/// Row-major, for row vectors: the translation is the fourth row.
pub(crate) type Matrix = [[f64; 4]; 4];

pub(crate) const IDENTITY: Matrix = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 1.0],
];

/// a · b.
pub(crate) fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let mut out = [[0.0; 4]; 4];
    for row in 0..4 {
        for column in 0..4 {
            for k in 0..4 {
                out[row][column] += a[row][k] * b[k][column];
            }
        }
    }
    out
}

/// Final transforms of a clip in the file's order of bones. Bones without keys, and clips without bones, have no place here.
pub(crate) fn palette(document: &Document, clip: usize, time_secs: f64) -> Vec<Matrix> {
    let bones = &document.clips[clip].bones;
    let to_parent: Vec<Matrix> = bones.iter().map(|bone| key_at(&bone.keyframes, time_secs)).collect();
    (0..document.bone_parents.len())
        .map(|bone| {
            let mut to_root = to_parent[bone];
            let mut parent = document.bone_parents[bone];
            while parent >= 0 {
                to_root = product(&to_root, &to_parent[parent as usize]);
                parent = document.bone_parents[parent as usize];
            }
            product(&offset(&document.bone_offsets[bone]), &to_root)
        })
        .collect()
}

/// The sixteen numbers as they stand, four a row.
pub(crate) fn offset(numbers: &[f32; 16]) -> Matrix {
    std::array::from_fn(|row| std::array::from_fn(|column| f64::from(numbers[row * 4 + column])))
}

/// One position by final transforms and the four weights as they stand.
pub(crate) fn skinned(position: [f32; 3], weights: [f64; 4], bones: [u32; 4], palette: &[Matrix]) -> [f64; 3] {
    let mut out = [0.0; 3];
    for influence in 0..4 {
        let matrix = &palette[bones[influence] as usize];
        for column in 0..3 {
            let mut sum = matrix[3][column];
            for row in 0..3 {
                sum += f64::from(position[row]) * matrix[row][column];
            }
            out[column] += weights[influence] * sum;
        }
    }
    out
}

/// scale · rotation · translation at a time, found by a walk over all keys.
fn key_at(keys: &[Keyframe], time_secs: f64) -> Matrix {
    let first = &keys[0];
    let last = &keys[keys.len() - 1];
    if time_secs <= f64::from(first.time_secs) {
        return matrix(wide(first.scale), wide(first.rotation), wide(first.translation));
    }
    if time_secs >= f64::from(last.time_secs) {
        return matrix(wide(last.scale), wide(last.rotation), wide(last.translation));
    }
    for pair in keys.windows(2) {
        let (from_secs, to_secs) = (f64::from(pair[0].time_secs), f64::from(pair[1].time_secs));
        if from_secs <= time_secs && time_secs <= to_secs {
            let part = (time_secs - from_secs) / (to_secs - from_secs);
            return matrix(
                straight(wide(pair[0].scale), wide(pair[1].scale), part),
                slerp(wide(pair[0].rotation), wide(pair[1].rotation), part),
                straight(wide(pair[0].translation), wide(pair[1].translation), part),
            );
        }
    }
    unreachable!("a time between the first and the last key lies between two keys")
}

fn wide<const N: usize>(numbers: [f32; N]) -> [f64; N] {
    numbers.map(f64::from)
}

fn straight(from: [f64; 3], to: [f64; 3], part: f64) -> [f64; 3] {
    std::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * part)
}

fn slerp(from: [f64; 4], to: [f64; 4], part: f64) -> [f64; 4] {
    let mut cosine: f64 = (0..4).map(|i| from[i] * to[i]).sum();
    let side = if cosine < 0.0 { -1.0 } else { 1.0 };
    cosine *= side;
    let (from_weight, to_weight) = if cosine > 1.0 - 1e-12 {
        (1.0 - part, part)
    } else {
        let angle = cosine.acos();
        (
            ((1.0 - part) * angle).sin() / angle.sin(),
            (part * angle).sin() / angle.sin(),
        )
    };
    std::array::from_fn(|i| from[i] * from_weight + to[i] * to_weight * side)
}

/// The affine transformation of the books: scale, then rotate by a quaternion x y z w, then translate.
fn matrix(scale: [f64; 3], rotation: [f64; 4], translation: [f64; 3]) -> Matrix {
    let [x, y, z, w] = rotation;
    #[rustfmt::skip]
    let turn = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)],
        [2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)],
        [2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)],
    ];
    let mut out = IDENTITY;
    for row in 0..3 {
        for column in 0..3 {
            out[row][column] = scale[row] * turn[row][column];
        }
    }
    out[3][..3].copy_from_slice(&translation);
    out
}
