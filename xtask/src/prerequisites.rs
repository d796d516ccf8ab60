//! What the checks need beside Rust: a software GPU, three browsers, a display for two of them, and Node.
//!
//! Where something is missing it is installed when that is possible (Debian and its kin, as root); otherwise the command
//! to run is named. Nothing is skipped.

use std::path::{Path, PathBuf};

use crate::browsers::Browser;
use crate::failure::Failure;
use crate::process::Line;

/// The oldest Node whose test runner takes what the browser tests use.
const NODE_MAJOR: u32 = 18;

/// How npm is started.
pub(crate) const NPM: &str = if cfg!(windows) { "npm.cmd" } else { "npm" };

/// The names that Chromium goes by.
const CHROMIUM_NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome-stable", "google-chrome"];

/// The names that Firefox goes by.
const FIREFOX_NAMES: [&str; 2] = ["firefox-esr", "firefox"];

/// WebKit's own small browser, which Debian keeps beside the library, in a folder for each version of its interface.
const MINI_BROWSERS: [&str; 4] = [
    "/usr/lib/x86_64-linux-gnu/webkitgtk-6.0/MiniBrowser",
    "/usr/lib/x86_64-linux-gnu/webkit2gtk-4.1/MiniBrowser",
    "/usr/lib/aarch64-linux-gnu/webkitgtk-6.0/MiniBrowser",
    "/usr/lib/aarch64-linux-gnu/webkit2gtk-4.1/MiniBrowser",
];

/// Where the Vulkan loader looks for drivers.
const VULKAN_DRIVERS: [&str; 3] = [
    "/usr/share/vulkan/icd.d",
    "/etc/vulkan/icd.d",
    "/usr/local/share/vulkan/icd.d",
];

/// Something the checks need.
struct Need {
    what: &'static str,
    packages: &'static [&'static str],
    is_there: fn() -> bool,
}

const NEEDS: [Need; 7] = [
    Need {
        what: "a software Vulkan and GL driver (Mesa llvmpipe)",
        packages: &["mesa-vulkan-drivers", "libgl1-mesa-dri", "libegl1", "libgles2"],
        is_there: has_software_gpu,
    },
    Need {
        what: "Chromium",
        packages: &["chromium", "fonts-dejavu-core"],
        is_there: || program(Browser::Chromium).is_some(),
    },
    Need {
        what: "Firefox",
        packages: &["firefox-esr"],
        is_there: || !Browser::Firefox.is_run_here() || program(Browser::Firefox).is_some(),
    },
    Need {
        what: "WebKit's MiniBrowser with WebKitWebDriver",
        packages: &["webkit2gtk-driver"],
        is_there: || {
            !Browser::Webkit.is_run_here() || program(Browser::Webkit).is_some() && on_path("WebKitWebDriver").is_some()
        },
    },
    Need {
        what: "a display without a screen (Xvfb)",
        packages: &["xvfb", "xauth"],
        is_there: || !cfg!(target_os = "linux") || on_path("xvfb-run").is_some() && on_path("xauth").is_some(),
    },
    Need {
        what: "Node 18 or newer",
        packages: &["nodejs"],
        is_there: has_node,
    },
    Need {
        what: "npm",
        packages: &["npm"],
        is_there: || Line::new(NPM).args(["--version"]).output().is_some(),
    },
];

/// What fuzzing needs.
const FUZZER_NEEDS: [Need; 1] = [Need {
    what: "a C++ compiler, for libFuzzer",
    packages: &["g++"],
    is_there: || on_path("c++").is_some(),
}];

/// What counting instructions needs.
const COUNTER_NEEDS: [Need; 1] = [Need {
    what: "valgrind, which counts instructions",
    packages: &["valgrind"],
    is_there: || on_path("valgrind").is_some(),
}];

/// Makes sure that everything is there that the checks need.
pub(crate) fn ensure() -> Result<(), Failure> {
    ensure_all(&NEEDS)
}

/// Makes sure that a fuzzer can be built.
pub(crate) fn ensure_fuzzer() -> Result<(), Failure> {
    ensure_all(&FUZZER_NEEDS)
}

