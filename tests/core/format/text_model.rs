//! `car.txt` and its like: positions, normals and triangles.

use bindpose::diagnostic::codes;
use bindpose::format::{Dialect, begins_like_model, parse, write};
use bindpose::import;

use crate::documents::shared_bytes;

const TRIANGLE: &str = "VertexCount: 3\nTriangleCount: 1\nVertexList (pos, normal)\n{\n\t0 0 0 0 0 -1\n\t0 1 0 0 0 -1\n\t1 0 0 0 0 -1\n}\nTriangleList\n{\n\t0 1 2\n}\n";

#[test]
fn a_text_model_is_read_and_written_as_it_was() {
    let parsed = parse(TRIANGLE.as_bytes()).expect("it is sound");
    let document = &parsed.document;
    assert_eq!((document.dialect, document.vertices.len()), (Dialect::Text, 3));
    assert_eq!(document.vertices[1].position, [0.0, 1.0, 0.0]);
    assert_eq!(document.vertices[1].normal, [0.0, 0.0, -1.0]);
    assert_eq!(document.triangles, [[0, 1, 2]]);
    assert_eq!(
        (parsed.lines.vertices, parsed.lines.triangles),
        (vec![5, 6, 7], vec![11])
    );
    assert!(parsed.diagnostics.is_empty(), "{:?}", parsed.diagnostics);
    assert_eq!(write(document), TRIANGLE);
    let imported = import::import(TRIANGLE.as_bytes()).expect("a model");
    assert!(imported.diagnostics.is_empty(), "{:?}", imported.diagnostics);
    assert_eq!(imported.source.format.as_str(), "txt");
    let model = imported.model;
    assert_eq!((model.mesh.vertex_count(), model.mesh.triangle_count()), (3, 1));
    assert!(model.mesh.tangents.is_empty() && model.clips.is_empty());
}

#[test]
fn it_is_known_by_its_first_line() {
    for text in [TRIANGLE, "\u{feff}\n  vertexcount : 4\n", "VERTEXCOUNT:3"] {
        assert!(begins_like_model(text.as_bytes()), "{text}");
    }
    for text in ["Notes\nVertexCount: 3\n", "vertices: 3", ""] {
        assert!(!begins_like_model(text.as_bytes()), "{text}");
    }
}

#[test]
fn odd_spellings_are_read() {
    let odd = "vertexcount 3\r\nTriangleCount : 1\r\n\r\nVertexList (pos, normal) {\r\n0 0 0 0 0 -1\r\n0 1,0 0 0 0 -1\r\n1 0 0\r\n0 0 -1\r\n}\r\nTriangleList\r\n{\r\n0, 1, 2\r\n}\r\n";
    let parsed = parse(odd.as_bytes()).expect("it is mended");
    assert_eq!(parsed.document, parse(TRIANGLE.as_bytes()).expect("sound").document);
    let codes: Vec<_> = parsed.diagnostics.iter().map(|diagnostic| diagnostic.code).collect();
    assert_eq!(codes, [codes::NUMBER_MENDED.name, codes::ROW_SPLIT.name]);
}

/// The code, the place and what was found of a damaged file.
#[track_caller]
fn refused(from: &str, to: &str) -> (&'static str, Option<(u32, u32)>, Option<String>) {
    assert!(TRIANGLE.contains(from), "{from}");
    let fault = parse(TRIANGLE.replacen(from, to, 1).as_bytes()).expect_err(to);
    let place = fault.position.map(|position| (position.line, position.column));
    (fault.code, place, fault.found)
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    let found = |text: &str| Some(text.to_owned());
    assert_eq!(refused("0 1 2", "0 1 3"), ("not-in-range", Some((11, 6)), found("3")));
    assert_eq!(
        refused("VertexCount: 3", "VertexCount: 4"),
        ("row-count", Some((1, 14)), found("3 vertices"))
    );
    assert_eq!(
        refused("VertexCount: 3", "VertexCount: 2"),
        ("row-count", Some((1, 14)), found("3 vertices"))
    );
    assert_eq!(
        refused("TriangleCount: 1", "TriangleCount: 2"),
        ("row-count", Some((2, 16)), found("1 triangle"))
    );
    assert_eq!(
        refused("TriangleCount: 1", "TriangleCount: 4294967295"),
        ("row-count", Some((2, 16)), found("1 triangle"))
    );
    assert_eq!(
        refused("\t0 1 0 0 0 -1", "\t0 one 0 0 0 -1"),
        ("not-a-number", Some((6, 4)), found("one"))
    );
    assert_eq!(
        refused("TriangleList", "Triangles"),
        ("wrong-label", Some((9, 1)), found("Triangles"))
    );
    assert_eq!(refused("TriangleList\n{\n\t0 1 2\n}\n", "").0, "unexpected-end");
    assert_eq!(refused("\t1 0 0 0 0 -1\n}", "\t1 0 0").0, "value-missing");
}

#[test]
fn every_beginning_of_a_file_is_an_answer() {
    for len in 0..TRIANGLE.len() {
        let _ = parse(&TRIANGLE.as_bytes()[..len]);
    }
}

#[test]
fn the_books_own_models_are_read() {
    for (name, vertices, triangles) in [("car.txt", 1860, 1850), ("skull.txt", 31_076, 60_339)] {
        let Some(bytes) = shared_bytes(&format!("models/text/{name}")) else {
            continue;
        };
        let imported = import::import(&bytes).expect("a model");
        assert_eq!(
            (imported.model.mesh.vertex_count(), imported.model.mesh.triangle_count()),
            (vertices, triangles)
        );
        assert!(
            imported
                .diagnostics
                .iter()
                .all(|diagnostic| diagnostic.code != "no-subsets"),
            "{name}"
        );
        let parsed = parse(&bytes).expect("sound");
        assert_eq!(
            parse(write(&parsed.document).as_bytes()).expect("sound").document,
            parsed.document
        );
    }
}
