//! Where the instances of the model stand and how they are posed: a vertex stream with an entry for each, and their joint matrices
//! in a texture.

use std::ops::Range;

use glam::Affine3A;

use super::buffers::bind_group;
use super::uniforms::{encoded, theme_colors};
use crate::anim::Palette;
use crate::scene::RenderFrame;
use crate::shaders::{Instance, JOINTS_PER_ROW};

/// Rows of a 3×4 matrix, a texel each.
const TEXELS_PER_JOINT: u32 = 3;
const TEXELS_PER_ROW: u32 = JOINTS_PER_ROW * TEXELS_PER_JOINT;
const BYTES_PER_TEXEL: u32 = 16;

/// Palettes one after another: `model_from_bind` of each joint as three texels, [`JOINTS_PER_ROW`] joints a row. It is what
/// `skinning.wgsl` reads as group 1. A uniform block of WebGL2 would hold 256 joints; this holds any number.
pub struct BoneTexture {
    device: wgpu::Device,
    layout: wgpu::BindGroupLayout,
    texture: wgpu::Texture,
    group: wgpu::BindGroup,
    /// Joints of one palette.
    joint_count: usize,
    palette_count: usize,
    /// Texels as they were uploaded last, whole rows.
    texels: Vec<[f32; 4]>,
    /// Those of the upload before, as a buffer for the next.
    texels_before: Vec<[f32; 4]>,
}

impl BoneTexture {
    /// The layout of its bind group.
    pub fn layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("bones"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX,
                ty: wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: false },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
                count: None,
            }],
        })
    }

    /// The greatest number of joints, of all palettes together, that fits a device.
    pub fn max_joints(limits: &wgpu::Limits) -> usize {
        limits.max_texture_dimension_2d as usize * JOINTS_PER_ROW as usize
    }

    /// For palettes of `joint_count` joints, at most [`BoneTexture::max_joints`]. To be written before it is read.
    pub fn new(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, joint_count: usize) -> Self {
        let rows = (joint_count as u32).div_ceil(JOINTS_PER_ROW).max(1);
        let (texture, group) = texture(device, layout, rows);
        Self {
            device: device.clone(),
            layout: layout.clone(),
            texture,
            group,
            joint_count,
            palette_count: 0,
            texels: Vec::new(),
            texels_before: Vec::new(),
        }
    }

    /// To be set as group 1.
    pub fn group(&self) -> &wgpu::BindGroup {
        &self.group
    }

    /// Uploads palettes, as many as fit the device, unless they are there already. Matrices that a palette lacks are identities;
    /// those beyond the joint count are left out.
    pub fn write<'a>(&mut self, queue: &wgpu::Queue, palettes: impl IntoIterator<Item = &'a Palette>) {
        let most = Self::max_joints(&self.device.limits()) / self.joint_count.max(1);
        std::mem::swap(&mut self.texels, &mut self.texels_before);
        self.texels.clear();
        self.palette_count = 0;
        for palette in palettes.into_iter().take(most) {
            let matrices = palette.0.iter().chain(std::iter::repeat(&Affine3A::IDENTITY));
            self.texels.extend(matrices.take(self.joint_count).flat_map(rows));
            self.palette_count += 1;
        }
        let height = (self.texels.len() as u32).div_ceil(TEXELS_PER_ROW);
        self.texels.resize((height * TEXELS_PER_ROW) as usize, [0.0; 4]);
        if self.texels == self.texels_before {
            return;
        }
        if height > self.texture.height() {
            (self.texture, self.group) = texture(&self.device, &self.layout, height);
        }
        queue.write_texture(
            self.texture.as_image_copy(),
            bytemuck::cast_slice(&self.texels),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(TEXELS_PER_ROW * BYTES_PER_TEXEL),
                rows_per_image: None,
            },
            wgpu::Extent3d {
                height,
                ..self.texture.size()
            },
        );
    }
}

fn texture(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, height: u32) -> (wgpu::Texture, wgpu::BindGroup) {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("bones"),
        size: wgpu::Extent3d {
            width: TEXELS_PER_ROW,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let group = bind_group(device, "bones", layout, [wgpu::BindingResource::TextureView(&view)]);
    (texture, group)
}

/// Opacity of the highlight at a surface's edge.
const HIGHLIGHT_OPACITY: f32 = 0.55;

/// The instances of a frame, as a vertex stream with one entry an instance. There are three kinds, one after another: the model
/// itself; the model again in the colour of the highlight; the ghosts. The model has one instance; a second one would be a second
/// entry of the first two kinds.
pub(super) struct Instances {
    buffer: wgpu::Buffer,
    count: u32,
}

/// A range of the stream.
#[derive(Clone, Copy)]
pub(super) struct InstanceRange<'a> {
    buffer: &'a wgpu::Buffer,
    first: u32,
    pub(super) count: u32,
}

