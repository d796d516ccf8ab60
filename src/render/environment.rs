//! The environment in GPU memory: the studio or a dropped sky, blurred for every roughness, and the cube that is seen and
//! mirrored.
//!
//! Tables that the CPU makes (studio, daylight, reflectance) are made once for all renderers. Devices and pipelines are not shared:
//! WebGL2's belong to a canvas, and WebGPU tells of errors and of a loss once for each device.

use std::borrow::Cow;
use std::sync::LazyLock;

use super::buffers::{Queue, uniform_buffer};
use super::maps::texture_of;
use super::target::UPLOADED_AND_READ;
use crate::image::{Image, ImageKind, MapKind};
use crate::light::{BRDF_TABLE_SIDE, BrdfTable, Environment, Prefiltered, Room, SkyLamp, sound_radiance};
use crate::scene::{Light, Pass, RenderFrame, Theme};
use crate::shaders;
use crate::slices::{Sliced, Slices};

/// The most texels along a side of a sky. More would hardly show: a sky is far behind the model, or mirrored in it.
const MAX_SKY_SIDE: u32 = 1024;

// Made once for all renderers of a program.
static STUDIOS: [LazyLock<Prefiltered>; Room::ALL.len()] = [
    LazyLock::new(|| Prefiltered::of(&Environment::coarse_studio(Room::Dark))),
    LazyLock::new(|| Prefiltered::of(&Environment::coarse_studio(Room::Bright))),
];
static DAYLIGHT: LazyLock<Environment> = LazyLock::new(Environment::daylight);

/// The studio that a theme shows.
pub(super) fn room(theme: Theme) -> Room {
    match theme {
        Theme::Dark => Room::Dark,
        Theme::Light => Room::Bright,
    }
}

/// Where the light comes from that has a direction, but for the books'.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Lamps {
    /// From the studio's lamp and its rim light, which stand beside the viewer.
    #[default]
    Studio,
    /// From the lamp of a sky, which stands in the world; from nowhere where it has none.
    Sky(Option<SkyLamp>),
}

/// Maps of an environment that lights the model.
struct EnvironmentMaps {
    /// Blurred for every roughness, a level each.
    specular: wgpu::TextureView,
    level_count: u32,
    sh: [[f32; 4]; 9],
    /// Whether they have all the texels that they will have.
    are_fine: bool,
}

/// A sky that was dropped.
struct Dropped {
    environment: Environment,
    maps: EnvironmentMaps,
    sky: wgpu::TextureView,
}

/// A large cube that is filtered while nothing moves, and then uploaded level by level.
enum Refining {
    Filtering(Sliced<Prefiltered>),
    Uploading(Prefiltered, wgpu::Texture, u32),
}

pub(super) struct Environments {
    /// For each light, in the order of [`Light::ALL`].
    uniforms: [wgpu::Buffer; Light::ALL.len()],
    table: wgpu::TextureView,
    /// The studio that was shown last.
    room: Room,
    /// For each room, made when it is first shown.
    studios: [Option<EnvironmentMaps>; Room::ALL.len()],
    daylight: wgpu::TextureView,
    dropped: Option<Dropped>,
    /// What is refined: maps of a room or, without one, of the sky.
    refining: Option<(Option<Room>, Refining)>,
}

impl Environments {
    pub(super) fn new(device: &wgpu::Device, queue: &Queue) -> Self {
        let studio = EnvironmentMaps::upload(device, queue, &STUDIOS[Room::Dark as usize]);
        Self {
            uniforms: Light::ALL.map(|_| uniform_buffer::<shaders::Environment>(device, "environment")),
            table: table(device, queue),
            room: Room::Dark,
            studios: [Some(studio), None],
            daylight: Cube {
                side: DAYLIGHT.side() as u32,
                format: wgpu::TextureFormat::Rgba8UnormSrgb,
                levels: vec![DAYLIGHT.to_rgba8_srgb()],
            }
            .upload(device, queue, "daylight"),
            dropped: None,
            refining: None,
        }
    }

