//! The project's own commands, run as `cargo xtask serve | test | pictures | dist | licenses | bench | fuzz`.
//!
//! Each does all of its set-up itself, so that a fresh machine with rustup needs nothing else: the wasm target is added,
//! wasm-bindgen is a library here rather than a tool to install, and what the tests draw with is installed or named.
//!
//! | module | does |
//! |---|---|
//! | [`args`] | the command line |
//! | [`wasm`] | build the library for the browser and bind it, as four programs: `pkg/`, `pkg/element/`, and of each one for WebGPU alone |
//! | [`site`] | which files make the site, their types, the policy they run under |
//! | [`serve`] | the site over HTTP on this machine alone |
//! | [`http`] | as much of the protocol as that takes |
//! | [`check`] | every check, in order, and what is measured |
//! | [`browsers`] | which browsers the page is tested in, and what they draw with |
//! | [`prerequisites`] | what the checks need beside Rust |
//! | [`list`] | what tests tell the checks |
//! | [`absent`] | which real files the tests could not look at |
//! | [`second_tries`] | which browser tests had to be tried again |
//! | [`dist`] | the static site: hashed names, compressed twice |
//! | [`npm`] | the package with the element |
//! | [`packages`] | which packages a program is made of |
//! | [`licenses`] | what they are passed on under: `licenses.txt` |
//! | `published`, for tests | what the library's package holds |
//! | [`worker`] | what keeps that site for visits without a network |
//! | [`headers`] | what its host is to say of each file |
//! | [`sizes`] | the most bytes that files of the site may have: `xtask/sizes.txt` |
//! | [`fuzz`] | files that a fuzzer makes up, read and written |

mod absent;
mod args;
mod browsers;
mod check;
mod compress;
mod dist;
mod failure;
mod fuzz;
mod headers;
mod http;
mod licenses;
mod list;
mod npm;
mod packages;
mod prerequisites;
mod process;
#[cfg(test)]
mod published;
mod scripts;
mod second_tries;
mod serve;
mod site;
mod sizes;
mod wasm;
mod watch;
mod worker;

use std::path::PathBuf;
use std::process::ExitCode;

use args::Task;
use failure::Failure;

fn main() -> ExitCode {
    let outcome = args::parse(std::env::args().skip(1)).and_then(|task| match task {
        Task::Help => {
            print!("{}", args::HELP);
            Ok(())
        }
        Task::Serve(options) => serve::run(&options),
        Task::Test(options) => check::run(&options),
        Task::Pictures => check::pictures(),
        Task::Dist => dist::run(),
        Task::DistNpm => dist::run_npm(),
        Task::Licenses(target) => licenses::print(&target),
        Task::Bench(options) => check::bench(&options),
        Task::Fuzz(options) => fuzz::run(&options),
    });
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("\nxtask: {failure}");
            // 2 for wrong use, as the tools around it do.
            ExitCode::from(if matches!(failure, Failure::Usage(_)) { 2 } else { 1 })
        }
    }
}

/// The repository: the folder above this package.
fn root() -> PathBuf {
    let package = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    package.parent().map_or(package.clone(), PathBuf::from)
}

/// Where cargo builds. Every cargo that is started here is told this folder, so that all of them agree.
fn target_dir() -> PathBuf {
    match std::env::var_os("CARGO_TARGET_DIR") {
        Some(dir) => root().join(dir),
        None => root().join("target"),
    }
}
