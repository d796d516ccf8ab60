//! Damaged files: cut short, with lines lost or garbled, or with bytes changed at random.

use bindpose::diagnostic::Fault;
use bindpose::format::{Parsed, parse, write};
use proptest::prelude::*;

use super::{fixtures, good, real_file};

/// A prefix is a whole file when what is missing says nothing: blanks, the end of the last number, or sections without rows.
#[test]
fn every_prefix_is_an_error_unless_it_is_a_whole_file() {
    for name in ["d3d12_skinned", "d3d11_static", "imm_skinned", "layout_crlf_bom"] {
        let bytes = good(name);
        let whole = bytes.trim_ascii_end().len();
        for length in 0..bytes.len() {
            let result = parse(&bytes[..length]);
            assert_eq!(
                result.is_ok(),
                length >= whole,
                "{name} cut to {length} of {whole} bytes: {result:?}"
            );
        }
    }
}

/// The same at every token of each good fixture: nothing is read out of less than was there.
#[test]
fn every_prefix_of_tokens_is_an_error_or_a_smaller_whole_file() {
    for fixture in fixtures("good") {
        let all = parse(&fixture.bytes).expect("good fixtures can be read");
        for (at, _) in fixture
            .bytes
            .windows(2)
            .enumerate()
            .filter(|(_, pair)| !is_blank(pair[0]) && is_blank(pair[1]))
        {
            if let Ok(parsed) = parse(&fixture.bytes[..=at]) {
                assert_eq!(parsed.document, all.document, "{} cut behind byte {at}", fixture.name);
            }
        }
    }
}

#[test]
fn every_tenth_token_prefix_of_a_real_file_is_an_error() {
    for name in ["models/imm/column.m3d", "models/d3d11/rock.m3d"] {
        let Some(bytes) = real_file(name) else { continue };
        let ends = (1..bytes.len()).filter(|&at| !is_blank(bytes[at - 1]) && is_blank(bytes[at]));
        let whole = bytes.trim_ascii_end().len();
        for length in ends.step_by(10).filter(|&length| length < whole) {
            assert!(
                parse(&bytes[..length]).is_err(),
                "{name} cut to {length} bytes was read"
            );
        }
    }
}

/// Without a line that says something, a file is refused or noted. Only blank lines may go unnoticed: they say nothing.
#[test]
fn a_lost_line_is_never_silent() {
    for fixture in fixtures("good") {
        let before = parse(&fixture.bytes).expect("good fixtures can be read");
        for (number, lines) in each_line(&fixture.bytes) {
            let mut lines = lines;
            let line = lines.remove(number);
            let result = parse(&lines.concat());
            let says_something = !line.trim_ascii().is_empty() && line != b"\xEF\xBB\xBF";
            if says_something && !is_optional(line) {
                assert_noticed(&fixture.name, number, &before, &result);
            }
        }
    }
}

/// A line whose first word is garbled, or its last one, is refused or noted. Names may be
/// anything, and so may a header's ruler behind its stars; lines that were noted before stay so.
#[test]
fn a_garbled_line_is_never_silent() {
    // What is left out may hold anything, and of several unreadable values only the first has a place in the notices.
    let left_out = [
        "alpha_clip_unreadable",
        "blend_data_unused",
        "comment_above_header",
        "material_line_repeated",
    ];
    for fixture in fixtures("good")
        .into_iter()
        .filter(|fixture| !left_out.contains(&fixture.name.as_str()))
    {
        let before = parse(&fixture.bytes).expect("good fixtures can be read");
        for (number, lines) in each_line(&fixture.bytes) {
            let line = lines[number].trim_ascii();
            let noted = before.diagnostics.iter().filter_map(|notice| notice.position);
            let noted = noted.map(|place| place.line as usize - 1).any(|line| line == number);
            if line.is_empty() || noted || is_optional(line) {
                continue;
            }
            let first_word = garbled_first_word(lines[number]);
            let last_word = [lines[number].trim_ascii_end(), b"~%\n"].concat();
            let replaced = if holds_a_name(line) {
                vec![first_word]
            } else {
                vec![first_word, last_word]
            };
            for garbled in replaced {
                let mut lines: Vec<&[u8]> = lines.clone();
                lines[number] = &garbled;
                assert_noticed(&fixture.name, number, &before, &parse(&lines.concat()));
            }
        }
    }
}

proptest! {
    #![proptest_config(crate::properties::cases(400))]

    #[test]
    fn arbitrary_bytes_are_answered(bytes in prop::collection::vec(any::<u8>(), 0..600)) {
        answered(&bytes);
    }

    #[test]
    fn arbitrary_words_of_the_format_are_answered(words in prop::collection::vec(word(), 0..120)) {
        answered(words.concat().as_bytes());
    }

    #[test]
    fn arbitrarily_changed_fixtures_are_answered(
        index in any::<prop::sample::Index>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), change()), 1..12),
    ) {
        let fixtures = fixtures("good");
        let mut bytes = fixtures[index.index(fixtures.len())].bytes.clone();
        for (place, change) in changes {
            let at = place.index(bytes.len() + 1);
            match change {
                Change::Insert(text) => drop(bytes.splice(at..at, text)),
                Change::Remove(length) => drop(bytes.drain(at..(at + length).min(bytes.len()))),
                Change::Set(byte) => if let Some(place) = bytes.get_mut(at) { *place = byte },
            }
        }
        answered(&bytes);
    }
}

