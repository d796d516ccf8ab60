//! Facts of real files, measured with other programs.

use bindpose::import::m3d;
use bindpose::model::{Handedness, Track, UpAxis};
use glam::Vec3;

use crate::documents::{REAL_FILES, read_parsed, real_file, soldier};

/// Bounds are known to one digit behind the point.
const BOUNDS_TOLERANCE: f32 = 0.06;

#[test]
fn counts_hands_and_axes() {
    //  file, vertices, triangles, materials, hand, up
    let facts = [
        ("d3d12/soldier", 13_748, 22_507, 5, Handedness::Right, UpAxis::Y),
        ("d3d11/base", 673, 632, 3, Handedness::Left, UpAxis::Y),
        ("d3d11/stairs", 86, 58, 1, Handedness::Left, UpAxis::Y),
        ("d3d11/rock", 42, 64, 1, Handedness::Left, UpAxis::Y),
        ("d3d11/tree", 2_258, 1_674, 2, Handedness::Left, UpAxis::Y),
        ("imm/column", 100, 74, 1, Handedness::Left, UpAxis::Z),
    ];
    assert_eq!(facts.map(|fact| fact.0), REAL_FILES);
    for (file, vertices, triangles, materials, handedness, up_axis) in facts {
        let Some(parsed) = real_file(file) else { continue };
        let (model, findings) = read_parsed(&parsed);
        let mesh = &model.mesh;
        assert_eq!(
            (mesh.vertex_count(), mesh.triangle_count(), model.materials.len()),
            (vertices, triangles, materials)
        );
        assert_eq!((model.handedness, model.up_axis), (handedness, up_axis), "{file}");
        assert_eq!(mesh.submeshes.len(), materials);
        let drawn: u32 = mesh.submeshes.iter().map(|submesh| submesh.triangle_count).sum();
        assert_eq!(drawn as usize, triangles);
        let codes: Vec<&str> = findings.iter().map(|finding| finding.code).collect();
        let expected: &[&str] = if file == "d3d12/soldier" {
            &["tangents-missing"]
        } else {
            &[]
        };
        assert_eq!(codes, expected, "{file}");
    }
}

#[test]
fn the_soldier() {
    let Some(parsed) = soldier() else { return };
    let (model, findings) = read_parsed(&parsed);
    assert_eq!(model.skeleton.joint_count(), 58);
    assert!(model.skeleton.file_bones().iter().copied().eq(0..58));

    let clip = &model.clips[0];
    assert_eq!(
        (clip.name.as_str(), clip.start_secs, clip.end_secs),
        ("Take1", 0.0, 1.25)
    );
    assert_eq!(
        (clip.keys_per_sec, clip.key_count, clip.last_frame()),
        (60.0, 4_400, 75)
    );
    assert_eq!(clip.frame_at(0.517), 31);
    let mut ends: Vec<usize> = clip.tracks.iter().map(Track::key_count).collect();
    ends.sort_unstable();
    ends.dedup();
    assert_eq!(ends, [73, 75, 76]);

    let bounds = model.bind_bounds();
    assert!(
        bounds.min.abs_diff_eq(Vec3::new(-29.3, -1.9, -7.7), BOUNDS_TOLERANCE),
        "{}",
        bounds.min
    );
    assert!(
        bounds.max.abs_diff_eq(Vec3::new(28.7, 72.5, 9.8), BOUNDS_TOLERANCE),
        "{}",
        bounds.max
    );

    let mut by_count = [0; 5];
    for influences in &model.mesh.influences {
        by_count[influences.weights.iter().filter(|&&weight| weight > 0.0).count()] += 1;
        assert!((influences.weights.iter().sum::<f32>() - 1.0).abs() < 1e-6);
    }
    assert_eq!(by_count, [0, 3_794, 1_862, 3_863, 4_229]);

    // Three of the 13 748 tangents are zero in the file.
    assert_eq!(
        findings[0].message,
        "3 vertices have a tangent that is zero or not finite; computed from the texture coordinates."
    );
    let negative = model.mesh.tangents.iter().filter(|tangent| tangent.w < 0.0).count();
    assert!((12_849..=12_852).contains(&negative), "{negative}");
}

/// Directions that are left out and computed again must come out as the files' own tools computed them.
#[test]
fn computed_directions_agree_with_stored_ones() {
    for file in REAL_FILES {
        let Some(parsed) = real_file(file) else { continue };
        let (model, _) = m3d::from_parsed(&parsed).expect("sound");
        let mut document = parsed.document.clone();
        document
            .vertices
            .iter_mut()
            .for_each(|vertex| vertex.tangent = [0.0; 4]);
        // Half of the normals stay, as evidence of the hand.
        document
            .vertices
            .iter_mut()
            .step_by(2)
            .for_each(|vertex| vertex.normal = [0.0; 3]);
        let (computed, _) = m3d::from_document(&document, &parsed.lines).expect("sound");
        assert_eq!(computed.handedness, model.handedness);

        let vertices = model.mesh.vertex_count() as f32;
        let share = |agrees: &dyn Fn(usize) -> bool| {
            (0..model.mesh.vertex_count()).filter(|&vertex| agrees(vertex)).count() as f32 / vertices
        };
        let (stored, ours) = (&model.mesh, &computed.mesh);
        let normals = share(&|vertex| stored.normals[vertex].dot(ours.normals[vertex]) > 0.5);
        let tangents = share(&|vertex| stored.tangents[vertex].truncate().dot(ours.tangents[vertex].truncate()) > 0.5);
        let signs = share(&|vertex| stored.tangents[vertex].w == ours.tangents[vertex].w);
        assert!(normals > 0.9, "{file}: {normals} of the normals agree");
        assert!(tangents > 0.95, "{file}: {tangents} of the tangents agree");
        assert!(signs > 0.95, "{file}: {signs} of the signs agree");
    }
}
