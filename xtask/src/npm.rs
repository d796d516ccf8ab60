//! The package `bindpose-viewer`: the element with all that it loads, its types and a README, as a folder that `npm publish` takes.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::dist::{self, ELEMENT, PAGE, resolved};
use crate::failure::{Doing as _, Failure};
use crate::licenses;
use crate::site::Site;

/// What the package has beside the site's files, from `xtask/npm`.
const BESIDE: [&str; 4] = ["package.json", "README.md", "bindpose-viewer.d.ts", "viewer.d.ts"];

/// What the manifest has in place of the version and the licence of `Cargo.toml`.
const PLACEHOLDERS: [(&str, &str); 2] = [
    ("\"0.0.0\"", env!("CARGO_PKG_VERSION")),
    ("\"LICENSE\"", "(MIT OR Apache-2.0)"),
];

/// Where [`write_for_tests`] writes.
pub(crate) fn package_for_tests() -> PathBuf {
    crate::target_dir().join("tmp/npm")
}

/// Writes the package of a site, whose licences are these, into a folder, which is emptied before.
pub(crate) fn write(site: &Site, licenses: &str, folder: &Path) -> Result<(), Failure> {
    if folder.exists() {
        fs::remove_dir_all(folder).doing(format!("removing {}", folder.display()))?;
    }
    let sources = dist::sources(site)?;
    for address in loaded_by(ELEMENT, &sources) {
        dist::write_file(folder, address, &without_way_back(address, &sources[address]))?;
    }
    for name in BESIDE {
        let path = crate::root().join("xtask/npm").join(name);
        let mut text = fs::read_to_string(&path).doing(format!("reading {}", path.display()))?;
        if name == "package.json" {
            for (placeholder, value) in PLACEHOLDERS {
                text = text.replacen(placeholder, &format!("\"{value}\""), 1);
            }
        }
        dist::write_file(folder, name, text.as_bytes())?;
    }
    dist::write_file(folder, licenses::NAME, licenses.as_bytes())?;
    Ok(())
}

/// The page of codes leads back to a page that is not in the package.
fn without_way_back(address: &str, bytes: &[u8]) -> Vec<u8> {
    if !address.ends_with("/codes.html") {
        return bytes.to_vec();
    }
    String::from_utf8_lossy(bytes)
        .replace(&format!("<a href=\"../{PAGE}\">Bindpose</a>"), "Bindpose")
        .into_bytes()
}

/// The same of what the checks build.
pub(crate) fn write_for_tests(site: &Site) -> Result<(), Failure> {
    write(
        site,
        "As in the package, though not all of them.\n",
        &package_for_tests(),
    )
}

/// A file and all that it names, and what those name.
fn loaded_by<'a>(first: &'a str, sources: &'a BTreeMap<String, Vec<u8>>) -> BTreeSet<&'a str> {
    let (mut found, mut waiting) = (BTreeSet::new(), vec![first]);
    while let Some(address) = waiting.pop() {
        if !found.insert(address) || !dist::refers(address) {
            continue;
        }
        let text = String::from_utf8_lossy(&sources[address]);
        let folder = address.rsplit_once('/').map_or("", |(folder, _)| folder);
        let named = text
            .split(['"', '\'', '`'])
            .filter_map(|part| sources.get_key_value(&resolved(folder, part)?))
            // The page of codes leads back to it.
            .filter(|(address, _)| *address != PAGE);
        waiting.extend(named.map(|(address, _)| address.as_str()));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_of_codes_leads_nowhere_else() {
        let bytes = fs::read(crate::root().join("web/codes.html")).expect("it is there");
        let has_way_back = |bytes: &[u8]| String::from_utf8_lossy(bytes).contains(PAGE);
        assert!(has_way_back(&bytes) && !has_way_back(&without_way_back("web/codes.html", &bytes)));
        assert_eq!(without_way_back("web/other.html", &bytes), bytes);
    }

    #[test]
    fn the_package_has_what_the_element_loads_and_no_more() {
        let page = dist::page();
        let loaded = loaded_by(ELEMENT, &page);
        for address in [
            "web/element/life.js",
            "pkg/bindpose.js",
            "pkg/element/webgpu/bindpose_bg.wasm",
            "web/mirror.js",
        ] {
            assert!(loaded.contains(address), "{address}");
        }
        for address in ["index.html", "web/boot.js", "web/worker.js", "web/sample/figure.m3d"] {
            assert!(!loaded.contains(address) && page.contains_key(address), "{address}");
        }
    }

    #[test]
    fn the_limits_of_a_first_visit_count_each_script_that_the_element_loads() {
        let limits = fs::read_to_string(crate::root().join("xtask/sizes.txt")).expect("it is there");
        let visits = limits.lines().filter(|line| line.contains(" web/element/*.js web/"));
        let (page, mut count) = (dist::page(), 0);
        for visit in visits {
            for address in loaded_by(ELEMENT, &page)
                .into_iter()
                .filter(|address| address.ends_with(".js"))
            {
                let is_there = address.starts_with("web/element/") || visit.split(' ').any(|part| part == address);
                assert!(is_there || address.starts_with("pkg/"), "{address} is not in: {visit}");
            }
            count += 1;
        }
        assert_eq!(count, 2);
    }

    #[test]
    fn the_manifest_has_the_places_that_are_filled() {
        let manifest = fs::read_to_string(crate::root().join("xtask/npm/package.json")).expect("it is there");
        for (placeholder, _) in PLACEHOLDERS {
            assert_eq!(manifest.matches(placeholder).count(), 1, "{placeholder}");
        }
    }
}
