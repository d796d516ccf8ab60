//! Each code of the table has a file that gives it and nothing else, with what `bindpose check` prints of it beside it; and the page of
//! codes is made of both. `BLESS=1 cargo test --test cli codes` writes the texts and the page anew.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use bindpose::diagnostic::{Code, Mended, Severity, codes};
use serde_json::Value;

use crate::program::{bindpose, run_command};

/// Groups of codes under the page's headings.
const GROUPS: [(&str, &[Code]); 12] = [
    ("Reading an .m3d file", codes::OF_PARSER),
    ("Making a model of it", codes::OF_MODEL),
    ("Reading a glTF file", codes::OF_GLTF),
    ("Reading an FBX file", codes::OF_FBX),
    ("Mesh and rig", codes::OF_MESH_AND_RIG),
    ("In motion", codes::OF_MOTION),
    ("The books’ programs", codes::OF_BOOKS),
    ("Pictures", codes::OF_IMAGES),
    ("Files together", codes::OF_SESSION),
    ("Files and folders of the command line", codes::OF_COMMAND_LINE),
    ("The page", codes::OF_PAGE),
    ("Models made by programs", codes::OF_CONSTRUCTORS),
];

/// Codes that come with another one, whatever the file.
const TOGETHER: [(&str, &str); 3] = [
    // A bone above 255 is one of more than 96.
    ("bone-index-above-byte", "many-bones"),
    // Four weights whose fourth is not what is left to 1 do not sum to 1.
    ("book-fourth-weight", "weights-not-normalized"),
    // A clip that moves shape keys is in a file that has some.
    ("gltf-morph-animation-left-out", "gltf-morph-targets-left-out"),
];

/// Codes without a file in the repository: why, and the tests that meet them.
#[rustfmt::skip]
const ELSEWHERE: [(&str, &str, &str); 9] = [
    (
        "A program that makes a document by itself meets it; the parser refuses or mends such a file before.",
        "tests/core/model/codes.rs",
        "parent-out-of-range bone-count-mismatch vertex-out-of-range influence-out-of-range offset-not-finite \
         vertex-not-finite clip-bones-missing clip-bones-extra",
    ),
    ("A file that gives it has 65,537 vertices.", "tests/core/model/codes.rs", "many-vertices"),
    (
        "A program that makes a model by itself meets it; no file leads to it.",
        "tests/core/model/errors.rs",
        "stream-length position-not-finite incomplete-triangle joint-out-of-range submesh-out-of-range track-count \
         parent-not-before joint-count-mismatch file-bone-not-unique matrix-not-finite no-keys key-not-after \
         key-not-finite",
    ),
    ("Cube maps are skies: one that is damaged shows when it is opened as such.", "tests/core/image/errors.rs",
     "image-cube"),
    ("A program that makes an image by itself meets it; no file leads to it.", "tests/core/image/errors.rs",
     "image-data-length"),
    ("It is about files that are opened together in the viewer.", "tests/core/session/joining.rs",
     "no-model clips-bones-differ clips-by-names clips-none clips-offsets-differ clips-replaced"),
    ("The viewer unpacks archives; `check` is given files and folders.", "tests/core/session/archives.rs",
     "archive-unreadable"),
    ("It is about the machine that draws.", "tests/core/session/going_back.rs and tests/browser/page.js",
     "gpu-refused viewer-stopped"),
    (
        "It is about the rights and kinds of files, which a repository does not keep.",
        "tests/cli/folders.rs and src/cli/textures.rs",
        "file-unreadable link-broken not-a-file folder-unreadable folder-too-large",
    ),
];

/// Extensions of models.
const EXTENSIONS: [&str; 4] = ["m3d", "gltf", "glb", "fbx"];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/check")
}

/// Names in a folder of fixtures, without what stands behind the last dot, where `is_one`.
fn listed(folder: &Path, is_one: impl Fn(&Path) -> bool) -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder).expect("the fixtures are there");
    let paths = entries.map(|entry| entry.expect("can be listed").path());
    let name = |path: PathBuf| Some(path.file_stem()?.to_str()?.to_owned());
    paths.filter(|path| is_one(path)).filter_map(name).collect()
}

/// The codes that have a model of their own, and those that have pictures for the model of all.
fn fixtures() -> (BTreeSet<String>, BTreeSet<String>) {
    let folder = folder();
    let is_model = |path: &Path| {
        path.extension()
            .is_some_and(|extension| EXTENSIONS.iter().any(|model| extension == *model))
    };
    (
        listed(&folder, is_model),
        listed(&folder.join("textures"), Path::is_dir),
    )
}

/// The model that gives a code.
fn fixture(code: &str) -> PathBuf {
    let names = EXTENSIONS.map(|extension| format!("{code}.{extension}"));
    let mut paths = names.into_iter().map(|name| folder().join(name));
    paths.find(|path| path.is_file()).expect("its fixture")
}

/// `check` of a file for a code, with the book where the code is one of books.
fn check_of(code: &str, path: &Path) -> Command {
    let mut command = bindpose();
    command.current_dir(folder()).arg("check").arg(path);
    if code.starts_with("book-") {
        command.args(["--book", "d3d12"]);
    }
    command
}

