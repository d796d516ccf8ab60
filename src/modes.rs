//! Enums that people and scripts choose from: each variant stands beside its names.

/// Declares such an enum. After each variant come its name for scripts, the command line and the address, and its label for
/// menus. The variants are in the order of menus.
macro_rules! modes {
    ($(#[$of_enum:meta])* pub enum $Mode:ident {
        $($(#[$of_variant:meta])* $Variant:ident = $name:literal, $label:literal;)+
    }) => {
        $(#[$of_enum])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $Mode {
            $($(#[$of_variant])* $Variant,)+
        }

        impl $Mode {
            /// In the order of menus.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$Variant),+];

            /// Name for scripts, the command line and the address.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$Variant => $name,)+
                }
            }

            /// Label for menus.
            pub const fn label(self) -> &'static str {
                match self {
                    $(Self::$Variant => $label,)+
                }
            }

            /// The variant with this [name](Self::name).
            pub fn from_name(name: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|mode| mode.name() == name)
            }
        }

        impl serde::Serialize for $Mode {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str(self.name())
            }
        }

        impl<'de> serde::Deserialize<'de> for $Mode {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                const NAMES: &[&str] = &[$($name),+];
                let name = <std::borrow::Cow<'de, str>>::deserialize(deserializer)?;
                Self::from_name(&name).ok_or_else(|| serde::de::Error::unknown_variant(&name, NAMES))
            }
        }
    };
}

pub(crate) use modes;
