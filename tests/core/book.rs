//! What the books' loaders make of files.

mod stream;

use std::fmt::Write as _;
use std::path::Path;

use bindpose::check::book::{Book, Known, Outcome, Verdict, read, verdict};
use bindpose::diagnostic::Entry;
use bindpose::format::{Dialect, Document, Material, Reflectance, Subset, parse, write};
use bindpose::model::Handedness;
use proptest::prelude::*;

use crate::documents::{REAL_FILES, arm, is_sentence, key, quad, shared_bytes, track};
use crate::format::{fixtures, written_documents};

/// A document as the D3D12 book writes it, for its demo: with the demo's clip and size.
fn for_demo() -> Document {
    let mut document = arm();
    document.clips[0].name = "Take1".into();
    for vertex in &mut document.vertices {
        vertex.position = vertex.position.map(|place| place * 24.0);
        vertex.tangent[3] = -1.0;
    }
    for material in &mut document.materials {
        material.name = "skin".into();
        material.type_name = "Skinned".into();
        material.diffuse_map = Some("skin_diff.dds".into());
        material.normal_map = Some("skin_norm.dds".into());
    }
    document
}

fn verdict_of(book: Book, document: &Document) -> Verdict {
    let known = Known {
        document: Some(document),
        handedness: Some(Handedness::Right),
        ..Known::default()
    };
    verdict(book, write(document).as_bytes(), &known)
}

#[track_caller]
fn assert_shows(verdict: &Verdict, words: &str) {
    assert_eq!(verdict.shows, words);
}

/// The codes of what the D3D12 book's demo says against a document.
fn codes(document: &Document) -> Vec<&'static str> {
    codes_of(&verdict_of(Book::D3d12, document))
}

fn codes_of(verdict: &Verdict) -> Vec<&'static str> {
    verdict.limits.iter().map(|limit| limit.code).collect()
}

fn one_line(verdict: &Verdict) -> String {
    match &verdict.trouble {
        None => format!("{}. {}", verdict.outcome, verdict.shows),
        Some(trouble) => {
            let place = trouble.position;
            format!("{}:{} {} {}", place.line, place.column, trouble.why, verdict.shows)
        }
    }
}

/// What both loaders make of every fixture. `BLESS=1 cargo test` writes the list anew.
#[test]
fn the_list_of_verdicts_holds() {
    let mut list = String::new();
    for folder in ["good", "bad"] {
        for fixture in fixtures(folder) {
            for book in Book::ALL {
                let verdict = verdict(book, &fixture.bytes, &Known::default());
                let line = one_line(&verdict).replace(|letter: char| letter.is_control(), "?");
                writeln!(list, "{folder}/{} {}: {line}", fixture.name, book.name()).expect("a string takes all");
            }
        }
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/book_verdicts.txt");
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, &list).expect("the list can be written");
    }
    let held = std::fs::read_to_string(&path).expect("the list is there");
    for (line, expected) in list.lines().zip(held.lines()) {
        assert_eq!(line, expected);
    }
    assert_eq!(list.lines().count(), held.lines().count());
}

/// A loader that reads a file to its end took from it what the file means.
#[test]
fn what_a_loader_reads_is_what_the_file_means() {
    let mut compared = 0;
    for fixture in fixtures("good") {
        let meant = parse(&fixture.bytes).expect("good fixtures can be read").document;
        for book in Book::ALL {
            let trouble = verdict(book, &fixture.bytes, &Known::default()).trouble;
            let said = as_said(&read(book, &fixture.bytes, &Known::default()).document);
            if trouble.is_none() {
                assert_eq!(said, as_said(&meant), "{} by {}", fixture.name, book.name());
                compared += 1;
            } else {
                // The other way round would be a file that is read well and called bad.
                assert_ne!(said, as_said(&meant), "{} by {}", fixture.name, book.name());
            }
        }
    }
    assert!(compared > 20, "{compared}");
}

