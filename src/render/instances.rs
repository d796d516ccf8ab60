//! Where the instances of the model stand and how they are posed: a vertex stream with an entry for each, and their joint matrices
//! in a texture.

use std::hash::{DefaultHasher, Hasher as _};
use std::ops::Range;
use std::slice::ChunksExact;

use glam::Affine3A;

use super::buffers::{Queue, bind_group, buffer, flat, layout};
use super::target::{UPLOADED_AND_READ, flat_texture};
use super::uniforms::{encoded, theme_colors};
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
    joint_count: usize,
    palette_count: usize,
    /// Texels as they were uploaded last, whole rows.
    texels: Vec<[f32; 4]>,
    /// Those of the upload before, as a buffer for the next.
    texels_before: Vec<[f32; 4]>,
}

impl BoneTexture {
    pub fn layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
        let matrices = wgpu::TextureSampleType::Float { filterable: false };
        layout(device, "bones", &[(wgpu::ShaderStages::VERTEX, flat(matrices))])
    }

    /// The greatest number of joints, of all palettes together, that fits a device.
    pub fn max_joints(limits: &wgpu::Limits) -> usize {
        limits.max_texture_dimension_2d as usize * JOINTS_PER_ROW as usize
    }

    /// For palettes of `joint_count` joints, at most [`BoneTexture::max_joints`]. To be written before it is read.
    pub fn new(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, joint_count: usize) -> Self {
        let rows = (joint_count as u32).div_ceil(JOINTS_PER_ROW).max(1);
        let (texture, group) = texture(device, layout, [TEXELS_PER_ROW, rows]);
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

    /// Uploads palettes, as many as fit the device: the rows of the texture that differ from what is there. Matrices that a palette
    /// lacks are identities; those beyond the joint count are left out.
    pub fn write<'a>(&mut self, queue: &Queue, palettes: impl IntoIterator<Item = &'a [Affine3A]>) {
        let limits = self.device.limits();
        let most = Self::max_joints(&limits) / self.joint_count.max(1);
        std::mem::swap(&mut self.texels, &mut self.texels_before);
        self.texels.clear();
        self.palette_count = 0;
        for palette in palettes.into_iter().take(most) {
            let matrices = palette.iter().chain(std::iter::repeat(&Affine3A::IDENTITY));
            self.texels.extend(matrices.take(self.joint_count).flat_map(rows));
            self.palette_count += 1;
        }
        let height = (self.texels.len() as u32).div_ceil(TEXELS_PER_ROW);
        self.texels.resize((height * TEXELS_PER_ROW) as usize, [0.0; 4]);
        if height > self.texture.height() {
            // More than is needed, since the number of poses changes from frame to frame.
            let height = height.next_power_of_two().min(limits.max_texture_dimension_2d);
            (self.texture, self.group) = texture(&self.device, &self.layout, [TEXELS_PER_ROW, height]);
            self.texels_before.clear();
        }
        let differs = |&row: &u32| row_of(&self.texels, row) != row_of(&self.texels_before, row);
        let mut row = 0;
        while let Some(start) = (row..height).find(differs) {
            row = (start..height).find(|row| !differs(row)).unwrap_or(height);
            self.upload(queue, start..row);
        }
    }

    /// Whether the last [`BoneTexture::write`] changed any of the first palettes, this many.
    pub(super) fn first_changed(&self, palettes: usize) -> bool {
        let count = palettes.min(self.palette_count) * self.joint_count * TEXELS_PER_JOINT as usize;
        let [after, before] =
            [&self.texels, &self.texels_before].map(|texels| texels.get(..count).map(bytemuck::cast_slice::<_, u8>));
        after != before
    }

    fn upload(&self, queue: &Queue, rows: Range<u32>) {
        let texels = &self.texels[(rows.start * TEXELS_PER_ROW) as usize..(rows.end * TEXELS_PER_ROW) as usize];
        write_rows(queue, &self.texture, rows.start, texels);
    }
}

/// Uploads whole rows.
fn write_rows(queue: &Queue, texture: &wgpu::Texture, first: u32, texels: &[[f32; 4]]) {
    let mut place = texture.as_image_copy();
    place.origin.y = first;
    queue.write_texture(
        place,
        bytemuck::cast_slice(texels),
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(texture.width() * BYTES_PER_TEXEL),
            rows_per_image: None,
        },
        wgpu::Extent3d {
            height: texels.len() as u32 / texture.width(),
            ..texture.size()
        },
    );
}

/// The bytes of a row of the bone texture, which are compared sooner than its numbers; none beyond the last.
fn row_of(texels: &[[f32; 4]], row: u32) -> Option<&[u8]> {
    let row = texels.get((row * TEXELS_PER_ROW) as usize..((row + 1) * TEXELS_PER_ROW) as usize);
    row.map(bytemuck::cast_slice)
}

