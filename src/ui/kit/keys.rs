//! What keys do in a control that has the focus, and what programs that read the screen ask of it.

use std::ops::RangeInclusive;

use egui::accesskit::{Action, ActionData};
use egui::{Event, EventFilter, FocusDirection, Id, Key, Modifiers, Response, Ui, WidgetInfo};

use super::control::tell_node;

/// Steps that the arrow keys ask of a focused control, or a program that reads the screen of any: right and up count up. The keys are
/// consumed, so that nothing else acts on them.
pub(crate) fn arrow_steps(ui: &Ui, response: &Response) -> f32 {
    let asked = |action| ui.input(|input| input.num_accesskit_action_requests(response.id, action)) as f32;
    let steps = focused_keys(ui, response, &ARROWS)
        .into_iter()
        .map(|(key, _)| match key {
            Key::ArrowRight | Key::ArrowUp => 1.0,
            _ => -1.0,
        });
    asked(Action::Increment) - asked(Action::Decrement) + steps.sum::<f32>()
}

const ARROWS: [Key; 4] = [Key::ArrowLeft, Key::ArrowRight, Key::ArrowUp, Key::ArrowDown];

/// Presses of these keys in a focused control, and whether Shift was held. They are consumed, so that nothing else acts on them. Keys
/// with Ctrl, Alt or Command are left alone.
pub(crate) fn focused_keys(ui: &Ui, response: &Response, wanted: &[Key]) -> Vec<(Key, bool)> {
    if !response.has_focus() {
        return Vec::new();
    }
    let filter = EventFilter {
        horizontal_arrows: wanted.contains(&Key::ArrowRight),
        vertical_arrows: wanted.contains(&Key::ArrowUp),
        ..EventFilter::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let mut pressed = Vec::new();
    retain_plain_keys(ui, |key, shift| {
        let is_wanted = wanted.contains(&key);
        if is_wanted {
            pressed.push((key, shift));
        }
        !is_wanted
    });
    pressed
}

/// Consumes the pressed keys that `keep` refuses; it is told whether Shift was held. Keys with Ctrl, Alt or Command are left alone.
pub(crate) fn retain_plain_keys(ui: &Ui, mut keep: impl FnMut(Key, bool) -> bool) {
    ui.input_mut(|input| {
        input.events.retain(|event| match event {
            Event::Key {
                key,
                pressed: true,
                modifiers,
                ..
            } if !modifiers.command && !modifiers.ctrl && !modifiers.alt => keep(*key, modifiers.shift),
            _ => true,
        });
    });
}

/// Reads the keys that move the focus through a list: ↑ ↓ to a neighbour, the page keys by a page, Home and End to an end. They are
/// consumed, so that they are not shortcuts too. Returns the place of the row that gets the focus, if it is another one.
pub(crate) fn walked(ui: &Ui, row: Id, place: usize, count: usize, page: usize) -> Option<usize> {
    if !ui.memory(|memory| memory.has_focus(row)) {
        return None;
    }
    let filter = EventFilter {
        horizontal_arrows: true,
        vertical_arrows: true,
        ..EventFilter::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(row, filter));
    let last = count.saturating_sub(1);
    let mut to = place;
    retain_plain_keys(ui, |key, _| {
        to = match key {
            Key::ArrowUp => to.saturating_sub(1),
            Key::ArrowDown => to + 1,
            Key::PageUp => to.saturating_sub(page),
            Key::PageDown => to + page,
            Key::Home => 0,
            Key::End => last,
            _ => return true,
        }
        .min(last);
        false
    });
    // egui sees the arrows of a row that got the focus in the pass before.
    ui.memory_mut(|memory| memory.move_focus(FocusDirection::None));
    (to != place).then_some(to)
}

/// A slider as screen readers have it.
#[derive(Clone, Debug)]
pub(crate) struct SliderNode<'a> {
    pub(crate) name: &'a str,
    pub(crate) value: f64,
    pub(crate) range: RangeInclusive<f64>,
    pub(crate) step: f64,
    pub(crate) text: &'a str,
}

impl SliderNode<'_> {
    /// Tells of it. Returns how many steps up they ask for, and which value.
    pub(crate) fn tell(&self, ui: &Ui, response: &Response) -> (i32, Option<f64>) {
        response.widget_info(|| WidgetInfo::slider(true, self.value, self.name));
        tell_node(response, |node| {
            node.set_min_numeric_value(*self.range.start());
            node.set_max_numeric_value(*self.range.end());
            node.set_numeric_value_step(self.step);
            node.set_value(self.text);
            for action in [Action::SetValue, Action::Increment, Action::Decrement] {
                node.add_action(action);
            }
        });
        ui.input(|input| {
            let count = |action| input.num_accesskit_action_requests(response.id, action) as i32;
            let set = input.accesskit_action_requests(response.id, Action::SetValue);
            let value = set.filter_map(|request| match request.data {
                Some(ActionData::NumericValue(value)) => Some(value),
                Some(ActionData::Value(ref text)) => text.parse().ok(),
                _ => None,
            });
            let value = value.filter(|value: &f64| value.is_finite());
            (count(Action::Increment) - count(Action::Decrement), value.last())
        })
    }
}

/// Arrow steps of a page key.
const PAGE_STEPS: f64 = 10.0;

/// Makes a control a slider for programs that read the screen, and returns the value that keys or such a program ask for.
pub(crate) fn slider_keys(ui: &Ui, response: &Response, slider: &SliderNode<'_>) -> Option<f64> {
    let (_, set) = slider.tell(ui, response);
    let (value, step) = (slider.value, slider.step);
    let (start, end) = (*slider.range.start(), *slider.range.end());
    let steps = f64::from(arrow_steps(ui, response));
    let page = |key| response.has_focus() && ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let asked = if let Some(value) = set {
        value
    } else if page(Key::Home) {
        start
    } else if page(Key::End) {
        end
    } else if page(Key::PageUp) {
        value + PAGE_STEPS * step
    } else if page(Key::PageDown) {
        value - PAGE_STEPS * step
    } else if steps != 0.0 {
        value + steps * step
    } else {
        return None;
    };
    Some(asked.clamp(start, end))
}
