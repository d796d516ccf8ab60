//! Named motions.

use glam::{Quat, Vec3};

/// A named motion: one track per joint, in the skeleton's order.
#[derive(Clone, Debug, Default)]
pub struct Clip {
    /// Name to show, unique in the model.
    pub name: String,
    /// One per joint.
    pub tracks: Vec<Track>,
    /// Least key time of all tracks.
    pub start_secs: f32,
    /// Greatest key time of all tracks.
    pub end_secs: f32,
    /// Keys a second of the densest track: the unit of a frame. 30 when no track has two keys.
    pub keys_per_sec: f32,
    /// Number of keys the file has for it.
    pub key_count: usize,
}

impl Clip {
    /// Length in seconds, 0 or more.
    pub fn duration_secs(&self) -> f32 {
        self.end_secs - self.start_secs
    }
}

/// Keys of one joint relative to its parent. Times are in seconds and strictly increasing; there is at least one key, and
/// all streams have one length. Outside its range a track holds its first or last value, since the tracks of a clip may
/// end at different times. Rotations are unit quaternions, neighbours on the same side.
#[derive(Clone, Debug, Default)]
pub struct Track {
    pub(super) times_secs: Vec<f32>,
    pub(super) translations: Vec<Vec3>,
    pub(super) rotations: Vec<Quat>,
    pub(super) scales: Vec<Vec3>,
}

impl Track {
    /// Key times in seconds, strictly increasing.
    pub fn times_secs(&self) -> &[f32] {
        &self.times_secs
    }
    /// Translation of each key.
    pub fn translations(&self) -> &[Vec3] {
        &self.translations
    }
    /// Unit rotation of each key.
    pub fn rotations(&self) -> &[Quat] {
        &self.rotations
    }
    /// Scale of each key.
    pub fn scales(&self) -> &[Vec3] {
        &self.scales
    }
}
