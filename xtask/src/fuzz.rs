//! `cargo xtask fuzz`: libFuzzer makes up files for the core, watching which code they reach.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::thread;

use crate::failure::{Doing as _, Failure};
use crate::prerequisites;
use crate::process::Line;

/// Compiles the core so that libFuzzer sees which branches were taken and what was compared: passes of the compiler that have no option
/// of their own. Sums that overflow and assertions end the program, as in tests.
const FLAGS: &str = "--cfg fuzzing -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares -Cdebug-assertions -Coverflow-checks";

/// What is tried, as `tools/fuzz` names it.
const TARGETS: [&str; 6] = ["models", "buffers", "pictures", "archives", "whole", "fbx"];

/// Inputs are short, so that many are tried. One that takes longer or more memory than this is a fault, as a panic is.
const LIMITS: [&str; 3] = ["-max_len=16384", "-timeout=5", "-rss_limit_mb=1024"];

/// Options of `fuzz`.
#[derive(Debug, PartialEq)]
pub(crate) struct FuzzOptions {
    /// How long each target is tried.
    pub(crate) secs: u32,
    /// What was found worth keeping goes into the corpora that the checks read.
    pub(crate) keep: bool,
}

impl FuzzOptions {
    /// A minute on two cores.
    pub(crate) fn of_the_checks() -> Self {
        Self { secs: 24, keep: false }
    }
}

/// Fuzzes all targets, as many at a time as there are cores.
pub(crate) fn run(options: &FuzzOptions) -> Result<(), Failure> {
    prerequisites::ensure_fuzzer()?;
    let host = Line::new("rustc").args(["--print", "host-tuple"]).output();
    let host = host.unwrap_or_default().trim().to_owned();
    // A folder of its own: with other flags all crates are compiled anew.
    let built = folder().join("build");
    let flags = format!("CARGO_TARGET_{}_RUSTFLAGS", host.replace('-', "_").to_uppercase());
    Line::cargo()
        .env("CARGO_TARGET_DIR", &built)
        .env(&flags, FLAGS)
        .args(["build", "--release", "--package", "fuzz", "--target", &host])
        .run()?;
    let program = built.join(&host).join("release/fuzz");
    corpora("unpack")?;
    let waiting = Mutex::new(TARGETS.to_vec());
    let fuzz_those_that_wait = || -> Result<(), Failure> {
        // The lock is given back before the target is tried.
        let next = || waiting.lock().map_or(None, |mut waiting| waiting.pop());
        while let Some(target) = next() {
            fuzz(&program, target, options.secs)?;
        }
        Ok(())
    };
    thread::scope(|scope| {
        let cores = thread::available_parallelism().map_or(1, usize::from);
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(fuzz_those_that_wait)).collect();
        let outcomes = workers
            .into_iter()
            .map(|worker| worker.join().expect("it does not panic"));
        outcomes.collect::<Result<(), Failure>>()
    })?;
    if options.keep {
        for target in TARGETS {
            minimise(&program, target)?;
        }
        corpora("pack")?;
    }
    Ok(())
}

/// Where it is built, and where the corpora grow.
fn folder() -> PathBuf {
    crate::target_dir().join("fuzz")
}

/// Inputs of a target that reach different code.
fn corpus(target: &str) -> PathBuf {
    folder().join("corpus").join(target)
}

/// Unpacks the corpora of the repository into the folders that the fuzzer adds to, or packs them again.
fn corpora(verb: &str) -> Result<(), Failure> {
    TARGETS.into_iter().try_for_each(|target| {
        let corpus = corpus(target);
        fs::create_dir_all(&corpus).doing(format!("making {}", corpus.display()))?;
        Line::cargo()
            .args([
                "run",
                "--quiet",
                "--package",
                "fuzz",
                "--",
                verb,
                target,
                &corpus.to_string_lossy(),
            ])
            .run()
    })
}

/// Files of others that another fuzzer damaged, where the folder of models beside the project has them.
fn damaged(target: &str) -> Option<&'static str> {
    const FOLDER: &str = "../shared/fbx/damaged";
    (target == "fbx" && Path::new(FOLDER).is_dir()).then_some(FOLDER)
}

fn fuzz(program: &Path, target: &str, secs: u32) -> Result<(), Failure> {
    let found = format!("-artifact_prefix={}/found-{target}-", folder().display());
    let time = format!("-max_total_time={secs}");
    let mut printed = String::new();
    let outcome = Line::new(&program.to_string_lossy())
        .env("BINDPOSE_FUZZ_TARGET", target)
        .args([&*corpus(target).to_string_lossy(), "tests/fixtures"])
        .args(damaged(target))
        .args(LIMITS)
        .args([&*time, &found, "-print_final_stats=1"])
        .run_into(&mut printed);
    let told = |line: &&str| line.starts_with("stat::") || line.contains("panicked") || line.contains("Test unit");
    let told: Vec<&str> = printed.lines().filter(told).collect();
    eprintln!("── {target}\n{}", told.join("\n"));
    outcome
}

/// Leaves few short inputs that together reach all code that is reached, however often each reaches it.
fn minimise(program: &Path, target: &str) -> Result<(), Failure> {
    let (corpus, all) = (corpus(target), corpus(target).with_extension("all"));
    fs::rename(&corpus, &all).doing("setting the corpus aside")?;
    fs::create_dir_all(&corpus).doing("making the corpus")?;
    let mut printed = String::new();
    let merged = Line::new(&program.to_string_lossy())
        .env("BINDPOSE_FUZZ_TARGET", target)
        .args(["-set_cover_merge=1", "-use_counters=0"])
        .args([&*corpus.to_string_lossy(), &*all.to_string_lossy()])
        .args(LIMITS)
        .run_into(&mut printed);
    merged?;
    fs::remove_dir_all(&all).doing("removing what is no longer needed")
}