fn texture(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, size: [u32; 2]) -> (wgpu::Texture, wgpu::BindGroup) {
    let view = flat_texture(
        device,
        "bones",
        size,
        wgpu::TextureFormat::Rgba32Float,
        UPLOADED_AND_READ,
    );
    let group = bind_group(device, "bones", layout, [wgpu::BindingResource::TextureView(&view)]);
    (view.texture().clone(), group)
}

/// A texture of rows of items with three texels each, [`JOINTS_PER_ROW`] items a row or, of many, as many as make it a square. None where a
/// texture may not have such a side.
pub(super) fn texels_in_rows(
    device: &wgpu::Device,
    queue: &Queue,
    layout: &wgpu::BindGroupLayout,
    elements: impl ExactSizeIterator<Item = [[f32; 4]; 3]>,
) -> Option<wgpu::BindGroup> {
    let count = elements.len() as u32;
    let per_row = JOINTS_PER_ROW.max(count.div_ceil(TEXELS_PER_JOINT).isqrt() + 1);
    let size = [per_row * TEXELS_PER_JOINT, count.div_ceil(per_row).max(1)];
    if size.into_iter().max() > Some(device.limits().max_texture_dimension_2d) {
        return None;
    }
    let (texture, group) = texture(device, layout, size);
    let (mut row, mut elements) = (0, elements.peekable());
    while elements.peek().is_some() {
        let mut texels: Vec<_> = elements.by_ref().take(per_row as usize).flatten().collect();
        texels.resize(size[0] as usize, [0.0; 4]);
        write_rows(queue, &texture, row, &texels);
        row += 1;
    }
    Some(group)
}

/// Opacity of the highlight at a surface's edge.
const HIGHLIGHT_OPACITY: f32 = 0.55;

/// The poses that a frame's instances have: its own palette, then the crowd's.
pub(super) fn poses<'a>(frame: &RenderFrame<'a>) -> impl Iterator<Item = &'a [Affine3A]> {
    std::iter::once(&frame.palette.0[..]).chain(crowd_palettes(frame))
}

/// How many [`poses`] there are.
pub(super) fn pose_count(frame: &RenderFrame<'_>) -> usize {
    1 + crowd_palettes(frame).len()
}

fn crowd_palettes<'a>(frame: &RenderFrame<'a>) -> ChunksExact<'a, Affine3A> {
    let joints = frame.palette.0.len();
    // In bind space no palette is read.
    let palettes = if joints == 0 { &[] } else { frame.crowd.palettes };
    palettes.chunks_exact(joints.max(1))
}

/// The instances of a frame, as a vertex stream: the frame's own instance four times, the crowd, those in sight before the others, so that
/// one draw has all of them; the own instance again in the colour of the highlight; the ghosts. A line reads all of the first, one for
/// each corner of its strip, since there the mesh's vertices or edges are the instances.
pub(super) struct Instances {
    buffer: wgpu::Buffer,
    /// As they were uploaded last.
    stream: Vec<Instance>,
    /// Those of the upload before, as a buffer for the next.
    stream_before: Vec<Instance>,
    roster: Roster,
}

/// The last of the frame's own instances, which is drawn with the crowd.
const OWN: u32 = 3;

/// Which instances a frame has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Roster {
    /// How many the camera may see, with the frame's own.
    in_sight: u32,
    /// How many there are, with the frame's own.
    count: u32,
    /// Sums of what is hashed of each, so that their order is the same to them: the camera changes it.
    hash_in_sight: u64,
    hash: u64,
}

impl Roster {
    /// Whether both have the same instances in any order, in sight or not.
    pub(super) fn has_all_of(&self, other: &Self) -> bool {
        (self.count, self.hash) == (other.count, other.hash)
    }
}

#[derive(Clone, Copy)]
pub(super) struct InstanceRange<'a> {
    buffer: &'a wgpu::Buffer,
    first: u32,
    pub(super) count: u32,
}

