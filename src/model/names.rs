//! Names to show: never empty, never the same twice.

use std::collections::{HashMap, HashSet};

/// One name for each of `names`: itself where it is the first of its kind, with ` (2)`, ` (3)` … otherwise. An empty name
/// becomes `kind` and its number. `renamed` hears the index and new name of every duplicate.
pub(crate) fn unique<'a>(
    names: impl Iterator<Item = &'a str> + Clone,
    kind: &str,
    mut renamed: impl FnMut(u32, &str),
) -> Vec<String> {
    // Names that stand in the file go first, so that `a (2)` of the file keeps its name beside two `a`.
    let mut shown = Shown {
        taken: names.clone().map(str::to_owned).collect(),
        next_numbers: HashMap::new(),
    };
    let mut seen = HashSet::new();
    (0u32..)
        .zip(names)
        .map(|(index, name)| {
            if name.is_empty() {
                return shown.free(&format!("{kind} {index}"));
            }
            if seen.insert(name) {
                return name.to_owned();
            }
            let name = shown.free(name);
            renamed(index, &name);
            name
        })
        .collect()
}

struct Shown {
    taken: HashSet<String>,
    // Where the search for a free number goes on, so that many equal names do not search from the start each.
    next_numbers: HashMap<String, u32>,
}

impl Shown {
    /// The wished name, or the first of `wish (2)`, `wish (3)` … that is free. It is taken from then on.
    fn free(&mut self, wish: &str) -> String {
        if self.taken.insert(wish.to_owned()) {
            return wish.to_owned();
        }
        let number = self.next_numbers.entry(wish.to_owned()).or_insert(2);
        loop {
            let name = format!("{wish} ({number})");
            *number += 1;
            if self.taken.insert(name.clone()) {
                return name;
            }
        }
    }
}
