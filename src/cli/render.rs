//! `bindpose render`: the page's picture, without a page.

use std::io::Write;
use std::path::PathBuf;

use clap::ValueEnum;

use super::look::LookArguments;
use super::text::Plain;
use super::{Failure, clip, input};
use crate::image::encode_png;
use crate::render::device::{self, Gpu};
use crate::render::{MaterialImages, Renderer, watched};
use crate::scene::{self, Insets, ViewPreset};
use crate::session::{Command, Session};

/// Draw a model into a PNG file.
///
/// The same picture that the page shows, drawn without a window. A software GPU is enough.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Model to read.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Picture to write.
    #[arg(short, long, value_name = "PNG")]
    output: PathBuf,
    /// Clip by its name [default: the first].
    #[arg(long, value_name = "NAME")]
    clip: Option<String>,
    /// Seconds in the clip's own time, kept inside the clip [default: where the clip starts].
    #[arg(long, value_name = "SECS", value_parser = clip::seconds, allow_negative_numbers = true)]
    time: Option<f32>,
    /// Width and height in pixels.
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "1280x720")]
    size: [u32; 2],
    /// Where to look from; the model is framed.
    #[arg(long, value_enum, default_value = "three-quarter")]
    view: View,
    /// Way to the GPU [default: vulkan, or gl where that is missing].
    #[arg(long, value_enum)]
    backend: Option<Backend>,
    /// Surroundings.
    #[arg(long, value_enum, default_value = "dark")]
    theme: Theme,
    /// A folder with the model's textures, folders in it included; may be given several times.
    #[arg(long, value_name = "DIR")]
    textures: Vec<PathBuf>,
    #[command(flatten)]
    look: LookArguments,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum View {
    ThreeQuarter,
    Front,
    Back,
    Left,
    Right,
    Top,
    Bottom,
    Isometric,
}

impl From<View> for ViewPreset {
    fn from(view: View) -> Self {
        match view {
            View::ThreeQuarter => Self::ThreeQuarter,
            View::Front => Self::Front,
            View::Back => Self::Back,
            View::Left => Self::Left,
            View::Right => Self::Right,
            View::Top => Self::Top,
            View::Bottom => Self::Bottom,
            View::Isometric => Self::Isometric,
        }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Backend {
    Vulkan,
    Gl,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Theme {
    Dark,
    Light,
}

impl From<Theme> for scene::Theme {
    fn from(theme: Theme) -> Self {
        match theme {
            Theme::Dark => Self::Dark,
            Theme::Light => Self::Light,
        }
    }
}

/// `1280x720`.
fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once(['x', 'X', '×']);
    let sides = sides.and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
    match sides {
        Some([width, height]) if width > 0 && height > 0 => Ok([width, height]),
        _ => Err("a size is a width and a height in pixels, such as 1280x720".into()),
    }
}

pub(super) fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let mut session = open(arguments)?;
    let (gpu, backend) = open_gpu(arguments.backend)?;
    let png = draw(arguments, &mut session, &gpu)?;
    std::fs::write(&arguments.output, png).map_err(|reason| Failure::Unwritable {
        path: arguments.output.clone(),
        reason,
    })?;

    let [width, height] = arguments.size;
    let posed = session.clip().map_or_else(String::new, |clip| {
        format!(", {} at {} s", clip.name, session.playback().time_secs())
    });
    let output = arguments.output.display();
    let line = format!(
        "{output}: {width}x{height}{posed}, drawn by {} ({backend})",
        gpu.info.name
    );
    writeln!(out, "{}", Plain(&line))?;
    Ok(())
}

/// A session that shows what was asked for, as the page's would.
fn open(arguments: &Arguments) -> Result<Session, Failure> {
    let path = &arguments.file;
    // At rest: time stands where it is put.
    let mut session = Session::new(true);
    let mut files = vec![input::read(path)?];
    for folder in &arguments.textures {
        input::read_pictures(folder, &mut files)?;
    }
    session.apply(Command::AddFiles(files));
    if let Some(error) = session.error() {
        return Err(Failure::Refused {
            path: path.clone(),
            error: Box::new(error.clone()),
        });
    }
    if let (Some(open), Some(asked)) = (session.open_model(), &arguments.clip)
        && let Some(clip) = clip::choose(&open.model, path, Some(asked))?
    {
        session.apply(Command::SelectClip(clip));
    }
    if let Some(time_secs) = arguments.time {
        session.apply(Command::Seek { time_secs });
    }
    let [width, height] = arguments.size;
    session.apply(Command::SetViewport {
        aspect: width as f32 / height as f32,
        insets: Insets::default(),
    });
    session.apply(Command::SetTheme(arguments.theme.into()));
    arguments.look.apply(&mut session);
    session.apply(Command::LookFrom(arguments.view.into()));
    Ok(session)
}

fn open_gpu(backend: Option<Backend>) -> Result<(Gpu, device::Backend), Failure> {
    let open = |backend| pollster::block_on(device::headless(backend)).map(|gpu| (gpu, backend));
    match backend {
        Some(Backend::Vulkan) => Ok(open(device::Backend::Vulkan)?),
        Some(Backend::Gl) => Ok(open(device::Backend::Gl)?),
        None => open(device::Backend::Vulkan)
            .or_else(|vulkan| open(device::Backend::Gl).map_err(|gl| Failure::NoDeviceAtAll { vulkan, gl })),
    }
}

/// The picture as the bytes of a PNG file.
fn draw(arguments: &Arguments, session: &mut Session, gpu: &Gpu) -> Result<Vec<u8>, Failure> {
    let [width, height] = arguments.size;
    let Gpu {
        device, queue, samples, ..
    } = gpu;
    // Without that, an error of the driver would end the process with a panic.
    let ((mut renderer, uploaded), answer) = watched(device, || {
        let mut renderer = Renderer::with_samples(device, queue, *samples);
        let uploaded = session
            .open_model()
            .map_or(Ok(()), |open| renderer.set_model(&open.model));
        let images = session.maps().images();
        let images: Vec<_> = images
            .map(|[diffuse, normal]| MaterialImages { diffuse, normal })
            .collect();
        renderer.set_maps(&images);
        renderer.set_sky(session.sky().map(|image| &**image));
        (renderer, uploaded)
    });
    uploaded?;
    pollster::block_on(answer)?;
    let pixels = renderer.picture(&session.frame(), arguments.size)?.pixels_blocking()?;
    Ok(encode_png(&pixels, width, height)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_two_numbers_above_zero() {
        assert_eq!(size("1280x720"), Ok([1280, 720]));
        assert_eq!(size("1X2"), Ok([1, 2]));
        for wrong in ["", "1280", "0x5", "5x0", "-1x5", "axb", "1x2x3", "99999999999x1"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }
}
