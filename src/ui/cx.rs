//! What the functions of a pass hand down to each other.

use crate::actions::Action;
use crate::session::{Command, PlayCommand, Session};

/// What is shown, what the interface remembers of it (all, or the part of one panel), and what the person asks for.
pub(super) struct Cx<'a, S> {
    pub(super) session: &'a Session,
    pub(super) state: &'a mut S,
    pub(super) commands: &'a mut Vec<Command>,
}

impl<S> Cx<'_, S> {
    pub(super) fn push(&mut self, command: impl Into<Command>) {
        self.commands.push(command.into());
    }

    /// Does what an action of the session does now, if anything.
    pub(super) fn act(&mut self, action: &Action) {
        self.commands.extend(action.command(self.session));
    }

    /// Pauses at a time. A clip that played on would leave it at once.
    pub(super) fn pause_at(&mut self, time_secs: f32) {
        self.push(PlayCommand::Pause);
        self.push(PlayCommand::Seek { time_secs });
    }

    /// The same with a part of the state.
    pub(super) fn part<T>(&mut self, part: impl FnOnce(&mut S) -> &mut T) -> Cx<'_, T> {
        Cx {
            session: self.session,
            state: part(self.state),
            commands: self.commands,
        }
    }
}
