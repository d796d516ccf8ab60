//! The fuzzer itself: libFuzzer makes bytes up and watches which code they reach. Without it this program packs corpora.

#![cfg_attr(fuzzing, no_main)]

#[cfg(fuzzing)]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    use std::sync::OnceLock;

    static RUN: OnceLock<fn(&[u8])> = OnceLock::new();
    let run = RUN.get_or_init(|| {
        let name = std::env::var(fuzz::TARGET).expect("the environment names a target");
        let target = fuzz::TARGETS.into_iter().find(|target| target.name == name);
        target.expect("the name of a target").run
    });
    run(bytes);
});

/// `fuzz unpack TARGET FOLDER` writes the inputs of a target into a folder, `fuzz pack TARGET FOLDER` keeps those that are there.
#[cfg(not(fuzzing))]
fn main() -> std::io::Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["unpack", target, folder] => fuzz::corpus::unpack(target, folder.as_ref()),
        ["pack", target, folder] => fuzz::corpus::pack(target, folder.as_ref()),
        _ => Err(std::io::Error::other("use: cargo xtask fuzz")),
    }
}
