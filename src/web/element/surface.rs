//! The canvas as a surface of the GPU.

use web_sys::HtmlCanvasElement;

use crate::render::Compositor;
use crate::web::backend::{Chosen, OpenGpu, request_adapter};

pub(super) struct CanvasSurface {
    canvas: HtmlCanvasElement,
    surface: wgpu::Surface<'static>,
    configuration: wgpu::SurfaceConfiguration,
    pub(super) gpu: OpenGpu,
}

impl CanvasSurface {
    /// Claims the canvas, for ever for one backend.
    pub(super) async fn claim(canvas: HtmlCanvasElement, chosen: Chosen) -> Result<Self, String> {
        let create = |instance: &wgpu::Instance| {
            let surface = instance.create_surface(wgpu::SurfaceTarget::Canvas(canvas.clone()));
            surface.map_err(|error| error.to_string())
        };
        let (surface, gpu) = match chosen {
            Chosen::WebGpu(gpu) => (create(&gpu.instance)?, *gpu),
            Chosen::WebGl2 => {
                let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
                descriptor.backends = wgpu::Backends::GL;
                let instance = wgpu::Instance::new(descriptor);
                let surface = create(&instance)?;
                let adapter = request_adapter(&instance, Some(&surface)).await?;
                (surface, OpenGpu::open(instance, adapter).await?)
            }
        };
        let unsupported = "the canvas has no format that this adapter draws";
        let format = {
            let formats = surface.get_capabilities(&gpu.adapter).formats;
            // The compositor encodes by itself.
            let is_plain = |format: &wgpu::TextureFormat| {
                matches!(
                    format,
                    wgpu::TextureFormat::Rgba8Unorm | wgpu::TextureFormat::Bgra8Unorm
                )
            };
            formats.into_iter().find(is_plain).ok_or(unsupported)?
        };
        let default = surface.get_default_config(&gpu.adapter, 0, 0).ok_or(unsupported)?;
        Ok(Self {
            canvas,
            surface,
            configuration: wgpu::SurfaceConfiguration { format, ..default },
            gpu,
        })
    }

    pub(super) fn format(&self) -> wgpu::TextureFormat {
        self.configuration.format
    }

    /// Takes up the size of the canvas, in pixels, as far as the device goes. Returns whether it is another one.
    pub(super) fn follow_canvas(&mut self) -> bool {
        let most = self.gpu.device.limits().max_texture_dimension_2d;
        let size = [self.canvas.width(), self.canvas.height()].map(|side| side.clamp(1, most));
        let is_other = size != self.size();
        if is_other {
            [self.configuration.width, self.configuration.height] = size;
            self.surface.configure(&self.gpu.device, &self.configuration);
        }
        is_other
    }

    /// Width and height, pixels.
    pub(super) fn size(&self) -> [u32; 2] {
        [self.configuration.width, self.configuration.height]
    }

    /// Shows what the compositor has. Returns whether the browser had room for it; it has in the next frame.
    pub(super) fn present(&self, compositor: &Compositor) -> bool {
        use wgpu::CurrentSurfaceTexture::{Suboptimal, Success};
        let (Success(shown) | Suboptimal(shown)) = self.surface.get_current_texture() else {
            self.surface.configure(&self.gpu.device, &self.configuration);
            return false;
        };
        let view = shown.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = self
            .gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("present") });
        compositor.paint(&mut encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("present"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: wgpu::StoreOp::Store,
                },
                depth_slice: None,
            })],
            ..Default::default()
        }));
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.queue.present(shown);
        true
    }
}
