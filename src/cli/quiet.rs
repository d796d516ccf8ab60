//! Standard error without messages of drivers.

/// Runs `work` while everything that is written to standard error is dropped.
///
/// Mesa's layer for choosing a device, which comes with every Vulkan instance that can show windows, asks for a
/// compositor. Where there is none, libwayland writes `error: XDG_RUNTIME_DIR is invalid or not set in the
/// environment`, though all is well.
#[cfg(unix)]
pub(super) fn quietly<T>(work: impl FnOnce() -> T) -> T {
    use std::fs::File;
    use std::io;
    use std::os::fd::{AsFd as _, OwnedFd};

    use rustix::stdio::dup2_stderr;

    /// The original stream. It is put back in the end, also after a panic.
    struct Aside(OwnedFd);

    impl Aside {
        fn put() -> io::Result<Self> {
            let nowhere = File::options().write(true).open("/dev/null")?;
            let aside = Self(io::stderr().as_fd().try_clone_to_owned()?);
            dup2_stderr(nowhere)?;
            Ok(aside)
        }
    }

    impl Drop for Aside {
        fn drop(&mut self) {
            // There is no stream left on which to report a failure.
            let _ = dup2_stderr(&self.0);
        }
    }

    // When the stream cannot be redirected, messages are shown.
    let _aside = Aside::put();
    work()
}

/// Runs `work`. Drivers of this system write nothing.
#[cfg(not(unix))]
pub(super) fn quietly<T>(work: impl FnOnce() -> T) -> T {
    work()
}
