//! Who may use whom: the table of ARCHITECTURE.md holds between the modules, and no files use each other in a circle.
//!
//! A file uses the file in which a name is defined, wherever it takes the name from: a re-export is followed to its origin.
//! So a `mod.rs` that only gathers names hides no circle and makes none. `super::` counts as every other path does. What a
//! file re-exports it uses only if its own code names it too; `mod child;` alone is no use. Between modules a re-export counts
//! as any use, and so does the module that a path goes through. Comments and method calls are not read.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path as FilePath;

use self::source::{Import, Path, Source};

mod source;

/// A module's path from the crate's root, and what its file says.
struct Module {
    path: Vec<String>,
    file: String,
    source: Source,
    has_tests: bool,
}

/// One file naming what another defines.
struct Use {
    file: String,
    line: usize,
    written: String,
    target: String,
    /// False for a re-export that the file's own code does not name.
    own: bool,
    /// Top modules, of the user and of what is used or gone through.
    from: String,
    to: BTreeSet<String>,
}

struct Crate {
    modules: Vec<Module>,
    index: BTreeMap<Vec<String>, usize>,
}

impl Crate {
    fn read() -> Self {
        let root = FilePath::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let mut modules = Vec::new();
        let mut folders = vec![root.clone()];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(&folder).expect("src can be listed") {
                let path = entry.expect("src can be listed").path();
                if path.is_dir() {
                    folders.push(path);
                    continue;
                }
                let file = path.strip_prefix(&root).expect("a file of src").with_extension("");
                let mut module: Vec<String> = file
                    .iter()
                    .map(|part| part.to_str().expect("names are ASCII").to_owned())
                    .collect();
                if module.last().is_some_and(|last| last == "mod") || module == ["lib"] {
                    module.pop();
                }
                let text = fs::read_to_string(&path).expect("sources are UTF-8");
                let source = Source::read(&text);
                let file = format!("src/{}", path.strip_prefix(&root).expect("a file of src").display());
                modules.push(Module {
                    path: module,
                    file: file.replace('\\', "/"),
                    source,
                    has_tests: text.contains("#[test]") || text.contains("#[cfg(test)]"),
                });
            }
        }
        modules.sort_by(|a, b| a.file.cmp(&b.file));
        let index = modules
            .iter()
            .enumerate()
            .map(|(index, module)| (module.path.clone(), index))
            .collect();
        Self { modules, index }
    }

    /// The module in whose file `segments` of a path in `from` is defined, and the top modules gone through; `None` for what
    /// is not of this crate. `importing`: the path is that of a `use`, which its own names do not shadow.
    fn resolve(
        &self,
        from: usize,
        segments: &[String],
        importing: bool,
        through: &mut BTreeSet<String>,
    ) -> Option<usize> {
        let module = &self.modules[from];
        let mut at = module.path.clone();
        let mut rest = segments;
        match rest.first()?.as_str() {
            "crate" | "bindpose" => (at, rest) = (Vec::new(), &rest[1..]),
            "self" => rest = &rest[1..],
            "super" => {}
            first => {
                at.push(first.to_owned());
                let child = self.index.contains_key(&at);
                at.pop();
                if !child && (importing || !module.source.imports.iter().any(|import| import.name == first)) {
                    return None;
                }
            }
        }
        while let [segment, others @ ..] = rest {
            if segment == "super" {
                at.pop();
            } else {
                at.push(segment.clone());
                if !self.index.contains_key(&at) {
                    at.pop();
                    return self.origin(&at, rest, through);
                }
            }
            rest = others;
            through.extend(at.first().cloned());
        }
        self.index.get(&at).copied()
    }

    /// The module that defines `rest` of a path which is not a module of `at`: this one, or what it imports the name from.
    fn origin(&self, at: &[String], rest: &[String], through: &mut BTreeSet<String>) -> Option<usize> {
        let here = *self.index.get(at)?;
        through.extend(at.first().cloned());
        let import = self.modules[here]
            .source
            .imports
            .iter()
            .find(|import| import.name == rest[0]);
        let Some(import) = import else { return Some(here) };
        // `pub(crate) use name;` makes a macro of this file known by its path.
        if import.path.segments == rest {
            return Some(here);
        }
        let path: Vec<String> = import.path.segments.iter().chain(&rest[1..]).cloned().collect();
        self.resolve(here, &path, true, through)
    }

    fn uses(&self) -> Vec<Use> {
        let mut uses = Vec::new();
        for (from, module) in self.modules.iter().enumerate() {
            let mut add = |path: &Path, importing: bool, own: bool| {
                let mut through = BTreeSet::new();
                let Some(target) = self.resolve(from, &path.segments, importing, &mut through) else {
                    return;
                };
                let target = &self.modules[target];
                let top = |path: &[String]| path.first().map_or("lib", |top| top).to_owned();
                // A module of modules that is only named is used where a path goes on into it.
                let is_gatherer = target.file.ends_with("/mod.rs") && target.path.last() == path.segments.last();
                let own = own && !(importing && is_gatherer);
                through.insert(top(&target.path));
                let from = top(&module.path);
                through.remove(&from);
                uses.push(Use {
                    file: module.file.clone(),
                    line: path.line,
                    written: path.segments.join("::"),
                    target: target.file.clone(),
                    own,
                    from,
                    to: through,
                });
            };
            let named = |import: &Import| module.source.paths.iter().any(|path| path.segments[0] == import.name);
            for import in &module.source.imports {
                add(&import.path, true, !import.public || named(import));
            }
            for path in &module.source.paths {
                if path.segments.len() > 1 {
                    add(path, false, true);
                }
            }
        }
        uses
    }
}

