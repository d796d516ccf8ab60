//! The row of a finding: a click unfolds the lines of the file, how to mend it and all its places, and goes to what it is about.

use egui::text::{LayoutJob, TextFormat};
use egui::{CursorIcon, FontId, Response, RichText, Role, Sense, Ui, UiBuilder, WidgetInfo, pos2, vec2};

use super::filter::color;
use super::goal::Goal;
use super::state::ShownDiagnostic;
use crate::actions;
use crate::diagnostic::{Code, Diagnostic, Mended, codes};
use crate::session::{Command, MaterialCommand, OpenModel, Session};
use crate::ui::cx::Cx;
use crate::ui::kit::theme::{self, Tokens};
use crate::ui::kit::wording::grouped;
use crate::ui::kit::{Row, RowList, TextButton, paint_elided, paint_row_ground, tell_folds, tell_node};
use crate::ui::panels::error_card::{expected_and_found, show_excerpt};
use crate::ui::panels::export;
use crate::ui::state::{Request, UiState};

/// Where the words of a line begin, behind its dot.
pub(super) const INDENT: f32 = 16.0;
const AROUND: f32 = 12.0;

pub(super) struct FindingRow<'a> {
    pub(super) diagnostic: &'a Diagnostic,
    /// Its index, and how many there are.
    pub(super) place: (usize, usize),
    pub(super) height: f32,
}

/// The height of a row while it is folded.
pub(super) fn row_height(ui: &Ui, session: &Session, open: &OpenModel, diagnostic: &Diagnostic) -> f32 {
    let goal = goal_of(session, open, diagnostic);
    let galley = ui.painter().layout_job(words(ui, diagnostic, goal.as_ref()));
    galley.size().y + AROUND
}

fn goal_of(session: &Session, open: &OpenModel, diagnostic: &Diagnostic) -> Option<Goal> {
    Goal::of(session, open, diagnostic.subject?, diagnostic.moment())
}

/// The sentence, and below it what it is about, place and code.
fn words(ui: &Ui, diagnostic: &Diagnostic, goal: Option<&Goal>) -> LayoutJob {
    let tokens = Tokens::of(ui);
    let format = |font_id, color| TextFormat {
        font_id,
        color,
        ..Default::default()
    };
    let small = |color| format(FontId::proportional(11.5), color);
    let mut job = LayoutJob::default();
    job.wrap.max_width = ui.available_width() - INDENT;
    let text = format(FontId::proportional(13.0), tokens.text);
    job.append(&diagnostic.message, 0.0, text);
    job.append("\n", 0.0, small(tokens.muted));
    if let Some(goal) = goal {
        job.append(&goal.words, 0.0, small(tokens.accent));
        job.append(" · ", 0.0, small(tokens.muted));
    }
    // A line tells little of JSON, which often has one alone.
    let place = match (&diagnostic.pointer, diagnostic.position) {
        (Some(pointer), _) => Some(format!("{pointer} · ")),
        (None, Some(at)) => Some(format!("line {}, column {} · ", at.line, at.column)),
        (None, None) => None,
    };
    if let Some(place) = place {
        job.append(&place, 0.0, small(tokens.muted));
    }
    job.append(diagnostic.code, 0.0, format(theme::mono(11.0), tokens.muted));
    job
}

