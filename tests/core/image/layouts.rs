//! Every layout of texels, by its description and its values.

use bindpose::image::{Channels, decode};

use super::blocks;
use super::dds::{Dds, every_layout};
use super::texels;

#[test]
fn every_layout_decodes_to_the_values_computed_by_hand() {
    for fixture in every_layout() {
        let image = decode(&fixture.bytes, "map.dds").unwrap_or_else(|error| panic!("{}: {error}", fixture.name));
        assert_eq!(image.description(), fixture.description);
        assert_eq!(image.channels(), fixture.channels, "{}", fixture.name);
        let texels = texels(&image);
        assert_eq!(texels.len(), 16);
        // All rows are the same.
        for row in texels.chunks(4) {
            assert_eq!(row, &fixture.first[..4], "{}", fixture.description);
        }
    }
}

#[test]
fn the_alpha_mode_of_a_header_is_heeded() {
    let with_mode = |mode| {
        let mut dds = Dds::dxgi(77, 4, 4);
        dds.dx10 = Some([77, 3, 0, 1, mode]);
        decode(&dds.file(&blocks::bc3()), "map.dds").expect("the file is sound")
    };
    // Unknown, straight, custom.
    for mode in [0, 1, 4] {
        assert_eq!(texels(&with_mode(mode))[..4], blocks::BC3_ROW);
    }
    assert_eq!(texels(&with_mode(2))[..4], blocks::BC3_STRAIGHT_ROW);
    let opaque = with_mode(3);
    assert_eq!(opaque.channels(), Channels::Rgb);
    assert!(texels(&opaque).iter().all(|texel| texel[3] == 255));
}

#[test]
fn channels_count_what_carries_data() {
    for (channels, count, has_alpha) in [
        (Channels::Grey, 1, false),
        (Channels::Alpha, 1, true),
        (Channels::GreyAlpha, 2, true),
        (Channels::RedGreen, 2, false),
        (Channels::Rgb, 3, false),
        (Channels::Rgba, 4, true),
    ] {
        assert_eq!((channels.count(), channels.has_alpha()), (count, has_alpha));
    }
}

#[test]
fn holes_in_what_a_block_has_over_the_edge_do_not_count() {
    // The fourth column is the one with holes.
    for (width, channels) in [(3, Channels::Rgb), (4, Channels::Rgba)] {
        let image = decode(&Dds::four_cc(b"DXT1", width, 1).file(&blocks::BC1_HOLES), "map.dds").expect("it is sound");
        assert_eq!(image.channels(), channels);
    }
    // Nor do those below.
    let mut lower_row = blocks::BC1_HOLES;
    lower_row[4..7].fill(0);
    for (height, channels) in [(3, Channels::Rgb), (4, Channels::Rgba)] {
        let image = decode(&Dds::four_cc(b"DXT1", 4, height).file(&lower_row), "map.dds").expect("it is sound");
        assert_eq!(image.channels(), channels);
    }
}
