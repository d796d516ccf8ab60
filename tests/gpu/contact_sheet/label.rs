//! Words in pixels.

use bindpose::contact_sheet::for_tests::Labels;

#[test]
fn digits_are_equally_wide_and_words_as_wide_as_their_letters() {
    let labels = Labels::new(20.0);
    let width = |text| labels.width(text);
    assert!(width("0") > 5.0 && width("0") < 20.0, "{}", width("0"));
    for digits in ["1", "7", "8"] {
        assert_eq!(width(digits), width("0"), "{digits}");
    }
    assert!((width("frame 0") - width("frame") - width(" ") - width("0")).abs() < 1e-3);
    assert!(width("·") > 0.0 && width("°") > 0.0, "the font has what captions need");
}

#[test]
fn a_text_covers_pixels_from_where_it_begins_to_its_width() {
    let labels = Labels::new(20.0);
    let (left, size) = (10.0, [100, 30]);
    let coverage = labels.coverage("0.5 s", left, size);
    assert_eq!(coverage.len(), 3000);
    let inked = |column: usize| (0..30).any(|row| coverage[row * 100 + column] > 0);
    let columns: Vec<usize> = (0..100).filter(|&column| inked(column)).collect();
    let (first, last) = (columns[0] as f32, columns[columns.len() - 1] as f32);
    assert!(first >= left && first < left + 4.0, "{first}");
    assert!(
        last <= left + labels.width("0.5 s") && last > left + labels.width("0.5"),
        "{last}"
    );
    assert!(coverage.contains(&255), "stems are solid");
    // In the middle of the height, give or take the rounding to a whole pixel.
    let rows: Vec<usize> = (0..30)
        .filter(|row| coverage[row * 100..][..100].iter().any(|&c| c > 128))
        .collect();
    let middle = (rows[0] + rows[rows.len() - 1] + 1) as f32 / 2.0;
    assert!((middle - 15.0).abs() <= 1.0, "{middle}");
    assert_eq!(coverage, labels.coverage("0.5 s", left, size), "the same every time");
}
