//! How a model is looked at: light, view mode, background, lines over it, and which passes are drawn. Plain data.

/// How surfaces are lit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Light {
    /// Physically based, image-based light and a soft key: how a present-day viewer shows a model.
    #[default]
    Studio,
    /// The character demo of the DirectX 12 book; Phong for materials of the DirectX 11 book.
    Book,
}

impl Light {
    /// In the order of menus.
    pub const ALL: [Self; 2] = [Self::Studio, Self::Book];

    /// Name for menus.
    pub fn label(self) -> &'static str {
        match self {
            Self::Studio => "Studio",
            Self::Book => "Book",
        }
    }

    /// Name for programs and addresses.
    pub fn name(self) -> &'static str {
        match self {
            Self::Studio => "studio",
            Self::Book => "book",
        }
    }

    /// The light with this [name](Self::name).
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|one| one.name() == name)
    }

    /// The other one.
    pub fn other(self) -> Self {
        match self {
            Self::Studio => Self::Book,
            Self::Book => Self::Studio,
        }
    }
}

/// What of a surface is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ViewMode {
    /// Under the light.
    #[default]
    Lit,
    /// Diffuse colour: the material's times the map's.
    BaseColor,
    /// The normal map as it is.
    NormalMap,
    /// The normal that light meets: vertex normal bent by the map. World axes as red, green, blue, 0 in the middle.
    ShadingNormal,
    /// The tangent, likewise; its mirrored side is darker.
    Tangent,
    /// Texture coordinates, as a checker of 8 × 8 fields a tile with u as red and v as green.
    TexCoords,
    /// Roughness, black smooth … white rough. For materials of the DirectX 11 book: what their power comes to.
    Roughness,
    /// A colour of its own for each material.
    Material,
    /// Distance from the viewer, near white … far black.
    Depth,
    /// How open a place is to its surroundings, black closed … white open.
    AmbientOcclusion,
    /// How much of the first light arrives, before the surface's own turning away.
    Shadow,
}

impl ViewMode {
    /// In the order of menus.
    pub const ALL: [Self; 11] = [
        Self::Lit,
        Self::BaseColor,
        Self::NormalMap,
        Self::ShadingNormal,
        Self::Tangent,
        Self::TexCoords,
        Self::Roughness,
        Self::Material,
        Self::Depth,
        Self::AmbientOcclusion,
        Self::Shadow,
    ];

    /// Name for menus.
    pub fn label(self) -> &'static str {
        match self {
            Self::Lit => "Lit",
            Self::BaseColor => "Base colour",
            Self::NormalMap => "Normal map",
            Self::ShadingNormal => "Shading normal",
            Self::Tangent => "Tangent",
            Self::TexCoords => "Texture coordinates",
            Self::Roughness => "Roughness",
            Self::Material => "Material",
            Self::Depth => "Depth",
            Self::AmbientOcclusion => "Ambient occlusion",
            Self::Shadow => "Shadow",
        }
    }

    /// Name for programs and addresses.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lit => "lit",
            Self::BaseColor => "base-color",
            Self::NormalMap => "normal-map",
            Self::ShadingNormal => "normal",
            Self::Tangent => "tangent",
            Self::TexCoords => "uv",
            Self::Roughness => "roughness",
            Self::Material => "material",
            Self::Depth => "depth",
            Self::AmbientOcclusion => "ao",
            Self::Shadow => "shadow",
        }
    }

    /// The mode with this [name](Self::name).
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|one| one.name() == name)
    }

    /// The mode some places further in the menu, around the end.
    pub fn cycled(self, places: i32) -> Self {
        let here = Self::ALL.iter().position(|&mode| mode == self).unwrap_or(0) as i64;
        Self::ALL[(here + i64::from(places)).rem_euclid(Self::ALL.len() as i64) as usize]
    }
}

/// What is behind the model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Background {
    /// The quiet gradient of the theme, with the ground.
    #[default]
    Backdrop,
    /// The surroundings that light the model.
    Sky,
    /// One colour, sRGB.
    Color([u8; 3]),
    /// Nothing: alpha 0, for pictures.
    None,
}

impl Background {
    /// Name for programs and addresses: `backdrop`, `sky`, `none`, or a colour such as `#20262e`.
    pub fn name(self) -> String {
        match self {
            Self::Backdrop => "backdrop".into(),
            Self::Sky => "sky".into(),
            Self::Color([red, green, blue]) => format!("#{red:02x}{green:02x}{blue:02x}"),
            Self::None => "none".into(),
        }
    }

    /// The background with this [name](Self::name).
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "backdrop" => Some(Self::Backdrop),
            "sky" => Some(Self::Sky),
            "none" => Some(Self::None),
            _ => {
                let digits = name.strip_prefix('#')?;
                if digits.len() != 6 || !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
                    return None;
                }
                let [_, red, green, blue] = u32::from_str_radix(digits, 16).ok()?.to_be_bytes();
                Some(Self::Color([red, green, blue]))
            }
        }
    }
}

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
    /// From the one to keep longest to the one to give up first.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn view_modes_follow_each_other_around_the_end() {
        assert_eq!(ViewMode::Lit.cycled(1), ViewMode::BaseColor);
        assert_eq!(ViewMode::Lit.cycled(-1), ViewMode::Shadow);
        assert_eq!(ViewMode::Shadow.cycled(1), ViewMode::Lit);
    }

    #[test]
    fn every_name_leads_back_to_what_it_names() {
        for mode in ViewMode::ALL {
            assert_eq!(ViewMode::from_name(mode.name()), Some(mode));
        }
        for light in Light::ALL {
            assert_eq!(Light::from_name(light.name()), Some(light));
        }
        for overlay in Overlay::ALL {
            assert_eq!(Overlay::from_name(overlay.name()), Some(overlay));
        }
        for pass in Pass::ALL {
            assert_eq!(Pass::from_name(pass.name()), Some(pass));
        }
        let colored = Background::Color([0x20, 0x0a, 0xff]);
        for background in [Background::Backdrop, Background::Sky, Background::None, colored] {
            assert_eq!(Background::from_name(&background.name()), Some(background));
        }
        for wrong in ["", "#", "#20262", "20262e", "#20262g", "#ääää", "#+12-34", "Sky"] {
            assert_eq!(Background::from_name(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn overlays_and_passes_are_switched_one_by_one() {
        let mut overlays = Overlays::none();
        for overlay in Overlay::ALL {
            overlays.set(overlay, true);
            assert!(overlays.has(overlay));
            overlays.set(overlay, false);
            assert!(overlays == Overlays::none());
        }
        for pass in Pass::ALL {
            let without = Passes::all().with(pass, false);
            assert!(Pass::ALL.into_iter().all(|other| without.has(other) == (other != pass)));
        }
    }
}
