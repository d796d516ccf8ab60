//! What was mended or is worth knowing, counted while reading and reported once for each kind.

use super::error::quoted;
use super::label::Section;
use crate::diagnostic::{Code, Diagnostic, Position, codes};
use crate::sorting;

/// A kind of diagnostic that does not stop the reader.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum DiagnosticKind {
    /// A section begins without its ruler.
    RulerMissing(Section),
    /// A ruler names something else where a section begins.
    RulerUnknown { section: Section, found: String },
    /// A line above the header that begins with `#` and is no count; left out.
    Comment,
    /// Every count of the header is 0.
    CountsAllZero,
    /// The header does not give a count that may be zero.
    CountAssumed(&'static str),
    /// A section that announces no rows is not there, though the other ones of a skinned model are.
    SectionMissing(Section),
    /// A labelled line that the format does not have; left out.
    LabelUnknown { section: Section, label: String },
    /// A line that came twice; the last one holds.
    LabelRepeated(String),
    /// A material line that is not there; its default holds.
    MaterialLineMissing(&'static str),
    /// `AlphaClip` that is neither a number nor a truth value; taken as off.
    AlphaClipUnreadable,
    /// More on a line than belongs there; it was left out.
    ValuesSurplus,
    /// A row that goes on in the next line.
    RowSplit,
    /// `1,5` or `1.0f`.
    NumberMended,
    /// `NaN`, `inf` …; replaced.
    NumberNotFinite,
    /// Three numbers for a tangent.
    TangentSignMissing,
    /// A misspelt label of the subset table.
    SubsetLabel(String),
    /// `VertexStart` or `VertexCount` that is no whole number.
    SubsetVertexRange,
    /// A bone index out of range with weight 0; replaced by 0.
    BlendIndexUnused,
    /// Blend data though there are no bones; left out.
    BlendDataUnused,
    /// A bone's label carries another number than its place.
    BoneNumber,
    /// The number of the bone stands before the sixteen numbers of its offset.
    BoneOffsetLabel,
    /// A brace that is not there.
    BraceMissing(char),
    /// A brace too many; left out.
    BraceSurplus,
    /// Something behind the last section; left out.
    TextSurplus,
    /// This many bytes of value 0 behind the end; left out.
    ZerosSurplus(usize),
}

impl DiagnosticKind {
    fn code(&self) -> &'static Code {
        match self {
            Self::RulerMissing(_) => &codes::RULER_MISSING,
            Self::RulerUnknown { .. } => &codes::RULER_UNKNOWN,
            Self::Comment => &codes::COMMENT,
            Self::CountsAllZero => &codes::COUNTS_ALL_ZERO,
            Self::CountAssumed(_) => &codes::COUNT_ASSUMED,
            Self::SectionMissing(_) => &codes::SECTION_MISSING,
            Self::LabelUnknown { .. } => &codes::LABEL_UNKNOWN,
            Self::LabelRepeated(_) => &codes::LABEL_REPEATED,
            Self::MaterialLineMissing(_) => &codes::MATERIAL_LINE_MISSING,
            Self::AlphaClipUnreadable => &codes::ALPHA_CLIP_UNREADABLE,
            Self::ValuesSurplus => &codes::VALUES_SURPLUS,
            Self::RowSplit => &codes::ROW_SPLIT,
            Self::NumberMended => &codes::NUMBER_MENDED,
            Self::NumberNotFinite => &codes::NUMBER_NOT_FINITE,
            Self::TangentSignMissing => &codes::TANGENT_SIGN_MISSING,
            Self::SubsetLabel(_) => &codes::SUBSET_LABEL,
            Self::SubsetVertexRange => &codes::SUBSET_VERTEX_RANGE,
            Self::BlendIndexUnused => &codes::BLEND_INDEX_UNUSED,
            Self::BlendDataUnused => &codes::BLEND_DATA_UNUSED,
            Self::BoneNumber => &codes::BONE_NUMBER,
            Self::BoneOffsetLabel => &codes::BONE_OFFSET_LABEL,
            Self::BraceMissing(_) => &codes::BRACE_MISSING,
            Self::BraceSurplus => &codes::BRACE_SURPLUS,
            Self::TextSurplus => &codes::TEXT_SURPLUS,
            Self::ZerosSurplus(_) => &codes::ZEROS_SURPLUS,
        }
    }

    fn message(&self, count: u32) -> String {
        let sentence = self.code().sentence;
        let several = |one: &str, many: &str| {
            if count == 1 {
                one.to_owned()
            } else {
                format!("{count} {many}")
            }
        };
        match self {
            Self::RulerMissing(section) => format!("The {} section begins without its ruler line.", section.name()),
            Self::RulerUnknown { section, found } => {
                format!("A ruler says \"{found}\" where the {} section begins.", section.name())
            }
            Self::Comment => several(sentence, "comment lines above the header were left out."),
            Self::CountsAllZero | Self::TextSurplus => sentence.to_owned(),
            Self::CountAssumed(name) => format!("The header does not say how many {name} there are; taken as none."),
            Self::SectionMissing(section) => format!("There is no {} section; its count is 0.", section.name()),
            Self::LabelUnknown { section, label } => match count {
                1 => format!(
                    "A line \"{label}\" in the {} section is not known and was left out.",
                    section.name()
                ),
                _ => format!(
                    "{count} lines \"{label}\" in the {} section are not known and were left out.",
                    section.name()
                ),
            },
            Self::LabelRepeated(label) => format!("\"{label}\" is given more than once; the last one holds."),
            Self::MaterialLineMissing(label) => several(
                &format!("A material has no {label} line; its default is used."),
                &format!("materials have no {label} line; its default is used."),
            ),
            Self::AlphaClipUnreadable => several(
                sentence,
                "AlphaClip values are neither a number nor true or false; taken as 0.",
            ),
            Self::ValuesSurplus => several(sentence, "lines hold more than belongs there; the rest was left out."),
            Self::RowSplit => several(sentence, "rows go on in the next line."),
            Self::NumberMended => several(
                sentence,
                "numbers are written in a foreign way, such as \"1,5\" or \"1.0f\", and were read by their sense.",
            ),
            Self::NumberNotFinite => several(
                sentence,
                "numbers are not finite and were replaced, by 1 for scales and a quaternion's w, otherwise by 0.",
            ),
            Self::TangentSignMissing => several(
                sentence,
                "tangents have three numbers; the fourth, the bitangent's sign, is taken as 1.",
            ),
            Self::SubsetLabel(label) => several(
                &format!("A label of the subset table is spelt \"{label}\"; it was read by its place."),
                &format!("labels of the subset table are spelt \"{label}\"; they were read by their place."),
            ),
            Self::SubsetVertexRange => several(
                sentence,
                "values of vertex ranges of the subset table are unreadable; they are not used.",
            ),
            Self::BlendIndexUnused => several(
                sentence,
                "blend indices name no bone, but have weight 0; bone 0 stands in.",
            ),
            Self::BlendDataUnused => several(
                sentence,
                "lines of blend weights or indices stand in a file without bones; they were left out.",
            ),
            Self::BoneNumber => several(
                sentence,
                "bones' labels have other numbers than their places; the places hold.",
            ),
            Self::BoneOffsetLabel => several(
                sentence,
                "bone offsets have their bone's number before the sixteen numbers.",
            ),
            Self::BraceMissing(brace) => several(
                &format!("A \"{brace}\" is missing."),
                &format!("\"{brace}\" are missing."),
            ),
            Self::BraceSurplus => several(sentence, "braces too many were left out."),
            Self::ZerosSurplus(1) => "The file ends in a byte of value 0; it was left out.".into(),
            Self::ZerosSurplus(bytes) => format!("The file ends in {bytes} bytes of value 0; they were left out."),
        }
    }
}