/// The table of ARCHITECTURE.md: module -> modules that it may use.
fn table() -> BTreeMap<String, BTreeSet<String>> {
    let text = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/ARCHITECTURE.md")).expect("ARCHITECTURE.md");
    let (_, section) = text
        .split_once("\n## Who may use whom\n")
        .expect("ARCHITECTURE.md says who may use whom");
    let section = section.split("\n## ").next().unwrap_or_default();
    let rows = section.lines().filter(|line| line.starts_with('|')).skip(2);
    let words = |cell: &str| -> BTreeSet<String> {
        cell.split(',')
            .map(|word| word.trim().to_owned())
            .filter(|word| word != "–")
            .collect()
    };
    let mut table = BTreeMap::new();
    for row in rows {
        let cells: Vec<&str> = row.trim_matches('|').split('|').collect();
        let [users, used] = cells[..] else {
            panic!("two cells: {row}")
        };
        for user in words(users) {
            assert!(table.insert(user.clone(), words(used)).is_none(), "two rows for {user}");
        }
    }
    assert!(!table.is_empty(), "the section holds a table");
    table
}

/// Groups of files that reach each other.
fn circles(uses: &[Use]) -> Vec<BTreeSet<&str>> {
    let mut edges = BTreeMap::<&str, BTreeSet<&str>>::new();
    for use_ in uses.iter().filter(|use_| use_.own && use_.file != use_.target) {
        edges.entry(&use_.file).or_default().insert(&use_.target);
    }
    let reach = |from: &str| {
        let mut reached = BTreeSet::new();
        let mut open: Vec<&str> = edges.get(from).into_iter().flatten().copied().collect();
        while let Some(file) = open.pop() {
            if reached.insert(file) {
                open.extend(edges.get(file).into_iter().flatten());
            }
        }
        reached
    };
    let reached: BTreeMap<&str, BTreeSet<&str>> = edges.keys().map(|file| (*file, reach(file))).collect();
    let mut circles: Vec<BTreeSet<&str>> = Vec::new();
    for (file, reachable) in &reached {
        if reachable.contains(file) && !circles.iter().any(|circle| circle.contains(file)) {
            circles.push(
                reachable
                    .iter()
                    .filter(|other| reached.get(*other).is_some_and(|r| r.contains(file)))
                    .copied()
                    .collect(),
            );
        }
    }
    circles
}

/// One line for each file and file that it uses: the first line of it, and all that is named.
fn listed(uses: &[&Use]) -> String {
    let mut pairs = BTreeMap::<(&str, &str), (usize, BTreeSet<&str>)>::new();
    for use_ in uses.iter().filter(|use_| use_.file != use_.target) {
        let (line, written) = pairs
            .entry((&use_.file, &use_.target))
            .or_insert((use_.line, BTreeSet::new()));
        *line = use_.line.min(*line);
        written.insert(&use_.written);
    }
    let written = |names: BTreeSet<&str>| names.into_iter().collect::<Vec<_>>().join(", ");
    let lines = pairs
        .into_iter()
        .map(|((file, target), (line, names))| format!("  {file}:{line} uses {target}: {}\n", written(names)));
    lines.collect()
}

#[test]
fn files_do_not_use_each_other_in_a_circle() {
    let uses = Crate::read().uses();
    let circles = circles(&uses);
    let mut message = String::new();
    for circle in &circles {
        message += &format!("\n{} files use each other in a circle:\n", circle.len());
        let inner =
            |use_: &&Use| use_.own && circle.contains(use_.file.as_str()) && circle.contains(use_.target.as_str());
        message += &listed(&uses.iter().filter(inner).collect::<Vec<_>>());
    }
    assert!(message.is_empty(), "{message}");
}

/// `[lib] test = false` in Cargo.toml: they would never run.
#[test]
fn the_library_has_no_tests_inside() {
    let with_tests = Crate::read().modules.into_iter().filter(|module| module.has_tests);
    assert_eq!(with_tests.map(|module| module.file).collect::<Vec<_>>(), [""; 0]);
}

#[test]
fn modules_keep_the_order_of_the_architecture() {
    let table = table();
    let uses = Crate::read().uses();
    let mut message = String::new();
    let mut broken = BTreeMap::<(&str, &str), Vec<&Use>>::new();
    let modules: BTreeSet<&str> = uses.iter().map(|u| u.from.as_str()).collect();
    for module in modules {
        if !table.contains_key(module) {
            message += &format!("\nARCHITECTURE.md has no row for {module}\n");
        }
    }
    for use_ in &uses {
        for to in &use_.to {
            if !table.get(&use_.from).is_some_and(|may| may.contains(to)) {
                broken.entry((&use_.from, to)).or_default().push(use_);
            }
        }
    }
    for ((from, to), uses) in broken {
        message += &format!("\n{from} may not use {to} by ARCHITECTURE.md, but does:\n");
        message += &listed(&uses);
    }
    assert!(message.is_empty(), "{message}");
}
