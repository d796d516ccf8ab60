//! What the numbers of an accessor are stored as, and where they belong.

use super::json::Accessor;

/// What belongs where floats do, by glTF 2.0 (3.6.2.2, 3.7.2.1, 3.11) and KHR_mesh_quantization: which whole numbers may stand for them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Floats alone.
    Floats,
    /// Floats, and whole numbers in a quantized mesh.
    Positions,
    /// Floats, and normalised signed numbers in a quantized mesh.
    Directions,
    /// Floats or normalised unsigned numbers, and any whole numbers in a quantized mesh.
    TexCoords,
    /// Floats or normalised unsigned numbers.
    Fractions,
    /// Floats or normalised numbers.
    Rotations,
}

/// Whether the numbers of an accessor belong in a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fit {
    Belongs,
    /// They do where the file requires KHR_mesh_quantization.
    Quantized,
    /// They would if the accessor said that they are normalised.
    NotNormalized,
    /// They make no sense there.
    No,
}

impl Wanted {
    /// What an attribute of vertices or of a morph target wants; `None` for whole numbers and unknown attributes.
    pub(crate) fn of_attribute(key: &str) -> Option<Self> {
        let set = key.split_once('_').map_or(key, |(name, _)| name);
        Some(match set {
            "POSITION" => Self::Positions,
            "NORMAL" | "TANGENT" => Self::Directions,
            "TEXCOORD" => Self::TexCoords,
            "COLOR" | "WEIGHTS" => Self::Fractions,
            _ => return None,
        })
    }

    pub(crate) fn fit(self, accessor: &Accessor) -> Fit {
        use Component::{F32, I8, I16, U8, U16, U32};
        let Some(component) = Component::of(accessor.component_type.0) else {
            return Fit::No;
        };
        match (self, component) {
            (_, F32) => Fit::Belongs,
            (Self::Floats, _) | (_, U32) | (Self::Directions, U8 | U16) | (Self::Fractions, I8 | I16) => Fit::No,
            (Self::TexCoords, U8 | U16) if accessor.normalized => Fit::Belongs,
            (Self::Positions | Self::TexCoords, _) => Fit::Quantized,
            _ if !accessor.normalized => Fit::NotNormalized,
            (Self::Directions, _) => Fit::Quantized,
            (Self::Fractions | Self::Rotations, _) => Fit::Belongs,
        }
    }

    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Floats | Self::Positions => "floats",
            Self::Directions => "floats or normalised signed numbers",
            Self::TexCoords | Self::Fractions => "floats or normalised unsigned numbers",
            Self::Rotations => "floats or normalised numbers",
        }
    }
}

/// What the numbers of an accessor are stored as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    pub(super) fn of(number: u64) -> Option<Self> {
        Some(match number {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    pub(super) fn byte_count(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    pub(super) fn words(self) -> String {
        let kind = match self {
            Self::I8 | Self::I16 => "signed whole numbers",
            Self::U8 | Self::U16 | Self::U32 => "unsigned whole numbers",
            Self::F32 => "floats",
        };
        format!("{kind} of {} bits", 8 * self.byte_count())
    }
}

/// How many numbers an element of a kind has.
pub(super) fn number_count(kind: &str) -> Option<usize> {
    Some(match kind {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" => 4,
        "MAT4" => 16,
        _ => return None,
    })
}
