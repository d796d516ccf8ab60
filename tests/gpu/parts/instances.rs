//! Matrices as the GPU has them.

use bindpose::render::for_tests::rows;
use glam::{Affine3A, Vec3};

#[test]
fn rows_times_a_point_is_the_transformed_point() {
    let affine = Affine3A::from_cols_array(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, -1.0, -2.0, -3.0]);
    let point = Vec3::new(0.5, -2.0, 4.0);
    let by_rows = rows(&affine).map(|row| glam::Vec4::from(row).dot(point.extend(1.0)));
    assert_eq!(Vec3::from(by_rows), affine.transform_point3(point));
}
