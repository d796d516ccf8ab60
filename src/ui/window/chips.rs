//! Chips over the view: the modes that change what is seen, and files that are being written or opened, each with a cross that ends it.

use egui::{Color32, FontId, Galley, Rect, Role, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, pos2, vec2};
use std::sync::Arc;

use crate::actions::{self, Action};
use crate::anim::SkinView;
use crate::scene::joint_colors;
use crate::session::{
    Command, CrowdCommand, ExportCommand, FileCommand, GHOSTS_SRGB, LookCommand, PlayCommand, Session, SubmeshCommand,
};
use crate::slices::{Stage, StageProgress};
use crate::ui::cx::Cx;
use crate::ui::kit::icons::{self, Icon};
use crate::ui::kit::theme::{self, Tokens};
use crate::ui::kit::wording::{grouped, shortened};
use crate::ui::kit::{control_size, elided_name, focus_ring, is_touch};
use crate::ui::state::{Chrome, UiState};

/// Height of a chip that is drawn. Its target is as high as a control.
const HEIGHT: f32 = 24.0;
/// Room before and behind the words.
const PADDING: f32 = 10.0;
const CROSS: f32 = 12.0;
/// Room between the parts of a chip.
const GAP: f32 = 6.0;
/// Room between chips.
const SPACING: f32 = 6.0;
/// Height of the bar of a chip that counts.
const BAR: f32 = 3.0;
/// An opening that takes longer is told.
const SHOWN_AFTER_SECS: f64 = 0.2;
/// Letters of the name of a file that is being opened, at most.
const MOST_NAME: usize = 24;
/// Width of the mark of a colour, and the most in a chip.
const MARK: f32 = 12.0;
const MOST_MARKS: usize = 3;
/// A longer name of a subset or a bone ends in an ellipsis.
const MOST_WORDS: f32 = 220.0;
/// The same of a chip that counts, which is as wide whatever the number.
const MOST_COUNTED: f32 = 320.0;

/// A mode that is on, and the command that ends it.
struct Mode {
    words: String,
    /// The key that ends it too, or none.
    key: &'static str,
    ends: Command,
    /// What the button is called.
    name: String,
    /// The colours that it has in the picture.
    marks: Vec<Color32>,
    /// How much of it is done, 0…1, of what ends by itself.
    done: Option<f32>,
}

impl Mode {
    fn new(words: String, action: Option<&Action>, ends: impl Into<Command>) -> Self {
        Self {
            name: leave("", &words),
            words,
            key: action.map_or("", Action::key),
            ends: ends.into(),
            marks: Vec::new(),
            done: None,
        }
    }

    /// Marked with the colours that it has in the picture, sRGB.
    fn marked(self, srgb: impl IntoIterator<Item = [u8; 3]>) -> Self {
        let marks = srgb.into_iter().take(MOST_MARKS);
        let marks = marks
            .map(|[red, green, blue]| Color32::from_rgb(red, green, blue))
            .collect();
        Self { marks, ..self }
    }

    fn with_article(self) -> Self {
        Self {
            name: leave("the ", &self.words),
            ..self
        }
    }
}

/// `Leave bind pose`, `Leave the range 20–40`.
fn leave(article: &str, words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(|letter| letter.to_lowercase().to_string());
    format!("Leave {article}{}{}", first.unwrap_or_default(), letters.as_str())
}

/// A file that is being written. Its name stays while the number grows.
fn export(session: &Session) -> Option<Mode> {
    let progress = session.export()?.saving?;
    let words = format!("Writing {} {} %", session.export_name()?, progress.percent());
    Some(Mode {
        name: "Cancel the export".to_owned(),
        ..Mode::new(words, None, ExportCommand::Cancel)
    })
}

/// What a person reads of a stage.
fn words(stage: Stage) -> &'static str {
    match stage {
        Stage::Reading => "parsing",
        Stage::Compiling => Stage::Checking.as_str(),
        Stage::Joining => "adding clips",
        Stage::Judging => "finishing",
        stage => stage.as_str(),
    }
}

/// What is being opened, once that has taken a while. Its name stays while the number grows.
fn opening(session: &Session, state: &mut UiState, now_secs: f64) -> Option<Mode> {
    let Some(opened) = session.being_opened() else {
        state.opening_since = None;
        return None;
    };
    let since_secs = *state.opening_since.get_or_insert(now_secs);
    if now_secs - since_secs < SHOWN_AFTER_SECS {
        return None;
    }
    let StageProgress { stage, done, total, .. } = opened.progress;
    let mega = |bytes: usize| format!("{:.1}", bytes as f64 * 1e-6);
    let percent = opened.progress.percent();
    // The number of the bar stands beside that of the stage, but for one that has numbers of its own.
    let number = if stage == Stage::Fetching {
        String::new()
    } else {
        format!(" · {percent} %")
    };
    let stage = match stage {
        Stage::Fetching if done == 0 => "waiting for its bytes".to_owned(),
        Stage::Fetching if total < done => format!("{} MB", mega(done)),
        Stage::Fetching => format!("{} of {} MB", mega(done), mega(total)),
        Stage::Decoding => format!("picture {} of {total}", total.min(done + 1)),
        stage => words(stage).to_owned(),
    };
    let name = shortened(opened.name, MOST_NAME);
    Some(Mode {
        name: format!("Cancel opening {name}"),
        done: Some(percent as f32 * 0.01),
        ..Mode::new(
            format!("Opening {name}: {stage}{number}"),
            None,
            FileCommand::CancelOpening,
        )
    })
}

