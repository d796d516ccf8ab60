//! Saves the model as a file of another format: what is kept of it, what that changes, and what the format does not hold.

use std::borrow::Cow;
use std::ops::RangeInclusive;

use egui::{Align, Color32, Label, Layout, ProgressBar, Rangef, RichText, Sense, Ui, vec2};

use crate::check::book::DEMO_CLIP;
use crate::session::{Command, Export, ExportCommand, ExportFormat, ExportOptions, ExportRange, Session};
use crate::ui::cx::Cx;
use crate::ui::kit::theme::{CONTROL_RADIUS, Tokens};
use crate::ui::kit::{
    TextButton, choose, control_size, number_field, section_name, section_with_labelled_action, switch_row,
};
use crate::ui::state::{DrawerPage, UiState};
use crate::ui::window::arrangement::Arrangement;
use crate::ui::window::panel::{popover_gap, scrolled};

pub(in crate::ui) const WIDTH: f32 = 320.0;
/// More sentences of a list than this are folded.
const MOST_SENTENCES: usize = 4;
const LOOP_SECS: f32 = 0.2;
const TOLERANCE: f32 = 0.001;
/// Width of a number that is typed.
const FIELD_WIDTH: f32 = 76.0;
/// The least height of what is lost and changed, and of the words about the demo.
const LEAST_OUTCOME: f32 = 150.0;
const DEMO_WORDS_HEIGHT: f32 = 32.0;
const FOOT_GAP: f32 = 8.0;
const CANCEL_WIDTH: f32 = 74.0;

/// The contents of the popover and of the drawer's page, no higher than `most`. The button that saves stays in view below what scrolls.
pub(in crate::ui) fn show(ui: &mut Ui, most: f32, cx: &mut Cx<'_, UiState>) {
    let foot = if cx.session.open_model().is_some() {
        control_size(ui) + FOOT_GAP
    } else {
        0.0
    };
    let mut scrolled = scrolled("export", most - foot);
    if cx.state.export.outcome_height == 0.0 {
        // It was shut: it begins with the format, wherever it was scrolled to before.
        scrolled = scrolled.vertical_scroll_offset(0.0);
    }
    scrolled.show(ui, |ui| choices(ui, cx));
    if foot > 0.0 {
        ui.add_space(FOOT_GAP);
        let export = cx.session.export();
        let export = export.filter(|export| *export.options == cx.state.export.options);
        save_row(ui, cx.session, export, cx.commands);
    }
}

/// What is written, and what that changes.
fn choices(ui: &mut Ui, cx: &mut Cx<'_, UiState>) {
    let session = cx.session;
    let choice = &mut cx.state.export;
    let Some(open) = session.open_model() else {
        ui.label(RichText::new("Nothing is open. Drop a model, then export it here.").color(Tokens::of(ui).muted));
        return;
    };
    if choice.of_model != session.model_revision() {
        choice.of_model = session.model_revision();
        if choice.of_file != open.file.base_name() {
            open.file.base_name().clone_into(&mut choice.of_file);
            choice.options = ExportOptions {
                format: choice.options.format,
                for_book: choice.options.for_book,
                ..ExportOptions::default()
            };
        }
        let names = |name: &String| open.model.clips.iter().any(|clip| clip.name == *name);
        // The same file, read again, keeps its choice.
        if choice
            .options
            .clips
            .as_ref()
            .is_some_and(|clips| !clips.iter().all(names))
        {
            (choice.options.clips, choice.options.range) = (None, ExportRange::default());
        }
    }
    choice.shown = true;
    let is_saving = session.export().is_some_and(|export| export.saving.is_some());
    ui.add_enabled_ui(!is_saving, |ui| {
        // What moves would stand still in a text model.
        let is_still = open.model.skeleton.joint_count() == 0;
        let formats = ExportFormat::ALL
            .into_iter()
            .filter(|&format| is_still || format != ExportFormat::Text);
        if !is_still && choice.options.format == ExportFormat::Text {
            choice.options.format = ExportFormat::default();
        }
        let formats: Vec<_> = formats.map(|format| (format, format.label())).collect();
        choose(ui, "Format", &formats, &mut choice.options.format);
        ui.add_space(6.0);
        demo(ui, session, &mut choice.options);
        ui.add_space(6.0);
        clip_list(ui, session, &mut choice.options);
        edits(ui, session, &mut choice.options);
    });
    if session.export().is_none_or(|export| *export.options != choice.options) {
        let options = Some(Box::new(choice.options.clone()));
        cx.commands.push(ExportCommand::Plan(options).into());
    }
    popover_gap(ui);
    let export = session.export().filter(|export| *export.options == choice.options);
    let mended = open.mended(choice.options.clips.as_deref()).count();
    let top = ui.cursor().min.y;
    outcome(ui, export, mended, &mut choice.unfolded);
    // It grows while it is open and never shrinks, so that the button that saves stays below the pointer.
    let height = ui.cursor().min.y - top;
    choice.outcome_height = choice.outcome_height.max(height).max(LEAST_OUTCOME);
    ui.add_space(choice.outcome_height - height);
}

