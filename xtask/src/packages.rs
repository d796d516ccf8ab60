//! Which packages a program is made of, as cargo resolves them for it.

use std::collections::BTreeSet;
use std::path::PathBuf;

use serde_json::Value;

use crate::failure::Failure;
use crate::process::Line;

/// A program as it is built.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Build<'a> {
    /// The compiler's name of the machine it is for.
    pub(crate) target: &'a str,
    /// The features of the library in it, separated by commas.
    pub(crate) features: &'a str,
}

/// A package whose code is in a program.
#[derive(Clone, Debug)]
pub(crate) struct Package {
    pub(crate) name: String,
    pub(crate) version: String,
    /// An SPDX expression; empty where the manifest has none.
    pub(crate) license: String,
    /// Where cargo fetched it from; `None` where it is of this workspace.
    pub(crate) source: Option<String>,
    pub(crate) authors: Vec<String>,
    pub(crate) repository: Option<String>,
    /// Where its sources are.
    pub(crate) folder: PathBuf,
}

/// The packages of a program, sorted by name. What only runs while it is built is not in it.
pub(crate) fn of(build: Build<'_>) -> Result<Vec<Package>, Failure> {
    // The tree has exactly what is built. The metadata's graph is larger, since it unites the features of all that is in the workspace.
    let tree = Line::cargo()
        .args([
            "tree",
            "--quiet",
            "--locked",
            "--package",
            "bindpose",
            "--no-default-features",
        ])
        .args(["--features", build.features, "--target", build.target])
        .args(["--edges", "normal,no-proc-macro", "--prefix", "none", "--format", "{p}"])
        .read()?;
    let contained: BTreeSet<(&str, &str)> = tree.lines().filter_map(name_and_version).collect();
    let metadata = Line::cargo()
        .args(["metadata", "--quiet", "--locked", "--format-version", "1"])
        .read()?;
    let metadata: Value =
        serde_json::from_str(&metadata).map_err(|error| Failure::Site(format!("cargo's metadata: {error}")))?;
    let all = metadata["packages"].as_array().into_iter().flatten().map(package);
    let mut packages: Vec<Package> = all
        .filter(|package| contained.contains(&(&package.name, &package.version)))
        .collect();
    packages.sort_by(|a, b| (&a.name, &a.version).cmp(&(&b.name, &b.version)));
    Ok(packages)
}

/// Of a line of the tree, as `glam v0.34.2 (*)`.
fn name_and_version(line: &str) -> Option<(&str, &str)> {
    let mut words = line.split(' ');
    Some((words.next()?, words.next()?.strip_prefix('v')?))
}

/// Of a package in the metadata.
fn package(record: &Value) -> Package {
    let text = |key: &str| record[key].as_str().map(str::to_owned);
    let authors = record["authors"].as_array().into_iter().flatten();
    let mut folder = PathBuf::from(text("manifest_path").unwrap_or_default());
    folder.pop();
    Package {
        name: text("name").unwrap_or_default(),
        version: text("version").unwrap_or_default(),
        license: text("license").unwrap_or_default(),
        source: text("source"),
        authors: authors.filter_map(Value::as_str).map(str::to_owned).collect(),
        repository: text("repository"),
        folder,
    }
}

#[cfg(test)]
mod tests {
    use std::iter::Peekable;
    use std::str::SplitWhitespace;
    use std::sync::LazyLock;

    use super::*;
    use crate::wasm::{self, Program};

    /// What a package must be to be had under, besides its other offers.
    const LICENSES: [&str; 5] = ["Apache-2.0", "ISC", "MIT", "Unicode-3.0", "Zlib"];

    /// Where packages come from.
    const REGISTRY: &str = "registry+https://github.com/rust-lang/crates.io-index";

    /// What a program may have in two versions, and why.
    const DOUBLED: [(&str, &str); 3] = [
        ("hashbrown", "gpu-allocator is behind the others; natively alone"),
        ("miniz_oxide", "png asks for 0.8 and, by way of flate2, for 0.9"),
        (
            "rustc-hash",
            "naga and wgpu ask for 1, the library for 2, which hashes better",
        ),
    ];

