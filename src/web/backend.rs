//! WebGPU when it is there and draws right, else WebGL2, in a program that has it (feature `webgl`). The decision falls before the canvas is claimed, since a canvas
//! that once had a WebGPU context can never have another.

use wasm_bindgen::JsValue;

use super::named_error;
use crate::render::device;

/// What the address or the page asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Preference {
    /// WebGPU on real hardware, else WebGL2.
    Auto,
    /// WebGPU, software adapters included, or an error.
    WebGpu,
    /// WebGL2.
    WebGl2,
}

impl Preference {
    /// Unknown names mean `auto`.
    pub(super) fn from_name(name: &str) -> Self {
        match name {
            "webgpu" => Self::WebGpu,
            "webgl2" => Self::WebGl2,
            _ => Self::Auto,
        }
    }
}

/// A way to draw.
pub(super) enum Chosen {
    /// A device that has drawn a known picture.
    WebGpu(Box<OpenGpu>),
    /// Its device is made together with the canvas's context.
    WebGl2,
}

/// An adapter that is open.
pub(super) struct OpenGpu {
    pub(super) instance: wgpu::Instance,
    pub(super) adapter: wgpu::Adapter,
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
}

impl OpenGpu {
    pub(super) async fn open(instance: wgpu::Instance, adapter: wgpu::Adapter) -> Result<Self, String> {
        let opened = adapter.request_device(&device::descriptor(&adapter)).await;
        let (device, queue) = opened.map_err(|error| error.to_string())?;
        Ok(Self {
            instance,
            adapter,
            device,
            queue,
        })
    }
}

/// The adapter to draw with, on a surface where one is given.
pub(super) async fn request_adapter(
    instance: &wgpu::Instance,
    surface: Option<&wgpu::Surface<'_>>,
) -> Result<wgpu::Adapter, String> {
    let options = wgpu::RequestAdapterOptions {
        power_preference: wgpu::PowerPreference::HighPerformance,
        compatible_surface: surface,
        ..Default::default()
    };
    let adapter = instance.request_adapter(&options).await;
    adapter.map_err(|error| error.to_string())
}

impl Chosen {
    /// The name in `state().backend`.
    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::WebGpu(_) => "webgpu",
            Self::WebGl2 => "webgl2",
        }
    }
}

/// Chooses a backend.
///
/// # Errors
/// When WebGPU was asked for by name and cannot be used, with the reason; and with the name `WebGl2Missing` when WebGL2 is left and this
/// program is the one without it. A browser without WebGL2 shows when the canvas is claimed.
pub(super) async fn choose(preference: Preference) -> Result<Chosen, JsValue> {
    if preference == Preference::WebGl2 {
        return web_gl2("it was asked for");
    }
    match web_gpu(preference == Preference::WebGpu).await {
        Ok(gpu) => Ok(Chosen::WebGpu(Box::new(gpu))),
        Err(reason) if preference == Preference::WebGpu => Err(named_error("Error", &format!("WebGPU: {reason}"))),
        Err(reason) => web_gl2(&format!("WebGPU is not to be had: {reason}")),
    }
}

fn web_gl2(reason: &str) -> Result<Chosen, JsValue> {
    if !cfg!(feature = "webgl") {
        let message = format!("WebGL2, which this program lacks, is needed, since {reason}");
        return Err(named_error("WebGl2Missing", &message));
    }
    web_sys::console::info_1(&format!("WebGL2 is used, since {reason}").into());
    Ok(Chosen::WebGl2)
}

async fn web_gpu(software_allowed: bool) -> Result<OpenGpu, String> {
    if !web_sys::window().is_some_and(|window| window.is_secure_context()) {
        return Err("this page is not in a secure context (https or localhost)".to_owned());
    }
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::BROWSER_WEBGPU;
    let instance = wgpu::util::new_instance_with_webgpu_detection(descriptor).await;
    let adapter = request_adapter(&instance, None).await?;
    if device::is_software(&adapter.get_info()) && !software_allowed {
        return Err(format!("its adapter is software ({})", adapter_name(&adapter)));
    }
    let gpu = OpenGpu::open(instance, adapter).await?;
    let pause = async || super::sleep(1).await;
    let probed = device::probe(&gpu.device, &gpu.queue, &device::probe_bones(), pause).await;
    probed.map_err(|error| error.to_string())?;
    Ok(gpu)
}

/// A name for people. Browsers often do not tell it.
pub(super) fn adapter_name(adapter: &wgpu::Adapter) -> String {
    let info = adapter.get_info();
    if info.name.is_empty() {
        "unnamed adapter".to_owned()
    } else {
        info.name
    }
}