/// What the loaders keep of a document: no word for "no map", no vertex ranges, no name for the dialect, and no bone of a slot without
/// weight.
fn as_said(document: &Document) -> Document {
    let mut document = document.clone();
    document.dialect = Dialect::D3d12;
    for material in &mut document.materials {
        for map in [&mut material.diffuse_map, &mut material.normal_map] {
            *map = map.take().filter(|name| !matches!(name.as_str(), "None" | "Null"));
        }
    }
    for vertex in &mut document.vertices {
        for (index, weight) in vertex.blend_indices.iter_mut().zip(vertex.blend_weights) {
            *index = if weight == 0.0 { 0 } else { *index };
        }
    }
    document
}

proptest! {
    #![proptest_config(crate::properties::cases(100))]

    #[test]
    fn documents_as_the_books_write_them_are_read_as_they_are_meant(mut document in written_documents()) {
        // What the books' own exporter gives: one word for each name, a map for each material, a subset for each material, bones
        // before clips.
        let word = |name: &str, index: usize| {
            let letters: String = name.chars().filter(char::is_ascii_alphanumeric).collect();
            format!("n{letters}{index}")
        };
        for (index, material) in document.materials.iter_mut().enumerate() {
            let is_phong = matches!(material.reflectance, Reflectance::Phong { .. });
            material.name = if is_phong { String::new() } else { word(&material.name, index) };
            material.type_name = word(&material.type_name, index);
            material.diffuse_map = Some(word("d", index));
            material.normal_map = Some(word("n", index));
        }
        document.subsets.resize(document.materials.len(), bindpose::format::Subset::default());
        for (index, clip) in document.clips.iter_mut().enumerate() {
            clip.name = word(&clip.name, index);
        }
        if document.bone_parents.is_empty() {
            document.clips.clear();
        }
        let book = match document.dialect {
            Dialect::D3d12 => Book::D3d12,
            Dialect::D3d11 | Dialect::Imm | Dialect::Text => Book::D3d11,
        };
        let text = write(&document);
        let meant = parse(text.as_bytes()).expect("what is written can be read").document;
        let trouble = verdict(book, text.as_bytes(), &Known::default()).trouble;
        prop_assert!(trouble.is_none(), "{trouble:?}\n{text}");
        prop_assert_eq!(as_said(&read(book, text.as_bytes(), &Known::default()).document), as_said(&meant));
    }
}

/// The same words in the same places, in lines that end in a blank which only `>>` takes for one: no row is read as a whole then, but each
/// word by itself.
fn word_by_word(text: &[u8]) -> Vec<u8> {
    let mut words = Vec::with_capacity(text.len() * 2);
    for (index, &byte) in text.iter().enumerate() {
        let ends_line = match byte {
            b'\n' => index == 0 || text[index - 1] != b'\r',
            b'\r' => text.get(index + 1) == Some(&b'\n'),
            _ => false,
        };
        words.extend(ends_line.then_some(0x0B));
        words.push(byte);
    }
    words
}

/// Puts something else in some places of a text.
fn damaged(text: &str, damage: &[(usize, &str)]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for &(place, other) in damage {
        let place = place % bytes.len();
        bytes.splice(place..=place, other.bytes());
    }
    bytes
}

proptest! {
    #![proptest_config(crate::properties::cases(400))]

    #[test]
    fn rows_that_are_read_as_a_whole_are_read_as_word_by_word(
        document in written_documents(),
        damage in prop::collection::vec((any::<usize>(), prop::sample::select(vec![
            "", " ", "\t", "\n", "\r\n", "\r", "\n\n", "0", "-", ".", ",5", ":", "x", "e9", "e-60", "nan", " 7", " 70000 ", "{", "}", "Normal:",
        ])), 0..4),
    ) {
        let bytes = damaged(&write(&document), &damage);
        let plain = word_by_word(&bytes);
        for book in Book::ALL {
            let (quick, plain) = (read(book, &bytes, &Known::default()), read(book, &plain, &Known::default()));
            prop_assert_eq!(quick.stop, plain.stop);
            prop_assert_eq!(quick.mistake, plain.mistake);
            prop_assert_eq!(quick.counts, plain.counts);
            prop_assert_eq!(quick.document, plain.document);
        }
    }
}

