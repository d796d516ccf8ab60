//! The few points by which a moving model is framed.

use glam::Vec3;

use super::{PoseBuffers, skin_positions};
use crate::model::{Clip, Model};

/// Lines along which the farthest points are kept, both ways. With 32 the hull of a round thing is short by about 3 %.
const AXES: usize = 32;
/// Times of a clip that are looked at, evenly spread.
const TIMES: usize = 12;
/// Vertices looked at per time; of a larger mesh every n-th.
const MOST_VERTICES: usize = 20_000;

/// Points of the mesh, in model space, that lie farthest in many directions over a clip, or in bind space without one.
/// Their hull is nearly that of all the model reaches, and they are at most `2 · 32` a time.
pub fn extreme_points(model: &Model, clip: Option<&Clip>) -> Vec<Vec3> {
    let mesh = &model.mesh;
    let stride = mesh.vertex_count().div_ceil(MOST_VERTICES).max(1);
    let axes = axes();
    let mut points = Vec::new();
    let Some(clip) = clip.filter(|_| !mesh.influences.is_empty()) else {
        keep_extremes(&axes, mesh.positions.iter().step_by(stride), &mut points);
        return points;
    };
    let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
    let mut positions = Vec::with_capacity(mesh.vertex_count());
    for i in 0..TIMES {
        let share = i as f32 / (TIMES - 1) as f32;
        buffers.evaluate(&model.skeleton, clip, clip.start_secs + share * clip.duration_secs());
        skin_positions(mesh, &buffers.palette, &mut positions);
        keep_extremes(&axes, positions.iter().step_by(stride), &mut points);
        if clip.duration_secs() <= 0.0 {
            break;
        }
    }
    points
}

/// Directions spread evenly over half a sphere (a Fibonacci lattice).
fn axes() -> [Vec3; AXES] {
    let golden_angle = std::f32::consts::PI * (3.0 - 5.0_f32.sqrt());
    std::array::from_fn(|i| {
        let y = 1.0 - (i as f32 + 0.5) / AXES as f32;
        let (sin, cos) = (golden_angle * i as f32).sin_cos();
        let radius = (1.0 - y * y).sqrt();
        Vec3::new(radius * cos, y, radius * sin)
    })
}

fn keep_extremes<'a>(axes: &[Vec3], points: impl Iterator<Item = &'a Vec3>, kept: &mut Vec<Vec3>) {
    let mut extremes: Vec<[(f32, Option<Vec3>); 2]> = vec![[(f32::NEG_INFINITY, None); 2]; axes.len()];
    for &point in points {
        for (axis, [far, near]) in axes.iter().zip(&mut extremes) {
            let along = axis.dot(point);
            if along > far.0 {
                *far = (along, Some(point));
            }
            if -along > near.0 {
                *near = (-along, Some(point));
            }
        }
    }
    kept.extend(extremes.iter().flatten().filter_map(|(_, point)| *point));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Mesh;

    #[test]
    fn the_corners_of_a_box_are_kept_and_its_inside_is_not() {
        let mut positions = vec![Vec3::ZERO, Vec3::splat(0.3)];
        positions.extend(
            crate::model::Aabb {
                min: Vec3::new(-1.0, -2.0, -3.0),
                max: Vec3::new(4.0, 5.0, 6.0),
            }
            .corners(),
        );
        let mesh = Mesh {
            positions: positions.clone(),
            ..Mesh::default()
        };
        let points = extreme_points(
            &Model {
                mesh,
                ..Model::default()
            },
            None,
        );
        assert!(positions[2..].iter().all(|corner| points.contains(corner)));
        assert!(!points.contains(&Vec3::ZERO) && !points.contains(&Vec3::splat(0.3)));
    }

    #[test]
    fn nothing_has_no_extremes() {
        assert!(extreme_points(&Model::default(), None).is_empty());
    }
}
