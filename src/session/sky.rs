//! The sky: a cube map that was dropped.

use std::sync::Arc;

use super::{File, Session};
use crate::diagnostic::Diagnostic;
use crate::image::{self, Image};
use crate::scene::Background;

/// The sky of a session. It belongs to no model, and stays when another opens.
#[derive(Clone, Debug, Default)]
pub(super) struct Sky {
    taken: Option<Taken>,
    notices: Vec<Diagnostic>,
    revision: u64,
}

#[derive(Clone, Debug)]
struct Taken {
    file: File,
    image: Arc<Image>,
    /// What was behind the model before there was a sky.
    background_before: Background,
}

impl Sky {
    pub(super) fn revision(&self) -> u64 {
        self.revision
    }

    /// Becomes another sky than one that came before it.
    pub(super) fn follow(&mut self, other: &Self) {
        self.revision = other.revision + 1;
    }

    /// Cube maps that could not be read.
    pub(super) fn notices(&self) -> &[Diagnostic] {
        &self.notices
    }
}

impl Session {
    /// The cube map that is the sky.
    pub fn sky(&self) -> Option<&Arc<Image>> {
        self.sky.taken.as_ref().map(|taken| &taken.image)
    }

    /// The file of the sky.
    pub fn sky_file(&self) -> Option<&File> {
        self.sky.taken.as_ref().map(|taken| &taken.file)
    }

    /// Counts changes of the sky: another number, another sky.
    pub fn sky_revision(&self) -> u64 {
        self.sky.revision
    }

    /// Makes the largest of these cube maps the sky, and shows it. Those that cannot be read are noted, and the next largest
    /// taken. Without any everything stays.
    pub(super) fn take_up_sky(&mut self, mut cubes: Vec<File>) {
        if cubes.is_empty() {
            return;
        }
        cubes.sort_by_key(|file| std::cmp::Reverse((image::cube_side(&file.bytes), file.bytes.len())));
        self.sky.notices.clear();
        let mut has_sky = false;
        for file in cubes {
            if has_sky {
                let unreadable = image::check(&file.bytes, file.base_name()).err();
                self.sky.notices.extend(unreadable.map(|error| error.diagnostic()));
                continue;
            }
            if self.sky_file() == Some(&file) {
                // The folder came again; what was chosen since stays.
                has_sky = true;
                continue;
            }
            match image::decode(&file.bytes, file.base_name()) {
                Ok(image) => {
                    let before = self.sky.taken.take();
                    self.sky.taken = Some(Taken {
                        file,
                        image: Arc::new(image),
                        background_before: before.map_or(self.look.background, |taken| taken.background_before),
                    });
                    self.sky.revision += 1;
                    self.look.background = Background::Sky;
                    has_sky = true;
                }
                Err(error) => self.sky.notices.push(error.diagnostic()),
            }
        }
    }

    pub(super) fn clear_sky(&mut self) {
        self.sky.notices.clear();
        if let Some(taken) = self.sky.taken.take() {
            self.sky.revision += 1;
            if self.look.background == Background::Sky {
                self.look.background = taken.background_before;
            }
        }
    }
}
