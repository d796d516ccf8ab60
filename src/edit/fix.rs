//! Mends what check names and can be mended without a choice. Each change has the code of the finding.

use glam::{Vec2, Vec3, Vec4};

use super::edited::{Change, Edited, with_tracks};
use crate::check::{flat_triangles, is_still, repeated_triangles, surplus_keys, tangents_against, used_vertices};
use crate::diagnostic::{Code, codes};
use crate::model::{Clip, Influences, Mesh, Track};

/// Leaves out triangles without area and those that repeat another one, and vertices that no triangle uses; turns signs of tangents
/// round that contradict the texture coordinates; leaves one key to bones that keep still.
pub(super) fn fix(edited: &mut Edited) {
    let model = &mut edited.model;
    let mut mended = |code: &Code, count: usize, words: [&str; 2], rest: &str| {
        edited.changes.extend(Change::counted(code.name, count, words, rest));
    };
    let flat: Vec<u32> = flat_triangles(&model.mesh).collect();
    leave_triangles_out(&mut model.mesh, &flat);
    mended(
        &codes::TRIANGLES_WITHOUT_AREA,
        flat.len(),
        ["triangle is", "triangles are"],
        "left out that had no area.",
    );
    let repeated = repeated(&model.mesh);
    leave_triangles_out(&mut model.mesh, &repeated);
    mended(
        &codes::TRIANGLES_REPEATED,
        repeated.len(),
        ["triangle is", "triangles are"],
        "left out that lay on another one of the same vertices.",
    );
    let unused = leave_unused_vertices_out(&mut model.mesh);
    mended(
        &codes::VERTICES_UNUSED,
        unused,
        ["vertex is", "vertices are"],
        "left out that no triangle used.",
    );
    let against: Vec<u32> = tangents_against(model).collect();
    for &vertex in &against {
        model.mesh.tangents[vertex as usize].w *= -1.0;
    }
    mended(
        &codes::TANGENT_SIGN_AGAINST_UV,
        against.len(),
        ["tangent has", "tangents have"],
        "another sign, as the texture coordinates ask for.",
    );
    for clip in &mut model.clips {
        if surplus_keys(clip).is_some() {
            let before = clip.key_count;
            *clip = without_still_keys(clip);
            let left_out = before - clip.key_count;
            mended(
                &codes::KEYS_ALL_EQUAL,
                left_out,
                ["key is", "keys are"],
                &format!("left out of \"{}\", of bones that keep still.", clip.name),
            );
        }
    }
}

/// Triangles that have the vertices of one before and wind as it does. One that winds the other way may be its back.
fn repeated(mesh: &Mesh) -> Vec<u32> {
    let (corners, _) = mesh.indices.as_chunks::<3>();
    // The same corners in a circle, from the least on.
    let winding = |triangle: u32| {
        let mut corners = corners[triangle as usize];
        let least = (0..3).min_by_key(|&place| corners[place]).unwrap_or_default();
        corners.rotate_left(least);
        corners
    };
    let mut left_out = Vec::new();
    let mut group: Vec<[u32; 3]> = Vec::new();
    let mut last = None;
    for (before, triangle) in repeated_triangles(mesh) {
        if last != Some(before) {
            group.clear();
            group.push(winding(before));
        }
        last = Some(triangle);
        let winding = winding(triangle);
        if group.contains(&winding) {
            left_out.push(triangle);
        } else {
            group.push(winding);
        }
    }
    left_out.sort_unstable();
    left_out
}

/// Leaves triangles out, given in their order; submeshes keep the others of theirs.
fn leave_triangles_out(mesh: &mut Mesh, left_out: &[u32]) {
    if left_out.is_empty() {
        return;
    }
    let before = |triangle: u32| left_out.partition_point(|&out| out < triangle) as u32;
    for submesh in &mut mesh.submeshes {
        let end = submesh.triangle_start + submesh.triangle_count;
        let [start, end] = [submesh.triangle_start, end].map(|triangle| triangle - before(triangle));
        (submesh.triangle_start, submesh.triangle_count) = (start, end - start);
    }
    let mut triangle = 0_u32;
    let mut next = left_out.iter().peekable();
    let mut corner = 0;
    mesh.indices.retain(|_| {
        let is_out = next.peek() == Some(&&triangle);
        corner += 1;
        if corner == 3 {
            next.next_if_eq(&&triangle);
            (corner, triangle) = (0, triangle + 1);
        }
        !is_out
    });
}

/// Leaves out vertices that no triangle uses. How many.
fn leave_unused_vertices_out(mesh: &mut Mesh) -> usize {
    let used = used_vertices(mesh);
    let unused = used.iter().filter(|used| !**used).count();
    if unused == 0 {
        return 0;
    }
    let mut places = Vec::with_capacity(used.len());
    let mut next = 0_u32;
    for &used in &used {
        places.push(next);
        next += u32::from(used);
    }
    for vertex in &mut mesh.indices {
        *vertex = places[*vertex as usize];
    }
    fn keep<T>(stream: &mut Vec<T>, used: &[bool]) {
        let mut used = used.iter();
        // A stream that the mesh does without is empty.
        stream.retain(|_| used.next().copied().unwrap_or_default());
    }
    keep::<Vec3>(&mut mesh.positions, &used);
    keep::<Vec3>(&mut mesh.normals, &used);
    keep::<Vec4>(&mut mesh.tangents, &used);
    keep::<Vec2>(&mut mesh.tex_coords, &used);
    keep::<Vec2>(&mut mesh.second_tex_coords, &used);
    keep::<Vec4>(&mut mesh.colors, &used);
    keep::<Influences>(&mut mesh.influences, &used);
    unused
}

/// One key for each bone that keeps still; where the clip's length would be lost with the others, one bone keeps its first and last.
fn without_still_keys(clip: &Clip) -> Clip {
    let still = |track: &Track| {
        if !is_still(track) {
            return track.clone();
        }
        let first = (track.start_secs(), track.key(0));
        Track::new([first]).unwrap_or_else(|_| track.clone())
    };
    let mut tracks: Vec<Track> = clip.tracks.iter().map(still).collect();
    for end_secs in [clip.start_secs, clip.end_secs] {
        let reaches =
            |track: &Track| track.has_keys() && (track.start_secs() == end_secs || track.end_secs() == end_secs);
        if tracks.iter().any(reaches) {
            continue;
        }
        if let Some(place) = clip.tracks.iter().position(reaches) {
            let old = &clip.tracks[place];
            let ends = [0, old.key_count() - 1].map(|key| (old.times_secs()[key], old.key(key)));
            tracks[place] = Track::new(ends).unwrap_or_else(|_| old.clone());
        }
    }
    with_tracks(clip, tracks)
}
