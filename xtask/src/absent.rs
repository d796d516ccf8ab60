//! Real files that this machine lacks: the tests list what they could not look at, and the end of the checks says it.

use std::collections::BTreeSet;

/// The environment variable that names the list to the tests. Each test that wants a file of `../shared` in vain adds a line.
pub(crate) const VARIABLE: &str = "BINDPOSE_ABSENT";

/// What is said of a list.
pub(crate) fn words(list: &str) -> String {
    let files: BTreeSet<&str> = list.lines().collect();
    if files.is_empty() {
        return String::new();
    }
    let mut words = format!(
        "\nNot everything was looked at: {} tests wanted real files in ../shared that are not there.\n",
        list.lines().count()
    );
    for file in files {
        words.push_str(&format!("    {file}\n"));
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_absent_file_is_said_once() {
        assert_eq!(words(""), "");
        assert_eq!(
            words("models/b.m3d\ntextures\nmodels/b.m3d\n"),
            "\nNot everything was looked at: 3 tests wanted real files in ../shared that are not there.\n    \
             models/b.m3d\n    textures\n"
        );
    }
}
