//! Excerpts are safe to print, and their mark stands under what is meant.

use bindpose::diagnostic::Position;
use bindpose::format::{Excerpt, LineIndex, excerpt};

fn at(line: u32, column: u32) -> Position {
    Position { line, column }
}

/// The characters under the mark.
fn marked(excerpt: &Excerpt) -> String {
    let (_, line) = excerpt.lines.last().expect("there is always a line");
    line.chars()
        .skip(excerpt.mark_column as usize - 1)
        .take(excerpt.mark_length as usize)
        .collect()
}

#[test]
fn the_mark_stands_under_the_token() {
    let text = b"BlendWeights: 0.7470379 0.2529621 0 0\nBlendIndices: 7 9 5x 0\nrest\n";
    let shown = excerpt(text, at(2, 19), 2);
    let lines = vec![
        (1, "BlendWeights: 0.7470379 0.2529621 0 0".into()),
        (2, "BlendIndices: 7 9 5x 0".into()),
    ];
    assert_eq!(
        shown,
        Excerpt {
            lines,
            in_hex: false,
            mark_column: 19,
            mark_length: 2
        }
    );
    assert_eq!(marked(&shown), "5x");
}

#[test]
fn tabs_keep_the_mark_aligned() {
    let shown = excerpt(b"\tTime:\t0 Pos: x", at(1, 15), 1);
    assert_eq!(shown.lines, [(1, "    Time:   0 Pos: x".into())]);
    assert_eq!(marked(&shown), "x");
}

#[test]
fn line_ends_of_every_kind_part_lines() {
    let shown = excerpt(b"\xEF\xBB\xBFone\r\ntwo\rthree", at(3, 1), 5);
    assert_eq!(shown.lines, [(2, "two".into()), (3, "three".into())]);
    assert_eq!(marked(&shown), "three");
    assert_eq!(marked(&excerpt(b"\xEF\xBB\xBFone\r\n", at(1, 1), 3)), "one");
}

#[test]
fn control_bytes_and_broken_text_are_replaced() {
    let shown = excerpt(b"h\xC3\xA4ut \x1B[31m \xFF \xE2\x80\xAE q\x07x", at(1, 19), 1);
    assert_eq!(
        shown.lines,
        [(1, "häut \u{FFFD}[31m \u{FFFD} \u{FFFD} q\u{FFFD}x".into())]
    );
    assert_eq!(marked(&shown), "q");
}

#[test]
fn what_is_no_text_is_shown_byte_by_byte() {
    let png = b"\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR\0\0\x02\0\0\0";
    let first = "89 50 4e 47 0d 0a 1a 0a 00 00 00 0d 49 48 44 52  .PNG........IHDR";
    let shown = excerpt(png, at(1, 1), 0);
    assert_eq!(shown.lines, [(0, first.to_owned())]);
    assert_eq!((shown.in_hex, marked(&shown).as_str()), (true, "89"));
    assert_eq!(shown.to_string(), format!("00 | {first}\n   | ^^\n"));
    // Of the four lines that these bytes would be, the second begins behind \r\n, the last behind the \r of a length.
    assert_eq!(marked(&excerpt(png, at(2, 1), 1)), "1a");
    let shown = excerpt(png, at(4, 6), 3);
    let second = "00 00 02 00 00 00".to_owned() + &" ".repeat(32) + "......";
    assert_eq!(shown.lines, [(0, first.to_owned()), (16, second)]);
    assert_eq!(marked(&shown), "00 02 00");
    assert_eq!(shown.to_string().lines().nth(1).map(|line| &line[..7]), Some("10 | 00"));
    // The mark ends with the row, and a place behind the end is at the end.
    assert_eq!(marked(&excerpt(png, at(3, 1), 99)), "00 00 00 0d 49 48 44 52");
    assert_eq!(excerpt(png, at(9, 99), 1).mark_column, 6 * 3 + 1);
    assert_eq!(excerpt(b"\0", at(1, 1), 7).lines, [(0, "00  .".to_owned())]);
    // A NUL far behind the beginning of a text is a slip of that line.
    let mut text = b"1 2\n".repeat(300);
    text.extend(b"3\x004\n");
    assert_eq!(
        excerpt(&text, at(301, 1), 1).lines.last(),
        Some(&(301, "3\u{FFFD}4".to_owned()))
    );
}

#[test]
fn of_long_lines_the_part_around_the_mark_is_shown() {
    let mut text = vec![b'a'; 100_000];
    text[50_000..50_003].copy_from_slice(b"BAD");
    let shown = excerpt(&text, at(1, 50_001), 3);
    assert_eq!(marked(&shown), "BAD");
    let (_, line) = &shown.lines[0];
    assert!(
        line.len() < 200 && line.starts_with('…') && line.ends_with('…'),
        "{line}"
    );
    // What is marked may itself be long.
    let shown = excerpt(&text, at(1, 1), 100_000);
    assert!(shown.mark_length < 200);
}

#[test]
fn places_outside_give_the_nearest_line() {
    assert_eq!(
        excerpt(b"", at(1, 1), 0),
        Excerpt {
            lines: vec![(1, String::new())],
            in_hex: false,
            mark_column: 1,
            mark_length: 1
        }
    );
    assert_eq!(
        excerpt(b"one\ntwo", at(9, 9), 4).lines,
        [(1, "one".into()), (2, "two".into())]
    );
    assert_eq!(excerpt(b"one\ntwo", at(2, 4), 0).mark_column, 4);
    assert_eq!(excerpt(b"one", at(u32::MAX, u32::MAX), u32::MAX).lines.len(), 1);
}

#[test]
fn of_a_whole_row_its_first_word_is_marked() {
    // Columns of tabs are four wide.
    assert_eq!(excerpt(b"{\n\t  Bone1\n", at(2, 1), 0).mark_column, 7);
    assert_eq!(excerpt(b"{\n\t  Bone1\n", at(2, 1), 1).mark_column, 1);
    assert_eq!(excerpt(b"a b", at(1, 2), 0).mark_column, 2);
    assert_eq!(excerpt(b"  \n", at(1, 1), 0).mark_column, 1);
}

#[test]
fn an_index_shows_what_reading_from_the_start_shows() {
    let ends = ["\n", "\r\n", "\r"];
    for mark in ["", "\u{FEFF}"] {
        for count in [0_usize, 1, 2, 255, 256, 257, 258, 511, 512, 513, 700] {
            let lines = (0..count).map(|line| format!("line {line}{}", ends[line % 3]));
            let text = format!("{mark}{}", lines.collect::<String>());
            let index = LineIndex::new(text.as_bytes());
            for line in (0..=count as u32 + 2).chain([u32::MAX]) {
                let expected = excerpt(text.as_bytes(), at(line, 3), 2);
                assert_eq!(index.excerpt(at(line, 3), 2), expected, "line {line} of {count}");
            }
        }
    }
}

/// Reading from the start for each of them would be 50 000 times 4 MB.
#[test]
fn excerpts_of_a_long_file_do_not_read_it_again() {
    let text = "0 1 2\n".repeat(700_000);
    let index = LineIndex::new(text.as_bytes());
    for line in 650_000..700_000 {
        assert_eq!(index.excerpt(at(line, 3), 1).lines[1].0, line);
    }
}
