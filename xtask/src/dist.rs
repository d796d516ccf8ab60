//! `cargo xtask dist`: the site as static files that a host may keep for ever.
//!
//! Each file has a part of its content's hash in its name, and every reference to it is rewritten. A file is named after those it refers to, so a
//! change below changes the names above it. Pages, the element for other pages, the licences, the manifest and the worker keep their
//! names.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::compress::{Coding, Effort};
use crate::failure::{Doing as _, Failure};
use crate::headers;
use crate::licenses;
use crate::npm;
use crate::scripts;
use crate::site::Site;
use crate::sizes::{self, Size};
use crate::wasm::{self, Profile, Program};
use crate::worker;

/// The viewer's page. Others lead back to it, so it comes last; pages keep their names, and so do the licences.
pub(crate) const PAGE: &str = "index.html";

/// What other people's pages name.
pub(crate) const ELEMENT: &str = "web/element/bindpose-viewer.js";

/// Files that are text and may refer to others.
const REFERRING: [&str; 4] = [".html", ".js", ".css", ".webmanifest"];

/// `dist --npm`: the package in `dist-npm/`.
pub(crate) fn run_npm() -> Result<(), Failure> {
    let folder = crate::root().join("dist-npm");
    npm::write(&built()?, &licenses::of_the_page()?, &folder)?;
    println!("{} is there: `npm publish` or `npm pack` takes it.", folder.display());
    Ok(())
}

/// The site with all programs as they are shipped.
fn built() -> Result<Site, Failure> {
    let built = |program| Ok((program, wasm::build(Profile::Dist, program)?));
    let programs: Result<Vec<_>, Failure> = Program::ALL.into_iter().map(built).collect();
    Ok(Site::new(programs?))
}

/// Builds `dist/`, and fails where a file is larger than it may be: then `dist/` is there all the same, to be looked at.
pub(crate) fn run() -> Result<(), Failure> {
    let files = made(sources(&built()?)?, licenses::of_the_page()?)?;
    let dist = crate::root().join("dist");
    if dist.exists() {
        fs::remove_dir_all(&dist).doing("removing dist/")?;
    }
    println!("{:>10} {:>10} {:>10}  dist/", "raw", "gzip", "brotli");
    let (mut totals, mut made) = ([0; 3], Vec::new());
    for (name, bytes) in &files {
        let sizes = write(&dist, name, bytes)?;
        println!(
            "{:>10} {:>10} {:>10}  {name}",
            grouped(sizes[0]),
            grouped(sizes[1]),
            grouped(sizes[2])
        );
        for (total, size) in totals.iter_mut().zip(sizes) {
            *total += size;
        }
        made.push(Size::new(name, sizes[0], sizes[2]));
    }
    println!(
        "{:>10} {:>10} {:>10}  in all",
        grouped(totals[0]),
        grouped(totals[1]),
        grouped(totals[2])
    );
    write_file(&dist, headers::NAME, headers::made(&files).as_bytes())?;
    println!("\n{}", headers::ADVICE);
    sizes::compare(Profile::Dist, &made)
}

/// Where [`write_for_tests`] writes.
pub(crate) fn builds_for_tests() -> PathBuf {
    crate::target_dir().join("tmp/builds")
}

/// Writes two builds of a site as hosts have them, `one` and `two`, which differ in a script and in the sample.
pub(crate) fn write_for_tests(site: &Site) -> Result<(), Failure> {
    let folder = builds_for_tests();
    if folder.exists() {
        fs::remove_dir_all(&folder).doing(format!("removing {}", folder.display()))?;
    }
    for build in ["one", "two"] {
        let mut sources = sources(site)?;
        for (address, more) in [("web/fault.js", ";\n"), ("web/sample/figure.m3d", "\n")] {
            let file = sources.get_mut(address).filter(|_| build == "two");
            file.into_iter()
                .for_each(|bytes| bytes.extend_from_slice(more.as_bytes()));
        }
        let licenses = "As in dist/, though not all of them.\n".to_owned();
        for (name, bytes) in made(sources, licenses)? {
            write_file(&folder.join(build), &name, &bytes)?;
        }
    }
    Ok(())
}

