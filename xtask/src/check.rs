//! `cargo xtask test`: every check, in order, stopping at the first failure.

use std::thread;
use std::time::{Duration, Instant};

use crate::absent;
use crate::args::{BenchOptions, TestOptions};
use crate::browsers::{Browser, BrowserRun, RUNS};
use crate::dist;
use crate::failure::Failure;
use crate::fuzz::{self, FuzzOptions};
use crate::list::List;
use crate::npm;
use crate::prerequisites;
use crate::process::Line;
use crate::second_tries;
use crate::serve;
use crate::site::Site;
use crate::sizes;
use crate::wasm::{self, Profile, Program};

/// The environment variable that says how many times as many cases a property is tried with, and how many `--long` takes.
const CASES: &str = "BINDPOSE_CASES";
const LONG_CASES: &str = "10";

/// Tests of the page's scripts that need no browser.
const SCRIPT_TESTS: &str = "tests/browser/alone/all.js";

/// The package with the browser tests.
const BROWSER_TESTS: &str = "tests/browser";

/// Runs all of them, or those in the browser alone.
pub(crate) fn run(options: &TestOptions) -> Result<(), Failure> {
    let mut steps = Steps::new();
    let absent = List::new("absent-files")?;
    let second_tries = List::new("second-tries")?;
    steps.step("What the tests draw with", prerequisites::ensure)?;
    steps.step("The wasm target", wasm::ensure_target)?;
    if !options.browser_alone {
        native(&mut steps, &absent, options.long)?;
    }
    let site = site(&mut steps, Profile::Dev, &options.browsers)?;
    steps.step("Two builds as hosts have them", || dist::write_for_tests(&site))?;
    if options.long {
        steps.step("The package with the element", || npm::write_for_tests(&site))?;
    }
    let page = served(&mut steps, site)?;
    if !options.browser_alone {
        steps.step("The page's scripts alone", || {
            Line::new("node")
                .args(["--test", "--test-reporter=spec", SCRIPT_TESTS])
                .run()
        })?;
        // The core's tests have written the files.
        steps.step("Written models, read by others", || {
            Line::new("node")
                .args(["--test", "--test-reporter=spec", "tests/browser/exported.js"])
                .run()
        })?;
    }
    let (here, elsewhere): (Vec<BrowserRun>, Vec<BrowserRun>) =
        options.browsers.iter().partition(|run| run.browser.is_run_here());
    let tests = BrowserTests {
        page: &page,
        only: options.only.as_deref(),
        all_on_each: options.long || options.browser_alone,
        cases: if options.long { LONG_CASES } else { "1" },
        absent: &absent,
        second_tries: &second_tries,
    };
    browsers(&mut steps, &here, tests).inspect_err(|_| {
        // Why a test failed stands far above by now.
        eprint!("{}", second_tries::words(&second_tries.read().unwrap_or_default()));
    })?;
    if options.long {
        steps.step("The package on pages, built and not", package)?;
    }
    steps.summary();
    for run in elsewhere {
        eprintln!("Not looked at: the page in {run}, which is driven on Linux alone.");
    }
    eprint!("{}", absent::words(&absent.read()?));
    second_tries::judge(&second_tries.read()?)
}

/// The package with the element, as those have it who install it: in Chromium on both backends, and in Firefox.
fn package() -> Result<(), Failure> {
    let firefox = prerequisites::program(Browser::Firefox).unwrap_or_default();
    Line::new("xvfb-run")
        .args([
            "--auto-servernum",
            "--server-args=-screen 0 1280x1024x24",
            "node",
            "--test",
            "--test-force-exit",
        ])
        .args(["--test-reporter=spec", "tests/browser/npm.js"])
        .env("LIBGL_ALWAYS_SOFTWARE", "1")
        .env("PACKAGE", npm::package_for_tests())
        .env(
            "CHROMIUM",
            prerequisites::program(Browser::Chromium).unwrap_or_default(),
        )
        .env("FIREFOX", firefox)
        .run()
}

/// Draws the README's pictures, those of the manifest, and those beside three.js.
pub(crate) fn pictures() -> Result<(), Failure> {
    let mut steps = Steps::new();
    steps.step("What the pictures are drawn with", prerequisites::ensure)?;
    let run = RUNS[1];
    let site = site(&mut steps, Profile::Dev, &[run])?;
    let page = served(&mut steps, site)?;
    let draw = |tests| node(run, None, tests, &page).run();
    steps.step("The pictures", || draw("tests/browser/readme.js"))?;
    steps.step("What a system shows of the page", || draw("tests/browser/install.js"))?;
    steps.step("The same beside three.js", || draw("tests/browser/beside.js"))
}

