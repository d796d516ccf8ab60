//! What a command or a step of time changed, and counters of these changes for caches.
//!
//! A counter for each kind serves any number of readers; flags would have to be taken and cleared by each of them. A test plays random
//! commands and looks for a frame that differs without being told.

use std::ops::BitOrAssign;

/// What is different from before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Changes {
    /// Another model is open, or none.
    pub model: bool,
    /// Other clips stand under the indices of the clips. Clips that were only added at the end do not count.
    pub clips: bool,
    /// Other images are used as the materials' maps.
    pub maps: bool,
    /// Another sky, or none.
    pub sky: bool,
    /// The materials that are drawn, including those of another model.
    pub materials: bool,
    /// The names of joints.
    pub names: bool,
    /// The pose of the model.
    pub pose: bool,
    /// Which clips there are, which one plays and how: range, speed, what happens at the end.
    pub playback: bool,
    /// What is drawn of the model, its light and its ground: all of the picture but what lies over it.
    pub scene: bool,
    /// The picture. True whenever one of the others changed what is seen.
    pub picture: bool,
}

impl Changes {
    const NONE: Self = Self {
        model: false,
        clips: false,
        maps: false,
        sky: false,
        materials: false,
        names: false,
        pose: false,
        playback: false,
        scene: false,
        picture: false,
    };

    /// All that belongs to a model, but for the names: they may stay when the same file opens again.
    pub(super) const MODEL: Self = Self {
        model: true,
        clips: true,
        maps: true,
        materials: true,
        pose: true,
        scene: true,
        picture: true,
        ..Self::NONE
    };

    pub(super) const CONTENT: Self = Self {
        sky: true,
        names: true,
        ..Self::MODEL
    };

    /// Whether a renderer has something to upload, beside the pose and the values of materials.
    pub(super) fn need_upload(self) -> bool {
        self.model || self.maps || self.sky
    }

    /// Returns what was recorded, and clears it.
    pub(super) fn take(&mut self) -> Self {
        std::mem::take(self)
    }
}

impl BitOrAssign for Changes {
    fn bitor_assign(&mut self, other: Self) {
        self.model |= other.model;
        self.clips |= other.clips;
        self.maps |= other.maps;
        self.sky |= other.sky;
        self.materials |= other.materials;
        self.names |= other.names;
        self.pose |= other.pose;
        self.playback |= other.playback;
        self.scene |= other.scene;
        self.picture |= other.picture;
    }
}

/// Counts changes of each kind since the session began. A cache keeps the number that it was filled at, and is filled again when
/// the number differs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Revisions {
    pub(super) model: u64,
    pub(super) clips: u64,
    pub(super) maps: u64,
    pub(super) sky: u64,
    pub(super) materials: u64,
    pub(super) names: u64,
    pub(super) pose: u64,
    pub(super) scene: u64,
    pub(super) picture: u64,
    pub(super) openings: u64,
    pub(super) beginnings: u64,
}

impl Revisions {
    pub(super) fn count(&mut self, changes: Changes) {
        self.model += u64::from(changes.model);
        self.clips += u64::from(changes.clips);
        self.maps += u64::from(changes.maps);
        self.sky += u64::from(changes.sky);
        self.materials += u64::from(changes.materials);
        self.names += u64::from(changes.names);
        self.pose += u64::from(changes.pose);
        self.scene += u64::from(changes.scene);
        self.picture += u64::from(changes.picture);
    }
}
