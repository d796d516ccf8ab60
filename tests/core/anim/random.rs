//! Random skeletons and clips against the textbook.

use bindpose::anim::{CompiledClip, PoseBuffers, SkinnedVertices, skin};
use bindpose::format::{AnimationClip, Document, Keyframe, LineMap, Vertex};
use bindpose::import::m3d;
use bindpose::model::Track;
use glam::{Affine3A, Mat4};
use proptest::prelude::*;

use crate::documents::{extent, model_of, subset, track, vertex};
use crate::textbook;

/// Depth and scale of the skeletons below multiply what f32 loses; all lengths are of the order of 1.
const TOLERANCE: f64 = 2e-4;

fn rotations() -> impl Strategy<Value = [f32; 4]> {
    prop::array::uniform4(-1.0_f32..1.0).prop_filter_map("a direction", |quaternion| {
        let length = quaternion.iter().map(|number| number * number).sum::<f32>().sqrt();
        (length > 0.1).then(|| quaternion.map(|number| number / length))
    })
}

fn keys() -> impl Strategy<Value = Vec<Keyframe>> {
    let one = (
        0.05_f32..0.5,
        prop::array::uniform3(-1.0_f32..1.0),
        prop::array::uniform3(0.5_f32..1.5),
        rotations(),
    );
    (-1.0_f32..1.0, prop::collection::vec(one, 1..12)).prop_map(|(start_secs, keys)| {
        let mut time_secs = start_secs;
        let key = |(step_secs, translation, scale, rotation)| {
            time_secs += step_secs;
            Keyframe {
                time_secs,
                translation,
                scale,
                rotation,
            }
        };
        keys.into_iter().map(key).collect()
    })
}

/// Bones whose parent is any other in an order that the file does not keep.
fn documents() -> impl Strategy<Value = Document> {
    (1_usize..12).prop_flat_map(|bones| {
        let order = Just((0..bones as u32).collect::<Vec<_>>()).prop_shuffle();
        let parents: Vec<_> = (0..bones as i32)
            .map(|bone| -1..bone.max(0))
            .map(|range| {
                if range.is_empty() {
                    Just(-1).boxed()
                } else {
                    range.boxed()
                }
            })
            .collect();
        let offsets = prop::collection::vec(prop::array::uniform16(-1.0_f32..1.0), bones);
        let vertices = prop::collection::vec(
            (
                prop::array::uniform3(-1.0_f32..1.0),
                prop::array::uniform4(0.0_f32..1.0),
                prop::array::uniform4(0..bones as u32),
            ),
            3..20,
        );
        (order, parents, offsets, prop::collection::vec(keys(), bones), vertices).prop_map(
            |(order, parents, mut offsets, keys, vertices)| {
                for row in &mut offsets {
                    (row[3], row[7], row[11], row[15]) = (0.0, 0.0, 0.0, 1.0);
                }
                let sorted = Document {
                    subsets: vec![subset(0, 1)],
                    vertices: vertices
                        .into_iter()
                        .map(|(position, weights, blend_indices)| {
                            let sum: f32 = weights.iter().sum::<f32>().max(0.1);
                            Vertex {
                                position,
                                blend_weights: weights.map(|weight| weight / sum),
                                blend_indices,
                                ..vertex(0.0, 0.0)
                            }
                        })
                        .collect(),
                    triangles: vec![[0, 1, 2]],
                    bone_offsets: offsets,
                    bone_parents: parents,
                    clips: vec![AnimationClip {
                        name: "any".to_owned(),
                        bones: keys.into_iter().map(track).collect(),
                    }],
                    ..Document::default()
                };
                crate::documents::reordered(&sorted, &order)
            },
        )
    })
}

