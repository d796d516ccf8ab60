//! `bindpose render`: the page's picture, without a page; or many of them.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::ValueEnum;

use super::appearance::AppearanceArguments;
use super::failure::{Failure, Outcome};
use super::input;
use super::paths;
use super::progress::progress;
use super::quiet::quietly;
use super::series::SeriesArguments;
use super::text::{Plain, counted};
use super::textures::{Folders, Textures, write_missing};
use crate::contact_sheet::ContactSheet;
use crate::image::{self, encode_png};
use crate::render::device::{self, Gpu};
use crate::render::{MOST_UNDER_LAYER, PictureTarget, Renderer, watched};
use crate::scene::{Background, FrameOptions, Shot, Theme, ViewPreset};
use crate::session::{
    CameraCommand, Command, CrowdCommand, CrowdState, File, FileCommand, MAX_CROWD, MOST_SAMPLES, PlayCommand, Series,
    Session,
};

/// Draw a model into PNG files.
///
/// The same picture that the page shows, drawn without a window; or many pictures, through the clip and around the model. A software GPU
/// is enough. On the same GPU with the same driver a picture has the same bytes every time.
#[derive(Debug, clap::Args)]
#[command(after_long_help = OUTPUT)]
pub(super) struct Arguments {
    /// Model to read, or - for standard input.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Picture to write, a .png; with --frames, --fps or --turntable the folder for the pictures.
    ///
    /// A folder that is not there is made. Of one that is there, files of the same names are replaced and the others stay, also
    /// pictures of an earlier, longer series.
    #[arg(short, long, value_name = "PATH")]
    output: PathBuf,
    /// Write over files that are marked as read-only too.
    #[arg(long)]
    force: bool,
    /// Clip by its name [default: the first].
    #[arg(long, value_name = "NAME")]
    clip: Option<String>,
    #[command(flatten)]
    series: SeriesArguments,
    /// Width and height of each file's picture in pixels, each up to what the GPU's textures have: mostly 16384. Large ones are drawn in bands.
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "1280x720")]
    size: [u32; 2],
    /// Where to look from; the model is framed.
    #[arg(long, value_parser = input::one_of(&ViewPreset::ALL, ViewPreset::name), default_value = "three-quarter")]
    view: ViewPreset,
    /// Of how many pictures each is the mean, 1 to 4096: edges, shadows and what is seen through hair become the smoother; 1 is what the
    /// page shows while it moves [default: 64; 16 for each of many, and where the CPU draws].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_SAMPLES)))]
    samples: Option<u32>,
    /// Depth of field: the diameter of the lens as a part of the distance to the model's middle, 0 to 0.5.
    #[arg(long, value_name = "PART", value_parser = aperture, default_value = "0")]
    aperture: f32,
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
    /// Reads the pictures that the model names. Maps that are missing or cannot be read are listed on standard error, a line each; the
    /// picture is drawn without them. A cube map is named in a note.
    #[arg(long, value_name = "DIR")]
    textures: Vec<PathBuf>,
    /// A cube map (.dds) or a panorama (.hdr) for the sky: it is behind the model, and lights it in the studio.
    #[arg(long, value_name = "FILE")]
    sky: Option<PathBuf>,
    /// What to refuse.
    #[arg(long, value_name = "WHAT", value_enum, requires = "textures")]
    deny: Vec<Denied>,
    #[command(flatten)]
    appearance: AppearanceArguments,
}

const OUTPUT: &str = "\
Warnings and notes, on standard error:
  PATH: warning[CODE]: MESSAGE
  map-missing          no file of the folders fits a map; PATH is the model's
  image-*, dds-*       the picture that fits a map is damaged or of a kind that is not read
  file-unreadable      a picture that fits a map, or an entry of a folder, that the system does not let us read
  folder-unreadable    likewise a folder inside of DIR
  folder-too-large     a folder with more entries than are looked at
  link-broken          a link to nothing
  not-a-file           a pipe or device with the name of a map
  map-is-cube          a cube map: a warning where it has the name of a map, else a note

Pictures of a folder become a film with, for example:
  bindpose render walk.m3d -o frames --fps 30
  ffmpeg -framerate 30 -i frames/frame-%04d.png walk.mp4

Exit codes:
  0  the picture is written, or all of them
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
    input::sides(text).ok_or_else(|| "a size is a width and a height in pixels, such as 1280x720".into())
}

fn aperture(text: &str) -> Result<f32, String> {
    let most = FrameOptions::WIDEST_APERTURE;
    let part = text.parse().ok().filter(|part| (0.0..=most).contains(part));
    part.ok_or_else(|| format!("an aperture is a number from 0 to {most}"))
}

