//! Codes that arguments name.

use crate::diagnostic::{codes, of_export};

/// What every JSON output says of its keys. It grows when one of them changes its meaning or goes.
pub(super) const SCHEMA_VERSION: u32 = 1;

/// The code of this name: of a finding, or of what `convert` tells of.
pub(super) fn known(name: &str) -> Result<&'static str, String> {
    known_or(name, &[])
}

/// The same, or one of some words.
pub(super) fn known_or(name: &str, words: &[&'static str]) -> Result<&'static str, String> {
    let of_findings = codes::all().map(|code| code.name);
    let of_exports = of_export::ALL.iter().map(|code| code.name);
    let all: Vec<&str> = words.iter().copied().chain(of_findings).chain(of_exports).collect();
    let nearest = all.into_iter().min_by_key(|known| edits(name, known));
    nearest.filter(|nearest| *nearest == name).ok_or_else(|| {
        let nearest = nearest.unwrap_or_default();
        format!("there is no code \"{name}\"; the nearest is \"{nearest}\"")
    })
}

/// How many letters must be put in, left out or changed to make one word of another (Levenshtein's distance).
fn edits(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    // Of each beginning of `to`, from as much of `from` as was read.
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (read, letter) in from.chars().enumerate() {
        let mut before = std::mem::replace(&mut row[0], read + 1);
        for (place, &other) in to.iter().enumerate() {
            let changed = before + usize::from(letter != other);
            before = row[place + 1];
            row[place + 1] = changed.min(before + 1).min(row[place] + 1);
        }
    }
    row[to.len()]
}
