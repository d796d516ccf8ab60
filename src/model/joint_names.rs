//! Names that a person gave to joints, which have none in the format.

use std::collections::BTreeMap;

use super::{JointIndex, MirrorPair, Skeleton};

const MOST_CHARS: usize = 64;

/// Names of joints by their number in the file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct JointNames {
    names: BTreeMap<usize, String>,
}

/// Names as plain data, to keep elsewhere.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SavedNames {
    /// [`hierarchy_fingerprint`] of the skeleton that they belong to.
    pub fingerprint: u64,
    /// By the joint's number in the file.
    pub names: BTreeMap<usize, String>,
}

impl SavedNames {
    /// One line a name: the joint's number in the file, a space, the name.
    pub fn to_text(&self) -> String {
        // Names have no line ends: they are control characters.
        self.names
            .iter()
            .map(|(bone, name)| format!("{bone} {name}\n"))
            .collect()
    }

    /// Reads what [`SavedNames::to_text`] wrote for the hierarchy with a fingerprint. Lines that are none are left out.
    pub fn from_text(fingerprint: u64, text: &str) -> Self {
        let name = |line: &str| {
            let (bone, name) = line.split_once(' ')?;
            Some((bone.parse().ok()?, name.to_owned()))
        };
        Self {
            fingerprint,
            names: text.lines().filter_map(name).collect(),
        }
    }
}

/// A number for the hierarchy of a file: the same parents in the same order give the same number, today and later. FNV-1a with
/// 64 bits over each bone's parent as four bytes, lowest first, −1 for a root.
pub fn hierarchy_fingerprint(skeleton: &Skeleton) -> u64 {
    let parent_bone = |joint: &JointIndex| {
        let parent = skeleton.parents()[joint.index()];
        parent.map_or(-1, |parent| skeleton.file_bones()[parent.index()] as i32)
    };
    let parents = skeleton.joint_of_bone().iter().map(parent_bone);
    parents
        .flat_map(i32::to_le_bytes)
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        })
}

impl JointNames {
    /// The name of a bone of the file.
    pub fn get(&self, bone: u32) -> Option<&str> {
        self.names.get(&(bone as usize)).map(String::as_str)
    }

    /// All names, by the joint's number in the file.
    pub fn all(&self) -> &BTreeMap<usize, String> {
        &self.names
    }

    /// Whether nothing has a name.
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    /// Names a bone; an empty name takes it away. Control characters and spaces at the ends go, and what is beyond 64
    /// characters.
    pub fn set(&mut self, bone: u32, name: &str) {
        let printable: String = name.chars().filter(|letter| !letter.is_control()).collect();
        let name: String = printable.trim().chars().take(MOST_CHARS).collect();
        match name.trim_end() {
            "" => self.names.remove(&(bone as usize)),
            name => self.names.insert(bone as usize, name.to_owned()),
        };
    }

    /// As plain data, with the skeleton that they belong to.
    pub fn saved(&self, skeleton: &Skeleton) -> SavedNames {
        SavedNames {
            fingerprint: hierarchy_fingerprint(skeleton),
            names: self.names.clone(),
        }
    }

    /// Takes up names that were kept. None when they belong to another hierarchy; what is no bone is left out.
    pub fn from_saved(saved: &SavedNames, skeleton: &Skeleton) -> Option<Self> {
        if saved.fingerprint != hierarchy_fingerprint(skeleton) {
            return None;
        }
        let mut names = Self::default();
        for (&bone, name) in saved.names.range(..skeleton.joint_count()) {
            names.set(bone as u32, name);
        }
        Some(names)
    }

    /// Names for pairs of which one side has a name: `L hand` proposes `R hand`. A name without a side gets one too, so that
    /// `hand` on the left proposes `L hand` and `R hand`. By the joint's number in the file; none where both sides have names.
    pub fn mirrored(&self, skeleton: &Skeleton, pairs: &[MirrorPair]) -> BTreeMap<usize, String> {
        let mut proposed = BTreeMap::new();
        for pair in pairs {
            let [left, right] = [pair.left, pair.right].map(|joint| skeleton.file_bones()[joint.index()]);
            let (named, name, other, side) = match (self.get(left), self.get(right)) {
                (Some(name), None) => (left, name, right, Side::Left),
                (None, Some(name)) => (right, name, left, Side::Right),
                _ => continue,
            };
            let (said, rest) = Side::split(name);
            // What a person calls left is left.
            let side = said.unwrap_or(side);
            if said.is_none() {
                proposed.insert(named as usize, format!("{} {rest}", side.letter()));
            }
            proposed.insert(other as usize, format!("{} {rest}", side.other().letter()));
        }
        proposed
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Left,
    Right,
}

impl Side {
    /// The side with which a name begins, as a word of its own, and the rest.
    fn split(name: &str) -> (Option<Self>, &str) {
        let Some((word, rest)) = name.split_once([' ', '_', '.', '-']) else {
            return (None, name);
        };
        let side = match word.to_lowercase().as_str() {
            "l" | "left" => Self::Left,
            "r" | "right" => Self::Right,
            _ => return (None, name),
        };
        (Some(side), rest)
    }

    fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }

    fn letter(self) -> char {
        match self {
            Self::Left => 'L',
            Self::Right => 'R',
        }
    }
}
