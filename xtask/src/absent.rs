//! Real files that this machine lacks: the tests list what they could not look at, and the end of the checks says it.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::failure::{Doing as _, Failure};

/// The environment variable that names the list to the tests.
pub(crate) const VARIABLE: &str = "BINDPOSE_ABSENT";

/// The list, emptied at the start. Each test that wants a file of `../shared` in vain adds a line.
pub(crate) struct Absent {
    list: PathBuf,
}

impl Absent {
    /// An empty list.
    pub(crate) fn new() -> Result<Self, Failure> {
        let folder = crate::target_dir();
        fs::create_dir_all(&folder).doing(format!("making {}", folder.display()))?;
        let list = folder.join("absent-files");
        fs::write(&list, "").doing(format!("writing {}", list.display()))?;
        Ok(Self { list })
    }

    /// Where the tests find it.
    pub(crate) fn list(&self) -> &Path {
        &self.list
    }

    /// Says what was not looked at, if anything.
    pub(crate) fn tell(&self) -> Result<(), Failure> {
        let list = fs::read_to_string(&self.list).doing(format!("reading {}", self.list.display()))?;
        eprint!("{}", words(&list));
        Ok(())
    }
}

/// What is said of a list.
fn words(list: &str) -> String {
    let files: BTreeSet<&str> = list.lines().collect();
    if files.is_empty() {
        return String::new();
    }
    let mut words = format!(
        "\nNot everything was looked at: {} tests wanted real files in ../shared that are not there.\n",
        list.lines().count()
    );
    for file in files {
        words.push_str(&format!("    {file}\n"));
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_absent_file_is_said_once() {
        assert_eq!(words(""), "");
        assert_eq!(
            words("models/b.m3d\ntextures\nmodels/b.m3d\n"),
            "\nNot everything was looked at: 3 tests wanted real files in ../shared that are not there.\n    \
             models/b.m3d\n    textures\n"
        );
    }
}
