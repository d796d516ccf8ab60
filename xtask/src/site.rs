//! Which files make the site, what types they have and the policy they run under.
//!
//! The addresses are those of the repository: `index.html`, `web/…` and, out of the build folder, `pkg/…`. All
//! references are relative, so the site works under any path.

use std::fs;
use std::path::{Path, PathBuf};

use crate::failure::{Doing as _, Failure};

/// What the page may do. `index.html` carries the same words for hosts that cannot set headers.
pub(crate) const CONTENT_SECURITY_POLICY: &str = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; \
     style-src 'self'; img-src 'self' blob: data:; connect-src 'self' blob:; worker-src 'self' blob:; base-uri 'none'; \
     object-src 'none'; form-action 'none'";

/// Who may show the page in a frame. Only a header can say it.
pub(crate) const FRAME_ANCESTORS: &str = "frame-ancestors 'self'";

/// The address of the wasm.
const WASM: &str = "pkg/bindpose_bg.wasm";

/// The site as it lies on the disk.
#[derive(Clone, Debug)]
pub(crate) struct Site {
    root: PathBuf,
    pkg: PathBuf,
}

impl Site {
    /// The site of this repository with the bound wasm from `pkg`.
    pub(crate) fn new(pkg: PathBuf) -> Self {
        Self {
            root: crate::root(),
            pkg,
        }
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
            Some(("web", _)) => self.root.join(address),
            Some(("pkg", name)) => self.pkg.join(name),
            _ => return None,
        };
        path.is_file().then_some(path)
    }

    /// What is sent for an address: the file's bytes, with the size of the wasm written into the page.
    pub(crate) fn read(&self, address: &str, path: &Path) -> Result<Vec<u8>, Failure> {
        let bytes = fs::read(path).doing(format!("reading {}", path.display()))?;
        if !matches!(address, "" | "index.html") {
            return Ok(bytes);
        }
        let wasm = self.pkg.join(WASM.trim_start_matches("pkg/"));
        let length = fs::metadata(&wasm).doing(format!("reading {}", wasm.display()))?.len();
        let text = String::from_utf8_lossy(&bytes);
        // A compressed response does not say how long it will be, so the page is told.
        let page = text.replacen("data-bytes=\"0\"", &format!("data-bytes=\"{length}\""), 1);
        Ok(page.into_bytes())
    }

    /// Every address of the site, sorted.
    pub(crate) fn addresses(&self) -> Result<Vec<String>, Failure> {
        let mut addresses = vec!["index.html".to_owned()];
        for (prefix, dir) in [("web", self.root.join("web")), ("pkg", self.pkg.clone())] {
            list(prefix, &dir, &mut addresses)?;
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
        Site::new(crate::root().join("web"))
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
