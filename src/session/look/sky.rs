//! The sky: a cube map that was dropped.

use std::sync::Arc;

use crate::diagnostic::{Diagnostic, Fault, codes};
use crate::image::{self, Image};
use crate::scene::Background;
use crate::session::open::files::{File, FileSet};
use crate::sorting;

/// The sky of a session. It belongs to no model, and stays when another opens.
#[derive(Clone, Debug, Default)]
pub(in crate::session) struct Sky {
    taken: Option<Arc<Taken>>,
    /// Cube maps that can be the sky, in the order in which they came.
    pub(in crate::session) found: Vec<File>,
    diagnostics: Vec<Diagnostic>,
}

/// A cube map that is the sky, or was it at a step of the history.
#[derive(Clone, Debug)]
pub(in crate::session) struct Taken {
    file: File,
    image: Arc<Image>,
    /// What was behind the model before there was a sky.
    background_before: Background,
}

impl PartialEq for Taken {
    fn eq(&self, other: &Self) -> bool {
        self.file == other.file
    }
}

impl Sky {
    /// Cube maps that could not be read.
    pub(in crate::session) fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }

    pub(in crate::session) fn image(&self) -> Option<&Arc<Image>> {
        self.taken.as_ref().map(|taken| &taken.image)
    }

    pub(in crate::session) fn file(&self) -> Option<&File> {
        self.taken.as_ref().map(|taken| &taken.file)
    }

    /// Notes which cube maps of a drop can be the sky, the largest first, and returns them. What cannot be read is a diagnostic.
    pub(in crate::session) fn note(&mut self, files: &FileSet) -> Vec<File> {
        let unread = files
            .unread()
            .map(|file| codes::IMAGE_UNRECOGNIZED.says(file.unread_words()));
        let mut diagnostics: Vec<_> = unread.collect();
        let mut cubes: Vec<File> = files.cubes().cloned().collect();
        if cubes.is_empty() && diagnostics.is_empty() {
            return cubes;
        }
        sorting::sort_by_key(&mut cubes, |file| {
            std::cmp::Reverse((image::cube_side(&file.bytes), file.bytes.len()))
        });
        cubes.retain(|file| {
            let checked = image::check(&file.bytes, file.base_name());
            let is_sound = checked.is_ok();
            diagnostics.extend(checked.err().map(|fault| *fault));
            is_sound
        });
        for cube in &cubes {
            match self.found.iter_mut().find(|known| known.path == cube.path) {
                Some(known) => known.clone_from(cube),
                None => self.found.push(cube.clone()),
            }
        }
        self.diagnostics = diagnostics;
        cubes
    }

    /// Makes a cube map the sky, and the background of the view. Whether it could be read.
    pub(in crate::session) fn choose(
        &mut self,
        file: File,
        read: Result<Image, Fault>,
        background: &mut Background,
    ) -> bool {
        let image = match read {
            Ok(image) => Arc::new(image),
            Err(fault) => {
                self.diagnostics.push(*fault);
                return false;
            }
        };
        let before = self.taken.as_ref().map(|taken| taken.background_before);
        self.taken = Some(Arc::new(Taken {
            file,
            image,
            background_before: before.unwrap_or(*background),
        }));
        *background = Background::Sky;
        true
    }

    /// What is the sky, for [`Sky::restore`].
    pub(in crate::session) fn taken(&self) -> Option<Arc<Taken>> {
        self.taken.clone()
    }

    /// Brings back what was the sky, or that there was none.
    pub(in crate::session) fn restore(&mut self, taken: Option<Arc<Taken>>, background: &mut Background) {
        self.clear(background);
        if taken.is_some() {
            self.taken = taken;
            *background = Background::Sky;
        }
    }

    /// Takes the sky away. The background that was there before it comes back. Whether there was one.
    pub(in crate::session) fn clear(&mut self, background: &mut Background) -> bool {
        self.diagnostics.clear();
        let taken = self.taken.take();
        if let Some(taken) = &taken
            && *background == Background::Sky
        {
            *background = taken.background_before;
        }
        taken.is_some()
    }
}
