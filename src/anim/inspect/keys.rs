//! The keys of a track as rows of a table.

use std::fmt::Write;

use super::parts::TransformParts;
use crate::model::{Clip, Track};

/// One key.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeyRow {
    /// Its number in the track, from 0.
    pub key: usize,
    /// Its time in the clip's own seconds.
    pub time_secs: f32,
    /// The frame of the clip that is nearest to it.
    pub frame: u32,
    /// Relative to the parent.
    pub parts: TransformParts,
}

/// The keys of a track of a clip, in order.
pub fn key_rows<'a>(clip: &'a Clip, track: &'a Track) -> impl ExactSizeIterator<Item = KeyRow> + 'a {
    let times = track.times_secs().iter().enumerate();
    times.map(|(key, &time_secs)| KeyRow {
        key,
        time_secs,
        frame: clip.frame_at(time_secs),
        parts: TransformParts::of_joint(&track.key(key)),
    })
}

/// The keys as text with tabs between the columns and a line of names above them, as spreadsheets take it.
pub fn key_table(clip: &Clip, track: &Track) -> String {
    let mut text = String::from(
        "key\tframe\ttime (s)\tx\ty\tz\tEuler x (deg)\tEuler y (deg)\tEuler z (deg)\tquaternion x\tquaternion y\t\
         quaternion z\tquaternion w\tscale x\tscale y\tscale z\n",
    );
    for row in key_rows(clip, track) {
        let TransformParts {
            position,
            rotation,
            euler_xyz_degrees,
            scale,
            ..
        } = row.parts;
        // Writing into a String cannot fail.
        let _ = write!(text, "{}\t{}\t{}", row.key, row.frame, row.time_secs);
        let vectors = [position.to_array(), euler_xyz_degrees.to_array()];
        for number in vectors
            .into_iter()
            .flatten()
            .chain(rotation.to_array())
            .chain(scale.to_array())
        {
            let _ = write!(text, "\t{number}");
        }
        text.push('\n');
    }
    text
}
