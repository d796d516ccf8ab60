//! Losses as they are found.

use super::Loss;

/// All that were found, in the order of finding.
#[derive(Default)]
pub(super) struct Losses(pub(super) Vec<Loss>);

impl Losses {
    /// Adds a loss that so many parts meet, unless none does.
    pub(super) fn add(&mut self, code: &'static str, count: usize, message: String) {
        if count > 0 {
            self.0.push(Loss { code, message, count });
        }
    }

    /// Adds a loss that so many parts meet: what one of them or several do, and what that means.
    pub(super) fn count(&mut self, code: &'static str, count: usize, words: [&str; 2], rest: &str) {
        self.0.extend(Loss::counted(code, count, words, rest));
    }
}
