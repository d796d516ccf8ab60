//! Which files make the site, what types they have and the policy they run under.
//!
//! The addresses are those of the repository: `index.html`, `web/…` and, out of the build folders, `pkg/…` for the full program, and folders in it
//! for the others; `examples/…` is served while one develops and is no part of it. All references are relative, so the site works under any path.

use std::fs;
use std::path::{Path, PathBuf};

use crate::failure::{Doing as _, Failure};
use crate::wasm::Program;

/// What the page may do. `index.html` carries the same words for hosts that cannot set headers.
pub(crate) const CONTENT_SECURITY_POLICY: &str = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; \
     style-src 'self'; img-src 'self' blob: data:; connect-src 'self' blob: https: http://localhost:* http://127.0.0.1:*; worker-src 'self' blob:; base-uri 'none'; \
     object-src 'none'; form-action 'none'";

/// Who may show the page in a frame: everyone, since people copy such frames from it. Only a header can say it.
pub(crate) const FRAME_ANCESTORS: &str = "frame-ancestors *";

/// The site as it lies on the disk.
#[derive(Clone, Debug)]
pub(crate) struct Site {
    root: PathBuf,
    /// Where each bound program is.
    programs: Vec<(Program, PathBuf)>,
}

impl Site {
    /// The site of this repository with bound programs and the folders that they are in. For one that draws on WebGPU alone the one that draws
    /// on both stands in.
    pub(crate) fn new(programs: impl Into<Vec<(Program, PathBuf)>>) -> Self {
        Self {
            root: crate::root(),
            programs: programs.into(),
        }
    }

    /// The folder of a program, or of what stands in for it.
    fn pkg(&self, program: Program) -> Option<&Path> {
        let of = |wanted| self.programs.iter().find(|(program, _)| *program == wanted);
        of(program)
            .or_else(|| of(program.on_both()))
            .map(|(_, pkg)| pkg.as_path())
    }

    /// The file behind an address (without the leading slash), or `None` when it is no file of the site.
    pub(crate) fn locate(&self, address: &str) -> Option<PathBuf> {
        let address = if address.is_empty() { "index.html" } else { address };
        let plain = |part: &str| {
            !part.is_empty() && !part.starts_with('.') && !part.contains(['\\', ':', '\0']) && part.len() <= 255
        };
        if !address.split('/').all(plain) {
            return None;
        }
        let path = match address.split_once('/') {
            None if address == "index.html" => self.root.join(address),
            Some(("web" | "examples", _)) => self.root.join(address),
            Some(("pkg", name)) => {
                let of = |program: Program| Some((program, name.strip_prefix(program.folder())?));
                let (program, name) = Program::ALL.into_iter().find_map(of)?;
                self.pkg(program)?.join(name)
            }
            _ => return None,
        };
        path.is_file().then_some(path)
    }

    /// What is sent for an address: the file's bytes, with the sizes of the programs written into the page.
    pub(crate) fn read(&self, address: &str, path: &Path) -> Result<Vec<u8>, Failure> {
        let bytes = fs::read(path).doing(format!("reading {}", path.display()))?;
        if !matches!(address, "" | "index.html") {
            return Ok(bytes);
        }
        let mut page = String::from_utf8_lossy(&bytes).into_owned();
        // A compressed response does not say how long it will be, so the page is told.
        for (name, program) in [("full", Program::Full), ("webgpu", Program::WebGpu)] {
            let Some(pkg) = self.pkg(program) else { continue };
            let wasm = pkg.join("bindpose_bg.wasm");
            let length = fs::metadata(&wasm).doing(format!("reading {}", wasm.display()))?.len();
            page = page.replacen(&format!("data-{name}=\"0\""), &format!("data-{name}=\"{length}\""), 1);
        }
        Ok(page.into_bytes())
    }

    /// Every address of the site, sorted.
    pub(crate) fn addresses(&self) -> Result<Vec<String>, Failure> {
        let mut addresses = vec!["index.html".to_owned()];
        list("web", &self.root.join("web"), &mut addresses)?;
        for program in Program::ALL {
            if let Some(pkg) = self.pkg(program) {
                let folder = format!("pkg/{}", program.folder());
                list(folder.trim_end_matches('/'), pkg, &mut addresses)?;
            }
        }
        addresses.sort();
        Ok(addresses)
    }
}

