//! Thousands of things alike: one finding, and work in proportion.

use bindpose::diagnostic::{Diagnostic, Moment, Position, Subject};
use bindpose::format::{AnimationClip, ClipLines, Document, LineMap, Subset};
use bindpose::import::m3d;

use crate::documents::{arm, key, material, quad, read, subset, track};

/// The findings of a code.
fn findings(document: &Document, lines: &LineMap, code: &str) -> Vec<Diagnostic> {
    let (_, findings) = read(document, lines);
    findings.into_iter().filter(|finding| finding.code == code).collect()
}

/// A clip without bones for each of the lines 10, 20, 30 …, all of one name.
fn clips(count: u32) -> (Document, LineMap) {
    let document = Document {
        clips: vec![
            AnimationClip {
                name: "Walk".into(),
                bones: Vec::new(),
            };
            count as usize
        ],
        ..quad()
    };
    let line = |clip| ClipLines {
        clip: clip * 10,
        ..ClipLines::default()
    };
    let lines = LineMap {
        clips: (1..=count).map(line).collect(),
        ..LineMap::default()
    };
    (document, lines)
}

fn line(line: u32) -> Position {
    Position { line, column: 1 }
}

#[test]
fn a_few_alike_are_told_apart_and_more_become_one() {
    let (document, lines) = clips(5);
    let few = findings(&document, &lines, "duplicate-clip-name");
    let places: Vec<_> = few.iter().map(|finding| finding.position).collect();
    assert_eq!(places, [20, 30, 40, 50].map(|number| Some(line(number))));
    assert!(
        few.iter()
            .all(|finding| finding.count == 1 && finding.places.len() == 1)
    );

    let (document, lines) = clips(6);
    let [one] = findings(&document, &lines, "duplicate-clip-name")
        .try_into()
        .expect("one finding");
    assert_eq!((one.count, one.position), (5, Some(line(20))));
    assert_eq!(one.places, [20, 30, 40, 50, 60].map(line));
    assert_eq!(one.subjects, [1, 2, 3, 4, 5].map(Subject::Clip));
    assert_eq!(one.subject, Some(Subject::Clip(1)));
    assert_eq!(
        one.message,
        "Another clip has the same name; this one is shown as \"Walk (2)\". The same holds for 4 more clips."
    );
}

#[test]
fn rows_that_are_counted_in_one_finding_have_their_first_places() {
    let mut document = arm();
    for vertex in [1, 3, 4, 8, 9] {
        document.vertices[vertex].normal = [0.0; 3];
    }
    let lines = LineMap {
        vertices: (100..).take(document.vertices.len()).collect(),
        ..LineMap::default()
    };
    let [one] = findings(&document, &lines, "normals-missing")
        .try_into()
        .expect("one finding");
    assert_eq!((one.count, one.position), (5, Some(line(103))));
    // The third line of each vertex has its normal.
    assert_eq!(one.places, [103, 105, 106, 110, 111].map(line));
    let expected = [1, 3, 4, 8, 9].map(|vertex| {
        (
            Some(Subject::Vertex(vertex)),
            Some(line(102 + vertex)),
            Moment::default(),
        )
    });
    assert_eq!(one.occurrences().collect::<Vec<_>>(), expected);
    assert_eq!(one.few_places(), [103, 105, 106, 110].map(line));
}

#[test]
fn of_very_many_the_first_twenty_are_known() {
    let (document, lines) = clips(101);
    let [one] = findings(&document, &lines, "duplicate-clip-name")
        .try_into()
        .expect("one finding");
    assert_eq!((one.count, one.places.len(), one.subjects.len()), (100, 20, 20));
}

/// Names are made unique by looking at each of them once: with a search of all others this would take minutes.
#[test]
fn many_names_alike_are_shown_as_different_ones() {
    let count = 200_000;
    let document = Document {
        materials: vec![material("skin"); count],
        subsets: vec![subset(0, 2)],
        ..quad()
    };
    let (model, _) = m3d::from_document(&document, &LineMap::default()).expect("the document is sound");
    let names: std::collections::HashSet<_> = model.materials.iter().map(|material| &material.name).collect();
    assert_eq!(names.len(), count);
    assert_eq!(
        findings(&document, &LineMap::default(), "duplicate-material-name").len(),
        1
    );
}

/// Each subset asks for all triangles. With a look at each of them this would be 20 000 million looks.
#[test]
fn subsets_over_the_same_triangles_are_looked_at_once() {
    let mut document = quad();
    document.triangles = document.triangles.repeat(100_000);
    let all = Subset {
        vertex_start: 1,
        vertex_count: 3,
        ..subset(0, 200_000)
    };
    document.subsets = vec![all; 100_000];
    assert_eq!(findings(&document, &LineMap::default(), "indices-look-relative"), []);
}

/// The highest index of a range, at every range of a few triangles.
#[test]
fn relative_indices_are_found_in_every_range() {
    for count in 1..=9_usize {
        for start in 0..count {
            for end in start + 1..=count {
                let mut document = quad();
                document.vertices = vec![document.vertices[0]; 40];
                // Triangle i names 2 + i at most; the range is one of a loader that adds VertexStart.
                document.triangles = (0..count as u32).map(|index| [0, 1, 2 + index]).collect();
                document.subsets = vec![Subset {
                    vertex_start: 20,
                    vertex_count: 2 + end as u32,
                    ..subset(start as u32, (end - start) as u32)
                }];
                let found = findings(&document, &LineMap::default(), "indices-look-relative");
                assert_eq!(found.len(), 1, "{start}..{end} of {count}");
                document.subsets[0].vertex_count += 1;
                let found = findings(&document, &LineMap::default(), "indices-look-relative");
                assert_eq!(found, [], "{start}..{end} of {count}");
            }
        }
    }
}

#[test]
fn clips_that_fly_apart_are_found_among_thousands() {
    let mut document = arm();
    document.clips[0].bones[1] = track([key(0.0, [20.0, 0.0, 0.0])]);
    document.triangles = document.triangles.repeat(405);
    document.clips = vec![document.clips[0].clone(); 10_000];
    let [one] = findings(&document, &LineMap::default(), "exploded")
        .try_into()
        .expect("one finding");
    assert_eq!(one.count, 10_000);
}
