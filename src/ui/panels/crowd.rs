//! How many instances of the model there are, which one is selected, and what a frame of them costs.

use egui::Ui;

use super::cost::SteadyCost;
use crate::session::{CrowdCommand, MAX_CROWD};
use crate::ui::cx::Cx;
use crate::ui::kit::icons::Icon;
use crate::ui::kit::wording::{bytes, grouped, milliseconds};
use crate::ui::kit::{TypedValue, control_size, hint_beside, push_button, section_name, segmented, value_row};

/// Sizes of a crowd to choose from.
const COUNTS: [usize; 4] = [1, 10, 100, MAX_CROWD];
/// Width of a field: the selected one of the largest crowd fits.
const FIELD_WIDTH: f32 = 116.0;
/// The least width of the seed beside its button.
const SEED_WIDTH: f32 = 86.0;
const HINT: &str = "Click to type";

/// The section. One model alone has neither seed nor selection nor costs.
pub(in crate::ui) fn show(ui: &mut Ui, cx: &mut Cx<'_, SteadyCost>) {
    let crowd = cx.session.crowd();
    section_name(ui, "Crowd");
    let labels = COUNTS.map(grouped);
    let choices: Vec<_> = COUNTS.into_iter().zip(labels.iter().map(String::as_str)).collect();
    if let Some(count) = segmented(ui, "Crowd", &choices, Some(crowd.count)) {
        let seed = crowd.seed;
        cx.push(CrowdCommand::Set { count, seed });
    }
    if crowd.count > 1 {
        ui.add_space(4.0);
        seed_row(ui, cx);
        ui.add_space(4.0);
        selected_row(ui, cx);
        cost_rows(ui, cx);
    }
}

fn seed_row<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let crowd = cx.session.crowd();
    let button = button_width(ui);
    let seed = crowd.seed.to_string();
    let read = |typed: &str| {
        let typed = typed.trim().parse::<u32>();
        typed.map_err(|_| format!("A whole number up to {}", u32::MAX))
    };
    let asked = ui.horizontal(|ui| {
        let field = TypedValue::new(ui, "Seed", &seed, &seed).width(field_width(ui) - button);
        let typed = field.row(ui, button, ("", HINT), read);
        let another = push_button(ui, Icon::Dice, "Another seed").clicked();
        typed.or(another.then_some(crowd.seed.wrapping_add(1)))
    });
    if let Some(seed) = asked.inner {
        let count = crowd.count;
        cx.push(CrowdCommand::Set { count, seed });
    }
}

/// Which instance timeline, skeleton and read-outs are of. The first is 1.
fn selected_row<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let crowd = cx.session.crowd();
    let count = crowd.count;
    let number = (crowd.selected + 1).to_string();
    let text = format!("{} of {}", grouped(crowd.selected + 1), grouped(count));
    let read = |typed: &str| {
        // As the field shows it: `1 000 of 1 000`.
        let (digits, _) = typed.split_once("of").unwrap_or((typed, ""));
        let digits: String = digits.chars().filter(|letter| !letter.is_whitespace()).collect();
        let number = digits.parse().ok();
        let number = number.filter(|number| (1..=count).contains(number));
        number.ok_or_else(|| format!("A number from 1 to {count}"))
    };
    let field = TypedValue::new(ui, "Selected", &text, &number).width(field_width(ui));
    let asked = ui.horizontal(|ui| field.row(ui, 0.0, ("", HINT), read));
    if let Some(number) = asked.inner {
        cx.push(CrowdCommand::Select(number - 1));
    }
}

fn field_width(ui: &Ui) -> f32 {
    FIELD_WIDTH.max(SEED_WIDTH + button_width(ui))
}

fn button_width(ui: &Ui) -> f32 {
    control_size(ui) + ui.spacing().item_spacing.x
}

fn cost_rows(ui: &mut Ui, cx: &mut Cx<'_, SteadyCost>) {
    let cost = cx.state.read(ui, cx.session);
    let gpu_secs = cost.gpu_secs.map(|passes| passes.iter().sum());
    let frame_secs = Some(cx.session.quality().frame_secs()).filter(|secs| *secs > 0.0);
    let rows = [
        (
            "Time",
            frame_secs.map(milliseconds),
            "From frame to frame while the picture moves: three of four take no longer",
        ),
        (
            "CPU",
            cost.cpu_secs.map(milliseconds),
            "Time to pose and draw the last frame",
        ),
        (
            "GPU",
            gpu_secs.map(milliseconds),
            "Time of all passes, some frames ago: its answer takes a while",
        ),
        (
            "Vertices",
            Some(grouped(cost.vertices as usize)),
            "Vertices transformed in all passes of the last frame",
        ),
        (
            "Uploaded",
            Some(bytes(cost.uploaded_bytes)),
            "Bytes sent to the GPU for the last frame",
        ),
    ];
    for (label, value, words) in rows {
        if let Some(value) = value {
            let row = value_row(ui, &format!("{label} a frame"), &value);
            hint_beside(row, None, words);
        }
    }
}
