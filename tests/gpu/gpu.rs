//! Opens each backend once and draws scenes with it.

use std::sync::OnceLock;

use bindpose::render::device::{self, Backend};
use bindpose::render::{MaterialImages, Renderer, Target, read_back_blocking};

use crate::scenes::Scene;

/// An open backend.
pub(crate) struct Gpu {
    pub(crate) backend: Backend,
    pub(crate) open: device::Gpu,
}

pub(crate) fn vulkan() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| open(Backend::Vulkan))
}

pub(crate) fn gl() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| open(Backend::Gl))
}

fn open(backend: Backend) -> Gpu {
    // The error names the package to install: a missing adapter must not pass for a green test.
    let open = pollster::block_on(device::headless(backend)).unwrap_or_else(|error| panic!("{error}"));
    Gpu { backend, open }
}

/// The same adapter opened without block-compressed textures.
pub(crate) fn without_blocks(backend: Backend) -> Gpu {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: match backend {
            Backend::Vulkan => wgpu::Backends::VULKAN,
            Backend::Gl => wgpu::Backends::GL,
        },
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()));
    let adapter = adapter.unwrap_or_else(|error| panic!("{error}"));
    let descriptor = wgpu::DeviceDescriptor {
        required_features: wgpu::Features::empty(),
        ..device::descriptor(&adapter)
    };
    let opened = pollster::block_on(adapter.request_device(&descriptor));
    let (device, queue) = opened.unwrap_or_else(|error| panic!("{error}"));
    let open = device::Gpu {
        info: adapter.get_info(),
        samples: device::sample_count(&adapter),
        draws_means: device::draws_means(&adapter),
        device,
        queue,
    };
    Gpu { backend, open }
}

impl Gpu {
    pub(crate) fn renderer(&self) -> Renderer {
        Renderer::with_samples(&self.open.device, &self.open.queue, self.open.samples)
    }

    pub(crate) fn target(&self, width: u32, height: u32) -> Target {
        Target::with_samples(&self.open.device, width, height, self.open.samples)
    }

    /// Draws a scene once.
    pub(crate) fn draw(&self, scene: &Scene, width: u32, height: u32) -> Picture {
        self.draw_with_maps(scene, &[], width, height)
    }

    /// Draws a scene once, its materials with these maps.
    pub(crate) fn draw_with_maps(
        &self,
        scene: &Scene,
        maps: &[MaterialImages<'_>],
        width: u32,
        height: u32,
    ) -> Picture {
        let mut renderer = self.renderer();
        renderer.set_model(&scene.model).expect("test models are small");
        renderer.set_maps(maps);
        let mut target = self.target(width, height);
        renderer.render(&scene.frame(), &mut target);
        self.read(&target)
    }

    /// Keeps a scene's model and maps on the GPU, to draw it many times.
    pub(crate) fn easel(&self, scene: &Scene, maps: &[MaterialImages<'_>], [width, height]: [u32; 2]) -> Easel<'_> {
        let mut renderer = self.renderer();
        renderer.set_model(&scene.model).expect("test models are small");
        renderer.set_maps(maps);
        Easel {
            gpu: self,
            renderer,
            target: self.target(width, height),
        }
    }

    pub(crate) fn read(&self, target: &Target) -> Picture {
        let [width, height] = target.size();
        let rgba = read_back_blocking(&self.open.device, &self.open.queue, target).expect("reads back");
        assert_eq!(rgba.len(), (width * height * 4) as usize);
        Picture { width, height, rgba }
    }
}

/// A renderer that has a model already.
pub(crate) struct Easel<'a> {
    gpu: &'a Gpu,
    pub(crate) renderer: Renderer,
    target: Target,
}

impl Easel<'_> {
    /// All of the scene is as it says, but for its model, which is the easel's.
    pub(crate) fn draw(&mut self, scene: &Scene) -> Picture {
        self.renderer.render(&scene.frame(), &mut self.target);
        self.gpu.read(&self.target)
    }
}

/// Pixels, sRGB, straight alpha.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Picture {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) rgba: Vec<u8>,
}

