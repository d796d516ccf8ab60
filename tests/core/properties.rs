//! How many cases a property is tried with.

use proptest::test_runner::Config;

/// So many cases, or `BINDPOSE_CASES` times as many where that is set: `cargo xtask test --long` takes its time. A case that fails is told
/// with its seed and kept in no file.
pub(crate) fn cases(count: u32) -> Config {
    let times = std::env::var("BINDPOSE_CASES").map_or(1, |times| times.parse().expect("BINDPOSE_CASES is a number"));
    Config {
        cases: count * times,
        failure_persistence: None,
        max_global_rejects: 1024 * times,
        ..Config::default()
    }
}
