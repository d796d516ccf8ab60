//! Where in the file a finding about a part of the model leads.

use std::collections::HashSet;

use bindpose::anim::CompiledClip;
use bindpose::check;
use bindpose::diagnostic::Position;
use bindpose::fbx::{Place, Record, parse};
use bindpose::import::import;

use super::files;

/// The places of a record and of all in it.
fn places_in(record: &Record<'_>, places: &mut HashSet<Place>) {
    places.insert(record.place);
    record.records.iter().for_each(|child| places_in(child, places));
}

#[test]
fn each_finding_about_a_part_of_a_real_file_leads_to_a_record() {
    let (mut offsets, mut lines) = (0, 0);
    for (name, bytes) in files("files").into_iter().chain(files("mixamo")) {
        let (Ok(document), Ok(imported)) = (parse(&bytes), import(&bytes)) else {
            continue;
        };
        let mut records = HashSet::new();
        let roots = ["Objects", "Takes"].into_iter().filter_map(|name| document.find(name));
        roots.for_each(|root| places_in(root, &mut records));
        let model = &imported.model;
        for finding in check::model(
            model,
            &CompiledClip::all(&model.clips),
            &*imported.source.places(&bytes),
        ) {
            if finding.subject.is_none() {
                continue;
            }
            let is_there = match (finding.byte_offset, finding.position) {
                (Some(offset), None) => records.contains(&Place::Offset(offset)),
                (None, Some(Position { line, .. })) => {
                    let is_on = |place: &Place| matches!(place, Place::At(position) if position.line == line);
                    records.iter().any(is_on)
                }
                _ => false,
            };
            assert!(is_there, "{name}: {finding:?}");
            offsets += usize::from(finding.byte_offset.is_some());
            lines += usize::from(finding.position.is_some());
        }
    }
    assert!(offsets > 2 && lines > 2, "{offsets} and {lines}");
}
