//! The most bytes that files of the site may have: `xtask/sizes.txt`, whose head says how it reads.

use std::fs;
use std::path::PathBuf;

use crate::dist::grouped;
use crate::failure::{Doing as _, Failure};
use crate::wasm::{Profile, Program};

/// The limits and where they stand.
const LIMITS: &str = include_str!("../sizes.txt");
const PLACE: &str = "xtask/sizes.txt";

/// A file of the site and its bytes.
#[derive(Clone, Debug)]
pub(crate) struct Size {
    address: String,
    raw: usize,
    brotli: usize,
}

impl Size {
    /// Of a file by its address; the hash that `dist` puts into names is left out.
    pub(crate) fn new(name: &str, raw: usize, brotli: usize) -> Self {
        let address = without_hash(name).unwrap_or_else(|| name.to_owned());
        Self { address, raw, brotli }
    }
}

/// Whether a name has the hash that `dist` puts into it.
pub(crate) fn is_hashed(name: &str) -> bool {
    without_hash(name).is_some()
}

fn without_hash(name: &str) -> Option<String> {
    let is_hash = |part: &str| part.len() == 16 && part.bytes().all(|byte| byte.is_ascii_hexdigit());
    let parts: Vec<&str> = name.split('.').collect();
    match parts[..] {
        [ref stem @ .., hash, extension] if !stem.is_empty() && is_hash(hash) => {
            Some(format!("{}.{extension}", stem.join(".")))
        }
        _ => None,
    }
}

/// Prints what was built of this profile beside its limits; fails above one, and where a file has none.
pub(crate) fn compare(profile: Profile, files: &[Size]) -> Result<(), Failure> {
    let limits = parse(LIMITS).map_err(Failure::Site)?;
    let limits: Vec<Limit<'_>> = limits.into_iter().filter(|limit| limit.profile == profile).collect();
    println!(
        "\n{:>10} {:>10} {:>10} {:>10}  {PLACE}",
        "raw", "limit", "brotli", "limit"
    );
    for limit in &limits {
        let [raw, brotli] = limit.sums(files);
        let words = |number: Option<usize>| number.map_or("-".to_owned(), grouped);
        println!(
            "{:>10} {:>10} {:>10} {:>10}  {}",
            grouped(raw),
            words(limit.most[0]),
            grouped(brotli),
            words(limit.most[1]),
            limit.addresses.join(" ")
        );
    }
    let faults = faults(&limits, files);
    if faults.is_empty() {
        return Ok(());
    }
    Err(Failure::Site(faults.join("\n")))
}

/// Compares the development builds of programs in these folders: the wasm of those that draw on both backends, which nobody fetches over a line.
pub(crate) fn of_development(built: &[(Program, PathBuf)]) -> Result<(), Failure> {
    let mut sizes = Vec::new();
    for (program, pkg) in built.iter().filter(|(program, _)| *program == program.on_both()) {
        let wasm = pkg.join("bindpose_bg.wasm");
        let raw = fs::metadata(&wasm).doing(format!("reading {}", wasm.display()))?.len();
        let name = format!("pkg/{}bindpose_bg.wasm", program.folder());
        sizes.push(Size::new(&name, usize::try_from(raw).unwrap_or(usize::MAX), 0));
    }
    compare(Profile::Dev, &sizes)
}

/// A line of the file.
#[derive(Clone, Debug)]
struct Limit<'a> {
    line: usize,
    profile: Profile,
    /// Raw and as Brotli.
    most: [Option<usize>; 2],
    addresses: Vec<&'a str>,
}

impl Limit<'_> {
    fn has(&self, file: &Size) -> bool {
        self.addresses.iter().any(|pattern| matches(pattern, &file.address))
    }

    /// What its files come to, raw and as Brotli.
    fn sums(&self, files: &[Size]) -> [usize; 2] {
        let own = files.iter().filter(|file| self.has(file));
        own.fold([0, 0], |[raw, brotli], file| [raw + file.raw, brotli + file.brotli])
    }
}