impl Instances {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        Self {
            buffer: buffer_for(device, OWN as usize + 1),
            stream: Vec::new(),
            stream_before: Vec::new(),
            roster: Roster::default(),
        }
    }

    /// Uploads the frame's instances, unless they are there already. `bones` has the frame's [`poses`], then the ghosts'. An instance
    /// whose palette is not there is posed by the last that is. `front_sign` is of them all: +1 where
    /// clockwise triangles show their front in the world, else −1.
    pub(super) fn write(
        &mut self,
        device: &wgpu::Device,
        queue: &Queue,
        frame: &RenderFrame<'_>,
        bones: Option<&BoneTexture>,
        front_sign: f32,
    ) {
        let (palettes, joints) = bones.map_or((0, 0), |bones| (bones.palette_count, bones.joint_count));
        let poses = pose_count(frame).min(palettes);
        let first_joint = |palette: usize| (palette * joints) as u32;
        let instance = |world_from_model: &Affine3A, palette: usize| Instance {
            rows: rows(world_from_model),
            tint_srgb: [1.0; 4],
            first_joint: first_joint(palette.min(poses.saturating_sub(1))),
            front_sign,
        };
        let own = instance(&frame.world_from_model, 0);
        let crowd = frame.crowd.instances.iter();
        let crowd = crowd.map(|one| instance(&one.world_from_model, one.palette as usize + 1));
        let accent = theme_colors(frame.options.theme).accent;
        let highlight = Instance {
            tint_srgb: encoded(accent, HIGHLIGHT_OPACITY),
            ..own
        };
        let ghost = |(palette, color_srgb): (usize, &[u8; 4])| Instance {
            tint_srgb: color_srgb.map(|channel| f32::from(channel) / 255.0),
            first_joint: first_joint(palette),
            ..own
        };
        let ghosts = (poses..palettes).zip(frame.ghosts.colors_srgb).map(ghost);
        let all = [own; OWN as usize + 1].into_iter().chain(crowd);
        let all = all.chain([highlight]).chain(ghosts);
        std::mem::swap(&mut self.stream, &mut self.stream_before);
        self.stream.clear();
        self.stream.extend(all);

        let (in_sight, count) = (frame.crowd.in_sight, frame.crowd.instances.len());
        let (in_sight, count) = (in_sight.min(count) as u32 + 1, count as u32 + 1);
        let differs = self.stream != self.stream_before;
        if differs || (self.roster.in_sight, self.roster.count) != (in_sight, count) {
            let (seen, others) = self.stream[OWN as usize..(OWN + count) as usize].split_at(in_sight as usize);
            let hash_in_sight = hash_of(seen);
            self.roster = Roster {
                in_sight,
                count,
                hash_in_sight,
                hash: hash_in_sight.wrapping_add(hash_of(others)),
            };
        }
        if differs {
            if self.stream.len() > self.buffer.size() as usize / size_of::<Instance>() {
                self.buffer = buffer_for(device, self.stream.len().next_power_of_two());
            }
            queue.write_buffer(&self.buffer, 0, bytemuck::cast_slice(&self.stream));
        }
    }

    pub(super) fn roster(&self) -> Roster {
        self.roster
    }

    pub(super) fn own(&self) -> InstanceRange<'_> {
        self.range(0..1)
    }

    /// The crowd, as far as it is in sight.
    pub(super) fn crowd_in_sight(&self) -> InstanceRange<'_> {
        self.range(OWN + 1..OWN + self.roster.in_sight)
    }

    /// The frame's own instance and the crowd, as far as it is in sight.
    pub(super) fn in_sight(&self) -> InstanceRange<'_> {
        self.range(OWN..OWN + self.roster.in_sight)
    }

    /// The frame's own instance and the whole crowd.
    pub(super) fn all(&self) -> InstanceRange<'_> {
        self.range(OWN..OWN + self.roster.count)
    }

    /// The frame's own instance in the colour of the highlight.
    pub(super) fn highlight(&self) -> InstanceRange<'_> {
        self.range(OWN + self.roster.count..OWN + self.roster.count + 1)
    }

    /// The frame's own instance in other poses, each by itself.
    pub(super) fn ghosts(&self) -> impl Iterator<Item = InstanceRange<'_>> {
        (OWN + self.roster.count + 1..self.stream.len() as u32).map(|ghost| self.range(ghost..ghost + 1))
    }

    fn range(&self, range: Range<u32>) -> InstanceRange<'_> {
        InstanceRange {
            buffer: &self.buffer,
            first: range.start,
            count: range.len() as u32,
        }
    }
}

/// The same for the same instances in any order.
fn hash_of(instances: &[Instance]) -> u64 {
    let hash = |instance: &Instance| {
        let mut hasher = DefaultHasher::new();
        hasher.write(bytemuck::bytes_of(instance));
        hasher.finish()
    };
    instances.iter().map(hash).fold(0, u64::wrapping_add)
}

impl<'a> InstanceRange<'a> {
    /// The stream from the range's instance with this index on. WebGL2 has no first instance, so the buffer starts there.
    pub(super) fn from(self, index: u32) -> wgpu::BufferSlice<'a> {
        self.buffer
            .slice(u64::from(self.first + index) * size_of::<Instance>() as u64..)
    }
}

fn buffer_for(device: &wgpu::Device, count: usize) -> wgpu::Buffer {
    let bytes = (count * size_of::<Instance>()) as u64;
    buffer(device, "instances", bytes, wgpu::BufferUsages::VERTEX)
}

/// The rows of a matrix as texels or vertex attributes.
pub fn rows(affine: &Affine3A) -> [[f32; 4]; 3] {
    let [x, y, z] = affine.matrix3.transpose().to_cols_array_2d();
    let t = affine.translation.to_array();
    [
        [x[0], x[1], x[2], t[0]],
        [y[0], y[1], y[2], t[1]],
        [z[0], z[1], z[2], t[2]],
    ]
}
