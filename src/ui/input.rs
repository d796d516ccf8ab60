//! Input: its order within a frame, and whether it is typed into a field.
//!
//! Once in a pass egui finds the widget under the pointer and the widget with the focus. So a press and the events after it must not
//! share a pass, nor Tab and the letters after it. A slow frame brings many events at once. It handles them in as many passes as
//! they need.

use std::collections::VecDeque;
use std::num::NonZeroUsize;

use egui::{Context, Event, Id, Key, RawInput, Ui};

use crate::ui::rim::mirror::{self, MirrorAction};

/// The most passes of one frame. Events that are left wait for the next frame.
pub(super) const MOST_PASSES: NonZeroUsize = NonZeroUsize::new(32).unwrap();

/// Holds back events that depend on the result of earlier events, and gives them to later passes.
#[derive(Debug, Default)]
pub(super) struct InputOrder {
    waiting: VecDeque<Event>,
    /// The frame in which the pointer was pressed last.
    pressed_in: Option<u64>,
}

/// A press that is held longer is no click; a finger's is a long press.
const MOST_CLICK_SECS: f64 = 0.8;

impl egui::Plugin for InputOrder {
    fn debug_name(&self) -> &'static str {
        "input order"
    }

    fn input_hook(&mut self, ctx: &Context, input: &mut RawInput) {
        self.waiting.extend(input.events.drain(..));
        let count = first_pass(&self.waiting);
        input.events.extend(self.waiting.drain(..count));
        // A slow frame must not turn a click into a long press: a release in the frame after the press is always a click.
        let frame = ctx.cumulative_frame_nr();
        if input.events.iter().any(|event| Kind::of(event) == Kind::Press) {
            self.pressed_in = Some(frame);
        }
        let is_next = self.pressed_in.is_some_and(|pressed_in| frame <= pressed_in + 1);
        let releases = input.events.iter().any(|event| Kind::of(event) == Kind::Release);
        let most_secs = if is_next && releases {
            f64::INFINITY
        } else {
            MOST_CLICK_SECS
        };
        ctx.options_mut(|options| options.input_options.max_click_duration = most_secs);
        if input.events.iter().any(MirrorAction::is_focus) {
            ctx.request_discard("a widget claims its arrow keys in the pass after it got the focus");
        }
        if !self.waiting.is_empty() {
            ctx.request_discard("there is input that depends on this pass");
            // The next frame takes the events that are left.
            ctx.request_repaint();
        }
    }
}

/// Which events may share a pass with this one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Move,
    Press,
    Release,
    /// The pointer is gone: a finger was lifted, or the mouse left the window.
    Gone,
    /// Goes to the focused widget.
    Typed,
    /// May focus another widget, or close the focused one.
    MovesFocus,
    /// None of these. It stays in the pass of the event before it.
    Other,
}

impl Kind {
    fn of(event: &Event) -> Self {
        match event {
            Event::PointerMoved(_) => Self::Move,
            Event::PointerButton { pressed: true, .. } => Self::Press,
            Event::PointerButton { pressed: false, .. } => Self::Release,
            Event::PointerGone => Self::Gone,
            Event::Key {
                key: Key::Tab | Key::Enter | Key::Escape | Key::F2,
                pressed: true,
                ..
            } => Self::MovesFocus,
            event if MirrorAction::is_focus(event) => Self::MovesFocus,
            Event::Key { pressed: true, .. } | Event::Text(_) | Event::Ime(_) | Event::Paste(_) => Self::Typed,
            Event::Copy | Event::Cut => Self::Typed,
            _ => Self::Other,
        }
    }
}

/// How many of these events one pass can handle.
pub fn first_pass(events: &VecDeque<Event>) -> usize {
    let (mut moved, mut typed) = (false, false);
    let mut end = None;
    let waits = |event: &Event| {
        let kind = Kind::of(event);
        let waits = match kind {
            Kind::Other => false,
            Kind::Move | Kind::Typed => end.is_some(),
            Kind::Press | Kind::MovesFocus => end.is_some() || typed,
            // The drag before it is handled first.
            Kind::Release => end.is_some() || typed || moved,
            // A pointer that leaves with its release shares the pass of the release.
            Kind::Gone => end.is_some_and(|end| end != Kind::Release),
        };
        moved |= kind == Kind::Move;
        typed |= kind == Kind::Typed;
        if matches!(kind, Kind::Press | Kind::Release | Kind::MovesFocus) {
            end = Some(kind);
        }
        waits
    };
    events.iter().position(waits).unwrap_or(events.len())
}

pub(super) fn is_arrow(key: Key) -> bool {
    matches!(key, Key::ArrowUp | Key::ArrowDown | Key::ArrowLeft | Key::ArrowRight)
}

/// What holds a value while it changes. What changes until it lets go is one step to undo.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Grip {
    /// A button of the pointer, or a finger.
    Pointer,
    /// The text field that has the focus.
    Field(Id),
    /// A key in the control that has the focus.
    Key(Id),
    /// A screen reader presses a control, in this pass only.
    Request,
}

impl Grip {
    /// What holds a value as a pass begins.
    pub(super) fn now(ctx: &Context) -> Option<Self> {
        let holds = |&key: &Key| is_arrow(key) || matches!(key, Key::PageUp | Key::PageDown | Key::Enter | Key::Space);
        let (pointer, key, click) = ctx.input(|input| {
            let click = input.events.iter().any(|event| MirrorAction::clicked(event).is_some());
            (input.pointer.any_down(), input.keys_down.iter().any(holds), click)
        });
        let is_held = key || mirror::holds_key(ctx);
        match ctx.memory(|memory| memory.focused()) {
            _ if pointer => Some(Self::Pointer),
            Some(field) if ctx.text_edit_focused() => Some(Self::Field(field)),
            Some(control) if is_held => Some(Self::Key(control)),
            _ => click.then_some(Self::Request),
        }
    }
}

/// Whether a text field has the keyboard.
#[derive(Debug, Default)]
pub(super) struct Keyboard {
    typing: bool,
}

impl Keyboard {
    /// Whether a text field had the focus when this pass began, or until a key of this pass took it away.
    pub(super) fn was_typing(&self, ctx: &Context) -> bool {
        self.typing || ctx.text_edit_focused()
    }

    /// Whether a text field has the focus as this pass ends, or is being pressed.
    pub(super) fn is_typing(&mut self, ctx: &Context) -> bool {
        let pressed = ctx.data_mut(|data| data.remove_temp::<()>(pressed_field()).is_some());
        self.typing = pressed || ctx.text_edit_focused();
        self.typing
    }
}

/// Notes that the pointer presses a text field. Until the field has the focus, no key is a shortcut.
pub(super) fn press_field(ui: &Ui) {
    ui.data_mut(|data| data.insert_temp(pressed_field(), ()));
}

fn pressed_field() -> Id {
    Id::unique("a field is pressed")
}