/// The modes that are on, in the order of their chips.
fn modes(session: &Session) -> Vec<Mode> {
    let look = session.look();
    let playback = session.playback();
    let mut modes = Vec::new();
    let bind_weight = session.bind_weight();
    if session.clip().is_some() && bind_weight > 0.0 {
        let words = match bind_weight {
            1.0.. => "Bind pose".to_owned(),
            share => format!("Bind pose {:.0} %", share * 100.0),
        };
        let key = Some(&actions::BIND_POSE).filter(|_| bind_weight >= 0.5);
        modes.push(Mode::new(words, key, PlayCommand::SetBindWeight(0.0)));
    }
    let crowd = session.crowd();
    if crowd.count > 1 {
        let words = format!("Crowd of {}", grouped(crowd.count));
        let alone = CrowdCommand::Set {
            count: 1,
            seed: crowd.seed,
        };
        modes.push(Mode::new(words, None, alone).with_article());
    }
    if let Some(submesh) = session.submeshes().solo() {
        let name = session.submesh_name(submesh);
        modes.push(Mode::new(format!("Only {name}"), None, SubmeshCommand::Solo(submesh)));
    }
    if let (Some(clip), Some([start_secs, end_secs])) = (session.clip(), playback.range_secs()) {
        let [start, end] = [start_secs, end_secs].map(|secs| clip.frame_at(secs));
        let words = format!("Range {start}–{end}");
        let clear = Some(&actions::CLEAR_RANGE);
        modes.push(Mode::new(words, clear, PlayCommand::ClearRange).with_article());
    }
    if let Some(view) = look.skin_view {
        let leaves = LookCommand::SetSkinView(None);
        let joints = session.joints();
        // A bone that is only pointed at would make the chip change under the pointer.
        let of_vertex = || session.weighed_joint().filter(|_| joints.selected_vertex().is_some());
        let joint = joints.selected().or_else(of_vertex);
        modes.push(match (view, joint) {
            (SkinView::Weight, Some(joint)) => {
                let words = format!("Weights of {}", session.joint_label(joint));
                Mode::new(words, Some(&actions::WEIGHTS), leaves)
            }
            (SkinView::Weight, None) => Mode::new(view.label().to_owned(), Some(&actions::WEIGHTS), leaves),
            _ => Mode::new(view.label().to_owned(), None, leaves),
        });
    }
    let [past, future, bind] = GHOSTS_SRGB;
    if let (Some(plan), Some(_)) = (look.ghosts, session.clip()) {
        let words = format!("Ghosts {} + {}", plan.before, plan.after);
        modes.push(Mode::new(words, None, LookCommand::SetGhosts(None)).marked([past, future]));
    }
    if look.bind_ghost {
        let words = "Ghost of the bind pose".to_owned();
        let leaves = LookCommand::SetBindGhost(false);
        modes.push(Mode::new(words, None, leaves).with_article().marked([bind]));
    }
    if let (Some(open), Some(_)) = (session.open_model(), session.clip())
        && !look.trails.is_empty()
    {
        let words = match look.trails[..] {
            [joint] => format!("Trail of {}", session.joint_label(joint)),
            ref trails => format!("Trails {}", trails.len()),
        };
        let colors = joint_colors(&open.model.skeleton);
        let colors = look.trails.iter().filter_map(|joint| colors.get(joint.index()));
        let mode = Mode::new(words, None, LookCommand::ClearTrails);
        modes.push(mode.marked(colors.map(|&[red, green, blue, _]| [red, green, blue])));
    }
    if let Some(stops) = actions::TURNTABLE.command(session).filter(|_| session.turntable()) {
        modes.push(Mode::new("Turntable".to_owned(), None, stops).with_article());
    }
    if session.clip().is_some() && playback.speed() != 1.0 {
        let words = format!("Speed {}", actions::speed_label(playback.speed()));
        modes.push(Mode::new(
            words,
            Some(&actions::NORMAL_SPEED),
            PlayCommand::SetSpeed(1.0),
        ));
    }
    modes
}

struct Chip {
    mode: Mode,
    words: Arc<Galley>,
    key: Arc<Galley>,
    width: f32,
}

