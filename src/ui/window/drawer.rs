//! The height of the drawer of a narrow window: it follows the finger, and comes to rest at one of three heights or shuts.

use egui::{Context, Id, Response, Ui};
use glam::Vec2;

use crate::gestures::DragTrail;
use crate::ui::kit::arrow_steps;

/// Heights of a page, as fractions of the window's: a look inside, half, and for keys over time a little more.
const PEEK: f32 = 0.22;
const HALF: f32 = 0.47;
const HALF_OF_TIMELINE: f32 = 0.56;
/// The least height of a page while it opens.
const LEAST_PAGE: f32 = 96.0;
/// A finger that lets go faster than this flings the drawer, in points a second.
const FLING_PER_SEC: f32 = 400.0;
/// How long the drawer takes to come to rest.
const SETTLE_SECS: f32 = 0.16;

/// Where the drawer rests.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rest {
    Peek,
    #[default]
    Half,
    Full,
}

/// The height of the page that is open, in points.
#[derive(Debug, Default)]
pub(in crate::ui) struct DrawerHeight {
    rest: Rest,
    /// The height while a finger holds the handle.
    dragged: Option<f32>,
    trail: DragTrail,
    /// The height of the strip below the page.
    pub(in crate::ui) strip: f32,
}

/// The heights at which a page can rest, no higher than `most`.
#[derive(Clone, Copy, Debug)]
pub struct Heights([f32; 3]);

impl Heights {
    /// `of_timeline`: of the page with keys over time.
    pub fn new(of_timeline: bool, window_height: f32, most: f32) -> Self {
        let half = if of_timeline { HALF_OF_TIMELINE } else { HALF };
        Self([PEEK * window_height, half * window_height, most].map(|height| height.min(most).max(0.0)))
    }

    fn of(self, rest: Rest) -> f32 {
        let Self([peek, half, full]) = self;
        match rest {
            Rest::Peek => peek,
            Rest::Half => half,
            Rest::Full => full,
        }
    }
}

impl DrawerHeight {
    /// The height that the page has in this pass, and the one at which it rests.
    pub(in crate::ui) fn now(&self, ctx: &Context, heights: Heights, still: bool) -> (f32, f32) {
        let rest = heights.of(self.rest);
        let (wanted, secs) = match self.dragged {
            Some(height) => (height, 0.0),
            None => (rest, if still { 0.0 } else { SETTLE_SECS }),
        };
        let now = ctx.animate_value_with_time(motion_id(), wanted, secs);
        (now.max(LEAST_PAGE.min(wanted)), rest)
    }

    /// While no page is open.
    pub(in crate::ui) fn shut(&mut self, ctx: &Context) {
        self.rest = Rest::Half;
        ctx.animate_value_with_time(motion_id(), 0.0, 0.0);
    }

    /// Follows the handle of a page that is open or not. Returns whether it is open now.
    pub(in crate::ui) fn drag(&mut self, ui: &Ui, handle: &Response, heights: Heights, mut open: bool) -> bool {
        let now_secs = ui.input(|input| input.time);
        if handle.drag_started() {
            self.trail.clear();
            self.dragged = Some(if open { heights.of(self.rest) } else { 0.0 });
        }
        if let Some(height) = self.dragged {
            let moved = handle.drag_delta().y;
            self.trail.add(now_secs, Vec2::new(0.0, moved));
            let height = (height - moved).clamp(0.0, heights.of(Rest::Full));
            self.dragged = Some(height);
            open |= height > 0.0;
        }
        if handle.drag_stopped() || (self.dragged.is_some() && !handle.dragged()) {
            let height = self.dragged.take().unwrap_or_default();
            let rate = self.trail.rate_per_sec(now_secs).y;
            match settle(height, rate, heights) {
                Some(rest) => self.rest = rest,
                None => open = false,
            }
        }
        let steps = arrow_steps(ui, handle);
        if steps > 0.0 {
            self.rest = match self.rest {
                rest if !open => rest,
                Rest::Peek => Rest::Half,
                Rest::Half | Rest::Full => Rest::Full,
            };
            open = true;
        } else if steps < 0.0 {
            match self.rest {
                Rest::Full => self.rest = Rest::Half,
                Rest::Half => self.rest = Rest::Peek,
                Rest::Peek => open = false,
            }
        }
        open
    }
}

/// Where a drawer of a height comes to rest when the finger lets go at a speed, in points a second downward. None: it shuts.
pub fn settle(height: f32, rate: f32, heights: Heights) -> Option<Rest> {
    let stops = [None, Some(Rest::Peek), Some(Rest::Half), Some(Rest::Full)];
    let height_of = |stop: Option<Rest>| stop.map_or(0.0, |rest| heights.of(rest));
    if rate < -FLING_PER_SEC {
        let above = stops.into_iter().find(|&stop| height_of(stop) > height);
        above.unwrap_or(Some(Rest::Full))
    } else if rate > FLING_PER_SEC {
        let below = stops.into_iter().rev().find(|&stop| height_of(stop) < height);
        below.flatten()
    } else {
        let off = |stop: Option<Rest>| (height_of(stop) - height).abs();
        let nearest = stops.into_iter().min_by(|&a, &b| off(a).total_cmp(&off(b)));
        nearest.flatten()
    }
}

fn motion_id() -> Id {
    Id::unique("height of the sheet")
}
