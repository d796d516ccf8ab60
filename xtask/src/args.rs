//! The command line.

use crate::browsers::{BrowserRun, RUNS};
use crate::failure::Failure;
use crate::fuzz::FuzzOptions;

/// What `cargo xtask --help` prints.
pub(crate) const HELP: &str = "\
Bindpose's own commands. Each does its set-up itself.

    cargo xtask serve [--port N] [--open] [--release] [--watch] [--examples]
        Build the viewer for the browser and serve it on this machine, the full program alone.
        --port N    the port, 8080 unless given; 0 takes any free one
        --open      open the page in the default browser
        --release   optimised, slower to build
        --watch     build again when a source file changes; reload the page to see it
        --examples  the program without the interface too, which the pages in examples/ need

    cargo xtask test [--long] [--browser [webgpu | webgl2 | firefox | webkit] [--only PATTERN]]
        Every check: formatting, lints, documentation, native tests, the wasm build and the browser tests: all of them
        in Chromium on WebGPU, those that draw on WebGL2 too, a walk in Firefox and in WebKit. Stops at the first failure
        and prints the command that repeats it.
        --long      what takes longer too: every browser test on both backends, properties with ten times as many cases,
                    a minute of fuzzing, `bench --counts`
        --browser   the browser tests alone: all, or those in Chromium on one backend, or those in another browser
        --only      of these the tests whose name fits a regular expression

    cargo xtask pictures
        The README's pictures and those of the manifest, drawn by the page in Chromium: assets/page/, web/install/ and,
        beside three.js, assets/beside/.

    cargo xtask dist [--npm]
        The static site in dist/: smallest download, hashed names, .br and .gz beside each file, the worker that keeps it
        for visits without a network, _headers for hosts that read it, and the licences of
        all.
        --npm       the package `bindpose-viewer` in dist-npm/, in place of the site

    cargo xtask licenses TARGET
        What the command `bindpose` is made of when it is built for TARGET, and the licences of it, for whoever passes it on.

    cargo xtask bench [--counts] [--browser [--dist] [--model FILE]]
        What speed is: one of these at least.
        --counts    instructions of the core's work, by valgrind, against tools/counts/limits.txt
        --browser   times, tasks and memory of the page in Chromium on both backends, built as `serve --release` builds it
        --dist      the page as `dist` builds it
        --model     the .m3d file that is read and played, in place of the soldier, or of the sample where that is missing

    cargo xtask fuzz [--secs N] [--keep]
        Files that libFuzzer makes up are read, edited and written by the core, each target for N seconds, 60 unless told.
        --keep      what reaches new code goes into tools/fuzz/corpus, which the checks try
";

/// The port that `serve` takes unless told another.
const DEFAULT_PORT: u16 = 8080;

/// One of the commands, with its options.
#[derive(Debug, PartialEq)]
pub(crate) enum Task {
    Help,
    Serve(ServeOptions),
    Test(TestOptions),
    Pictures,
    Dist,
    DistNpm,
    /// For the command, built for this target.
    Licenses(String),
    Bench(BenchOptions),
    Fuzz(FuzzOptions),
}

/// Options of `serve`.
#[derive(Debug, PartialEq)]
pub(crate) struct ServeOptions {
    /// 0 takes any free port.
    pub(crate) port: u16,
    pub(crate) open: bool,
    pub(crate) release: bool,
    pub(crate) watch: bool,
    /// Also what the pages with the element need.
    pub(crate) examples: bool,
}

/// Options of `test`.
#[derive(Debug, PartialEq)]
pub(crate) struct TestOptions {
    /// Also what takes too long for every change.
    pub(crate) long: bool,
    /// Only the browser tests.
    pub(crate) browser_alone: bool,
    /// The browsers, in turn.
    pub(crate) browsers: Vec<BrowserRun>,
    /// A pattern of the names of browser tests; all without one.
    pub(crate) only: Option<String>,
}

/// Options of `bench`.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct BenchOptions {
    /// Instructions of the core's work.
    pub(crate) counts: bool,
    /// The page in Chromium.
    pub(crate) browser: bool,
    /// The page as it is shipped.
    pub(crate) dist: bool,
    /// What is read and played.
    pub(crate) model: Option<String>,
}

