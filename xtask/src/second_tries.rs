//! Browser tests that failed and were tried again. Real input meets a page that software draws a few times a second, so one may fail that is
//! sound; but each is told, and more than a few are a fault.

use crate::failure::Failure;

/// The environment variable that names the list to the browser tests. Each that is tried again adds a line.
pub(crate) const VARIABLE: &str = "BINDPOSE_SECOND_TRIES";

/// So many are let through in one run of the checks.
const MOST: usize = 2;

/// What was tried again, and why; nothing where nothing was.
pub(crate) fn words(list: &str) -> String {
    let count = list.lines().count();
    if count == 0 {
        return String::new();
    }
    let lines: String = list.lines().map(|line| format!("    {line}\n")).collect();
    format!("\nTried a second time: {count} (at most {MOST} are let through).\n{lines}")
}

/// Says what was tried again.
///
/// # Errors
/// When it was too much.
pub(crate) fn judge(list: &str) -> Result<(), Failure> {
    eprint!("{}", words(list));
    let count = list.lines().count();
    if count > MOST {
        return Err(Failure::Remedy {
            what: format!("{count} tests passed at their second try only"),
            remedy: "cargo xtask test --browser --only \"words of a test's name\"".to_owned(),
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_second_tries_are_let_through_and_three_are_not() {
        assert!(judge("").is_ok());
        assert_eq!(words(""), "");
        assert!(words("a\nb\n").ends_with("    a\n    b\n"));
        assert!(judge("a\nb\n").is_ok());
        let failure = judge("a\nb\nc\n").expect_err("three").to_string();
        assert!(failure.contains("3 tests"), "{failure}");
    }
}
