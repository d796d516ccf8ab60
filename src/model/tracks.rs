//! All tracks of a clip.

use std::ops::Deref;

use super::track_group::TrackGroup;
use super::{JointLanes, Track};

/// The tracks of a clip, one per joint in the skeleton's order: a slice of [`Track`] to read.
///
/// Beside them it keeps the same motion in groups of four joints, as `anim::sample` wants it; both are made at once from
/// the tracks, so they cannot differ.
#[derive(Clone, Debug, Default)]
pub struct Tracks {
    tracks: Vec<Track>,
    groups: Vec<TrackGroup>,
}

impl Tracks {
    /// Joints 0 to 3, joints 4 to 7 and so on.
    pub(crate) fn groups(&self) -> &[TrackGroup] {
        &self.groups
    }
}

impl From<Vec<Track>> for Tracks {
    fn from(tracks: Vec<Track>) -> Self {
        let groups = tracks.chunks(JointLanes::COUNT).map(TrackGroup::new).collect();
        Self { tracks, groups }
    }
}

impl Deref for Tracks {
    type Target = [Track];

    fn deref(&self) -> &[Track] {
        &self.tracks
    }
}

impl<'a> IntoIterator for &'a Tracks {
    type Item = &'a Track;
    type IntoIter = std::slice::Iter<'a, Track>;

    fn into_iter(self) -> Self::IntoIter {
        self.tracks.iter()
    }
}
