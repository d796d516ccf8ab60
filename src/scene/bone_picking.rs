//! Bones in the picture: which one is under the pointer, and where names are placed.

use std::collections::HashMap;

use glam::{Mat4, Vec2, Vec3, Vec4, Vec4Swizzles};

use super::Bones;
use crate::model::JointIndex;

/// Bones whose distances from the pointer differ by less than this fraction of the radius count as equally near. Of
/// those the one nearest to the eye is picked.
const EQUALLY_NEAR: f32 = 0.3;

/// A picture's projection and shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// World -> clip, depth 0…1.
    pub clip_from_world: Mat4,
    /// Width / height.
    pub aspect: f32,
}

impl Screen {
    /// A point of the picture (x right, y up, −1…1) in heights of the picture.
    fn in_heights(&self, point: Vec2) -> Vec2 {
        Vec2::new(point.x * self.aspect, point.y) * 0.5
    }

    /// Position of a world point in the picture: x right, y up, −1…1, z its depth 0…1. `None` outside the picture and
    /// behind the eye.
    pub fn place(&self, position: Vec3) -> Option<Vec3> {
        let clip = self.clip(position);
        let place = clip.xyz() / clip.w;
        let in_view = clip.w > 0.0 && place.truncate().abs().max_element() <= 1.0 && (0.0..=1.0).contains(&place.z);
        in_view.then_some(place)
    }

    fn clip(&self, position: Vec3) -> Vec4 {
        self.clip_from_world * position.extend(1.0)
    }
}

/// Distance of something from the pointer, and its depth there.
#[derive(Clone, Copy)]
struct Near {
    joint: JointIndex,
    distance: f32,
    depth: f32,
}

/// The joint at a point of the picture (x right, y up, −1…1), at most `radius` away from it, in heights of the picture.
/// Joints are tried before bones; a bone gives the joint that it turns with. Of several that are about equally near on
/// screen, the one nearest to the eye is picked.
pub fn pick_joint(bones: &Bones, screen: &Screen, pointer: Vec2, radius: f32) -> Option<JointIndex> {
    let pointer = screen.in_heights(pointer);
    let places = bones
        .world_from_joint()
        .iter()
        .enumerate()
        .filter_map(|(joint, world_from_joint)| {
            let clip = screen.clip(world_from_joint.translation.into());
            near_segment(screen, JointIndex(joint as u32), clip, clip, pointer)
        });
    let lines = bones.bones().iter().filter_map(|bone| {
        near_segment(
            screen,
            bone.joint,
            screen.clip(bone.from),
            screen.clip(bone.to),
            pointer,
        )
    });
    first(places, radius).or_else(|| first(lines, radius))
}

fn first(near: impl Iterator<Item = Near> + Clone, radius: f32) -> Option<JointIndex> {
    let near = near.filter(|near| near.distance <= radius);
    let nearest = near.clone().map(|near| near.distance).min_by(f32::total_cmp)?;
    let equally_near = near.filter(|near| near.distance <= nearest + radius * EQUALLY_NEAR);
    let first = equally_near.min_by(|a, b| a.depth.total_cmp(&b.depth).then(a.distance.total_cmp(&b.distance)))?;
    Some(first.joint)
}

/// The point of a segment that is nearest to the pointer on screen. The part in front of the near plane is cut away.
fn near_segment(screen: &Screen, joint: JointIndex, from: Vec4, to: Vec4, pointer: Vec2) -> Option<Near> {
    let (from, to) = before_eye(from, to)?;
    let [start, end] = [from, to].map(|clip| screen.in_heights(clip.xy() / clip.w));
    let way = end - start;
    let length_squared = way.length_squared();
    let fraction = if length_squared > 0.0 {
        ((pointer - start).dot(way) / length_squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let distance = (start + way * fraction).distance(pointer);
    // z / w is straight along a segment on screen.
    let depth = (from.z / from.w) * (1.0 - fraction) + (to.z / to.w) * fraction;
    (distance.is_finite() && depth <= 1.0).then_some(Near { joint, distance, depth })
}

/// The part of a segment behind the near plane, where z is 0.
fn before_eye(from: Vec4, to: Vec4) -> Option<(Vec4, Vec4)> {
    let cut = |inside: Vec4, outside: Vec4| inside.lerp(outside, inside.z / (inside.z - outside.z));
    let in_front = |clip: Vec4| clip.z >= 0.0 && clip.w > 0.0;
    match (in_front(from), in_front(to)) {
        (true, true) => Some((from, to)),
        (true, false) => Some((from, cut(from, to))),
        (false, true) => Some((cut(to, from), to)),
        (false, false) => None,
    }
}

/// Where a joint's name is placed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LabelPlace {
    /// The joint.
    pub joint: JointIndex,
    /// Position in the picture: x right, y up, −1…1.
    pub position: Vec2,
    /// Depth, 0 near … 1 far.
    pub depth: f32,
}

/// Positions of joints in the picture, for their names: `first` comes first, then the others from near to far. A joint
/// closer than `spacing` (heights of the picture) to an earlier one is left out, so that names stay readable with
/// thousands of joints; 0 leaves out none.
pub fn label_places(bones: &Bones, screen: &Screen, spacing: f32, first: &[JointIndex], places: &mut Vec<LabelPlace>) {
    places.clear();
    let joints = (0u32..).map(JointIndex).zip(bones.world_from_joint());
    places.extend(joints.filter_map(|(joint, world_from_joint)| {
        let place = screen.place(world_from_joint.translation.into())?;
        Some(LabelPlace {
            joint,
            position: place.truncate(),
            depth: place.z,
        })
    }));
    let rank = |place: &LabelPlace| {
        first
            .iter()
            .position(|&joint| joint == place.joint)
            .unwrap_or(first.len())
    };
    places.sort_by(|a, b| rank(a).cmp(&rank(b)).then(a.depth.total_cmp(&b.depth)));
    if spacing > 0.0 {
        let mut taken = Taken::new(spacing);
        places.retain(|place| taken.take(screen.in_heights(place.position)));
    }
}

/// Points that keep a least distance from each other, in a grid of cells of that size: one point a cell.
struct Taken {
    spacing: f32,
    cells: HashMap<[i32; 2], Vec2>,
}

impl Taken {
    fn new(spacing: f32) -> Self {
        Self {
            spacing,
            cells: HashMap::new(),
        }
    }

    /// Takes a point if it is far enough from all points taken before.
    fn take(&mut self, point: Vec2) -> bool {
        let cell = (point / self.spacing).floor().as_ivec2().to_array();
        let around = (-1..=1).flat_map(|x| (-1..=1).map(move |y| [x, y]));
        let mut neighbours = around.filter_map(|[x, y]| {
            let cell = [cell[0].saturating_add(x), cell[1].saturating_add(y)];
            self.cells.get(&cell)
        });
        let free = !self.cells.contains_key(&cell) && neighbours.all(|taken| taken.distance(point) >= self.spacing);
        if free {
            self.cells.insert(cell, point);
        }
        free
    }
}
