//! How far a command is, for a person who waits.

use indicatif::{ProgressBar, ProgressStyle};

/// A line on standard error, where that is a terminal and there is more than one step. `words` name `{pos}`, `{len}` and `{eta}`.
pub(super) fn progress(steps: usize, words: &str) -> ProgressBar {
    if steps < 2 {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(steps as u64);
    if let Ok(style) = ProgressStyle::with_template(words) {
        bar.set_style(style);
    }
    bar
}
