//! The worker that keeps the site for visits without a network: `web/worker.js`, told what it keeps; and the id of the build, which pages have too.

use std::collections::BTreeMap;

use crate::dist::fnv1a;
use crate::failure::Failure;
use crate::sizes::is_hashed;

/// What the worker is made of, and its name at the root of the site: a worker serves what is below it.
pub(crate) const TEMPLATE: &str = "web/worker.js";
pub(crate) const NAME: &str = "sw.js";

/// The lines of the template that are written anew.
const BUILD: &str = "const BUILD = \"\";";
const FILES: &str = "const FILES = { shell: [], full: [], webgpu: [] };";

/// Writes the build's id into the pages, and adds the worker to the files.
pub(crate) fn join(files: &mut BTreeMap<String, Vec<u8>>, template: &str) -> Result<(), Failure> {
    let mut all = template.to_owned();
    for (name, bytes) in files.iter() {
        all.push_str(&format!("{name} {:016x}\n", fnv1a(bytes)));
    }
    let id = format!("{:016x}", fnv1a(all.as_bytes()));
    for (name, bytes) in files.iter_mut().filter(|(name, _)| name.ends_with(".html")) {
        let page = String::from_utf8_lossy(bytes).into_owned();
        let told = format!("<meta name=\"build\" content=\"{id}\">\n</head>");
        *bytes = replaced(&page, "</head>", &told, name)?.into_bytes();
    }
    let of = |part: Part| {
        let names = files.keys().filter(|name| part_of(name) == Some(part));
        // A host may answer for the page's own name with another address.
        let names = names.map(|name| if name == "index.html" { "./" } else { name.as_str() });
        names.map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ")
    };
    let lists = format!(
        "const FILES = {{\n  shell: [{}],\n  full: [{}],\n  webgpu: [{}],\n}};",
        of(Part::Shell),
        of(Part::Full),
        of(Part::WebGpu)
    );
    let worker = replaced(template, BUILD, &format!("const BUILD = \"{id}\";"), TEMPLATE)?;
    let worker = replaced(&worker, FILES, &lists, TEMPLATE)?;
    files.insert(NAME.to_owned(), worker.into_bytes());
    Ok(())
}

/// What a file is kept with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Shell,
    Full,
    WebGpu,
}

/// `None` for what no visit of the page uses: what a system shows, licences, the element for other pages. The worker knows a file for its own by the
/// hash in its name, and a page by the build that it tells.
fn part_of(name: &str) -> Option<Part> {
    let is_others = ["web/install/", "web/element/", "pkg/element/"]
        .iter()
        .any(|folder| name.starts_with(folder));
    if is_others || !(is_hashed(name) || name.ends_with(".html")) {
        return None;
    }
    Some(match name.strip_prefix("pkg/") {
        None => Part::Shell,
        Some(name) if name.starts_with("webgpu/") => Part::WebGpu,
        Some(_) => Part::Full,
    })
}

fn replaced(text: &str, old: &str, new: &str, name: &str) -> Result<String, Failure> {
    match text.split_once(old) {
        Some((before, after)) => Ok([before, new, after].concat()),
        None => Err(Failure::Site(format!("{name} has no `{old}`"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dist;

    /// The worker of files, its id and the names in each of its lists.
    fn read(files: &BTreeMap<String, Vec<u8>>) -> (String, [Vec<String>; 3]) {
        let worker = std::str::from_utf8(&files[NAME]).expect("text");
        let after = |start: &str, end: char| {
            let rest = worker.split_once(start).expect(start).1;
            rest.split_once(end).expect("an end").0.to_owned()
        };
        let lists = ["shell", "full", "webgpu"].map(|list| {
            let names = after(&format!("  {list}: ["), ']');
            names
                .split(", ")
                .map(|name| name.trim_matches('"').to_owned())
                .collect()
        });
        (after("const BUILD = \"", '"'), lists)
    }

    #[test]
    fn the_worker_keeps_every_file_of_the_real_page_but_what_no_visit_takes() {
        let files = dist::of_the_page();
        let (id, lists) = read(&files);
        let mut kept: Vec<String> = lists.concat();
        kept.sort();
        let mut expected: Vec<String> = files.keys().filter(|name| *name != NAME).cloned().collect();
        let is_taken = |name: &str| is_hashed(name) || name == "index.html" || name == "web/codes.html";
        expected.retain(|name| is_taken(name) && !name.starts_with("web/install/"));
        expected.retain(|name| !name.starts_with("pkg/element/") && !name.starts_with("web/element/"));
        expected.retain(|name| name != "index.html");
        expected.push("./".to_owned());
        expected.sort();
        assert_eq!(kept, expected);
        assert!(lists[1].len() == 2 && lists[1].iter().all(|name| name.starts_with("pkg/bindpose")));
        assert!(lists[2].len() == 2 && lists[2].iter().all(|name| name.starts_with("pkg/webgpu/")));
        for page in ["index.html", "web/codes.html"] {
            let page = String::from_utf8_lossy(&files[page]);
            assert!(page.contains(&format!("<meta name=\"build\" content=\"{id}\">\n</head>")));
        }
    }

    #[test]
    fn the_id_is_another_when_any_file_is() {
        let id = |changed: &str| {
            let template = format!("{BUILD}\n{FILES}\n// {}", changed == TEMPLATE);
            let mut files = BTreeMap::new();
            for (name, text) in [("index.html", "<head></head>"), ("web/a.js", ""), ("pkg/a.wasm", "")] {
                let text = format!("{text}{}", if changed == name { "!" } else { "" });
                files.insert(name.to_owned(), text.into_bytes());
            }
            join(&mut files, &template).expect("a template");
            read(&files).0
        };
        let changes = ["", "index.html", "web/a.js", "pkg/a.wasm", TEMPLATE];
        let ids: std::collections::BTreeSet<String> = changes.map(id).into();
        assert_eq!(ids.len(), changes.len());
        assert_eq!(id(""), id(""));
    }

    #[test]
    fn a_template_without_the_lines_is_refused() {
        let failure = join(&mut BTreeMap::new(), "// nothing").expect_err("no lines");
        assert!(
            failure.to_string().contains("web/worker.js has no `const BUILD"),
            "{failure}"
        );
    }
}