impl Chip {
    fn new(ui: &Ui, mode: Mode, most: f32) -> Self {
        let tokens = Tokens::of(ui);
        let font = FontId::proportional(12.0);
        let longest = if mode.done.is_some() { MOST_COUNTED } else { MOST_WORDS };
        let words = elided_name(ui.painter(), &mode.words, font, tokens.text, longest.min(most));
        let shown_key = if is_touch(ui) { "" } else { mode.key };
        let key = ui
            .painter()
            .layout_no_wrap(shown_key.to_owned(), theme::mono(11.0), tokens.muted);
        let behind = if shown_key.is_empty() { 0.0 } else { GAP + key.size().x };
        let marks = mode.marks.len() as f32 * MARK;
        // One that counts keeps its width.
        let words_width = mode.done.map_or(0.0, |_| MOST_COUNTED.min(most)).max(words.size().x);
        let width = 2.0 * PADDING + marks + words_width + behind + GAP + CROSS;
        Self {
            mode,
            words,
            key,
            width,
        }
    }

    /// Shows it. Returns whether it was pressed.
    fn show(&self, ui: &Ui, index: usize, place: Rect) -> bool {
        let tokens = Tokens::of(ui);
        let name = self.mode.name.clone();
        let response = ui.interact(place, ui.scope_id().with(("mode", index)), Sense::click());
        let chip = Rect::from_center_size(place.center(), vec2(place.width(), HEIGHT.min(place.height())));
        let radius = 0.5 * chip.height();
        let painter = ui.painter();
        painter.rect(
            chip,
            radius,
            tokens.panel,
            Stroke::new(1.0, tokens.hairline),
            StrokeKind::Inside,
        );
        if response.hovered() {
            painter.rect_filled(chip, radius, tokens.field_hovered);
        }
        if let Some(done) = self.mode.done {
            let part = chip.with_max_x(chip.min.x + done * chip.width());
            painter
                .with_clip_rect(part)
                .rect_filled(chip, radius, tokens.accent_ground);
            let bar = Rect::from_min_max(pos2(chip.min.x, chip.max.y - BAR), part.max);
            painter.with_clip_rect(bar).rect_filled(chip, radius, tokens.accent);
        }
        let middle = chip.center().y;
        let mut x = chip.min.x + PADDING;
        for &mark in &self.mode.marks {
            painter.circle_filled(pos2(x + 3.0, middle), 4.0, mark);
            x += MARK;
        }
        for (galley, color) in [(&self.words, tokens.text), (&self.key, tokens.muted)] {
            let at = pos2(x, middle - 0.5 * galley.size().y);
            painter.galley(at, Arc::clone(galley), color);
            x += galley.size().x + GAP;
        }
        let cross = Rect::from_center_size(pos2(chip.max.x - PADDING - 0.5 * CROSS, middle), Vec2::splat(CROSS));
        icons::paint(painter, cross, Icon::Close, tokens.muted_to_text(response.hovered()));
        focus_ring(ui, chip, &response);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
        let hint = match self.mode.key {
            "" => name,
            key => format!("{name} ({key})"),
        };
        response.on_hover_text(hint).clicked()
    }
}

/// Shows a chip for each mode, in rows at the top of a room, and one for a file that is written while its panel is not open, and one
/// for what is being opened. Returns the lower edge of the last row of modes.
pub(in crate::ui) fn show(ui: &Ui, cx: &mut Cx<'_, UiState>, room: Rect, export_is_open: bool) -> Option<f32> {
    let opening = opening(cx.session, cx.state, ui.input(|input| input.time));
    if room.width() < 2.0 * control_size(ui) {
        return None;
    }
    // On other people's pages the transport says what there is to say of them, or nothing does.
    let modes = if cx.session.open_model().is_some() && cx.state.chrome == Chrome::Full {
        modes(cx.session)
    } else {
        Vec::new()
    };
    // The view is not framed anew for what goes by itself.
    let lasting = modes.len();
    let most = room.width() - 2.0 * PADDING - GAP - CROSS - 40.0;
    let chips: Vec<Chip> = modes
        .into_iter()
        .chain(export(cx.session).filter(|_| !export_is_open))
        .chain(opening)
        .map(|mode| Chip::new(ui, mode, most))
        .collect();
    let height = if is_touch(ui) { control_size(ui) } else { HEIGHT };
    let step = if is_touch(ui) { height } else { height + SPACING };
    // The names of the lights stand at the top while the picture is divided.
    let top = room.min.y
        + if cx.session.look().split.is_some() {
            HEIGHT + SPACING
        } else {
            0.0
        };
    let (mut index, mut bottom) = (0, None);
    for row in 0.. {
        let (mut width, mut end) = (0.0, index);
        while let Some(chip) = chips.get(end)
            && (end == index || width + SPACING + chip.width <= room.width())
        {
            width += chip.width + if end == index { 0.0 } else { SPACING };
            end += 1;
        }
        if end == index {
            break;
        }
        let mut left = room.center().x - 0.5 * width;
        let y = top + row as f32 * step;
        if index < lasting {
            bottom = Some(y + 0.5 * (height + HEIGHT));
        }
        for chip in &chips[index..end] {
            let place = Rect::from_min_size(pos2(left, y), vec2(chip.width, height));
            if chip.show(ui, index, place) {
                cx.commands.push(chip.mode.ends.clone());
            }
            left += chip.width + SPACING;
            index += 1;
        }
    }
    bottom
}
