//! The library built for the browser and bound to JavaScript, as several programs: `bindpose.js` and `bindpose_bg.wasm` of each.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use wasm_bindgen_cli_support::Bindgen;

use crate::failure::{Doing as _, Failure};
use crate::process::Line;

/// The compiler's name of the browser.
pub(crate) const TARGET: &str = "wasm32-unknown-unknown";

/// Where the built library goes, by how hard the compiler works on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Profile {
    Dev,
    Release,
    Dist,
}

impl Profile {
    /// Cargo's name of the profile.
    fn name(self) -> &'static str {
        match self {
            Self::Dev => "dev",
            Self::Release => "release",
            Self::Dist => "dist",
        }
    }

    /// Cargo's name of the folder it builds into.
    fn folder(self) -> &'static str {
        match self {
            Self::Dev => "debug",
            Self::Release => "release",
            Self::Dist => "dist",
        }
    }
}

/// What the library is built into. A page chooses one before it fetches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Program {
    /// Draws on WebGPU and on WebGL2.
    Full,
    /// Draws on WebGPU alone, and is smaller.
    WebGpu,
    /// Without the interface, for other people's pages; on both.
    Element,
    /// The same on WebGPU alone.
    ElementWebGpu,
}

impl Program {
    /// One in a folder of another comes before it.
    pub(crate) const ALL: [Self; 4] = [Self::ElementWebGpu, Self::Element, Self::WebGpu, Self::Full];

    /// The program that does all that this one does, on both backends.
    pub(crate) fn on_both(self) -> Self {
        match self {
            Self::Full | Self::WebGpu => Self::Full,
            Self::Element | Self::ElementWebGpu => Self::Element,
        }
    }

    /// Where it is below `pkg/`, with a slash at the end, and below the folder that cargo builds into: a folder of its own, since programs of one name
    /// would be linked anew in turns.
    pub(crate) fn folder(self) -> &'static str {
        match self {
            Self::Full => "",
            Self::WebGpu => "webgpu/",
            Self::Element => "element/",
            Self::ElementWebGpu => "element/webgpu/",
        }
    }

    pub(crate) fn features(self) -> &'static str {
        match self {
            Self::Full => "viewer,webgl",
            Self::WebGpu => "viewer",
            Self::Element => "element,webgl",
            Self::ElementWebGpu => "element",
        }
    }
}

/// The arguments that build a program.
pub(crate) fn build_args(profile: Profile, program: Program) -> Vec<&'static str> {
    // Natively nobody needs the library in this shape, so the manifest does not ask for it.
    let mut args = vec![
        "rustc",
        "--lib",
        "--crate-type",
        "cdylib",
        "--target",
        TARGET,
        "--no-default-features",
        "--features",
        program.features(),
    ];
    args.extend(["--profile", profile.name()]);
    args
}

/// Builds and binds a program. Gives the folder with `bindpose.js` and `bindpose_bg.wasm`.
pub(crate) fn build(profile: Profile, program: Program) -> Result<PathBuf, Failure> {
    ensure_target()?;
    let target = crate::target_dir().join(program.folder());
    Line::cargo()
        .env("CARGO_TARGET_DIR", &target)
        .args(build_args(profile, program))
        .run()?;
    let wasm = target.join(TARGET).join(profile.folder()).join("bindpose.wasm");
    let pkg = target.join("site").join(profile.folder()).join("pkg");
    if !is_newer(&pkg.join("bindpose_bg.wasm"), &wasm) {
        bind(&wasm, &pkg, profile)?;
    }
    Ok(pkg)
}

/// Adds the wasm target to the toolchain when it is not there.
pub(crate) fn ensure_target() -> Result<(), Failure> {
    if Line::new("rustc")
        .args(["--target", TARGET, "--print", "target-libdir"])
        .output()
        .is_some_and(|libdir| {
            // rustc names the folder whether it is there or not.
            Path::new(libdir.trim()).is_dir()
        })
    {
        return Ok(());
    }
    Line::new("rustup")
        .args(["target", "add", TARGET])
        .run()
        .map_err(|_| Failure::Remedy {
            what: format!("the Rust target {TARGET} is not installed, and rustup could not add it"),
            remedy: format!("rustup target add {TARGET}"),
        })
}

fn bind(wasm: &Path, pkg: &Path, profile: Profile) -> Result<(), Failure> {
    let started = Instant::now();
    // Into a folder beside it first: a page that is being served never sees half of the new and half of the old.
    let fresh = pkg.with_extension("new");
    remove_dir(&fresh)?;
    fs::create_dir_all(&fresh).doing(format!("making {}", fresh.display()))?;
    let shipped = profile == Profile::Dist;
    Bindgen::new()
        .input_path(wasm)
        .out_name("bindpose")
        .web(true)
        .and_then(|bindgen| {
            bindgen
                .typescript(false)
                // The page names the wasm itself (it shows the download's progress), so the script need not.
                .omit_default_module_path(true)
                .keep_debug(false)
                .remove_name_section(shipped)
                .remove_producers_section(shipped)
                .generate(&fresh)
        })
        .map_err(|error| Failure::Bind(format!("{error:#}")))?;
    remove_dir(pkg)?;
    fs::rename(&fresh, pkg).doing(format!("moving {} to {}", fresh.display(), pkg.display()))?;
    eprintln!("  bound to JavaScript in {:.1} s", started.elapsed().as_secs_f32());
    Ok(())
}

fn remove_dir(dir: &Path) -> Result<(), Failure> {
    if dir.exists() {
        fs::remove_dir_all(dir).doing(format!("removing {}", dir.display()))
    } else {
        Ok(())
    }
}

/// Whether `made` is there and was written after `from`.
fn is_newer(made: &Path, from: &Path) -> bool {
    let modified = |path: &Path| fs::metadata(path).and_then(|metadata| metadata.modified()).ok();
    match (modified(made), modified(from)) {
        (Some(made), Some(from)) => made > from,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_programs_are_built_with_and_without_webgl_and_into_different_folders() {
        let features = |program| {
            let args = build_args(Profile::Dist, program);
            let at = args.iter().position(|arg| *arg == "--features").expect("features");
            assert!(
                args.contains(&"--no-default-features") && args.ends_with(&["--profile", "dist"]),
                "{args:?}"
            );
            args[at + 1].split(',').collect::<Vec<_>>()
        };
        for program in Program::ALL {
            let both = features(program.on_both());
            assert_eq!(both[1..], ["webgl"]);
            let alone = if program == program.on_both() {
                &both[..]
            } else {
                &both[..1]
            };
            assert_eq!(features(program), alone);
        }
        assert_eq!(features(Program::Full)[0], "viewer");
        assert_eq!(features(Program::Element)[0], "element");
        let folders: std::collections::BTreeSet<_> = Program::ALL.map(Program::folder).into();
        assert_eq!(folders.len(), Program::ALL.len());
    }
}