/// The files of a site by their addresses.
pub(crate) fn sources(site: &Site) -> Result<BTreeMap<String, Vec<u8>>, Failure> {
    let mut sources = BTreeMap::new();
    for address in site.addresses()? {
        if let Some(path) = site.locate(&address) {
            let bytes = site.read(&address, &path)?;
            sources.insert(address, bytes);
        }
    }
    Ok(sources)
}

/// The same as a host gets them: scripts without comments, with the licences of what is in them, under hashed names, with the worker that keeps them.
fn made(mut sources: BTreeMap<String, Vec<u8>>, licenses: String) -> Result<BTreeMap<String, Vec<u8>>, Failure> {
    sources.insert(licenses::NAME.to_owned(), licenses.into_bytes());
    for (_, script) in sources.iter_mut().filter(|(address, _)| address.ends_with(".js")) {
        *script = scripts::without_comments(&String::from_utf8_lossy(script)).into_bytes();
    }
    let template = sources.remove(worker::TEMPLATE).unwrap_or_default();
    let mut files = hashed(&sources)?;
    worker::join(&mut files, &String::from_utf8_lossy(&template))?;
    Ok(files)
}

pub(crate) fn write_file(dir: &Path, name: &str, bytes: &[u8]) -> Result<PathBuf, Failure> {
    let path = dir.join(name);
    if let Some(dir) = path.parent() {
        fs::create_dir_all(dir).doing(format!("making {}", dir.display()))?;
    }
    fs::write(&path, bytes).doing(format!("writing {}", path.display()))?;
    Ok(path)
}

/// Writes a file and its compressed twins; gives the three sizes.
fn write(dist: &Path, name: &str, bytes: &[u8]) -> Result<[usize; 3], Failure> {
    let twins = [
        (".gz", Coding::Gzip.encode(bytes, Effort::Best)),
        (".br", Coding::Brotli.encode(bytes, Effort::Best)),
    ];
    write_file(dist, name, bytes)?;
    for (suffix, twin) in &twins {
        write_file(dist, &format!("{name}{suffix}"), twin)?;
    }
    Ok([bytes.len(), twins[0].1.len(), twins[1].1.len()])
}

/// The files under their hashed names, with the references in them rewritten.
fn hashed(sources: &BTreeMap<String, Vec<u8>>) -> Result<BTreeMap<String, Vec<u8>>, Failure> {
    let mut naming = Naming {
        sources,
        names: BTreeMap::new(),
        open: Vec::new(),
        files: BTreeMap::new(),
    };
    for address in sources.keys() {
        naming.name(address)?;
    }
    Ok(naming.files)
}

/// The work of [`hashed`]: depth first, so that what a file refers to has its name before the file has.
struct Naming<'a> {
    sources: &'a BTreeMap<String, Vec<u8>>,
    /// Hashed name by address.
    names: BTreeMap<String, String>,
    /// The addresses that are being named, outermost first.
    open: Vec<String>,
    files: BTreeMap<String, Vec<u8>>,
}

