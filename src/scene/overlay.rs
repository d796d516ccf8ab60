//! Lines and triangles over the model: what a renderer uploads as it is.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// A corner of what lies over the model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct OverlayVertex {
    /// World space.
    pub position: [f32; 3],
    /// sRGB, straight alpha.
    pub color_srgb: [u8; 4],
}

/// Lines and triangles in buffers to keep. What comes later is drawn later.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OverlayGeometry {
    /// Two a line.
    pub lines: Vec<OverlayVertex>,
    /// Three a triangle, clockwise seen from outside.
    pub triangles: Vec<OverlayVertex>,
}

impl OverlayGeometry {
    /// Empties both, and keeps their memory.
    pub fn clear(&mut self) {
        self.lines.clear();
        self.triangles.clear();
    }

    /// Adds a line, world space.
    pub fn line(&mut self, from: Vec3, to: Vec3, color_srgb: [u8; 4]) {
        self.lines.extend([from, to].map(|position| OverlayVertex {
            position: position.to_array(),
            color_srgb,
        }));
    }

    /// Adds a triangle, world space.
    pub fn triangle(&mut self, corners: [Vec3; 3], color_srgb: [u8; 4]) {
        self.triangles.extend(corners.map(|position| OverlayVertex {
            position: position.to_array(),
            color_srgb,
        }));
    }
}

/// A colour for each vertex of the mesh, in its order.
#[derive(Clone, Copy, Debug)]
pub struct VertexColors<'a> {
    /// sRGB; alpha is not read. Vertices beyond the slice are black.
    pub colors_srgb: &'a [[u8; 4]],
    /// Another number, other colours.
    pub revision: u64,
}

/// The model in other poses, each a veil of one colour.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ghosts<'a> {
    /// Joint matrices of each.
    pub palettes: &'a [crate::anim::Palette],
    /// sRGB, straight alpha; as many as palettes.
    pub colors_srgb: &'a [[u8; 4]],
}
