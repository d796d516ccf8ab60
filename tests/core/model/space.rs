//! From the file's space into the world.

use bindpose::model::{Front, Handedness, UpAxis, world_from_model};
use glam::Vec3;

#[test]
fn every_space_comes_out_left_handed_and_upright() {
    for handedness in [Handedness::Left, Handedness::Right] {
        for (up_axis, up) in [(UpAxis::Y, Vec3::Y), (UpAxis::Z, Vec3::Z)] {
            let world_from_model = world_from_model(handedness, up_axis, Front::default());
            assert_eq!(
                world_from_model.transform_vector3(up),
                Vec3::Y,
                "{handedness:?} {up_axis:?}"
            );
            let mirrors = world_from_model.matrix3.determinant() < 0.0;
            assert_eq!(mirrors, handedness == Handedness::Right, "{handedness:?} {up_axis:?}");
        }
    }
}

#[test]
fn fronts_face_the_default_camera() {
    for handedness in [Handedness::Left, Handedness::Right] {
        for (up_axis, front) in [(UpAxis::Y, Vec3::NEG_Z), (UpAxis::Z, Vec3::NEG_Y)] {
            for (facing, front) in [(Front::Negative, front), (Front::Positive, -front)] {
                let world_front = world_from_model(handedness, up_axis, facing).transform_vector3(front);
                assert_eq!(world_front, Vec3::NEG_Z, "{handedness:?} {up_axis:?} {facing:?}");
            }
        }
    }
}
