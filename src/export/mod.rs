//! A model as a file: the books' text format, and glTF's binary form.
//!
//! What a format cannot hold is a [`Loss`]. All losses are known before anything is written.

mod directions;
mod glb;
mod losses;
mod m3d;

use std::collections::BTreeMap;

use crate::diagnostic::collect::counted;
use crate::image::Image;
use crate::model::{MapSlot, Skeleton};

pub use directions::directions;
pub use glb::{glb, glb_in, glb_losses, turned_materials};
pub use m3d::{Bake, Look, looks, m3d, m3d_in, m3d_losses};

pub use crate::model::one_word;

/// A written file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exported {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// What it does not hold, or holds otherwise.
    pub losses: Vec<Loss>,
}

/// Something of a model that a file does not hold, or holds otherwise.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loss {
    /// Its name for programs, for example `vertex-colors`.
    pub code: &'static str,
    /// One sentence for people.
    pub message: String,
    /// How many parts of the model it is about.
    pub count: usize,
}

impl Loss {
    /// A loss that so many parts meet, unless none does: what one of them or several do, and what that means.
    pub(crate) fn counted(code: &'static str, count: usize, [one, many]: [&str; 2], rest: &str) -> Option<Self> {
        let message = format!("{} {rest}", counted(count, one, many));
        (count > 0).then_some(Self { code, message, count })
    }
}

/// Why no file was written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A picture could not be written.
    #[error(transparent)]
    Picture(#[from] crate::image::EncodeError),
    /// Something came out as no finite number.
    #[error("A number overflows: `{place}` of the .glb would be none. Smaller lengths, by `--scale`, may do.")]
    NotFinite {
        /// JSON pointer.
        place: String,
    },
    /// The sizes of a file's parts are written in 32 bits.
    #[error("The file would have more than 4 GiB.")]
    TooLarge,
    /// A vertex of glTF names its joints in 16 bits.
    #[error("The model has {0} joints; vertices of a .glb can name {most} at most.", most = Skeleton::MOST_NAMED)]
    TooManyJoints(usize),
}

/// Decoded pictures by the material and what it uses them for. What is not there is left out of a `.glb`.
pub type MapImages<'a> = BTreeMap<(usize, MapSlot), &'a Image>;

/// The files that decoded pictures were read from, as far as they are known.
pub type MapSources = BTreeMap<(usize, MapSlot), bytes::Bytes>;
