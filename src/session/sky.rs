//! The sky: a cube map that was dropped.

use std::sync::Arc;

use super::files::File;
use crate::diagnostic::Diagnostic;
use crate::image::{self, Image};
use crate::scene::Background;

/// The sky of a session. It belongs to no model, and stays when another opens.
#[derive(Clone, Debug, Default)]
pub(super) struct Sky {
    taken: Option<Taken>,
    diagnostics: Vec<Diagnostic>,
}

#[derive(Clone, Debug)]
struct Taken {
    file: File,
    image: Arc<Image>,
    /// What was behind the model before there was a sky.
    background_before: Background,
}

impl Sky {
    /// Cube maps that could not be read.
    pub(super) fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }

    pub(super) fn image(&self) -> Option<&Arc<Image>> {
        self.taken.as_ref().map(|taken| &taken.image)
    }

    pub(super) fn file(&self) -> Option<&File> {
        self.taken.as_ref().map(|taken| &taken.file)
    }

    /// Makes what was found the sky, and the background of the view. Whether there is another sky now.
    pub(super) fn choose(&mut self, found: FoundSky, background: &mut Background) -> bool {
        self.diagnostics = found.diagnostics;
        let Some((file, image)) = found.image else { return false };
        let before = self.taken.take();
        self.taken = Some(Taken {
            file,
            image,
            background_before: before.map_or(*background, |taken| taken.background_before),
        });
        *background = Background::Sky;
        true
    }

    /// Takes the sky away. The background that was there before it comes back. Whether there was one.
    pub(super) fn clear(&mut self, background: &mut Background) -> bool {
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

/// What became of the cube maps of a drop.
#[derive(Clone, Debug, Default)]
pub(super) struct FoundSky {
    /// The largest that can be read, unless it is the sky already.
    image: Option<(File, Arc<Image>)>,
    /// The largest that can be read is the sky already: the same folder was dropped again, and the background stays as chosen.
    is_kept: bool,
    /// Those that could not be read.
    diagnostics: Vec<Diagnostic>,
}

impl FoundSky {
    /// Whether one was found that is not the sky already.
    pub(super) fn is_another(&self) -> bool {
        self.image.is_some()
    }

    /// Decodes the largest of these cube maps, or else the next largest. `current` is the sky that is there. None without any.
    pub(super) fn among(mut cubes: Vec<File>, current: Option<&File>) -> Option<Self> {
        if cubes.is_empty() {
            return None;
        }
        cubes.sort_by_key(|file| std::cmp::Reverse((image::cube_side(&file.bytes), file.bytes.len())));
        let mut found = Self::default();
        for file in cubes {
            let looked_at = if found.image.is_some() || found.is_kept {
                image::check(&file.bytes, file.base_name())
            } else if current == Some(&file) {
                found.is_kept = true;
                Ok(())
            } else {
                image::decode(&file.bytes, file.base_name())
                    .map(|image| found.image = Some((file.clone(), Arc::new(image))))
            };
            found
                .diagnostics
                .extend(looked_at.err().map(|error| error.diagnostic()));
        }
        Some(found)
    }
}
