//! All diagnostics of the open file, with subject, position and code. A click shows the lines of the file, and goes to the joint,
//! submesh, clip or vertex that is the subject.

use egui::{CursorIcon, FontId, Role, Sense, Ui, WidgetInfo, vec2};

use super::error_card::show_excerpt;
use super::panel::scrolled;
use super::skeleton::state::SidePage;
use super::state::{ShownDiagnostic, UiState};
use super::theme::{MARGIN, Tokens};
use super::widgets::{RowList, closable_heading, paint_elided, paint_row_ground, pressed_row, rule};
use super::wording::grouped;
use crate::diagnostic::{Diagnostic, Severity, Subject};
use crate::model::JointIndex;
use crate::session::{Command, JointCommand, LookCommand, OpenModel, PlayCommand, Session, SubmeshCommand, named_maps};

/// The panel's contents.
pub(super) fn show(ui: &mut Ui, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
    let Some(open) = session.open_model() else { return };
    let tokens = Tokens::of(ui);
    if closable_heading(ui, "Diagnostics") {
        state.diagnostics_open = false;
    }
    rule(ui, MARGIN);
    if session.diagnostics().next().is_none() {
        ui.label(egui::RichText::new("Nothing was mended and nothing is odd.").color(tokens.muted));
        return;
    }
    scrolled("diagnostics list", ui.available_height())
        .auto_shrink([false, true])
        .show(ui, |ui| {
            RowList::show(ui, "Diagnostics", |ui, list| {
                for diagnostic in session.diagnostics() {
                    diagnostic_row(ui, list, session, open, diagnostic, state, commands);
                }
            });
        });
}

fn diagnostic_row(
    ui: &mut Ui,
    list: &mut RowList,
    session: &Session,
    open: &OpenModel,
    diagnostic: &Diagnostic,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let tokens = Tokens::of(ui);
    let color = match diagnostic.severity {
        Severity::Error => tokens.error,
        Severity::Warning => tokens.warning,
        Severity::Note => tokens.accent,
    };
    let goal = diagnostic.subject.and_then(|subject| Goal::of(session, open, subject));
    let shown = state
        .shown_diagnostic
        .as_ref()
        .is_some_and(|shown| shown.diagnostic == *diagnostic);
    let mut job = egui::text::LayoutJob::default();
    job.wrap.max_width = ui.available_width() - 16.0;
    let plain = |size: f32, color| egui::TextFormat {
        font_id: FontId::proportional(size),
        color,
        ..Default::default()
    };
    job.append(&diagnostic.message, 0.0, plain(13.0, tokens.text));
    job.append("\n", 0.0, plain(11.5, tokens.muted));
    if let Some(goal) = &goal {
        job.append(&goal.words, 0.0, plain(11.5, tokens.accent));
        job.append(" · ", 0.0, plain(11.5, tokens.muted));
    }
    let place = diagnostic
        .position
        .map(|p| format!("line {}, column {} · ", p.line, p.column))
        .unwrap_or_default();
    job.append(&format!("{place}{}", diagnostic.code), 0.0, plain(11.5, tokens.muted));
    let galley = ui.painter().layout_job(job);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), galley.size().y + 12.0), Sense::click());
    paint_row_ground(ui, rect, &response, false, response.contains_pointer() || shown);
    ui.painter().circle_filled(rect.min + vec2(4.0, 14.0), 3.0, color);
    ui.painter().galley(rect.min + vec2(16.0, 6.0), galley, tokens.text);
    let about = goal
        .as_ref()
        .map(|goal| format!("\nGo to {}", goal.words))
        .unwrap_or_default();
    let label = format!(
        "{} {}: {}{about}",
        diagnostic.severity, diagnostic.code, diagnostic.message
    );
    response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, &label));
    list.row(&response, shown);
    ui.ctx()
        .accesskit_node_builder(response.id, |node| node.set_expanded(shown));
    let response = response.on_hover_cursor(CursorIcon::PointingHand);
    if response.clicked() {
        state.shown_diagnostic = (!shown).then(|| ShownDiagnostic {
            diagnostic: diagnostic.clone(),
            occurrence: 0,
            excerpt: open.excerpt(diagnostic),
        });
        if let Some(goal) = goal.filter(|_| !shown) {
            goal.go(session, state, commands);
        }
    }
    if shown {
        occurrences(ui, list, session, open, diagnostic, state, commands);
    }
    if shown && let Some(lines) = state.shown_diagnostic.as_ref().and_then(|shown| shown.excerpt.as_ref()) {
        ui.add_space(4.0);
        show_excerpt(ui, lines, None, color);
        ui.add_space(8.0);
    }
}