/// A line for each clip, to keep it or leave it out.
fn clip_list(ui: &mut Ui, session: &Session, options: &mut ExportOptions) {
    let Some(open) = session.open_model() else { return };
    let clips = &open.model.clips;
    if clips.len() < 2 {
        return;
    }
    let is_kept = |options: &ExportOptions, name: &str| {
        let kept = options.clips.as_ref();
        kept.is_none_or(|kept| kept.iter().any(|kept| kept == name))
    };
    let (all, label) = match options.clips {
        None => ("None", "Export no clip"),
        Some(_) => ("All", "Export all clips"),
    };
    if section_with_labelled_action(ui, "Clips", Some((all, label))) {
        options.clips = match options.clips {
            None => Some(Vec::new()),
            Some(_) => None,
        };
    }
    for clip in clips {
        let on = is_kept(options, &clip.name);
        if switch_row(ui, &clip.name, "", on).clicked() {
            let kept = |name: &str| is_kept(options, name) != (name == clip.name);
            let names: Vec<String> = clips
                .iter()
                .map(|clip| &clip.name)
                .filter(|name| kept(name))
                .cloned()
                .collect();
            options.clips = (names.len() < clips.len()).then_some(names);
        }
    }
    ui.add_space(6.0);
}

/// The only clip that is kept: its first and last time.
fn only_clip(session: &Session, options: &ExportOptions) -> Option<[f32; 2]> {
    let clips = &session.open_model()?.model.clips;
    let clip = match &options.clips {
        Some(names) => match names.as_slice() {
            [name] => clips.iter().find(|clip| clip.name == *name)?,
            _ => return None,
        },
        None if clips.len() == 1 => clips.first()?,
        None => return None,
    };
    (clip.duration_secs() > 0.0).then_some([clip.start_secs, clip.end_secs])
}

/// Switches for what is edited before it is written, each with its numbers. They are there, disabled, where they do not apply.
fn edits(ui: &mut Ui, session: &Session, options: &mut ExportOptions) {
    let has_clips = session.open_model().is_some_and(|open| !open.model.clips.is_empty());
    let keeps_some = options.clips.as_ref().is_none_or(|clips| !clips.is_empty());
    range(ui, session, options);
    ui.add_enabled_ui(has_clips && keeps_some, |ui| {
        let in_place = switch_row(ui, "In place", "", has_clips && options.in_place)
            .on_hover_text("Each clip stays over where it starts: what walks away walks on the spot");
        if in_place.clicked() {
            options.in_place = !options.in_place;
        }
        let hint = "The end of each clip is eased into its first pose";
        let row = ("Seconds of the easing", "Over", "s");
        let secs = (options.close_loop_secs, LOOP_SECS, 0.01..=10.0, (0.01, 2));
        options.close_loop_secs = switched_number(ui, ("Close the loop", hint), row, secs);
        let hint = "Keys are left out as long as no bone and no tip of one moves farther than this";
        let row = ("Tolerance in % of the size", "Off by", "%");
        let percent = options.reduce.map(|tolerance| tolerance * 100.0);
        let percent = (percent, TOLERANCE * 100.0, 0.001..=5.0, (0.005, 3));
        let reduce = switched_number(ui, ("Reduce keys", hint), row, percent);
        // One that stays is not rounded again.
        if reduce != options.reduce.map(|tolerance| tolerance * 100.0) {
            options.reduce = reduce.map(|percent| percent / 100.0);
        }
    });
}

