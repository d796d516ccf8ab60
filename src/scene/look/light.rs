//! How surfaces are lit.

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
