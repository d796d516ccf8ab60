//! What the programs of the books have room for. Whoever tells of these limits takes them from here.

/// Bones that the shaders of both books' demos hold.
pub const MOST_BONES: usize = 96;

/// The highest bone that an influence can name: the loaders keep it in a byte.
pub const MOST_BONE_INDEX: u32 = 255;

/// Vertices that the 16-bit indices of both demos can number.
pub const MOST_VERTICES: usize = 1 << 16;

/// Materials whose maps the shader of the D3D12 book's demo can reach: its array has 48 textures, of which six are the scene's own and two
/// each material's.
pub const MOST_MATERIALS: usize = (48 - 6) / 2;

/// Materials of which the same demo can keep the views: it has room for 64, of which 16 are its own and two each material's.
pub const MOST_MATERIAL_VIEWS: usize = (64 - 16) / 2;
