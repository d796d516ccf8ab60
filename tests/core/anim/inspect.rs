//! Read-outs of a joint: put together again, its parts are the matrix.

use bindpose::anim::{CompiledClip, JointReadout, PoseBuffers, RowMatrix, TransformParts, key_rows, key_table};
use bindpose::import::m3d;
use bindpose::model::{JointIndex, JointTree, LocalJoint};
use glam::{Affine3A, DMat3, DQuat, DVec3, Mat3, Quat, Vec3};
use proptest::prelude::*;

use crate::documents::{arm, model_of, soldier};
use crate::textbook;

/// The matrix that the parts are of: the axes of the rotation, leaned by the cosines, times the scale.
fn rebuilt(parts: &TransformParts) -> DMat3 {
    let rotation = DMat3::from_quat(parts.rotation.as_dquat());
    let shear = parts.shear.as_dvec3();
    let y = DVec3::new(shear.x, (1.0 - shear.x * shear.x).sqrt(), 0.0);
    let along_y = (shear.z - shear.x * shear.y) / y.y;
    let z = DVec3::new(shear.y, along_y, (1.0 - shear.y * shear.y - along_y * along_y).sqrt());
    rotation * DMat3::from_cols(DVec3::X, y, z) * DMat3::from_diagonal(parts.scale.as_dvec3())
}

/// Turns about the fixed axes x, y, z in turn, with sines and cosines alone.
fn turned_about_axes(degrees: Vec3) -> DMat3 {
    let [x, y, z] = degrees.as_dvec3().to_array().map(f64::to_radians).map(f64::sin_cos);
    let about_x = DMat3::from_cols(DVec3::X, DVec3::new(0.0, x.1, x.0), DVec3::new(0.0, -x.0, x.1));
    let about_y = DMat3::from_cols(DVec3::new(y.1, 0.0, -y.0), DVec3::Y, DVec3::new(y.0, 0.0, y.1));
    let about_z = DMat3::from_cols(DVec3::new(z.1, z.0, 0.0), DVec3::new(-z.0, z.1, 0.0), DVec3::Z);
    about_z * about_y * about_x
}

fn check_parts(matrix: &Affine3A, tolerance: f64) {
    let parts = TransformParts::of_matrix(matrix);
    let expected = matrix.as_daffine3().matrix3;
    let size = expected
        .to_cols_array()
        .into_iter()
        .fold(0.0, |most: f64, number| most.max(number.abs()));
    let rebuilt = rebuilt(&parts);
    assert!(
        rebuilt.abs_diff_eq(expected, tolerance * size),
        "{parts:?}: {rebuilt} for {expected}"
    );
    assert_eq!(parts.position, matrix.translation.into());
    assert_eq!(parts.is_mirrored(), expected.determinant() < 0.0);
    let euler = turned_about_axes(parts.euler_xyz_degrees);
    let rotation = DMat3::from_quat(parts.rotation.as_dquat());
    assert!(euler.abs_diff_eq(rotation, 1e-5), "{parts:?}: {euler} for {rotation}");
}

fn directions() -> impl Strategy<Value = Quat> {
    prop::array::uniform4(-1.0_f32..1.0)
        .prop_filter("a direction", |numbers| glam::Vec4::from_array(*numbers).length() > 0.1)
        .prop_map(|numbers| Quat::from_array(numbers).normalize())
}

fn scales() -> impl Strategy<Value = Vec3> {
    let one = (0.01_f32..20.0, any::<bool>()).prop_map(|(length, negative)| if negative { -length } else { length });
    prop::array::uniform3(one).prop_map(Vec3::from)
}

proptest! {
    #![proptest_config(crate::properties::cases(500))]

    #[test]
    fn parts_make_the_matrix_again(rotation in directions(), scale in scales(), position in prop::array::uniform3(-9.0_f32..9.0)) {
        let matrix = Affine3A::from_scale_rotation_translation(scale, rotation, position.into());
        check_parts(&matrix, 2e-5);
        prop_assert!(!TransformParts::of_matrix(&matrix).is_sheared(), "square axes");
        let joint = LocalJoint { rotation, translation: position.into(), scale };
        let parts = TransformParts::of_joint(&joint);
        prop_assert_eq!(parts.scale, scale, "signs stay as they stand");
        prop_assert!(rebuilt(&parts).abs_diff_eq(matrix.as_daffine3().matrix3, 1e-4));
    }

    #[test]
    fn what_is_sheared_is_flagged_and_its_cosines_are_told(first in directions(), second in directions(), scale in scales()) {
        // A chain of an uneven scale and a turn.
        let uneven = scale * Vec3::new(1.0, 2.5, 0.4);
        let linear = Mat3::from_diagonal(uneven) * Mat3::from_quat(first) * Mat3::from_diagonal(scale) * Mat3::from_quat(second);
        let matrix = Affine3A::from_mat3(linear);
        let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis].map(|axis| axis.as_dvec3().normalize());
        let cosines = [x.dot(y), x.dot(z), y.dot(z)].map(f64::abs);
        let most = cosines.into_iter().fold(0.0, f64::max);
        // Beyond that an axis lies along another and the rest of it is lost in f32.
        prop_assume!(most < 0.95 && x.cross(y).dot(z).abs() > 0.05);
        prop_assert_eq!(TransformParts::of_matrix(&matrix).is_sheared(), most > 1e-4);
        if most > 1e-4 {
            check_parts(&matrix, 1e-4);
        }
    }
}