    /// Sets a cube map as the sky; without one, the studio and its daylight come back. False, and nothing changes, when the image
    /// is no cube map.
    pub(super) fn set_sky(&mut self, device: &wgpu::Device, queue: &Queue, image: Option<&Image>) -> bool {
        let Some(image) = image else {
            (self.dropped, self.refining) = (None, None);
            return true;
        };
        let (Some(environment), Some(cube)) = (Environment::from_image(image), Cube::of(device, image)) else {
            return false;
        };
        let coarse = environment.coarse();
        let maps = EnvironmentMaps {
            are_fine: coarse.side() == environment.side(),
            ..EnvironmentMaps::upload(device, queue, &Prefiltered::of(&coarse))
        };
        self.dropped = Some(Dropped {
            environment,
            maps,
            sky: cube.upload(device, queue, "sky"),
        });
        self.refining = None;
        true
    }

    /// Writes how the environment of a frame is turned. The studio keeps its place beside the viewer, as if the model stood on a
    /// turntable. A sky stands in the world, and so does the daylight of the book light.
    pub(super) fn write(&mut self, device: &wgpu::Device, queue: &Queue, frame: &RenderFrame<'_>) {
        self.room = room(frame.options.theme);
        let index = self.room as usize;
        self.studios[index].get_or_insert_with(|| EnvironmentMaps::upload(device, queue, &STUDIOS[index]));
        let Some(maps) = self.maps() else { return };
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
        self.maps().map_or(&self.daylight, |maps| &maps.specular)
    }

    /// The cube that is seen behind the model, and that the book light mirrors.
    pub(super) fn sky(&self, light: Light) -> &wgpu::TextureView {
        match (&self.dropped, light) {
            (Some(dropped), _) => &dropped.sky,
            (None, Light::Book) => &self.daylight,
            (None, Light::Studio) => self.specular(),
        }
    }

    /// None before the first frame in its room.
    fn maps(&self) -> Option<&EnvironmentMaps> {
        let of_sky = self.dropped.as_ref().map(|dropped| &dropped.maps);
        of_sky.or(self.studios[self.room as usize].as_ref())
    }

    /// Where the light comes from that has a direction.
    pub(super) fn lamps(&self) -> Lamps {
        let sky = self.dropped.as_ref();
        sky.map_or(Lamps::Studio, |sky| Lamps::Sky(sky.environment.lamp().copied()))
    }

    /// Whether the environment that was shown last has all its texels.
    pub(super) fn is_fine(&self) -> bool {
        self.maps().is_none_or(|maps| maps.are_fine)
    }

    /// Works on that in a slice, always with the same slices. True when all of it is there and the cubes are exchanged: the picture is then
    /// another one.
    pub(super) fn refine(&mut self, device: &wgpu::Device, queue: &Queue, slices: &Slices) -> bool {
        let wanted = self.dropped.is_none().then_some(self.room);
        let begun = self.refining.take().filter(|(of, _)| *of == wanted);
        let refining = match begun.map(|(_, refining)| refining) {
            None => Refining::Filtering(match &self.dropped {
                Some(dropped) => {
                    let environment = dropped.environment.clone();
                    Sliced::new(slices, |slices| async move {
                        Prefiltered::of_in(&environment, &slices).await
                    })
                }
                None => {
                    let room = self.room;
                    Sliced::new(slices, |slices| async move {
                        Prefiltered::of_in(&Environment::studio_in(room, &slices).await, &slices).await
                    })
                }
            }),
            Some(Refining::Filtering(mut work)) => match work.advance() {
                None => Refining::Filtering(work),
                Some(filtered) => {
                    let texture = cube_texture(device, "environment", &filtered);
                    Refining::Uploading(filtered, texture, 0)
                }
            },
            Some(Refining::Uploading(filtered, texture, level)) => {
                write_level(queue, &texture, level, &half_bytes(&filtered, level));
                if level + 1 == filtered.level_count() {
                    let maps = EnvironmentMaps::new(&filtered, &texture, true);
                    match &mut self.dropped {
                        Some(dropped) => dropped.maps = maps,
                        None => self.studios[self.room as usize] = Some(maps),
                    }
                    return true;
                }
                Refining::Uploading(filtered, texture, level + 1)
            }
        };
        self.refining = Some((wanted, refining));
        false
    }
}

