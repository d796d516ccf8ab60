//! Several instances of the open model, each with a clip and a time of its own.

use super::Session;

/// The most instances in a crowd.
pub const MAX_CROWD: usize = 1_000;

/// A command about the instances of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CrowdCommand {
    /// Shows this many instances, clamped to 1…[`MAX_CROWD`]; clips, times and places come from a seed. The first stays where it is and as
    /// it is.
    Set {
        /// Instances, with the first.
        count: usize,
        /// The same seed, the same crowd.
        seed: u32,
    },
    /// Makes an instance the one that is selected: timeline, skeleton and read-outs are of it. An instance that is not there is ignored.
    Select(usize),
}

/// How many instances there are, and which is selected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CrowdState {
    /// Instances; 1 is the model alone.
    pub count: usize,
    /// What clips, times and places come from.
    pub seed: u32,
    /// The one that timeline, skeleton and read-outs are of.
    pub selected: usize,
}

impl Default for CrowdState {
    fn default() -> Self {
        Self {
            count: 1,
            seed: 1,
            selected: 0,
        }
    }
}

impl Session {
    /// How many instances of the model there are, and which is selected.
    pub fn crowd(&self) -> CrowdState {
        self.crowd
    }

    pub(super) fn apply_to_crowd(&mut self, command: CrowdCommand) {
        match command {
            CrowdCommand::Set { count, seed } => {
                (self.crowd.count, self.crowd.seed) = (count.clamp(1, MAX_CROWD), seed);
                self.crowd.selected = self.crowd.selected.min(self.crowd.count - 1);
            }
            CrowdCommand::Select(instance) if instance < self.crowd.count => self.crowd.selected = instance,
            CrowdCommand::Select(_) => {}
        }
    }
}
