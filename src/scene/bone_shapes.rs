//! Bones as lines and triangles to upload.

use glam::Vec3;

use super::{Bone, Bones, OverlayGeometry, Theme};
use crate::model::JointIndex;
use crate::modes::modes;

modes! {
    /// How bones are drawn.
    #[derive(Default)]
    pub enum BoneStyle {
        /// A line each.
        Lines = "lines", "Lines";
        /// A long octahedron each, thick near its joint.
        #[default]
        Octahedra = "octahedra", "Octahedra";
        /// A line each, and the axes of each joint: x red, y green, z blue.
        Axes = "axes", "Axes";
    }
}

/// Joints that are drawn in a colour of their own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MarkedJoints {
    /// The selected joint.
    pub selected: Option<JointIndex>,
    /// The joint under the pointer.
    pub hovered: Option<JointIndex>,
}

/// How a bone is marked. Bones are drawn in this order, so that marked ones lie on top.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum State {
    Plain,
    ChildOfSelected,
    Hovered,
    Selected,
}

impl State {
    const ALL: [Self; 4] = [Self::Plain, Self::ChildOfSelected, Self::Hovered, Self::Selected];
    const MARKED: [Self; 2] = [Self::Hovered, Self::Selected];

    fn of(joint: JointIndex, bones: &Bones, marked: MarkedJoints) -> Self {
        let parent = bones.parents().get(joint.index()).copied().flatten();
        if marked.selected == Some(joint) {
            Self::Selected
        } else if marked.hovered == Some(joint) {
            Self::Hovered
        } else if parent.is_some() && parent == marked.selected {
            Self::ChildOfSelected
        } else {
            Self::Plain
        }
    }
}

/// Colours of bones, sRGB with straight alpha.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoneColors {
    /// Any bone.
    pub plain: [u8; 4],
    /// Bones of the children of the selected joint.
    pub child_of_selected: [u8; 4],
    /// Bones of the joint under the pointer.
    pub hovered: [u8; 4],
    /// Bones of the selected joint.
    pub selected: [u8; 4],
}

impl BoneColors {
    /// Colours that stand out from the background of a theme.
    pub fn of(theme: Theme) -> Self {
        match theme {
            Theme::Dark => Self {
                plain: [0xFF, 0xB4, 0x54, 0xE6],
                child_of_selected: [0xA6, 0xD0, 0xFF, 0xF0],
                hovered: [0xFF, 0xFF, 0xFF, 0xFF],
                selected: [0x5A, 0xA9, 0xFF, 0xFF],
            },
            Theme::Light => Self {
                plain: [0xC2, 0x6A, 0x00, 0xE6],
                child_of_selected: [0x5B, 0x9B, 0xE0, 0xF0],
                hovered: [0x1B, 0x20, 0x29, 0xFF],
                selected: [0x17, 0x69, 0xD2, 0xFF],
            },
        }
    }

    fn get(&self, state: State) -> [u8; 4] {
        match state {
            State::Plain => self.plain,
            State::ChildOfSelected => self.child_of_selected,
            State::Hovered => self.hovered,
            State::Selected => self.selected,
        }
    }
}

/// x, y, z as every tool colours them.
pub const AXES_SRGB: [[u8; 4]; 3] = [
    [0xF2, 0x4D, 0x57, 0xFF],
    [0x80, 0xCC, 0x33, 0xFF],
    [0x3D, 0x8A, 0xFA, 0xFF],
];
/// Length of a joint's axes, as a fraction of its bone, and at most as a fraction of the scene's radius.
const AXIS_LENGTH: (f32, f32) = (0.35, 0.05);
/// Half the thickness of an octahedron, likewise.
const HALF_THICKNESS: (f32, f32) = (0.09, 0.025);
/// Where along its bone an octahedron is thickest.
const THICKEST_AT: f32 = 0.15;
/// With more bones than this, octahedra get thinner, down to the least fraction, so that thousands do not become one
/// mass.
const CROWDED_FROM: f32 = 256.0;
const LEAST_THICKNESS: f32 = 0.25;
/// Brightness of an octahedron's four sides: enough to see its form without a light.
const SIDES: [f32; 4] = [1.0, 0.84, 0.68, 0.84];

