//! What is found about files that people made, and about the project's own figure.

use bindpose::diagnostic::Subject;

use crate::documents::{REAL_FILES, checked, figure, real_file};

#[test]
fn the_books_files_have_no_findings_but_ten_triangles_of_the_soldier() {
    for name in REAL_FILES {
        let Some(parsed) = real_file(name) else { continue };
        let (_, findings) = checked(&parsed.document, &parsed.lines);
        let codes: Vec<_> = findings.iter().map(|finding| (finding.code, finding.count)).collect();
        if name != "d3d12/soldier" {
            assert_eq!(codes, [], "{name}");
            continue;
        }
        assert_eq!(codes, [("tangents-missing", 3), ("triangles-without-area", 10)]);
        let subjects = findings[1].subjects.iter();
        for subject in subjects {
            let Subject::Triangle(triangle) = *subject else {
                panic!("a triangle")
            };
            let corners = parsed.document.triangles[triangle as usize];
            let [a, b, c] = corners.map(|vertex| glam::Vec3::from(parsed.document.vertices[vertex as usize].position));
            let [a, b, c] = [a, b, c].map(|corner| corner.as_dvec3());
            // The soldier is 75 units high.
            let height = (b - a).cross(c - a).length() / (b - a).length().max((c - a).length()).max((c - b).length());
            assert!(height < 1e-5, "{triangle}: {height}");
        }
    }
}

#[test]
fn nothing_is_found_about_the_figure() {
    let parsed = figure();
    assert_eq!(checked(&parsed.document, &parsed.lines).1, []);
}