impl FindingRow<'_> {
    /// Shows it, and what is unfolded below it.
    pub(super) fn show(&self, ui: &mut Ui, list: &mut RowList, cx: &mut Cx<'_, UiState>, open: &OpenModel) {
        let diagnostic = self.diagnostic;
        let goal = goal_of(cx.session, open, diagnostic);
        let is_shown = cx.state.findings.is_shown(diagnostic);
        let response = self.line(ui, goal.as_ref(), is_shown);
        list.row(&response, is_shown);
        let (index, count) = self.place;
        tell_node(&response, |node| {
            node.set_position_in_set(index);
            node.set_size_of_set(count);
        });
        if tell_fold(ui, &response, is_shown) {
            cx.state.findings.shown = (!is_shown).then(|| ShownDiagnostic::new(open, diagnostic));
            if let Some(goal) = goal.filter(|_| !is_shown) {
                goal.go(cx);
            }
        }
        if !is_shown {
            return;
        }
        // Rows before it come and go while the list scrolls; what is in here is the same all the time.
        let scope = UiBuilder::new().scope_id(response.id.with("unfolded"));
        let unfolded = ui.scope_builder(scope, |ui| {
            self.occurrences(ui, list, cx, open);
            self.details(ui, cx);
        });
        let height = unfolded.response.rect.height();
        if let Some(shown) = &mut cx.state.findings.shown {
            shown.height = height;
        }
    }

    fn line(&self, ui: &mut Ui, goal: Option<&Goal>, is_shown: bool) -> Response {
        let diagnostic = self.diagnostic;
        let galley = ui.painter().layout_job(words(ui, diagnostic, goal));
        let (_, rect) = ui.allocate_space(vec2(ui.available_width(), self.height));
        let id = ui.scope_id().with(("finding", self.place.0));
        let response = ui.interact(rect, id, Sense::click());
        paint_row_ground(ui, rect, &response, false, response.contains_pointer() || is_shown);
        let dot = rect.min + vec2(4.0, 14.0);
        ui.painter().circle_filled(dot, 3.0, color(ui, diagnostic.severity));
        let at = rect.min + vec2(INDENT, 0.5 * AROUND);
        ui.painter().galley(at, galley, Tokens::of(ui).text);
        let about = goal.map(|goal| format!("\nGo to {}", goal.words)).unwrap_or_default();
        let label = format!(
            "{} {}: {}{about}",
            diagnostic.severity, diagnostic.code, diagnostic.message
        );
        response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, &label));
        response.on_hover_cursor(CursorIcon::PointingHand)
    }

    /// The lines of the file, what belonged there, and how to mend it for good.
    fn details(&self, ui: &mut Ui, cx: &mut Cx<'_, UiState>) {
        let diagnostic = self.diagnostic;
        let shown = cx.state.findings.shown.as_ref();
        if let Some(lines) = shown.and_then(|shown| shown.excerpt.as_ref()) {
            ui.add_space(4.0);
            show_excerpt(ui, lines, color(ui, diagnostic.severity));
        }
        ui.add_space(4.0);
        if let Some(expected) = expected_and_found(diagnostic) {
            ui.label(RichText::new(expected).size(12.5).color(Tokens::of(ui).text));
        }
        explanation(ui, diagnostic.code, &mut cx.state.requests);
        if let Some(code) = codes::named(diagnostic.code) {
            show_keep_mended(ui, code, cx.state);
        }
        if diagnostic.code == codes::TRIANGLES_TURNED_AWAY.name {
            sides(ui, cx.session, cx.commands);
        }
        ui.add_space(8.0);
    }

    /// The occurrences, if there are several. A click shows the lines of one, and goes to its part.
    fn occurrences(&self, ui: &mut Ui, list: &mut RowList, cx: &mut Cx<'_, UiState>, open: &OpenModel) {
        let tokens = Tokens::of(ui);
        let diagnostic = self.diagnostic;
        let known = diagnostic.occurrences();
        let listed = known.len();
        if listed < 2 {
            return;
        }
        let chosen = cx.state.findings.shown.as_ref().map(|shown| shown.occurrence);
        for (index, (subject, position, moment)) in known.enumerate() {
            let goal = subject.and_then(|subject| Goal::of(cx.session, open, subject, moment));
            let line = position.map(|position| format!("line {}", position.line));
            let words: Vec<&str> = goal
                .iter()
                .map(|goal| goal.words.as_str())
                .chain(line.as_deref())
                .collect();
            let words = words.join(" · ");
            let is_chosen = chosen == Some(index);
            let row = Row::pressable(ui, is_chosen);
            let (at, font) = (pos2(row.left + INDENT, row.y), FontId::proportional(12.0));
            paint_elided(ui.painter(), at, &words, font, tokens.accent, row.rect.width() - INDENT);
            let response = row.told(Role::ListItem, format!("Go to {words}"));
            list.row(&response, is_chosen);
            if response.on_hover_cursor(CursorIcon::PointingHand).clicked() {
                if let Some(shown) = &mut cx.state.findings.shown {
                    shown.choose(open, index);
                }
                if let Some(goal) = goal {
                    goal.go(cx);
                }
            }
        }
        let more = (diagnostic.count as usize).saturating_sub(listed);
        if listed == Diagnostic::MOST_PLACES && more > 0 {
            ui.add_space(2.0);
            let words = RichText::new(format!("and {} more", grouped(more)));
            ui.horizontal(|ui| {
                ui.add_space(INDENT);
                ui.label(words.size(12.0).color(tokens.muted));
            });
        }
    }
}

/// The other way to draw materials with one side, and back.
fn sides(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let both = session.materials().iter().any(|material| !material.double_sided);
    let label = if both {
        "Draw both sides"
    } else {
        "Draw sides as in the file"
    };
    ui.add_space(4.0);
    if TextButton::new(label, label).show(ui).clicked() {
        commands.push(MaterialCommand::DrawBothSides(both).into());
    }
}

/// Says how to write the mended file, with a button for Export where an export does it.
fn show_keep_mended(ui: &mut Ui, code: &Code, state: &mut UiState) {
    let Some(words) = code.permanent() else { return };
    ui.add_space(6.0);
    let words = RichText::new(words.replace('`', "")).size(12.5);
    ui.label(words.color(Tokens::of(ui).text));
    if code.mended == Mended::WithFix {
        return;
    }
    ui.add_space(4.0);
    let button = TextButton::new(actions::EXPORT.label, "Export the model as it is mended");
    if button.show(ui).on_hover_text(actions::EXPORT.hint()).clicked() {
        export::open(ui, state);
    }
}

/// What findings of a code mean, and how to mend them for good.
pub(super) fn explanation(ui: &mut Ui, code: &'static str, requests: &mut Vec<Request>) {
    let words = codes::named(code).map(Code::help);
    about(ui, words.as_deref(), code, requests);
}

/// How to mend findings of a code for good.
pub(super) fn mending(ui: &mut Ui, code: &'static str, requests: &mut Vec<Request>) {
    about(ui, codes::named(code).map(|code| code.mending), code, requests);
}

/// Words about a code, and the code, which leads to its place on the page of codes.
fn about(ui: &mut Ui, words: Option<&str>, code: &'static str, requests: &mut Vec<Request>) {
    if let Some(words) = words {
        let words = RichText::new(words.replace('`', "")).size(12.5);
        ui.label(words.color(Tokens::of(ui).muted));
    }
    let link = ui.link(RichText::new(code).font(theme::mono(11.0)));
    if link.on_hover_text("What it means, with an example").clicked() {
        requests.push(Request::ExplainCode(code));
    }
}

/// Tells programs that read the screen whether something is unfolded. Returns whether to fold or unfold it.
pub(super) fn tell_fold(ui: &Ui, response: &Response, is_open: bool) -> bool {
    // A row of a list is drawn as the chosen one too.
    tell_node(response, |node| node.clear_selected());
    let asked = tell_folds(ui, response.id, is_open);
    response.clicked() || asked
}