fn list(prefix: &str, dir: &Path, addresses: &mut Vec<String>) -> Result<(), Failure> {
    let reading = format!("reading {}", dir.display());
    for entry in fs::read_dir(dir).doing(&reading)? {
        let path = entry.doing(&reading)?.path();
        let Some(name) = path.file_name().and_then(|name| name.to_str()) else {
            continue;
        };
        let address = format!("{prefix}/{name}");
        if path.is_dir() {
            list(&address, &path, addresses)?;
        } else if !name.starts_with('.') {
            addresses.push(address);
        }
    }
    Ok(())
}

/// The media type that belongs to a file's name.
pub(crate) fn media_type(address: &str) -> &'static str {
    match address.rsplit_once('.').map_or("html", |(_, extension)| extension) {
        "html" => "text/html; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "json" => "application/json",
        "webmanifest" => "application/manifest+json",
        "wasm" => "application/wasm",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "jpg" | "jpeg" => "image/jpeg",
        "m3d" | "txt" => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn site() -> Site {
        // No wasm is needed to look at the page, so any folder will do for it.
        Site::new([(Program::Full, crate::root().join("web"))])
    }

    #[test]
    fn each_program_has_its_folder_and_the_page_is_told_both_sizes() {
        let dir = crate::target_dir().join("tmp/site-of-two-programs");
        let pkgs = ["full", "webgpu"].map(|name| dir.join(name));
        for (pkg, bytes) in pkgs.iter().zip(["four", "one"]) {
            fs::create_dir_all(pkg).expect("a folder");
            fs::write(pkg.join("bindpose_bg.wasm"), bytes).expect("a file");
        }
        let [full, web_gpu] = pkgs;
        let both = Site::new([(Program::Full, full.clone()), (Program::WebGpu, web_gpu.clone())]);
        let wasm = |folder: &str| format!("pkg/{folder}bindpose_bg.wasm");
        let located = |site: &Site, folder| site.locate(&wasm(folder)).expect("it is there");
        assert_eq!(located(&both, ""), full.join("bindpose_bg.wasm"));
        assert_eq!(located(&both, "webgpu/"), web_gpu.join("bindpose_bg.wasm"));
        let addresses = both.addresses().expect("the site lists");
        for folder in ["", "webgpu/"] {
            assert_eq!(addresses.iter().filter(|address| **address == wasm(folder)).count(), 1);
        }
        let index = both.locate("").expect("index.html");
        let page = String::from_utf8(both.read("", &index).expect("it reads")).expect("text");
        assert!(page.contains(r#" data-full="4" data-webgpu="3""#), "{page}");
        let one = Site::new([(Program::Full, full.clone())]);
        assert_eq!(
            located(&one, "webgpu/"),
            full.join("bindpose_bg.wasm"),
            "the full one stands in"
        );
        assert_eq!(
            one.locate(&wasm("element/")),
            None,
            "but not for a program of another kind"
        );
    }

    #[test]
    fn only_files_of_the_site_are_found() {
        assert!(site().locate("").is_some_and(|path| path.ends_with("index.html")));
        assert!(site().locate("web/boot.js").is_some());
        for outside in [
            "Cargo.toml",
            "src/lib.rs",
            "web/../Cargo.toml",
            "web/..\\Cargo.toml",
            "web//boot.js",
            "web/",
            "/etc/passwd",
            "web/.hidden",
            "pkg/../../../etc/passwd",
            "web/absent.js",
        ] {
            assert_eq!(site().locate(outside), None, "{outside}");
        }
    }

    #[test]
    fn the_page_carries_the_same_policy_as_the_header() {
        let page = fs::read_to_string(crate::root().join("index.html")).expect("index.html");
        assert!(
            page.contains(&format!("content=\"{CONTENT_SECURITY_POLICY}\"")),
            "{CONTENT_SECURITY_POLICY}"
        );
    }

    /// The policy forbids them, so they would be dead on the page.
    #[test]
    fn the_page_has_no_inline_script_or_style() {
        let page = fs::read_to_string(crate::root().join("index.html")).expect("index.html");
        for (at, _) in page.match_indices('<') {
            let tag = page[at..].split_once('>').map_or("", |(tag, _)| tag);
            let handler = tag
                .split_whitespace()
                .any(|word| word.starts_with("on") && word.contains('='));
            assert!(
                !handler && !tag.contains("style=") && !tag.starts_with("<style"),
                "{tag}"
            );
            assert!(!tag.starts_with("<script") || tag.contains("src="), "{tag}");
        }
    }
}
