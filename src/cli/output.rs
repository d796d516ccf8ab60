//! Standard output whose reader may leave early.

use std::io::{self, ErrorKind, Write};

/// Writes until the reader closes its end, and drops the rest. The command runs to its end, so that the exit code of
/// `bindpose check … | head` is the same as without `head`.
#[derive(Debug)]
pub(super) struct UntilClosed<W> {
    inner: W,
    closed: bool,
}

impl<W: Write> UntilClosed<W> {
    pub(super) fn new(inner: W) -> Self {
        Self { inner, closed: false }
    }

    /// The inner writer's result, or `swallowed` once the reader is gone.
    fn unless_closed<T>(&mut self, swallowed: T, write: impl FnOnce(&mut W) -> io::Result<T>) -> io::Result<T> {
        if self.closed {
            return Ok(swallowed);
        }
        match write(&mut self.inner) {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => {
                self.closed = true;
                Ok(swallowed)
            }
            result => result,
        }
    }
}

impl<W: Write> Write for UntilClosed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.unless_closed(bytes.len(), |inner| inner.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.unless_closed((), Write::flush)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert!(left.closed && left.flush().is_ok());

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
}
