//! Numbers are read exactly as `str::parse` reads them.

use bindpose::format::parse;
use proptest::prelude::*;

/// Texts at the edges: halfway between two `f32`, the smallest and largest, many digits, odd but common spellings.
const EDGES: [&str; 3] = [
    "0 -0 0.0 -0.0 00 007 1 -1 +1 1. .5 -.5 1e0 1E5 1e+5 1e-5 1e005 0e99 0.0e-99 4.884964E-07 8.4e-23 8.412415E-23 \
     1e-7 5.7701E-08 16777216 16777217 16777218 16777219 33554433 0.1 0.2 0.3 0.7071068 3.4028235e38 3.4028234e38 \
     340282346638528859811704183484516925440 1.17549435e-38 1.1754943e-38 1.1754942e-38 1e-45 1.4e-45 7.1e-46 \
     7.006492321624085e-46 7.006492321624086e-46 0.000000000000000000000000000000000000011754943508222875 \
     123456789012345678 1234567890123456789 12345678901234567890 99999999999999999999 0.123456789012345678 \
     0.1234567890123456789 1.00000017881393421514957253748434595763683319091796875 1.00000017881393432617187499 \
     1.00000017881393432617187500 1.00000017881393432617187501 8388608.5 8388609.5 0.50000002980232239 \
     0.5000000298023224 2.9802322387695312e-8 99999999 9999999.5 12345678.12345678 1.0000000596046448 1e20 1e21 1e-37 \
     1e-38",
    // As exporters write them.
    "67.88861 -0.9983482 0.05002538 0.0001278553 -1.331581E-06 8.412415e-23 13748 100.25 -123.456789",
    // What the quick path turns away.
    "12345678 1e99 1e-99 16777217.0 1.00000000000001",
];

#[test]
fn the_edges_are_exact() {
    let texts = EDGES.iter().flat_map(|texts| texts.split(' '));
    assert_exact(texts.map(str::to_owned).collect());
}

#[test]
fn halfway_points_and_their_neighbours_are_exact() {
    let mut texts = Vec::new();
    let mut bits = 0x0080_0000_u32;
    while bits < 0x7F00_0000 {
        let middle = (f64::from(f32::from_bits(bits)) + f64::from(f32::from_bits(bits + 1))) / 2.0;
        for text in [
            format!("{middle:e}"),
            format!("{:e}", middle.next_up()),
            format!("{:e}", middle.next_down()),
        ] {
            texts.push(text);
        }
        // 17 digits reach the quick path, and cannot tell a halfway point from what is beside it.
        texts.push(format!("{middle:.16e}"));
        texts.push(format!("{middle:.8e}"));
        bits += 0x0001_0F0F;
    }
    assert_exact(texts);
}

proptest! {
    #![proptest_config(crate::properties::cases(64))]

    #[test]
    fn random_floats_are_exact_in_every_spelling(all in prop::collection::vec(any::<u32>(), 300)) {
        let finite = all.into_iter().map(f32::from_bits).filter(|float| float.is_finite());
        assert_exact(finite.flat_map(|float| [
            format!("{float}"), format!("{float:e}"), format!("{float:E}"), format!("{float:.7}"), format!("{float:.9e}"), format!("{float:.3}"),
        ]).collect());
    }

    #[test]
    fn random_decimals_are_exact(texts in prop::collection::vec("-?[0-9]{1,9}(\\.[0-9]{0,11})?([eE][+-]?[0-9]{1,2})?", 300)) {
        assert_exact(texts);
    }

    #[test]
    fn decimals_of_exporters_are_exact(texts in prop::collection::vec("-?[0-9]{1,3}\\.[0-9]{5,9}", 300)) {
        assert_exact(texts);
    }
}

#[test]
fn what_is_no_number_is_not_read_as_one() {
    for text in [
        "", "-", "1x", "1x.5", "1.5x", "1.5.5", "1e", "1e+", "1.5f", "1,5", "nan", "--1", "- 1",
    ] {
        let file = file_of(&[text, "0", "0"].map(str::to_owned));
        let told = parse(file.as_bytes()).map_or(1, |parsed| parsed.diagnostics.len());
        assert!(told > 0, "{text:?}");
    }
}

/// Puts the texts into the positions of a file. What `str::parse` takes for infinite must come back replaced.
fn assert_exact(mut texts: Vec<String>) {
    while !texts.len().is_multiple_of(3) {
        texts.push("0".into());
    }
    let file = file_of(&texts);
    let parsed = parse(file.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{file}"));
    let read = parsed.document.vertices.iter().flat_map(|vertex| vertex.position);
    for (text, read) in texts.iter().zip(read) {
        let expected = text.parse::<f32>().expect("the texts are numbers");
        let expected = if expected.is_finite() { expected } else { 0.0 };
        assert_eq!(
            read.to_bits(),
            expected.to_bits(),
            "{text}: {read} instead of {expected}"
        );
    }
}

fn file_of(texts: &[String]) -> String {
    let mut file = String::from("***Header***\n#Materials 0\n");
    file += &format!(
        "#Vertices {}\n#Triangles 0\n#Bones 0\n#AnimationClips 0\n",
        texts.len() / 3
    );
    file += "***Materials***\n***SubsetTable***\n***Vertices***\n";
    for row in texts.chunks(3) {
        file += &format!(
            "Position: {}\nTangent: 1 0 0 1\nNormal: 0 0 1\nTex-Coords: 0 0\n\n",
            row.join(" ")
        );
    }
    file += "***Triangles***\n";
    file
}