#[test]
fn rows_of_fixtures_and_real_files_are_read_as_word_by_word() {
    let of_fixtures = ["good", "bad"]
        .into_iter()
        .flat_map(fixtures)
        .map(|fixture| fixture.bytes);
    let real = REAL_FILES
        .iter()
        .filter_map(|name| shared_bytes(&format!("models/{name}.m3d")));
    for bytes in of_fixtures.chain(real) {
        let plain = word_by_word(&bytes);
        for book in Book::ALL {
            let (quick, plain) = (
                read(book, &bytes, &Known::default()),
                read(book, &plain, &Known::default()),
            );
            assert_eq!((quick.stop, quick.mistake), (plain.stop, plain.mistake));
            assert!(quick.document == plain.document && quick.counts == plain.counts);
        }
    }
}

#[test]
fn real_files_are_read_by_the_loader_of_their_book() {
    for name in REAL_FILES {
        let Some(bytes) = shared_bytes(&format!("models/{name}.m3d")) else {
            continue;
        };
        let (own, other) = if name.starts_with("d3d12") {
            (Book::D3d12, Book::D3d11)
        } else {
            (Book::D3d11, Book::D3d12)
        };
        assert!(verdict(own, &bytes, &Known::default()).reads(), "{name}");
        let stop = verdict(other, &bytes, &Known::default()).position();
        assert_eq!(stop.map(|place| (place.line, place.column)), Some((9, 1)), "{name}");
    }
}

/// Followed by hand. The D3D11 loader skips `Name:`, wants the first number of Ambient and finds `soldier_head`.
#[test]
fn the_other_books_materials_stop_a_loader_at_their_first_word() {
    let mut document = for_demo();
    document.materials[0].name = "soldier_head".into();
    let verdict = verdict_of(Book::D3d11, &document);
    assert_eq!(
        one_line(&verdict),
        "9:1 It takes \"Name:\" for the label Ambient of material 0. In line 9 it reads Ambient of material 0 and finds \
         \"soldier_head\", which is no number. It ends with an error: it looks for a map without a name."
    );
}

/// Followed by hand. `AnimationClip Take 001 {` gives the name `Take`; `001` is skipped as the brace; the bone's two words are `{` and
/// `Bone0`, and its number of keys is `#Keyframes:`.
#[test]
fn a_clip_name_of_two_words_stops_a_loader_in_its_first_bone() {
    let mut document = for_demo();
    document.clips[0].name = "Take 001".into();
    let verdict = verdict_of(Book::D3d12, &document);
    let trouble = verdict.trouble.as_ref().expect("it stops");
    assert_eq!(trouble.entry, Entry::Track { clip: 0, bone: 0 });
    assert!(
        trouble
            .why
            .ends_with("finds \"#Keyframes:\", which is no whole number."),
        "{}",
        trouble.why
    );
    assert_shows(&verdict, "It crashes at its first frame: there is no clip \"Take1\".");
}

/// Followed by hand. The header counts one vertex more than there are: the ruler of the triangles is taken for `Position:`, the six
/// indices of the two triangles for a position and the label and the first two numbers of a tangent, and the ruler of the next section,
/// or the end of the file, is no number.
#[test]
fn a_count_that_is_believed_leads_into_the_next_section() {
    let document = quad();
    let text = write(&Document {
        materials: for_demo().materials,
        ..document
    });
    let text = text.replace("#Vertices 4", "#Vertices 5");
    let verdict = verdict(Book::D3d12, text.as_bytes(), &Known::default());
    let why = verdict.trouble.expect("it stops").why;
    assert!(why.contains("for the label Position of vertex 4"), "{why}");
    assert!(
        why.ends_with("the file ends where it reads Tangent of vertex 4."),
        "{why}"
    );
}

/// Two labels change places: their values are as many, so nothing fails.
#[test]
fn swapped_lines_are_read_into_each_other() {
    let text = write(&for_demo())
        .replace("Diffuse:", "X:")
        .replace("Fresnel0:", "Diffuse:")
        .replace("X:", "Fresnel0:");
    let verdict = verdict(Book::D3d12, text.as_bytes(), &Known::default());
    assert_eq!(verdict.position().map(|place| place.line), Some(10));
    assert_shows(&verdict, "The model, but material 0 has values that belong elsewhere.");
}