/// Reads the arguments after the program's name.
pub(crate) fn parse(args: impl IntoIterator<Item = String>) -> Result<Task, Failure> {
    let mut args = args.into_iter();
    let Some(name) = args.next() else { return Ok(Task::Help) };
    let rest: Vec<String> = args.collect();
    if matches!(name.as_str(), "help" | "--help" | "-h") || rest.iter().any(|arg| arg == "--help" || arg == "-h") {
        return Ok(Task::Help);
    }
    match name.as_str() {
        "serve" => serve_options(rest).map(Task::Serve),
        "test" => test_options(&rest).map(Task::Test),
        "pictures" => nothing_more("pictures", &rest).map(|()| Task::Pictures),
        "dist" => match rest.first().map(String::as_str) {
            None => Ok(Task::Dist),
            Some("--npm") if rest.len() == 1 => Ok(Task::DistNpm),
            Some(arg) => Err(Failure::Usage(format!(
                "`dist` takes `--npm` or nothing, but `{arg}` was given"
            ))),
        },
        "licenses" => match <[String; 1]>::try_from(rest) {
            Ok([target]) => Ok(Task::Licenses(target)),
            Err(_) => Err(Failure::Usage("`licenses` takes a target".to_owned())),
        },
        "bench" => bench_options(rest).map(Task::Bench),
        "fuzz" => fuzz_options(&rest).map(Task::Fuzz),
        other => Err(Failure::Usage(format!("there is no command `{other}`"))),
    }
}

fn nothing_more(name: &str, rest: &[String]) -> Result<(), Failure> {
    match rest.first() {
        None => Ok(()),
        Some(arg) => Err(Failure::Usage(format!(
            "`{name}` takes no options, but `{arg}` was given"
        ))),
    }
}

fn test_options(rest: &[String]) -> Result<TestOptions, Failure> {
    let mut words: Vec<&str> = rest.iter().map(String::as_str).collect();
    let long = words.first() == Some(&"--long");
    if long {
        words.remove(0);
    }
    let (words, only) = match words[..] {
        [ref words @ .., "--only", pattern] if !words.is_empty() => (words, Some(pattern.to_owned())),
        ref words => (words, None),
    };
    let options = |browser_alone: bool, browsers: Vec<BrowserRun>| TestOptions {
        long,
        browser_alone,
        browsers,
        only,
    };
    match words {
        [] => Ok(options(false, RUNS.to_vec())),
        ["--browser"] => Ok(options(true, RUNS.to_vec())),
        ["--browser", name] => match RUNS.into_iter().find(|run| run.name() == *name) {
            Some(run) => Ok(options(true, vec![run])),
            None => Err(Failure::Usage(format!(
                "`--browser` takes {}, but `{name}` was given",
                RUNS.map(BrowserRun::name).join(", ")
            ))),
        },
        _ => Err(Failure::Usage(format!("`test` does not know `{}`", words.join(" ")))),
    }
}

fn bench_options(rest: Vec<String>) -> Result<BenchOptions, Failure> {
    let mut options = BenchOptions::default();
    let mut rest = rest.into_iter();
    while let Some(arg) = rest.next() {
        match arg.as_str() {
            "--counts" => options.counts = true,
            "--browser" => options.browser = true,
            "--dist" if options.browser => options.dist = true,
            "--model" if options.browser => {
                let model = rest.next();
                options.model = Some(model.ok_or_else(|| Failure::Usage("`--model` takes a file".to_owned()))?);
            }
            other => return Err(Failure::Usage(format!("`bench` does not know `{other}` here"))),
        }
    }
    if !(options.counts || options.browser) {
        return Err(Failure::Usage("`bench` takes --counts or --browser".to_owned()));
    }
    Ok(options)
}

fn fuzz_options(rest: &[String]) -> Result<FuzzOptions, Failure> {
    let mut options = FuzzOptions { secs: 60, keep: false };
    let mut rest = rest.iter().map(String::as_str);
    while let Some(arg) = rest.next() {
        match arg {
            "--keep" => options.keep = true,
            "--secs" => {
                let secs = rest.next().and_then(|secs| secs.parse().ok()).filter(|&secs| secs > 0);
                options.secs = secs.ok_or_else(|| Failure::Usage("`--secs` takes a number of seconds".to_owned()))?;
            }
            other => return Err(Failure::Usage(format!("`fuzz` has no option `{other}`"))),
        }
    }
    Ok(options)
}

