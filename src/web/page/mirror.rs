//! The interface as elements of the page: what changed goes out after a frame, and what is done with an element comes in before one.
//!
//! A tree for screen readers is made in frames that input brings, and else four times a second: what plays is not told more often.

use std::cell::{Cell, RefCell};
use std::time::Duration;

use egui::{Context, Event, Key, Modifiers, RawInput};
use serde::Serialize as _;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::prelude::*;

use crate::ui::{Mirror, MirrorAction, MirrorId, MirrorInput, owns_key};
use crate::web::{field, sleep};

/// Without input a tree is told no more often than this.
const PERIOD_MS: i32 = 250;
/// What input opens may need some frames until all of it is there.
const FRAMES_AFTER_INPUT: u8 = 3;

/// What comes in and goes out between two frames.
#[derive(Debug, Default)]
pub(super) struct MirrorLink {
    input: RefCell<MirrorInput>,
    /// Frames that tell at once.
    eager: Cell<u8>,
    /// No frame without input tells before this has passed.
    waits: Cell<bool>,
    /// A frame had something to tell meanwhile.
    due: Cell<bool>,
}

impl MirrorLink {
    /// Tells all of a new start at once.
    pub(super) fn begin(&self) {
        self.eager.set(FRAMES_AFTER_INPUT);
    }

    /// Does what was asked of an element: `{node, action, value}`. An unknown one is ignored.
    pub(super) fn act(&self, asked: &JsValue) {
        let value = field(asked, "value");
        let mut input = self.input.borrow_mut();
        let action = match field(asked, "action").as_string().as_deref() {
            Some("blur") => return input.blur(),
            Some(how @ ("hold" | "release")) => return input.holds_key = how == "hold",
            Some("click") => Some(MirrorAction::Click),
            Some("focus") => Some(MirrorAction::Focus),
            Some("expand") => Some(MirrorAction::Expand),
            Some("collapse") => Some(MirrorAction::Collapse),
            Some("scrollIntoView") => Some(MirrorAction::ScrollIntoView),
            Some("setValue") => match value.as_f64() {
                Some(number) => Some(MirrorAction::SetNumber(number)),
                None => value.as_string().map(MirrorAction::SetText),
            },
            _ => None,
        };
        let node = field(asked, "node").as_string();
        let node = node.and_then(|text| MirrorId::from_text(&text));
        if let (Some(action), Some(node)) = (action, node) {
            input.events.push(action.event(node));
        }
    }

    /// Takes a key event of an element. Returns whether the browser should leave the key alone.
    pub(super) fn press(&self, event: &JsValue) -> bool {
        let text = |name| field(event, name).as_string().unwrap_or_default();
        let held = |name| field(event, name).is_truthy();
        let modifiers = Modifiers {
            alt: held("altKey"),
            ctrl: held("ctrlKey"),
            shift: held("shiftKey"),
            mac_cmd: held("metaKey"),
            command: held("ctrlKey") || held("metaKey"),
        };
        let pressed = text("type") == "keydown";
        let mut input = self.input.borrow_mut();
        let key = input.press(&text("key"), &text("code"), pressed, modifiers);
        key.is_some_and(|key| pressed && (owns_key(key, modifiers) || (!modifiers.any() && scrolls(key))))
    }

    /// Hears whether an element of the mirror has the focus of the page.
    pub(super) fn set_focused(&self, focused: bool) {
        self.input.borrow_mut().set_focused(focused);
    }

    /// Adds what came in to the input of a frame.
    pub(super) fn begin_frame(&self, ctx: &Context, input: &mut RawInput) {
        self.input.borrow_mut().begin_frame(ctx, input);
        let only_moves = |event: &Event| {
            matches!(
                event,
                Event::PointerMoved(_) | Event::MouseMoved(_) | Event::PointerGone
            )
        };
        if !input.events.iter().all(only_moves) {
            self.eager.set(FRAMES_AFTER_INPUT);
        }
        let tells = self.eager.get() > 0 || !self.waits.get();
        self.eager.set(self.eager.get().saturating_sub(1));
        self.due.set(!tells);
        if tells {
            ctx.enable_accesskit();
        } else {
            ctx.disable_accesskit();
        }
    }
}

impl MirrorLink {
    /// Whether a frame tells the page, once it has ended.
    pub(super) fn tells(&self) -> bool {
        !self.due.get()
    }

    /// Waits until a frame without input may tell again, and asks for one if there was something to tell. Once at a time.
    pub(super) async fn rest(&self, ctx: &Context) {
        if self.waits.replace(true) {
            return;
        }
        sleep(PERIOD_MS).await;
        self.waits.set(false);
        if self.due.replace(false) {
            // With a delay, since egui runs a second pass after each one that is asked for at once: that one would be a frame that could
            // not tell yet, for which another pass is asked, without an end.
            ctx.request_repaint_after(Duration::from_millis(1));
        }
    }
}

/// Whether a browser scrolls with a key.
fn scrolls(key: Key) -> bool {
    use Key::{ArrowDown, ArrowLeft, ArrowRight, ArrowUp, Space};
    matches!(key, ArrowUp | ArrowDown | ArrowLeft | ArrowRight | Space)
}

/// What changed since the last call, as plain objects; `None` when nothing did.
pub(super) fn take_changes(ctx: &Context) -> Option<JsValue> {
    let changes = ctx.plugin::<Mirror>().lock().take_changes()?;
    // All of our values can be written.
    changes.serialize(&Serializer::json_compatible()).ok()
}
