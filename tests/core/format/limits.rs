//! What a header claims decides nothing, and large odd files take time in proportion.

use bindpose::format::{Parsed, parse};

use super::good;

/// Rows of this many bytes in memory for each byte of the file, at most: a keyframe of 44 bytes takes 30 bytes of text,
/// a triangle with its line 16 of 6, a material some 200 of 24.
const BYTES_PER_BYTE: usize = 10;

#[test]
fn a_claim_of_four_billion_rows_is_an_error() {
    let text = String::from_utf8(good("d3d12_skinned")).expect("the fixture is text");
    for (count, claim) in [
        ("#Materials 1", "#Materials 4294967295"),
        ("#Vertices 3", "#Vertices 4294967295"),
        ("#Triangles 1", "#Triangles 4294967295"),
        ("#Bones 2", "#Bones 4294967295"),
        ("#AnimationClips 1", "#AnimationClips 4294967295"),
        ("#Keyframes: 2", "#Keyframes: 4294967295"),
        ("#Vertices 3", "#Vertices 4294967296"),
    ] {
        let changed = text.replace(count, claim);
        assert_ne!(changed, text);
        // With room for so many rows this would not end, or end the process.
        assert!(parse(changed.as_bytes()).is_err(), "{claim}");
    }
}

/// Files without rows for the claim that reach their end: the room that was made must not follow the claim.
#[test]
fn room_follows_the_bytes() {
    for name in ["d3d12_skinned", "d3d11_static", "imm_skinned"] {
        let bytes = good(name);
        let parsed = parse(&bytes).expect("good fixtures can be read");
        assert!(
            room(&parsed) <= BYTES_PER_BYTE * bytes.len(),
            "{name}: {} for {}",
            room(&parsed),
            bytes.len()
        );
    }
    // The smallest rows that can be read.
    let mut text =
        String::from("***Header***\n#Materials 0\n#Vertices 1\n#Triangles 5000\n#Bones 0\n#AnimationClips 0\n");
    text += "***Materials***\n***SubsetTable***\n***Vertices***\nP:0 0 0\nT:0 0 0\nN:0 0 0\nT:0 0\n***Triangles***\n";
    text += &"0 0 0\n".repeat(5000);
    let parsed = parse(text.as_bytes()).expect("it is sound");
    assert!(room(&parsed) <= BYTES_PER_BYTE * text.len());
}

fn room(parsed: &Parsed) -> usize {
    fn of<T>(list: &Vec<T>) -> usize {
        list.capacity() * size_of::<T>()
    }
    let document = &parsed.document;
    let clips = document
        .clips
        .iter()
        .flat_map(|clip| &clip.bones)
        .map(|bone| of(&bone.keyframes))
        .sum::<usize>();
    let bones = document.clips.iter().map(|clip| of(&clip.bones)).sum::<usize>();
    let lists = of(&document.materials) + of(&document.subsets) + of(&document.vertices) + of(&document.triangles);
    let skeleton = of(&document.bone_offsets) + of(&document.bone_parents) + of(&document.clips);
    let lines = of(&parsed.lines.vertices) + of(&parsed.lines.triangles) + of(&parsed.lines.materials);
    lists + skeleton + lines + bones + clips
}

/// Each of these is some megabytes. Work that grew with the square of the size would take hours, so that they end at all
/// within the test is the check.
#[test]
fn large_odd_files_end() {
    const SIZE: usize = 2_000_000;
    let text = String::from_utf8(good("d3d12_skinned")).expect("the fixture is text");
    for odd in [
        "\n", " ", "\r", "x", "9", "{", "}", "} ", "***\n", "---", "*x\n", "a:", "a: ", "Name:\n", "Name", "1 ",
        "0 0 0 ", "\u{1}", "#", "# ",
    ] {
        let flood = odd.repeat(SIZE / odd.len());
        assert!(parse(flood.as_bytes()).is_err());
        let places = [
            "#Vertices",
            "Name: skin",
            "SubsetID",
            "Tangent",
            "0 1 2\n",
            "BoneOffset1",
            "ParentIndexOfBone1",
            "\tBone1",
            "Time: 0.5",
            "\t}",
        ];
        for place in places {
            let at = text.find(place).expect("the place is in the fixture");
            // An answer, whichever.
            let _ = parse([&text[..at], &flood, "\n", &text[at..]].concat().as_bytes());
        }
    }
}

/// Every line of this file has its own unknown label; the list of notices stays short and still tells of them all.
#[test]
fn notices_do_not_flood() {
    let text = String::from_utf8(good("d3d12_skinned")).expect("the fixture is text");
    let unknown: String = (0..5000).map(|index| format!("Extra{index}: 1\n")).collect();
    let flooded = text.replace("Roughness:", &format!("{unknown}Roughness:"));
    let parsed = parse(flooded.as_bytes()).expect("unknown lines are left out");
    assert!(
        (10..60).contains(&parsed.diagnostics.len()),
        "{}",
        parsed.diagnostics.len()
    );
    let rest = parsed
        .diagnostics
        .iter()
        .any(|notice| notice.message.contains("lines \"…\""));
    assert!(rest, "{:?}", parsed.diagnostics.last());
}
