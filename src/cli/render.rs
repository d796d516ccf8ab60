//! `bindpose render`: the page's picture, without a page.

use std::io::Write;
use std::path::PathBuf;

use clap::ValueEnum;

use super::appearance::AppearanceArguments;
use super::diagnostic::write_diagnostic;
use super::failure::{Failure, Outcome};
use super::input;
use super::quiet::quietly;
use super::text::Plain;
use super::textures::{Textures, Wanted, read_sky, write_missing};
use crate::image::encode_png;
use crate::render::device::{self, Gpu};
use crate::render::{MaterialImages, Renderer, watched};
use crate::scene::{Insets, Theme, ViewPreset};
use crate::session::{CameraCommand, Command, CrowdCommand, CrowdState, FileCommand, MAX_CROWD, PlayCommand, Session};

/// Draw a model into a PNG file.
///
/// The same picture that the page shows, drawn without a window. A software GPU is enough.
#[derive(Debug, clap::Args)]
#[command(after_long_help = OUTPUT)]
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
    #[arg(long, value_name = "SECS", value_parser = input::seconds, allow_negative_numbers = true)]
    time: Option<f32>,
    /// Width and height in pixels.
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "1280x720")]
    size: [u32; 2],
    /// Where to look from; the model is framed.
    #[arg(long, value_parser = input::one_of(&ViewPreset::ALL, ViewPreset::name), default_value = "three-quarter")]
    view: ViewPreset,
    /// How the GPU is driven [default: vulkan, or gl where that is missing].
    #[arg(long, value_enum)]
    backend: Option<Backend>,
    /// Instances of the model, 1 to 1000; the others stand beside and behind the first, each with a clip and a time of its own.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=MAX_CROWD as i64), default_value_t = 1)]
    crowd: u16,
    /// What the clips, times and places of the others come from.
    #[arg(long, value_name = "S", requires = "crowd", default_value_t = CrowdState::default().seed)]
    seed: u32,
    /// The theme of the backdrop and the grid.
    #[arg(long, value_parser = input::one_of(&Theme::ALL, Theme::name), default_value = "dark")]
    theme: Theme,
    /// A folder with the model's textures, folders and links in it included; may be given several times.
    ///
    /// Reads the pictures that the model names, and the largest cube map, which becomes the sky. Maps that are missing
    /// or cannot be read are listed on standard error, a line each; the picture is drawn without them.
    #[arg(long, value_name = "DIR")]
    textures: Vec<PathBuf>,
    /// What to refuse.
    #[arg(long, value_name = "WHAT", value_enum, requires = "textures")]
    deny: Vec<Denied>,
    #[command(flatten)]
    appearance: AppearanceArguments,
}

const OUTPUT: &str = "\
Warnings, on standard error:
  PATH: warning[CODE]: MESSAGE
  map-missing          no file of the folders fits a map; PATH is the model's
  image-*, dds-*       the picture that fits a map is damaged or of a kind that is not read
  file-unreadable      a picture that fits a map, or an entry of a folder, that the system does not let us read
  folder-unreadable    likewise a folder inside of DIR
  folder-too-large     a folder with more entries than are looked at
  link-broken          a link to nothing
  not-a-file           a pipe or device with the name of a map

