//! A clip at a time to a palette: the product beside the textbook, in one run.
//!
//! The textbook does what the books' `SkinnedData` does, in f32 with the same maths library: it walks over the keys of each
//! bone, blends two of them into a matrix, multiplies down the hierarchy and with the offsets, each into a new list.
//!
//! A crowd in one call stands beside as many single poses.

use std::hint::black_box;
use std::time::Duration;

use bindpose::anim::{ClipPose, CompiledClip, CrowdPalettes, PoseBuffers};
use bindpose::format::{Document, Keyframe};
use bindpose::model::Clip;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::{Mat4, Quat, Vec3};

mod input;

/// What two ways in f32 may differ by on a model 72 units high.
const TOLERANCE: f32 = 2e-4;

fn posing(criterion: &mut Criterion) {
    let (name, document, model) = input::input();
    let textbook = Textbook::new(&document);
    let (skeleton, clip) = (&model.skeleton, &CompiledClip::new(&model.clips[0]));
    let mut buffers = PoseBuffers::for_skeleton(skeleton);
    for (order, times_secs) in forward_and_random_times(&model.clips[0]) {
        let mut sums = [0.0; 2];
        for &time_secs in &times_secs {
            buffers.evaluate(skeleton, clip, time_secs);
            let expected = textbook.palette(time_secs);
            for (&matrix, &bone) in buffers.palette.0.iter().zip(skeleton.file_bones()) {
                let (ours, theirs) = (Mat4::from(matrix), expected[bone as usize]);
                assert!(
                    ours.abs_diff_eq(theirs, TOLERANCE),
                    "bone {bone} at {time_secs} s: {ours} {theirs}"
                );
                for (sum, matrix) in sums.iter_mut().zip([theirs, ours]) {
                    *sum += f64::from(matrix.to_cols_array().iter().sum::<f32>());
                }
            }
        }
        input::report_check(&format!("pose/{name}/{order}"), sums);

        let mut group = criterion.benchmark_group(format!("pose/{name}/{order}"));
        group.throughput(Throughput::Elements(skeleton.joint_count() as u64));
        group.measurement_time(Duration::from_secs(3));
        let mut turn = times_secs.iter().cycle();
        group.bench_function("product", |bencher| {
            bencher.iter(|| {
                let &time_secs = turn.next().expect("a cycle has no end");
                buffers.evaluate(skeleton, clip, black_box(time_secs));
                black_box(&buffers.palette);
            });
        });
        group.bench_function("textbook", |bencher| {
            bencher.iter(|| {
                let &time_secs = turn.next().expect("a cycle has no end");
                textbook.palette(black_box(time_secs))
            });
        });
        group.finish();
        input::report_ratio(
            &format!("pose/{name}/{order}"),
            || {
                for &time_secs in &times_secs {
                    black_box(textbook.palette(time_secs));
                }
            },
            || {
                for &time_secs in &times_secs {
                    buffers.evaluate(skeleton, clip, time_secs);
                    black_box(&buffers.palette);
                }
            },
        );
    }
}

/// A crowd in one call beside as many single poses, and one in which all poses are equal. Each round is of another time, so that no
/// palette is there already.
fn crowd(criterion: &mut Criterion) {
    let (name, _, model) = input::input();
    let (skeleton, clips) = (&model.skeleton, CompiledClip::all(&model.clips));
    let [_, (_, times_secs)] = forward_and_random_times(&model.clips[0]);
    let length_secs = model.clips[0].duration_secs();
    for count in [1, 10, 100, 1_000] {
        for (poses, are_apart) in [("apart", true), ("equal", false)] {
            let mut single = PoseBuffers::for_skeleton(skeleton);
            let mut palettes = CrowdPalettes::default();
            let mut wanted: Vec<ClipPose> = Vec::new();
            let time_of = |instance: usize, round: usize| {
                let clip = &model.clips[0];
                let secs = times_secs[round % times_secs.len()] + times_secs[instance] * f32::from(are_apart);
                clip.start_secs + (secs - 2.0 * clip.start_secs).rem_euclid(length_secs)
            };
            let mut round = 0;
            let mut together = || {
                round += 1;
                wanted.clear();
                wanted.extend((0..count).map(|instance| ClipPose::new(Some(0), time_of(instance, round))));
                palettes.update(skeleton, &clips, 0.0, &wanted);
                black_box(palettes.palettes());
            };
            let mut other_round = 0;
            let mut one_by_one = || {
                other_round += 1;
                for instance in 0..count {
                    single.evaluate(skeleton, &clips[0], black_box(time_of(instance, other_round)));
                    black_box(&single.palette);
                }
            };
            let mut group = criterion.benchmark_group(format!("crowd/{name}/{count} {poses}"));
            group.throughput(Throughput::Elements(count as u64));
            group.measurement_time(Duration::from_secs(2));
            group.bench_function("together", |bencher| bencher.iter(&mut together));
            group.bench_function("one by one", |bencher| bencher.iter(&mut one_by_one));
            group.finish();
            input::report_ratio(&format!("crowd/{name}/{count} {poses}"), &mut one_by_one, &mut together);
        }
    }
}

