//! The model in other poses, as veils.

use super::bones::BoneTexture;
use super::model::{GpuModel, Posed};
use super::overlay::Style;
use super::pipelines::Pipelines;
use super::recipe::ModelDraw;
use crate::scene::RenderFrame;
use crate::shaders::Veil;

/// One pose in GPU memory.
struct GpuGhost {
    bones: BoneTexture,
    style: Style,
}

/// As many as were ever shown at once of one skeleton.
#[derive(Default)]
pub(super) struct Ghosts {
    ghosts: Vec<GpuGhost>,
    joint_count: usize,
    shown: usize,
}

impl Ghosts {
    /// Uploads the frame's ghosts.
    pub(super) fn write(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        pipelines: &Pipelines,
        frame: &RenderFrame<'_>,
    ) {
        let palettes = frame.ghosts.palettes;
        let joint_count = palettes.first().map_or(0, |palette| palette.0.len());
        if joint_count != self.joint_count {
            self.ghosts.clear();
            self.joint_count = joint_count;
        }
        let layouts = &pipelines.layouts;
        self.ghosts
            .resize_with(self.ghosts.len().max(palettes.len()), || GpuGhost {
                bones: BoneTexture::new(device, &layouts.bones, joint_count),
                style: Style::new(device, layouts),
            });
        self.shown = palettes.len();
        let given = palettes.iter().zip(frame.ghosts.colors_srgb);
        for (ghost, (palette, color_srgb)) in self.ghosts.iter_mut().zip(given) {
            ghost.bones.write(queue, palette);
            let veil = Veil {
                color_srgb: color_srgb.map(|channel| f32::from(channel) / 255.0),
                ..Default::default()
            };
            ghost.style.write(queue, &veil);
        }
    }

    /// Draws them behind and before the finished model. Group 0 is set, and so is an empty group 2.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, model: &GpuModel, posed: Posed<'_>) {
        if !posed.skinned {
            return;
        }
        for ghost in &self.ghosts[..self.shown] {
            let posed = Posed {
                bones: &ghost.bones,
                ..posed
            };
            pass.set_bind_group(3, ghost.style.group(), &[]);
            model.draw_shape(pass, posed, ModelDraw::Highlight);
        }
    }
}
