//! Steps of drawing that can be left out.

/// A step of drawing that can be left out where it costs too much.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pass {
    /// What the first light does not reach.
    Shadow,
    /// Where the surroundings do not reach, from depth and normals in view.
    AmbientOcclusion,
    /// The soft dark where the model is near the ground.
    ContactShadow,
    /// The surroundings as they are mirrored; without them, one mean light is.
    Environment,
}

impl Pass {
    /// In the order of panels.
    pub const ALL: [Self; 4] = [
        Self::Shadow,
        Self::Environment,
        Self::ContactShadow,
        Self::AmbientOcclusion,
    ];

    /// Name for panels.
    pub fn label(self) -> &'static str {
        match self {
            Self::Shadow => "Shadow",
            Self::AmbientOcclusion => "Ambient occlusion",
            Self::ContactShadow => "Contact shadow",
            Self::Environment => "Reflections",
        }
    }

    /// Name for programs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Shadow => "shadow",
            Self::AmbientOcclusion => "ao",
            Self::ContactShadow => "contact",
            Self::Environment => "reflections",
        }
    }

    /// The pass with this [name](Self::name).
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|one| one.name() == name)
    }
}

/// Which passes are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Passes([bool; Pass::ALL.len()]);

impl Default for Passes {
    fn default() -> Self {
        Self::all()
    }
}

impl Passes {
    /// Everything.
    pub fn all() -> Self {
        Self([true; Pass::ALL.len()])
    }

    /// The least.
    pub fn none() -> Self {
        Self([false; Pass::ALL.len()])
    }

    /// Whether one is drawn.
    pub fn has(&self, pass: Pass) -> bool {
        self.0[pass as usize]
    }

    /// These, with one drawn or left out.
    pub fn with(mut self, pass: Pass, drawn: bool) -> Self {
        self.0[pass as usize] = drawn;
        self
    }
}