/// One kind, and how often it was met.
#[derive(Clone, Debug)]
struct Tally {
    kind: DiagnosticKind,
    length: u32,
    count: u32,
    /// The first occurrences; at least one.
    places: Vec<Position>,
}

impl Tally {
    fn add(&mut self, position: Position) {
        self.count = self.count.saturating_add(1);
        if self.places.len() < Diagnostic::MOST_PLACES {
            self.places.push(position);
        }
    }
}

/// All kinds that were met so far.
#[derive(Clone, Debug, Default)]
pub(super) struct KindCounts {
    tallies: Vec<Tally>,
}

impl KindCounts {
    /// Kinds that are told apart by words of the file, at most; a longer list of unknown labels helps nobody.
    const MOST: usize = 32;

    /// Counts an occurrence of a kind. The first ones give the places.
    pub(super) fn add(&mut self, kind: DiagnosticKind, position: Position, length: u32) {
        let mut kind = kind;
        loop {
            if let Some(tally) = self.tallies.iter_mut().find(|tally| tally.kind == kind) {
                tally.add(position);
                return;
            }
            if self.tallies.len() < Self::MOST || !kind.shorten() {
                self.tallies.push(Tally {
                    kind,
                    length,
                    count: 1,
                    places: vec![position],
                });
                return;
            }
        }
    }

    /// One diagnostic for each kind, in the order of the file.
    pub(super) fn into_diagnostics(mut self) -> Vec<Diagnostic> {
        sorting::sort_by_key(&mut self.tallies, |tally| tally.places.first().copied());
        self.tallies
            .into_iter()
            .map(|tally| {
                let code = tally.kind.code();
                Diagnostic {
                    found: tally.kind.found(),
                    position: tally.places.first().copied(),
                    length: tally.length,
                    count: tally.count,
                    places: tally.places,
                    ..code.says(tally.kind.message(tally.count))
                }
            })
            .collect()
    }
}

impl DiagnosticKind {
    pub(super) fn unknown(section: Section, label: &[u8]) -> Self {
        Self::LabelUnknown {
            section,
            label: quoted(label),
        }
    }

    /// Replaces the words that come from the file by `…`. False when there are none left to replace.
    fn shorten(&mut self) -> bool {
        match self {
            Self::RulerUnknown { found: text, .. }
            | Self::LabelUnknown { label: text, .. }
            | Self::LabelRepeated(text)
            | Self::SubsetLabel(text) => {
                let shortened = text != "…";
                "…".clone_into(text);
                shortened
            }
            _ => false,
        }
    }

    fn found(&self) -> Option<String> {
        match self {
            Self::RulerUnknown { found: text, .. }
            | Self::LabelUnknown { label: text, .. }
            | Self::LabelRepeated(text)
            | Self::SubsetLabel(text) => Some(text.clone()),
            _ => None,
        }
    }
}
