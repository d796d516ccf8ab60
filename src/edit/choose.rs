//! Keeps some of the clips.

use std::collections::HashSet;

use super::edited::{Change, Edited, counted};
use super::error::EditError;

/// Keeps the clips of these names, in the model's order.
pub(super) fn choose_clips(edited: &mut Edited, names: &[String]) -> Result<(), EditError> {
    let clips = &mut edited.model.clips;
    let there: HashSet<&str> = clips.iter().map(|clip| clip.name.as_str()).collect();
    if let Some(asked) = names.iter().find(|name| !there.contains(name.as_str())) {
        return Err(EditError::no_clip(asked, clips));
    }
    let before = clips.len();
    let wanted: HashSet<&str> = names.iter().map(String::as_str).collect();
    clips.retain(|clip| wanted.contains(clip.name.as_str()));
    let left_out = before - clips.len();
    if left_out > 0 {
        edited.changes.push(Change::new(
            "clips-chosen",
            format!("{} left out.", counted(left_out, "clip is", "clips are")),
        ));
    }
    Ok(())
}
