//! Lines over and beside the model.

/// Lines drawn over or beside the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Overlay {
    /// The ground grid.
    Grid,
    /// Edges of the triangles.
    Wireframe,
    /// A line along each vertex normal.
    Normals,
    /// A line along each vertex tangent.
    Tangents,
    /// The box of all that the clip reaches.
    Bounds,
    /// The world's axes at its origin.
    Axes,
}

impl Overlay {
    /// In the order of menus.
    pub const ALL: [Self; 6] = [
        Self::Grid,
        Self::Wireframe,
        Self::Normals,
        Self::Tangents,
        Self::Bounds,
        Self::Axes,
    ];

    /// Name for menus.
    pub fn label(self) -> &'static str {
        match self {
            Self::Grid => "Ground grid",
            Self::Wireframe => "Wireframe",
            Self::Normals => "Vertex normals",
            Self::Tangents => "Vertex tangents",
            Self::Bounds => "Bounds",
            Self::Axes => "Axes",
        }
    }

    /// Name for programs and addresses.
    pub fn name(self) -> &'static str {
        match self {
            Self::Grid => "grid",
            Self::Wireframe => "wireframe",
            Self::Normals => "normals",
            Self::Tangents => "tangents",
            Self::Bounds => "bounds",
            Self::Axes => "axes",
        }
    }

    /// The lines with this [name](Self::name).
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|one| one.name() == name)
    }
}

/// Which lines are on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlays {
    on: [bool; Overlay::ALL.len()],
    /// Length of the lines along normals and tangents, as a share of the scene's radius.
    pub line_length: f32,
}

impl Default for Overlays {
    fn default() -> Self {
        Self {
            on: [true, false, false, false, false, false],
            line_length: 0.02,
        }
    }
}

impl Overlays {
    /// None at all.
    pub fn none() -> Self {
        Self {
            on: [false; Overlay::ALL.len()],
            ..Self::default()
        }
    }

    /// Whether one is on.
    pub fn has(&self, overlay: Overlay) -> bool {
        self.on[overlay as usize]
    }

    /// Turns one on or off.
    pub fn set(&mut self, overlay: Overlay, visible: bool) {
        self.on[overlay as usize] = visible;
    }
}
