//! The queue that uploads; buffers of uniforms and of a model, within what a device can hold, and the groups that bind them.

use std::cell::Cell;

/// A device's queue. It counts the bytes that are uploaded through it.
pub struct Queue {
    pub(super) inner: wgpu::Queue,
    bytes: Cell<u64>,
}

impl Queue {
    pub fn new(queue: &wgpu::Queue) -> Self {
        Self {
            inner: queue.clone(),
            bytes: Cell::new(0),
        }
    }

    /// As [`wgpu::Queue::write_buffer`].
    pub(super) fn write_buffer(&self, buffer: &wgpu::Buffer, offset: u64, bytes: &[u8]) {
        self.count(bytes);
        self.inner.write_buffer(buffer, offset, bytes);
    }

    /// As [`wgpu::Queue::write_texture`].
    pub(super) fn write_texture(
        &self,
        texture: wgpu::TexelCopyTextureInfo<'_>,
        bytes: &[u8],
        layout: wgpu::TexelCopyBufferLayout,
        size: wgpu::Extent3d,
    ) {
        self.count(bytes);
        self.inner.write_texture(texture, bytes, layout, size);
    }

    /// The bytes that were uploaded since this was last asked.
    pub(super) fn take_bytes(&self) -> u64 {
        self.bytes.take()
    }

    fn count(&self, bytes: &[u8]) {
        self.bytes.set(self.bytes.get() + bytes.len() as u64);
    }
}

/// A bind group whose resources have the bindings 0, 1, 2…
pub(super) fn bind_group<'a>(
    device: &wgpu::Device,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    resources: impl IntoIterator<Item = wgpu::BindingResource<'a>>,
) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(label),
        layout,
        entries: &entries,
    })
}

/// A buffer for one uniform `T`, to be written before it is read.
pub(super) fn uniform_buffer<T>(device: &wgpu::Device, label: &str) -> wgpu::Buffer {
    buffer(device, label, size_of::<T>() as u64, wgpu::BufferUsages::UNIFORM)
}

/// A buffer of so many bytes, that may also be written to.
pub(super) fn buffer(device: &wgpu::Device, label: &str, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Elements converted at a time, so that an upload needs no second copy of the mesh.
const CHUNK: usize = 16 * 1024;

/// Why a model cannot be drawn on this device.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum UploadError {
    /// One of its buffers is larger than the device's largest buffer.
    #[error("the model's {stream} need {bytes} bytes; this device holds {limit} in one buffer")]
    TooLarge {
        stream: &'static str,
        bytes: u64,
        limit: u64,
    },
    /// More joints than the bone texture can have.
    #[error("the model has {joints} bones; this device can blend with {limit}")]
    TooManyJoints { joints: usize, limit: usize },
}

/// Uploads the data of one model.
pub(super) struct Uploader<'a> {
    pub(super) device: &'a wgpu::Device,
    pub(super) queue: &'a Queue,
    pub(super) limits: wgpu::Limits,
}

impl Uploader<'_> {
    /// A buffer of `count` elements. Without elements it has a few bytes all the same, since no slice of it may be empty.
    pub(super) fn upload<T: bytemuck::NoUninit>(
        &self,
        stream: &'static str,
        usage: wgpu::BufferUsages,
        count: usize,
        elements: impl Iterator<Item = T>,
    ) -> Result<wgpu::Buffer, UploadError> {
        let bytes = (count as u64 * size_of::<T>() as u64)
            .next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT)
            .max(16);
        if bytes > self.limits.max_buffer_size {
            return Err(UploadError::TooLarge {
                stream,
                bytes,
                limit: self.limits.max_buffer_size,
            });
        }
        let buffer = buffer(self.device, stream, bytes, usage);
        let mut elements = elements;
        let mut offset = 0;
        loop {
            let chunk: Vec<T> = elements.by_ref().take(CHUNK).collect();
            if chunk.is_empty() {
                return Ok(buffer);
            }
            let bytes = bytemuck::cast_slice(&chunk);
            self.queue.write_buffer(&buffer, offset, bytes);
            offset += bytes.len() as u64;
        }
    }
}

pub(super) fn flat(sample_type: wgpu::TextureSampleType) -> wgpu::BindingType {
    texture(sample_type, wgpu::TextureViewDimension::D2)
}

pub(super) fn texture(
    sample_type: wgpu::TextureSampleType,
    view_dimension: wgpu::TextureViewDimension,
) -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type,
        view_dimension,
        multisampled: false,
    }
}

/// A layout whose entries have the bindings 0, 1, 2…
pub(super) fn layout(
    device: &wgpu::Device,
    label: &str,
    entries: &[(wgpu::ShaderStages, wgpu::BindingType)],
) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = (0..)
        .zip(entries)
        .map(|(binding, &(visibility, ty))| wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty,
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(label),
        entries: &entries,
    })
}
