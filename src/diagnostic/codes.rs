//! The one table of all codes. Of each: name, severity, a sentence, what it means, what is done about it, how to mend it, and, where it is
//! mended here, when.
//!
//! Messages take severity and name from here, and the sentence too where it has no blanks to fill. Tests compare the table
//! with what the program gives, and make `web/codes.html` of it. To add a code: add its row and a fixture, and use its constant. Names and meanings
//! stay as they are for good, since scripts read them.

use super::{Code, Mended, Severity};

/// Every code, in the order of the groups.
pub fn all() -> impl Iterator<Item = &'static Code> {
    GROUPS.iter().flat_map(|group| group.iter())
}

/// The code with this name.
pub fn named(name: &str) -> Option<&'static Code> {
    all().find(|code| code.name == name)
}

/// Whether this program makes reports and works out the books' verdicts. The small program for other people's pages only tells scripts what was
/// found: it has neither the longer words of codes nor the code of verdicts.
pub(crate) const HAS_REPORTS: bool = cfg!(any(feature = "viewer", feature = "cli", not(feature = "element")));

/// Words that only reports have; empty where there are none.
const fn long(words: &'static str) -> &'static str {
    if HAS_REPORTS { words } else { "" }
}

/// A constant for each row, and a list for each group. A row has, in this order: name, severity, sentence; what it means; what is done about it
/// here; what the author of the file does about it; and how the program mends it, where it does.
macro_rules! table {
    (@mended) => { Mended::No };
    (@mended $mended:ident) => { Mended::$mended };
    ($(
        $(#[doc = $group_doc:literal])*
        $group:ident {
            $($constant:ident = $name:literal, $severity:ident, $sentence:literal, $explanation:literal, $handling:literal, $mending:literal $(, $mended:ident)?;)*
        }
    )*) => {
        $($(
            #[doc = concat!("`", $name, "`, ", stringify!($severity), ". ", $sentence)]
            #[doc = ""]
            #[doc = $explanation]
            pub const $constant: Code = Code {
                name: $name,
                severity: Severity::$severity,
                sentence: $sentence,
                explanation: long($explanation),
                handling: long($handling),
                mending: long($mending),
                mended: table!(@mended $($mended)?),
            };
        )*)*
        $(
            $(#[doc = $group_doc])*
            pub const $group: &[Code] = &[$($constant),*];
        )*
        const GROUPS: &[&[Code]] = &[$($group),*];
    };
}

table! {
    /// What reading an `.m3d` file gives ([`format::parse`](crate::format::parse)).
    OF_PARSER {
        EMPTY_FILE = "empty-file", Error,
            "The file is empty.",
            "It holds nothing but blanks. Perhaps it was not written or copied to its end.",
            "The file is not opened.",
            "Export again, and look whether the disk is full or the exporter ended early.";
        OTHER_FORMAT = "other-format", Error,
            "This is a file of another format.",
            "The message names the format.",
            "The file is not opened.",
            "Choose `.m3d` text or glTF as the exporter's output; renaming a file does not convert it.";
        RELATIVE_FORMAT = "relative-format", Error,
            "This file is a variant of the format that is laid out differently.",
            "The books' loaders do not read it either.",
            "The file is not opened.",
            "Write indices that count from the first vertex of the file, and the sections that the D3D12 book's exporter writes.";
        NOT_M3D = "not-m3d", Error,
            "This text does not begin as an .m3d file does.",
            "An .m3d file begins with a ruler that names its header, or with a count such as `#Materials 5`.",
            "The file is not opened.",
            "Begin the file with the ruler `***************m3d-File-Header***************`.";
        COUNT_MISSING = "count-missing", Error,
            "The header lacks the count of materials, vertices or triangles.",
            "Without the count nobody knows where the section ends.",
            "The file is not opened.",
            "Write all five counts: `#Materials`, `#Vertices`, `#Triangles`, `#Bones` and `#AnimationClips`.";
        WRONG_SECTION = "wrong-section", Error,
            "A section stands where another one belongs.",
            "The sections have one order: header, materials, subsets, vertices, triangles, offsets, hierarchy, clips.",
            "The file is not opened.",
            "Write the sections in their order, each with its ruler.";
        ROW_COUNT = "row-count", Error,
            "There are fewer or more rows than announced.",
            "Either the count or the rows are wrong. The books' loaders would read on into the next section.",
            "The file is not opened.",
            "Write the count after the rows are known, from the same list.";
        UNEXPECTED_END = "unexpected-end", Error,
            "The file ends too early.",
            "It was not written or copied to its end.",
            "The file is not opened.",
            "Close the file before the exporter ends, and check that every write succeeded.";
        VALUE_MISSING = "value-missing", Error,
            "A line ends before its last value.",
            "The message says which value should have come next.",
            "The file is not opened.",
            "Write every value of the row: three for positions and normals, four for tangents, weights and quaternions.";
        WRONG_LABEL = "wrong-label", Error,
            "A label is not the one that belongs there.",
            "The rows of a section have the same labels in the same order.",
            "The file is not opened.",
            "Write the labels of a row in the order of the book's exporter, spelt as there.";
        NOT_A_NUMBER = "not-a-number", Error,
            "A word stands where a number belongs.",
            "Often a value before it is missing, or a section is longer than announced.",
            "The file is not opened.",
            "Write numbers in decimal, with a point and without units or separators.";
        NOT_IN_RANGE = "not-in-range", Error,
            "A value is no whole number, or one out of its range.",
            "An index must name a row that is there; a count must not be negative.",
            "The file is not opened.",
            "Count from 0, and write counts and indices of the same list as whole numbers.";
        MATERIAL_INCOMPLETE = "material-incomplete", Error,
            "The material that begins here has too few lines to be one.",
            "Perhaps the header announces more materials than there are.",
            "The file is not opened.",
            "Write every line of each material, and count the materials that are written.";
        MOSTLY_ZEROS = "mostly-zeros", Error,
            "The file ends in more bytes of value 0 than stand before them.",
            "It was not written or copied whole.",
            "The file is not opened.",
            "Copy or export the file again.";
        RULER_MISSING = "ruler-missing", Warning,
            "A section begins without its ruler line.",
            "The books' loaders skip one word there and would be out of step.",
            "The section is read by its place.",
            "Write a ruler line before each section, the empty ones too.", OnReading;
        RULER_UNKNOWN = "ruler-unknown", Note,
            "A ruler does not name the section that begins there.",
            "The books' loaders do not look at its words.",
            "The section is read by its place.",
            "Name the section in its ruler as the book's exporter does.", OnReading;
        COMMENT = "comment", Note,
            "A comment line above the header was left out.",
            "The books' loaders do not know comments.",
            "The line is left out.",
            "Write no comments: the format has none.", OnReading;
        COUNTS_ALL_ZERO = "counts-all-zero", Warning,
            "Every count of the header is 0: the file holds nothing.",
            "There is nothing to show.",
            "An empty model is opened.",
            "Look whether the scene or the selection was empty when it was exported.";
        COUNT_ASSUMED = "count-assumed", Warning,
            "The header lacks the count of bones or clips; taken as none.",
            "A model without bones is shown as it was bound.",
            "The count is taken as 0.",
            "Write `#Bones 0` and `#AnimationClips 0` for a model without them.", OnReading;
        SECTION_MISSING = "section-missing", Note,
            "An empty section is not there, though the others of a skinned model are.",
            "Nothing is lost: its count is 0.",
            "The section is taken as empty.",
            "Write the ruler of every section, though it has no rows.", OnReading;
        LABEL_UNKNOWN = "label-unknown", Note,
            "A line is not known and was left out.",
            "Perhaps its label is misspelt, or another tool wrote it for itself.",
            "The line is left out.",
            "Write no lines but the format's own, spelt as the book's exporter does.", OnReading;
        LABEL_REPEATED = "label-repeated", Warning,
            "A line is given more than once; the last one holds.",
            "Perhaps two materials were written without a blank line between them.",
            "The last one holds.",
            "Write each line once, and a blank line between two materials.", OnReading;
        MATERIAL_LINE_MISSING = "material-line-missing", Warning,
            "A material lacks a line; its default is used.",
            "The books' loaders need every line of a material in its order.",
            "The default of the line is used.",
            "Write every line of a material, its maps too, in the book's order.", OnReading;
        ALPHA_CLIP_UNREADABLE = "alpha-clip-unreadable", Warning,
            "An AlphaClip is neither a number nor true or false; taken as 0.",
            "The material is drawn without holes.",
            "It is taken as 0.",
            "Write `AlphaClip: 0` or `AlphaClip: 1`.", OnReading;
        VALUES_SURPLUS = "values-surplus", Note,
            "A line holds more than belongs there; the rest was left out.",
            "The books' loaders read word by word and would be out of step from there on.",
            "What is too much is left out.",
            "Write as many values as the row has, and no blanks in names.", OnReading;
        ROW_SPLIT = "row-split", Note,
            "A row goes on in the next line.",
            "The books' loaders read words, whatever line they stand in.",
            "It is read as one row.",
            "Write each row on a line of its own.", OnReading;
        NUMBER_MENDED = "number-mended", Warning,
            "A number is written in a foreign way, such as \"1,5\" or \"1.0f\", and was read by its sense.",
            "Exporters write so under a language with decimal commas, or for source code.",
            "It is read by its sense.",
            "Write numbers with a point and without a suffix, whatever the language of the machine: in C++ with `std::locale::classic()`.", OnReading;
        NUMBER_NOT_FINITE = "number-not-finite", Warning,
            "A number is not finite and was replaced, by 1 for scales and a quaternion's w, otherwise by 0.",
            "The exporter divided by zero or used a value that was never set.",
            "It is replaced.",
            "Find the division by zero or the unset value; write 0, or 1 for scales and a quaternion's w.", OnReading;
        TANGENT_SIGN_MISSING = "tangent-sign-missing", Note,
            "A tangent has three numbers; the fourth, the bitangent's sign, is taken as 1.",
            "Where the texture is mirrored, bumps look like dents.",
            "The sign is taken as 1.",
            "Write the sign of the bitangent, −1 or 1, as the fourth number.", OnReading;
        SUBSET_LABEL = "subset-label", Note,
            "A label of the subset table is misspelt; it was read by its place.",
            "Nothing is lost: the order of the values is always the same.",
            "It is read by its place.",
            "Write `SubsetID: VertexStart: VertexCount: FaceStart: FaceCount:`, each with its number.", OnReading;
        SUBSET_VERTEX_RANGE = "subset-vertex-range", Note,
            "A vertex range of the subset table is unreadable; it is not used.",
            "Only the range of triangles is needed to draw a subset.",
            "The range is not used.",
            "Write `VertexStart` and `VertexCount` as whole numbers.", OnReading;
        BLEND_INDEX_UNUSED = "blend-index-unused", Note,
            "A blend index names no bone, but has weight 0; bone 0 stands in.",
            "Nothing moves differently.",
            "Bone 0 stands in.",
            "Write 0 for influences without weight.", OnReading;
        BLEND_DATA_UNUSED = "blend-data-unused", Note,
            "A vertex has blend weights or indices though there are no bones; they were left out.",
            "Perhaps the file was exported without its skeleton.",
            "It is left out.",
            "Export the skeleton too, or leave weights and indices out.", OnReading;
        BONE_NUMBER = "bone-number", Note,
            "A bone's label has another number than its place; the place holds.",
            "The books' loaders do not look at the number either.",
            "The place holds.",
            "Number the bones from 0 in the order in which they are written.", OnReading;
        BONE_OFFSET_LABEL = "bone-offset-label", Note,
            "A bone offset has its bone's number before the sixteen numbers.",
            "The books' loaders would take it for the first of the sixteen.",
            "It is taken as part of the label.",
            "Write `BoneOffset0` with the number joined to the word.", OnReading;
        BRACE_MISSING = "brace-missing", Warning,
            "A brace is missing.",
            "The books' loaders skip a word there and would be out of step.",
            "The clip is read as if it stood there.",
            "Write a brace before and after the keys of each bone, and around all bones of a clip.", OnReading;
        BRACE_SURPLUS = "brace-surplus", Warning,
            "A brace too many was left out.",
            "The books' loaders would be out of step from there on.",
            "It is left out.",
            "Write one closing brace for each opening one.", OnReading;
        TEXT_SURPLUS = "text-surplus", Warning,
            "There is something behind the last section; it was left out.",
            "Perhaps the header announces fewer clips than there are.",
            "It is left out.",
            "Count the clips that are written, and write nothing after the last one.", OnReading;
        ZEROS_SURPLUS = "zeros-surplus", Warning,
            "The file ends in bytes of value 0; they were left out.",
            "A disk or a transfer padded the file. The text before them is whole.",
            "They are left out.",
            "Write the file to its length, and copy it as a whole.", OnReading;
    }

    /// What making a model of a document gives ([`import::m3d`](crate::import::m3d)).
    OF_MODEL {
        PARENT_OUT_OF_RANGE = "parent-out-of-range", Error,
            "A bone's parent is neither −1 nor a bone.",
            "A root has −1 as its parent; any other bone names one that is there.",
            "The file is not opened.",
            "Write −1 for the root, and for any other bone the number of its parent.";
        PARENT_CYCLE = "parent-cycle", Error,
            "Bones are their own ancestors.",
            "A hierarchy that runs in a circle has no root from which to begin.",
            "The file is not opened.",
            "Follow the parents of the bones that the message names, and give one of them −1.";
        BONE_COUNT_MISMATCH = "bone-count-mismatch", Error,
            "The numbers of bone offsets and of parents differ.",
            "Every bone has one offset and one parent.",
            "The file is not opened.",
            "Write one offset and one parent for each bone.";
        VERTEX_OUT_OF_RANGE = "vertex-out-of-range", Error,
            "A triangle names a vertex that is not there.",
            "The first vertex has the number 0.",
            "The file is not opened.",
            "Count vertices from 0, over the whole file.";
        INFLUENCE_OUT_OF_RANGE = "influence-out-of-range", Error,
            "A vertex gives weight to a bone that is not there.",
            "The first bone has the number 0.",
            "The file is not opened.",
            "Count bones from 0, in the order of the offsets.";
        DUPLICATE_MATERIAL_NAME = "duplicate-material-name", Note,
            "Another material has the same name; this one is shown with a number.",
            "Subsets name materials by their place, so both are drawn as they are.",
            "It is shown with a number.",
            "Give each material a name of its own.", OnReading;
        NO_SUBSETS = "no-subsets", Warning,
            "The file has no subset; all triangles are drawn with the first material.",
            "The books' demos draw nothing without a subset.",
            "All triangles are drawn with the first material.",
            "Write one row of the subset table for each material.", OnReading;
        SUBSET_WITHOUT_MATERIAL = "subset-without-material", Warning,
            "A subset has no material; drawn in a default grey.",
            "The file has more subsets than materials; each subset takes the material of its own place.",
            "It is drawn in grey.",
            "Write as many materials as subsets, in the same order.", OnReading;
        SUBSET_OUT_OF_RANGE = "subset-out-of-range", Warning,
            "A subset asks for triangles that are not there; they are left out.",
            "FaceStart and FaceCount count triangles, not indices.",
            "Triangles that are not there are left out.",
            "Write `FaceStart` and `FaceCount` in triangles: indices divided by 3.", OnReading;
        TRIANGLES_UNDRAWN = "triangles-undrawn", Warning,
            "A triangle belongs to no subset; not drawn.",
            "Parts of the model are missing in the picture.",
            "They are not drawn.",
            "Let the ranges of the subsets follow one another up to the last triangle.";
        TRIANGLES_SHARED = "triangles-shared", Note,
            "A triangle belongs to more than one subset.",
            "It is drawn with the material of the first of them, unless alpha cuts holes into it.",
            "The first of the subsets draws them.",
            "Let each range begin where the one before ends: `FaceStart` + `FaceCount`.";
        INDICES_LOOK_RELATIVE = "indices-look-relative", Note,
            "The indices of a subset look counted from its VertexStart; they are taken as they stand.",
            "If the model looks torn, the exporter should add VertexStart to them.",
            "They are taken as they stand.",
            "Add `VertexStart` to the indices of each subset.";
        BONES_REORDERED = "bones-reordered", Note,
            "A bone stands before its parent; the joints are sorted and keep the file's numbers for display.",
            "The books' demos multiply down the list and show such a model wrong.",
            "The joints are sorted; the file's numbers are shown.",
            "Write bones with parents first, and change offsets, blend indices and tracks with them.", ForBook;
        MANY_BONES = "many-bones", Note,
            "There are more bones than the books' shaders hold.",
            "The books' demos need a larger array of bones in their constant buffer.",
            "All bones move.",
            "Leave out bones that move no vertex, or enlarge the array of the shader.";
        OFFSET_NOT_FINITE = "offset-not-finite", Warning,
            "A bone offset has a number that is not finite; the identity stands in.",
            "The vertices of the bone are moved as if it had been bound at the origin.",
            "The identity stands in.",
            "Write the inverse of the bone's bind matrix, in the model's space.";
        OFFSET_NOT_AFFINE = "offset-not-affine", Warning,
            "A bone offset has a fourth column other than 0 0 0 1; that column was left out.",
            "Perhaps the matrix was written for column vectors: the translation belongs in its fourth row.",
            "The fourth column is left out.",
            "Write row-vector matrices row by row: transpose matrices for column vectors.", OnReading;
        OFFSET_SINGULAR = "offset-singular", Warning,
            "A bone offset has no inverse; the bone's place in the bind pose is unknown.",
            "The bone is shown at the origin of the bind pose. Clips are not affected.",
            "The bone stands at the origin of the bind pose.",
            "Give no bone of the bind pose a scale of 0.";
        MANY_VERTICES = "many-vertices", Note,
            "There are more vertices than the books' 16-bit indices can number.",
            "The books' demos need 32-bit indices to show it.",
            "All of them are drawn.",
            "Reduce or split the mesh, or use 32-bit indices in the demo.";
        VERTEX_NOT_FINITE = "vertex-not-finite", Warning,
            "A vertex has a position or texture coordinate that is not finite; taken as 0.",
            "The vertex stands at the origin of that coordinate.",
            "The coordinate is taken as 0.",
            "Find the division by zero or the unset value in the exporter.";
        HANDEDNESS_UNCLEAR = "handedness-unclear", Note,
            "Some triangles face the other way than the rest; the majority decides.",
            "Their front faces look inwards (flipped normals). Parts of the model may be inside out, or the whole may be mirrored.",
            "The majority decides.",
            "Recalculate the normals to point outside, and apply negative scales, before the export.";
        NORMALS_MISSING = "normals-missing", Warning,
            "A vertex has a normal that is zero or not finite; computed from the triangles.",
            "Edges that should be sharp may look round there.",
            "They are computed from the triangles.",
            "Export normals, each of length 1.", OnReading;
        WEIGHTS_INVALID = "weights-invalid", Warning,
            "A vertex has a blend weight that is negative or not finite; taken as 0.",
            "Its other bones take over.",
            "The weight is taken as 0.",
            "Cut weights off at 0 and share out what is left so that they sum to 1.", OnReading;
        WEIGHTS_NOT_NORMALIZED = "weights-not-normalized", Warning,
            "The blend weights of a vertex do not sum to 1; normalised.",
            "The books' shaders give the fourth bone whatever is left to 1, so the vertex may stand elsewhere there.",
            "The weights are normalised.",
            "Keep the four greatest weights, and divide them by their sum.", OnReading;
        WEIGHTS_ALL_ZERO = "weights-all-zero", Warning,
            "A vertex of a skinned model has no blend weight; not moved by any bone.",
            "It stays where the bind pose has it while the rest moves.",
            "The vertex is moved by no bone.",
            "Give every vertex a bone: the one that its part of the mesh hangs on (a vertex group).", ForBook;
        BONE_INDEX_ABOVE_BYTE = "bone-index-above-byte", Note,
            "An influence names a bone above 255, which the books' loaders cannot hold.",
            "They keep bone indices in bytes.",
            "The bone moves the vertex.",
            "Leave out bones that move no vertex, so that fewer than 257 are left.";
        TANGENTS_MISSING = "tangents-missing", Warning,
            "A vertex has a tangent that is zero or not finite; computed from the texture coordinates.",
            "Only normal maps depend on tangents.",
            "They are computed from the texture coordinates.",
            "Export tangents, each of length 1, with the bitangent's sign.", OnReading;
        TANGENT_SIGN = "tangent-sign", Warning,
            "A tangent has a fourth number other than 1 or −1; its sign is kept.",
            "The number is the sign of the bitangent.",
            "The number's sign is kept.",
            "Write −1 or 1 as the fourth number of a tangent.", OnReading;
        DUPLICATE_CLIP_NAME = "duplicate-clip-name", Note,
            "Another clip has the same name; this one is shown with a number.",
            "The books' demos find clips by name and know only one of them.",
            "It is shown with a number.",
            "Give each clip a name of its own.", OnReading;
        CLIP_UNNAMED = "clip-unnamed", Note,
            "This clip has no name; it is shown with its number.",
            "The books' loaders read a word as its name and would be out of step.",
            "It is shown with its number.",
            "Write a name of one word behind `AnimationClip`.", OnReading;
        CLIP_BONES_MISSING = "clip-bones-missing", Warning,
            "A clip has fewer tracks than there are bones; the others are at rest as in the bind pose.",
            "The books' loaders read one track for each bone.",
            "The other bones are at rest as in the bind pose.",
            "Write one track for each bone, with at least one key.";
        CLIP_BONES_EXTRA = "clip-bones-extra", Warning,
            "A clip has more tracks than there are bones; they are left out.",
            "Perhaps the clip was made for another skeleton.",
            "They are left out.",
            "Export clips with the skeleton that they were made for.";
        TRACK_EMPTY = "track-empty", Warning,
            "A bone has no keys in a clip; at rest as in the bind pose.",
            "The books' demos need at least one key for each bone.",
            "The bone is at rest as in the bind pose.",
            "Write one key for a bone that keeps still.", ForBook;
        KEYS_NOT_FINITE = "keys-not-finite", Warning,
            "A key has a number that is not finite or a time beyond 10⁹ s; left out.",
            "The motion goes straight from the key before to the key after.",
            "The key is left out.",
            "Find the division by zero or the unset value in the exporter.", OnReading;
        KEYS_NOT_SORTED = "keys-not-sorted", Warning,
            "A bone has keys that are not in the order of time; sorted.",
            "The books' demos take them in the order of the file and jump.",
            "The keys are sorted.",
            "Sort the keys of each bone by time before they are written.", OnReading;
        KEYS_AT_EQUAL_TIMES = "keys-at-equal-times", Warning,
            "Keys of a bone have the same time; the first and the last key of a time are kept as a jump.",
            "The books' demos divide by the time between two keys.",
            "The first and the last key of a time are kept as a jump.",
            "Write one key for a time, and more digits if times are rounded.", OnReading;
        ROTATION_NOT_UNIT = "rotation-not-unit", Warning,
            "A key has a rotation that is not of unit length; normalised.",
            "The books' demos make a matrix of it as it stands, which stretches what hangs on the bone.",
            "The rotation is normalised.",
            "Divide each quaternion by its length.", OnReading;
        ROTATION_ZERO = "rotation-zero", Warning,
            "A key has a rotation of length 0; taken as no rotation.",
            "Such a quaternion has no direction.",
            "It is taken as no rotation.",
            "Write 0 0 0 1 where there is no rotation.", OnReading;
        ROTATION_SIDE = "rotation-side", Note,
            "A rotation has all its signs turned against the key before it; turned back.",
            "The quaternions q and −q are one rotation. The books' demos take the nearer one too; programs that blend the four numbers spin the long way.",
            "The signs are turned back.",
            "Turn the signs of a quaternion where its dot product with the one before is negative.", OnReading;
    }

    /// What reading an FBX file gives ([`fbx`](crate::fbx)).
    OF_FBX {
        FBX_DAMAGED = "fbx-damaged", Error,
            "A record of an FBX file is damaged.",
            "The message says what does not fit. The file was not written or copied to its end, or another program changed it.",
            "The file is not opened.",
            "Copy or export the file again.";
        FBX_VERSION = "fbx-version", Error,
            "The file is of a version of FBX that is not read.",
            "Versions before 6.1 are laid out differently.",
            "The file is not opened.",
            "Export it as FBX 2014 or later, or convert it with Autodesk's FBX Converter.";
        FBX_RULE_BROKEN = "fbx-rule-broken", Warning,
            "A part of an FBX file is not as it should be.",
            "The message names the part and what was done. Programs that mend such files in other ways show something else.",
            "Drawn with what the message says.",
            "Export the file again, or mend it in the program that made it.";
        FBX_EMPTY = "fbx-empty", Warning,
            "The file has neither a mesh nor a skeleton.",
            "Nothing that the file shows has triangles or bones.",
            "Nothing is drawn.",
            "Export it with the meshes or the skeleton selected.";
        FBX_LEFT_OUT = "fbx-left-out", Note,
            "The file has something that is not taken from it.",
            "The message names it. A model has triangles, four bones for a vertex, materials and clips of joints, and nothing else.",
            "The rest of the file is drawn.",
            "Nothing, unless it is missed: then bake it into the mesh, the skeleton or a clip in the program that made it.";
        FBX_OBJECTS_MERGED = "fbx-objects-merged", Note,
            "Several objects become one mesh.",
            "Each keeps its subsets and its materials.",
            "Drawn as they stand in the scene.",
            "Nothing.";
    }

    /// What reading a glTF file gives ([`gltf`](crate::gltf)), beside codes above.
    OF_GLTF {
        GLB_DAMAGED = "glb-damaged", Error,
            "The container of a .glb file is damaged.",
            "It was not written or copied to its end, or another program changed it.",
            "The file is not opened.",
            "Copy or export the file again.";
        GLB_SURPLUS = "glb-surplus", Warning,
            "A .glb file has chunks or bytes that do not belong there.",
            "A .glb file is one chunk of JSON, then at most one of binary data, and nothing behind the length in its header.",
            "What is too much is left out.",
            "Write the length of the whole file into its header, the JSON first and the binary data second.", OnReading;
        GLTF_NOT_JSON = "gltf-not-json", Error,
            "The JSON of a glTF file cannot be read.",
            "The message says what the reader of JSON met.",
            "The file is not opened.",
            "Write the file with a library for JSON, and its text in UTF-8.";
        GLTF_WRONG_TYPE = "gltf-wrong-type", Error,
            "A value is of another kind than glTF asks for, or one that it needs is missing.",
            "The JSON pointer says which value it is.",
            "The file is not opened.",
            "Write what the specification of glTF 2.0 has at that place.";
        GLTF_VERSION = "gltf-version", Error,
            "The file is of another version of glTF.",
            "Version 1.0 is laid out differently, and none is later than 2.0.",
            "The file is not opened.",
            "Export it as glTF 2.0.";
        GLTF_EXTENSION_REQUIRED = "gltf-extension-required", Error,
            "The model cannot be read without an extension that is not known here.",
            "The file says that it makes no sense without: compressed meshes, mostly, or pictures of another kind.",
            "The file is not opened.",
            "Export it without compression, and with textures in PNG or JPEG.";
        GLTF_EXTENSION_UNKNOWN = "gltf-extension-unknown", Note,
            "The file uses an extension that is not read; the model is shown without.",
            "For example lights, or the iridescence of a material. The file says itself that it can be shown so.",
            "The extension is left out.",
            "Nothing needs to be mended.";
        GLTF_INDEX_OUT_OF_RANGE = "gltf-index-out-of-range", Error,
            "An index names something that is not in the file.",
            "The JSON pointer says which index it is.",
            "The file is not opened.",
            "Count from 0, and write every list that is named.";
        GLTF_BUFFER_MISSING = "gltf-buffer-missing", Error,
            "The data of a buffer are not there.",
            "A .gltf file has its data in files beside it: drop them together with it.",
            "The file is not opened where a model needs them.",
            "Drop the files together, or export a `.glb`, which has all in one.";
        GLTF_BUFFER_SHORT = "gltf-buffer-short", Error,
            "A buffer has less data than it says, or a part of it reaches beyond its end.",
            "It was not written or copied to its end.",
            "The file is not opened.",
            "Write `byteLength` after the data are known, and copy the file to its end.";
        GLTF_ACCESSOR_OUT_OF_RANGE = "gltf-accessor-out-of-range", Error,
            "An accessor reaches beyond its data.",
            "Its count, offset or stride is wrong.",
            "The file is not opened.",
            "Write the count of the elements that there are, and offsets in bytes.";
        GLTF_ACCESSOR_FORMAT = "gltf-accessor-format", Error,
            "An accessor has other numbers than belong in its place.",
            "Positions have three numbers, joints four whole ones, and so on.",
            "The file is not opened.",
            "Write the type and the component type that the specification has for the attribute.";
        GLTF_NODES_TANGLED = "gltf-nodes-tangled", Error,
            "Objects are parented in a circle, or one has two parents.",
            "Every node of glTF (object, bone or empty) has one parent at most.",
            "The file is not opened.",
            "Name each node as the child of one other at most, and of none below it.";
        GLTF_TOO_LARGE = "gltf-too-large", Error,
            "The file asks for far more than it holds.",
            "One mesh or clip is used so often that it does not fit into memory.",
            "The file is not opened.",
            "Look whether a count is wrong, or one accessor is named by a great many others.";
        GLTF_RULE_BROKEN = "gltf-rule-broken", Warning,
            "The file breaks a rule of glTF, and was read as it is probably meant.",
            "Other programs may refuse it.",
            "It is read as it is probably meant; what makes no sense is left out.",
            "Look at the place with the Khronos validator, which names the rule.", OnReading;
        GLTF_EMPTY = "gltf-empty", Warning,
            "The scene has neither meshes nor joints.",
            "There is nothing to show.",
            "An empty model is opened.",
            "Look whether the scene or the selection was empty when it was exported.";
        GLTF_PRIMITIVE_LEFT_OUT = "gltf-primitive-left-out", Warning,
            "A part of a mesh has no triangles; left out.",
            "Points, lines and parts without positions are not shown.",
            "The part is left out.",
            "Export triangles.";
        GLTF_NORMALS_ABSENT = "gltf-normals-absent", Note,
            "A part of a mesh has no normals; smooth ones were computed.",
            "The format asks for flat triangles there, which would need vertices of their own.",
            "The mean of the triangles around each vertex is taken.",
            "Export normals.", OnReading;
        GLTF_MORPH_ANIMATION_LEFT_OUT = "gltf-morph-animation-left-out", Warning,
            "A clip moves shape keys (morph targets, blend shapes); they stay still.",
            "Shape keys are shown with the values that the file gives them outside of clips.",
            "The rest of the clip is played.",
            "Move what has to be seen here, such as a face, by bones.";
        GLTF_MORPH_TARGETS_LEFT_OUT = "gltf-morph-targets-left-out", Note,
            "A mesh has shape keys (morph targets), which stand still.",
            "They are shown with the weights that the file gives them outside of clips. A model here is moved by bones alone.",
            "They are neither played nor written.",
            "Move what has to be seen here, such as a face, by bones.";
        GLTF_OBJECTS_MERGED = "gltf-objects-merged", Note,
            "Several objects become one mesh.",
            "A model here has one mesh, whose parts have materials and no names of their own.",
            "They are joined, each moved by its own node or skin. A `.glb` has them apart again, a `.m3d` as one.",
            "Export what has to stay apart as files of their own.";
        GLTF_NODES_LEFT_OUT = "gltf-nodes-left-out", Note,
            "Cameras, lights or nodes on which nothing hangs are left out.",
            "They show nothing of the model.",
            "They are not shown, and no file that is written has them.",
            "Nothing needs to be mended.";
        GLTF_SCENE_LEFT_OUT = "gltf-scene-left-out", Note,
            "The file has more scenes than the one that is shown.",
            "One scene becomes the model: the one that the file shows first.",
            "The others are left out.",
            "Export each scene as a file of its own.";
        GLTF_EXTRAS_LEFT_OUT = "gltf-extras-left-out", Note,
            "The file has `extras`: values of its author's own.",
            "Programs that know them may need them; nothing of the picture depends on them.",
            "Those of objects and their meshes are in a `.glb` that is written; all others are left out.",
            "Nothing needs to be mended.";
        GLTF_ATTRIBUTE_LEFT_OUT = "gltf-attribute-left-out", Note,
            "Vertices have an attribute that is not read.",
            "It is one of a program's own, or a set of colours or texture coordinates that no material uses here.",
            "It is left out.",
            "Nothing needs to be mended.";
        GLTF_TRANSMISSION = "gltf-transmission", Note,
            "Light goes through a material, which is drawn blended.",
            "Glass bends and tints what is behind it; blending shows it as it is, through a little of the surface.",
            "It is blended by how much light goes through, and what it mirrors is seen whole.",
            "Give the material an alpha of its own and the mode BLEND, where it has to look so everywhere.";
        GLTF_MAP_LEFT_OUT = "gltf-map-left-out", Note,
            "A material has a map of transmission, or two pictures for the two values of a layer; such a map is not read.",
            "Of specular, clear coat and sheen one picture each is read, which may hold both values: glTF gives each channels of its own.",
            "The material is drawn and written without the map. The number that a layer has beside its map then holds everywhere; without its map of transmission no light goes through a material.",
            "Put both values of a layer into the channels of one picture.";
        GLTF_CHANNEL_LEFT_OUT = "gltf-channel-left-out", Note,
            "A clip moves something that is not shown; left out.",
            "Cameras, lights and empties are not shown.",
            "The rest of the clip is played.",
            "Nothing needs to be mended.";
        GLTF_MATRIX_SHEARED = "gltf-matrix-sheared", Warning,
            "An object or a bone is sheared or flattened, which a bone cannot say.",
            "Bones have a location, a rotation and a scale. What hangs on it may look displaced.",
            "The shear is left out where it is a bone; a mesh that nothing moves keeps it.",
            "Apply scales before exporting, so that nothing is turned below an object of uneven scale.";
        GLTF_IMAGE_NOT_READ = "gltf-image-not-read", Warning,
            "A picture is of a kind that is not read, or its address is wrong; the material is shown without it.",
            "PNG, JPEG and WebP are read.",
            "The material is shown without it.",
            "Export textures as PNG or JPEG.";
        WEIGHTS_CUT = "weights-cut", Warning,
            "A vertex is moved by more than four bones; the four with the greatest weights are kept.",
            "Their weights are scaled to sum to 1. The message says how much was lost at most.",
            "The four greatest weights are kept and scaled to sum to 1.",
            "Limit the weights of a vertex to four in the modelling program (Weights › Limit Total), and look at the result there.", OnReading;
    }

    /// What the checks of a mesh and its rig give ([`check::model`](crate::check::model)).
    OF_MESH_AND_RIG {
        TRIANGLES_WITHOUT_AREA = "triangles-without-area", Note,
            "A triangle has no area: corners coincide or lie in a line.",
            "It is not seen and can be left out.",
            "It is drawn, and not seen.",
            "Remove degenerate faces before the export (Clean Up › Degenerate Dissolve).", WithFix;
        TRIANGLES_REPEATED = "triangles-repeated", Note,
            "A triangle has the same three vertices as another one before.",
            "One hides the other, or flickers with it. Where it is meant as the back, it needs vertices with normals of its own.",
            "Both are drawn. `bindpose convert --fix` leaves out those that wind the same way.",
            "Remove duplicate faces before the export.";
        TRIANGLES_TURNED_AWAY = "triangles-turned-away", Warning,
            "A triangle is drawn from the side that its normals point away from, and not from the other.",
            "The file says that its material has one side. Turned triangles leave holes; the outline of a drawn character may be meant so.",
            "It is drawn from the side that its corners wind round. On the page, `Draw both sides` closes the holes.",
            "Turn its corners round where they were mirrored or flipped, or give the material two sides (`doubleSided`).";
        TRIANGLES_LIT_FROM_BEHIND = "triangles-lit-from-behind", Warning,
            "Most triangles of a part that is drawn from both sides wind the other way round than their normals say.",
            "A glTF file is lit on the side that the corners wind round, so the part looks dark, as if the light came from inside. It comes of objects that are mirrored (a negative scale) and then exported.",
            "It is drawn as the file has it, which is what glTF asks for. A `.m3d` that is written of it goes by the normals.",
            "Blender: apply the scale (Ctrl+A), then Mesh > Normals > Recalculate Outside, and export again.";
        VERTICES_UNUSED = "vertices-unused", Note,
            "A vertex is a corner of no triangle.",
            "It is loose: not seen, but it counts for the model's size and is moved with the others. It can be left out.",
            "It is kept.",
            "Write only vertices that a triangle names, and number the indices anew.", WithFix;
        EDGES_CROWDED = "edges-crowded", Note,
            "An edge belongs to more than two triangles.",
            "Perhaps a surface lies inside another one (non-manifold geometry). They share normals at that edge, which fit no more than one of them.",
            "All of them are drawn.",
            "Remove inner faces and duplicate surfaces in the modelling program.";
        TEX_COORDS_EQUAL = "tex-coords-equal", Warning,
            "All texture coordinates (UVs) of a subset are equal, so its maps show one point.",
            "Perhaps the file was exported without them. One point is enough only where the map is a palette of colours.",
            "The maps are drawn as the file says.",
            "Unwrap the mesh, and export its texture coordinates.";
        TANGENT_SIGN_AGAINST_UV = "tangent-sign-against-uv", Warning,
            "A tangent has a sign that contradicts the texture coordinates.",
            "Bumps of the normal map look like dents there. The sign is −1 or 1 so that sign · cross(normal, tangent) points along v.",
            "The sign is taken as it stands.",
            "Compute the fourth number from the texture coordinates of the file, after they were flipped for it.", WithFix;
        BONES_IDLE = "bones-idle", Note,
            "A bone moves no vertex, nor does a bone below.",
            "Often it marks the end of a limb or a place for props. Where it should move something, its weights are missing.",
            "The bone moves with the others.",
            "Leave such bones out, or paint weights for them.";
        KEYS_ALL_EQUAL = "keys-all-equal", Note,
            "A good part of a clip's keys are equal keys of bones that keep still.",
            "One key of each such bone shows the same, in a smaller file.",
            "All keys are kept.",
            "Write one key for a bone that keeps still.", WithFix;
        LOOP_JUMPS = "loop-jumps", Note,
            "A clip ends near its first pose, but not near enough to loop without a jump.",
            "The timeline shows the gap bone by bone.",
            "The clip is played as it is.",
            "Give the last keys the values of the first. Export here, and `bindpose convert --close-loop`, ease the end into them.";
        SCALE_SHEARS = "scale-shears", Note,
            "A clip turns a bone while one above it is scaled by different factors, which shears it.",
            "It is shown as the books' demos do. Programs that keep scale and rotation apart show it otherwise.",
            "The shear is shown.",
            "Scale bones by one factor for all axes, or apply the scale before the export.";
    }

    /// What the checks of posed vertices give: where the keys of a clip bring the mesh.
    OF_MOTION {
        EXPLODED = "exploded", Warning,
            "The keys of a clip do not belong to the bone offsets: the mesh flies apart.",
            "Perhaps the keys are relative to the model, not to the parent, or the clip was made for another skeleton.",
            "The clip is played as it is.",
            "Write keys relative to the bone's parent, and offsets and clips of the same skeleton.";
        POSE_OVERFLOWS = "pose-overflows", Warning,
            "A clip takes a bone, or a vertex on it, beyond 10³⁷: numbers overflow there.",
            "Scales multiply along a chain of bones, so a few great ones are enough.",
            "The clip is played; what overflows is not drawn.",
            "Write scales about 1, relative to the parent.";
    }

    /// What the books' programs cannot show as it is meant ([`check::book`](crate::check::book)), beside limits that have a code above.
    OF_BOOKS {
        BOOK_STOPS = "book-stops", Warning,
            "A book's loader does not read the file as it is meant.",
            "The loaders read words in order and look at no label.",
            "The file is read by its labels.",
            "Write the labels and values of a row as the book's exporter does, with one word for each name.", ForBook;
        BOOK_CLIP_NAME = "book-clip-name", Note,
            "There is no clip of the name that the books' demos ask for.",
            "The demos play one clip, look for it in their first frame, and crash where it is not.",
            "Any clip can be played.",
            "Name the clip to be shown `Take1`, or change `ClipName` in the demo.", ForBook;
        BOOK_ROOTS = "book-roots", Note,
            "Bone 0 is not the only root.",
            "The books' demos take bone 0 as the root of all others.",
            "Any bone may be a root.",
            "Add a bone 0 that is the parent of all others.", ForBook;
        BOOK_FOURTH_WEIGHT = "book-fourth-weight", Note,
            "The four weights of a vertex do not sum to 1, and the books take the fourth for what the others leave.",
            "Their shaders do not read the fourth weight: they take 1 less the first three.",
            "The fourth weight is used and all are normalised.",
            "Divide the four weights by their sum.", OnReading;
        BOOK_ALPHA_CLIP = "book-alpha-clip", Note,
            "A material asks for holes, which the books' demos do not cut into characters.",
            "Hair and leaves look like cards there.",
            "Holes are cut.",
            "Cut the holes out of the mesh, or add the clip to the demo's shader.";
        BOOK_HANDEDNESS = "book-handedness", Note,
            "The model is left-handed; the books' demos mirror their character.",
            "The model is shown inside out there.",
            "Handedness is found from the triangles.",
            "Export right-handed coordinates, or take the minus from the demo's scale.", ForBook;
        BOOK_SIZE = "book-size", Note,
            "The books' demos show the model too small or too large.",
            "They scale by 0.05, for a soldier that is 72 units high.",
            "The model is framed whatever its size.",
            "Scale the scene so that the character is about 72 units high, or change the demo's scale.", ForBook;
        BOOK_TANGENT_SIGN = "book-tangent-sign", Note,
            "The D3D12 book's loader leaves the sign of tangents unread.",
            "Its demo mirrors the model, so that bumps of normal maps are right where the sign is −1 and look like dents where it is 1.",
            "The sign is used.",
            "Write −1 for all tangents where nothing is mirrored, or read the fourth number in the loader.";
        BOOK_MAP_FORMAT = "book-map-format", Note,
            "A map is of a format that the book's demo does not read, or there is none.",
            "The D3D12 book reads DDS alone, and opens two maps for each material, also where `None` stands.",
            "PNG, JPEG, WebP, TGA and BMP are read too.",
            "Save maps as `.dds`, and name those in the materials; where there is none, the demo's own `white1x1.dds` and `default_nmap.dds`.";
        BOOK_MANY_MATERIALS = "book-many-materials", Note,
            "There are more materials than the D3D12 book's demo has room for.",
            "It opens two textures for each, and its shader has an array of 48 for them and six of its own. Of more than 24 materials it writes \
             behind its 64 views.",
            "All materials are drawn.",
            "Join materials that look alike, or raise the sizes of `gTextureMaps` and of the demo's heap of views.";
        BOOK_MATERIAL_NAME = "book-material-name", Note,
            "A material has a name that the D3D12 book's demo uses itself.",
            "It keeps materials by name, and its own are called `sky`, `bricks0`, `tile0` and `mirror0`.",
            "The material is drawn as any other.",
            "Give the material another name.", ForBook;
    }

    /// What [`Skeleton::new`](crate::model::Skeleton::new), [`Track::new`](crate::model::Track::new) and
    /// [`Model::checked`](crate::model::Model::checked) refuse. No file leads to these.
    OF_CONSTRUCTORS {
        STREAM_LENGTH = "stream-length", Error,
            "A stream of the mesh has not one entry for each vertex.",
            "Every vertex has a normal, a tangent and texture coordinates, and influences if there are joints.",
            "The part is refused.",
            "Give every stream as many entries as there are positions.";
        POSITION_NOT_FINITE = "position-not-finite", Error,
            "A position holds a number that is not finite.",
            "NaN and infinity have no place in the picture.",
            "The part is refused.",
            "Replace the number before the mesh is made.";
        INCOMPLETE_TRIANGLE = "incomplete-triangle", Error,
            "The number of vertex indices is not a multiple of three.",
            "Three indices make a triangle.",
            "The part is refused.",
            "Give three indices for each triangle.";
        JOINT_OUT_OF_RANGE = "joint-out-of-range", Error,
            "A vertex names a joint that is not there.",
            "A slot without weight names joint 0.",
            "The part is refused.",
            "Give joints of the skeleton.";
        SUBMESH_OUT_OF_RANGE = "submesh-out-of-range", Error,
            "A submesh names triangles or a material that are not there.",
            "Its range lies inside the mesh, and its material in the list of materials.",
            "The part is refused.",
            "Cut ranges off at the mesh's end, and add the material.";
        TRACK_COUNT = "track-count", Error,
            "A clip has not one track for each joint.",
            "A joint without keys has a track at rest.",
            "The part is refused.",
            "Give one track for each joint, in their order.";
        PARENT_NOT_BEFORE = "parent-not-before", Error,
            "A joint stands before its parent.",
            "Poses are multiplied from the first joint to the last.",
            "The part is refused.",
            "Sort the joints, and all that names them.";
        JOINT_COUNT_MISMATCH = "joint-count-mismatch", Error,
            "There are not as many parents, inverse bind matrices and file bones.",
            "Every joint has one of each.",
            "The part is refused.",
            "Give lists of equal length.";
        FILE_BONE_NOT_UNIQUE = "file-bone-not-unique", Error,
            "A joint's file bone is out of range or taken.",
            "The file bones are an order of all joints.",
            "The part is refused.",
            "Give each joint another number below their count.";
        MATRIX_NOT_FINITE = "matrix-not-finite", Error,
            "An inverse bind matrix holds a number that is not finite.",
            "It takes the vertices of its joint out of the bind pose.",
            "The part is refused.",
            "Use the identity where nothing better is known.";
        NO_KEYS = "no-keys", Error,
            "A track needs at least one key.",
            "A joint without keys is left out of the clip's tracks or rests.",
            "The part is refused.",
            "Give one key with the pose at rest.";
        KEY_NOT_AFTER = "key-not-after", Error,
            "A key is not after the key before it.",
            "Key times must increase.",
            "The part is refused.",
            "Sort the keys, and keep one for each time.";
        KEY_NOT_FINITE = "key-not-finite", Error,
            "A key holds a number that is not finite, or a rotation without a direction.",
            "A pose is made of numbers.",
            "The part is refused.",
            "Leave the key out, or give it numbers and a quaternion of length 1.";
    }

    /// What reading a picture gives ([`image::decode`](crate::image::decode)). A model shows without its maps.
    OF_IMAGES {
        IMAGE_EMPTY = "image-empty", Warning,
            "The picture's file is empty.",
            "Perhaps it was not written or copied to its end.",
            "The material is drawn without the map.",
            "Save the picture again.";
        IMAGE_UNRECOGNIZED = "image-unrecognized", Warning,
            "The file is none of DDS, PNG, JPEG, WebP, TGA, BMP and Radiance.",
            "Neither its first bytes nor its name say what it is.",
            "The material is drawn without the map.",
            "Save the picture as DDS, PNG, JPEG, TGA or BMP.";
        DDS_SIGNATURE = "dds-signature", Warning,
            "A DDS file does not begin like one.",
            "Perhaps it is another kind of picture under this name.",
            "The material is drawn without the map.",
            "Save it as DDS, or give it the extension of what it is.";
        DDS_HEADER_CUT = "dds-header-cut", Warning,
            "A DDS file ends within its header.",
            "It was not written or copied to its end.",
            "The material is drawn without the map.",
            "Save or copy the picture again.";
        DDS_HEADER_FIELD = "dds-header-field", Warning,
            "A field of a DDS header has a value that it cannot have.",
            "The file is damaged.",
            "The material is drawn without the map.",
            "Save the picture again with a program that writes DDS, such as texconv.";
        DDS_UNSUPPORTED = "dds-unsupported", Warning,
            "A DDS file stores its pixels in a way that is not supported.",
            "BC1 to BC7 and plain 8, 16, 24 and 32 bits are read.",
            "The material is drawn without the map.",
            "Save it as BC1, BC3, BC5 or BC7, or as 32 bits a pixel.";
        DDS_MASK = "dds-mask", Warning,
            "A channel mask of a DDS file does not fit its pixels.",
            "The file is damaged.",
            "The material is drawn without the map.",
            "Save it with 8 bits for each channel.";
        IMAGE_DIMENSION = "image-dimension", Warning,
            "The texture has one dimension, or three.",
            "Maps are flat pictures, skies are cube maps.",
            "The material is drawn without the map.",
            "Save one slice of it as a flat picture.";
        IMAGE_CUBE = "image-cube", Warning,
            "A cube map lacks faces, its faces are not square, or a panorama is not twice as wide as high.",
            "A sky needs six square faces, or a panorama of all of it.",
            "The material is drawn without the map.",
            "Save all six faces, square and of one size.";
        IMAGE_NO_SLICES = "image-no-slices", Warning,
            "The texture says that it has no slices.",
            "There is no picture in it.",
            "The material is drawn without the map.",
            "Save it as an array of one slice.";
        IMAGE_SIZE = "image-size", Warning,
            "The picture has no size, or is too large.",
            "A side has at least one pixel, and at most as many as a GPU can hold.",
            "The material is drawn without the map.",
            "Scale the picture down.";
        IMAGE_MIP_COUNT = "image-mip-count", Warning,
            "The texture has more mip levels than its size allows.",
            "The header is damaged.",
            "The material is drawn without the map.",
            "Save it with mips down to 1 × 1, or with none.";
        IMAGE_CUT = "image-cut", Warning,
            "The picture's file ends too early.",
            "It was not written or copied to its end.",
            "The material is drawn without the map.",
            "Save or copy the picture again.";
        IMAGE_IMPLAUSIBLE = "image-implausible", Warning,
            "The picture claims more pixels than its file can hold.",
            "The header is damaged.",
            "The material is drawn without the map.",
            "Save the picture again.";
        IMAGE_DATA_LENGTH = "image-data-length", Warning,
            "The picture's data are not as long as its size asks for.",
            "The file is damaged.",
            "The material is drawn without the map.",
            "Give four bytes for each texel.";
        IMAGE_UNDECODABLE = "image-undecodable", Warning,
            "The picture could not be decoded.",
            "The message has the decoder's words.",
            "The material is drawn without the map.",
            "Open it in a picture editor and save it again.";
    }

    /// What putting files together gives: models, maps, clips, and the GPU that is to draw them.
    OF_SESSION {
        NO_MODEL = "no-model", Error,
            "No model was dropped.",
            "Pictures alone show nothing.",
            "What is open stays.",
            "Drop the `.m3d` file too, or the folder that has both.";
        ARCHIVE_UNREADABLE = "archive-unreadable", Error,
            "An archive cannot be unpacked.",
            "A file in it is damaged, encrypted or packed in a way that is not read, or all are too large together; the message says which.",
            "What is open stays.",
            "Unpack it with another program and drop its folder.";
        MAP_MISSING = "map-missing", Note,
            "No file fits a map that a material names.",
            "The material is drawn without it. Maps are found by base name and may be dropped later.",
            "The material is drawn in its colour.",
            "Put the picture beside the model, or write the name that it has.";
        MAP_IS_CUBE = "map-is-cube", Warning,
            "A cube map has the name of a map that a material names.",
            "A material's map is one flat picture; a cube map is six, of what is around.",
            "The material is drawn without the map; the cube map can be the sky.",
            "Save a flat picture under this name, or give the cube map another one.";
        MAP_AMBIGUOUS = "map-ambiguous", Note,
            "A map could be several files; the first is taken.",
            "They have one name, in several folders or formats.",
            "The first of them is taken.",
            "Rename or leave out the files that are not meant.";
        MAP_UNUSED = "map-unused", Note,
            "A picture fits no name of the model's maps, or a better one was there; not used.",
            "Maps are found by base name, without case and extension.",
            "The picture is not used.",
            "Name the picture in a material.";
        CLIPS_BONES_DIFFER = "clips-bones-differ", Error,
            "Clips can only be added from a file with the same bones.",
            "Where both files name bones, at least half of those that the clips move must have a name that the model has too; else all are the same, in the same order. The message says what differs.",
            "No clip is added.",
            "Export the clips with the model's skeleton: with the same names, or without names with the same bones in the same order.";
        CLIPS_NONE = "clips-none", Error,
            "The file has no clips to add.",
            "Perhaps it was exported without its animation.",
            "No clip is added.",
            "Export the animation together with the skeleton.";
        CLIPS_OFFSETS_DIFFER = "clips-offsets-differ", Note,
            "The bone offsets of a file of clips differ from those of the model.",
            "Its clips were made for other proportions, and may look displaced.",
            "The clips are added.",
            "Export model and clips from one bind pose.";
        CLIPS_BY_NAMES = "clips-by-names", Note,
            "Clips of another file found their bones by name, and not all fits.",
            "Bones that only one of the files has do not move. Where bones lie otherwise at rest, a motion is kept relative to the rest pose.",
            "The clips are added.",
            "Nothing, if it looks right; else export model and clips with one skeleton, in one pose.";
        CLIPS_REPLACED = "clips-replaced", Note,
            "A file of clips was added before; its clips replace those from then.",
            "The clips have the state of the file that came last.",
            "The earlier clips of that file are taken out.",
            "Nothing needs to be done.";
        GPU_REFUSED = "gpu-refused", Error,
            "This cannot be drawn here.",
            "The graphics device has too little memory, or cannot hold something so large. The file may be sound.",
            "What was open before is shown again.",
            "Close other pages that draw, or reduce mesh and maps.";
    }

    /// What the page gives by itself, where the viewer cannot (`web/api.js`).
    OF_PAGE {
        VIEWER_STOPPED = "viewer-stopped", Error,
            "The viewer stopped.",
            "It cannot go on.",
            "The page says so.",
            "Load the page again; if it happens again, try the other backend.";
    }

    /// What the command line gives beside these, about files and folders.
    OF_COMMAND_LINE {
        FILE_UNREADABLE = "file-unreadable", Warning,
            "The file cannot be read.",
            "The message has the system's reason.",
            "The file is skipped.",
            "Change the rights of the file.";
        LINK_BROKEN = "link-broken", Warning,
            "The link cannot be followed; skipped.",
            "It leads nowhere.",
            "The link is skipped.",
            "Remove the link, or let it lead to a file.";
        NOT_A_FILE = "not-a-file", Warning,
            "This is no regular file; skipped.",
            "A pipe or a device has the name of a model or a map. Opening it could wait for ever.",
            "It is skipped.",
            "Put a file in its place. A pipe that is named itself, not its folder, is read.";
        FOLDER_UNREADABLE = "folder-unreadable", Warning,
            "The folder cannot be read; skipped.",
            "The message has the system's reason.",
            "The folder is skipped.",
            "Change the rights of the folder.";
        FOLDER_TOO_LARGE = "folder-too-large", Warning,
            "The folder holds more files than are looked at; the others are skipped.",
            "Perhaps a whole disk was named.",
            "What comes later is skipped.",
            "Name a folder that holds the maps alone.";
    }
}