impl Picture {
    pub(crate) fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        assert!(x < self.width && y < self.height);
        let start = ((y * self.width + x) * 4) as usize;
        self.rgba[start..start + 4].try_into().expect("four channels")
    }

    pub(crate) fn at(&self, [x, y]: [u32; 2]) -> [u8; 4] {
        self.pixel(x, y)
    }

    pub(crate) fn middle(&self) -> [u8; 4] {
        self.pixel(self.width / 2, self.height / 2)
    }

    /// Share of the pixels in which some channel differs by more than `tolerance`.
    pub(crate) fn share_that_differs(&self, other: &Self, tolerance: u8) -> f64 {
        assert_eq!((self.width, self.height), (other.width, other.height));
        let pixels = self.rgba.chunks_exact(4).zip(other.rgba.chunks_exact(4));
        let differs = |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > tolerance);
        pixels.filter(differs).count() as f64 / f64::from(self.width * self.height)
    }
}

/// Greatest difference of two pixels in any channel.
pub(crate) fn difference(a: [u8; 4], b: [u8; 4]) -> u8 {
    a.into_iter()
        .zip(b)
        .map(|(a, b)| a.abs_diff(b))
        .max()
        .expect("four channels")
}

/// Draws into a texture of its own, and gives its bytes.
pub(crate) fn drawn(
    gpu: &Gpu,
    format: wgpu::TextureFormat,
    [width, height]: [u32; 2],
    draw: impl FnOnce(wgpu::RenderPass<'_>),
) -> Vec<u8> {
    let device = &gpu.open.device;
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    draw(encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        })],
        ..Default::default()
    }));
    gpu.open.queue.submit([encoder.finish()]);
    read_texture(gpu, &texture, format.block_copy_size(None).expect("a colour"))
}

/// GL may not draw into floats; every device draws into integers, and bits are bits.
pub(crate) const PROBED: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;

/// A pipeline of the source's `vertex` and `fragment` that draws into [`PROBED`].
pub(crate) fn probe(
    gpu: &Gpu,
    source: String,
    groups: &[&wgpu::BindGroupLayout],
    buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
    topology: wgpu::PrimitiveTopology,
) -> wgpu::RenderPipeline {
    let device = &gpu.open.device;
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("probe"),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let groups: Vec<_> = groups.iter().map(|layout| Some(*layout)).collect();
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &groups,
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("probe"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers,
        },
        primitive: wgpu::PrimitiveState {
            topology,
            ..Default::default()
        },
        depth_stencil: None,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: Default::default(),
            targets: &[Some(PROBED.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// A group for what a probe has no use for.
pub(crate) fn nothing(gpu: &Gpu) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
    let device = &gpu.open.device;
    let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &[],
    });
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &layout,
        entries: &[],
    });
    (layout, group)
}

/// The bytes of any texture, rows without padding.
pub(crate) fn read_texture(gpu: &Gpu, texture: &wgpu::Texture, bytes_per_pixel: u32) -> Vec<u8> {
    let device = &gpu.open.device;
    let row = texture.width() * bytes_per_pixel;
    let padded_row = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(padded_row * texture.height()),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(padded_row),
                rows_per_image: None,
            },
        },
        texture.size(),
    );
    gpu.open.queue.submit([encoder.finish()]);
    let (answer, mapped) = std::sync::mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |result| {
        answer.send(result).expect("is waited for");
    });
    device.poll(wgpu::PollType::wait_indefinitely()).expect("waits");
    // Another test's wait may have taken this one's answer up, and hand it over a moment later.
    mapped.recv().expect("an answer").expect("maps");
    let mapped = buffer.get_mapped_range(..).expect("mapped");
    mapped
        .chunks_exact(padded_row as usize)
        .flat_map(|padded| &padded[..row as usize])
        .copied()
        .collect()
}
