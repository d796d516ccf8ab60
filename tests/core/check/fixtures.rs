//! Each code of the mesh and the rig has a file that gives it, and nothing else, in the words beside it. `BLESS=1 cargo test` writes
//! those words anew. The codes of the parser have `good` and `bad`; those of model and motion are met in `model/codes.rs`.

use std::collections::BTreeSet;

use bindpose::diagnostic::codes;
use bindpose::format::parse;

use crate::documents::{checked, is_sentence};
use crate::format::{fixtures, one_line};

#[test]
fn each_fixture_has_the_finding_of_its_name_and_no_other() {
    let mut given = BTreeSet::new();
    for fixture in fixtures("check") {
        let parsed = parse(&fixture.bytes).expect("the fixture can be read");
        assert_eq!(parsed.diagnostics, [], "{}", fixture.name);
        let (_, findings) = checked(&parsed.document, &parsed.lines);
        let [finding] = &findings[..] else {
            panic!("{}: {findings:?}", fixture.name)
        };
        assert_eq!(finding.code, fixture.name);
        assert!(is_sentence(&finding.message), "{}", finding.message);
        let told = format!("{}\n{:?}\n", one_line(finding), finding.subjects);
        let beside = fixture.path.with_extension("txt");
        if std::env::var_os("BLESS").is_some() {
            std::fs::write(&beside, &told).expect("the text can be written");
        }
        assert_eq!(std::fs::read_to_string(&beside).unwrap_or_default(), told);
        given.insert((finding.code, finding.severity));
    }
    let table: BTreeSet<_> = codes::OF_MESH_AND_RIG
        .iter()
        .map(|code| (code.name, code.severity))
        .collect();
    assert_eq!(given, table);
}
