//! The browsers that the page is tested in, and what each draws with.

use std::fmt;

/// A browser.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Browser {
    Chromium,
    Firefox,
    Webkit,
}

/// A browser that draws with a backend.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct BrowserRun {
    pub(crate) browser: Browser,
    /// As the page's address names it.
    pub(crate) backend: &'static str,
    /// Which tests the checks run in it, as `tests/browser/harness.js` names them.
    pub(crate) tests: &'static str,
}

/// Every run, in order: Chromium on both backends, and a walk through the page in the others, which have WebGL2 only on the machines that the
/// tests are made for. Tests that draw run on both backends. What does not draw is the same on both: they share those tests.
pub(crate) const RUNS: [BrowserRun; 4] = [
    BrowserRun {
        browser: Browser::Chromium,
        backend: "webgpu",
        tests: "odd",
    },
    BrowserRun {
        browser: Browser::Chromium,
        backend: "webgl2",
        tests: "even",
    },
    BrowserRun {
        browser: Browser::Firefox,
        backend: "webgl2",
        tests: "all",
    },
    BrowserRun {
        browser: Browser::Webkit,
        backend: "webgl2",
        tests: "all",
    },
];

impl Browser {
    /// Whether this system has it: WebKit with a driver and a display without a screen are Linux's.
    pub(crate) fn is_run_here(self) -> bool {
        matches!(self, Self::Chromium) || cfg!(target_os = "linux")
    }

    /// As the tests name it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Chromium => "chromium",
            Self::Firefox => "firefox",
            Self::Webkit => "webkit",
        }
    }
}

impl BrowserRun {
    /// As the command line names it: Chromium by its backend.
    pub(crate) fn name(self) -> &'static str {
        match self.browser {
            Browser::Chromium => self.backend,
            other => other.name(),
        }
    }
}

impl fmt::Display for BrowserRun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let browser = match self.browser {
            Browser::Chromium => "Chromium",
            Browser::Firefox => "Firefox",
            Browser::Webkit => "WebKit",
        };
        write!(f, "{browser} on {}", self.backend)
    }
}
