//! The environment in GPU memory: the studio or a dropped sky, blurred for every roughness, and the cube that is seen and
//! mirrored.
//!
//! Tables that the CPU makes (studio, daylight, reflectance) are made once for all renderers. Devices and pipelines are not shared:
//! WebGL2's belong to a canvas, and WebGPU tells of errors and of a loss once for each device.

use std::borrow::Cow;
use std::sync::LazyLock;

use super::buffers::{Queue, uniform_buffer};
use crate::image::{Image, ImageKind, MapKind};
use crate::light::{BRDF_TABLE_SIDE, BrdfTable, Environment, Prefiltered, sound_radiance};
use crate::scene::{Light, Pass, RenderFrame};
use crate::shaders;

/// The most texels along a side of a sky. More would hardly show: a sky is far behind the model, or mirrored in it.
const MAX_SKY_SIDE: u32 = 1024;

// Made once for all renderers of a program.
static STUDIO: LazyLock<Prefiltered> = LazyLock::new(|| Prefiltered::of(&Environment::studio()));
static DAYLIGHT: LazyLock<Environment> = LazyLock::new(Environment::daylight);

/// Maps of an environment that lights the model.
struct EnvironmentMaps {
    /// Blurred for every roughness, a level each.
    specular: wgpu::TextureView,
    level_count: u32,
    sh: [[f32; 4]; 9],
}

pub(super) struct Environments {
    /// For each light, in the order of [`Light::ALL`].
    uniforms: [wgpu::Buffer; Light::ALL.len()],
    table: wgpu::TextureView,
    studio: EnvironmentMaps,
    daylight: wgpu::TextureView,
    dropped: Option<(EnvironmentMaps, wgpu::TextureView)>,
}

impl Environments {
    pub(super) fn new(device: &wgpu::Device, queue: &Queue) -> Self {
        Self {
            uniforms: Light::ALL.map(|_| uniform_buffer::<shaders::Environment>(device, "environment")),
            table: table(device, queue),
            studio: EnvironmentMaps::upload(device, queue, &STUDIO),
            daylight: Cube {
                side: DAYLIGHT.side() as u32,
                format: wgpu::TextureFormat::Rgba8UnormSrgb,
                levels: vec![DAYLIGHT.to_rgba8_srgb()],
            }
            .upload(device, queue, "daylight"),
            dropped: None,
        }
    }

    /// Sets a cube map as the sky; without one, the studio and its daylight come back. False, and nothing changes, when the image
    /// is no cube map.
    pub(super) fn set_sky(&mut self, device: &wgpu::Device, queue: &Queue, image: Option<&Image>) -> bool {
        let Some(image) = image else {
            self.dropped = None;
            return true;
        };
        let (Some(environment), Some(cube)) = (Environment::from_image(image), Cube::of(device, image)) else {
            return false;
        };
        let maps = EnvironmentMaps::upload(device, queue, &Prefiltered::of(&environment));
        self.dropped = Some((maps, cube.upload(device, queue, "sky")));
        true
    }

    /// Writes how the environment of a frame is turned. The studio keeps its place beside the viewer, as if the model stood on a
    /// turntable. A sky stands in the world, and so does the daylight of the book light.
    pub(super) fn write(&self, queue: &Queue, frame: &RenderFrame<'_>) {
        let maps = self.maps();
        for light in Light::ALL {
            let studio_yaw = match (&self.dropped, light) {
                (None, Light::Studio) => frame.camera.yaw_radians,
                _ => 0.0,
            };
            // The turn about y that brings the world's x to the environment's.
            let turn = frame.options.environment_turn_radians + studio_yaw;
            let uniform = shaders::Environment {
                sh: maps.sh,
                turn_cos: turn.cos(),
                turn_sin: -turn.sin(),
                intensity: 1.0,
                specular_level_count: if frame.options.passes.has(Pass::Environment) {
                    maps.level_count as f32
                } else {
                    0.0
                },
            };
            queue.write_buffer(self.uniforms(light), 0, bytemuck::bytes_of(&uniform));
        }
    }

    pub(super) fn uniforms(&self, light: Light) -> &wgpu::Buffer {
        &self.uniforms[light as usize]
    }

    pub(super) fn table(&self) -> &wgpu::TextureView {
        &self.table
    }

    /// The cube that is blurred for every roughness.
    pub(super) fn specular(&self) -> &wgpu::TextureView {
        &self.maps().specular
    }

