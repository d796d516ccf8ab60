//! What moves: clip and time of each instance, blends between clips, and the crowd.
//!
//! One instance is selected, and is all that a single model would be: an `Actor` with mixer, fades and buffers for read-outs. Of the
//! others there is a `Player` (clip and playback) and a place; selecting one exchanges players. Time moves all by the same seconds, each
//! in its own clip. Speed and ends are for all; clip, range and blends are for one. Clips, times and places are hashed from seed and
//! index, so a crowd grows without moving anybody, and a view restores it from count, seed and selection.

pub(super) mod actor;
pub(super) mod crowd;
pub(super) mod crowd_cache;
pub(super) mod instances;
pub(super) mod mixer;
pub(super) mod player;
pub(super) mod playing;