    /// Every program that people get: those of pages, and what is native for each machine that the release is built for, with all features.
    static PROGRAMS: LazyLock<Vec<(Build<'static>, Vec<Package>)>> = LazyLock::new(|| {
        let page = Program::ALL.map(|program| Build {
            target: wasm::TARGET,
            features: program.features(),
        });
        let release = include_str!("../../.github/workflows/release.yml").lines();
        let targets = release.filter_map(|line| line.trim().strip_prefix("- target: "));
        let native = targets.map(|target| Build {
            target,
            features: "viewer,cli",
        });
        let programs: Vec<Build<'_>> = page.into_iter().chain(native).collect();
        assert_eq!(programs.len(), 8, "four of pages, and four machines");
        let packages = |build| (build, of(build).expect("cargo resolves it"));
        programs.into_iter().map(packages).collect()
    });

    /// Whether an SPDX expression can be met with these licences, or `None` where it is none. Old manifests write `/` for OR.
    fn is_met(expression: &str, allowed: &[&str]) -> Option<bool> {
        let spaced = expression.replace('(', " ( ").replace(')', " ) ").replace('/', " OR ");
        let mut words = spaced.split_whitespace().peekable();
        let met = any(&mut words, allowed)?;
        words.next().is_none().then_some(met)
    }

    type Words<'a> = Peekable<SplitWhitespace<'a>>;

    fn any(words: &mut Words<'_>, allowed: &[&str]) -> Option<bool> {
        let mut met = all(words, allowed)?;
        while words.next_if_eq(&"OR").is_some() {
            met |= all(words, allowed)?;
        }
        Some(met)
    }

    fn all(words: &mut Words<'_>, allowed: &[&str]) -> Option<bool> {
        let mut met = one(words, allowed)?;
        while words.next_if_eq(&"AND").is_some() {
            met &= one(words, allowed)?;
        }
        Some(met)
    }

    fn one(words: &mut Words<'_>, allowed: &[&str]) -> Option<bool> {
        match words.next()? {
            "(" => {
                let met = any(words, allowed)?;
                (words.next() == Some(")")).then_some(met)
            }
            ")" | "AND" | "OR" | "WITH" => None,
            name if words.next_if_eq(&"WITH").is_some() => {
                let name = format!("{name} WITH {}", words.next()?);
                Some(allowed.contains(&name.as_str()))
            }
            name => Some(allowed.contains(&name)),
        }
    }

    #[test]
    fn expressions_of_licences_are_met_as_they_bind() {
        for (expression, met) in [
            ("MIT", Some(true)),
            ("LGPL-2.1-or-later", Some(false)),
            ("MIT/Apache-2.0", Some(true)),
            ("GPL-2.0-only OR Zlib", Some(true)),
            ("MIT AND NCSA", Some(false)),
            ("MIT OR NCSA AND NCSA", Some(true)),
            ("(MIT OR NCSA) AND NCSA", Some(false)),
            ("(NCSA OR MIT) AND (Zlib)", Some(true)),
            ("Apache-2.0 WITH LLVM-exception", Some(false)),
            ("Apache-2.0 WITH LLVM-exception OR MIT", Some(true)),
            ("", None),
            ("MIT OR", None),
            ("(MIT", None),
            ("MIT Zlib", None),
        ] {
            assert_eq!(is_met(expression, &LICENSES), met, "{expression}");
        }
    }

    #[test]
    fn every_package_of_a_program_may_be_passed_on_and_comes_from_the_registry() {
        let packages: Vec<&Package> = PROGRAMS.iter().flat_map(|(_, packages)| packages).collect();
        for Package {
            name, license, source, ..
        } in &packages
        {
            assert_eq!(
                is_met(license, &LICENSES),
                Some(true),
                "{name}: `{license}` is on no list"
            );
            match source {
                Some(source) => assert_eq!(source, REGISTRY, "{name}"),
                None => assert_eq!(name, "bindpose", "no other package of the workspace is in a program"),
            }
        }
        for license in LICENSES {
            let others: Vec<&str> = LICENSES.into_iter().filter(|other| *other != license).collect();
            let needs_it = |package: &&Package| is_met(&package.license, &others) == Some(false);
            assert!(
                packages.iter().any(needs_it),
                "{license}: nothing needs it. Take it out."
            );
        }
    }

    #[test]
    fn a_program_has_a_package_twice_only_with_a_reason() {
        let mut doubled = BTreeSet::new();
        for (build, packages) in PROGRAMS.iter() {
            for pair in packages.windows(2).filter(|pair| pair[0].name == pair[1].name) {
                let [name, one, two] = [&pair[0].name, &pair[0].version, &pair[1].version];
                let is_known = DOUBLED.iter().any(|(known, _)| known == name);
                assert!(
                    is_known,
                    "{name} {one} and {two} are both in {build:?}. `cargo tree --invert` says why."
                );
                doubled.insert(name.as_str());
            }
        }
        for (name, reason) in DOUBLED {
            assert!(
                doubled.contains(name),
                "{name} ({reason}) is no longer there twice. Take it out."
            );
        }
    }
}
