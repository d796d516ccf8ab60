//! A short message over the view: what was just done. It goes by itself. An error is never a message: it has the card.

use egui::{Align2, Label, Margin, Rangef, Rect, RichText, Ui};

use super::panel::Panel;
use crate::session::ExportedFile;
use crate::ui::kit::icons::Icon;
use crate::ui::kit::theme::Tokens;
use crate::ui::kit::wording::bytes;
use crate::ui::kit::{TextButton, control_size, push_button};

/// How long a message is shown. The time begins anew while the pointer is over it or one of its buttons has the focus.
const SHOWN_SECS: f64 = 6.0;
/// Room between its parts.
const SPACING: f32 = 6.0;
/// The least room in which one is shown.
const LEAST_WIDTH: f32 = 160.0;

/// The message that is shown. A new one takes its place.
#[derive(Debug, Default)]
pub struct Messages {
    shown: Option<Message>,
    /// The words are new to [`Messages::take_spoken`].
    unspoken: bool,
}

#[derive(Debug)]
struct Message {
    words: String,
    offer: Option<Offer>,
    /// The last step of undo when the message appeared. Undo is offered only while it still is the last.
    step: Option<String>,
    /// When it goes, in egui's time. None until it was shown once.
    ends_secs: Option<f64>,
}

/// What a message offers beside its words: a button.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::ui) enum Offer {
    /// To save the picture that it is about elsewhere.
    SavePicture,
    /// To take back the last step.
    Undo,
    /// To make the cube map with this path the sky.
    UseSky(String),
}

impl Offer {
    /// The button's label, its name and its width.
    fn button(&self) -> (&'static str, &'static str, f32) {
        match self {
            Self::SavePicture => ("Save as…", "Save the picture as…", 78.0),
            Self::Undo => ("Undo", "Undo what the message tells of", 54.0),
            Self::UseSky(_) => ("Use as sky", "Use the cube map as sky", 88.0),
        }
    }
}

impl Messages {
    pub fn say(&mut self, words: impl Into<String>) {
        self.show_next(words.into(), None);
    }

    pub(in crate::ui) fn offer(&mut self, words: impl Into<String>, offer: Offer) {
        self.show_next(words.into(), Some(offer));
    }

    /// Shows a sentence that a screen reader was told.
    pub(in crate::ui) fn show_spoken(&mut self, sentence: &str, offer: Option<Offer>) {
        self.show_next(sentence.trim_end_matches('.').to_owned(), offer);
        self.unspoken = false;
    }

    /// Shows that a picture was saved, and offers to save it elsewhere.
    pub fn say_saved(&mut self, name: &str, [width, height]: [u32; 2]) {
        self.offer(format!("Saved {name}, {width} × {height}"), Offer::SavePicture);
    }

    pub fn say_exported(&mut self, file: &ExportedFile) {
        let size = bytes(file.bytes.len() as u64);
        self.say(format!("Saved {}, {size}", file.name));
    }

    fn show_next(&mut self, words: String, offer: Option<Offer>) {
        self.unspoken = true;
        self.shown = Some(Message {
            words,
            offer,
            step: None,
            ends_secs: None,
        });
    }

    pub(in crate::ui) fn is_shown(&self) -> bool {
        self.shown.is_some()
    }

    /// The words of a message that no call before returned, for a screen reader.
    pub fn take_spoken(&mut self) -> Option<String> {
        let is_new = std::mem::take(&mut self.unspoken);
        let message = self.shown.as_ref().filter(|_| is_new)?;
        Some(format!("{}.", message.words))
    }
}

/// Shows the message at the bottom of a room. `last_step`: what undo would take back. Returns what the person took of what it offers.
pub(in crate::ui) fn show(ui: &Ui, messages: &mut Messages, last_step: Option<&str>, room: Rect) -> Option<Offer> {
    let message = messages.shown.as_mut()?;
    let now_secs = ui.input(|input| input.time);
    if message.ends_secs.is_none() {
        message.step = last_step.map(str::to_owned);
    }
    message
        .offer
        .take_if(|offer| *offer == Offer::Undo && message.step.as_deref() != last_step);
    let ends_secs = *message.ends_secs.get_or_insert(now_secs + SHOWN_SECS);
    if now_secs >= ends_secs || room.width() < LEAST_WIDTH {
        messages.shown = None;
        // The chips that it replaced come back.
        ui.ctx().request_repaint();
        return None;
    }
    let (mut shut, mut taken, mut held) = (false, false, false);
    let button = message.offer.as_ref().map(Offer::button);
    let tokens = Tokens::of(ui);
    let rect = Panel::new("message", "Message", Align2::CENTER_BOTTOM)
        .margin(Margin {
            left: 14,
            right: 3,
            top: 3,
            bottom: 3,
        })
        .show(ui, room, |ui| {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = SPACING;
                let side = control_size(ui);
                let button_width = button.map_or(0.0, |(_, _, width)| width + SPACING);
                let most = ui.available_width() - side - button_width - 2.0 * SPACING;
                ui.scope(|ui| {
                    ui.set_max_width(most.max(0.0));
                    let words = RichText::new(&message.words).color(tokens.text);
                    ui.add(Label::new(words).truncate());
                });
                if let Some((label, name, width)) = button {
                    let button = TextButton::new(label, name).width(Rangef::point(width)).show(ui);
                    taken = button.clicked();
                    held |= button.has_focus();
                }
                let cross = push_button(ui, Icon::Close, "Close the message");
                shut = cross.clicked();
                held |= cross.has_focus();
            });
        });
    held |= ui.input(|input| input.pointer.hover_pos().is_some_and(|at| rect.contains(at)));
    let ends_secs = if held { now_secs + SHOWN_SECS } else { ends_secs };
    message.ends_secs = Some(ends_secs);
    let offer = if taken { message.offer.take() } else { None };
    if shut || taken {
        messages.shown = None;
        ui.ctx().request_repaint();
    } else {
        let left = std::time::Duration::from_secs_f64(ends_secs - now_secs);
        ui.ctx().request_repaint_after(left);
    }
    offer
}
