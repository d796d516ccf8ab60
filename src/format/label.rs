//! Labels and rulers, compared as writers vary them: without case, dashes, underscores, colons and number signs.

/// The eight sections, in the order of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Section {
    /// Counts of everything that follows.
    Header,
    /// `Materials`.
    Materials,
    /// `SubsetTable`.
    SubsetTable,
    /// `Vertices`.
    Vertices,
    /// `Triangles`.
    Triangles,
    /// `BoneOffsets`.
    BoneOffsets,
    /// `BoneHierarchy`.
    BoneHierarchy,
    /// `AnimationClips`.
    AnimationClips,
}

impl Section {
    /// All of them, in the order of the file.
    pub(super) const ALL: [Self; 8] = [
        Self::Header,
        Self::Materials,
        Self::SubsetTable,
        Self::Vertices,
        Self::Triangles,
        Self::BoneOffsets,
        Self::BoneHierarchy,
        Self::AnimationClips,
    ];

    /// The name on its ruler.
    pub fn name(self) -> &'static str {
        match self {
            Self::Header => "m3d-File-Header",
            Self::Materials => "Materials",
            Self::SubsetTable => "SubsetTable",
            Self::Vertices => "Vertices",
            Self::Triangles => "Triangles",
            Self::BoneOffsets => "BoneOffsets",
            Self::BoneHierarchy => "BoneHierarchy",
            Self::AnimationClips => "AnimationClips",
        }
    }

    /// The section that a ruler names, if it is one of ours. A header may call itself after another tool.
    pub(super) fn of_ruler(ruler: &[u8]) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|section| same(ruler, section.name()))
            .or_else(|| {
                let header = ruler.to_ascii_lowercase();
                memchr::memmem::find(&header, b"header").map(|_| Self::Header)
            })
    }
}

/// True when `text` is a ruler: it begins with three stars or three dashes.
pub(super) fn is_ruler(text: &[u8]) -> bool {
    text.starts_with(b"***") || text.starts_with(b"---")
}

/// True for a ruler without a name: decoration.
pub(super) fn is_bare_ruler(ruler: &[u8]) -> bool {
    letters(ruler).next().is_none()
}

/// True when label or ruler `text` says `name`, as far as letters and digits go.
pub(super) fn same(text: &[u8], name: &str) -> bool {
    letters(text).eq(letters(name.as_bytes()))
}

/// True when `text` says one of `names`.
pub(super) fn same_as_any(text: &[u8], names: &[&str]) -> bool {
    names.iter().any(|name| same(text, name))
}

/// Splits `BoneOffset12:` into the label and its number, if it ends in one.
pub(super) fn split_number(label: &[u8]) -> (&[u8], Option<u32>) {
    let label = label.strip_suffix(b":").unwrap_or(label);
    let digits = label.iter().rev().take_while(|byte| byte.is_ascii_digit()).count();
    let (name, number) = label.split_at(label.len() - digits);
    (name, whole(number))
}

/// A whole number in decimal digits, with an optional plus sign.
pub(super) fn whole(text: &[u8]) -> Option<u32> {
    std::str::from_utf8(text).ok()?.parse().ok()
}

fn letters(text: &[u8]) -> impl Iterator<Item = u8> + '_ {
    text.iter()
        .filter(|byte| !matches!(byte, b'*' | b'-' | b'_' | b':' | b'#') && !byte.is_ascii_whitespace())
        .map(u8::to_ascii_lowercase)
}
