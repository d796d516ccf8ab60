//! What is behind the model.

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