/// Makes sure that instructions can be counted.
pub(crate) fn ensure_counter() -> Result<(), Failure> {
    ensure_all(&COUNTER_NEEDS)
}

fn ensure_all(needs: &[Need]) -> Result<(), Failure> {
    let missing: Vec<&Need> = needs.iter().filter(|need| !(need.is_there)()).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let whats = missing.iter().map(|need| need.what).collect::<Vec<_>>().join(", ");
    let packages: Vec<&str> = missing.iter().flat_map(|need| need.packages).copied().collect();
    eprintln!("  missing: {whats}");
    if can_install() {
        // The list of packages may be older than the archive; installing says so if it still does not fit.
        Line::new("apt-get").args(["update"]).run().ok();
        let install = ["install", "--yes", "--no-install-recommends"];
        Line::new("apt-get")
            .env("DEBIAN_FRONTEND", "noninteractive")
            .args(install)
            .args(packages.iter().copied())
            .run()?;
    }
    let still: Vec<&str> = missing
        .iter()
        .filter(|need| !(need.is_there)())
        .map(|need| need.what)
        .collect();
    if still.is_empty() {
        return Ok(());
    }
    Err(Failure::Remedy {
        what: format!("the checks need what this machine does not have: {}", still.join(", ")),
        remedy: remedy(&packages),
    })
}

/// The command that brings the packages, which are named as Debian names them.
fn remedy(packages: &[&str]) -> String {
    let packages = packages.join(" ");
    if cfg!(target_os = "macos") {
        "brew install node && brew install --cask chromium".to_owned()
    } else if cfg!(windows) {
        "winget install OpenJS.NodeJS.LTS && winget install Hibbiki.Chromium".to_owned()
    } else if on_path("apt-get").is_some() {
        format!("sudo apt-get update && sudo apt-get install --yes {packages}")
    } else {
        format!("(with this system's package manager; the names are Debian's) install {packages}")
    }
}

/// The program of a browser: what `CHROMIUM`, `FIREFOX` or `WEBKIT` names, else where it is found.
pub(crate) fn program(browser: Browser) -> Option<PathBuf> {
    if let Some(named) = std::env::var_os(browser.name().to_uppercase()) {
        return Some(PathBuf::from(named)).filter(|path| path.is_file());
    }
    let first_file = |paths: &[&str]| paths.iter().map(PathBuf::from).find(|path: &PathBuf| path.is_file());
    match browser {
        Browser::Chromium => CHROMIUM_NAMES
            .into_iter()
            .find_map(on_path)
            .or_else(|| first_file(&["/Applications/Chromium.app/Contents/MacOS/Chromium"])),
        Browser::Firefox => FIREFOX_NAMES.into_iter().find_map(on_path),
        Browser::Webkit => first_file(&MINI_BROWSERS),
    }
}

fn on_path(name: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path)
        .map(|dir| dir.join(name))
        .find(|program| program.is_file())
}

fn has_node() -> bool {
    let version = Line::new("node").args(["--version"]).output().unwrap_or_default();
    let major = version
        .trim()
        .trim_start_matches('v')
        .split('.')
        .next()
        .and_then(|major| major.parse().ok());
    major.is_some_and(|major: u32| major >= NODE_MAJOR)
}

/// Elsewhere than on Linux the system brings its own GPU.
fn has_software_gpu() -> bool {
    if !cfg!(target_os = "linux") {
        return true;
    }
    let is_llvmpipe = |path: PathBuf| {
        path.file_name()
            .is_some_and(|name| name.to_string_lossy().starts_with("lvp_icd"))
    };
    let vulkan = VULKAN_DRIVERS.iter().any(|dir| {
        Path::new(dir)
            .read_dir()
            .is_ok_and(|entries| entries.flatten().any(|entry| is_llvmpipe(entry.path())))
    });
    let libraries = Line::new("/sbin/ldconfig").args(["-p"]).output().unwrap_or_default();
    vulkan
        && ["libvulkan.so.1", "libEGL.so.1", "libGLESv2.so.2"]
            .iter()
            .all(|name| libraries.contains(name))
}

fn can_install() -> bool {
    let is_root = Line::new("id").args(["-u"]).output().is_some_and(|id| id.trim() == "0");
    is_root && on_path("apt-get").is_some()
}