/// Measures what is asked for, and prints it.
pub(crate) fn bench(options: &BenchOptions) -> Result<(), Failure> {
    let mut steps = Steps::new();
    if options.counts {
        counts(&mut steps)?;
    }
    if !options.browser {
        return Ok(());
    }
    steps.step("What the page is measured with", prerequisites::ensure)?;
    let profile = if options.dist { Profile::Dist } else { Profile::Release };
    let site = site(&mut steps, profile, &RUNS)?;
    let page = served(&mut steps, site)?;
    steps.step("The page in numbers", || {
        // Both backends in one run: the script starts itself for each.
        Line::new("node")
            .args(["tests/browser/bench.js"])
            .args(options.model.as_deref())
            .env("LIBGL_ALWAYS_SOFTWARE", "1")
            .env("PROGRAM", prerequisites::program(Browser::Chromium).unwrap_or_default())
            .env("PAGE", page)
            .run()
    })
}

/// Holds the instructions of the core's work against their limits.
fn counts(steps: &mut Steps) -> Result<(), Failure> {
    steps.step("What counts instructions", prerequisites::ensure_counter)?;
    steps.step("Instructions of the core's work", || {
        Line::cargo()
            .args(["run", "--profile", "dist", "--package", "counts"])
            .run()
    })
}

/// Builds the page for these runs.
fn site(steps: &mut Steps, profile: Profile, runs: &[BrowserRun]) -> Result<Site, Failure> {
    let mut programs = vec![("The wasm", Program::Full)];
    if profile == Profile::Dev {
        programs.push(("The wasm without egui", Program::Element));
    }
    if runs.iter().any(|run| run.backend == "webgpu") {
        programs.push(("The wasm for WebGPU alone", Program::WebGpu));
    }
    let mut built = Vec::new();
    for (name, program) in programs {
        built.push((program, steps.step(name, || wasm::build(profile, program))?));
    }
    if profile == Profile::Dev {
        steps.step("How large they are", || sizes::of_development(&built))?;
    }
    Ok(Site::new(built))
}

/// Serves the page and brings what drives the browsers. Gives its address.
fn served(steps: &mut Steps, site: Site) -> Result<String, Failure> {
    let page = format!("http://{}/", serve::start(serve::listen(0)?, site)?);
    steps.step("What drives the browsers", || {
        Line::new(prerequisites::NPM)
            .args(["ci", "--no-progress", "--prefix", BROWSER_TESTS])
            .run()
    })?;
    Ok(page)
}

/// What needs no browser.
fn native(steps: &mut Steps, absent: &List, long: bool) -> Result<(), Failure> {
    steps.step("Formatting", || Line::cargo().args(["fmt", "--all", "--check"]).run())?;
    // The library only: its tests bring egui and wgpu, which would be checked once more with other features.
    steps.step("Lints: the core alone", || clippy(&["--no-default-features", "--lib"]))?;
    steps.step("Lints: all that is native", || {
        clippy(&["--workspace", "--all-targets"])
    })?;
    for (name, program) in [
        ("Lints: the browser", Program::Full),
        ("Lints: the browser, without egui", Program::Element),
    ] {
        steps.step(name, || {
            clippy(&[
                "--lib",
                "--target",
                "wasm32-unknown-unknown",
                "--no-default-features",
                "--features",
                program.features(),
            ])
        })?;
    }
    let document = |what: &[&str]| {
        let line = Line::cargo().env("RUSTDOCFLAGS", "-D warnings");
        line.args(["doc", "--no-deps"]).args(what.iter().copied()).run()
    };
    steps.step("Documentation: the core alone", || {
        document(&["--package", "bindpose", "--no-default-features", "--lib"])
    })?;
    steps.step("Documentation", || document(&["--workspace"]))?;
    // The tests marked as needing a GPU run too: the software one is there by now.
    steps.step("Native tests", || {
        Line::cargo()
            .env(absent::VARIABLE, absent.path())
            .env(CASES, if long { LONG_CASES } else { "1" })
            .args([
                "test",
                "--package",
                "bindpose",
                "--package",
                "sample-figure",
                "--package",
                "fuzz",
            ])
            .args(["--", "--include-ignored"])
            .run()
    })?;
    // Apart from the others: together, cargo would build what binds the wasm a second time, with the features of both.
    steps.step("Tests of these commands", || {
        Line::cargo().args(["test", "--package", "xtask"]).run()
    })?;
    if long {
        steps.step("Fuzzing", || fuzz::run(&FuzzOptions::of_the_checks()))?;
        counts(steps)?;
    }
    Ok(())
}

fn clippy(what: &[&str]) -> Result<(), Failure> {
    Line::cargo()
        .args(["clippy"])
        .args(what.iter().copied())
        .args(["--", "-D", "warnings"])
        .run()
}

/// The line that runs a file of tests in a browser.
fn node(run: BrowserRun, only: Option<&str>, tests: &str, page: &str) -> Line {
    // A browser that does not end would keep node waiting for it.
    let node = ["--test", "--test-force-exit", "--test-reporter=spec"]
        .into_iter()
        .chain(only)
        .chain([tests]);
    let line = match run.browser {
        Browser::Chromium => Line::new("node").args(node),
        // These two draw in a window only.
        Browser::Firefox | Browser::Webkit => Line::new("xvfb-run")
            .args(["--auto-servernum", "--server-args=-screen 0 1280x1024x24", "node"])
            .args(node),
    };
    // GL is that of a GPU of software only when it is told so.
    line.env("LIBGL_ALWAYS_SOFTWARE", "1")
        .env("BROWSER", run.browser.name())
        .env("PROGRAM", prerequisites::program(run.browser).unwrap_or_default())
        .env("PAGE", page)
        .env("BACKEND", run.backend)
        .env("BUILDS", dist::builds_for_tests())
}

