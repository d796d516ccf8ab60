//! Frame time of the renderer on software GPUs, Vulkan's and GL's: with everything, with one pass left out at a time, under each
//! light, split, as a property, still, with one sample a pixel, and in a crowd; but for the still ones the pose moves, as while a clip plays. A software GPU draws
//! with the CPU, so only the ratios of one run tell something.
//!
//! criterion repeats too often for frames of a tenth of a second; this takes the ways in turn, so that what else the machine does
//! falls on all of them, and shows the least time of each, which it disturbed least, beside the median.

use std::path::Path;
use std::time::Instant;

use bindpose::render::device::{self, Backend};
use bindpose::render::{Renderer, SampleCount, Target};
use bindpose::scene::{
    Aabb, Crowd, CrowdInstance, FrameCost, FrameOptions, Light, Pass, Passes, RenderFrame, ViewMode,
};
use bindpose::session::{File, FileCommand, PlayCommand, Session};
use glam::{Affine3A, Vec3};

const SIZE: [u32; 2] = [1280, 720];
const ROUNDS: usize = 9;

/// One way to draw the frame.
struct Way {
    name: String,
    /// The pose is that of the frame before.
    is_still: bool,
    /// Instances of the model.
    count: usize,
    /// One sample a pixel, as a slow device moves.
    is_coarse: bool,
    options: FrameOptions,
    millis: Vec<f64>,
    cost: FrameCost,
}

/// Instances in the crowd.
const CROWD: usize = 10;

/// Instances beside the model, in rows behind it, and twice as many poses, so that each frame has others.
struct Others {
    instances: Vec<CrowdInstance>,
    palettes: Vec<Affine3A>,
    world_bounds: Aabb,
}

impl Others {
    fn of(session: &mut Session) -> Self {
        let mut palettes = Vec::new();
        for pose in 0..2 * CROWD - 2 {
            session.apply(PlayCommand::Seek {
                time_secs: 0.05 * pose as f32,
            });
            palettes.extend_from_slice(&session.frame().palette.0);
        }
        let frame = session.frame();
        let apart = frame.world_bounds.size() * 1.1;
        let mut world_bounds = frame.world_bounds;
        let place = |index: usize| {
            let (row, column) = (index / 4, index % 4);
            let place = Vec3::new(column as f32 - 1.5, 0.0, row as f32) * apart;
            let moved = Affine3A::from_translation(place);
            world_bounds = world_bounds.union(frame.world_bounds.transformed(moved));
            CrowdInstance {
                world_from_model: moved * frame.world_from_model,
                palette: index as u32 - 4,
            }
        };
        Self {
            instances: (4..CROWD + 3).map(place).collect(),
            palettes,
            world_bounds,
        }
    }

    /// In poses that the frame before this step had not.
    fn join<'a>(&'a self, frame: &mut RenderFrame<'a>, step: usize) {
        let joints = frame.palette.0.len();
        let first = step % (CROWD - 1) * joints;
        frame.crowd = Crowd {
            instances: &self.instances,
            in_sight: self.instances.len(),
            palettes: &self.palettes[first..first + (CROWD - 1) * joints],
        };
        frame.world_bounds = self.world_bounds;
    }
}

fn ways(options: FrameOptions) -> Vec<Way> {
    let way = |name: &str, change: &dyn Fn(&mut FrameOptions)| {
        let mut options = options;
        change(&mut options);
        Way {
            name: name.to_owned(),
            is_still: false,
            count: 1,
            is_coarse: false,
            options,
            millis: Vec::new(),
            cost: FrameCost::default(),
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
        ways.push(Way {
            is_coarse: true,
            ..way(&format!("{}, one sample", light.name()), &all)
        });
        ways.push(Way {
            count: CROWD,
            ..way(&format!("{}, a crowd of {CROWD}", light.name()), &all)
        });
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
    let images: Vec<_> = session.maps().images().collect();
    renderer.set_maps(&images);
    let map_count = images.iter().flatten().flatten().count();
    let [width, height] = SIZE;
    let mut target = Target::with_samples(&gpu.device, width, height, gpu.samples);
    let mut coarse_target = Target::with_samples(&gpu.device, width, height, SampleCount::One);

    let others = Others::of(&mut session);
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
            if way.count > 1 {
                others.join(&mut frame, round);
            }
            let start = Instant::now();
            let target = if way.is_coarse { &mut coarse_target } else { &mut target };
            way.cost = renderer.render(&frame, target);
            let done = gpu.device.poll(wgpu::PollType::wait_indefinitely());
            done.expect("the device is there");
            if round > 0 {
                way.millis.push(start.elapsed().as_secs_f64() * 1e3);
            }
        }
    }

    println!(
        "frame/{name} with {map_count} maps, {width} x {height}, {backend:?}, {}: least and median of {ROUNDS}, least in \
         relation to the first, indices drawn, KB uploaded",
        gpu.info.name
    );
    for way in &mut ways {
        way.millis.sort_by(f64::total_cmp);
    }
    let all_off = ways[0].millis[0];
    for Way { name, millis, cost, .. } in &ways {
        let (least, median) = (millis[0], millis[ROUNDS / 2]);
        let (relation, uploaded) = (least / all_off, cost.uploaded_bytes as f64 / 1e3);
        println!(
            "{name:28} {least:8.1} ms {median:8.1} ms  {relation:5.2} {:9} {uploaded:7.1}",
            cost.vertices
        );
    }
}
