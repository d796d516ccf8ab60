//! The books, and what their demos are made for.

use crate::modes::modes;

/// The clip that the demos play.
pub const DEMO_CLIP: &str = "Take1";

/// Names of materials that the D3D12 book's demo has itself, for its sky, its columns and box, its floor and its spheres.
pub const DEMO_MATERIALS: [&str; 4] = ["sky", "bricks0", "tile0", "mirror0"];

/// The demos scale their character by this, since their soldier is 72 units high.
pub const DEMO_SCALE: f32 = 0.05;

/// Heights in the demos' units between which a character is seen as a whole and not as a dot: a quarter of the soldier's 3.6 to four times
/// as much. The camera begins 15 units away.
pub const SEEN_HEIGHTS: [f32; 2] = [0.9, 14.4];

modes! {
    /// A book with a loader for the format, and a demo that shows what it reads.
    pub enum Book {
        /// Introduction to 3D Game Programming with DirectX 11.
        D3d11 = "d3d11", "D3D11 demo";
        /// Introduction to 3D Game Programming with DirectX 12.
        D3d12 = "d3d12", "D3D12 demo";
    }
}