/// Drives the first browser, and meanwhile the others one after the other: a page that software draws waits for its frames more than it
/// keeps two cores busy. What the others print comes when the first has ended.
fn browsers(steps: &mut Steps, runs: &[BrowserRun], tests: BrowserTests<'_>) -> Result<(), Failure> {
    let Some((&first, others)) = runs.split_first() else {
        return Ok(());
    };
    let name = |run: BrowserRun| format!("The page in {run}");
    thread::scope(|scope| {
        let beside = scope.spawn(|| {
            let drive = |&run: &BrowserRun| {
                let (started, mut printed) = (Instant::now(), String::new());
                let outcome = drive(run, tests, |line| line.run_into(&mut printed));
                (run, outcome, started.elapsed(), printed)
            };
            others.iter().map(drive).collect::<Vec<_>>()
        });
        let mut outcome = steps.step(&name(first), || drive(first, tests, Line::run));
        for (run, of_run, elapsed, printed) in beside.join().expect("it does not panic") {
            steps.begin(&format!("{}, beside the first", name(run)));
            eprint!("{printed}");
            let of_run = steps.end(&name(run), elapsed, of_run);
            outcome = outcome.and(of_run);
        }
        outcome
    })
}

/// Runs the tests of a browser.
fn drive(
    run: BrowserRun,
    tests: BrowserTests<'_>,
    mut start: impl FnMut(Line) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let outcome = match start(browser(run, tests)) {
        // Chromium's tests are tried again one by one. The walk in the others is one piece, and a browser may fail in it that does not
        // the next time: WebKit's compiler was seen to give the program wrong numbers.
        Err(_) if run.browser != Browser::Chromium => {
            tests.second_tries.add(&format!("The page in {run}"))?;
            start(browser(run, tests))
        }
        outcome => outcome,
    };
    outcome.map_err(|failure| repeated_with_xtask(failure, run))
}

/// What every run of browser tests is told.
#[derive(Clone, Copy)]
struct BrowserTests<'a> {
    page: &'a str,
    only: Option<&'a str>,
    /// All tests, in place of a run's own.
    all_on_each: bool,
    /// How many times as often what is repeated is.
    cases: &'a str,
    absent: &'a List,
    second_tries: &'a List,
}

/// The line that runs a browser's tests.
fn browser(run: BrowserRun, wanted: BrowserTests<'_>) -> Line {
    let tests = match run.browser {
        Browser::Chromium => "tests/browser/all.js",
        Browser::Firefox | Browser::Webkit => "tests/browser/short.js",
    };
    let only = wanted.only.map(|pattern| format!("--test-name-pattern={pattern}"));
    let line = node(run, only.as_deref(), tests, wanted.page)
        .env(absent::VARIABLE, wanted.absent.path())
        .env(second_tries::VARIABLE, wanted.second_tries.path())
        .env(CASES, wanted.cases);
    line.env("TESTS", if wanted.all_on_each { "all" } else { run.tests })
}

/// The page that was served here ends with this program, so node alone could not repeat what failed.
fn repeated_with_xtask(failure: Failure, run: BrowserRun) -> Failure {
    match failure {
        Failure::Command { why, .. } => Failure::Command {
            shown: format!("cargo xtask test --browser {}", run.name()),
            why,
        },
        other => other,
    }
}

/// Names each step, times it and lists them at the end.
struct Steps {
    begun: Instant,
    done: Vec<(String, Duration)>,
}

impl Steps {
    fn new() -> Self {
        Self {
            begun: Instant::now(),
            done: Vec::new(),
        }
    }

    fn step<T>(&mut self, name: &str, work: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
        self.begin(name);
        let started = Instant::now();
        let outcome = work();
        self.end(name, started.elapsed(), outcome)
    }

    fn begin(&self, name: &str) {
        eprintln!("\n── {}. {name}", self.done.len() + 1);
    }

    fn end<T>(&mut self, name: &str, elapsed: Duration, outcome: Result<T, Failure>) -> Result<T, Failure> {
        let word = if outcome.is_ok() { "passed" } else { "FAILED" };
        eprintln!("── {word} in {:.1} s: {name}", elapsed.as_secs_f32());
        self.done.push((name.to_owned(), elapsed));
        outcome
    }

    fn summary(&self) {
        eprintln!("\nAll passed.");
        for (name, elapsed) in &self.done {
            eprintln!("{:8.1} s  {name}", elapsed.as_secs_f32());
        }
        eprintln!("{:8.1} s  in all", self.begun.elapsed().as_secs_f32());
    }
}
