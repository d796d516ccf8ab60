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
    let mut shown = Taken::of(names.clone());
    let mut free = |wish: &str| {
        let named = |number: u32| match number {
            1 => wish.to_owned(),
            _ => format!("{wish} ({number})"),
        };
        named(shown.free(named))
    };
    let mut seen = HashSet::new();
    (0u32..)
        .zip(names)
        .map(|(index, name)| {
            if name.is_empty() {
                return free(&format!("{kind} {index}"));
            }
            if seen.insert(name) {
                return name.to_owned();
            }
            let name = free(name);
            renamed(index, &name);
            name
        })
        .collect()
}

/// A name as the books' loaders read it, up to the first blank: blanks and control characters become underscores, and so does a brace at
/// the end, which would be taken for the one behind the name of a clip.
pub fn one_word(name: &str) -> String {
    let words: Vec<&str> = name
        .split(char::is_whitespace)
        .filter(|word| !word.is_empty())
        .collect();
    let word = words.join("_").replace(char::is_control, "_");
    match word.strip_suffix(['{', '}']) {
        Some(start) => format!("{start}_"),
        None => word,
    }
}

/// [`one_word`] for each name, `_` for one without a letter, none twice. Names that are words already keep theirs.
pub(crate) fn unique_words<'a>(names: impl Iterator<Item = &'a str> + Clone) -> Vec<String> {
    let mut taken = Taken::of(
        names
            .clone()
            .filter(|name| one_word(name) == **name && !name.is_empty()),
    );
    let mut seen = HashSet::new();
    let unique = |name: &str| {
        let word = one_word(name);
        if word == name && !word.is_empty() && seen.insert(word.clone()) {
            return word;
        }
        let wish = if word.is_empty() { "_" } else { &word };
        let named = |number: u32| match number {
            1 => wish.to_owned(),
            _ => format!("{wish}_{number}"),
        };
        named(taken.free(named))
    };
    names.map(unique).collect()
}

#[derive(Default)]
pub(crate) struct Taken {
    taken: HashSet<String>,
    // Where the search for a free number goes on, so that many equal names do not search from the start each.
    next_numbers: HashMap<String, u32>,
}

impl Taken {
    fn of<'a>(names: impl Iterator<Item = &'a str>) -> Self {
        Self {
            taken: names.map(str::to_owned).collect(),
            next_numbers: HashMap::new(),
        }
    }

    /// The first number from 1 on whose name is free. It is taken from then on.
    pub(crate) fn free(&mut self, named: impl Fn(u32) -> String) -> u32 {
        let wish = named(1);
        if self.taken.insert(wish.clone()) {
            return 1;
        }
        let next = self.next_numbers.entry(wish).or_insert(2);
        loop {
            let number = *next;
            *next += 1;
            if self.taken.insert(named(number)) {
                return number;
            }
        }
    }
}
