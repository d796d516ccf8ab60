//! What a file says of its axes and its unit.

use glam::{DMat3, DVec3};

use super::curves::TICKS_PER_SEC;
use super::objects::property;
use crate::fbx::{Document, Record};

/// Centimetres are FBX's unit where a file names none.
const METRES_OF_A_CENTIMETRE: f64 = 0.01;

#[derive(Clone, Copy, Debug)]
pub(super) struct Settings {
    /// The file's axes -> x to the right, y up, z to the front.
    pub(super) model_from_file: DMat3,
    /// Metres of a unit of the file: models are in metres, as those of glTF are.
    pub(super) unit_metres: f64,
    pub(super) ticks_per_sec: f64,
}

impl Settings {
    pub(super) fn of(document: &Document<'_>) -> Self {
        // Files of 6.1 have them among the objects.
        let record = document
            .find("GlobalSettings")
            .or_else(|| document.find("Objects")?.find("GlobalSettings"));
        let properties = record.and_then(|record| record.find("Properties70").or_else(|| record.find("Properties60")));
        let found = |name: &str| properties.and_then(|properties| property(properties, name));
        let integer = |name: &str, default: i64| {
            found(name)
                .and_then(|(record, at)| record.integer(at))
                .unwrap_or(default)
        };
        let axis = |name: &str, default: i64| {
            let axes = [DVec3::X, DVec3::Y, DVec3::Z];
            let axis = axes[integer(name, default).clamp(0, 2) as usize];
            axis * if integer(&format!("{name}Sign"), 1) < 0 {
                -1.0
            } else {
                1.0
            }
        };
        let rows = DMat3::from_cols(axis("CoordAxis", 0), axis("UpAxis", 1), axis("FrontAxis", 2)).transpose();
        let factor = found("UnitScaleFactor").and_then(|(record, at)| record.number(at));
        let factor = factor
            .filter(|factor| factor.is_finite() && *factor > 0.0)
            .unwrap_or(1.0);
        Self {
            // Some name an axis twice.
            model_from_file: if rows.determinant().abs() == 1.0 {
                rows
            } else {
                DMat3::IDENTITY
            },
            unit_metres: factor * METRES_OF_A_CENTIMETRE,
            ticks_per_sec: ticks_per_sec(document),
        }
    }
}

/// Ticks of a second in the unit of FBX 8.
const NEW_TICKS_PER_SEC: f64 = 141_120_000.0;

/// As ufbx has it: headers since version 1004 may name the unit of times. 127 is the old one, all else that of FBX 8.
fn ticks_per_sec(document: &Document<'_>) -> f64 {
    let integer = |record: Option<&Record<'_>>| record.and_then(|record| record.integer(0));
    let header = document.find("FBXHeaderExtension");
    let version = integer(header.and_then(|header| header.find("FBXHeaderVersion")));
    let unit = integer(header.and_then(|header| header.find("OtherFlags")?.find("TCDefinition")));
    if version >= Some(1004) && unit.is_some_and(|unit| unit != 127) {
        NEW_TICKS_PER_SEC
    } else {
        TICKS_PER_SEC
    }
}
