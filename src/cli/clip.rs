//! Which clip is meant.

use std::path::Path;

use super::failure::Failure;
use crate::model::Model;

/// The index of the named clip; of the only one when none is named. A model without clips has none to name.
pub(super) fn choose(model: &Model, path: &Path, asked: Option<&str>) -> Result<Option<usize>, Failure> {
    let known = || model.clips.iter().map(|clip| clip.name.clone()).collect();
    match (asked, model.clips.len()) {
        (Some(asked), _) => {
            let index = model.clips.iter().position(|clip| clip.name == asked);
            index.map(Some).ok_or_else(|| Failure::UnknownClip {
                path: path.to_owned(),
                asked: asked.to_owned(),
                known: known(),
            })
        }
        (None, 0) => Ok(None),
        (None, 1) => Ok(Some(0)),
        (None, _) => Err(Failure::ClipNotNamed {
            path: path.to_owned(),
            known: known(),
        }),
    }
}

/// Seconds of a clip, as an argument.
pub(super) fn seconds(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(time_secs) if time_secs.is_finite() => Ok(time_secs),
        _ => Err("a time is a number of seconds".into()),
    }
}