impl EnvironmentMaps {
    fn new(filtered: &Prefiltered, texture: &wgpu::Texture, are_fine: bool) -> Self {
        Self {
            specular: cube_view(texture),
            level_count: filtered.level_count(),
            sh: filtered.irradiance().to_uniform(),
            are_fine,
        }
    }

    /// Of few texels.
    fn upload(device: &wgpu::Device, queue: &Queue, filtered: &Prefiltered) -> Self {
        let texture = cube_texture(device, "environment", filtered);
        for level in 0..filtered.level_count() {
            write_level(queue, &texture, level, &half_bytes(filtered, level));
        }
        Self::new(filtered, &texture, false)
    }
}

/// A level's texels as bytes, RGBA half floats.
fn half_bytes(filtered: &Prefiltered, level: u32) -> Vec<u8> {
    bytemuck::cast_slice(&filtered.level_rgba16f(level).unwrap_or_default()).to_vec()
}

fn cube_texture(device: &wgpu::Device, label: &str, filtered: &Prefiltered) -> wgpu::Texture {
    let format = wgpu::TextureFormat::Rgba16Float;
    empty_cube(device, label, filtered.side(), filtered.level_count(), format)
}

fn empty_cube(
    device: &wgpu::Device,
    label: &str,
    side: u32,
    level_count: u32,
    format: wgpu::TextureFormat,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width: side,
            height: side,
            depth_or_array_layers: 6,
        },
        mip_level_count: level_count,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: UPLOADED_AND_READ,
        view_formats: &[],
    })
}

fn cube_view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::Cube),
        ..Default::default()
    })
}

/// Uploads a level of a cube: faces one after another.
fn write_level(queue: &Queue, cube: &wgpu::Texture, mip_level: u32, texels: &[u8]) {
    let side = (cube.width() >> mip_level).max(1);
    let texel_bytes = cube.format().block_copy_size(None).unwrap_or_default();
    queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            mip_level,
            ..cube.as_image_copy()
        },
        texels,
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(side * texel_bytes),
            rows_per_image: Some(side),
        },
        wgpu::Extent3d {
            width: side,
            height: side,
            depth_or_array_layers: 6,
        },
    );
}

/// Six faces with levels, ready to upload.
struct Cube {
    side: u32,
    format: wgpu::TextureFormat,
    /// From the largest, each half the side of the one before; faces one after another.
    levels: Vec<Vec<u8>>,
}

impl Cube {
    /// The image's largest level that fits and all smaller ones, decoded. When all are too large, the smallest is averaged down.
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
        let is_float = image.format().is_float();
        let texels = |face, level| match is_float {
            true => image.to_rgba32f(face, level).map(|texels| half_floats(&texels)),
            false => image.to_rgba8(face, level),
        };
        let faces = |level| (0..6).map(|face| texels(face, level)).collect::<Option<Vec<_>>>();
        let levels = (level..image.level_count()).map(|level| Some(faces(level)?.concat()));
        Some(Self {
            side,
            format: match is_float {
                true => wgpu::TextureFormat::Rgba16Float,
                false => wgpu::TextureFormat::Rgba8UnormSrgb,
            },
            levels: levels.collect::<Option<_>>()?,
        })
    }

    fn upload(&self, device: &wgpu::Device, queue: &Queue, label: &str) -> wgpu::TextureView {
        let texture = empty_cube(device, label, self.side, self.levels.len() as u32, self.format);
        for (level, texels) in (0..).zip(&self.levels) {
            write_level(queue, &texture, level, texels);
        }
        cube_view(&texture)
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
    let entries = TABLE.to_rgba16f();
    let (size, format) = ([TABLE.side() as u32; 2], wgpu::TextureFormat::Rgba16Float);
    texture_of(
        device,
        queue,
        "BRDF table",
        size,
        format,
        bytemuck::cast_slice(&entries),
    )
}