#[test]
fn a_pole_of_the_angles_still_gives_the_rotation() {
    for y in [90.0_f32, -90.0, 89.999, -90.001, 180.0] {
        for x in [0.0_f32, 33.0, -170.0] {
            let rotation = Quat::from_rotation_z(0.4)
                * Quat::from_rotation_y(y.to_radians())
                * Quat::from_rotation_x(x.to_radians());
            check_parts(&Affine3A::from_quat(rotation), 1e-5);
        }
    }
}

#[test]
fn matrices_that_flatten_space_have_parts_without_nan() {
    let flat = |x: Vec3, y: Vec3, z: Vec3| Affine3A::from_mat3(Mat3::from_cols(x, y, z));
    let (x, y, z, zero) = (Vec3::X * 2.0, Vec3::new(0.0, 0.0, 3.0), Vec3::NEG_Y, Vec3::ZERO);
    for matrix in [
        flat(zero, zero, zero),
        flat(x, zero, zero),
        flat(zero, y, zero),
        flat(zero, zero, z),
        flat(zero, y, z),
        flat(x, zero, z),
        flat(x, y, zero),
        flat(x, x, x),
        flat(Vec3::splat(1e-30), y, z),
    ] {
        let parts = TransformParts::of_matrix(&matrix);
        assert!(
            parts.rotation.is_normalized() && parts.euler_xyz_degrees.is_finite(),
            "{parts:?}"
        );
        assert!(parts.scale.is_finite() && parts.shear.is_finite(), "{parts:?}");
    }
    let parts = TransformParts::of_matrix(&flat(x, y, zero));
    assert!(
        DMat3::from_quat(parts.rotation.as_dquat())
            .x_axis
            .abs_diff_eq(DVec3::X, 1e-6)
    );
    assert_eq!(parts.scale, Vec3::new(2.0, 3.0, 0.0));
}

#[test]
fn a_joint_reads_as_the_file_has_it() {
    let document = arm();
    let (model, _) = model_of(&document);
    let tree = JointTree::new(&model.skeleton);
    let mut pose = PoseBuffers::default();
    pose.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), 1.0);
    let readout = JointReadout::of(&model.skeleton, &tree, &pose, JointIndex(1)).expect("three joints");
    assert_eq!(
        (readout.bone, readout.parent_bone, readout.child_bones.as_slice()),
        (1, Some(0), [2].as_slice())
    );
    assert_eq!(readout.offset.0.as_flattened(), document.bone_offsets[1]);
    assert!(readout.local.position.abs_diff_eq(Vec3::Y, 1e-6), "on its parent");
    assert!(
        readout.model.position.abs_diff_eq(Vec3::NEG_X, 1e-6),
        "the parent has turned it to the left"
    );
    assert!(readout.local.euler_xyz_degrees.abs_diff_eq(Vec3::Z * 90.0, 1e-4));
    assert!((readout.model.euler_xyz_degrees.z.abs() - 180.0).abs() < 1e-4);
    let expected = textbook::palette(&document, 0, 1.0)[1];
    for (ours, theirs) in readout
        .final_transform
        .0
        .as_flattened()
        .iter()
        .zip(expected.as_flattened())
    {
        assert!((f64::from(*ours) - theirs).abs() < 1e-6);
    }
    assert_eq!(JointReadout::of(&model.skeleton, &tree, &pose, JointIndex(3)), None);
    assert_eq!(
        JointReadout::of(&model.skeleton, &tree, &PoseBuffers::default(), JointIndex(0)),
        None
    );
}

