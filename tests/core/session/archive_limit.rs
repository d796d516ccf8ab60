//! How much an archive may unpack to.

use std::io::{Cursor, Write as _};

use bindpose::session::for_tests::unpack_within;
use bindpose::slices::{Slices, at_once};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

#[test]
fn a_few_bytes_that_become_very_many_are_not_all_unpacked() {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for name in ["a.dds", "b.dds", "c.dds"] {
        let started = writer.start_file(name, SimpleFileOptions::default());
        started.expect("a file");
        writer.write_all(&vec![0; 1 << 20]).expect("zeros");
    }
    let bytes = writer.finish().expect("an archive").into_inner();
    assert!(bytes.len() < 1 << 14);
    assert_eq!(
        at_once(unpack_within(&bytes, 3 << 20, &Slices::ENDLESS)).map(|files| files.len()),
        Ok(3)
    );
    assert_eq!(
        at_once(unpack_within(&bytes, (3 << 20) - 1, &Slices::ENDLESS)).map(|files| files.len()),
        Err("its files have more than 2 MiB together".to_owned())
    );
}