proptest! {
    #![proptest_config(crate::properties::cases(200))]

    #[test]
    fn any_skeleton_poses_as_in_the_textbook(document in documents(), times_secs in prop::collection::vec(-2.0_f32..7.0, 8)) {
        let (model, _) = model_of(&document);
        let mut buffers = PoseBuffers::default();
        for time_secs in times_secs {
            buffers.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), time_secs);
            let expected = textbook::palette(&document, 0, f64::from(time_secs));
            for (matrix, &bone) in buffers.palette.0.iter().zip(model.skeleton.file_bones()) {
                let ours = Mat4::from(*matrix).to_cols_array();
                for (&ours, &theirs) in ours.iter().zip(expected[bone as usize].as_flattened()) {
                    let scale = theirs.abs().max(1.0);
                    prop_assert!((f64::from(ours) - theirs).abs() <= TOLERANCE * scale, "bone {bone}: {ours} {theirs}");
                }
            }
        }
    }

    #[test]
    fn parents_come_first_and_numbers_are_kept(document in documents()) {
        let (model, _) = model_of(&document);
        let skeleton = &model.skeleton;
        for (joint, parent) in skeleton.parents().iter().enumerate() {
            let bone = skeleton.file_bones()[joint];
            let file_parent = document.bone_parents[bone as usize];
            match parent {
                Some(parent) => {
                    prop_assert!(parent.index() < joint);
                    prop_assert_eq!(skeleton.file_bones()[parent.index()] as i32, file_parent);
                }
                None => prop_assert_eq!(file_parent, -1),
            }
            prop_assert_eq!(skeleton.joint_of_bone()[bone as usize].index(), joint);
        }
    }

    #[test]
    fn the_box_of_a_clip_holds_every_vertex_at_every_key(document in documents()) {
        let (model, _) = model_of(&document);
        let clip = &model.clips[0];
        let bounds = extent(&model, Some(&CompiledClip::new(clip))).bounds;
        let mut buffers = PoseBuffers::default();
        let mut out = SkinnedVertices::default();
        for time_secs in clip.tracks.iter().flat_map(Track::times_secs) {
            buffers.evaluate(&model.skeleton, &CompiledClip::new(clip), *time_secs);
            skin(&model.mesh, &buffers.palette, &mut out);
            for position in &out.positions {
                prop_assert!(position.cmpge(bounds.min).all() && position.cmple(bounds.max).all());
            }
        }
    }

    /// Whatever the numbers are, also NaN and infinity: a model or an error, and no NaN in what is drawn.
    #[test]
    fn no_numbers_break_the_stages(
        mut document in documents(),
        numbers in prop::collection::vec(prop_oneof![
            Just(f32::NAN), Just(f32::INFINITY), Just(f32::NEG_INFINITY), Just(0.0), Just(-0.0), Just(1e-40), -10.0_f32..10.0
        ], 40),
        time_secs in prop_oneof![Just(f32::NAN), Just(f32::INFINITY), -3.0_f32..9.0],
    ) {
        let mut next = numbers.into_iter().cycle();
        let mut take = || next.next().expect("a cycle has no end");
        document.vertices[0].position = std::array::from_fn(|_| take());
        document.vertices[0].normal = std::array::from_fn(|_| take());
        document.vertices[1].tangent = std::array::from_fn(|_| take());
        document.vertices[1].tex_coords = std::array::from_fn(|_| take());
        document.vertices[2].blend_weights = std::array::from_fn(|_| take());
        document.bone_offsets[0] = std::array::from_fn(|_| take());
        for bone in &mut document.clips[0].bones {
            for key in bone.keyframes.iter_mut().skip(1).step_by(2) {
                key.time_secs = take();
                key.translation = std::array::from_fn(|_| take());
                key.scale = std::array::from_fn(|_| take());
                key.rotation = std::array::from_fn(|_| take());
            }
        }
        let (model, _) = m3d::from_document(&document, &LineMap::default()).expect("all references hold");
        let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
        buffers.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), time_secs);
        prop_assert!(buffers.palette.0.iter().all(Affine3A::is_finite));
        let mut out = SkinnedVertices::default();
        skin(&model.mesh, &buffers.palette, &mut out);
        prop_assert!(out.positions.iter().all(|position| position.is_finite()));
        for (normal, tangent) in out.normals.iter().zip(&out.tangents) {
            prop_assert!((normal.length() - 1.0).abs() < 1e-3);
            prop_assert!((tangent.truncate().length() - 1.0).abs() < 1e-3);
            prop_assert_eq!(tangent.w.abs(), 1.0);
        }
        let bounds = extent(&model, Some(&CompiledClip::new(&model.clips[0]))).bounds;
        prop_assert!(bounds.min.is_finite() && bounds.max.is_finite());
    }
}