#[test]
fn text_names_its_layout_and_stands_in_columns() {
    let matrix = Affine3A::from_translation(Vec3::new(1.5, -20.0, 0.0));
    let text = RowMatrix::from(matrix).to_text("offset");
    let expected = "\
offset (row vectors, row by row as in the file; translation in the fourth row)
1.000000    0.000000  0.000000  0.000000
0.000000    1.000000  0.000000  0.000000
0.000000    0.000000  1.000000  0.000000
1.500000  -20.000000  0.000000  1.000000
";
    assert_eq!(text, expected);

    let parts = TransformParts::of_matrix(&(matrix * Affine3A::from_scale(Vec3::new(-1.0, 2.0, 1.0))));
    let expected = "\
position                       1.500000  -20.000000  0.000000
rotation (Euler XYZ, degrees)  0.000000    0.000000  0.000000
scale                          -1.000000    2.000000  1.000000
";
    // The first column is as wide as its widest number.
    let expected = expected.replace("  1.500000  -20", "   1.500000  -20").replace(
        "  0.000000    0.000000  0.000000\nscale",
        "   0.000000    0.000000  0.000000\nscale",
    );
    let quaternion = "quaternion (x y z w)           0.000000  0.000000  0.000000  1.000000\nmirrored\n";
    assert_eq!(parts.to_text(), format!("{expected}{quaternion}"));
}

#[test]
fn the_whole_read_out_names_bones_and_matrices() {
    let (model, _) = model_of(&arm());
    let tree = JointTree::new(&model.skeleton);
    let pose = PoseBuffers::for_skeleton(&model.skeleton);
    let text = |joint| {
        JointReadout::of(&model.skeleton, &tree, &pose, JointIndex(joint))
            .expect("there")
            .to_text()
    };
    assert!(text(0).starts_with("bone 0; root; children 1\n"));
    assert!(text(2).starts_with("bone 2; parent 1; no children\n"));
    for name in [
        "\noffset (",
        "\ntoParent (",
        "\ntoRoot (",
        "\nfinalTransform = offset · toRoot (",
    ] {
        assert!(text(1).contains(name), "{name}");
    }
}

#[test]
fn keys_are_rows_of_a_table() {
    let (model, _) = model_of(&arm());
    let clip = &model.clips[0];
    let rows: Vec<_> = key_rows(clip, &clip.tracks[1]).collect();
    assert_eq!(rows.len(), 2);
    assert_eq!(
        (rows[1].key, rows[1].time_secs, rows[1].frame),
        (1, 1.0, clip.last_frame())
    );
    assert!(rows[1].parts.euler_xyz_degrees.abs_diff_eq(Vec3::Z * 90.0, 1e-4));
    let table = key_table(clip, &clip.tracks[1]);
    let lines: Vec<Vec<&str>> = table.lines().map(|line| line.split('\t').collect()).collect();
    assert_eq!(lines.len(), 3);
    assert!(lines.iter().all(|cells| cells.len() == 16), "{table}");
    assert_eq!(lines[2][..6], ["1", "1", "1", "0", "1", "0"]);
    let number = |cell: &str| cell.parse::<f32>().expect("a number");
    let rotation = Quat::from_array([9, 10, 11, 12].map(|column| number(lines[2][column])));
    assert_eq!(rotation, clip.tracks[1].key(1).rotation, "every digit is there");
}

#[test]
fn the_soldiers_joints_are_rigid_and_put_together_again() {
    let Some(parsed) = soldier() else { return };
    let (model, _) = m3d::from_parsed(&parsed).expect("sound");
    let tree = JointTree::new(&model.skeleton);
    let mut pose = PoseBuffers::default();
    pose.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), 0.517);
    for joint in (0..model.skeleton.joint_count() as u32).map(JointIndex) {
        let readout = JointReadout::of(&model.skeleton, &tree, &pose, joint).expect("there");
        check_parts(&pose.model.0[joint.index()], 1e-4);
        assert!(!readout.model.is_mirrored(), "{readout:?}");
        let local = readout.local;
        let turned = local.rotation.as_dquat() * DQuat::IDENTITY;
        assert!(DMat3::from_quat(turned).abs_diff_eq(turned_about_axes(local.euler_xyz_degrees), 1e-5));
    }
}

#[test]
fn numbers_are_short_zero_has_no_sign_and_cells_stand_to_the_right() {
    let rows = [
        [-0.0, -1e-9, -1.5, 2.5e9],
        [f32::NAN, 1.0, 300.0, -20.0],
        [0.0; 4],
        [0.0; 4],
    ];
    assert_eq!(
        RowMatrix(rows).lines()[..2],
        [
            "0.000000  0.000000   -1.500000       2.5e9",
            "     NaN  1.000000  300.000000  -20.000000"
        ]
    );
}