impl Naming<'_> {
    fn name(&mut self, address: &str) -> Result<String, Failure> {
        if let Some(name) = self.names.get(address) {
            return Ok(name.clone());
        }
        if self.open.iter().any(|open| open == address) {
            let circle = self.open.join(" -> ");
            return Err(Failure::Site(format!(
                "these files refer to each other in a circle: {circle} -> {address}"
            )));
        }
        self.open.push(address.to_owned());
        let bytes = self.rewritten(address)?;
        self.open.pop();
        let name = match (address, address.rsplit_once('.')) {
            (ELEMENT | licenses::NAME, _) | (_, None | Some((_, "html" | "webmanifest"))) => address.to_owned(),
            (_, Some((stem, extension))) => format!("{stem}.{:016x}.{extension}", fnv1a(&bytes)),
        };
        self.names.insert(address.to_owned(), name.clone());
        self.files.insert(name.clone(), bytes);
        Ok(name)
    }

    /// The file with every quoted relative address of another file replaced.
    fn rewritten(&mut self, address: &str) -> Result<Vec<u8>, Failure> {
        let sources = self.sources;
        let bytes = sources.get(address).map(Vec::as_slice).unwrap_or_default();
        if !refers(address) {
            return Ok(bytes.to_vec());
        }
        let text =
            std::str::from_utf8(bytes).map_err(|error| Failure::Site(format!("{address} is not UTF-8: {error}")))?;
        let folder = address.rsplit_once('/').map_or("", |(folder, _)| folder);
        let mut out = String::with_capacity(text.len());
        for part in text.split_inclusive(['"', '\'']) {
            let (part, quote) = part.split_at(part.trim_end_matches(['"', '\'']).len());
            let target = resolved(folder, part).filter(|target| sources.contains_key(target) && target != PAGE);
            match target {
                None => out.push_str(part),
                Some(target) => {
                    let name = self.name(&target)?;
                    let file = name.rsplit_once('/').map_or(name.as_str(), |(_, file)| file);
                    let above = part
                        .rsplit_once('/')
                        .map_or(String::new(), |(above, _)| format!("{above}/"));
                    out.push_str(&above);
                    out.push_str(file);
                }
            }
            out.push_str(quote);
        }
        Ok(out.into_bytes())
    }
}

/// Whether a file may refer to others.
pub(crate) fn refers(address: &str) -> bool {
    REFERRING.iter().any(|extension| address.ends_with(extension))
}

