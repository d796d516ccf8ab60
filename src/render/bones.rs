//! Joint matrices in a texture: any number of them within the limits of WebGL2, where a uniform block holds 256.

use glam::Affine3A;

use crate::anim::Palette;
use crate::shaders::JOINTS_PER_ROW;

/// Rows of a 3×4 matrix, a texel each.
const TEXELS_PER_JOINT: u32 = 3;
const BYTES_PER_TEXEL: u32 = 16;

/// `model_from_bind` of each joint as three texels, [`JOINTS_PER_ROW`] joints a row: what `skinning.wgsl` reads as group 1.
pub struct BoneTexture {
    texture: wgpu::Texture,
    group: wgpu::BindGroup,
    joint_count: usize,
    /// Texels as they are uploaded, whole rows.
    texels: Vec<[f32; 4]>,
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

    /// The greatest number of joints that fits a device.
    pub fn max_joints(limits: &wgpu::Limits) -> usize {
        limits.max_texture_dimension_2d as usize * JOINTS_PER_ROW as usize
    }

    /// Sized for `joint_count` joints, at most [`BoneTexture::max_joints`]; one row at least. To be written before it is read.
    pub fn new(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, joint_count: usize) -> Self {
        let rows = (joint_count as u32).div_ceil(JOINTS_PER_ROW).max(1);
        let width = JOINTS_PER_ROW * TEXELS_PER_JOINT;
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("bones"),
            size: wgpu::Extent3d {
                width,
                height: rows,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("bones"),
            layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(&texture.create_view(&Default::default())),
            }],
        });
        Self {
            texture,
            group,
            joint_count,
            texels: vec![[0.0; 4]; (rows * width) as usize],
        }
    }

    /// To be set as group 1.
    pub fn group(&self) -> &wgpu::BindGroup {
        &self.group
    }

    /// Uploads a palette. Matrices that it lacks are identities, what it has beyond the joints of the texture is left out.
    pub fn write(&mut self, queue: &wgpu::Queue, palette: &Palette) {
        let joints = self
            .texels
            .chunks_exact_mut(TEXELS_PER_JOINT as usize)
            .take(self.joint_count);
        let matrices = palette.0.iter().chain(std::iter::repeat(&Affine3A::IDENTITY));
        for (texels, model_from_bind) in joints.zip(matrices) {
            texels.copy_from_slice(&rows(model_from_bind));
        }
        let size = self.texture.size();
        queue.write_texture(
            self.texture.as_image_copy(),
            bytemuck::cast_slice(&self.texels),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(size.width * BYTES_PER_TEXEL),
                rows_per_image: None,
            },
            size,
        );
    }
}

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
