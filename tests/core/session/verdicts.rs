//! What the books' programs make of the open file, and the report.

use bindpose::check::book::Book;
use bindpose::diagnostic::codes;
use bindpose::session::{ExportOptions, File, FileCommand, Session};

use super::maps::{mapped, picture};
use super::{models, opened};

/// Codes of the limits of the D3D12 book.
fn limits(session: &Session) -> Vec<&'static str> {
    let verdict = session.verdicts().iter().find(|verdict| verdict.book == Book::D3d12);
    let limits = &verdict.expect("each book has one").limits;
    limits.iter().map(|limit| limit.code).collect()
}

#[test]
fn without_a_model_there_is_no_verdict_and_no_report() {
    let session = Session::new(false);
    assert!(session.verdicts().is_empty() && session.report().is_empty() && session.sarif().is_none());
}

#[test]
fn each_book_has_a_verdict_that_is_worked_out_once() {
    let session = opened(models::file("a.m3d", &models::skinned(&models::CLIPS)));
    let first = session.verdicts();
    let reads: Vec<_> = first.iter().map(|verdict| (verdict.book, verdict.reads())).collect();
    assert_eq!(reads, [(Book::D3d11, false), (Book::D3d12, true)]);
    assert!(std::ptr::eq(first, session.verdicts()));
}

#[test]
fn maps_that_are_missing_give_one_verdict_whether_some_came_or_none() {
    let mut session = opened(mapped("box.m3d", "skin_diff.dds", "skin_norm.dds"));
    let words = |session: &Session| {
        let verdict = session.verdicts().iter().find(|verdict| verdict.book == Book::D3d12);
        verdict.map(|verdict| (verdict.outcome.to_string(), verdict.ends, verdict.is_bad()))
    };
    let told = |words: &str| Some((words.to_owned(), false, false));
    assert_eq!(words(&session), told("shows it, if these 2 maps lie beside it"));
    session.apply(FileCommand::Add(vec![picture("other.png", [0; 4])]));
    assert_eq!(words(&session), told("shows it, if these 2 maps lie beside it"));
    session.apply(FileCommand::Add(vec![picture("skin_diff.png", [0; 4])]));
    assert_eq!(words(&session), told("shows it, if this map lies beside it"));
    assert!(limits(&session).contains(&codes::MAP_MISSING.name));
    session.apply(FileCommand::Add(vec![picture("skin_norm.png", [0; 4])]));
    assert_eq!(words(&session), told("shows it"));
    assert!(!limits(&session).contains(&codes::MAP_MISSING.name));
}

#[test]
fn that_the_other_books_demo_cannot_read_the_file_is_no_fault_of_it() {
    let session = opened(models::file("a.m3d", &models::skinned(&models::CLIPS)));
    let told: Vec<_> = session
        .verdicts()
        .iter()
        .map(|verdict| (verdict.outcome.to_string(), verdict.is_foreign, verdict.is_bad()))
        .collect();
    assert_eq!(
        told,
        [
            ("cannot read it".to_owned(), true, false),
            ("would end with an error".to_owned(), false, true)
        ]
    );
}

#[test]
fn of_gltf_it_is_said_what_it_exceeds_once_it_is_converted() {
    let m3d = opened(models::file("a.m3d", &models::document()));
    assert!(m3d.limits_once_converted().is_none());
    let glb = m3d
        .export_job(&ExportOptions::default())
        .expect("a model")
        .run()
        .expect("it can be written");
    let session = opened(File::new("a.glb", glb.bytes));
    assert!(session.verdicts().is_empty() && session.limits_once_converted().is_some_and(<[_]>::is_empty));
    assert!(
        session
            .report()
            .ends_with("a.glb: Book demos: converted for the book: fits\n"),
        "{}",
        session.report()
    );
}

#[test]
fn another_model_has_verdicts_of_its_own() {
    let mut session = opened(models::file("a.m3d", &models::skinned(&models::CLIPS)));
    assert!(session.verdicts().iter().any(|verdict| verdict.reads() && verdict.ends));
    session.apply(FileCommand::Add(vec![mapped(
        "b.m3d",
        "skin_diff.dds",
        "skin_norm.dds",
    )]));
    assert!(
        session
            .verdicts()
            .iter()
            .any(|verdict| verdict.reads() && !verdict.ends)
    );
}

#[test]
fn the_report_names_the_file_and_has_a_line_for_each_book() {
    let session = opened(models::file("folder/a.m3d", &models::skinned(&models::CLIPS)));
    let report = session.report();
    let lines: Vec<&str> = report.lines().filter(|line| line.starts_with("a.m3d")).collect();
    let (permanent, lines): (Vec<&str>, Vec<&str>) = lines
        .into_iter()
        .partition(|line| line.contains("The file itself is unchanged"));
    assert!(!permanent.is_empty(), "{report}");
    assert_eq!(lines.len(), 2 + session.diagnostics().count(), "{report}");
    assert!(
        lines
            .iter()
            .any(|line| line.starts_with("a.m3d:9:1: D3D11 demo: cannot read it. It takes \"Name:\"")),
        "{report}"
    );
    assert!(
        lines
            .iter()
            .any(|line| line.starts_with("a.m3d: D3D12 demo: would end with an error. One sees: ")),
        "{report}"
    );
}

#[test]
fn the_report_has_help_once_for_each_code_and_no_sentence_twice_in_a_finding() {
    let mut document = models::skinned(&models::CLIPS);
    document.clips.iter_mut().for_each(|clip| clip.name = "Walk".into());
    let count = document.clips.len() - 1;
    let session = opened(models::file("a.m3d", &document));
    let report = session.report();
    let of_finding = codes::DUPLICATE_CLIP_NAME;
    assert_eq!(
        report.matches(&format!("note[{}]", of_finding.name)).count(),
        count,
        "{report}"
    );
    assert_eq!(report.matches(of_finding.explanation).count(), 1, "{report}");
    for limit in session.verdicts().iter().flat_map(|verdict| &verdict.limits) {
        let mending = codes::named(limit.code).expect("a row of the table").mending;
        assert!(report.contains(&format!("{} {mending}", limit.message)), "{report}");
    }
    for code in codes::all() {
        let words = [code.sentence, code.explanation, code.handling, code.mending].join(" ");
        let mut sentences: Vec<&str> = words.split_inclusive(". ").map(str::trim).collect();
        sentences.sort_unstable();
        let count = sentences.len();
        sentences.dedup();
        assert_eq!(sentences.len(), count, "{}", code.name);
    }
}
