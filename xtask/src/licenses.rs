//! What is owed to others for passing a program on: each package in it with its licence, and the texts of all licences.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::failure::{Doing as _, Failure};
use crate::packages::{self, Build, Package};
use crate::wasm::{self, Program};

/// The file's name beside a program.
pub(crate) const NAME: &str = "licenses.txt";

/// How the names of files with licences begin.
const BEGINNINGS: [&str; 6] = ["LICENSE", "LICENCE", "UNLICENSE", "COPYING", "COPYRIGHT", "NOTICE"];

/// The fonts that a program has, by the beginnings of their files' names, and whose they are.
const FONTS: [(&str, &str); 2] = [
    ("Inter", "Copyright 2020 The Inter Project Authors"),
    (
        "JetBrainsMono",
        "Copyright 2020 The JetBrains Mono Project Authors (https://github.com/JetBrains/JetBrainsMono)",
    ),
];

const HEAD: &str = "\
What Bindpose is made of, and the licences of it. The numbers are those of the texts below. Of packages that offer several licences, MIT or
Apache-2.0 is taken wherever it is among them. A package without a number brings no text: those of others with the same licence hold.
";

/// A part of the program.
struct Part {
    name: String,
    license: String,
    /// Whose it is and where it comes from.
    origin: Vec<String>,
    /// The files with the texts of its licences.
    files: Vec<PathBuf>,
}

/// `cargo xtask licenses`: the file's text for the command, as it is released for a target.
pub(crate) fn print(target: &str) -> Result<(), Failure> {
    let features = "cli";
    print!("{}", text(Build { target, features })?);
    Ok(())
}

/// The file's text for the page. Of all programs one has all that the others have.
pub(crate) fn of_the_page() -> Result<String, Failure> {
    text(Build {
        target: wasm::TARGET,
        features: Program::Full.features(),
    })
}

/// The file's text for a program.
fn text(build: Build<'_>) -> Result<String, Failure> {
    let mut parts = vec![standard_library()];
    parts.extend(fonts());
    for package in packages::of(build)? {
        parts.push(of_package(package)?);
    }
    assemble(&parts)
}

/// It is in every program, but no package.
fn standard_library() -> Part {
    Part {
        name: "Rust's standard library".to_owned(),
        license: "MIT OR Apache-2.0".to_owned(),
        origin: ["The Rust Project Developers", "https://github.com/rust-lang/rust"]
            .map(str::to_owned)
            .to_vec(),
        files: Vec::new(),
    }
}

fn fonts() -> [Part; 2] {
    FONTS.map(|(name, owner)| Part {
        name: format!("{name} (font)"),
        license: "OFL-1.1".to_owned(),
        origin: vec![owner.to_owned()],
        files: vec![crate::root().join("assets/fonts/OFL.txt")],
    })
}

fn of_package(package: Package) -> Result<Part, Failure> {
    let place = package.repository.or(package.source);
    Ok(Part {
        name: format!("{} {}", package.name, package.version),
        files: license_files(&package.folder)?,
        license: package.license,
        origin: package.authors.into_iter().chain(place).collect(),
    })
}

/// The files with licences in a folder, sorted.
fn license_files(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let reading = format!("reading {}", folder.display());
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).doing(&reading)? {
        let entry = entry.doing(&reading)?;
        let name = entry.file_name().to_string_lossy().to_uppercase();
        let path = entry.path();
        if path.is_file() && BEGINNINGS.iter().any(|beginning| name.starts_with(beginning)) {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// The parts in order, then each text once: texts that differ in spaces and line ends alone are one.
fn assemble(parts: &[Part]) -> Result<String, Failure> {
    let (mut list, mut texts) = (HEAD.to_owned(), String::new());
    let mut numbers: BTreeMap<String, usize> = BTreeMap::new();
    for part in parts {
        let mut own = Vec::new();
        for path in &part.files {
            let bytes = fs::read(path).doing(format!("reading {}", path.display()))?;
            let text = String::from_utf8_lossy(&bytes);
            let next = numbers.len() + 1;
            let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
            let number = *numbers.entry(words).or_insert(next);
            if number == next {
                texts += &format!("\n---------- {number} ----------\n\n");
                for line in text.trim_matches(['\n', '\r', '\u{feff}']).lines() {
                    texts += line.trim_end();
                    texts.push('\n');
                }
            }
            own.push(format!("[{number}]"));
        }
        list += &format!("\n{}: {} {}", part.name, part.license, own.join(" "));
        list.truncate(list.trim_end().len());
        list.push('\n');
        for line in &part.origin {
            list += &format!("    {line}\n");
        }
    }
    Ok(list + &texts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_text_is_there_once_and_parts_name_it_by_its_number() {
        let folder = crate::target_dir().join("tmp/licenses");
        for (name, text) in [
            ("one/LICENSE-MIT", "Copyright One\n\n  may be used\n"),
            ("one/COPYING", "whatever\n"),
            ("one/lib.rs", "no licence"),
            ("two/license.md", "Copyright One\r\n\r\nmay  be used"),
            ("three/README.md", "none"),
        ] {
            let path = folder.join(name);
            fs::create_dir_all(path.parent().expect("a folder")).expect("it can be made");
            fs::write(path, text).expect("it can be written");
        }
        let part = |name: &str| {
            of_package(Package {
                name: name.to_owned(),
                version: "1.0.0".to_owned(),
                license: "MIT".to_owned(),
                source: None,
                authors: vec!["A Person".to_owned()],
                repository: Some("https://example.org".to_owned()),
                folder: folder.join(name),
            })
        };
        let parts = ["one", "two", "three"].map(|name| part(name).expect("the folder reads"));
        let origin = "    A Person\n    https://example.org\n";
        assert_eq!(
            assemble(&parts).expect("the files read"),
            format!(
                "{HEAD}\none 1.0.0: MIT [1] [2]\n{origin}\ntwo 1.0.0: MIT [2]\n{origin}\nthree 1.0.0: MIT\n{origin}\n\
                 ---------- 1 ----------\n\nwhatever\n\n---------- 2 ----------\n\nCopyright One\n\n  may be used\n"
            )
        );
    }

    #[test]
    fn the_page_says_what_it_is_made_of() {
        let text = of_the_page().expect("cargo resolves it");
        for words in [
            &format!("\nbindpose {}: MIT OR Apache-2.0 [", env!("CARGO_PKG_VERSION")),
            "\nRust's standard library: ",
            "\nJetBrainsMono (font): OFL-1.1 [1]\n    Copyright 2020 The JetBrains Mono Project Authors",
            "\negui 0.",
            "\nwasm-bindgen 0.2.130: MIT OR Apache-2.0 [",
            "SIL OPEN FONT LICENSE Version 1.1",
            "Permission is hereby granted, free of charge",
        ] {
            assert!(text.contains(words), "{words}");
        }
        // Neither what is native alone nor what runs while it is built.
        for name in ["\nclap ", "\nwinit ", "\nserde_derive ", "\nxtask "] {
            assert!(!text.contains(name), "{name}");
        }
        let here = crate::root().display().to_string();
        assert!(!text.contains(&here), "nothing tells where it was made");
    }

    #[test]
    fn every_font_has_an_owner() {
        let mut count = 0;
        for entry in fs::read_dir(crate::root().join("assets/fonts")).expect("the fonts list") {
            let name = entry.expect("an entry").file_name().to_string_lossy().into_owned();
            if name.ends_with(".otf") || name.ends_with(".ttf") {
                count += 1;
                assert!(FONTS.iter().any(|(font, _)| name.starts_with(font)), "{name}");
            }
        }
        assert!(count > 0);
    }
}
