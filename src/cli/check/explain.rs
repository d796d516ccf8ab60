//! What a code means.

use std::io::Write;

use crate::cli::codes::known;
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
    let Some(code) = codes::named(name) else {
        return Err(Failure::WrongUse(known(name).err().unwrap_or_default()));
    };
    writeln!(out, "{}[{}]: {}", code.severity, code.name, code.sentence)?;
    writeln!(out, "{}", code.explanation)?;
    writeln!(out, "Here: {}", code.handling)?;
    writeln!(out, "To mend it: {}", code.mending)?;
    if let Some(permanent) = code.permanent() {
        writeln!(out, "{permanent}")?;
    }
    Ok(())
}
