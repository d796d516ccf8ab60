//! What becomes of a file in a book's demo, in a few words.

use std::fmt;

/// What a book's demo does with a file, in words that go on after its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It shows it, once maps lie beside it.
    Shows {
        /// How many maps are missing; all that the materials name where nobody looked for them.
        missing_maps: usize,
    },
    /// It reads it, and ends with an error before it shows anything.
    EndsWithError,
    /// It reads it, and crashes at its first frame.
    Crashes,
    /// It does not read it as it is meant.
    CannotRead,
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Shows { missing_maps: 0 } => "shows it",
            Self::Shows { missing_maps: 1 } => "shows it, if this map lies beside it",
            Self::Shows { missing_maps } => return write!(f, "shows it, if these {missing_maps} maps lie beside it"),
            Self::EndsWithError => "would end with an error",
            Self::Crashes => "would crash at its first frame",
            Self::CannotRead => "cannot read it",
        })
    }
}
