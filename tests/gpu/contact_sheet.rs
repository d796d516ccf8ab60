//! Many pictures on one: this needs no GPU.

mod label;
mod layout;

use bindpose::contact_sheet::ContactSheet;
use bindpose::contact_sheet::for_tests::{Layout, blend};
use bindpose::scene::Theme;

const SIZE: [u32; 2] = [400, 300];

fn sheet(transparent: bool) -> ContactSheet {
    ContactSheet::new(SIZE, [2, 2], Theme::Dark, transparent).expect("has room")
}

/// A sheet as its file has it.
struct Written {
    layout: Layout,
    pixels: Vec<u8>,
}

fn written(sheet: ContactSheet, size: [u32; 2], cells: [u32; 2]) -> Written {
    let file = sheet.into_png().expect("it is encoded");
    let read = image::load_from_memory(&file).expect("it is a picture");
    assert_eq!(
        [read.width(), read.height()],
        size,
        "the file has the size of the sheet"
    );
    Written {
        layout: Layout::new(size, cells).expect("has room"),
        pixels: read.into_rgba8().into_raw(),
    }
}

fn red(size: [u32; 2]) -> Vec<u8> {
    [255, 0, 0, 255].repeat((size[0] * size[1]) as usize)
}

/// Pixels below `from` rows of the sheet that are as bright as text.
fn bright(sheet: &Written, columns: std::ops::Range<u32>, rows: std::ops::Range<u32>) -> usize {
    let at = |x, y| &sheet.pixels[sheet.layout.pixel_index([x, y]) * 4..];
    let pixels = rows.flat_map(|y| columns.clone().map(move |x| (x, y)));
    pixels.filter(|&(x, y)| at(x, y)[2] > 100).count()
}

#[test]
fn a_picture_fills_its_place_and_its_label_stands_under_it() {
    let mut sheet = sheet(false);
    let caption = ["0.500 s", "frame 15"].map(str::to_owned);
    sheet.place(3, &red(sheet.cell_size()), caption.to_vec());
    let sheet = written(sheet, SIZE, [2, 2]);
    let (picture, label) = sheet.layout.places(3).expect("the last of four");
    let reds = sheet.pixels.chunks_exact(4).filter(|pixel| pixel[..3] == [255, 0, 0]);
    assert_eq!(reds.count() as u32, picture.size[0] * picture.size[1]);
    let ([left, top], [width, height]) = (label.at, label.size);
    assert_eq!(top, picture.at[1] + picture.size[1]);
    let middle = left + width / 2;
    assert!(bright(&sheet, left..middle, top..top + height) > 30, "the time");
    assert!(
        bright(&sheet, middle..left + width, top..top + height) > 30,
        "the frame"
    );
    assert_eq!(bright(&sheet, 0..SIZE[0], 0..picture.at[1]), 0, "nothing else");
}

#[test]
fn labels_without_room_lose_their_last_parts_together() {
    let captions = [&["0.500 s", "frame 1"][..], &["0.500 s", "frame 1", "a turn"]];
    let captions = captions.map(|parts| parts.iter().map(|&part| part.to_owned()).collect::<Vec<_>>());
    // How many pixels of text are in the right half of each label, and in all of it.
    let written = |size: [u32; 2]| {
        let mut sheet = ContactSheet::new(size, [2, 1], Theme::Dark, false).expect("has room");
        let black = vec![0; red(sheet.cell_size()).len()];
        for (index, caption) in captions.iter().enumerate() {
            sheet.place(index, &black, caption.clone());
        }
        let sheet = written(sheet, size, [2, 1]);
        [0, 1].map(|index| {
            let (_, label) = sheet.layout.places(index).expect("is there");
            let ([left, top], [width, height]) = (label.at, label.size);
            let count = |columns| bright(&sheet, columns, top..top + height);
            [count(left + width / 2..left + width), count(left..left + width)]
        })
    };
    let [one, other] = written([400, 150]);
    assert!(other[0] > one[0], "room for all: {one:?} {other:?}");
    let [one, other] = written([220, 100]);
    assert!(one[0] > 0 && one == other, "without the turn: {one:?} {other:?}");
    let [one, other] = written([120, 100]);
    assert!(one[0] < one[1] && one == other, "the time alone: {one:?} {other:?}");
    assert_eq!(written([60, 100]), [[0, 0]; 2], "nothing");
}

/// Labels are read on a dark page and on a light one: they bring their ground, and text does not touch its ends.
#[test]
fn without_ground_there_is_nothing_but_pictures_and_labels_on_theirs() {
    let empty = written(sheet(true), SIZE, [2, 2]);
    assert!(empty.pixels.chunks_exact(4).all(|pixel| pixel[3] == 0));
    let mut sheet = sheet(true);
    let nothing = vec![0; red(sheet.cell_size()).len()];
    sheet.place(0, &nothing, ["1.000 s", "frame 30"].map(str::to_owned).to_vec());
    let sheet = written(sheet, SIZE, [2, 2]);
    let (_, label) = sheet.layout.places(0).expect("is there");
    let opaque = sheet.pixels.chunks_exact(4).filter(|pixel| pixel[3] == 255);
    assert_eq!(opaque.count() as u32, label.size[0] * label.size[1]);
    let ([left, top], right) = (label.at, label.at[0] + label.size[0]);
    let text = |columns| bright(&sheet, columns, top..top + label.size[1]);
    assert!(text(left..right) > 60 && text(left..left + 3) == 0 && text(right - 3..right) == 0);
}

#[test]
fn ink_covers_what_is_under_it() {
    for (under, covered, expected) in [
        ([0, 0, 0, 255], 255, [200, 100, 0, 255]),
        ([0, 0, 0, 255], 0, [0, 0, 0, 255]),
        ([100, 100, 100, 255], 128, [150, 100, 50, 255]),
        ([9, 9, 9, 0], 128, [200, 100, 0, 128]),
        ([9, 9, 9, 0], 0, [9, 9, 9, 0]),
    ] {
        let mut pixel = under;
        blend(&mut pixel, [200, 100, 0], covered);
        assert_eq!(pixel, expected, "{under:?} {covered}");
    }
}
