//! Uncompressed texels whose channels are given by bit masks.

use super::format::Channels;
use crate::diagnostic::{Fault, codes};
use crate::sorting;

/// Where a channel's bits lie in a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Field {
    mask: u32,
    shift: u32,
    /// Value of all bits set; at least 1.
    max: u32,
}

impl Field {
    /// `None` for an empty mask.
    fn new(channel: &'static str, mask: u32, bits: u32) -> Result<Option<Self>, Fault> {
        if mask == 0 {
            return Ok(None);
        }
        let shift = mask.trailing_zeros();
        let max = mask >> shift;
        let has_gaps = max.checked_add(1).is_some_and(|next| !next.is_power_of_two());
        if has_gaps || u64::from(mask) >> bits != 0 {
            return Err(unfit(channel, mask, bits));
        }
        Ok(Some(Self { mask, shift, max }))
    }

    /// The channel's value as 0 … 255, rounded.
    fn read(self, pixel: u32) -> u8 {
        let value = (pixel & self.mask) >> self.shift;
        if self.max == 255 {
            return value as u8;
        }
        let max = u64::from(self.max);
        ((u64::from(value) * 255 + max / 2) / max) as u8
    }

    fn width(self) -> u32 {
        self.mask.count_ones()
    }
}

fn unfit(channel: &str, mask: u32, bits: u32) -> Fault {
    let message = format!("the mask {mask:#x} for {channel} does not fit a pixel of {bits} bits");
    codes::DDS_MASK.says(message).into()
}

/// A layout of pixels of 1 to 4 bytes, little-endian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Masks {
    pixel_len: usize,
    /// Red or grey, green, blue, alpha.
    fields: [Option<Field>; 4],
    grey: bool,
}

impl Masks {
    /// Colour by masks of red, green, blue and alpha, of which some may be 0. Red alone counts as grey.
    pub(super) fn rgba(bits: u32, masks: [u32; 4]) -> Result<Self, Fault> {
        if !matches!(bits, 8 | 16 | 24 | 32) {
            let message = format!("DDS pixels of {bits} bits are not supported; there must be 8, 16, 24 or 32");
            return Err(codes::DDS_UNSUPPORTED.says(message).into());
        }
        let [r, g, b, a] = masks;
        let fields = [
            Field::new("red", r, bits)?,
            Field::new("green", g, bits)?,
            Field::new("blue", b, bits)?,
            Field::new("alpha", a, bits)?,
        ];
        if fields.iter().all(Option::is_none) {
            return Err(unfit("colour and alpha", 0, bits));
        }
        Ok(Self {
            pixel_len: bits as usize / 8,
            fields,
            grey: r != 0 && g == 0 && b == 0,
        })
    }

    /// Bytes of a pixel.
    pub(super) fn pixel_len(self) -> usize {
        self.pixel_len
    }

    pub(super) fn channels(self) -> Channels {
        let [red, green, blue, alpha] = self.fields.map(|field| field.is_some());
        match (self.grey, alpha) {
            (true, false) => Channels::Grey,
            (true, true) => Channels::GreyAlpha,
            (false, true) if !(red || green || blue) => Channels::Alpha,
            (false, true) => Channels::Rgba,
            (false, false) if !blue => Channels::RedGreen,
            (false, false) => Channels::Rgb,
        }
    }

    /// Channels and their bits from the lowest on, as DXGI names them: `B8G8R8X8`, `L8`.
    pub(super) fn label(self) -> String {
        let letters = if self.grey {
            ["L", "", "", "A"]
        } else {
            ["R", "G", "B", "A"]
        };
        let mut named: Vec<_> = letters
            .into_iter()
            .zip(self.fields)
            .filter_map(|(letter, field)| Some((letter, field?)))
            .collect();
        sorting::sort_by_key(&mut named, |(_, field)| field.shift);
        let used: u32 = named.iter().map(|(_, field)| field.width()).sum();
        let mut label: String = named
            .iter()
            .map(|(letter, field)| format!("{letter}{}", field.width()))
            .collect();
        let unused = (self.pixel_len as u32 * 8).saturating_sub(used);
        if unused > 0 {
            label += &format!("X{unused}");
        }
        label
    }

    /// Pixels as RGBA, 8 bits a channel. Without a mask colour is 0 and alpha 255.
    pub(super) fn to_rgba8(self, pixels: &[u8]) -> Vec<u8> {
        let [red, green, blue, alpha] = self.fields;
        let read = |field: Option<Field>, pixel, missing| field.map_or(missing, |field| field.read(pixel));
        let mut texels = Vec::with_capacity(pixels.len() / self.pixel_len * 4);
        for bytes in pixels.chunks_exact(self.pixel_len) {
            let mut pixel = [0; 4];
            pixel[..self.pixel_len].copy_from_slice(bytes);
            let pixel = u32::from_le_bytes(pixel);
            let red = read(red, pixel, 0);
            let [green, blue] = if self.grey {
                [red; 2]
            } else {
                [read(green, pixel, 0), read(blue, pixel, 0)]
            };
            texels.extend([red, green, blue, read(alpha, pixel, 255)]);
        }
        texels
    }
}