/// Appends the bones in a style to `out`.
pub fn append_bones(
    bones: &Bones,
    style: BoneStyle,
    marked: MarkedJoints,
    colors: BoneColors,
    out: &mut OverlayGeometry,
) {
    draw_states(&State::ALL, bones, style, marked, colors, out);
}

/// Appends only the bones of the hovered and of the selected joint.
pub fn append_marked_bones(
    bones: &Bones,
    style: BoneStyle,
    marked: MarkedJoints,
    colors: BoneColors,
    out: &mut OverlayGeometry,
) {
    if marked != MarkedJoints::default() {
        draw_states(&State::MARKED, bones, style, marked, colors, out);
    }
}

fn draw_states(
    states: &[State],
    bones: &Bones,
    style: BoneStyle,
    marked: MarkedJoints,
    colors: BoneColors,
    out: &mut OverlayGeometry,
) {
    let crowding = (CROWDED_FROM / bones.bones().len().max(1) as f32).sqrt();
    let thinness = crowding.clamp(LEAST_THICKNESS, 1.0);
    for &state in states {
        let color = colors.get(state);
        let in_state = bones
            .bones()
            .iter()
            .filter(|bone| State::of(bone.joint, bones, marked) == state);
        for bone in in_state {
            match style {
                BoneStyle::Lines => out.line(bone.from, bone.to, color),
                BoneStyle::Octahedra => octahedron(bones, bone, thinness, color, out),
                BoneStyle::Axes => {
                    out.line(bone.from, bone.to, color);
                    axes(bones, bone, out);
                }
            }
        }
    }
}

fn axes(bones: &Bones, bone: &Bone, out: &mut OverlayGeometry) {
    let (of_bone, of_scene) = AXIS_LENGTH;
    let length = (bone.from.distance(bone.to) * of_bone).min(bones.scene_radius() * of_scene);
    let linear = bones.world_from_joint()[bone.joint.index()].matrix3;
    let axes = [linear.x_axis, linear.y_axis, linear.z_axis];
    for (axis, color) in axes.into_iter().zip(AXES_SRGB) {
        let way = Vec3::from(axis).normalize_or_zero() * length;
        out.line(bone.from, bone.from + way, color);
    }
}

fn octahedron(bones: &Bones, bone: &Bone, thinness: f32, color: [u8; 4], out: &mut OverlayGeometry) {
    let (of_bone, of_scene) = HALF_THICKNESS;
    let way = bone.to - bone.from;
    let along = way.normalize_or(Vec3::Y);
    let half = (way.length() * of_bone).min(bones.scene_radius() * of_scene) * thinness;
    // Beside the joint's own axes, so that the sides turn with the joint.
    let linear = bones.world_from_joint()[bone.joint.index()].matrix3;
    let beside = [linear.x_axis, linear.y_axis, linear.z_axis]
        .map(|axis| Vec3::from(axis).normalize_or_zero())
        .map(|axis| axis - along * axis.dot(along))
        .into_iter()
        .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
        .and_then(Vec3::try_normalize)
        .unwrap_or_else(|| along.any_orthonormal_vector());
    let (u, v) = (beside * half, along.cross(beside) * half);
    let middle = bone.from + way * THICKEST_AT;
    let ring = [middle + u, middle + v, middle - u, middle - v];
    for (side, brightness) in SIDES.into_iter().enumerate() {
        let (corner, next) = (ring[side], ring[(side + 1) % 4]);
        let color = shaded(color, brightness);
        out.triangle([bone.to, corner, next], color);
        out.triangle([bone.from, next, corner], color);
    }
}

fn shaded([red, green, blue, alpha]: [u8; 4], brightness: f32) -> [u8; 4] {
    let [red, green, blue] = [red, green, blue].map(|channel| (f32::from(channel) * brightness).round() as u8);
    [red, green, blue, alpha]
}
