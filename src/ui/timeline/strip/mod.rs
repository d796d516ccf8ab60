//! The bar below the view: transport, time, clips, and what is set about playing.

pub(in crate::ui) mod bar;
pub(in crate::ui) mod clips;
pub(in crate::ui) mod controls;
pub(in crate::ui) mod options;
pub(in crate::ui) mod transport;
pub(in crate::ui) mod typed;
