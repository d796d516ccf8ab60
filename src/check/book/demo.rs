//! The books, and what their demos are made for.

use crate::modes::modes;

/// The clip that the demos play.
pub const DEMO_CLIP: &str = "Take1";

/// Bones that the demos' shaders have room for.
pub const MOST_BONES: usize = 96;

modes! {
    /// A book with a loader for the format.
    pub enum Book {
        /// Introduction to 3D Game Programming with DirectX 11.
        D3d11 = "d3d11", "D3D11 book";
        /// Introduction to 3D Game Programming with DirectX 12.
        D3d12 = "d3d12", "D3D12 book";
    }
}
