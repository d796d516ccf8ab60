//! What the timeline remembers: what is open, which part of the time is visible, which keys are chosen.

use std::collections::BTreeSet;

use super::axis::SeenTime;
use super::curves::Curves;
use super::loop_gap::LoopGapReading;
use crate::model::{Clip, JointIndex};
use crate::session::Session;
use crate::ui::timeline::sheet::rows::Rows;

/// Height of the sheet until its edge is dragged …
const FIRST_HEIGHT: f32 = 264.0;
/// … or less: in a small window the model keeps this much of the room for the panel …
const KEPT_HEIGHT: f32 = 150.0;
/// … and the sheet has this fraction of the rest.
const FIRST_FRACTION: f32 = 0.4;
/// The least height of the sheet.
const LEAST_HEIGHT: f32 = 132.0;
/// The most that it can be dragged to, as a fraction of the room for the panel. The view keeps the rest.
const MOST_FRACTION: f32 = 0.54;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum SheetTab {
    #[default]
    Keys,
    Curves,
}

/// The sheets, by the names that they have in links.
const SHEETS: [(&str, SheetTab); 2] = [("keys", SheetTab::Keys), ("curves", SheetTab::Curves)];

/// What the timeline remembers. Nothing here changes the model or the picture of it.
#[derive(Debug, Default)]
pub(in crate::ui) struct TimelineState {
    pub(super) open: bool,
    pub(super) dragged_height: Option<f32>,
    pub(super) tab: SheetTab,
    pub(super) seen: SeenTime,
    pub(super) rows: Rows,
    pub(super) curves: Curves,
    pub(super) key_box: Option<KeyBox>,
    pub(super) loop_gap: LoopGapReading,
    /// The joint whose row is under the pointer in this pass.
    pub(super) hovered: Option<JointIndex>,
    /// The selected joint to whose row the sheet has scrolled.
    pub(super) revealed: Option<JointIndex>,
    /// The cell of the dope sheet that has the keyboard.
    pub(super) cursor: Option<KeyCursor>,
    /// The frames in which the dope sheet was opened and was shown last.
    keys_opened_in: u64,
    keys_shown_in: Option<u64>,
    of: Option<(u64, usize)>,
    head_was_seen: bool,
}

impl TimelineState {
    /// The name of the sheet that is open.
    pub(in crate::ui) fn open_sheet(&self) -> Option<&'static str> {
        let mut open = SHEETS.iter().filter(|(_, tab)| self.open && *tab == self.tab);
        open.next().map(|(name, _)| *name)
    }

    /// Whether a sheet has this name.
    pub(in crate::ui) fn has_sheet(name: &str) -> bool {
        SHEETS.iter().any(|(sheet, _)| *sheet == name)
    }

    /// Opens the sheet that is among these names, or none.
    pub(in crate::ui) fn open_this_sheet(&mut self, names: &[String]) {
        let named = SHEETS.iter().find(|(sheet, _)| names.iter().any(|name| name == sheet));
        self.open = named.is_some();
        self.tab = named.map_or(self.tab, |(_, tab)| *tab);
    }

    /// Resets what belonged to another clip or model, and follows the play head.
    pub(in crate::ui) fn update(&mut self, session: &Session) {
        self.hovered = None;
        self.loop_gap.update(session);
        let (Some(index), Some(clip)) = (session.clip_index(), session.clip()) else {
            return;
        };
        let of = Some((session.clips_revision(), index));
        if self.of != of {
            self.seen.show_all();
            self.key_box = None;
            self.cursor = None;
            self.of = of;
        }
        self.follow(session, clip);
    }

    /// With Shift the keys between where the cell was and where it is are chosen, from where it was when Shift began. Without they are let
    /// go. `chose`: Shift had chosen some before.
    pub(super) fn choose_keys<'a>(
        &mut self,
        (shift, chose): (bool, bool),
        [from, to]: [Corner; 2],
        joints_of: impl Fn(usize) -> Option<&'a [JointIndex]>,
    ) {
        if shift {
            let key_box = match &mut self.key_box {
                Some(key_box) if chose => key_box,
                key_box => key_box.insert(KeyBox::at(from)),
            };
            key_box.stretch(to, joints_of);
        } else {
            self.key_box = None;
        }
    }

    /// Notes that the dope sheet is shown in a frame. Returns whether it was opened in it.
    pub(super) fn keys_open(&mut self, frame: u64) -> bool {
        if self.keys_shown_in.is_none_or(|last| last + 1 < frame) {
            self.keys_opened_in = frame;
        }
        self.keys_shown_in = Some(frame);
        self.keys_opened_in == frame
    }

    /// Scrolls on when the play head leaves the view while it plays.
    fn follow(&mut self, session: &Session, clip: &Clip) {
        let time_secs = session.playback().time_secs();
        let whole_secs = [clip.start_secs, clip.end_secs];
        let [start_secs, end_secs] = self.seen.span_secs(whole_secs);
        let seen = (start_secs..=end_secs).contains(&time_secs);
        if !seen && self.head_was_seen && session.is_animating() {
            let length_secs = end_secs - start_secs;
            let start_secs = if session.playback().is_backward() {
                time_secs - length_secs
            } else {
                time_secs
            };
            let frame_secs = 1.0 / clip.keys_per_sec;
            self.seen
                .show(whole_secs, frame_secs, [start_secs, start_secs + length_secs]);
        } else {
            self.head_was_seen = seen;
        }
    }

    /// The joint whose row is under the pointer.
    pub(in crate::ui) fn hovered(&self) -> Option<JointIndex> {
        self.hovered
    }

    /// Whether keys were chosen with a box.
    pub(in crate::ui) fn has_chosen_keys(&self) -> bool {
        self.key_box.is_some()
    }

    pub(in crate::ui) fn let_go_of_keys(&mut self) {
        self.key_box = None;
    }

    /// Height of the sheet in a wide window, while it is open. `room`: the most that its panel can have.
    pub(super) fn sheet_height(&self, room: f32) -> Option<f32> {
        let most = (MOST_FRACTION * room).max(LEAST_HEIGHT);
        let height = self
            .dragged_height
            .unwrap_or(FIRST_HEIGHT.min(FIRST_FRACTION * (room - KEPT_HEIGHT)));
        self.open.then(|| height.clamp(LEAST_HEIGHT, most))
    }

    /// Sets the height from a drag. The sheet closes when it is too low.
    pub(super) fn drag_height(&mut self, height: f32) {
        self.open = height > 0.5 * LEAST_HEIGHT;
        self.dragged_height = Some(height);
    }

    /// After a drag, clamps the height.
    pub(super) fn settle_height(&mut self, room: f32) {
        self.dragged_height = self.sheet_height(room);
    }
}

