//! Which GPU, and what is asked of it: never more than WebGL2 gives, so that no platform is special.

use super::target::{COLOR_FORMAT, DEPTH_FORMAT, SampleCount};

/// A way to a GPU without a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Backend {
    /// Vulkan.
    Vulkan,
    /// OpenGL ES through EGL: the nearest to WebGL2.
    Gl,
}

impl std::fmt::Display for Backend {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Vulkan => "Vulkan",
            Self::Gl => "GL",
        })
    }
}

/// An open GPU.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// Name, driver, backend.
    pub info: wgpu::AdapterInfo,
    /// Makes things.
    pub device: wgpu::Device,
    /// Takes work.
    pub queue: wgpu::Queue,
    /// What targets and renderer should use.
    pub samples: SampleCount,
}

/// Why there is no GPU.
#[derive(Clone, Debug, thiserror::Error)]
pub enum DeviceError {
    /// None found.
    #[error("no {backend} adapter was found ({reason}); on Debian, `apt-get install {packages}` brings a software one", packages = packages(*backend))]
    NoAdapter {
        /// Looked for through this.
        backend: Backend,
        /// In wgpu's words.
        reason: String,
    },
    /// It would not open.
    #[error("the {backend} adapter \"{adapter}\" would not open: {reason}")]
    NoDevice {
        /// Found through this.
        backend: Backend,
        /// Its name.
        adapter: String,
        /// In wgpu's words.
        reason: String,
    },
}

/// Debian packages with a software adapter.
fn packages(backend: Backend) -> &'static str {
    match backend {
        Backend::Vulkan => "mesa-vulkan-drivers",
        Backend::Gl => "libgl1-mesa-dri libegl1",
    }
}

/// The limits to ask of any adapter: WebGL2's, but for the size of textures.
pub fn required_limits(adapter: &wgpu::Adapter) -> wgpu::Limits {
    wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits())
}

/// The features to ask of any adapter: block-compressed textures where it has them.
pub fn required_features(adapter: &wgpu::Adapter) -> wgpu::Features {
    adapter.features() & wgpu::Features::TEXTURE_COMPRESSION_BC
}

/// What to ask of any adapter.
pub fn descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    wgpu::DeviceDescriptor {
        label: Some("bindpose"),
        required_features: required_features(adapter),
        required_limits: required_limits(adapter),
        ..Default::default()
    }
}

/// How many samples a pixel an adapter can draw and resolve.
pub fn sample_count(adapter: &wgpu::Adapter) -> SampleCount {
    let four = SampleCount::Four.count();
    let flags = |format| adapter.get_texture_format_features(format).flags;
    let resolves = flags(COLOR_FORMAT).contains(wgpu::TextureFormatFeatureFlags::MULTISAMPLE_RESOLVE);
    let both = [COLOR_FORMAT, DEPTH_FORMAT]
        .into_iter()
        .all(|format| flags(format).sample_count_supported(four));
    if both && resolves {
        SampleCount::Four
    } else {
        SampleCount::One
    }
}

/// Opens a GPU without a window, for pictures from the command line and from tests.
pub async fn headless(backend: Backend) -> Result<Gpu, DeviceError> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: match backend {
            Backend::Vulkan => wgpu::Backends::VULKAN,
            Backend::Gl => wgpu::Backends::GL,
        },
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let adapter = instance
        .request_adapter(&wgpu::RequestAdapterOptions::default())
        .await
        .map_err(|error| DeviceError::NoAdapter {
            backend,
            reason: error.to_string(),
        })?;
    let info = adapter.get_info();
    let (device, queue) =
        adapter
            .request_device(&descriptor(&adapter))
            .await
            .map_err(|error| DeviceError::NoDevice {
                backend,
                adapter: info.name.clone(),
                reason: error.to_string(),
            })?;
    Ok(Gpu {
        samples: sample_count(&adapter),
        info,
        device,
        queue,
    })
}
