//! What the figure is built of: solids with real bevels, each of one material.

mod loft;
mod plate;
mod solid;
mod tube;

pub(crate) use loft::{COARSE, FINE, Frame, Loft, Ring, bevelled, ring, shell, smooth};
pub(crate) use plate::{Plate, block, rectangle, tile};
pub(crate) use solid::{Binding, Grid, POSITION_DECIMALS, Solid};
pub(crate) use tube::tube;