#[test]
fn a_model_for_the_demo_has_no_limits() {
    let verdict = verdict_of(Book::D3d12, &for_demo());
    assert!(verdict.reads() && verdict.limits.is_empty(), "{:?}", verdict.limits);
    assert_shows(&verdict, "The model in \"Take1\".");
}

/// Gives a document so many materials with names of their own, the last ones for no triangle.
fn with_materials(document: &mut Document, count: usize) {
    let first = document.materials[0].clone();
    let named = |index| Material {
        name: format!("skin{index}"),
        ..first.clone()
    };
    document.materials.extend((1..count).map(named));
    document.subsets.resize(count, Subset::default());
}

/// Where a material has no map, the format says `None`, and the demo opens a file of that name.
#[test]
fn a_material_without_a_map_ends_the_demo_whoever_asks() {
    let mut document = for_demo();
    document.materials[0].normal_map = None;
    let text = write(&document);
    let meant = parse(text.as_bytes()).expect("it can be read").document;
    assert_eq!(meant.materials[0].normal_map, None);
    for document in [Some(&meant), None] {
        let known = Known {
            document,
            handedness: Some(Handedness::Right),
            missing_maps: Some(&[]),
            ..Known::default()
        };
        let verdict = verdict(Book::D3d12, text.as_bytes(), &known);
        assert_eq!((verdict.outcome, verdict.ends), (Outcome::EndsWithError, true));
        assert_shows(&verdict, "It ends with an error: \"None\" is no picture that it reads.");
        let codes = codes_of(&verdict);
        assert_eq!(codes, ["book-map-format"]);
        assert!(
            verdict.limits[0].message.starts_with("Material 0 lacks a map, "),
            "{:?}",
            verdict.limits
        );
    }
}

/// Maps are opened, and views of them made, before the first frame asks for the clip and the bones.
#[test]
fn what_ends_the_demo_first_is_told() {
    let mut document = for_demo();
    document.clips[0].name = "Walk".into();
    let shows = |document: &Document| verdict_of(Book::D3d12, document).shows;
    assert_eq!(
        shows(&document),
        "It crashes at its first frame: there is no clip \"Take1\"."
    );
    with_materials(&mut document, 25);
    let garbage = "It has room for 24 pairs of maps and writes 25: it crashes or draws garbage.";
    assert_eq!(shows(&document), garbage);
    document.materials[3].diffuse_map = Some("suit.png".into());
    assert_eq!(
        shows(&document),
        "It ends with an error: \"suit.png\" is no picture that it reads."
    );
    assert_eq!(
        codes(&document),
        ["book-clip-name", "book-many-materials", "book-map-format"]
    );
}

/// The demo's shader has 48 textures, of which six are the scene's own; its heap has room for 64 views, of which 16 are.
#[test]
fn the_demos_room_for_textures_is_judged() {
    for (count, is_told, ends) in [
        (21, false, false),
        (22, true, false),
        (24, true, false),
        (25, true, true),
    ] {
        let mut document = for_demo();
        with_materials(&mut document, count);
        let verdict = verdict_of(Book::D3d12, &document);
        let codes = codes_of(&verdict);
        assert_eq!(codes.contains(&"book-many-materials"), is_told, "{count}");
        assert_eq!(verdict.ends, ends, "{count}: {}", verdict.shows);
    }
}

#[test]
fn the_sign_of_tangents_matters_where_there_are_bumps() {
    for (map, is_told) in [
        ("flat_normal.dds", false),
        ("default_nmap.dds", false),
        ("skin_norm.dds", true),
    ] {
        let mut document = for_demo();
        document.vertices[0].tangent[3] = 1.0;
        document.materials[0].normal_map = Some(map.into());
        let limits = verdict_of(Book::D3d12, &document).limits;
        assert_eq!(!limits.is_empty(), is_told, "{map}: {limits:?}");
    }
}

