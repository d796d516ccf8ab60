//! Runs the program, and finds files for it.

use std::ffi::OsStr;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

/// The binary under test, without arguments.
pub(crate) fn bindpose() -> Command {
    Command::new(env!("CARGO_BIN_EXE_bindpose"))
}

/// What came of a run.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

/// The arguments of a command line, none of which has a blank in it.
pub(crate) fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

/// Runs it to its end.
pub(crate) fn run(arguments: impl IntoIterator<Item = impl AsRef<OsStr>>) -> Run {
    run_command(bindpose().args(arguments))
}

/// Likewise, with an environment of the caller's.
pub(crate) fn run_command(command: &mut Command) -> Run {
    Run::of(command.output().expect("the binary was built for this test"))
}

/// Likewise, with bytes on standard input.
pub(crate) fn run_with_input(command: &mut Command, input: &[u8]) -> Run {
    let pipes = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = pipes.spawn().expect("the binary was built for this test");
    // It may refuse before it has read all.
    let _ = child.stdin.take().expect("piped").write_all(input);
    Run::of(child.wait_with_output().expect("it ends"))
}

impl Run {
    pub(crate) fn of(output: Output) -> Self {
        Self {
            code: output.status.code(),
            out: String::from_utf8(output.stdout).expect("prints UTF-8"),
            err: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }

    /// Standard output of a run in which all was well.
    pub(crate) fn fine(self) -> String {
        assert_eq!(self.code, Some(0), "{self:?}");
        self.out
    }

    /// What is said by a run that ends with this code and gives nothing.
    #[track_caller]
    pub(crate) fn refused(&self, code: i32) -> &str {
        assert_eq!((self.code, self.out.as_str()), (Some(code), ""), "{self:?}");
        &self.err
    }

    /// The same, where these words are among what is said.
    #[track_caller]
    pub(crate) fn refused_with(&self, code: i32, words: &str) {
        assert!(self.refused(code).contains(words), "{words} is not in {self:?}");
    }

    /// The same as JSON.
    pub(crate) fn json(self) -> Value {
        let code = self.code;
        assert!(matches!(code, Some(0 | 1)), "{self:?}");
        serde_json::from_str(&self.out).unwrap_or_else(|error| panic!("{error} in {}", self.out))
    }
}

/// A file of `tests/fixtures`, as an argument.
pub(crate) fn fixture(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name);
    assert!(path.is_file(), "{} is missing", path.display());
    path.into_os_string()
        .into_string()
        .expect("the checkout's path is UTF-8")
}

/// All models of a folder of `tests/fixtures`, in order.
pub(crate) fn fixtures(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/fixtures")
        .join(folder);
    let entries = std::fs::read_dir(&folder).expect("the fixtures are there");
    let mut models: Vec<PathBuf> = entries
        .map(|entry| entry.expect("can be listed").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "m3d"))
        .collect();
    models.sort();
    assert!(models.len() > 20, "{} is nearly empty", folder.display());
    models
}

/// The sample: skinned, several clips, thousands of vertices.
pub(crate) const FIGURE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/web/sample/figure.m3d");

/// A file of the folder of real files, where that is beside the checkout.
pub(crate) fn shared(path: &str) -> Option<String> {
    crate::shared::shared(path).map(|path| path.display().to_string())
}

/// A path to write to, of this test alone.
pub(crate) fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cli");
    std::fs::create_dir_all(&folder).expect("the target folder can be written");
    let path = folder.join(name);
    if path.is_dir() {
        std::fs::remove_dir_all(&path).expect("was made by an earlier run");
    } else if path.exists() {
        std::fs::remove_file(&path).expect("was written by an earlier run");
    }
    path
}

/// Likewise, as an argument.
pub(crate) fn scratch_name(name: &str) -> String {
    scratch(name).into_os_string().into_string().expect("UTF-8")
}

/// A file of this test alone, as an argument.
pub(crate) fn scratch_file(name: &str, bytes: impl AsRef<[u8]>) -> String {
    let path = scratch_name(name);
    std::fs::write(&path, bytes).expect("the target folder can be written");
    path
}

/// An empty folder of this test alone.
pub(crate) fn scratch_folder(name: &str) -> PathBuf {
    let path = scratch(name);
    std::fs::create_dir_all(&path).expect("the target folder can be written");
    path
}

/// The text of a file of `tests/fixtures`.
pub(crate) fn fixture_text(name: &str) -> String {
    std::fs::read_to_string(fixture(name)).expect("is text")
}
