//! Instructions that the core's work takes, as callgrind counts them: the same in every run, whatever else the machine does.
//!
//! It is built as the program is, in the profile `dist`: `cargo run --profile dist --package counts`. What that makes small and not fast is
//! counted as it is.
//!
//! `counts` runs each work under valgrind and compares with `limits.txt`; a count above its limit ends with an error.
//! `counts WORK MODEL` does one work, and prints a number that shows that it was done right. A work is prepared, then done once
//! without being counted, so that tables that are made at first use are there.

use std::fs;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use bindpose::anim::{self, CompiledClip, Extent, Palette, PoseBuffers, SkinnedVertices, VertexGroups};
use bindpose::check;
use bindpose::format;
use bindpose::image::{Image, MapKind, decode, encode_png};
use bindpose::import::{self, m3d};
use bindpose::model::Model;
use bindpose::scene::{Ray, pick};
use bindpose::session::{File, FileCommand, Session};
use bindpose::slices::{Slices, at_once};
use glam::Vec3;

/// What a count may be above its limit: libraries of another machine copy memory in other ways.
const TOLERANCE: f64 = 1.02;

/// A work by its name: it takes a file and gives the number that shows that it was done right.
type Work = (&'static str, fn(&[u8]) -> u64);

const WORKS: [Work; 11] = [
    ("parse", parse),
    ("build", build),
    ("import", import),
    ("compile", compile),
    ("check", check),
    ("extent", extent),
    ("pose", pose),
    ("skin", skin),
    ("positions", positions),
    ("pick", picking),
    ("open", open),
];

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let outcome = match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => compare(),
        ["mips", side] => one(mips, &side.parse::<u16>().unwrap_or(1024).to_le_bytes()),
        [work, model] => match WORKS.into_iter().find(|(name, _)| *name == work) {
            Some((_, run)) => fs::read(model)
                .map_err(|error| format!("{model}: {error}"))
                .and_then(|bytes| one(run, &bytes)),
            None => Err(format!("there is no work `{work}`")),
        },
        _ => Err("use: counts [WORK MODEL]".to_owned()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(words) => {
            eprintln!("{words}");
            ExitCode::FAILURE
        }
    }
}

fn one(run: fn(&[u8]) -> u64, input: &[u8]) -> Result<(), String> {
    println!("{:016x}", run(input));
    Ok(())
}

/// Counts each line of `limits.txt`: a work, a file beside the repository or in it, the most instructions in millions.
fn compare() -> Result<(), String> {
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    if program.parent().is_none_or(|folder| !folder.ends_with("dist")) {
        return Err(
            "the limits are of the program as it is shipped: cargo run --profile dist --package counts".to_owned(),
        );
    }
    let limits = include_str!("../limits.txt").lines();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut above = 0;
    println!("{:>10} {:>10}  work, model", "counted, M", "limit, M");
    for line in limits.filter(|line| !line.starts_with('#') && !line.is_empty()) {
        let [work, model, limit] = line.split_whitespace().collect::<Vec<_>>()[..] else {
            return Err(format!("limits.txt: three words are wanted, not `{line}`"));
        };
        let limit: f64 = limit.parse().map_err(|_| format!("limits.txt: `{limit}`"))?;
        let path = root.join(model);
        let input = if work == "mips" { PathBuf::from(model) } else { path };
        if work != "mips" && !input.exists() {
            println!("{:>10} {limit:>10}  {work}, {model} (not here)", "-");
            continue;
        }
        let counted = count(&program, work, &input)? as f64 / 1e6;
        let word = if counted > limit * TOLERANCE { "  ABOVE" } else { "" };
        above += usize::from(!word.is_empty());
        println!("{counted:>10.3} {limit:>10}  {work}, {model}{word}");
    }
    match above {
        0 => Ok(()),
        _ => Err(format!(
            "{above} above the limit: make it less, or raise the limit and say why"
        )),
    }
}

/// Runs this program under callgrind, which counts inside [`counted`] alone.
fn count(program: &Path, work: &str, input: &Path) -> Result<u64, String> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--toggle-collect=counts::counted"])
        .arg("--callgrind-out-file=/dev/null")
        .arg(program)
        .arg(work)
        .arg(input)
        .output()
        .map_err(|error| format!("valgrind cannot be started: {error}"))?;
    let told = String::from_utf8_lossy(&output.stderr);
    let collected = told.lines().find_map(|line| line.split("Collected : ").nth(1));
    collected
        .filter(|_| output.status.success())
        .and_then(|number| number.trim().parse().ok())
        .ok_or_else(|| format!("{work}: {told}"))
}

/// What is done in here is counted.
#[inline(never)]
fn counted(work: &mut dyn FnMut()) {
    work();
}

/// Does a work twice; the second time is counted. Gives what came of it.
fn twice<T>(mut work: impl FnMut() -> T) -> T {
    let mut made = work();
    counted(&mut || made = work());
    made
}

fn hash(values: impl IntoIterator<Item = f32>) -> u64 {
    let mut hasher = DefaultHasher::new();
    values.into_iter().for_each(|value| value.to_bits().hash(&mut hasher));
    hasher.finish()
}

fn parse(bytes: &[u8]) -> u64 {
    let parsed = twice(|| format::parse(bytes).expect("the model is sound"));
    hash(parsed.document.vertices.iter().flat_map(|vertex| vertex.position))
}

