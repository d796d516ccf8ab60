//! The document as a whole, and the committed file.

use std::sync::LazyLock;

use bindpose::check::book::{self, Book, Known};
use bindpose::format::{self, Document, Reflectance};
use bindpose::model::{Handedness, UpAxis};
use bindpose::session::{File, load};

use super::FIGURE;

/// What the file holds.
static SAMPLE: LazyLock<Document> = LazyLock::new(|| sample_figure::sample(FIGURE.clone()));

#[test]
fn materials_are_physically_plausible() {
    for material in &FIGURE.materials {
        let Reflectance::Fresnel { fresnel0, roughness } = material.reflectance else {
            panic!("{} is not of the DirectX 12 book", material.name)
        };
        assert!(
            fresnel0.iter().all(|f| (0.02..=1.0).contains(f)),
            "{}: {fresnel0:?}",
            material.name
        );
        assert!((0.05..=1.0).contains(&roughness), "{}: {roughness}", material.name);
        // Less than 0.9 of the light, sRGB-encoded.
        assert!(
            material.diffuse.iter().all(|c| (0.0..0.955).contains(c)),
            "{}: {:?}",
            material.name,
            material.diffuse
        );
    }
}

#[test]
fn the_committed_file_is_reproduced() {
    let path = sample_figure::folder().join(sample_figure::FIGURE_NAME);
    let text = format::write(&SAMPLE);
    let committed =
        std::fs::read_to_string(path).expect("cargo run --package sample-figure writes the file that is missing");
    // The download stays small before compression too.
    assert!(committed.len() < 3_300_000, "{} bytes", committed.len());
    if cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        assert!(
            committed == text,
            "web/sample/figure.m3d is not what is made: cargo run --package sample-figure writes it anew"
        );
    }
    // Elsewhere a sine may differ in its last bit and flip a last decimal, but never the topology.
    let parsed = format::parse(committed.as_bytes()).expect("the project's own file is well formed");
    assert!(parsed.diagnostics.is_empty(), "{:?}", parsed.diagnostics);
    let (ours, theirs) = (&*SAMPLE, &parsed.document);
    assert_eq!((&ours.materials, &ours.subsets), (&theirs.materials, &theirs.subsets));
    assert!(ours.triangles == theirs.triangles);
    assert_eq!(ours.bone_parents, theirs.bone_parents);
    assert_eq!(ours.vertices.len(), theirs.vertices.len());
    for (a, b) in ours.vertices.iter().zip(&theirs.vertices) {
        assert_eq!(a.blend_indices, b.blend_indices);
        assert_close(&a.position, &b.position);
        assert_close(&a.normal, &b.normal);
        assert_close(&a.tangent, &b.tangent);
        assert_close(&a.tex_coords, &b.tex_coords);
        assert_close(&a.blend_weights, &b.blend_weights);
    }
    for (a, b) in ours.bone_offsets.iter().zip(&theirs.bone_offsets) {
        assert_close(a, b);
    }
    let keys = |document: &Document| -> Vec<[f32; 8]> {
        let bones = document.clips.iter().flat_map(|clip| &clip.bones);
        let key = |key: &format::Keyframe| {
            let ([x, y, z], [i, j, k, w]) = (key.translation, key.rotation);
            [key.time_secs, x, y, z, i, j, k, w]
        };
        bones.flat_map(|bone| bone.keyframes.iter().map(key)).collect()
    };
    assert_eq!(keys(ours).len(), keys(theirs).len());
    for (a, b) in keys(ours).iter().zip(&keys(theirs)) {
        assert_close(a, b);
    }
}

/// Equal but for the last of four decimals, or of five in metres, which are forty units.
fn assert_close(ours: &[f32], theirs: &[f32]) {
    let close = ours.iter().zip(theirs).all(|(a, b)| (a - b).abs() < 5e-4);
    assert!(close && ours.len() == theirs.len(), "{ours:?} is not {theirs:?}");
}

#[test]
fn it_makes_a_right_handed_model_without_a_word() {
    let file = File::new("figure.m3d", format::write(&SAMPLE).into_bytes());
    let open = load(&file).expect("the figure is sound");
    assert!(open.diagnostics.is_empty(), "{:?}", open.diagnostics);
    let model = &open.model;
    assert_eq!(model.handedness, Handedness::Right);
    assert_eq!(model.up_axis, UpAxis::Y);
    assert!(
        model.clips.iter().all(|clip| clip.keys_per_sec == 30.0),
        "30 keys a second"
    );
}

#[test]
fn the_demo_of_the_book_shows_it_as_it_is() {
    let text = format::write(&SAMPLE);
    let known = Known {
        document: Some(&SAMPLE),
        handedness: Some(Handedness::Right),
        missing_maps: Some(&[]),
        ..Known::default()
    };
    let verdict = book::verdict(Book::D3d12, text.as_bytes(), &known);
    assert!(verdict.reads() && !verdict.ends, "{verdict:?}");
    assert_eq!(verdict.limits, []);
}

#[test]
fn the_model_in_the_demo_s_units_is_the_figure() {
    use bindpose::anim::{CompiledClip, PoseBuffers, skin_positions};
    let [mirrored, made] = [&*SAMPLE, &*FIGURE].map(|document| {
        let file = File::new("figure.m3d", format::write(document).into_bytes());
        let open = load(&file).expect("the figure is sound");
        let world = bindpose::model::world_from_model(open.model.handedness, UpAxis::Y, open.model.front);
        let mut pose = PoseBuffers::for_skeleton(&open.model.skeleton);
        pose.evaluate(&open.model.skeleton, &CompiledClip::new(&open.model.clips[0]), 0.3);
        let mut positions = Vec::new();
        skin_positions(&open.model.mesh, &pose.palette, &mut positions);
        positions
            .iter()
            .map(|&place| world.transform_point3(place))
            .collect::<Vec<_>>()
    });
    for (mirrored, made) in mirrored.iter().zip(&made) {
        // Each offset and key was rounded in metres.
        assert!(
            mirrored.distance(40.0 * *made) < 2e-3,
            "{mirrored} is not 40 times {made}"
        );
    }
}

#[test]
fn two_runs_are_equal() {
    assert!(sample_figure::figure() == *FIGURE);
}