/// Runs `check` on the fixture of a code.
fn check(code: &str, format: &str) -> String {
    let mut command = if fixtures().1.contains(code) {
        let mut command = check_of(code, Path::new("textures/model.m3d"));
        command.args(["--textures", &format!("textures/{code}")]);
        command
    } else {
        check_of(code, Path::new(fixture(code).file_name().expect("a file")))
    };
    let run = run_command(command.args(["--format", format]));
    assert_eq!(run.err, "", "{code}");
    run.out
}

/// Code, severity and words of each finding.
fn findings(code: &str) -> Vec<[String; 3]> {
    let log: Value = serde_json::from_str(&check(code, "sarif")).expect("is JSON");
    let results = log["runs"][0]["results"].as_array().expect("a list");
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let parts = |result: &Value| {
        [
            text(&result["ruleId"]),
            text(&result["level"]),
            text(&result["message"]["text"]),
        ]
    };
    results.iter().map(parts).collect()
}

/// Compares a text with a file, or writes it there.
fn compare(path: &Path, text: &str) {
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(path, text).expect("can be written");
    }
    let stands = std::fs::read_to_string(path).unwrap_or_default();
    assert!(
        stands == text,
        "{} is not what the program gives; BLESS=1 writes it anew. Now it is:\n{text}",
        path.display()
    );
}

#[test]
fn each_fixture_gives_its_code_and_no_other_in_the_words_beside_it() {
    let (models, pictures) = fixtures();
    for code in models.iter().chain(&pictures) {
        let findings = findings(code);
        let together = TOGETHER.iter().filter(|(one, _)| one == code).map(|(_, other)| *other);
        let expected: BTreeSet<&str> = together.chain([code.as_str()]).collect();
        let given: BTreeSet<&str> = findings.iter().map(|[code, ..]| code.as_str()).collect();
        assert_eq!(given, expected, "{findings:?}");
        for [given, severity, message] in &findings {
            let row = codes::named(given).expect("a row of the table");
            // A map that the person asked for weighs more than the table says, and its message begins with a path.
            let is_map = pictures.contains(code);
            assert!(is_map || *severity == row.severity.to_string(), "{code}: {severity}");
            let is_sentence = !message.starts_with(char::is_lowercase) && message.ends_with('.');
            assert!(is_map || is_sentence, "{code}: {message}");
        }
        let beside = if pictures.contains(code) { "textures" } else { "" };
        compare(&folder().join(beside).join(format!("{code}.txt")), &check(code, "text"));
    }
}

#[test]
fn what_is_said_to_be_mended_in_an_export_is_not_found_there() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("mended");
    std::fs::create_dir_all(&folder).expect("can be made");
    for code in fixtures().0.iter().filter_map(|name| codes::named(name)) {
        let (option, outputs): (_, &[&str]) = match code.mended {
            Mended::No => continue,
            Mended::OnReading => (None, &["m3d", "glb"]),
            Mended::WithFix => (Some("--fix"), &["m3d", "glb"]),
            Mended::ForBook => (Some("--for-book"), &["m3d"]),
        };
        for output in outputs {
            let out = folder.join(format!("{}.{output}", code.name));
            let run = run_command(bindpose().arg("convert").arg(fixture(code.name)).arg(&out).args(option));
            assert_eq!(run.code, Some(0), "{}: {}", code.name, run.err);
            let run = run_command(&mut check_of(code.name, &out));
            assert!(!run.out.contains(&format!("[{}]", code.name)), "{}", run.out);
            assert!(!run.out.contains(&format!("   = {}: ", code.name)), "{}", run.out);
        }
        let permanent = code.permanent().expect("a sentence");
        assert!(option.is_none_or(|option| permanent.contains(option)), "{permanent}");
    }
}

#[test]
fn findings_about_keys_say_when_and_on_which_bone() {
    let bone = Some(1);
    for (code, time_secs, bone) in [
        ("exploded", Some(0.0), None),
        ("keys-all-equal", None, Some(0)),
        ("keys-at-equal-times", Some(0.0), bone),
        ("keys-not-finite", None, bone),
        ("keys-not-sorted", Some(0.0), bone),
        ("loop-jumps", Some(4.0), bone),
        ("pose-overflows", Some(1.0), bone),
        ("rotation-not-unit", Some(1.0), bone),
        ("rotation-side", Some(1.0), bone),
        ("rotation-zero", Some(1.0), bone),
        ("scale-shears", Some(1.0), bone),
        ("track-empty", None, bone),
    ] {
        let files: Value = serde_json::from_str(&check(code, "json")).expect("is JSON");
        let finding = &files[0]["findings"][0];
        assert_eq!(finding["time_secs"].as_f64(), time_secs, "{finding}");
        assert_eq!(finding["bone"].as_u64(), bone, "{finding}");
    }
}