/// The switch for what the books' programs need, and what that means.
fn demo(ui: &mut Ui, session: &Session, options: &mut ExportOptions) {
    let is_of_book = options.format.is_m3d();
    let demo = switch_row(ui, "For the book's demo", "", is_of_book && options.for_book)
        .on_hover_text("Size, names, bones and keys as the books' programs need them");
    if demo.clicked() {
        options.for_book = !(is_of_book && options.for_book);
        if !is_of_book {
            options.format = ExportFormat::D3d12;
        }
    }
    let words: Cow<'_, str> = match (is_of_book, options.for_book) {
        (false, _) if options.format == ExportFormat::Text => "The demos of what stands still read it.".into(),
        (false, _) => "A demo of the books reads .m3d only: turning this on chooses it.".into(),
        (true, true) => match session.demo_clip(options) {
            None => "No clip is kept: the demo shows the model standing still.".into(),
            Some(DEMO_CLIP) => "The demo plays one clip, Take1. Maps come along as DDS.".into(),
            Some(name) => format!("The demo plays \u{201c}{name}\u{201d}, as Take1. Maps come along as DDS.").into(),
        },
        (true, false) => {
            "The demo may show nothing: it wants a clip Take1, keys for each bone, its size, and maps as DDS.".into()
        }
    };
    let size = vec2(ui.available_width(), DEMO_WORDS_HEIGHT);
    ui.allocate_ui_with_layout(size, Layout::top_down(Align::Min), |ui| {
        ui.set_min_size(size);
        ui.label(RichText::new(words).size(12.0).color(Tokens::of(ui).muted));
    });
}

/// The switch for a part of the only clip, and its first and last second.
fn range(ui: &mut Ui, session: &Session, options: &mut ExportOptions) {
    let only = only_clip(session, options);
    if only.is_none() && matches!(options.range, ExportRange::Secs(_)) {
        // A range is of one clip.
        options.range = ExportRange::Timeline;
    }
    let of_timeline = session.timeline_range(options.clips.as_deref());
    let range = match options.range {
        ExportRange::Timeline => of_timeline,
        ExportRange::Whole => None,
        ExportRange::Secs(range) => Some(range),
    };
    let range = range.filter(|_| only.is_some());
    let whole = only.unwrap_or_default();
    ui.add_enabled_ui(only.is_some(), |ui| {
        if switch_row(ui, "Only a range", "", range.is_some()).clicked() {
            options.range = match range {
                Some(_) => ExportRange::Whole,
                None => of_timeline.map_or(ExportRange::Secs(whole), |_| ExportRange::Timeline),
            };
        }
        ui.add_enabled_ui(range.is_some(), |ui| {
            let [from, to] = range.unwrap_or(whole);
            let span = whole[0]..=whole[1];
            let typed_from = number_row(ui, ("First second", "From", "s"), (from, span.clone()), (0.01, 3));
            let typed_to = number_row(ui, ("Last second", "To", "s"), (to, span), (0.01, 3));
            if typed_from.is_some() || typed_to.is_some() {
                options.range = ExportRange::Secs([typed_from.unwrap_or(from), typed_to.unwrap_or(to)]);
            }
        });
    });
}

/// A switch, and below it the number of what is on. Returns the number, or `None` where it is off; it begins with the second one.
fn switched_number(
    ui: &mut Ui,
    (label, hint): (&str, &str),
    row: (&str, &str, &str),
    (value, first, range, step): (Option<f32>, f32, RangeInclusive<f32>, (f32, usize)),
) -> Option<f32> {
    let switch = switch_row(ui, label, "", value.is_some()).on_hover_text(hint);
    let typed = ui.add_enabled_ui(value.is_some(), |ui| {
        number_row(ui, row, (value.unwrap_or(first), range), step)
    });
    match value {
        None => switch.clicked().then_some(first),
        Some(_) if switch.clicked() => None,
        Some(value) => Some(typed.inner.unwrap_or(value)),
    }
}

/// A label, a number that is dragged or typed, its unit.
fn number_row(
    ui: &mut Ui,
    (name, label, unit): (&str, &str, &str),
    (value, range): (f32, RangeInclusive<f32>),
    step: (f32, usize),
) -> Option<f32> {
    let color = Tokens::of(ui).muted;
    let size = vec2(ui.available_width(), control_size(ui));
    let row = ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        ui.add_sized(vec2(14.0, size.y), Label::new(RichText::new(unit).color(color)));
        let typed = number_field(ui, name, vec2(FIELD_WIDTH, size.y), value, range, step);
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            ui.add_space(12.0);
            ui.label(RichText::new(label).color(color));
        });
        typed
    });
    row.inner
}

