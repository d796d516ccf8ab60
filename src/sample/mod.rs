//! The sample: a figure that the project makes itself, so that there is something to see before a file was dropped.
//!
//! ```text
//! rig -> volumes -> body -> skin (surface nets, relaxed, snapped) -> weights, charts -> Document
//!    \-> motion (poses, two-bone legs) -> clips                                        /
//! maps (reliefs: cloth, moulded panels, grip, visor) -> texels
//! ```
//!
//! The same document on every machine: the topology depends on + − × ÷ √ alone, which IEEE 754 fixes; sines and arc tangents
//! appear in texture coordinates and clips only, in f64, and all numbers are rounded to few decimals before they are stored.
//! A sine that differs in its last bit between systems could still flip the last decimal of a rare number. Maps need no sine:
//! their bytes are the same everywhere.

mod assemble;
mod body;
mod charts;
mod lattice;
mod maps;
mod materials;
mod motion;
mod rig;
mod sdf;
mod skin;
mod surface_nets;
mod texcoords;
mod volumes;
mod weights;

use crate::format::Document;

pub use maps::{SampleMap, maps};

/// The sample figure: left-handed, y up, 1.8 m tall, standing on y = 0 and facing −z, with the clips `Walk`, `Run`, `Wave`
/// and `Idle` at 30 keys a second, each of which loops.
pub fn figure() -> Document {
    let rig = rig::Rig::new();
    let body = body::Body::new(&rig);
    let skin = skin::Skin::new(&body, &rig);
    let influences = weights::influences(&skin, &body, &rig);
    assemble::document(&skin, &influences, &rig, motion::clips(&rig))
}