/// Each limit by itself: an edit of a document that has none, and the only code that comes of it.
#[test]
fn each_limit_is_found_and_nothing_else() {
    type Edit = fn(&mut Document);
    let many_bones: Edit = |document| {
        for _ in 3..97 {
            document.bone_offsets.push(document.bone_offsets[2]);
            document.bone_parents.push(0);
            document.clips[0].bones.push(track([key(0.0, [0.0; 3])]));
        }
    };
    let edits: [(&str, Edit); 16] = [
        ("many-bones", many_bones),
        ("many-vertices", |document| {
            document.vertices.resize(65_537, document.vertices[0]);
        }),
        ("book-roots", |document| document.bone_parents[2] = -1),
        ("bones-reordered", |document| document.bone_parents[1] = 2),
        ("book-fourth-weight", |document| {
            document.vertices[3].blend_weights = [0.5, 0.25, 0.0, 0.0];
        }),
        ("book-clip-name", |document| document.clips[0].name = "Walk".into()),
        ("duplicate-clip-name", |document| {
            document.clips.push(document.clips[0].clone());
        }),
        ("keys-not-sorted", |document| {
            document.clips[0].bones[1].keyframes.reverse();
        }),
        ("rotation-not-unit", |document| {
            document.clips[0].bones[1].keyframes[0].rotation = [0.0, 0.0, 0.0, 2.0];
        }),
        ("book-alpha-clip", |document| document.materials[0].alpha_clip = true),
        ("book-size", |document| {
            for vertex in &mut document.vertices {
                vertex.position = vertex.position.map(|place| place / 72.0);
            }
        }),
        ("book-tangent-sign", |document| document.vertices[0].tangent[3] = 1.0),
        ("book-map-format", |document| {
            document.materials[0].diffuse_map = Some("skin.png".into());
        }),
        ("book-many-materials", |document| with_materials(document, 22)),
        ("book-material-name", |document| {
            document.materials[0].name = "mirror0".into();
        }),
        ("duplicate-material-name", |document| {
            with_materials(document, 2);
            document.materials[1].name = document.materials[0].name.clone();
        }),
    ];
    for (code, edit) in edits {
        let mut document = for_demo();
        edit(&mut document);
        let verdict = verdict_of(Book::D3d12, &document);
        let codes = codes_of(&verdict);
        assert_eq!(codes, [code]);
        assert!(is_sentence(&verdict.limits[0].message), "{}", verdict.limits[0].message);
        assert!(verdict.reads(), "{code}: {:?}", verdict.trouble);
        let outcome = match code {
            "many-bones" | "book-clip-name" => Outcome::Crashes,
            "book-map-format" => Outcome::EndsWithError,
            // Nobody looked for the two that it names.
            _ => Outcome::Shows { missing_maps: 2 },
        };
        assert_eq!(verdict.outcome, outcome, "{code}: {}", verdict.shows);
        assert_eq!(verdict.ends, !verdict.is_shown(), "{code}: {}", verdict.shows);
    }
}

#[test]
fn bones_above_a_byte_are_found_where_they_have_weight() {
    let mut document = for_demo();
    for _ in 3..300 {
        document.bone_offsets.push(document.bone_offsets[2]);
        document.bone_parents.push(0);
        document.clips[0].bones.push(track([key(0.0, [0.0; 3])]));
    }
    document.vertices[0].blend_indices = [0, 1, 299, 299];
    assert_eq!(codes(&document), ["many-bones"]);
    document.vertices[0].blend_weights = [0.25, 0.25, 0.25, 0.25];
    assert_eq!(codes(&document), ["many-bones", "bone-index-above-byte"]);
}

/// What is known beside the file decides these.
#[test]
fn handedness_and_missing_maps_are_limits_where_they_are_known() {
    let document = for_demo();
    let text = write(&document);
    let missing = ["skin_norm.dds".to_owned()];
    let known = Known {
        document: Some(&document),
        handedness: Some(Handedness::Left),
        missing_maps: Some(&missing),
        ..Known::default()
    };
    let verdict = verdict(Book::D3d12, text.as_bytes(), &known);
    assert_eq!(codes_of(&verdict), ["book-handedness", "map-missing"]);
}

/// The D3D11 book opens more kinds of pictures, and reads the sign of tangents.
#[test]
fn limits_are_those_of_the_book() {
    let mut document = for_demo();
    for material in &mut document.materials {
        material.reflectance = Reflectance::Phong {
            ambient: [0.5; 3],
            specular: [0.5; 3],
            spec_power: 16.0,
            reflectivity: [0.0; 3],
        };
        material.name.clear();
        material.diffuse_map = Some("skin.png".into());
    }
    document.dialect = Dialect::D3d11;
    document.vertices[0].tangent[3] = 1.0;
    let verdict = verdict_of(Book::D3d11, &document);
    assert!(verdict.reads() && verdict.limits.is_empty(), "{verdict:?}");
}

