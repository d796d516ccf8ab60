//! The selected submesh: its counts, its material to edit, its maps.

use std::ops::RangeInclusive;

use egui::{Role, Ui, Vec2, vec2};

use super::model_panel::shown_color;
use super::textures::{holds, picture_row};
use crate::actions::Control;
use crate::model::{AlphaMode, Layers, MapSlot, Material, Mesh, Reflectance, Submesh};
use crate::scene::{linear_from_srgb8, srgb8_from_linear};
use crate::session::{MAX_SPEC_POWER, MaterialCommand, OpenModel, Session, SubmeshCommand};
use crate::ui::cx::Cx;
use crate::ui::kit::theme::{MARGIN, ROW_HEIGHT, Tokens};
use crate::ui::kit::wording::{capital, grouped};
use crate::ui::kit::{
    Label, Row, Slider, color_button, control_size, hint_beside, is_touch, number_field, rule, section_name,
    section_with_action, segmented, selected_heading, switch_row, value_row,
};
use crate::ui::state::UiState;

const LABEL_WIDTH: f32 = 90.0;
const ROUGHNESS: (&str, Control) = ("Roughness", Control::new("roughness"));
/// Room between fields.
const SPACING: f32 = 5.0;

/// The panel's contents. Nothing while nothing is selected.
pub(in crate::ui) fn show(ui: &mut Ui, cx: &mut Cx<'_, UiState>) {
    let session = cx.session;
    let (Some(open), Some(index)) = (session.open_model(), session.submeshes().selected()) else {
        return;
    };
    let mesh = &open.model.mesh;
    let Some(submesh) = mesh.submeshes.get(index) else {
        return;
    };
    let material = submesh.material as usize;
    let Some(values) = session.materials().get(material) else {
        return;
    };

    let swatch = Some(shown_color(session, material));
    if selected_heading(ui, session.submesh_name(index), Tokens::of(ui).text, swatch) {
        cx.push(SubmeshCommand::Select(None));
    }
    rule(ui, MARGIN);
    let of = (session.model_revision(), index);
    let vertices = *cx.state.vertex_count.of(of, || vertex_count(mesh, submesh));
    value_row(ui, "Subset", &format!("{} of {}", index + 1, mesh.submeshes.len()));
    value_row(ui, "Triangles", &grouped(submesh.triangle_count as usize));
    value_row(ui, "Vertices", &grouped(vertices));
    rule(ui, MARGIN);
    let action = session.is_edited(material).then_some("Reset");
    if section_with_action(ui, ("Material", Control::new("reset-material")), action) {
        cx.push(MaterialCommand::Reset(material));
    }
    let of_file = open.model.materials.get(material);
    let of_file = of_file.map(|of_file| of_file.layers).unwrap_or_default();
    if let Some(edited) = material_fields(ui, values, &of_file) {
        cx.push(MaterialCommand::Edit {
            index: material,
            material: Box::new(edited),
        });
    }
    if MapSlot::ALL.into_iter().any(|slot| values.map_name(slot).is_some()) {
        rule(ui, MARGIN);
        section_name(ui, "Maps");
        for slot in MapSlot::ALL {
            map_row(ui, session, open, cx.state, material, slot);
        }
    }
}

/// How many vertices the triangles of a submesh use.
fn vertex_count(mesh: &Mesh, submesh: &Submesh) -> usize {
    let start = submesh.triangle_start as usize * 3;
    let end = start + submesh.triangle_count as usize * 3;
    let mut used: Vec<u32> = mesh.indices.get(start..end).unwrap_or_default().to_vec();
    used.sort_unstable();
    used.dedup();
    used.len()
}