/// Times inside the clip: one after the other, and in any order.
fn forward_and_random_times(clip: &Clip) -> [(&'static str, Vec<f32>); 2] {
    const COUNT: u16 = 1_024;
    let at = |part: f32| clip.start_secs + part * clip.duration_secs();
    let forward = (0..COUNT).map(|step| at(f32::from(step) / f32::from(COUNT))).collect();
    let mut next = input::noise();
    let random = (0..COUNT).map(|_| at(next())).collect();
    [("forward", forward), ("random", random)]
}

struct Textbook {
    bones: Vec<Vec<Key>>,
    parents: Vec<Option<usize>>,
    offsets: Vec<Mat4>,
}

struct Key {
    time_secs: f32,
    translation: Vec3,
    scale: Vec3,
    rotation: Quat,
}

impl From<&Keyframe> for Key {
    fn from(key: &Keyframe) -> Self {
        Self {
            time_secs: key.time_secs,
            translation: key.translation.into(),
            scale: key.scale.into(),
            rotation: Quat::from_array(key.rotation),
        }
    }
}

impl Textbook {
    /// Parents must come first, as the books' loader asks.
    fn new(document: &Document) -> Self {
        Self {
            bones: document.clips[0]
                .bones
                .iter()
                .map(|bone| bone.keyframes.iter().map(Key::from).collect())
                .collect(),
            parents: document
                .bone_parents
                .iter()
                .map(|&parent| usize::try_from(parent).ok())
                .collect(),
            offsets: document.bone_offsets.iter().map(Mat4::from_cols_array).collect(),
        }
    }

    fn palette(&self, time_secs: f32) -> Vec<Mat4> {
        let to_parent: Vec<Mat4> = self.bones.iter().map(|keys| interpolated(keys, time_secs)).collect();
        let mut to_root = Vec::with_capacity(to_parent.len());
        for (bone, &to_parent) in to_parent.iter().enumerate() {
            to_root.push(match self.parents[bone] {
                Some(parent) => to_root[parent] * to_parent,
                None => to_parent,
            });
        }
        to_root
            .iter()
            .zip(&self.offsets)
            .map(|(&to_root, &offset)| to_root * offset)
            .collect()
    }
}

fn interpolated(keys: &[Key], time_secs: f32) -> Mat4 {
    let (first, last) = (&keys[0], &keys[keys.len() - 1]);
    if time_secs <= first.time_secs {
        return Mat4::from_scale_rotation_translation(first.scale, first.rotation, first.translation);
    }
    if time_secs >= last.time_secs {
        return Mat4::from_scale_rotation_translation(last.scale, last.rotation, last.translation);
    }
    for pair in keys.windows(2) {
        let (from, to) = (&pair[0], &pair[1]);
        if from.time_secs <= time_secs && time_secs <= to.time_secs {
            let part = (time_secs - from.time_secs) / (to.time_secs - from.time_secs);
            return Mat4::from_scale_rotation_translation(
                from.scale.lerp(to.scale, part),
                from.rotation.slerp(to.rotation, part),
                from.translation.lerp(to.translation, part),
            );
        }
    }
    unreachable!("a time between the first and the last key lies between two keys")
}

criterion_group!(benches, posing, crowd);
criterion_main!(benches);
