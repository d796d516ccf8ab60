//! Standard error without the words of drivers.

/// Does something while whatever is written to standard error is dropped, by whomever.
///
/// Mesa's layer for choosing a device, which comes with every Vulkan instance that can show windows, asks for a compositor;
/// where there is none, libwayland says `error: XDG_RUNTIME_DIR is invalid or not set in the environment`, and all is well.
#[cfg(unix)]
pub(super) fn quietly<T>(work: impl FnOnce() -> T) -> T {
    use std::fs::File;
    use std::io;
    use std::os::fd::{AsFd as _, OwnedFd};

    use rustix::stdio::dup2_stderr;

    /// The stream as it was, which comes back in the end, also after a panic.
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
            // There is no stream left on which a failure could be told.
            let _ = dup2_stderr(&self.0);
        }
    }

    // Where it cannot be put aside, it is closed or there is nothing to drop words into: they are heard then.
    let _aside = Aside::put();
    work()
}

/// Does something. Drivers of this system write nothing.
#[cfg(not(unix))]
pub(super) fn quietly<T>(work: impl FnOnce() -> T) -> T {
    work()
}