/// Whether the pattern, an address that may have one `*` in the name, means this address.
fn matches(pattern: &str, address: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == address,
        Some((start, end)) => address
            .strip_prefix(start)
            .and_then(|rest| rest.strip_suffix(end))
            .is_some_and(|name| !name.contains('/')),
    }
}

/// The lines of the file, or what is wrong with one.
fn parse(text: &str) -> Result<Vec<Limit<'_>>, String> {
    let lines = text.lines().enumerate().map(|(index, words)| (index + 1, words));
    lines
        .filter(|(_, words)| !words.starts_with('#') && !words.trim().is_empty())
        .map(|(line, words)| limit(line, words).map_err(|why| format!("{PLACE}, line {line}: {why}")))
        .collect()
}

fn limit(line: usize, words: &str) -> Result<Limit<'_>, String> {
    let mut words = words.split_whitespace();
    let profile = match words.next() {
        Some("dist") => Profile::Dist,
        Some("dev") => Profile::Dev,
        other => {
            return Err(format!(
                "`dist` or `dev` is wanted first, not `{}`",
                other.unwrap_or("")
            ));
        }
    };
    let mut most = [None; 2];
    for (most, name) in most.iter_mut().zip(["raw", "Brotli"]) {
        let word = words.next().unwrap_or("");
        *most = match word {
            "-" => None,
            word => Some(
                word.replace('_', "")
                    .parse()
                    .map_err(|_| format!("a number of bytes or `-` is wanted for {name}, not `{word}`"))?,
            ),
        };
    }
    let addresses: Vec<&str> = words.collect();
    if addresses.is_empty() {
        return Err("an address is wanted after the two numbers".to_owned());
    }
    Ok(Limit {
        line,
        profile,
        most,
        addresses,
    })
}

