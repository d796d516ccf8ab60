//! Starting other programs, with the line shown first so that a person can repeat it.

use std::ffi::OsStr;
use std::io;
use std::process::{Command, ExitStatus, Stdio};

use crate::failure::Failure;

/// A command line in the repository's folder.
pub(crate) struct Line {
    command: Command,
    shown: String,
}

impl Line {
    /// A line that starts `program`.
    pub(crate) fn new(program: &str) -> Self {
        let mut command = Command::new(program);
        command.current_dir(crate::root());
        Self {
            command,
            shown: program.to_owned(),
        }
    }

    /// A line that starts the cargo this program was started by.
    ///
    /// The toolchain file decides the toolchain; the build folder is the same for every line.
    pub(crate) fn cargo() -> Self {
        let program = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
        let mut line = Self::new(&program);
        line.command.env("CARGO_TARGET_DIR", crate::target_dir());
        line.shown = "cargo".to_owned();
        line
    }

    /// Adds arguments.
    pub(crate) fn args<'a>(mut self, args: impl IntoIterator<Item = &'a str>) -> Self {
        for arg in args {
            self.command.arg(arg);
            self.shown.push(' ');
            self.shown.push_str(&quoted(arg));
        }
        self
    }

    /// Sets an environment variable, shown in front of the line.
    pub(crate) fn env(mut self, name: &str, value: impl AsRef<OsStr>) -> Self {
        let value = value.as_ref();
        self.shown = format!("{name}={} {}", quoted(&value.to_string_lossy()), self.shown);
        self.command.env(name, value);
        self
    }

    /// Runs it with its output going to the terminal.
    pub(crate) fn run(mut self) -> Result<(), Failure> {
        eprintln!("$ {}", self.shown);
        let status = self.command.status();
        self.judge(status)
    }

    /// Runs it and adds what it printed to `printed`, after the line itself.
    pub(crate) fn run_into(mut self, printed: &mut String) -> Result<(), Failure> {
        let outcome = self.command.stdin(Stdio::null()).output();
        let texts = outcome.iter().flat_map(|output| [&output.stdout, &output.stderr]);
        *printed += &format!("$ {}\n", self.shown);
        texts.for_each(|text| *printed += &String::from_utf8_lossy(text));
        self.judge(outcome.map(|output| output.status))
    }

    fn judge(self, outcome: io::Result<ExitStatus>) -> Result<(), Failure> {
        let why = match outcome {
            Ok(status) if status.success() => return Ok(()),
            Ok(status) => format!("the command ended with {status}"),
            Err(error) => format!("the command could not be started: {error}"),
        };
        Err(Failure::Command { shown: self.shown, why })
    }

    /// Runs it and gives what it wrote to standard output; errors go to the terminal.
    pub(crate) fn read(mut self) -> Result<String, Failure> {
        let outcome = self.command.stdin(Stdio::null()).stderr(Stdio::inherit()).output();
        let text = outcome
            .iter()
            .map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
        let text = text.collect();
        self.judge(outcome.map(|output| output.status))?;
        Ok(text)
    }

    /// Runs it quietly; gives what it wrote to standard output, or `None` when it is not there or ended with an error.
    pub(crate) fn output(mut self) -> Option<String> {
        let output = self.command.stdin(Stdio::null()).stderr(Stdio::null()).output().ok()?;
        output
            .status
            .success()
            .then(|| String::from_utf8_lossy(&output.stdout).into_owned())
    }
}

/// As a POSIX shell would need it; plain words stay as they are.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=./:,@+".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shown_line_can_be_pasted() {
        let line = Line::cargo()
            .args(["test", "it's here"])
            .env("RUSTDOCFLAGS", "-D warnings");
        assert_eq!(line.shown, r"RUSTDOCFLAGS='-D warnings' cargo test 'it'\''s here'");
    }
}
