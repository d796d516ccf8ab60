//! Output whose reader leaves.

use std::io::{self, ErrorKind, Write};

use bindpose::cli::for_tests::UntilClosed;

/// Takes some writes, then fails in one way.
struct Failing {
    writes_left: usize,
    then: ErrorKind,
}

impl Write for Failing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.writes_left.checked_sub(1) {
            Some(left) => {
                self.writes_left = left;
                Ok(bytes.len())
            }
            None => Err(self.then.into()),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_reader_that_left_is_no_failure_and_a_full_disk_is() {
    let mut left = UntilClosed::new(Failing {
        writes_left: 1,
        then: ErrorKind::BrokenPipe,
    });
    for _ in 0..3 {
        assert!(left.write_all(b"line\n").is_ok());
    }
    assert!(left.flush().is_ok());

    let mut full = UntilClosed::new(Failing {
        writes_left: 1,
        then: ErrorKind::StorageFull,
    });
    assert!(full.write_all(b"line\n").is_ok());
    assert_eq!(
        full.write_all(b"line\n").map_err(|error| error.kind()),
        Err(ErrorKind::StorageFull)
    );
}