    /// The cube that is seen behind the model, and that the book light mirrors.
    pub(super) fn sky(&self, light: Light) -> &wgpu::TextureView {
        match (&self.dropped, light) {
            (Some((_, sky)), _) => sky,
            (None, Light::Book) => &self.daylight,
            (None, Light::Studio) => &self.studio.specular,
        }
    }

    fn maps(&self) -> &EnvironmentMaps {
        self.dropped.as_ref().map_or(&self.studio, |(maps, _)| maps)
    }
}

impl EnvironmentMaps {
    fn upload(device: &wgpu::Device, queue: &Queue, prefiltered: &Prefiltered) -> Self {
        let levels = (0..prefiltered.level_count()).filter_map(|level| prefiltered.level_rgba16f(level));
        let cube = Cube {
            side: prefiltered.side(),
            format: wgpu::TextureFormat::Rgba16Float,
            levels: levels.map(|texels| bytemuck::cast_slice(&texels).to_vec()).collect(),
        };
        Self {
            specular: cube.upload(device, queue, "environment"),
            level_count: prefiltered.level_count(),
            sh: prefiltered.irradiance().to_uniform(),
        }
    }
}

/// Six faces with levels, ready to upload.
struct Cube {
    side: u32,
    format: wgpu::TextureFormat,
    /// From the largest, each half the side of the one before; faces one after another.
    levels: Vec<Vec<u8>>,
}

impl Cube {
    /// The image's largest level that fits, decoded. When all are too large, the smallest is averaged down.
    fn of(device: &wgpu::Device, image: &Image) -> Option<Self> {
        if image.kind() != ImageKind::Cube {
            return None;
        }
        let limit = device.limits().max_texture_dimension_2d.min(MAX_SKY_SIDE);
        let fits = (0..image.level_count()).find(|&level| image.level_size(level).0 <= limit);
        let (image, level) = match fits {
            Some(level) => (Cow::Borrowed(image), level),
            None => {
                let smallest = image.reduced(image.level_count() - 1, MapKind::Diffuse, limit)?;
                (Cow::Owned(smallest), 0)
            }
        };
        let (side, height) = image.level_size(level);
        if side != height {
            return None;
        }
        let faces = 0..6;
        let (format, texels) = if image.format().is_float() {
            let halves = |face| image.to_rgba32f(face, level).map(|texels| half_floats(&texels));
            (
                wgpu::TextureFormat::Rgba16Float,
                faces.map(halves).collect::<Option<Vec<_>>>()?,
            )
        } else {
            let bytes = |face| image.to_rgba8(face, level);
            (
                wgpu::TextureFormat::Rgba8UnormSrgb,
                faces.map(bytes).collect::<Option<Vec<_>>>()?,
            )
        };
        Some(Self {
            side,
            format,
            levels: vec![texels.concat()],
        })
    }

    fn upload(&self, device: &wgpu::Device, queue: &Queue, label: &str) -> wgpu::TextureView {
        let size = |side| wgpu::Extent3d {
            width: side,
            height: side,
            depth_or_array_layers: 6,
        };
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: size(self.side),
            mip_level_count: self.levels.len() as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: self.format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let texel_bytes = self.format.block_copy_size(None).unwrap_or_default();
        for (mip_level, texels) in (0..).zip(&self.levels) {
            let side = (self.side >> mip_level).max(1);
            queue.write_texture(
                wgpu::TexelCopyTextureInfo {
                    mip_level,
                    ..texture.as_image_copy()
                },
                texels,
                wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(side * texel_bytes),
                    rows_per_image: Some(side),
                },
                size(side),
            );
        }
        texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::Cube),
            ..Default::default()
        })
    }
}

/// Radiance of a file. All of it becomes finite: filtering would spread what is not.
fn half_floats(texels: &[f32]) -> Vec<u8> {
    let halves = texels
        .iter()
        .map(|&value| crate::image::half::from_f32(sound_radiance(value)));
    halves.flat_map(u16::to_ne_bytes).collect()
}

fn table(device: &wgpu::Device, queue: &Queue) -> wgpu::TextureView {
    static TABLE: LazyLock<BrdfTable> = LazyLock::new(|| BrdfTable::new(BRDF_TABLE_SIDE));
    let side = TABLE.side() as u32;
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("reflectances"),
        size: wgpu::Extent3d {
            width: side,
            height: side,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rg16Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(side * 4),
        rows_per_image: None,
    };
    let entries = TABLE.to_rg16f();
    queue.write_texture(
        texture.as_image_copy(),
        bytemuck::cast_slice(&entries),
        layout,
        texture.size(),
    );
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
