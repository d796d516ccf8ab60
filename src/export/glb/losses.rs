//! What glTF does not hold.

use std::collections::{BTreeSet, HashSet};

use super::animation::has_keys;
use super::skeleton::is_unweighted;
use crate::diagnostic::collect::named;
use crate::export::losses::Losses;
use crate::export::{Loss, MapImages};
use crate::model::{Clip, MapSlot, Model, Sampling};

/// The cosine between two axes up to which they are square to each other but for rounding.
const SQUARE: f32 = 1e-5;

/// What a `.glb` file does not hold of a model, or holds otherwise. Maps that are there and cannot be read, `unreadable`, are not missing.
pub fn glb_losses(model: &Model, maps: &MapImages<'_>, unreadable: &BTreeSet<(usize, MapSlot)>) -> Vec<Loss> {
    let mut losses = Losses::default();
    let mesh = &model.mesh;
    let undrawn = mesh.triangle_count() - model.triangles_of(|_| true).count();
    losses.count(
        "triangles-undrawn",
        undrawn,
        ["triangle is", "triangles are"],
        "left out, since no subset draws them.",
    );
    let empty = mesh
        .submeshes
        .iter()
        .filter(|submesh| submesh.triangle_count == 0)
        .count();
    losses.count(
        "subsets-empty",
        empty,
        ["subset is", "subsets are"],
        "left out, which have no triangles.",
    );
    let unweighted = mesh
        .influences
        .iter()
        .filter(|influences| is_unweighted(influences))
        .count();
    losses.count(
        "vertices-unweighted",
        unweighted,
        ["vertex is", "vertices are"],
        "moved by no bone; a joint that stands still is added to hold them.",
    );
    let names = |is: &dyn Fn(&Clip) -> bool| -> Vec<&str> {
        let clips = model.clips.iter().filter(|clip| is(clip));
        clips.map(|clip| clip.name.as_str()).collect()
    };
    let early = names(&|clip| has_keys(clip) && clip.start_secs < 0.0);
    losses.count(
        "negative-times",
        early.len(),
        ["clip begins", "clips begin"],
        &format!(
            "before 0 s, where glTF has no time, and moved to begin there: {}.",
            named(early)
        ),
    );
    let still = names(&|clip| !has_keys(clip));
    losses.count(
        "clips-without-keys",
        still.len(),
        ["clip is", "clips are"],
        &format!("left out for having no keys: {}.", named(still)),
    );
    // A picture that several materials name is one.
    let missing: HashSet<&str> = (0..)
        .zip(&model.materials)
        .flat_map(|(index, material)| {
            MapSlot::ALL
                .into_iter()
                .filter_map(move |slot| Some(((index, slot), material.map_name(slot)?)))
        })
        .filter(|(place, _)| !maps.contains_key(place) && !unreadable.contains(place))
        .map(|(_, name)| name)
        .collect();
    let mut missing: Vec<&str> = missing.into_iter().collect();
    missing.sort_unstable();
    losses.count(
        "maps-missing",
        missing.len(),
        ["map is", "maps are"],
        &format!("left out, since there is no picture: {}.", named(missing)),
    );
    let named = model
        .materials
        .iter()
        .flat_map(|material| MapSlot::ALL.map(|slot| material.map(slot)));
    let sheared = named.flatten().filter(|map| is_sheared(&map.sampling)).count();
    losses.count(
        "texture-shear",
        sheared,
        ["map shears", "maps shear"],
        "texture coordinates, which glTF's transform cannot say; the rest of it is kept.",
    );
    losses.0
}

/// Whether the axes of a transform of texture coordinates are not square to each other.
fn is_sheared(sampling: &Sampling) -> bool {
    let [x, y] = [
        sampling.map_from_mesh.matrix2.x_axis,
        sampling.map_from_mesh.matrix2.y_axis,
    ];
    x.dot(y).abs() > SQUARE * x.length() * y.length()
}