/// What would be otherwise, or why it cannot be. `mended`: how many changes are what was mended on reading.
fn outcome(ui: &mut Ui, export: Option<Export<'_>>, mended: usize, unfolded: &mut [bool; 2]) {
    let tokens = Tokens::of(ui);
    if let Some((refusal, options)) = export.and_then(|export| Some((export.refusal?, export.options))) {
        section_name(ui, "Cannot be written");
        sentence(ui, refusal, tokens.error);
        if options.for_book && options.format.is_m3d() {
            let words = "What the demo cannot hold is written when \u{201c}For the book's demo\u{201d} is off.";
            sentence(ui, words, tokens.muted);
        }
        return;
    }
    let Some(plan) = export.and_then(|export| export.plan) else {
        section_name(ui, "What is lost");
        sentence(ui, "This is being worked out.", tokens.faint);
        return;
    };
    let [all_losses, all_changes] = unfolded;
    let losses: Vec<&str> = plan.losses.iter().map(|loss| loss.message.as_str()).collect();
    let mut changes: Vec<&str> = plan.changes.iter().map(|change| change.message.as_str()).collect();
    // A plan begins with what was mended on reading. That is in the findings too, so here it comes last.
    changes.rotate_left(mended.min(plan.changes.len()));
    if losses.is_empty() {
        section_name(ui, "What is lost");
        sentence(ui, "Nothing.", tokens.faint);
    } else {
        sentences(ui, "What is lost", &losses, tokens.warning, all_losses);
    }
    if !changes.is_empty() {
        ui.add_space(6.0);
        sentences(ui, "What changes", &changes, tokens.accent, all_changes);
    }
}

/// A list of sentences below its name and their number. A long one is folded.
fn sentences(ui: &mut Ui, name: &str, list: &[&str], color: Color32, all: &mut bool) {
    let folds = list.len() > MOST_SENTENCES;
    let title = format!("{name} · {}", list.len());
    let (words, label) = if *all {
        ("Fewer", format!("{name}: show fewer"))
    } else {
        ("All", format!("{name}: show all"))
    };
    if section_with_labelled_action(ui, &title, folds.then_some((words, label.as_str()))) {
        *all = !*all;
    }
    let most = if *all { list.len() } else { MOST_SENTENCES };
    for words in list.iter().take(most) {
        sentence(ui, words, color);
    }
}

fn sentence(ui: &mut Ui, words: &str, color: Color32) {
    let text = Tokens::of(ui).text;
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        let (rect, _) = ui.allocate_exact_size(vec2(6.0, 17.0), Sense::hover());
        ui.painter().circle_filled(rect.center(), 2.5, color);
        ui.add(Label::new(RichText::new(words).color(text)).wrap());
    });
}

/// The button that saves; while that goes on, how far it is, and a button that stops it.
fn save_row(ui: &mut Ui, session: &Session, export: Option<Export<'_>>, commands: &mut Vec<Command>) {
    if let Some(progress) = export.and_then(|export| export.saving) {
        let tokens = Tokens::of(ui);
        ui.horizontal(|ui| {
            let width = ui.available_width() - CANCEL_WIDTH - ui.spacing().item_spacing.x;
            let words = RichText::new(format!("Writing {} %", progress.percent())).color(tokens.text);
            ui.add(
                ProgressBar::new(progress.percent() as f32 / 100.0)
                    .desired_width(width)
                    .desired_height(control_size(ui))
                    .corner_radius(CONTROL_RADIUS)
                    .fill(tokens.accent_ground)
                    .text(words),
            );
            let cancel = TextButton::new("Cancel", "Cancel the export").width(Rangef::point(CANCEL_WIDTH));
            if cancel.show(ui).clicked() {
                commands.push(ExportCommand::Cancel.into());
            }
        });
        return;
    }
    let name = session.export_name().unwrap_or_default();
    let words = format!("Save {name}");
    let words = words.trim_end();
    let is_ready = export.is_some_and(|export| export.plan.is_some());
    ui.add_enabled_ui(is_ready, |ui| {
        if TextButton::new(words, words).show_wide(ui).clicked() {
            commands.push(ExportCommand::Save.into());
        }
    });
}

/// Opens it for a key, in a narrow window as a page of the drawer; where it is open, it shuts.
pub(in crate::ui) fn ask(ui: &Ui, state: &mut UiState) {
    if Arrangement::here(ui) == Arrangement::Wide {
        state.export.asked = true;
        return;
    }
    let shown = state.drawer == Some(DrawerPage::Export);
    state.drawer = (!shown).then_some(DrawerPage::Export);
}

/// Opens it, where it is not open yet.
pub(in crate::ui) fn open(ui: &Ui, state: &mut UiState) {
    if Arrangement::here(ui) == Arrangement::Wide || state.drawer != Some(DrawerPage::Export) {
        ask(ui, state);
    }
}

/// Ends what is planned when it was shut; what is being written goes on. Returns whether it is open.
pub(in crate::ui) fn settle(cx: &mut Cx<'_, UiState>) -> bool {
    let is_open = std::mem::take(&mut cx.state.export.shown);
    if !is_open {
        cx.state.export.outcome_height = 0.0;
        if cx.session.export().is_some_and(|export| export.saving.is_none()) {
            cx.push(ExportCommand::Plan(None));
        }
    }
    is_open
}
