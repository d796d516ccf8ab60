//! How a model appears: theme, light, view mode, background, lines over it, and which passes are drawn. Plain data.

use crate::image::MapKind;
use crate::model::MapSlot;
use crate::modes::modes;

/// What the texels of a map are.
pub fn map_kind(slot: MapSlot) -> MapKind {
    match slot {
        MapSlot::Diffuse | MapSlot::Emissive => MapKind::Diffuse,
        MapSlot::Specular | MapSlot::Sheen => MapKind::Color,
        MapSlot::Normal | MapSlot::ClearcoatNormal => MapKind::Normal,
        MapSlot::MetallicRoughness | MapSlot::Occlusion | MapSlot::Clearcoat => MapKind::Data,
    }
}

modes! {
    /// Colours of the page, the backdrop and the grid.
    #[derive(Default)]
    pub enum Theme {
        /// Light things on dark ground.
        #[default]
        Dark = "dark", "Dark";
        /// Dark things on light ground.
        Light = "light", "Light";
    }
}

modes! {
    /// How surfaces are lit.
    #[derive(Default)]
    pub enum Light {
        /// Physically based, image-based light and a soft key: how a present-day viewer shows a model.
        #[default]
        Studio = "studio", "Studio";
        /// The character demo of the DirectX 12 book; Phong for materials of the DirectX 11 book.
        Book = "book", "Book";
    }
}

impl Light {
    /// The other one.
    pub fn other(self) -> Self {
        match self {
            Self::Studio => Self::Book,
            Self::Book => Self::Studio,
        }
    }
}

modes! {
    /// What of a surface is shown.
    #[derive(Default)]
    pub enum ViewMode {
        /// Under the light.
        #[default]
        Lit = "lit", "Lit";
        /// Diffuse colour: the material's times the map's.
        BaseColor = "base-color", "Base colour";
        /// The normal map as it is.
        NormalMap = "normal-map", "Normal map";
        /// The normal that light meets: vertex normal bent by the map. World axes as red, green, blue, 0 in the middle.
        ShadingNormal = "normal", "Shading normal";
        /// The tangent, likewise; its mirrored side is darker.
        Tangent = "tangent", "Tangent";
        /// Texture coordinates, as a checker of 8 × 8 fields a tile with u as red and v as green.
        TexCoords = "uv", "Texture coordinates";
        /// Roughness, black smooth … white rough, with the gloss in the alpha of normal maps: 1 − (1 − roughness) × alpha, as
        /// both lights take it. For materials of the DirectX 11 book: what their power comes to. For those of glTF the number times the
        /// map's green.
        Roughness = "roughness", "Roughness";
        /// Metalness, black none … white metal: for materials of glTF the number times the map's blue. The books' materials have none.
        Metallic = "metallic", "Metallic";
        /// A colour of its own for each material.
        Material = "material", "Material";
        /// Distance from the viewer, near white … far black.
        Depth = "depth", "Depth";
        /// Ambient occlusion, times the occlusion map: black where none of the environment is seen … white where all is.
        AmbientOcclusion = "ao", "Ambient occlusion";
        /// How much of the first light arrives, without the surface's angle to it.
        Shadow = "shadow", "Shadow";
    }
}

impl ViewMode {
    /// Whether it shows what a pass finds out. Other passes are not drawn for it.
    pub fn shows(self, pass: Pass) -> bool {
        match self {
            Self::Lit => true,
            Self::AmbientOcclusion => pass == Pass::AmbientOcclusion,
            Self::Shadow => pass == Pass::Shadow,
            Self::BaseColor
            | Self::NormalMap
            | Self::ShadingNormal
            | Self::Tangent
            | Self::TexCoords
            | Self::Roughness
            | Self::Metallic
            | Self::Material
            | Self::Depth => false,
        }
    }

    /// The mode some places further in the menu; after the last comes the first.
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
    /// The environment that lights the model.
    Sky,
    /// One colour, sRGB.
    Color([u8; 3]),
    /// Nothing, for saved pictures: alpha 0 but for shadows on the ground.
    None,
}

impl Background {
    /// Name for scripts, the command line and the address: `backdrop`, `sky`, `none`, or a colour such as `#20262e`.
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

impl serde::Serialize for Background {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.name())
    }
}

impl<'de> serde::Deserialize<'de> for Background {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = <std::borrow::Cow<'de, str>>::deserialize(deserializer)?;
        let expected = &"backdrop, sky, none, or a colour such as #20262e";
        Self::from_name(&name)
            .ok_or_else(|| serde::de::Error::invalid_value(serde::de::Unexpected::Str(&name), expected))
    }
}

modes! {
    /// Lines drawn over or beside the model.
    pub enum Overlay {
        /// The ground grid.
        Grid = "grid", "Ground grid";
        /// Edges of the triangles.
        Wireframe = "wireframe", "Wireframe";
        /// A line along each vertex normal.
        Normals = "normals", "Vertex normals";
        /// A line along each vertex tangent.
        Tangents = "tangents", "Vertex tangents";
        /// The box of all that the clip reaches.
        Bounds = "bounds", "Bounds";
        /// The world's axes at its origin.
        Axes = "axes", "Axes";
    }
}

/// Which lines are on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlays {
    on: [bool; Overlay::ALL.len()],
    /// Length of the lines along normals and tangents, as a fraction of the figure's radius.
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

modes! {
    /// A step of drawing that can be left out where it costs too much.
    pub enum Pass {
        /// The shadow of the first light.
        Shadow = "shadow", "Shadow";
        /// Reflections of the environment; without them its mean light is reflected.
        Environment = "reflections", "Reflections";
        /// The soft dark where the model is near the ground.
        ContactShadow = "contact", "Contact shadow";
        /// Ambient occlusion, from depth and normals in view.
        AmbientOcclusion = "ao", "Ambient occlusion";
    }
}

/// How finely a costly pass is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Detail {
    /// As finely as it can be.
    #[default]
    Full,
    /// With about half as many samples.
    Low,
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