/// A map that the material names: its thumbnail and what it is, or that it is missing.
fn map_row(ui: &mut Ui, session: &Session, open: &OpenModel, state: &mut UiState, material: usize, slot: MapSlot) {
    let of_file = open.model.materials.get(material);
    let Some(name) = of_file.and_then(|material| material.map_name(slot)) else {
        return;
    };
    let what = capital(slot.label());
    let used = session.maps().used().find(|map| map.users.contains(&(material, slot)));
    if let Some(map) = used {
        let thumbnail = state.thumbnails.of(ui.ctx(), session, &map);
        let details = format!("{what}: {}\n{}", map.file.path, holds(map.image));
        picture_row(ui, thumbnail, &map, &what, &details);
        return;
    }
    let missing = session.maps().checklist().missing.iter().any(|other| other == name);
    let (words, hint) = if missing {
        ("missing", "Drop it here at any time.")
    } else {
        ("unreadable", "See Findings.")
    };
    let tokens = Tokens::of(ui);
    let mut row = Row::new(ui, ROW_HEIGHT);
    row.right(words, tokens.warning);
    row.right -= 8.0;
    row.name(name, tokens.muted);
    let response = row.told(Role::Label, format!("{what}: {name}, {words}"));
    hint_beside(response, None, &format!("{what}: {name}\n{hint}"));
}

/// The values of a material. Returns the edited material if a value changed.
fn material_fields(ui: &mut Ui, material: &Material, of_file: &Layers) -> Option<Material> {
    let mut edited = material.clone();
    match &mut edited.reflectance {
        Reflectance::Fresnel { fresnel0, roughness } => {
            color_row(ui, "Diffuse", &mut edited.diffuse, ENCODED);
            color_row(ui, "Fresnel R0", fresnel0, LINEAR);
            part_row(ui, ROUGHNESS, roughness);
        }
        Reflectance::MetallicRoughness { metallic, roughness } => {
            color_row(ui, "Diffuse", &mut edited.diffuse, LINEAR);
            part_row(ui, "Metallic", metallic);
            part_row(ui, ROUGHNESS, roughness);
            return of_gltf(ui, material, of_file, edited);
        }
        Reflectance::Phong {
            ambient,
            specular,
            spec_power,
            reflectivity,
        } => {
            color_row(ui, "Ambient", ambient, ENCODED);
            color_row(ui, "Diffuse", &mut edited.diffuse, ENCODED);
            color_row(ui, "Specular", specular, ENCODED);
            let speed = 0.25 + *spec_power * 0.01;
            number_row(ui, "Power", spec_power, 0.0..=MAX_SPEC_POWER, (speed, 1));
            color_row(ui, "Reflectivity", reflectivity, LINEAR);
        }
    }
    if switch_row(ui, "Alpha clip", "", material.is_cut()).clicked() {
        edited.alpha = AlphaMode::clipped(!material.is_cut());
    }
    (edited != *material).then_some(edited)
}

/// The values that a glTF file has and the books have not, as far as they do something here, for a material that is being edited.
fn of_gltf(ui: &mut Ui, material: &Material, of_file: &Layers, mut edited: Material) -> Option<Material> {
    color_row(ui, "Emissive", &mut edited.emissive, LINEAR);
    if material.normal_map.is_some() {
        number_row(ui, "Normal scale", &mut edited.normal_scale, -8.0..=8.0, (0.01, 2));
    }
    if material.occlusion_map.is_some() {
        part_row(ui, "Occlusion", &mut edited.occlusion_strength);
    }
    layer_rows(ui, of_file, &mut edited.layers);
    if material.clearcoat_normal_map.is_some() {
        let scale = &mut edited.layers.clearcoat_normal_scale;
        number_row(ui, "Coat normals", scale, -8.0..=8.0, (0.01, 2));
    }
    let mask = match material.alpha {
        AlphaMode::Mask { .. } => material.alpha,
        // glTF's own cutoff.
        AlphaMode::Opaque | AlphaMode::Blend => AlphaMode::Mask { cutoff: 0.5 },
    };
    let modes = [
        (AlphaMode::Opaque, "Opaque"),
        (mask, "Mask"),
        (AlphaMode::Blend, "Blend"),
    ];
    if let Some(alpha) = segmented(ui, "Alpha", &modes, Some(material.alpha)) {
        edited.alpha = alpha;
    }
    if let AlphaMode::Mask { cutoff } = &mut edited.alpha {
        part_row(ui, "Cutoff", cutoff);
    }
    if material.alpha != AlphaMode::Opaque {
        part_row(ui, "Opacity", &mut edited.opacity);
    }
    if switch_row(ui, "Both sides", "", material.double_sided).clicked() {
        edited.double_sided = !material.double_sided;
    }
    if switch_row(ui, "Unlit", "", material.unlit).clicked() {
        edited.unlit = !material.unlit;
    }
    (edited != *material).then_some(edited)
}

