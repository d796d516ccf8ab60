//! What is seen where a loop begins again, in words.

use super::super::wording::measured;
use crate::anim::LoopMode;
use crate::session::Session;

/// The seam of the clip on show in words: when it is seen, and the whole clip plays in a loop.
pub(super) fn words(session: &Session) -> Option<String> {
    let playback = session.playback();
    if playback.loop_mode() != LoopMode::Loop || playback.range_secs().is_some() {
        return None;
    }
    let seam = session.open_model()?.seam(session.clip_index()?)?;
    let worst = seam.worst.filter(|_| seam.visible)?;
    let jump = seam.joints.get(worst.index())?;
    let numbers = [
        (jump.rotation_degrees >= 0.05).then(|| format!("turns by {:.1}°", jump.rotation_degrees)),
        (jump.translation > 0.0).then(|| format!("moves by {}", measured(jump.translation))),
        (jump.scale >= 5e-4).then(|| format!("scales by {:.1} %", jump.scale * 100.0)),
    ];
    let numbers: Vec<String> = numbers.into_iter().flatten().collect();
    Some(format!(
        "The loop's seam is seen: {} {} from the last pose to the first",
        session.joint_label(worst),
        numbers.join(", "),
    ))
}