/// The occurrences of a diagnostic, if there are several. A click shows the lines of one, and goes to its part.
fn occurrences(
    ui: &mut Ui,
    list: &mut RowList,
    session: &Session,
    open: &OpenModel,
    diagnostic: &Diagnostic,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let tokens = Tokens::of(ui);
    let known = diagnostic.occurrences();
    let listed = known.len();
    if listed < 2 {
        return;
    }
    let chosen = state.shown_diagnostic.as_ref().map(|shown| shown.occurrence);
    for (index, (subject, position)) in known.enumerate() {
        let goal = subject.and_then(|subject| Goal::of(session, open, subject));
        let line = position.map(|position| format!("line {}", position.line));
        let words: Vec<&str> = goal
            .iter()
            .map(|goal| goal.words.as_str())
            .chain(line.as_deref())
            .collect();
        let words = words.join(" · ");
        let is_chosen = chosen == Some(index);
        let (rect, response) = pressed_row(ui, is_chosen);
        let (at, font) = (rect.left_center() + vec2(16.0, 0.0), FontId::proportional(12.0));
        paint_elided(ui.painter(), at, &words, font, tokens.accent, rect.width() - 16.0);
        response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, format!("Go to {words}")));
        list.row(&response, is_chosen);
        if response.on_hover_cursor(CursorIcon::PointingHand).clicked() {
            let at_this = Diagnostic {
                position,
                ..diagnostic.clone()
            };
            state.shown_diagnostic = Some(ShownDiagnostic {
                diagnostic: diagnostic.clone(),
                occurrence: index,
                excerpt: open.excerpt(&at_this),
            });
            if let Some(goal) = goal {
                goal.go(session, state, commands);
            }
        }
    }
    let more = (diagnostic.count as usize).saturating_sub(listed);
    if listed == Diagnostic::MOST_PLACES && more > 0 {
        ui.add_space(2.0);
        let words = egui::RichText::new(format!("and {} more", grouped(more)));
        ui.horizontal(|ui| {
            ui.add_space(16.0);
            ui.label(words.size(12.0).color(tokens.muted));
        });
    }
}

/// A part of the open model, and how to show it.
struct Goal {
    /// What it is called: `Bone 3`, `Submesh 0`, `Clip walk`.
    words: String,
    /// Select and show it.
    commands: Vec<Command>,
    /// The page of the side panel that lists it, if any.
    page: Option<SidePage>,
}

impl Goal {
    /// How to show a subject. None if the model lacks it, or if no submesh has this material.
    fn of(session: &Session, open: &OpenModel, subject: Subject) -> Option<Self> {
        let mesh = &open.model.mesh;
        match subject {
            Subject::Bone(bone) => {
                let joints = open.model.skeleton.joint_of_bone();
                Some(Self::bone(session, *joints.get(bone as usize)?))
            }
            Subject::Vertex(vertex) => ((vertex as usize) < mesh.vertex_count()).then(|| Self::vertex(vertex)),
            // A triangle cannot be selected; its first corner can.
            Subject::Triangle(triangle) => Some(Self::vertex(*mesh.indices.get(triangle as usize * 3)?)),
            Subject::Subset(submesh) => {
                let submesh = submesh as usize;
                (submesh < mesh.submeshes.len()).then(|| Self::submesh(session, submesh, format!("Subset {submesh}")))
            }
            Subject::Material(material) => {
                let has_it = |submesh: &crate::model::Submesh| submesh.material == material;
                let submesh = mesh.submeshes.iter().position(has_it)?;
                let name = &open.model.materials.get(material as usize)?.name;
                Some(Self::submesh(session, submesh, format!("Material {name}")))
            }
            Subject::Map(map) => {
                let (material, ..) = named_maps(&open.model.materials).nth(map as usize)?;
                Self::of(session, open, Subject::Material(material as u32))
            }
            Subject::Clip(clip) => {
                let name = &open.model.clips.get(clip as usize)?.name;
                Some(Self {
                    words: format!("Clip {name}"),
                    // The timeline shows it.
                    commands: vec![PlayCommand::SelectClip(clip as usize).into()],
                    page: None,
                })
            }
        }
    }

    fn bone(session: &Session, joint: JointIndex) -> Self {
        Self {
            words: session.joint_label(joint),
            commands: vec![
                JointCommand::SelectVertex(None).into(),
                JointCommand::Select(Some(joint)).into(),
                LookCommand::SetBonesVisible(true).into(),
            ],
            page: Some(SidePage::Skeleton),
        }
    }

    fn vertex(vertex: u32) -> Self {
        Self {
            words: format!("Vertex {}", grouped(vertex as usize)),
            commands: vec![
                JointCommand::Select(None).into(),
                JointCommand::SelectVertex(Some(vertex)).into(),
            ],
            page: None,
        }
    }

    fn submesh(session: &Session, submesh: usize, words: String) -> Self {
        let mut commands = vec![SubmeshCommand::Select(Some(submesh)).into()];
        if !session.submeshes().is_visible(submesh) {
            commands.push(SubmeshCommand::SetVisible { submesh, visible: true }.into());
        }
        Self {
            words,
            commands,
            page: Some(SidePage::Model),
        }
    }

    /// Goes there. The selection is framed in the next pass, when its panels are open.
    fn go(self, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
        state.frames_selection = self
            .commands
            .iter()
            .any(|command| matches!(command, Command::Joint(_) | Command::Submesh(_)));
        if let Some(page) = self.page {
            state.skeleton.show_page(session, page);
        }
        commands.extend(self.commands);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::{File, FileCommand};

    /// No model that opens has a diagnostic about a triangle, so no click can lead there yet.
    #[test]
    fn the_way_to_a_triangle_is_that_to_its_first_corner_and_what_is_not_there_has_none() {
        let mut session = Session::new(true);
        session.apply(FileCommand::Add(vec![File::new(
            "figure.m3d",
            include_bytes!("../../web/sample/figure.m3d").to_vec(),
        )]));
        let open = session.open_model().expect("the sample opens");
        let corner = open.model.mesh.indices[3 * 7];
        let goal = Goal::of(&session, open, Subject::Triangle(7)).expect("it has triangles");
        let selects: Command = JointCommand::SelectVertex(Some(corner)).into();
        assert!(goal.commands.contains(&selects));
        let beyond = [
            Subject::Material(9_999_999),
            Subject::Subset(9_999_999),
            Subject::Vertex(9_999_999),
            Subject::Triangle(u32::MAX),
            Subject::Bone(9_999_999),
            Subject::Clip(9_999_999),
        ];
        assert!(
            beyond
                .into_iter()
                .all(|subject| Goal::of(&session, open, subject).is_none())
        );
    }
}