/// Each instance is there twice. A draw of triangles steps over both at each instance. A draw of a line at each vertex reads one
/// for each end of the line, since there the mesh's vertices are the instances.
type Entry = [Instance; 2];

impl Instances {
    const MODEL: Range<u32> = 0..1;
    const HIGHLIGHT: Range<u32> = 1..2;

    pub(super) fn new(device: &wgpu::Device) -> Self {
        Self {
            buffer: stream(device, 2),
            count: 0,
        }
    }

    /// Uploads the frame's instances. The ghosts' palettes follow the model's in `bones`. `winding` is +1 when the model's
    /// triangles are clockwise from their front in a left-handed space, else −1.
    pub(super) fn write(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        frame: &RenderFrame<'_>,
        bones: Option<&BoneTexture>,
        winding: f32,
    ) {
        let mirrors = frame.world_from_model.matrix3.determinant() < 0.0;
        let model = Instance {
            rows: rows(&frame.world_from_model),
            tint_srgb: [1.0; 4],
            first_joint: 0,
            front_sign: if mirrors { -winding } else { winding },
        };
        let accent = theme_colors(frame.options.theme).accent;
        let highlight = Instance {
            tint_srgb: encoded(accent, HIGHLIGHT_OPACITY),
            ..model
        };
        let (palettes, joints) = bones.map_or((0, 0), |bones| (bones.palette_count, bones.joint_count));
        let ghost = |(palette, color_srgb): (usize, &[u8; 4])| Instance {
            tint_srgb: color_srgb.map(|channel| f32::from(channel) / 255.0),
            first_joint: (palette * joints) as u32,
            ..model
        };
        let ghosts = (1..palettes).zip(frame.ghosts.colors_srgb).map(ghost);
        let entries: Vec<Entry> = [model, highlight]
            .into_iter()
            .chain(ghosts)
            .map(|one| [one; 2])
            .collect();
        let bytes: &[u8] = bytemuck::cast_slice(&entries);
        if bytes.len() as u64 > self.buffer.size() {
            self.buffer = stream(device, entries.len());
        }
        queue.write_buffer(&self.buffer, 0, bytes);
        self.count = entries.len() as u32;
    }

    /// The model itself.
    pub(super) fn model(&self) -> InstanceRange<'_> {
        self.range(Self::MODEL)
    }

    /// The model in the colour of the highlight.
    pub(super) fn highlight(&self) -> InstanceRange<'_> {
        self.range(Self::HIGHLIGHT)
    }

    /// The model in other poses, each by itself.
    pub(super) fn ghosts(&self) -> impl Iterator<Item = InstanceRange<'_>> {
        (Self::HIGHLIGHT.end..self.count).map(|ghost| self.range(ghost..ghost + 1))
    }

    fn range(&self, range: Range<u32>) -> InstanceRange<'_> {
        InstanceRange {
            buffer: &self.buffer,
            first: range.start,
            count: range.len() as u32,
        }
    }
}

impl<'a> InstanceRange<'a> {
    /// The stream from the range's instance with this index on. WebGL2 has no first instance, so the buffer starts there.
    pub(super) fn from(self, index: u32) -> wgpu::BufferSlice<'a> {
        self.buffer
            .slice(u64::from(self.first + index) * size_of::<Entry>() as u64..)
    }
}

fn stream(device: &wgpu::Device, count: usize) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("instances"),
        size: (count * size_of::<Entry>()) as u64,
        usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// The rows of a matrix as texels or vertex attributes.
fn rows(affine: &Affine3A) -> [[f32; 4]; 3] {
    let [x, y, z] = affine.matrix3.transpose().to_cols_array_2d();
    let t = affine.translation.to_array();
    [
        [x[0], x[1], x[2], t[0]],
        [y[0], y[1], y[2], t[1]],
        [z[0], z[1], z[2], t[2]],
    ]
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn rows_times_a_point_is_the_transformed_point() {
        let affine = Affine3A::from_cols_array(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, -1.0, -2.0, -3.0]);
        let point = Vec3::new(0.5, -2.0, 4.0);
        let by_rows = rows(&affine).map(|row| glam::Vec4::from(row).dot(point.extend(1.0)));
        assert_eq!(Vec3::from(by_rows), affine.transform_point3(point));
    }
}
