//! Naming joints: a field in the row, and names proposed for the other side.

use egui::{FontId, Id, Key, Rangef, Rect, Role, TextEdit, Ui, Vec2, WidgetInfo, vec2};

use crate::model::{Handedness, JointIndex, UpAxis};
use crate::session::{Command, NameCommand, Session};
use crate::ui::cx::Cx;
use crate::ui::kit::theme::{ROW_HEIGHT, Tokens};
use crate::ui::kit::{Kept, Row, TextButton, control_size, section_name, select_all};
use crate::ui::window::panel::scrolled;

/// Naming waits so long for its row to scroll into view, in seconds …
const LONGEST_WAIT_SECS: f64 = 1.0;
/// … and at least this many passes.
const LONGEST_WAIT_PASSES: u32 = 10;

#[derive(Debug, Default)]
pub(super) struct Naming {
    pub(super) of: Option<JointIndex>,
    text: String,
    stage: Stage,
    /// A key began it in the joint's row, which gets the focus back.
    by_key: bool,
    /// The list of proposed names stands in place of the tree.
    pub(super) proposing: bool,
    /// The names proposed last, by bone.
    proposed: Kept<ProposedFor, Vec<(usize, String)>>,
}

/// A model, its names and its axes.
type ProposedFor = (u64, u64, Handedness, UpAxis);

#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Stage {
    /// Its field has the focus. `shown`: in this pass.
    Typing { shown: bool },
    /// Its field was not shown yet, since this time in seconds and for so many passes.
    Begins { at_secs: f64, passes: u32 },
    #[default]
    Idle,
}

impl Naming {
    pub(super) fn begin(&mut self, ui: &Ui, session: &Session, joint: JointIndex) {
        *self = Self {
            of: Some(joint),
            text: session.joint_name(joint).unwrap_or_default().to_owned(),
            stage: Stage::Begins {
                at_secs: ui.input(|input| input.time),
                passes: 0,
            },
            ..Self::default()
        };
        // Focus the field at once, so that it gets the first letters.
        ui.memory_mut(|memory| memory.request_focus(field_id()));
    }

    /// The same by a key in the joint's row. The row gets the focus back when a key ends the naming.
    pub(super) fn begin_by_key(&mut self, ui: &Ui, session: &Session, joint: JointIndex) {
        self.begin(ui, session, joint);
        self.by_key = true;
    }

    /// Whether its field was not shown yet.
    pub(super) fn awaits_field(&self) -> bool {
        matches!(self.stage, Stage::Begins { .. })
    }

    /// Ends a pass. Accepts the typed name if the row went out of view. Cancels if the field never appeared.
    pub(super) fn settle(&mut self, ui: &Ui, commands: &mut Vec<Command>) {
        match &mut self.stage {
            Stage::Typing { shown: shown @ true } => *shown = false,
            Stage::Typing { shown: false } => self.take_name(commands),
            Stage::Begins { at_secs, passes } => {
                *passes += 1;
                if *passes > LONGEST_WAIT_PASSES && ui.input(|input| input.time) - *at_secs > LONGEST_WAIT_SECS {
                    *self = Self::default();
                }
            }
            Stage::Idle => {}
        }
    }

    fn take_name(&mut self, commands: &mut Vec<Command>) {
        let naming = std::mem::take(self);
        if let Some(joint) = naming.of {
            commands.push(Command::Name(NameCommand::Rename {
                joint,
                name: naming.text,
            }));
        }
    }
}

/// Room around the letters of the field.
const FIELD_MARGIN: Vec2 = vec2(4.0, 0.0);

fn field_id() -> Id {
    Id::unique("joint name")
}

/// The field in place of a joint's name, whose letters stand where the name's do. Enter or a click elsewhere accepts the name, Esc
/// cancels. Returns whether the row gets the focus back.
pub(super) fn show_field(ui: &mut Ui, cx: &mut Cx<'_, Naming>, name: Rect, unnamed: &str) -> bool {
    let naming = &mut *cx.state;
    let begins = naming.awaits_field();
    if begins {
        select_all(ui, field_id(), &naming.text);
    }
    let place = name.expand2(vec2(FIELD_MARGIN.x, -1.0));
    let field = TextEdit::singleline(&mut naming.text)
        .id(field_id())
        .char_limit(64)
        .hint_text(unnamed)
        .font(FontId::proportional(13.0))
        .text_color(Tokens::of(ui).text)
        .margin(FIELD_MARGIN)
        .min_size(place.size())
        .desired_width(place.width())
        .align(egui::Align2::LEFT_CENTER);
    let centered = egui::Layout::left_to_right(egui::Align::Center);
    let mut row = ui.new_child(egui::UiBuilder::new().max_rect(place).layout(centered));
    // No higher than the row.
    row.spacing_mut().interact_size.y = place.height();
    let response = row.add(field);
    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, "Name of the bone"));
    naming.stage = Stage::Typing { shown: true };
    if begins {
        response.request_focus();
    } else if !response.has_focus() {
        let [escape, enter] = [Key::Escape, Key::Enter].map(|key| ui.input(|input| input.key_pressed(key)));
        let by_key = naming.by_key;
        if escape {
            *naming = Naming::default();
        } else {
            naming.take_name(cx.commands);
        }
        return by_key && (escape || enter);
    }
    false
}

/// Gap between the proposed names and the buttons below them.
const BUTTONS_GAP: f32 = 10.0;

/// The names proposed for mirrored joints, to accept or refuse.
pub(super) fn show_proposals(ui: &mut Ui, cx: &mut Cx<'_, Naming>) {
    let tokens = Tokens::of(ui);
    let session = cx.session;
    let (model, names) = (session.model_revision(), session.joint_names_revision());
    let of = (model, names, session.handedness(), session.up_axis());
    let proposed = cx
        .state
        .proposed
        .of(of, || session.proposed_names().into_iter().collect());
    section_name(ui, "Mirrored names");
    if proposed.is_empty() {
        let words = if cx.session.joint_names().is_empty() {
            "Name bones of one side first: double click a bone, or press F2."
        } else {
            "There are no names to propose: both bones of each pair are named, or neither is."
        };
        ui.label(egui::RichText::new(words).color(tokens.muted));
    }
    let most = ui.available_height() - BUTTONS_GAP - control_size(ui);
    let list = scrolled("proposed", most.max(3.0 * ROW_HEIGHT));
    let rows = list.auto_shrink([false, true]);
    rows.show_rows(ui, ROW_HEIGHT, proposed.len(), |ui, range| {
        for (bone, name) in &proposed[range] {
            let mut row = Row::new(ui, ROW_HEIGHT);
            row.left(&format!("Bone {bone}"), tokens.muted);
            row.left = row.rect.min.x + 76.0;
            row.name(name, tokens.text);
            row.told(Role::Label, format!("Bone {bone} would be {name}"));
        }
    });
    ui.add_space(BUTTONS_GAP);
    ui.horizontal(|ui| {
        let wide = Rangef::new(control_size(ui), f32::INFINITY);
        if !proposed.is_empty() {
            let words = format!("Take {}", proposed.len());
            if TextButton::new(&words, "Take the proposed names")
                .width(wide)
                .show(ui)
                .clicked()
            {
                cx.commands.push(NameCommand::AcceptMirrored.into());
                cx.state.proposing = false;
            }
        }
        if TextButton::new("Back", "Back to the tree")
            .width(wide)
            .show(ui)
            .clicked()
        {
            cx.state.proposing = false;
        }
    });
}
