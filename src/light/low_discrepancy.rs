//! Points that cover a square evenly.

/// Point `index` of `count` of the Hammersley set, 0 … 1 both ways, each in the middle of its stratum.
pub(super) fn hammersley(index: u32, count: u32) -> (f32, f32) {
    // The radical inverse in base 2; 24 bits are exact in f32.
    let inverse = (index.reverse_bits() >> 8) as f32 / (1u32 << 24) as f32;
    ((index as f32 + 0.5) / count as f32, inverse)
}