/// What is above its limit, has none, or has one and is not there.
fn faults(limits: &[Limit<'_>], files: &[Size]) -> Vec<String> {
    let mut faults = Vec::new();
    for limit in limits {
        let what = limit.addresses.join(" ");
        for ((sum, most), name) in limit.sums(files).into_iter().zip(limit.most).zip(["raw", "as Brotli"]) {
            if let Some(most) = most.filter(|most| sum > *most) {
                faults.push(format!(
                    "{what}: {} bytes {name}, {} above the limit of {}.\n  Make it smaller (PERFORMANCE.md, \"Size of the program\", \
                     has what it is made of), or raise the limit in {PLACE}, line {}, and say why.",
                    grouped(sum),
                    grouped(sum - most),
                    grouped(most),
                    limit.line
                ));
            }
        }
        let is_absent = |pattern: &&&str| !files.iter().any(|file| matches(pattern, &file.address));
        for pattern in limit.addresses.iter().filter(is_absent) {
            faults.push(format!(
                "{PLACE}, line {}: no file of the site is {pattern}. Take it out.",
                limit.line
            ));
        }
    }
    for file in files.iter().filter(|file| !limits.iter().any(|limit| limit.has(file))) {
        faults.push(format!("{}: it has no limit. Add a line to {PLACE}.", file.address));
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compress::{Coding, Effort};
    use crate::dist;

    const TEXT: &str = "# words\n\ndist 1_000 500 pkg/a.wasm\ndist - 60 web/*.js index.html\ndev 9 - pkg/a.wasm\n";

    fn of_dist(files: &[(&str, usize, usize)]) -> Vec<String> {
        let limits: Vec<Limit<'_>> = parse(TEXT).expect("sound");
        let limits: Vec<Limit<'_>> = limits
            .into_iter()
            .filter(|limit| limit.profile == Profile::Dist)
            .collect();
        let files: Vec<Size> = files
            .iter()
            .map(|&(name, raw, brotli)| Size::new(name, raw, brotli))
            .collect();
        faults(&limits, &files)
    }

    #[test]
    fn what_is_at_its_limit_passes_and_a_byte_more_fails_in_words() {
        let rest = [("web/x.0123456789abcdef.js", 900, 40), ("index.html", 9, 20)];
        assert_eq!(
            of_dist(&[&[("pkg/a.fedcba9876543210.wasm", 1000, 500)], &rest[..]].concat()),
            [""; 0]
        );
        let above = of_dist(&[&[("pkg/a.wasm", 2100, 500)], &rest[..]].concat());
        assert_eq!(above.len(), 1, "{above:?}");
        let start = "pkg/a.wasm: 2 100 bytes raw, 1 100 above the limit of 1 000.";
        assert!(above[0].starts_with(start), "{}", above[0]);
        assert!(above[0].contains("xtask/sizes.txt, line 3"), "{}", above[0]);
    }

    #[test]
    fn files_of_a_line_count_together() {
        let files = [
            ("pkg/a.wasm", 1, 1),
            ("web/x.js", 1, 30),
            ("web/y.js", 1, 11),
            ("index.html", 1, 20),
        ];
        let above = of_dist(&files);
        let start = "web/*.js index.html: 61 bytes as Brotli, 1 above the limit of 60.";
        assert!(above.len() == 1 && above[0].starts_with(start), "{above:?}");
    }

    #[test]
    fn a_file_without_a_limit_and_a_limit_without_a_file_are_named() {
        let files = [("pkg/a.wasm", 1, 1), ("web/x/y.js", 1, 1), ("index.html", 1, 1)];
        assert_eq!(
            of_dist(&files),
            [
                "xtask/sizes.txt, line 4: no file of the site is web/*.js. Take it out.",
                "web/x/y.js: it has no limit. Add a line to xtask/sizes.txt.",
            ]
        );
    }

    #[test]
    fn hashes_of_names_are_left_out() {
        for (name, address) in [
            ("pkg/webgpu/a_bg.0123456789abcdef.wasm", "pkg/webgpu/a_bg.wasm"),
            ("web/a.b.0123456789abcdef.js", "web/a.b.js"),
            ("index.html", "index.html"),
            ("web/0123456789abcdef.js", "web/0123456789abcdef.js"),
        ] {
            assert_eq!(Size::new(name, 0, 0).address, address);
        }
    }

    #[test]
    fn what_is_wrong_with_a_line_is_said() {
        for (text, words) in [
            ("disc 1 1 a", "line 1: `dist` or `dev` is wanted first, not `disc`"),
            (
                "# a\ndist 1",
                "line 2: a number of bytes or `-` is wanted for Brotli, not ``",
            ),
            (
                "dist 1k 1 a",
                "line 1: a number of bytes or `-` is wanted for raw, not `1k`",
            ),
            ("dev 1 -", "line 1: an address is wanted after the two numbers"),
        ] {
            let told = parse(text).expect_err("a fault");
            assert_eq!(told, format!("xtask/sizes.txt, {words}"));
        }
    }

    /// The shell must be there long before the wasm is, on any line. What is neither built nor of the sample is looked at, under the names
    /// of `dist`.
    #[test]
    fn the_shell_keeps_its_limits() {
        let is_other = |address: &str| address.starts_with("pkg/") || address.starts_with("web/sample/");
        let files = dist::of_the_page();
        let sized = files
            .iter()
            .filter(|(name, _)| !is_other(name))
            .map(|(name, bytes)| Size::new(name, bytes.len(), Coding::Brotli.encode(bytes, Effort::Best).len()));
        let limits = parse(LIMITS).expect("sound");
        let is_here = |limit: &Limit<'_>| !limit.addresses.iter().any(|address| is_other(address));
        let limits: Vec<Limit<'_>> = limits.into_iter().filter(is_here).collect();
        assert_eq!(faults(&limits, &sized.collect::<Vec<_>>()), [""; 0]);
    }
}
