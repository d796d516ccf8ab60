//! `cargo xtask test`: every check, in order, stopping at the first failure.

use std::time::{Duration, Instant};

use crate::args::TestOptions;
use crate::failure::Failure;
use crate::prerequisites;
use crate::process::Line;
use crate::serve;
use crate::site::Site;
use crate::wasm::{self, Profile};

/// The package with the browser tests.
const BROWSER_TESTS: &str = "tests/browser";

/// Runs all of them, or those in the browser alone.
pub(crate) fn run(options: &TestOptions) -> Result<(), Failure> {
    let mut steps = Steps::default();
    steps.step("What the tests draw with", prerequisites::ensure)?;
    steps.step("The wasm target", wasm::ensure_target)?;
    if !options.browser_alone {
        native(&mut steps)?;
    }
    let pkg = steps.step("The wasm", || wasm::build(Profile::Dev))?;
    let page = format!("http://{}/", serve::start(serve::listen(0)?, Site::new(pkg))?);
    steps.step("What drives the browser", || {
        Line::new(prerequisites::NPM)
            .args(["ci", "--no-progress", "--prefix", BROWSER_TESTS])
            .run()
    })?;
    for backend in &options.backends {
        steps.step(&format!("The page in Chromium on {backend}"), || {
            browser(backend, &page)
        })?;
    }
    steps.summary();
    Ok(())
}

/// What needs no browser.
fn native(steps: &mut Steps) -> Result<(), Failure> {
    steps.step("Formatting", || Line::cargo().args(["fmt", "--all", "--check"]).run())?;
    steps.step("Lints: the core alone", || {
        clippy(&["--no-default-features", "--all-targets"])
    })?;
    steps.step("Lints: all that is native", || {
        clippy(&["--workspace", "--all-targets", "--features", "viewer,cli"])
    })?;
    steps.step("Lints: the browser", || {
        clippy(&[
            "--lib",
            "--target",
            "wasm32-unknown-unknown",
            "--no-default-features",
            "--features",
            "viewer",
        ])
    })?;
    steps.step("Documentation", || {
        Line::cargo()
            .env("RUSTDOCFLAGS", "-D warnings")
            .args(["doc", "--workspace", "--no-deps"])
            .run()
    })?;
    // The tests marked as needing a GPU run too: the software one is there by now.
    steps.step("Native tests", || {
        Line::cargo()
            .args([
                "test",
                "--workspace",
                "--features",
                "viewer,cli",
                "--",
                "--include-ignored",
            ])
            .run()
    })
}

fn clippy(what: &[&str]) -> Result<(), Failure> {
    Line::cargo()
        .args(["clippy"])
        .args(what.iter().copied())
        .args(["--", "-D", "warnings"])
        .run()
}

fn browser(backend: &str, page: &str) -> Result<(), Failure> {
    let outcome = Line::new("node")
        .env("CHROMIUM", prerequisites::chromium().unwrap_or_default())
        .env("PAGE", page)
        .env("BACKEND", backend)
        .args(["--test", "--test-reporter=spec", "tests/browser/all.js"])
        .run();
    outcome.map_err(|failure| match failure {
        // The page that was served here ends with this program, so node alone could not repeat it.
        Failure::Command { why, .. } => Failure::Command {
            shown: format!("cargo xtask test --browser {backend}"),
            why,
        },
        other => other,
    })
}

/// Names each step, times it and lists them at the end.
#[derive(Default)]
struct Steps {
    done: Vec<(String, Duration)>,
}

impl Steps {
    fn step<T>(&mut self, name: &str, work: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
        eprintln!("\n── {}. {name}", self.done.len() + 1);
        let started = Instant::now();
        let outcome = work();
        let elapsed = started.elapsed();
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
        let total: Duration = self.done.iter().map(|(_, elapsed)| elapsed).sum();
        eprintln!("{:8.1} s  in all", total.as_secs_f32());
    }
}