/// The address that a relative reference in `folder` means, or `None` when it cannot be one.
pub(crate) fn resolved(folder: &str, reference: &str) -> Option<String> {
    if reference.is_empty() || reference.len() > 255 || reference.contains([' ', '\n', ':']) {
        return None;
    }
    let mut parts: Vec<&str> = folder.split('/').filter(|part| !part.is_empty()).collect();
    for part in reference.split('/') {
        match part {
            "." => {}
            ".." => {
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

/// FNV-1a, 64 bits: enough to tell versions of one file apart. It guards against nothing else.
pub(crate) fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// The number with its thousands grouped.
pub(crate) fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut out = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            out.push(' ');
        }
        out.push(digit);
    }
    out
}

/// The files of the real page, with others in place of those that are not built in a test.
#[cfg(test)]
pub(crate) fn page() -> BTreeMap<String, Vec<u8>> {
    let built = [
        ("pkg/bindpose.js", b"1".to_vec()),
        ("pkg/bindpose_bg.wasm", b"2".to_vec()),
        ("pkg/webgpu/bindpose.js", b"3".to_vec()),
        ("pkg/webgpu/bindpose_bg.wasm", b"4".to_vec()),
        ("pkg/element/bindpose.js", b"7".to_vec()),
        ("pkg/element/webgpu/bindpose.js", b"8".to_vec()),
        ("pkg/element/bindpose_bg.wasm", b"5".to_vec()),
        ("pkg/element/webgpu/bindpose_bg.wasm", b"6".to_vec()),
    ];
    let mut files = BTreeMap::from(built.map(|(address, bytes)| (address.to_owned(), bytes)));
    // The folder of what is built: any other will do.
    let site = Site::new([(Program::Full, crate::root().join("web"))]);
    for address in site.addresses().expect("the site lists") {
        if let Some(path) = site.locate(&address).filter(|_| !address.starts_with("pkg/")) {
            files.insert(address, fs::read(path).expect("a listed file"));
        }
    }
    files
}

/// The same under the names that `dist` gives them.
#[cfg(test)]
pub(crate) fn of_the_page() -> BTreeMap<String, Vec<u8>> {
    let licenses = licenses::of_the_page().expect("cargo resolves the page");
    made(page(), licenses).expect("no circle")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sources(files: &[(&str, &str)]) -> BTreeMap<String, Vec<u8>> {
        files
            .iter()
            .map(|(address, text)| ((*address).to_owned(), text.as_bytes().to_vec()))
            .collect()
    }

    fn text_of<'a>(files: &'a BTreeMap<String, Vec<u8>>, start: &str) -> (&'a str, &'a str) {
        let (name, bytes) = files
            .iter()
            .find(|(name, _)| name.starts_with(start))
            .expect("the file is there");
        (name, std::str::from_utf8(bytes).expect("text"))
    }

    #[test]
    fn references_follow_the_names_and_a_change_below_renames_what_is_above() {
        let page = r#"<script src="web/boot.js"></script><p title="boot.js">"#;
        let boot = r#"import init from "../pkg/a.js"; fetch(new URL('sample/f.m3d', import.meta.url)); say("nothing.js", "isn't");"#;
        let build = |model: &str| {
            hashed(&sources(&[
                ("index.html", page),
                ("web/boot.js", boot),
                ("web/sample/f.m3d", model),
                ("pkg/a.js", "1"),
            ]))
            .expect("no circle")
        };
        let (one, two) = (build("model"), build("another"));
        let (boot_name, boot_text) = text_of(&one, "web/boot.");
        let model_name = text_of(&one, "web/sample/").0.trim_start_matches("web/");
        let script_name = text_of(&one, "pkg/a.").0;
        assert!(boot_text.contains(&format!("\"../{script_name}\"")), "{boot_text}");
        assert!(boot_text.contains(&format!("'{model_name}'")), "{boot_text}");
        assert!(boot_text.contains("\"nothing.js\""), "{boot_text}");
        assert_eq!(
            one["index.html"],
            format!(r#"<script src="{boot_name}"></script><p title="boot.js">"#).into_bytes()
        );
        assert_ne!(text_of(&two, "web/boot.").0, boot_name);
        assert_eq!(text_of(&two, "pkg/a.").0, script_name);
    }

    #[test]
    fn no_file_of_the_real_page_refers_to_a_name_that_is_gone() {
        let (files, built) = (page(), of_the_page());
        assert_eq!(built.len(), files.len() + 1);
        let (name, text) = text_of(&built, "licenses.");
        assert_eq!(name, licenses::NAME, "who looks for them finds them");
        assert!(text.contains("\negui 0.") && text.contains("SIL OPEN FONT LICENSE"));
        let choice = text_of(&built, "web/program.").1;
        for folder in ["pkg/bindpose", "pkg/webgpu/bindpose"] {
            for end in [".", "_bg."] {
                let name = text_of(&built, &format!("{folder}{end}")).0;
                assert!(choice.contains(&format!("\"../{name}\"")), "{name} in {choice}");
            }
        }
        for (name, bytes) in built
            .iter()
            .filter(|(name, _)| REFERRING.iter().any(|end| name.ends_with(end)))
        {
            let text = std::str::from_utf8(bytes).expect("text");
            for gone in files.keys().filter(|address| !built.contains_key(*address)) {
                let (folder, file) = gone.rsplit_once('/').unwrap_or(("", gone));
                assert!(!text.contains(&format!("/{file}\"")), "{name} still refers to {gone}");
                // A bare name is a reference only to a neighbour; elsewhere it is a name to show.
                let is_neighbour = name.rsplit_once('/').map_or("", |(folder, _)| folder) == folder;
                let bare = text.contains(&format!("\"{file}\""));
                assert!(!(is_neighbour && bare), "{name} still refers to {gone}");
            }
        }
    }

    #[test]
    fn a_circle_of_references_is_named() {
        let circle = sources(&[("web/a.js", r#"import "./b.js""#), ("web/b.js", r#"import "./a.js""#)]);
        let failure = hashed(&circle).expect_err("a circle").to_string();
        assert!(failure.contains("web/a.js -> web/b.js -> web/a.js"), "{failure}");
    }

    #[test]
    fn thousands_are_grouped() {
        for (number, text) in [(0, "0"), (999, "999"), (1_000, "1 000"), (1_234_567, "1 234 567")] {
            assert_eq!(grouped(number), text);
        }
    }
}