fn serve_options(rest: Vec<String>) -> Result<ServeOptions, Failure> {
    let mut options = ServeOptions {
        port: DEFAULT_PORT,
        open: false,
        release: false,
        watch: false,
        examples: false,
    };
    let mut rest = rest.into_iter();
    while let Some(arg) = rest.next() {
        match arg.as_str() {
            "--open" => options.open = true,
            "--release" => options.release = true,
            "--watch" => options.watch = true,
            "--examples" => options.examples = true,
            "--port" => options.port = port(rest.next().as_deref())?,
            other => match other.strip_prefix("--port=") {
                Some(value) => options.port = port(Some(value))?,
                None => return Err(Failure::Usage(format!("`serve` has no option `{other}`"))),
            },
        }
    }
    Ok(options)
}

fn port(value: Option<&str>) -> Result<u16, Failure> {
    let found = value.map_or("nothing".to_owned(), |value| format!("`{value}`"));
    value.and_then(|value| value.parse().ok()).ok_or_else(|| {
        Failure::Usage(format!(
            "`--port` takes a number from 0 to 65535, but {found} was given"
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str) -> Result<Task, String> {
        parse(line.split_whitespace().map(str::to_owned)).map_err(|failure| failure.to_string())
    }

    #[test]
    fn options_are_read_in_any_order() {
        let expected = ServeOptions {
            port: 9000,
            open: true,
            release: true,
            watch: false,
            examples: true,
        };
        assert_eq!(
            parsed("serve --port 9000 --open --release --examples"),
            Ok(Task::Serve(expected))
        );
        let expected = ServeOptions {
            port: 0,
            open: false,
            release: false,
            watch: true,
            examples: false,
        };
        assert_eq!(parsed("serve --watch --port=0"), Ok(Task::Serve(expected)));
        let expected = TestOptions {
            long: false,
            browser_alone: true,
            browsers: vec![RUNS[1]],
            only: None,
        };
        assert_eq!(parsed("test --browser webgl2"), Ok(Task::Test(expected)));
        let expected = TestOptions {
            long: false,
            browser_alone: true,
            browsers: RUNS.to_vec(),
            only: Some("keys".to_owned()),
        };
        assert_eq!(parsed("test --browser --only keys"), Ok(Task::Test(expected)));
        let expected = TestOptions {
            long: false,
            browser_alone: false,
            browsers: RUNS.to_vec(),
            only: None,
        };
        assert_eq!(parsed("test"), Ok(Task::Test(expected)));
        let expected = TestOptions {
            long: true,
            browser_alone: false,
            browsers: RUNS.to_vec(),
            only: None,
        };
        assert_eq!(parsed("test --long"), Ok(Task::Test(expected)));
        let expected = FuzzOptions { secs: 5, keep: true };
        assert_eq!(parsed("fuzz --keep --secs 5"), Ok(Task::Fuzz(expected)));
        let expected = BenchOptions {
            browser: true,
            dist: true,
            model: Some("a.m3d".to_owned()),
            ..BenchOptions::default()
        };
        assert_eq!(
            parsed("bench --browser --model a.m3d --dist"),
            Ok(Task::Bench(expected))
        );
        let expected = "aarch64-apple-darwin".to_owned();
        assert_eq!(parsed("licenses aarch64-apple-darwin"), Ok(Task::Licenses(expected)));
        assert_eq!(parsed("dist --npm"), Ok(Task::DistNpm));
        assert_eq!(parsed("dist --help"), Ok(Task::Help));
        assert_eq!(parsed(""), Ok(Task::Help));
    }

    #[test]
    fn wrong_use_names_what_was_wrong() {
        for (line, words) in [
            ("sevre", "there is no command `sevre`"),
            ("serve --prot 1", "`serve` has no option `--prot`"),
            ("serve --port", "but nothing was given"),
            ("serve --port 70000", "but `70000` was given"),
            ("test --fast", "`test` does not know `--fast`"),
            ("test --only keys", "`test` does not know `--only keys`"),
            (
                "test --browser webgl2 --only",
                "`test` does not know `--browser webgl2 --only`",
            ),
            ("test --browser metal", "but `metal` was given"),
            ("fuzz --secs 0", "`--secs` takes a number of seconds"),
            ("fuzz --fast", "`fuzz` has no option `--fast`"),
            ("licenses", "`licenses` takes a target"),
            ("bench", "`bench` takes --counts or --browser"),
            ("bench --dist", "`bench` does not know `--dist` here"),
            ("bench --browser --model", "`--model` takes a file"),
            ("dist --fast", "`dist` takes `--npm` or nothing, but `--fast` was given"),
        ] {
            let failure = parsed(line).expect_err(line);
            assert!(failure.contains(words), "{line}: {failure}");
        }
    }
}