/// How the demo ends when bones have no keys: at the first of them.
#[test]
fn a_bone_without_keys_crashes_the_demo() {
    let mut document = for_demo();
    document.clips[0].bones[1].keyframes.clear();
    let verdict = verdict_of(Book::D3d12, &document);
    assert!(verdict.reads());
    assert_shows(
        &verdict,
        "It crashes at its first frame: bone 1 has no keys in \"Take1\".",
    );
}

/// A file that ends in its last keys, at every byte: nothing panics, and what is shown fits what was read.
#[test]
fn a_cut_file_is_judged_at_every_byte() {
    let text = write(&for_demo());
    for end in 0..text.len() {
        let verdict = verdict(Book::D3d12, &text.as_bytes()[..end], &Known::default());
        let is_whole = verdict.shows == "The model in \"Take1\".";
        assert_eq!(verdict.reads(), is_whole, "{end}: {verdict:?}");
    }
}

/// Vertices that are taken over are those that it reads itself, and what comes after them is read at the same place.
/// A text with each of its lines written in another way, one at a time.
fn with_an_odd_line(text: &str) -> Vec<Vec<u8>> {
    let odd = |line: &str| {
        let (first, rest) = line.split_once(' ').unwrap_or((line, ""));
        [
            format!("\n{line}"),
            format!("{line}\n \n"),
            format!("{first}  {rest} "),
            format!("{first}\t{rest}\r"),
            format!("{first} +{rest}"),
            format!("{line} 7"),
            format!("{first}\n{rest}"),
            String::new(),
        ]
    };
    let lines: Vec<&str> = text.lines().collect();
    let with = |(index, line): (usize, &&str)| {
        odd(line).map(|odd| {
            let mut lines = lines.clone();
            lines[index] = &odd;
            lines.join("\n").into_bytes()
        })
    };
    lines.iter().enumerate().flat_map(with).collect()
}

/// Puts the rows that a reading passed over where another one has them.
fn with_what_was_passed(reading: &mut Document, other: &Document, meant: &Document) {
    if reading.vertices.is_empty() && !other.vertices.is_empty() {
        reading.vertices.clone_from(&meant.vertices);
    }
    if reading.triangles.is_empty() && !other.triangles.is_empty() {
        reading.triangles.clone_from(&meant.triangles);
    }
    for (clip, meant) in reading.clips.iter_mut().zip(&meant.clips) {
        for (bone, meant) in clip.bones.iter_mut().zip(&meant.bones) {
            if bone.keyframes.len() == 1 && bone.keyframes[..] == meant.keyframes[..1] {
                bone.keyframes.clone_from(&meant.keyframes);
            }
        }
    }
}

#[test]
fn a_loader_makes_the_same_of_a_file_whose_rows_are_known() {
    let own = ["good", "bad"]
        .into_iter()
        .flat_map(fixtures)
        .map(|fixture| fixture.bytes);
    let real = REAL_FILES
        .iter()
        .filter_map(|name| shared_bytes(&format!("models/{name}.m3d")));
    let files = own.chain(real).chain(with_an_odd_line(&write(&arm())));
    let mut taken_over = 0;
    for bytes in files.chain([write(&arm()).into_bytes(), write(&quad()).into_bytes()]) {
        let Ok(parsed) = parse(&bytes) else { continue };
        let plain = Known {
            document: Some(&parsed.document),
            ..Known::default()
        };
        let known = Known {
            quick: Some(&parsed.quick),
            ..plain
        };
        taken_over += usize::from(parsed.quick.are_all());
        for book in Book::ALL {
            let plain = read(book, &bytes, &plain);
            let mut known = read(book, &bytes, &known);
            with_what_was_passed(&mut known.document, &plain.document, &parsed.document);
            assert!(format!("{plain:?}") == format!("{known:?}"), "{}", book.name());
        }
    }
    assert!(taken_over >= 2, "{taken_over} files have rows that are known");
}