/// A time, and a row with its fraction.
pub(super) type Corner = (f32, f32);

/// A time span, and the joints whose keys in it are chosen.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct KeyBox {
    /// Where the drag began.
    pub(super) from: Corner,
    /// Start and end, in order.
    pub(super) span_secs: [f32; 2],
    /// The joints of the rows that it covers.
    pub(super) joints: BTreeSet<JointIndex>,
}

impl KeyBox {
    pub(super) fn at(from: Corner) -> Self {
        Self {
            from,
            span_secs: [from.0; 2],
            joints: BTreeSet::new(),
        }
    }

    pub(super) fn stretch<'a>(
        &mut self,
        (time_secs, row): Corner,
        joints_of: impl Fn(usize) -> Option<&'a [JointIndex]>,
    ) {
        let (from_secs, from_row) = self.from;
        self.span_secs = [from_secs.min(time_secs), from_secs.max(time_secs)];
        let [first, last] = [from_row.min(row), from_row.max(row)].map(|row| row.max(0.0) as usize);
        self.joints = (first..=last).map_while(joints_of).flatten().copied().collect();
    }

    /// The range of a joint's key times that are in it.
    pub(super) fn part_of(&self, joint: JointIndex, times_secs: &[f32]) -> std::ops::Range<usize> {
        if !self.joints.contains(&joint) {
            return 0..0;
        }
        self.span_of(times_secs)
    }

    /// The range of merged key times of several joints that are in it. Empty if it has none of these joints.
    pub(super) fn part_of_any(
        &self,
        is_among: impl Fn(JointIndex) -> bool,
        times_secs: &[f32],
    ) -> std::ops::Range<usize> {
        if !self.joints.iter().any(|&joint| is_among(joint)) {
            return 0..0;
        }
        self.span_of(times_secs)
    }

    fn span_of(&self, times_secs: &[f32]) -> std::ops::Range<usize> {
        let [start_secs, end_secs] = self.span_secs;
        let first = times_secs.partition_point(|&secs| secs < start_secs);
        let end = times_secs.partition_point(|&secs| secs <= end_secs);
        first..end.max(first)
    }

    pub(super) fn count(&self, session: &Session) -> usize {
        let in_box = |&joint: &JointIndex| self.part_of(joint, session.key_times(Some(joint))).len();
        self.joints.iter().map(in_box).sum()
    }
}

/// The cell of the dope sheet that has the keyboard.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct KeyCursor {
    pub(super) joint: JointIndex,
    /// The time of its key. None is the name of the row.
    pub(super) key_secs: Option<f32>,
    /// The time that up and down look for in each row.
    pub(super) wanted_secs: Option<f32>,
    /// Whether Shift has chosen keys since it moved without.
    pub(super) chooses: bool,
}

impl KeyCursor {
    /// At a key of a row, or at its name.
    pub(super) fn at(joint: JointIndex, key_secs: Option<f32>) -> Self {
        Self {
            joint,
            key_secs,
            wanted_secs: key_secs,
            chooses: false,
        }
    }
}