/// Rows of a band are a multiple of this: rasterisers draw in tiles, and what they round there is then the same.
const BAND_STEP: u64 = 64;

/// Of how many pictures each is the mean, where nothing is asked for: one alone, and each of many or where the CPU draws.
const SAMPLES: [u32; 2] = [64, 16];

pub(super) fn run(arguments: &Arguments, out: &mut dyn Write, err: &mut dyn Write) -> Result<Outcome, Failure> {
    arguments.series.check(&arguments.output)?;
    paths::check_writable(&arguments.output, arguments.force)?;
    let (mut session, lacks_maps) = open(arguments, err)?;
    let shots = arguments.series.shots(&mut session, &arguments.file)?;
    let mut sheet = match arguments.series.sheet() {
        Some(cells) => {
            let transparent = session.look().background == Background::None;
            Some(ContactSheet::new(arguments.size, cells, arguments.theme, transparent)?)
        }
        None => None,
    };
    let size = sheet.as_ref().map_or(arguments.size, ContactSheet::cell_size);
    let said = in_words(arguments, &session, &shots, size);
    let (gpu, backend) = open_gpu(arguments.backend)?;
    let is_slow = device::is_software(&gpu.info) || shots.len() > 1;
    let samples = arguments.samples.unwrap_or(SAMPLES[usize::from(is_slow)]);
    let samples = if gpu.draws_means { samples } else { 1 };
    let target = PictureTarget::new(size).with_mean_of(samples).waiting();
    let mut painter = Painter::new(&session, &gpu, target, arguments.aperture)?;
    let [width, height] = size.map(|side| side as f32);
    let mut series = Series::new(session, width / height, shots);

    let folder = arguments.series.fills_folder().then_some(&*arguments.output);
    if let Some(folder) = folder {
        std::fs::create_dir_all(folder).map_err(|reason| Failure::Unwritable {
            path: folder.to_owned(),
            reason,
        })?;
    }
    let progress = progress(series.count(), "drawing {pos} of {len} pictures, {eta} left");
    let drawn = (0..series.count()).try_for_each(|index| -> Result<(), Failure> {
        let pixels = painter.draw(&mut series, index, size)?;
        match (&mut sheet, folder) {
            (Some(sheet), _) => sheet.place(index, &pixels, series.caption(index)),
            (None, folder) => {
                let in_folder = folder.map(|folder| folder.join(format!("frame-{index:04}.png")));
                let path = in_folder.as_ref().unwrap_or(&arguments.output);
                paths::write(path, &encode_png(&pixels, size[0], size[1])?, arguments.force)?;
            }
        }
        progress.inc(1);
        Ok(())
    });
    progress.finish_and_clear();
    drawn?;
    if let Some(sheet) = sheet {
        paths::write(&arguments.output, &sheet.into_png()?, arguments.force)?;
    }

    let line = format!("{said}, drawn by {} ({backend})", gpu.info.name);
    writeln!(out, "{}", Plain(&line))?;
    Ok(if lacks_maps && arguments.deny.contains(&Denied::MissingMaps) {
        Outcome::FileHasErrors
    } else {
        Outcome::Fine
    })
}

/// What is written, in a line: `walk.png: 1280x720, Walk at 0.3 s`.
fn in_words(arguments: &Arguments, session: &Session, shots: &[Shot], [width, height]: [u32; 2]) -> String {
    let mut parts = Vec::new();
    let [sheet_width, sheet_height] = arguments.size;
    match arguments.series.sheet() {
        Some(_) => {
            parts.push(format!("{sheet_width}x{sheet_height}"));
            parts.push(format!("{} of {width}x{height}", counted(shots.len(), "picture")));
        }
        None if arguments.series.fills_folder() => {
            parts.push(format!("{} of {width}x{height}", counted(shots.len(), "picture")));
        }
        None => parts.push(format!("{width}x{height}")),
    }
    if let Some(clip) = session.clip() {
        let times_secs = || shots.iter().filter_map(|shot| shot.time_secs);
        let last_secs = times_secs().reduce(f32::max);
        parts.push(match (times_secs().next(), last_secs) {
            (Some(first_secs), Some(last_secs)) => {
                format!("{} from {first_secs:.3} s to {last_secs:.3} s", clip.name)
            }
            _ => format!("{} at {} s", clip.name, session.playback().time_secs()),
        });
    }
    if shots.iter().any(|shot| shot.turn_radians.is_some()) {
        parts.push("all round".into());
    }
    if session.crowd().count > 1 {
        parts.push(format!("{} instances", session.crowd().count));
    }
    format!("{}: {}", arguments.output.display(), parts.join(", "))
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
    if let Some(path) = &arguments.sky {
        add_sky(path, &mut session)?;
    }
    if let (Some(open), Some(asked)) = (session.open_model(), &arguments.clip)
        && let Some(clip) = input::choose_clip(&open.model, path, Some(asked))?
    {
        session.apply(PlayCommand::SelectClip(clip));
    }
    session.apply(CrowdCommand::Set {
        count: usize::from(arguments.crowd),
        seed: arguments.seed,
    });
    session.apply(Command::SetTheme(arguments.theme));
    arguments.appearance.apply(&mut session);
    session.apply(CameraCommand::LookFrom(arguments.view));
    Ok((session, lacks_maps))
}

