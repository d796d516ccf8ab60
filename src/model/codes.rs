//! The stable codes, in one table.

use crate::diagnostic::Severity::{self, Error, Note, Warning};

/// Every code that turning a document into a model can give, with its severity and its meaning. Codes keep their meaning
/// for good.
pub const CODES: &[(&str, Severity, &str)] = &[
    ("parent-out-of-range", Error, "a bone's parent is neither −1 nor a bone"),
    ("parent-cycle", Error, "bones are their own ancestors"),
    (
        "bone-count-mismatch",
        Error,
        "the numbers of bone offsets and of parents differ",
    ),
    (
        "vertex-out-of-range",
        Error,
        "a triangle names a vertex that is not there",
    ),
    (
        "influence-out-of-range",
        Error,
        "a vertex gives weight to a bone that is not there",
    ),
    (
        "duplicate-material-name",
        Note,
        "another material has the same name; shown with a number",
    ),
    (
        "no-subsets",
        Warning,
        "triangles but no subset; all are drawn with the first material",
    ),
    (
        "subset-without-material",
        Warning,
        "more subsets than materials; the rest is drawn in a default grey",
    ),
    (
        "subset-out-of-range",
        Warning,
        "a subset asks for triangles that are not there; left out",
    ),
    ("triangles-undrawn", Warning, "triangles that belong to no subset"),
    (
        "triangles-shared",
        Note,
        "triangles that belong to more than one subset",
    ),
    (
        "indices-look-relative",
        Note,
        "the indices of a subset look counted from its VertexStart; taken as they stand",
    ),
    ("bones-reordered", Note, "a bone stands before its parent; sorted"),
    ("many-bones", Note, "more bones than the books' shaders hold"),
    (
        "offset-not-finite",
        Warning,
        "a bone offset with a number that is not finite; the identity stands in",
    ),
    (
        "offset-not-affine",
        Warning,
        "a bone offset whose fourth column is not 0 0 0 1; that column was left out",
    ),
    (
        "offset-singular",
        Warning,
        "a bone offset without an inverse; the bone's place in the bind pose is unknown",
    ),
    (
        "many-vertices",
        Note,
        "more vertices than the books' 16-bit indices name",
    ),
    (
        "vertex-not-finite",
        Warning,
        "a position or texture coordinate that is not finite; taken as 0",
    ),
    (
        "handedness-unclear",
        Note,
        "triangles wind both ways; the majority decides",
    ),
    (
        "normals-missing",
        Warning,
        "normals that are zero or not finite; computed from the triangles",
    ),
    (
        "weights-invalid",
        Warning,
        "a blend weight that is negative or not finite; taken as 0",
    ),
    (
        "weights-not-normalized",
        Warning,
        "blend weights whose sum is not 1; normalised",
    ),
    (
        "weights-all-zero",
        Warning,
        "a vertex without blend weight in a skinned model; not moved",
    ),
    (
        "bone-index-above-byte",
        Note,
        "an influence names a bone above 255, which the books' loaders cannot hold",
    ),
    (
        "tangents-missing",
        Warning,
        "tangents that are zero or not finite; computed from the texture coordinates",
    ),
    (
        "tangent-sign",
        Warning,
        "a tangent whose fourth number is not 1 or −1; its sign is kept",
    ),
    (
        "duplicate-clip-name",
        Note,
        "another clip has the same name; shown with a number",
    ),
    ("clip-unnamed", Note, "a clip has no name; shown with its number"),
    (
        "clip-bones-missing",
        Warning,
        "a clip has fewer tracks than there are bones; the rest is at rest",
    ),
    (
        "clip-bones-extra",
        Warning,
        "a clip has more tracks than there are bones; left out",
    ),
    ("track-empty", Warning, "a bone has no keys in a clip; at rest"),
    (
        "keys-not-finite",
        Warning,
        "a key with a number that is not finite or a time beyond 10⁹ s; left out",
    ),
    (
        "keys-not-sorted",
        Warning,
        "keys that are not in the order of time; sorted",
    ),
    (
        "keys-at-equal-times",
        Warning,
        "keys of one bone at the same time; the first and the last are kept as a jump",
    ),
    (
        "rotation-not-unit",
        Warning,
        "a rotation that is not of unit length; normalised",
    ),
    ("rotation-zero", Warning, "a rotation of length 0; taken as no rotation"),
    (
        "exploded",
        Warning,
        "the keys of a clip do not belong to the bone offsets: the mesh flies apart",
    ),
    (
        "pose-overflows",
        Warning,
        "a clip takes a bone or what hangs on it beyond 10³⁷, where numbers overflow",
    ),
];
