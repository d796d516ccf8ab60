//! The selected subset: its counts, its material to be changed, its maps.

use egui::{Align2, FontId, Rect, Sense, Ui, Vec2, pos2, vec2};

use super::icons::Icon;
use super::material_fields;
use super::state::UiState;
use super::subset_list::{paint_swatch, shown_color};
use super::textures::{holds, picture_row};
use super::theme::{self, MARGIN, ROW_HEIGHT, Tokens};
use super::widgets::{control_size, icon_button, paint_elided, rule, section_name, section_with_action, value_row};
use super::wording::grouped;
use crate::model::{Mesh, Submesh};
use crate::session::{Command, MapSlot, OpenModel, Session, SubsetCommand};

/// Height of the heading, as in the panel on the left.
const HEADING_HEIGHT: f32 = 22.0;

/// Vertices of the subset that was counted last.
#[derive(Debug, Default)]
pub(super) struct VertexCount {
    of: Option<(u64, usize)>,
    count: usize,
}

impl VertexCount {
    /// How many vertices the triangles of a subset use.
    fn of(&mut self, model_revision: u64, subset: usize, mesh: &Mesh, submesh: &Submesh) -> usize {
        if self.of != Some((model_revision, subset)) {
            let start = submesh.triangle_start as usize * 3;
            let end = start + submesh.triangle_count as usize * 3;
            let mut used: Vec<u32> = mesh.indices.get(start..end).unwrap_or_default().to_vec();
            used.sort_unstable();
            used.dedup();
            *self = Self {
                of: Some((model_revision, subset)),
                count: used.len(),
            };
        }
        self.count
    }
}

/// The panel's contents. Nothing while nothing is selected.
pub(super) fn show(ui: &mut Ui, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
    let (Some(open), Some(subset)) = (session.open_model(), session.subsets().selected()) else {
        return;
    };
    let mesh = &open.model.mesh;
    let Some(submesh) = mesh.submeshes.get(subset) else {
        return;
    };
    let material = submesh.material as usize;
    let Some(values) = session.materials().get(material) else {
        return;
    };

    if heading(ui, &values.name, shown_color(session, material)) {
        commands.push(SubsetCommand::Select(None).into());
    }
    rule(ui, MARGIN);
    let vertices = state.vertex_count.of(session.model_revision(), subset, mesh, submesh);
    value_row(ui, "Subset", &format!("{} of {}", subset + 1, mesh.submeshes.len()));
    value_row(ui, "Triangles", &grouped(submesh.triangle_count as usize));
    value_row(ui, "Vertices", &grouped(vertices));
    rule(ui, MARGIN);
    let action = session.is_edited(material).then_some("Reset");
    if section_with_action(ui, "Material", action) {
        commands.push(Command::ResetMaterial(material));
    }
    if let Some(edited) = material_fields::show(ui, values) {
        commands.push(Command::EditMaterial {
            index: material,
            material: edited,
        });
    }
    if MapSlot::ALL.iter().any(|slot| slot.name_in(values).is_some()) {
        rule(ui, MARGIN);
        section_name(ui, "Maps");
        for slot in MapSlot::ALL {
            map_row(ui, session, open, state, material, slot);
        }
    }
}

/// The name in its colour, and a button that closes. Whether it was clicked.
fn heading(ui: &mut Ui, name: &str, color: [f32; 3]) -> bool {
    let size = vec2(ui.available_width(), HEADING_HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    paint_swatch(ui, rect.left_center() + vec2(5.0, 0.0), color, 1.0);
    let side = control_size(ui);
    let at = pos2(rect.min.x + 18.0, rect.center().y);
    let (font, most) = (theme::semibold(13.0), rect.max.x - side - at.x);
    paint_elided(ui.painter(), at, name, font, Tokens::of(ui).text, most);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, format!("Selected: {name}")));
    // The cross stands where the edges of the rows below end, and its field around it.
    let place = Rect::from_center_size(rect.right_center() - vec2(8.0, 0.0), Vec2::splat(side));
    // Apart from the rows, which it must not make wider.
    let mut corner = ui.new_child(egui::UiBuilder::new().max_rect(place));
    icon_button(&mut corner, Icon::Close, "Clear the selection (Esc)", false).clicked()
}

/// A map that the material names: the picture, or that it is missing.
fn map_row(ui: &mut Ui, session: &Session, open: &OpenModel, state: &mut UiState, material: usize, slot: MapSlot) {
    let of_file = open.model.materials.get(material);
    let Some(name) = of_file.and_then(|material| slot.name_in(material)) else {
        return;
    };
    let what = match slot {
        MapSlot::Diffuse => "Diffuse",
        MapSlot::Normal => "Normal",
    };
    let used = session.maps().used().find(|map| map.users.contains(&(material, slot)));
    if let Some(map) = used {
        let thumbnail = state.thumbnails.of(ui.ctx(), session, &map);
        let details = format!("{what} map: {}\n{}", map.file.path, holds(map.image));
        picture_row(ui, thumbnail, map.file.base_name(), map.image, &details);
        return;
    }
    let missing = session.maps().checklist().missing.iter().any(|other| other == name);
    let (words, hint) = if missing {
        ("missing", "Drop it any time.")
    } else {
        ("unreadable", "See the diagnostics.")
    };
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW_HEIGHT), Sense::hover());
    let font = FontId::proportional(13.0);
    let (right, color) = (rect.right_center(), tokens.warning);
    let drawn = ui
        .painter()
        .text(right, Align2::RIGHT_CENTER, words, font.clone(), color);
    let room = drawn.min.x - 8.0 - rect.min.x;
    paint_elided(ui.painter(), rect.left_center(), name, font, tokens.muted, room);
    response.widget_info(|| {
        let label = format!("{what} map: {name}, {words}");
        egui::WidgetInfo::labeled(egui::Role::Label, true, label)
    });
    response.on_hover_text(format!("{what} map: {name}\n{hint}"));
}