Exit codes:
  0  the picture is written
  1  the model has errors; or with --deny missing-maps, the picture is written without some of its maps
  2  wrong use, or something is missing: a file or folder that can be read, a clip, a GPU";

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Backend {
    Vulkan,
    Gl,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Denied {
    /// Exit with 1 when a map that the model names is missing or cannot be read. The picture is written all the same.
    MissingMaps,
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

pub(super) fn run(arguments: &Arguments, out: &mut dyn Write, err: &mut dyn Write) -> Result<Outcome, Failure> {
    let (mut session, lacks_maps) = open(arguments, err)?;
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
    let crowd = match session.crowd().count {
        1 => String::new(),
        count => format!(", {count} instances"),
    };
    let output = arguments.output.display();
    let line = format!(
        "{output}: {width}x{height}{posed}{crowd}, drawn by {} ({backend})",
        gpu.info.name
    );
    writeln!(out, "{}", Plain(&line))?;
    Ok(if lacks_maps && arguments.deny.contains(&Denied::MissingMaps) {
        Outcome::FileHasErrors
    } else {
        Outcome::Fine
    })
}

/// A session that shows what the arguments ask for, as on the page, and whether maps are missing.
fn open(arguments: &Arguments, err: &mut dyn Write) -> Result<(Session, bool), Failure> {
    let path = &arguments.file;
    // Paused, so that time stays where it is set.
    let mut session = Session::new(true);
    session.apply(FileCommand::Add(input::read_all(path)?));
    if let Some(error) = session.error() {
        return Err(Failure::Refused {
            path: path.clone(),
            error: Box::new(error.clone()),
        });
    }
    let lacks_maps = add_textures(arguments, &mut session, err)?;
    if let (Some(open), Some(asked)) = (session.open_model(), &arguments.clip)
        && let Some(clip) = input::choose_clip(&open.model, path, Some(asked))?
    {
        session.apply(PlayCommand::SelectClip(clip));
    }
    if let Some(time_secs) = arguments.time {
        session.apply(PlayCommand::Seek { time_secs });
    }
    session.apply(CrowdCommand::Set {
        count: usize::from(arguments.crowd),
        seed: arguments.seed,
    });
    let [width, height] = arguments.size;
    session.apply(CameraCommand::SetViewport {
        aspect: width as f32 / height as f32,
        insets: Insets::default(),
    });
    session.apply(Command::SetTheme(arguments.theme));
    arguments.appearance.apply(&mut session);
    session.apply(CameraCommand::LookFrom(arguments.view));
    Ok((session, lacks_maps))
}

/// Adds the model's maps from the folders, and the largest readable cube map as the sky. Gives whether maps are
/// missing.
fn add_textures(arguments: &Arguments, session: &mut Session, err: &mut dyn Write) -> Result<bool, Failure> {
    let folders = arguments.textures.as_slice();
    let materials = match session.open_model() {
        Some(open) if !folders.is_empty() => open.model.materials.clone(),
        _ => return Ok(false),
    };
    let mut textures = Textures::read(folders, &materials, Wanted::MapsAndSky)?;
    textures.write_warnings(err)?;
    let pictures = std::mem::take(&mut textures.pictures);
    if !pictures.is_empty() {
        session.apply(FileCommand::Add(pictures));
    }
    let lacks_maps = write_missing(err, &arguments.file, &textures.states(&materials, session.maps()))?;
    for path in &textures.cubes {
        match read_sky(path) {
            Ok(file) => {
                session.apply(FileCommand::Add(vec![file]));
                break;
            }
            Err(warning) => write_diagnostic(err, path, &warning, None)?,
        }
    }
    Ok(lacks_maps)
}

fn open_gpu(backend: Option<Backend>) -> Result<(Gpu, device::Backend), Failure> {
    let open = |backend| {
        let open = || pollster::block_on(device::headless(backend));
        // When opening fails, the second try lets the driver's messages through.
        quietly(open).or_else(|_| open()).map(|gpu| (gpu, backend))
    };
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
    // Otherwise an error of the driver would end the process with a panic.
    let ((mut renderer, uploaded), answer) = watched(device, || {
        let mut renderer = Renderer::with_samples(device, queue, *samples);
        let uploaded = session
            .open_model()
            .map_or(Ok(()), |open| renderer.set_model(&open.model));
        let images = session.maps().images();
        let images: Vec<_> = images
            .map(|[diffuse, normal, ..]| MaterialImages { diffuse, normal })
            .collect();
        renderer.set_maps(&images);
        renderer.set_sky(session.sky().map(|image| &**image));
        (renderer, uploaded)
    });
    uploaded?;
    pollster::block_on(answer)?;
    let pixels = renderer
        .picture(&session.frame_at_rest(), arguments.size)?
        .pixels_blocking()?;
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
