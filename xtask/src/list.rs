//! What tests tell the checks, a line each, in a file that they are told of by an environment variable.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use crate::failure::{Doing as _, Failure};

/// A list that tests add lines to.
pub(crate) struct List {
    path: PathBuf,
}

impl List {
    /// An empty list in a file of this name.
    pub(crate) fn new(name: &str) -> Result<Self, Failure> {
        let folder = crate::target_dir();
        fs::create_dir_all(&folder).doing(format!("making {}", folder.display()))?;
        let path = folder.join(name);
        fs::write(&path, "").doing(format!("writing {}", path.display()))?;
        Ok(Self { path })
    }

    /// Where the tests find it.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// What they wrote.
    pub(crate) fn read(&self) -> Result<String, Failure> {
        fs::read_to_string(&self.path).doing(format!("reading {}", self.path.display()))
    }

    /// Adds a line.
    pub(crate) fn add(&self, line: &str) -> Result<(), Failure> {
        let open = fs::OpenOptions::new().append(true).open(&self.path);
        open.and_then(|mut file| writeln!(file, "{line}"))
            .doing(format!("writing {}", self.path.display()))
    }
}
