//! Frame time of the renderer on software GPUs, Vulkan's and GL's: with everything, with one pass left out at a time, under each
//! light, split, as a property, and still; in the others the pose moves, as while a clip plays. A software GPU draws with the CPU,
//! so only the ratios of one run tell something.
//!
//! criterion repeats too often for frames of a tenth of a second; this takes the ways in turn, so that what else the machine does
//! falls on all of them, and shows the least time of each, which it disturbed least, beside the median.

use std::path::Path;
use std::time::Instant;

use bindpose::render::device::{self, Backend};
use bindpose::render::{MaterialImages, Renderer, Target};
use bindpose::scene::{FrameOptions, Light, Pass, Passes, ViewMode};
use bindpose::session::{File, FileCommand, PlayCommand, Session};

const SIZE: [u32; 2] = [1280, 720];
const ROUNDS: usize = 9;

/// One way to draw the frame.
struct Way {
    name: String,
    /// The pose is that of the frame before.
    is_still: bool,
    options: FrameOptions,
    millis: Vec<f64>,
}

fn ways(options: FrameOptions) -> Vec<Way> {
    let way = |name: &str, change: &dyn Fn(&mut FrameOptions)| {
        let mut options = options;
        change(&mut options);
        Way {
            name: name.to_owned(),
            is_still: false,
            options,
            millis: Vec::new(),
        }
    };
    let mut ways = Vec::new();
    for light in Light::ALL {
        let name = light.name();
        let mut with = |name: &str, passes: Passes| {
            ways.push(way(name, &|options| {
                options.light = light;
                options.passes = passes;
            }));
        };
        with(&format!("{name}, all passes off"), Passes::none());
        with(name, Passes::all());
        for pass in Pass::ALL {
            with(
                &format!("{name} without {}", pass.name()),
                Passes::all().with(pass, false),
            );
        }
    }
    ways.push(way("split in the middle", &|options| options.split = Some(0.5)));
    for light in Light::ALL {
        let all = |options: &mut FrameOptions| {
            options.light = light;
            options.passes = Passes::all();
        };
        // The first of two still frames draws the maps of the light.
        for name in ["moved", "still"] {
            let way = way(&format!("{}, {name}", light.name()), &all);
            ways.push(Way {
                is_still: name == "still",
                ..way
            });
        }
    }
    for mode in [ViewMode::BaseColor, ViewMode::AmbientOcclusion] {
        ways.push(way(&format!("property {}", mode.name()), &|options| {
            options.view_mode = mode;
        }));
    }
    ways
}

/// The soldier where it is at hand, else the sample figure, a second into its first clip, with its maps.
fn session() -> (&'static str, Session) {
    let mut session = Session::new(true);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let soldier = root.join("../shared/models/d3d12/soldier.m3d");
    let (name, files) = if soldier.exists() {
        let mut files = files_in(&root.join("../shared/textures/soldier"));
        files.extend(file(&soldier));
        ("soldier", files)
    } else {
        ("sample figure", files_in(&root.join("web/sample")))
    };
    session.apply(FileCommand::Add(files));
    session.apply(PlayCommand::Seek { time_secs: 1.0 });
    (name, session)
}

fn file(path: &Path) -> Option<File> {
    let name = path.file_name()?.to_string_lossy();
    Some(File::new(&name, std::fs::read(path).ok()?))
}

fn files_in(folder: &Path) -> Vec<File> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    entries.flatten().filter_map(|entry| file(&entry.path())).collect()
}

fn main() {
    for backend in [Backend::Vulkan, Backend::Gl] {
        measure(backend);
    }
}

#[expect(clippy::print_stdout, reason = "the times are what the benchmark is for")]
fn measure(backend: Backend) {
    let (name, mut session) = session();
    let gpu = pollster::block_on(device::headless(backend)).unwrap_or_else(|error| panic!("{error}"));
    let mut renderer = Renderer::with_samples(&gpu.device, &gpu.queue, gpu.samples);
    let open = session.open_model().expect("the input is sound");
    renderer.set_model(&open.model).expect("it is small");
    let images = session.maps().images();
    let images: Vec<_> = images
        .map(|[diffuse, normal]| MaterialImages { diffuse, normal })
        .collect();
    renderer.set_maps(&images);
    let map_count = images
        .iter()
        .flat_map(|maps| [maps.diffuse, maps.normal])
        .flatten()
        .count();
    let [width, height] = SIZE;
    let mut target = Target::with_samples(&gpu.device, width, height, gpu.samples);

    let mut ways = ways(session.frame().options);
    let mut time_secs = 1.0;
    // The first round makes pipelines and textures.
    for round in 0..=ROUNDS {
        for way in &mut ways {
            if !way.is_still {
                time_secs += 1e-3;
                session.apply(PlayCommand::Seek { time_secs });
            }
            let mut frame = session.frame();
            frame.options = way.options;
            let start = Instant::now();
            renderer.render(&frame, &mut target);
            let done = gpu.device.poll(wgpu::PollType::wait_indefinitely());
            done.expect("the device is there");
            if round > 0 {
                way.millis.push(start.elapsed().as_secs_f64() * 1e3);
            }
        }
    }

    println!(
        "frame/{name} with {map_count} maps, {width} x {height}, {backend:?}, {}: least and median of {ROUNDS}, least in \
         relation to the first",
        gpu.info.name
    );
    for way in &mut ways {
        way.millis.sort_by(f64::total_cmp);
    }
    let all_off = ways[0].millis[0];
    for Way { name, millis, .. } in &ways {
        let (least, median) = (millis[0], millis[ROUNDS / 2]);
        println!("{name:28} {least:8.1} ms {median:8.1} ms  {:5.2}", least / all_off);
    }
}
