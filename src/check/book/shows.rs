//! What one sees when a book's demo shows what its loader made of a file.

use super::demo::{Book, DEMO_CLIP};
use super::limits::unreadable_map;
use super::loader::{Counts, Reading};
use super::outcome::Outcome;
use crate::diagnostic::Entry;
use crate::diagnostic::limits::{MOST_BONES, MOST_MATERIAL_VIEWS};

/// What one sees of a file with which the demo does not end, in a sentence.
pub(super) fn shows(reading: &Reading) -> String {
    let Reading {
        document,
        counts,
        stop,
        mistake,
        ..
    } = reading;
    let stopped_at = stop.as_ref().filter(|_| !is_complete(reading)).map(|stop| stop.entry);
    match stopped_at {
        // With the first two the demo has ended.
        Some(Entry::Header | Entry::Material(_) | Entry::Subset(_) | Entry::Vertex(_) | Entry::Tangent(_)) => {
            "Nothing: all corners of all triangles are the first vertex.".to_owned()
        }
        Some(Entry::Triangle(read)) => {
            format!("Only the first {read} of {} triangles.", counts.triangles)
        }
        Some(Entry::Key { bone, .. } | Entry::Track { bone, .. }) => {
            format!("The model, but bone {bone} moves wrongly: its keys end in zeros.")
        }
        Some(Entry::Offset(_) | Entry::Bone(_) | Entry::Clip(_)) => {
            format!("The model in \"{DEMO_CLIP}\"; other clips are missing.")
        }
        None => match mistake.as_ref().map(|mistake| mistake.entry) {
            Some(Entry::Material(material)) => {
                format!("The model, but material {material} has values that belong elsewhere.")
            }
            Some(_) => "A torn model: values are taken for others.".to_owned(),
            None if counts.materials == 0 => "Nothing: without a material nothing is drawn.".to_owned(),
            None if document.clips.is_empty() => "The model.".to_owned(),
            None => format!("The model in \"{DEMO_CLIP}\"."),
        },
    }
}

/// Whether all that the header counts was read. Only braces can be missing then.
pub(super) fn is_complete(reading: &Reading) -> bool {
    let Reading { document, counts, .. } = reading;
    let Counts {
        materials,
        vertices,
        triangles,
        bones,
        clips,
    } = *counts;
    let has = |list: usize, count: u32| list == count as usize;
    let header_was_read = !matches!(&reading.stop, Some(stop) if stop.entry == Entry::Header);
    let is_skinned = bones > 0;
    header_was_read
        && has(document.materials.len(), materials)
        && has(document.subsets.len(), materials)
        && has(reading.vertices, vertices)
        && has(reading.triangles, triangles)
        && has(document.bone_offsets.len(), bones)
        && has(document.bone_parents.len(), bones)
        && (!is_skinned || has(document.clips.len(), clips))
        && document.clips.iter().all(|clip| has(clip.bones.len(), bones))
}

/// How the demo ends before it shows anything, if it does: what comes first. It makes its buffers, opens the maps, makes the views of them,
/// and then asks for the clip in its first frame. A map that is missing may still come.
pub(super) fn ends(book: Book, reading: &Reading) -> Option<(Outcome, String)> {
    let Reading {
        document, counts, stop, ..
    } = reading;
    let error = |why: &str| Some((Outcome::EndsWithError, format!("It ends with an error: {why}.")));
    let crash = |why: &str| Some((Outcome::Crashes, format!("It crashes at its first frame: {why}.")));
    if counts.vertices == 0 || counts.triangles == 0 {
        return error("a buffer without bytes cannot be made");
    }
    let bytes = u64::from(counts.vertices) * bytes_per_vertex(book);
    if bytes > MOST_BYTES {
        let gigabytes = bytes >> 30;
        return error(&format!(
            "it asks for {gigabytes} GB for the vertices that the header counts"
        ));
    }
    if let Some(Entry::Header | Entry::Material(_)) = stop.as_ref().map(|stop| stop.entry) {
        return error("it looks for a map without a name");
    }
    if let Some((_, name)) = unreadable_map(book, document) {
        return error(&format!("\"{name}\" is no picture that it reads"));
    }
    let too_many = |count: usize, what: &str, most: usize| {
        let words = format!("It has room for {most} {what} and writes {count}: it crashes or draws garbage.");
        (count > most).then_some((Outcome::Crashes, words))
    };
    let views = too_many(document.materials.len(), "pairs of maps", MOST_MATERIAL_VIEWS);
    if let Some(views) = views.filter(|_| book == Book::D3d12) {
        return Some(views);
    }
    if counts.bones == 0 {
        return None;
    }
    // Of clips of one name the last one stays.
    let Some(clip) = document.clips.iter().rposition(|clip| clip.name == DEMO_CLIP) else {
        return crash(&format!("there is no clip \"{DEMO_CLIP}\""));
    };
    let read = &document.clips[clip].bones;
    // The keys of the bone in which reading stopped are there, as zeros.
    let in_keys =
        matches!(stop.as_ref().map(|stop| stop.entry), Some(Entry::Key { .. })) && clip + 1 == document.clips.len();
    let there = read.len() + usize::from(in_keys);
    let empty = read.iter().position(|bone| bone.keyframes.is_empty());
    if let Some(bone) = empty.or((there < counts.bones as usize).then_some(there)) {
        return crash(&format!("bone {bone} has no keys in \"{DEMO_CLIP}\""));
    }
    too_many(counts.bones as usize, "matrices of bones", MOST_BONES)
}

/// More than this a program does not get.
const MOST_BYTES: u64 = 16 << 30;

fn bytes_per_vertex(book: Book) -> u64 {
    match book {
        Book::D3d11 => 64,
        Book::D3d12 => 60,
    }
}
