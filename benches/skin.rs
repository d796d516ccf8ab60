//! Vertices moved by a palette: the product beside the textbook, in one run.
//!
//! The textbook is the books' vertex shader as a loop: four times position, normal and tangent by a matrix, weighed and
//! summed, then made unit. It moves normals as directions, which is right for rotations and even scale only; the product
//! moves them rightly under any scale.

use std::hint::black_box;
use std::time::Duration;

use bindpose::anim::{CompiledClip, Palette, PoseBuffers, SkinnedVertices, skin};
use bindpose::model::Mesh;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::{Mat4, Vec3};

mod input;

fn skinning(criterion: &mut Criterion) {
    let (name, _, model) = input::input();
    let mesh = &model.mesh;
    let clip = &model.clips[0];
    let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
    buffers.evaluate(
        &model.skeleton,
        &CompiledClip::new(clip),
        clip.start_secs + 0.4 * clip.duration_secs(),
    );
    let palette = &buffers.palette;
    let matrices: Vec<Mat4> = palette.0.iter().map(|&matrix| matrix.into()).collect();
    let (mut ours, mut theirs) = (SkinnedVertices::default(), SkinnedVertices::default());
    skin(mesh, palette, &mut ours);
    textbook(mesh, &matrices, &mut theirs);
    assert_same(&ours, &theirs, palette);
    input::report_check(
        &format!("skin/{name}"),
        [&theirs, &ours].map(|moved| sum(&moved.positions)),
    );

    let mut group = criterion.benchmark_group(format!("skin/{name}"));
    group.throughput(Throughput::Elements(mesh.vertex_count() as u64));
    group.measurement_time(Duration::from_secs(3));
    group.bench_function("product", |bencher| {
        bencher.iter(|| skin(black_box(mesh), palette, &mut ours));
    });
    group.bench_function("textbook", |bencher| {
        bencher.iter(|| textbook(black_box(mesh), &matrices, &mut theirs));
    });
    group.finish();
    input::report_ratio(
        &format!("skin/{name}"),
        || textbook(black_box(mesh), &matrices, &mut theirs),
        || skin(black_box(mesh), palette, &mut ours),
    );
}

fn sum(positions: &[Vec3]) -> f64 {
    positions.iter().map(|position| f64::from(position.element_sum())).sum()
}

fn textbook(mesh: &Mesh, matrices: &[Mat4], out: &mut SkinnedVertices) {
    out.positions.clear();
    out.normals.clear();
    out.tangents.clear();
    for vertex in 0..mesh.vertex_count() {
        let mut position = Vec3::ZERO;
        let mut normal = Vec3::ZERO;
        let mut tangent = Vec3::ZERO;
        for influence in 0..4 {
            let weight = mesh.influences[vertex].weights[influence];
            let matrix = &matrices[mesh.influences[vertex].joints[influence] as usize];
            position += weight * matrix.transform_point3(mesh.positions[vertex]);
            normal += weight * matrix.transform_vector3(mesh.normals[vertex]);
            tangent += weight * matrix.transform_vector3(mesh.tangents[vertex].truncate());
        }
        out.positions.push(position);
        out.normals.push(normal.normalize());
        out.tangents.push(tangent.normalize().extend(mesh.tangents[vertex].w));
    }
}

/// Positions and tangents are the same; normals too, but where matrices that turn apart are blended into one with shear.
fn assert_same(ours: &SkinnedVertices, theirs: &SkinnedVertices, palette: &Palette) {
    assert_eq!(ours.positions.len(), theirs.positions.len());
    assert!(
        palette
            .0
            .iter()
            .all(|matrix| (matrix.matrix3.determinant() - 1.0).abs() < 1e-3)
    );
    for (ours, theirs) in ours.positions.iter().zip(&theirs.positions) {
        assert!(ours.abs_diff_eq(*theirs, 1e-4), "{ours} {theirs}");
    }
    for (ours, theirs) in ours.tangents.iter().zip(&theirs.tangents) {
        assert!(ours.abs_diff_eq(*theirs, 1e-4), "{ours} {theirs}");
    }
    let pairs = || ours.normals.iter().zip(&theirs.normals);
    let same = pairs().filter(|(ours, theirs)| ours.dot(**theirs) > 0.999).count();
    assert!(same * 10 > ours.normals.len() * 9, "only {same} normals agree");
}

criterion_group!(benches, skinning);
criterion_main!(benches);
