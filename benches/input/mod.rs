//! What the benchmarks of `anim` work on: the soldier where it is at hand, otherwise a model of its size.

use bindpose::format::{AnimationClip, BoneAnimation, Document, Keyframe, LineMap, Subset, Vertex, parse};
use bindpose::import::m3d;
use bindpose::model::Model;

/// As many as the soldier has.
const BONES: u32 = 58;
const KEYS: u32 = 76;
const VERTICES: u32 = 13_748;

/// Name, document and model.
pub(crate) fn input() -> (&'static str, Document, Model) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/models/d3d12/soldier.m3d");
    let (name, document) = match std::fs::read(path) {
        Ok(bytes) => ("soldier", parse(&bytes).expect("the soldier is sound").document),
        Err(_) => ("generated", soldier_sized()),
    };
    let (model, _) = m3d::from_document(&document, &LineMap::default()).expect("the input is sound");
    (name, document, model)
}

/// Numbers between 0 and 1, the same in every run.
pub(crate) fn noise() -> impl FnMut() -> f32 {
    let mut state = 0x2545_F491_u32;
    move || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        (state >> 8) as f32 / (1 << 24) as f32
    }
}

fn soldier_sized() -> Document {
    let mut next = noise();
    let mut spread = move |size: f32| (next() - 0.5) * size;
    let bone_parents = (0..BONES as i32)
        .map(|bone| if bone == 0 { -1 } else { (bone - 1) / 2 })
        .collect();
    let bone_offsets = (0..BONES)
        .map(|_| {
            let mut offset = [0.0; 16];
            (offset[0], offset[5], offset[10], offset[15]) = (1.0, 1.0, 1.0, 1.0);
            offset[12..15].fill_with(|| spread(20.0));
            offset
        })
        .collect();
    let bones = (0..BONES)
        .map(|_| {
            let (place, swing) = ([spread(10.0), spread(10.0), spread(10.0)], spread(2.0));
            let keyframes = (0..KEYS).map(|key| {
                let (sine, cosine) = ((key as f32 * 0.1).sin() * swing * 0.5).sin_cos();
                Keyframe {
                    time_secs: key as f32 / 60.0,
                    translation: place,
                    scale: [1.0; 3],
                    rotation: [sine * 0.6, sine * 0.8, 0.0, cosine],
                }
            });
            BoneAnimation {
                keyframes: keyframes.collect(),
            }
        })
        .collect();
    let vertices = (0..VERTICES)
        .map(|index| {
            let count = (index % 4 + 1) as usize;
            let mut blend_weights = [0.0; 4];
            blend_weights[..count].fill(1.0 / count as f32);
            Vertex {
                position: std::array::from_fn(|_| spread(70.0)),
                tangent: [1.0, 0.0, 0.0, 1.0],
                normal: [0.0, 0.0, -1.0],
                tex_coords: [spread(2.0), spread(2.0)],
                blend_weights,
                blend_indices: std::array::from_fn(|slot| (index / 240 + slot as u32) % BONES),
            }
        })
        .collect();
    Document {
        subsets: vec![Subset {
            face_count: VERTICES / 3,
            ..Subset::default()
        }],
        vertices,
        triangles: (0..VERTICES / 3)
            .map(|triangle| [0, 1, 2].map(|corner| triangle * 3 + corner))
            .collect(),
        bone_offsets,
        bone_parents,
        clips: vec![AnimationClip {
            name: "swing".to_owned(),
            bones,
        }],
        ..Document::default()
    }
}

/// What came of both, so that two runs can be seen to have done the same: the sum of all numbers.
#[expect(clippy::print_stdout, reason = "it belongs to the ratio")]
pub(crate) fn report_check(name: &str, [textbook, product]: [f64; 2]) {
    println!("{name}, numbers sum to {product:.3}, in the textbook to {textbook:.3}");
}

/// Both in turn, so that what else the machine does falls on both: median, least and greatest ratio of one round.
#[expect(clippy::print_stdout, reason = "the ratio is what the benchmark is for")]
pub(crate) fn report_ratio(name: &str, mut textbook: impl FnMut(), mut product: impl FnMut()) {
    const ROUNDS: usize = 101;
    let mut ratios: Vec<f64> = (0..ROUNDS)
        .map(|_| seconds(&mut textbook) / seconds(&mut product))
        .collect();
    ratios.sort_by(f64::total_cmp);
    let [low, median, high] = [0, ROUNDS / 2, ROUNDS - 1].map(|index| ratios[index]);
    println!("{name}, product against textbook in one round: {median:.2} times as fast ({low:.2} to {high:.2})");
}

fn seconds(work: &mut impl FnMut()) -> f64 {
    let start = std::time::Instant::now();
    work();
    start.elapsed().as_secs_f64()
}
