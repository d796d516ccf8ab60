//! The passes of a window: time goes on, what would differ is drawn, and whoever has the window hears when the next pass is due.

use super::SessionPainter;
use crate::render::Compositor;
use crate::session::Session;

/// Longest step of time: a window that was asleep goes on where it was.
const MAX_STEP_SECS: f32 = 0.25;
/// Between two steps of what is prepared while nothing moves, so that input comes first.
const PREPARE_PAUSE_SECS: f32 = 0.02;

/// When the next pass of a window is due, unless input or the waker asks for one before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NextPass {
    AtOnce,
    After {
        secs: f32,
    },
    /// None is due. After this time [`SessionPainter::prepares`] can go on with what may be asked for next; a pass does so too.
    ToPrepare {
        secs: f32,
    },
    WhenAsked,
}

/// What became of a pass.
#[derive(Clone, Copy, Debug)]
pub struct Pass {
    pub next: NextPass,
    /// Whether the compositor may show something else than before.
    pub is_new: bool,
}

impl SessionPainter {
    /// A pass begins, `dt_secs` after the one before: what moved then goes on.
    pub fn begin_pass(&self, session: &mut Session, dt_secs: f32) {
        session.begin_pass(dt_secs);
        session.advance(if self.was_moving {
            dt_secs.min(MAX_STEP_SECS)
        } else {
            0.0
        });
    }

    /// All commands of a pass were applied: draws for a window of this size in pixels. A pass that `had_input` leaves for later what can wait.
    pub fn end_pass(
        &mut self,
        session: &mut Session,
        window: [f32; 2],
        compositor: &mut Compositor,
        had_input: bool,
    ) -> Pass {
        session.follow_motion();
        let adds_samples = self.is_sampling(session);
        let cost = self.draw(session, window, compositor);
        let goes_on = cost.is_some_and(|cost| session.frame_drawn(cost));
        self.was_moving = session.is_moving();
        let next = if goes_on || self.was_moving || !self.is_current(session) || self.is_sampling(session) {
            NextPass::AtOnce
        } else if let Some(secs) = session.quality().rests_in_secs() {
            NextPass::After { secs }
        } else {
            // What is being opened will want other pipelines, and must not wait for these.
            let is_idle = cost.is_none() && !session.is_opening() && !had_input;
            if self.prepares(session, is_idle) {
                NextPass::ToPrepare {
                    secs: PREPARE_PAUSE_SECS,
                }
            } else {
                NextPass::WhenAsked
            }
        };
        Pass {
            next,
            is_new: cost.is_some() || adds_samples,
        }
    }
}
