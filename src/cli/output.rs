//! Standard output whose reader may leave early.

use std::io::{self, ErrorKind, Write};

/// Writes until the reader closes its end, and drops the rest. The command runs to its end, so that the exit code of
/// `bindpose check … | head` is the same as without `head`.
#[derive(Debug)]
pub struct UntilClosed<W> {
    inner: W,
    closed: bool,
}

impl<W: Write> UntilClosed<W> {
    /// Everything goes to `inner` until its reader leaves.
    pub fn new(inner: W) -> Self {
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