/// The values of those extensions of glTF that the file has.
fn layer_rows(ui: &mut Ui, of_file: &Layers, edited: &mut Layers) {
    let none = Layers::default();
    if of_file.ior != none.ior {
        // glTF knows 0 too: what mirrors all.
        let range = of_file.ior.min(1.0)..=of_file.ior.max(4.0);
        number_row(ui, "IOR", &mut edited.ior, range, (0.01, 2));
    }
    if (of_file.specular, of_file.specular_color) != (none.specular, none.specular_color) {
        part_row(ui, "Specular", &mut edited.specular);
        color_row(ui, "Specular tint", &mut edited.specular_color, LINEAR);
    }
    if of_file.clearcoat > 0.0 {
        part_row(ui, "Clear coat", &mut edited.clearcoat);
        part_row(ui, "Coat roughness", &mut edited.clearcoat_roughness);
    }
    if of_file.sheen_color != none.sheen_color {
        color_row(ui, "Sheen", &mut edited.sheen_color, LINEAR);
        part_row(ui, "Sheen roughness", &mut edited.sheen_roughness);
    }
    if of_file.transmission > 0.0 {
        part_row(ui, "Transmission", &mut edited.transmission);
    }
}

/// A number 0…1.
fn part_row<'a>(ui: &mut Ui, label: impl Into<Label<'a>>, part: &mut f32) {
    let (label, text): (Label<'_>, _) = (label.into(), format!("{part:.2}"));
    if let Some(chosen) = Slider::new(label, *part, 0.0..=1.0, &text).show(ui) {
        *part = chosen;
    }
}

/// From a colour's numbers to the bytes of its swatch, sRGB, and back.
type Swatch = (fn(f32) -> u8, fn(u8) -> f32);

const LINEAR: Swatch = (srgb8_from_linear, linear_from_srgb8);

/// Of numbers that are sRGB-encoded themselves.
const ENCODED: Swatch = (|number| (number * 255.0).round() as u8, |byte| f32::from(byte) / 255.0);

/// A colour: a button with a picker, and three numbers.
fn color_row(ui: &mut Ui, label: &str, color: &mut [f32; 3], (byte, number): Swatch) {
    row(ui, label, |ui, height| {
        let side = Vec2::splat(height);
        let shown = color.map(byte);
        if let Some(chosen) = color_button(ui, label, side, shown) {
            // Set only the channels that changed. 8 bits would round the others.
            for channel in 0..3 {
                if chosen[channel] != shown[channel] {
                    color[channel] = number(chosen[channel]);
                }
            }
        }
        let width = (ui.available_width() - 2.0 * SPACING) / 3.0;
        for (value, name) in color.iter_mut().zip(["red", "green", "blue"]) {
            let label = format!("{label}: {name}");
            let size = vec2(width, height);
            *value = number_field(ui, &label, size, *value, 0.0..=1.0, (0.005, 3)).unwrap_or(*value);
        }
    });
}

fn number_row(ui: &mut Ui, label: &str, number: &mut f32, range: RangeInclusive<f32>, step: (f32, usize)) {
    row(ui, label, |ui, height| {
        let (name, size) = (format!("{label}: number"), vec2(ui.available_width(), height));
        *number = number_field(ui, &name, size, *number, range, step).unwrap_or(*number);
    });
}

/// A label, then fields, which get their height.
fn row(ui: &mut Ui, label: &str, fields: impl FnOnce(&mut Ui, f32)) {
    let height = if is_touch(ui) { 40.0 } else { 22.0 };
    let row_height = control_size(ui).max(height + 4.0);
    let size = vec2(ui.available_width(), row_height);
    ui.allocate_ui_with_layout(size, egui::Layout::left_to_right(egui::Align::Center), |ui| {
        ui.set_min_height(row_height);
        ui.spacing_mut().item_spacing.x = SPACING;
        let mut row = Row::sized(ui, vec2(LABEL_WIDTH - SPACING, row_height));
        row.left(label, Tokens::of(ui).muted);
        row.told(Role::Label, label);
        fields(ui, height);
    });
}
