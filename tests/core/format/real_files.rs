//! Facts of the real files.

use bindpose::format::parse;

#[test]
fn all_parse() {
    for file in [
        "d3d12/soldier",
        "d3d11/base",
        "d3d11/rock",
        "d3d11/stairs",
        "d3d11/tree",
        "imm/column",
    ] {
        let path = format!("{}/../shared/models/{file}.m3d", env!("CARGO_MANIFEST_DIR"));
        let Ok(bytes) = std::fs::read(path) else { continue };
        let parsed = parse(&bytes).map_err(|e| e.to_string()).unwrap();
        assert_eq!(parsed.notices, vec![]);
        let again = parse(bindpose::format::write(&parsed.document).as_bytes()).unwrap();
        assert_eq!(again.document, parsed.document);
        println!("{file} {:?}", parsed.document.dialect);
    }
}
