//! What moves: clip and time of each instance, blends between clips, and the crowd.

pub(super) mod actor;
pub(super) mod crowd;
pub(super) mod crowd_cache;
pub(super) mod instances;
pub(super) mod mixer;
pub(super) mod player;
pub(super) mod playing;
