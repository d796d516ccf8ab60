//! What of a surface is shown.

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
    /// Roughness, black smooth … white rough, with the gloss in the alpha of normal maps: 1 − (1 − roughness) × alpha, as both
    /// lights take it. For materials of the DirectX 11 book: what their power comes to.
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
