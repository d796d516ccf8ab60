//! Formats of texels.

/// Texels a side of the largest picture that is read: what the largest GPUs take.
pub const MAX_SIDE: u32 = 16_384;

/// How an [`Image`](super::Image) holds its texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ImageFormat {
    /// Red, green, blue and alpha, 8 bits each.
    Rgba8,
    /// Red, green, blue and alpha as half floats, little-endian, linear.
    Rgba16Float,
    /// Red, green and blue as mantissas, and their exponent, 8 bits each; linear.
    Rgbe,
    /// Colour with one bit of alpha; 8 bytes a block.
    Bc1,
    /// Colour with 4 bits of alpha.
    Bc2,
    /// Colour with interpolated alpha.
    Bc3,
    /// One value; 8 bytes a block.
    Bc4,
    /// One value from −1 to 1; 8 bytes a block.
    Bc4Signed,
    /// Two values.
    Bc5,
    /// Two values from −1 to 1.
    Bc5Signed,
    /// Colour as half floats without sign, linear.
    Bc6h,
    /// Colour as half floats with sign, linear.
    Bc6hSigned,
    /// Colour and alpha, in eight ways.
    Bc7,
}

impl ImageFormat {
    /// Texels a side of a block: 4 for the compressed formats, 1 for the others.
    pub fn block_side(self) -> u32 {
        if self.is_compressed() { 4 } else { 1 }
    }

    /// Bytes of a block.
    pub fn block_len(self) -> usize {
        match self {
            Self::Rgba8 | Self::Rgbe => 4,
            Self::Rgba16Float | Self::Bc1 | Self::Bc4 | Self::Bc4Signed => 8,
            Self::Bc2 | Self::Bc3 | Self::Bc5 | Self::Bc5Signed | Self::Bc6h | Self::Bc6hSigned | Self::Bc7 => 16,
        }
    }

    /// Bytes of a level of this size; blocks that reach over its edge count whole.
    pub fn level_len(self, width: u32, height: u32) -> u64 {
        let side = self.block_side();
        u64::from(width.div_ceil(side)) * u64::from(height.div_ceil(side)) * self.block_len() as u64
    }

    /// Whether texels come in blocks of 4 × 4.
    pub fn is_compressed(self) -> bool {
        !matches!(self, Self::Rgba8 | Self::Rgba16Float | Self::Rgbe)
    }

    /// Whether values are linear light and may exceed 1.
    pub fn is_float(self) -> bool {
        matches!(self, Self::Rgba16Float | Self::Rgbe | Self::Bc6h | Self::Bc6hSigned)
    }

    /// Whether a GPU that samples the blocks gives −1 … 1 where the unsigned formats give 0 … 1.
    pub fn is_signed_unit(self) -> bool {
        matches!(self, Self::Bc4Signed | Self::Bc5Signed)
    }
}

/// Which channels of a picture carry data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Channels {
    /// One value, decoded into red, green and blue alike. A GPU that samples BC4 blocks sees it in red only.
    Grey,
    /// One value and alpha.
    GreyAlpha,
    /// Alpha alone; colour is 0.
    Alpha,
    /// Two values, blue is 0: of a normal map x and y, whose z is to be rebuilt.
    RedGreen,
    /// Colour.
    Rgb,
    /// Colour and alpha.
    Rgba,
}

impl Channels {
    /// How many there are: 1 to 4.
    pub fn count(self) -> u32 {
        match self {
            Self::Grey | Self::Alpha => 1,
            Self::GreyAlpha | Self::RedGreen => 2,
            Self::Rgb => 3,
            Self::Rgba => 4,
        }
    }

    /// Whether alpha is among them. Where it is not, alpha is 1.
    pub fn has_alpha(self) -> bool {
        matches!(self, Self::GreyAlpha | Self::Alpha | Self::Rgba)
    }
}