#[test]
fn each_code_has_one_fixture_or_a_reason_to_have_none() {
    let (models, pictures) = fixtures();
    let elsewhere = ELSEWHERE.iter().flat_map(|(.., codes)| codes.split(' '));
    let mut counts: BTreeMap<&str, usize> = codes::all().map(|code| (code.name, 0)).collect();
    for code in models.iter().chain(&pictures).map(String::as_str).chain(elsewhere) {
        *counts
            .get_mut(code)
            .unwrap_or_else(|| panic!("there is no code {code}")) += 1;
    }
    let odd: Vec<_> = counts.iter().filter(|(_, count)| **count != 1).collect();
    assert!(
        odd.is_empty(),
        "tests/fixtures/check/CODE.m3d is missing, or too much: {odd:?}"
    );
    for path in ELSEWHERE.iter().flat_map(|(_, tests, _)| tests.split(" and ")) {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        assert!(path.is_file(), "{} is missing", path.display());
    }
}

#[test]
fn the_page_of_codes_is_that_of_the_table() {
    let of_groups: BTreeSet<_> = GROUPS
        .iter()
        .flat_map(|(_, codes)| *codes)
        .map(|code| code.name)
        .collect();
    assert_eq!(
        of_groups,
        codes::all().map(|code| code.name).collect(),
        "each group has a heading"
    );
    compare(&Path::new(env!("CARGO_MANIFEST_DIR")).join("web/codes.html"), &page());
}

/// All codes with what they mean and an example of each.
fn page() -> String {
    let mut page = String::from(HEAD);
    for (index, (title, codes)) in GROUPS.iter().enumerate() {
        let links: Vec<_> = codes
            .iter()
            .map(|code| format!("<a href=\"#{0}\">{0}</a>", code.name))
            .collect();
        let links = links.join(" ");
        writeln!(
            page,
            "<li><a href=\"#group-{index}\">{title}</a> <span>{links}</span></li>"
        )
        .expect("a string");
    }
    page.push_str("</ul></nav>\n");
    for (index, (title, codes)) in GROUPS.iter().enumerate() {
        writeln!(
            page,
            "\n<section aria-labelledby=\"group-{index}\">\n<h2 id=\"group-{index}\">{title}</h2>"
        )
        .expect("a string");
        for code in *codes {
            article(&mut page, code);
        }
        page.push_str("</section>\n");
    }
    page.push_str("</main>\n</body>\n</html>\n");
    page
}

const HEAD: &str = r#"<!doctype html>
<html lang="en">
<!-- Made of src/diagnostic/codes.rs and tests/fixtures/check by `BLESS=1 cargo test`. -->
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'self'; img-src 'self'; base-uri 'none'">
<meta name="color-scheme" content="dark light">
<meta name="description" content="What each finding of Bindpose means, with an example, and how to mend it in the exporter.">
<title>Findings of Bindpose</title>
<link rel="icon" href="icon.svg" type="image/svg+xml">
<link rel="stylesheet" href="style.css">
<link rel="stylesheet" href="codes.css">
</head>
<body>
<main>
<header>
<p><a href="../index.html">Bindpose</a></p>
<h1>Findings</h1>
<p>What each of them means, an example, what Bindpose does about it, and how to mend it for good. Examples are what
<code>bindpose check</code> prints; <code>bindpose check --explain CODE</code> has the same words.</p>
</header>
<nav aria-label="Codes"><ul>
"#;

fn article(page: &mut String, code: &Code) {
    let Code {
        name,
        severity,
        sentence,
        explanation,
        handling,
        mending,
        mended: _,
    } = *code;
    let dot = match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    };
    let permanent = code
        .permanent()
        .map(|sentence| format!("<dt>To keep it mended</dt><dd>{}</dd>\n", html(sentence)))
        .unwrap_or_default();
    let [sentence, explanation, handling, mending] = [sentence, explanation, handling, mending].map(html);
    write!(
        page,
        "<article id=\"{name}\">\n<h3><a href=\"#{name}\">{name}</a> <span class=\"{dot}\">{severity}</span></h3>\n\
         <p>{sentence}</p>\n<dl>\n<dt>Means</dt><dd>{explanation}</dd>\n<dt>Bindpose</dt><dd>{handling}</dd>\n\
         <dt>To mend it</dt><dd>{mending}</dd>\n{}</dl>\n{}</article>\n",
        permanent,
        example(name)
    )
    .expect("a string");
}

/// What is printed of the fixture; or why there is none.
fn example(code: &str) -> String {
    if let Some((why, ..)) = ELSEWHERE.iter().find(|(.., codes)| codes.contains(code)) {
        return format!("<p class=\"none\">{}</p>\n", html(why));
    }
    let text = check(code, "text");
    // How to keep it mended stands above.
    let ends = codes::all().filter_map(Code::permanent).collect::<BTreeSet<_>>();
    let lines = text.lines().filter(|line| !ends.iter().any(|end| line.ends_with(end)));
    format!("<pre>{}</pre>\n", escaped(&lines.collect::<Vec<_>>().join("\n")))
}

/// Text of the table: what stands between backticks is code.
fn html(text: &str) -> String {
    let parts = escaped(text);
    let parts = parts.split('`').enumerate();
    parts
        .map(|(index, part)| {
            if index % 2 == 1 {
                format!("<code>{part}</code>")
            } else {
                part.to_owned()
            }
        })
        .collect()
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
