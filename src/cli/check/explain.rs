//! What a code means.

use std::io::Write;

use crate::cli::failure::Failure;
use crate::diagnostic::{codes, of_export};

/// Prints the row of the table of codes, or of those that `convert` tells of.
pub(super) fn explain(name: &str, out: &mut dyn Write) -> Result<(), Failure> {
    if let Some(code) = of_export::named(name) {
        let kind = if code.is_loss { "loss" } else { "change" };
        writeln!(out, "{kind}[{}]: {}", code.name, code.sentence)?;
        writeln!(out, "What to do: {}", code.advice)?;
        return Ok(());
    }
    let code = codes::named(name).ok_or_else(|| Failure::UnknownCode {
        asked: name.to_owned(),
        nearest: codes::all()
            .map(|code| code.name)
            .chain(of_export::ALL.iter().map(|code| code.name))
            .min_by_key(|known| edits(name, known))
            .unwrap_or_default(),
    })?;
    writeln!(out, "{}[{}]: {}", code.severity, code.name, code.sentence)?;
    writeln!(out, "{}", code.explanation)?;
    writeln!(out, "Here: {}", code.handling)?;
    writeln!(out, "To mend it: {}", code.mending)?;
    if let Some(permanent) = code.permanent() {
        writeln!(out, "{permanent}")?;
    }
    Ok(())
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_are_counted_one_by_one() {
        for (from, to, count) in [
            ("", "", 0),
            ("", "abc", 3),
            ("abc", "", 3),
            ("same", "same", 0),
            ("weights-not-normalised", "weights-not-normalized", 1),
            ("empy-file", "empty-file", 1),
            ("kitten", "sitting", 3),
        ] {
            assert_eq!(edits(from, to), count, "{from} {to}");
        }
    }
}
