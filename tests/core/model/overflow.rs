//! Clips whose numbers overflow while they are posed.

use bindpose::anim::{CompiledClip, PoseBuffers};
use bindpose::diagnostic::Subject;
use bindpose::format::{Document, LineMap};

use crate::documents::{REAL_FILES, arm, extent, key, message_of, model_of, read, read_parsed, real_file, track};

/// Time and bone of the one finding.
fn overflow(document: &Document) -> Option<(f32, u32)> {
    let (_, findings) = read(document, &LineMap::default());
    let finding = findings.iter().find(|finding| finding.code == "pose-overflows")?;
    let words: Vec<&str> = finding.message.split([' ', ',']).collect();
    assert_eq!([words[0], words[5]], ["At", "bone"], "{}", finding.message);
    Some((words[1].parse().expect("a time"), words[6].parse().expect("a bone")))
}

#[test]
fn scales_that_multiply_along_the_bones_are_found_with_their_time_and_bone() {
    let mut document = arm();
    for bone in &mut document.clips[0].bones {
        bone.keyframes[1].scale = [1e20; 3];
    }
    let expected = (1.0, 1);
    assert_eq!(overflow(&document), Some(expected));
    assert_eq!(
        message_of(&document, "pose-overflows"),
        "At 1 s of \"bend\" bone 1, or a vertex on it, is taken beyond 10³⁷: numbers overflow there."
    );
    let (_, findings) = read(&document, &LineMap::default());
    let finding = findings.iter().find(|finding| finding.code == "pose-overflows");
    assert_eq!(finding.and_then(|finding| finding.subject), Some(Subject::Clip(0)));
}

/// The bones fit, but not where one of them takes its vertices.
#[test]
fn vertices_that_overflow_are_found() {
    let mut document = arm();
    document.clips[0].bones[2].keyframes[0].scale = [1e30; 3];
    assert_eq!(overflow(&document), None);
    document.vertices[12].position[1] = 1e10;
    let expected = (0.0, 2);
    assert_eq!(overflow(&document), Some(expected));
}

/// The product of two scales is greatest between their keys; it is found where a third bone has a key.
#[test]
fn what_overflows_between_the_keys_of_its_bones_is_found() {
    let mut document = arm();
    let scaled = |time_secs, scale| bindpose::format::Keyframe {
        scale: [scale; 3],
        ..key(time_secs, [0.0; 3])
    };
    document.clips[0].bones[0] = track([scaled(0.0, 1e25), scaled(1.0, 0.0)]);
    document.clips[0].bones[1] = track([scaled(0.0, 0.0), scaled(1.0, 1e25)]);
    assert_eq!(overflow(&document), None);
    document.clips[0].bones[2] = track([key(0.0, [0.0; 3]), key(0.5, [0.0; 3])]);
    let expected = (0.5, 1);
    assert_eq!(overflow(&document), Some(expected));
}

/// Great numbers at different times, or that cancel out, are no overflow.
#[test]
fn what_stays_finite_is_not_accused() {
    let mut document = arm();
    document.clips[0].bones[0].keyframes[0].scale = [1e30; 3];
    document.clips[0].bones[1].keyframes[0].scale = [1e-30; 3];
    document.clips[0].bones[1].keyframes[1].scale = [1e30; 3];
    let (model, codes) = model_of(&document);
    assert!(!codes.contains(&"pose-overflows"), "{codes:?}");
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    for time_secs in [0.0, 1.0] {
        pose.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), time_secs);
        assert!(pose.palette.0.iter().all(|matrix| matrix.is_finite()));
    }
    let bounds = extent(&model, Some(&CompiledClip::new(&model.clips[0]))).bounds;
    assert!(bounds.min.is_finite() && bounds.max.is_finite());
}

#[test]
fn no_real_file_overflows_or_lacks_names_and_counts() {
    for name in REAL_FILES {
        let Some(parsed) = real_file(name) else { continue };
        let (_, findings) = read_parsed(&parsed);
        let wrong = [
            "pose-overflows",
            "clip-unnamed",
            "counts-all-zero",
            "comment",
            "zeros-surplus",
        ];
        assert!(
            !findings.iter().any(|finding| wrong.contains(&finding.code)),
            "{name}: {findings:?}"
        );
    }
}