#[derive(Clone, Debug)]
enum Change {
    Insert(Vec<u8>),
    Remove(usize),
    Set(u8),
}

fn change() -> impl Strategy<Value = Change> {
    prop_oneof![
        word().prop_map(|word| Change::Insert(word.into_bytes())),
        (1..40_usize).prop_map(Change::Remove),
        any::<u8>().prop_map(Change::Set),
    ]
}

/// What files of this format are made of.
fn word() -> impl Strategy<Value = String> {
    let words = "*** --- * { } : # - , . e 0 1 2 -1 4294967295 4294967296 1e39 nan Materials Vertices Triangles Bones \
        AnimationClips SubsetTable m3d-File-Header BoneOffsets BoneHierarchy BoneOffset0 ParentIndexOfBone0: \
        AnimationClip";
    let lines = [
        "\n",
        "\r\n",
        "\r",
        " ",
        "\t",
        "Name: x\n",
        "Diffuse: 1 1 1\n",
        "Ambient: 0 0 0\n",
        "SubsetID: 0 VertexStart: 0 VertexCount: 0 FaceStart: 0 FaceCount: 0\n",
        "Position: 0 0 0\n",
        "Tangent: 1 0 0\n",
        "Normal: 0 0 1\n",
        "Tex-Coords: 0 0\n",
        "Bone0 #Keyframes:",
        "Time: 0 Pos: 0 0 0 Scale: 1 1 1 Quat: 0 0 0 1\n",
    ];
    let all: Vec<_> = words.split(' ').chain(lines).collect();
    prop::sample::select(all).prop_map(str::to_owned)
}

/// Any answer will do, as long as it is sound: places inside of the file, and a document that can be written and read again.
fn answered(bytes: &[u8]) {
    let lines = bytes.split(|&byte| byte == b'\n' || byte == b'\r').count();
    let places: Vec<_> = match parse(bytes) {
        Ok(parsed) => {
            let again = parse(write(&parsed.document).as_bytes());
            assert!(
                again.is_ok(),
                "what was read cannot be written and read again: {again:?}"
            );
            parsed.diagnostics.iter().filter_map(|notice| notice.position).collect()
        }
        Err(error) => {
            assert!(error.to_string().len() < 300, "long message: {error}");
            error.places
        }
    };
    for place in places {
        assert!(
            place.line >= 1 && place.line as usize <= lines && place.column >= 1,
            "{place} of {lines} lines"
        );
        bindpose::format::excerpt(bytes, place, 3);
    }
}

fn assert_noticed(name: &str, line: usize, before: &Parsed, result: &Result<Parsed, Fault>) {
    if let Ok(after) = result {
        let told = |parsed: &Parsed| {
            parsed
                .diagnostics
                .iter()
                .map(|notice| notice.message.clone())
                .collect::<Vec<_>>()
        };
        assert_ne!(
            told(after),
            told(before),
            "{name}: nothing was said of line {}",
            line + 1
        );
    }
}

/// The lines of a file with their ends, once for each line.
fn each_line(bytes: &[u8]) -> impl Iterator<Item = (usize, Vec<&[u8]>)> {
    let lines: Vec<&[u8]> = bytes.split_inclusive(|&byte| byte == b'\n').collect();
    (0..lines.len()).map(move |number| (number, lines.clone()))
}

/// Lines that a file may have or not: decoration, what was left out anyway, and a count that has its own default.
fn is_optional(line: &[u8]) -> bool {
    let bare_ruler = line.trim_ascii().iter().all(|&byte| byte == b'*');
    bare_ruler || line.starts_with(b"#Subsets")
}

fn holds_a_name(line: &[u8]) -> bool {
    let labels: [&[u8]; 6] = [
        b"Name:",
        b"MaterialTypeName:",
        b"Effect:",
        b"DiffuseMap:",
        b"NormalMap:",
        b"AnimationClip",
    ];
    labels.iter().any(|label| line.starts_with(label))
        || line.ends_with(b"Header***************")
        || line.ends_with(b"Header ****")
        || line.ends_with(b"Header-")
}

/// `Nor~mal: …`: a letter too many in the first word, or in a number.
fn garbled_first_word(line: &[u8]) -> Vec<u8> {
    let start = line.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(0);
    let mut garbled = line.to_vec();
    garbled.splice(start..start, *b"qx~");
    garbled
}

fn is_blank(byte: u8) -> bool {
    byte.is_ascii_whitespace()
}