/// Adds the model's maps from the folders. Gives whether maps are missing.
fn add_textures(arguments: &Arguments, session: &mut Session, err: &mut dyn Write) -> Result<bool, Failure> {
    let folders = arguments.textures.as_slice();
    let materials = match session.open_model() {
        Some(open) if !folders.is_empty() => open.model.materials.clone(),
        _ => return Ok(false),
    };
    let folders = Folders::walk(folders, err)?;
    let mut textures = Textures::of(&folders, &materials);
    textures.write_warnings(err)?;
    textures.write_cubes(err)?;
    let pictures = std::mem::take(&mut textures.pictures);
    if !pictures.is_empty() {
        session.apply(FileCommand::Add(pictures));
    }
    Ok(write_missing(
        err,
        &arguments.file,
        &textures.states(&materials, session.maps()),
    )?)
}

/// Makes a cube map or a panorama the sky. Its first bytes tell what it is, whatever its name.
fn add_sky(path: &Path, session: &mut Session) -> Result<(), Failure> {
    let bytes = paths::read(path)?;
    let name = path.to_string_lossy();
    let refused = |message: String| Err(Failure::WrongUse(message));
    if let Err(fault) = image::check(&bytes, &name) {
        return refused(fault.to_string());
    }
    if image::cube_side(&bytes).is_none() {
        return refused(format!(
            "{name} is a flat picture; --sky takes a cube map or a panorama"
        ));
    }
    session.apply(FileCommand::Add(vec![File::new("sky.dds", bytes)]));
    match (session.sky(), session.diagnostics().last()) {
        (None, Some(fault)) => refused(fault.message.replace("sky.dds", &name)),
        _ => Ok(()),
    }
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

/// Draws pictures of one model: it is brought to the GPU once, and all pictures are drawn into one target.
struct Painter {
    device: wgpu::Device,
    renderer: Renderer,
    target: PictureTarget,
    aperture: f32,
}

impl Painter {
    fn new(session: &Session, gpu: &Gpu, target: PictureTarget, aperture: f32) -> Result<Self, Failure> {
        let Gpu {
            device, queue, samples, ..
        } = gpu;
        // Otherwise an error of the driver would end the process with a panic.
        let ((renderer, uploaded), answer) = watched(device, || {
            let mut renderer = Renderer::with_samples(device, queue, *samples);
            let uploaded = session
                .open_model()
                .map_or(Ok(()), |open| renderer.set_model(&open.model));
            renderer.set_maps(&session.maps().images().collect::<Vec<_>>());
            renderer.set_sky(session.sky().map(|image| &**image));
            (renderer, uploaded)
        });
        uploaded?;
        pollster::block_on(answer)?;
        Ok(Self {
            device: device.clone(),
            renderer,
            target,
            aperture,
        })
    }

    /// The pixels of a picture, as [`encode_png`] takes them.
    fn draw(&mut self, series: &mut Series, index: usize, [width, height]: [u32; 2]) -> Result<Vec<u8>, Failure> {
        let mut frame = series.frame(index);
        frame.options.aperture = self.aperture;
        // A band needs a part of the memory that all rows would.
        let steps = MOST_UNDER_LAYER / u64::from(width.max(1)) / BAND_STEP;
        let rows = (steps.max(1) * BAND_STEP) as u32;
        self.target.show(0..rows.min(height));
        self.target.check(&self.device)?;
        self.renderer.refine_for(&frame);
        let mut pixels = Vec::new();
        let len = (u64::from(width) * u64::from(height)).saturating_mul(4);
        usize::try_from(len)
            .ok()
            .and_then(|len| pixels.try_reserve_exact(len).ok())
            .ok_or(Failure::NoRoomForPicture {
                width,
                height,
                megabytes: len / 1_000_000,
            })?;
        for top in (0..height).step_by(rows as usize) {
            self.target.show(top..(top + rows).min(height));
            pixels.extend(
                self.renderer
                    .picture_into(&frame, &mut self.target)?
                    .pixels_blocking()?,
            );
        }
        Ok(pixels)
    }
}