fn build(bytes: &[u8]) -> u64 {
    let parsed = format::parse(bytes).expect("the model is sound");
    let built = || m3d::from_document(&parsed.document, &parsed.lines).expect("the model is sound");
    let (model, _) = twice(built);
    of_mesh(&model)
}

fn import(bytes: &[u8]) -> u64 {
    of_mesh(&twice(|| model_of(bytes)))
}

fn model_of(bytes: &[u8]) -> Model {
    import::import(bytes).expect("the model is sound").model
}

fn of_mesh(Model { mesh, .. }: &Model) -> u64 {
    let tangents = mesh.tangents.iter().flat_map(|tangent| tangent.to_array());
    hash(mesh.normals.iter().flat_map(|normal| normal.to_array()).chain(tangents))
}

fn compile(bytes: &[u8]) -> u64 {
    let model = model_of(bytes);
    let compiled = twice(|| CompiledClip::all(&model.clips));
    hash(compiled.iter().map(CompiledClip::end_secs))
}

fn check(bytes: &[u8]) -> u64 {
    let imported = import::import(bytes).expect("the model is sound");
    let compiled = CompiledClip::all(&imported.model.clips);
    let places = imported.source.places(bytes);
    twice(|| check::model(&imported.model, &compiled, &*places)).len() as u64
}

/// The groups of vertices, the box and the points of the first clip.
fn extent(bytes: &[u8]) -> u64 {
    let model = model_of(bytes);
    let clip = CompiledClip::new(&model.clips[0]);
    let measured = || async {
        let groups = VertexGroups::new(&model.mesh, &Slices::ENDLESS).await;
        Extent::of(&model, &groups, Some(&clip), &Slices::ENDLESS).await
    };
    let Extent { bounds, points, .. } = twice(|| at_once(measured()));
    let all = [bounds.min, bounds.max].into_iter().chain(points);
    hash(all.flat_map(|point| point.to_array()))
}

fn posed(model: &Model) -> Palette {
    let clip = CompiledClip::new(&model.clips[0]);
    let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
    let middle = 0.4f32.mul_add(clip.end_secs() - clip.start_secs(), clip.start_secs());
    buffers.evaluate(&model.skeleton, &clip, middle);
    buffers.palette
}

/// A thousand poses.
fn pose(bytes: &[u8]) -> u64 {
    let model = model_of(bytes);
    let clip = CompiledClip::new(&model.clips[0]);
    let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
    twice(|| {
        for step in 0..1000u16 {
            let fraction = f32::from(step) / 1000.0;
            let time_secs = fraction.mul_add(clip.end_secs() - clip.start_secs(), clip.start_secs());
            buffers.evaluate(&model.skeleton, &clip, time_secs);
        }
    });
    hash(buffers.palette.0.iter().flat_map(|matrix| matrix.to_cols_array()))
}

fn skin(bytes: &[u8]) -> u64 {
    let model = model_of(bytes);
    let palette = posed(&model);
    let mut moved = SkinnedVertices::default();
    twice(|| anim::skin(&model.mesh, &palette, &mut moved));
    let directions = moved.normals.iter().zip(&moved.tangents);
    hash(directions.flat_map(|(normal, tangent)| [normal.x, normal.y, tangent.x, tangent.y]))
}

fn positions(bytes: &[u8]) -> u64 {
    let model = model_of(bytes);
    let palette = posed(&model);
    let mut moved = Vec::new();
    twice(|| anim::skin_positions(&model.mesh, &palette, &mut moved));
    hash(moved.into_iter().flat_map(|position| position.to_array()))
}

/// A pick of a posed model, from in front through the middle of its box.
fn picking(bytes: &[u8]) -> u64 {
    let model = model_of(bytes);
    let mut moved = Vec::new();
    anim::skin_positions(&model.mesh, &posed(&model), &mut moved);
    let middle = model.bind_bounds().center();
    let ray = Ray {
        origin: middle - Vec3::Z * 1000.0,
        direction: Vec3::Z,
    };
    let mut in_ray = Vec::new();
    let place = glam::Affine3A::IDENTITY;
    let hit = twice(|| pick(&model.mesh, &moved, place, ray, &mut in_ray, |_| true));
    hit.map_or(0, |hit| hit.triangle as u64)
}

/// Opening the file, without pictures.
fn open(bytes: &[u8]) -> u64 {
    let open = || {
        let mut session = Session::new(false);
        session.apply(FileCommand::Add(vec![File::new("model.m3d", bytes)]));
        session
    };
    let session = twice(open);
    session.open_model().map_or(0, |open| of_mesh(&open.model))
}

/// Smaller levels of a square picture of colours, whose side is given.
fn mips(side: &[u8]) -> u64 {
    let side = u32::from(u16::from_le_bytes([side[0], side[1]]));
    let texels = (0..side * side).flat_map(|texel| texel.wrapping_mul(0x9e37_79b9).to_le_bytes());
    let png = encode_png(&texels.collect::<Vec<u8>>(), side, side).expect("the size fits");
    let picture = decode(&png, "noise.png").expect("it was just written");
    let made: Image = {
        let mut copies = vec![picture.clone(), picture];
        twice(|| copies.pop().expect("two").with_mips(MapKind::Diffuse))
    };
    let mut hasher = DefaultHasher::new();
    (0..made.level_count()).for_each(|level| made.to_rgba8(0, level).hash(&mut hasher));
    hasher.finish()
}
