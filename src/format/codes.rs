//! The stable codes, in one table.

use crate::diagnostic::Severity::{self, Error, Note, Warning};

/// Every code that reading a file can give, with its severity and its meaning. Codes keep their meaning for good.
pub const CODES: &[(&str, Severity, &str)] = &[
    ("empty-file", Error, "nothing but blanks"),
    ("other-format", Error, "another format, which the message names"),
    (
        "relative-format",
        Error,
        "a variant of this format that is laid out differently",
    ),
    ("not-m3d", Error, "text that does not begin as an .m3d file does"),
    (
        "count-missing",
        Error,
        "the header lacks the count of materials, vertices or triangles",
    ),
    ("wrong-section", Error, "a section stands where another one belongs"),
    ("row-count", Error, "fewer or more rows than announced"),
    ("unexpected-end", Error, "the file ends too early"),
    ("value-missing", Error, "a line ends before its last value"),
    ("wrong-label", Error, "a label is not the one that belongs there"),
    ("not-a-number", Error, "a word where a number belongs"),
    ("not-in-range", Error, "no whole number, or one out of range"),
    ("material-incomplete", Error, "a material with too few lines to be one"),
    (
        "mostly-zeros",
        Error,
        "more bytes of value 0 at the end than there are before them",
    ),
    ("ruler-missing", Warning, "a section begins without its ruler"),
    ("ruler-unknown", Note, "a ruler names something else"),
    ("comment", Note, "a comment line above the header; left out"),
    ("counts-all-zero", Warning, "every count of the header is 0"),
    (
        "count-assumed",
        Warning,
        "the header lacks the count of bones or clips, taken as 0",
    ),
    (
        "section-missing",
        Note,
        "an empty section is not there, though the others of a skinned model are",
    ),
    ("label-unknown", Note, "a line that is not known was left out"),
    ("label-repeated", Warning, "a line came twice; the last one holds"),
    (
        "material-line-missing",
        Warning,
        "a material lacks a line; its default holds",
    ),
    (
        "alpha-clip-unreadable",
        Warning,
        "AlphaClip is neither a number nor a truth value; taken as 0",
    ),
    ("values-surplus", Note, "more on a line than belongs there; left out"),
    ("row-split", Note, "a row goes on in the next line"),
    ("number-mended", Warning, "a number in a foreign spelling"),
    ("number-not-finite", Warning, "a number that is not finite was replaced"),
    ("tangent-sign-missing", Note, "a tangent of three numbers"),
    ("subset-label", Note, "a misspelt label of the subset table"),
    ("subset-vertex-range", Note, "an unreadable vertex range of a subset"),
    ("blend-index-unused", Note, "a blend index without weight names no bone"),
    ("blend-data-unused", Note, "blend data in a file without bones"),
    ("bone-number", Note, "a bone's label has another number than its place"),
    ("bone-offset-label", Note, "a second word of a bone offset's label"),
    ("brace-missing", Warning, "a brace is missing"),
    ("brace-surplus", Warning, "a brace too many"),
    ("text-surplus", Warning, "something behind the last section"),
    ("zeros-surplus", Warning, "bytes of value 0 at the end; left out"),
];
