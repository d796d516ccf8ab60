//! The books, and what their demos are made for.

use crate::modes::modes;

/// The clip that the demos play.
pub const DEMO_CLIP: &str = "Take1";

/// Bones that the demos' shaders have room for.
pub const MOST_BONES: usize = 96;

/// Vertices that 16-bit indices name.
pub const MOST_VERTICES: usize = 1 << 16;

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
