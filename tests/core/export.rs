//! Models as files.

mod m3d;
