//! Makes smaller levels where a file has none.

use glam::{Vec3, Vec3A, Vec4};

use super::format::{Channels, ImageFormat};
use super::picture::{Image, full_level_count, level_size};
use super::srgb::{Srgb, WHOLE};
use super::{half, rgbe};
use crate::slices::{Slices, at_once};

/// The kind of values in a map, which decides how they are averaged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MapKind {
    /// sRGB colours: averaged as linear light, each weighted by its alpha, since a transparent texel has no colour.
    Diffuse,
    /// sRGB colours with a number in alpha: averaged as linear light, each channel by itself.
    Color,
    /// Directions of unit length: averaged, and not normalised, so that a mean is the shorter the more they differ. With two channels
    /// the length is in blue. Alpha is averaged by itself.
    Normal,
    /// Numbers such as roughness: each channel is averaged by itself.
    Data,
}

impl MapKind {
    /// Each of them.
    pub const ALL: [Self; 4] = [Self::Diffuse, Self::Color, Self::Normal, Self::Data];
}

/// So many texels are averaged or written between two places at which that can stop: half a millisecond or so.
const TEXELS_A_PIECE: usize = 1 << 15;

/// A value that is averaged: colour times weight and weight, or direction or colour and alpha.
type Texel = Vec4;

/// Weight of a transparent texel relative to an opaque one: too little to tint an edge, but enough that an area without
/// any alpha keeps its colour.
const CLEAR_WEIGHT: f32 = 1.0 / 1024.0;

impl Image {
    /// The picture with all levels down to 1 × 1. A picture that has more than one level stays as it is.
    ///
    /// Compressed pictures become [`ImageFormat::Rgba8`], or [`ImageFormat::Rgba16Float`] where they hold floats. Floats
    /// are taken as linear colours whatever `map_kind` says. Each texel is the mean of the area that it covers, also
    /// where a side is odd.
    #[must_use]
    pub fn with_mips(self, map_kind: MapKind) -> Self {
        self.mipped(map_kind).unwrap_or(self)
    }

    /// [`with_mips`](Self::with_mips) of a borrowed picture; `None` where nothing would change.
    pub(crate) fn mipped(&self, map_kind: MapKind) -> Option<Self> {
        at_once(self.mipped_in(map_kind, None, &Slices::ENDLESS))
    }

    /// [`mipped`](Self::mipped) in slices. Of colours that are cut where their alpha is below `cutoff`, 0…1, as large a part is left of each
    /// level as of the largest.
    pub(crate) async fn mipped_in(&self, map_kind: MapKind, cutoff: Option<f32>, slices: &Slices) -> Option<Self> {
        let level_count = full_level_count(self.width, self.height);
        if self.level_count > 1 || level_count == 1 {
            return None;
        }
        let coding = Coding::of(self, map_kind);
        let level_len = |level| {
            let (width, height) = self.level_size(level);
            coding.format().level_len(width, height) as usize
        };
        let face_len: usize = (0..level_count).map(level_len).sum();
        let mut data = Vec::with_capacity(face_len * self.face_count() as usize);
        let cutoff = cutoff.filter(|_| map_kind == MapKind::Diffuse && self.has_alpha());
        for face in 0..self.face_count() {
            coding
                .append_chain(&mut data, self, (face, cutoff), level_count, slices)
                .await;
        }
        Some(self.remade(coding, [self.width, self.height], level_count, data))
    }

    /// One level alone, halved until no side has more than `limit` texels, as [`with_mips`](Self::with_mips) does.
    /// `None` where there is no such level. `limit` is not 0.
    #[must_use]
    pub fn reduced(&self, level: u32, map_kind: MapKind, limit: u32) -> Option<Self> {
        if level >= self.level_count {
            return None;
        }
        let coding = Coding::of(self, map_kind);
        let (width, height) = self.level_size(level);
        let size_after = |halvings| level_size(width, height, halvings);
        let halvings = (0..u32::BITS).find(|&halvings| {
            let (width, height) = size_after(halvings);
            width.max(height) <= limit
        })?;
        let mut data = Vec::new();
        for face in 0..self.face_count() {
            let start = data.len();
            let mut texels = at_once(coding.append_level(&mut data, self, face, level, &Slices::ENDLESS));
            if halvings == 0 {
                continue;
            }
            data.truncate(start);
            for halved in 1..halvings {
                let (width, height) = size_after(halved);
                texels = at_once(halve(width, height, &texels, |&texel| texel, &Slices::ENDLESS));
            }
            coding.append(&mut data, &texels, 1.0);
        }
        Some(self.remade(coding, size_after(halvings).into(), 1, data))
    }

    /// The same picture with other texels.
    fn remade(&self, coding: Coding, [width, height]: [u32; 2], level_count: u32, data: Vec<u8>) -> Self {
        Self {
            width,
            height,
            level_count,
            kind: self.kind,
            format: coding.format(),
            channels: self.channels,
            source: self.source.clone(),
            mips_generated: true,
            data,
        }
    }
}

/// How texels are read from bytes and written back.
#[derive(Clone, Copy, Debug)]
enum Coding {
    /// sRGB with straight alpha, by which colours are weighted; or with a number there, by which they are not.
    Srgb { weighted: bool },
    /// With two channels z follows from x and y, and blue is the length.
    Direction { two_channels: bool },
    /// Numbers 0…1, each channel by itself.
    Linear,
    /// Linear half floats.
    Half,
    /// Linear light with a common exponent.
    Rgbe,
}

impl Coding {
    fn of(image: &Image, map_kind: MapKind) -> Self {
        match map_kind {
            _ if image.format == ImageFormat::Rgbe => Self::Rgbe,
            _ if image.format.is_float() => Self::Half,
            MapKind::Diffuse => Self::Srgb { weighted: true },
            MapKind::Color => Self::Srgb { weighted: false },
            MapKind::Normal => Self::Direction {
                two_channels: image.channels == Channels::RedGreen,
            },
            MapKind::Data => Self::Linear,
        }
    }

    /// The format in which levels are written.
    fn format(self) -> ImageFormat {
        match self {
            Self::Srgb { .. } | Self::Direction { .. } | Self::Linear => ImageFormat::Rgba8,
            Self::Half => ImageFormat::Rgba16Float,
            Self::Rgbe => ImageFormat::Rgbe,
        }
    }

    /// Writes a face of at least two levels: the largest as it is, then all smaller ones.
    async fn append_chain(
        self,
        data: &mut Vec<u8>,
        image: &Image,
        (face, cutoff): (u32, Option<f32>),
        level_count: u32,
        slices: &Slices,
    ) {
        let start = data.len();
        let mut texels = self.append_level(data, image, face, 0, slices).await;
        let coverage = cutoff.map(|cutoff| Coverage::of(&data[start..], cutoff));
        for level in 1..level_count {
            let alpha_scale = coverage.map_or(1.0, |coverage| coverage.alpha_scale(&texels));
            for texels in texels.chunks(TEXELS_A_PIECE) {
                slices.pause().await;
                self.append(data, texels, alpha_scale);
            }
            // From the values before rounding, so that errors do not add up.
            let (width, height) = image.level_size(level);
            texels = halve(width, height, &texels, |&texel| texel, slices).await;
        }
    }

    /// Writes a level of the picture in this coding's format, and gives the values of the next smaller level.
    async fn append_level(
        self,
        data: &mut Vec<u8>,
        image: &Image,
        face: u32,
        level: u32,
        slices: &Slices,
    ) -> Vec<Texel> {
        let (width, height) = image.level_size(level);
        if let Self::Half | Self::Rgbe = self {
            let values = image.to_rgba32f(face, level).unwrap_or_default();
            match self {
                Self::Rgbe => data.extend_from_slice(image.level(face, level).unwrap_or_default()),
                _ => data.extend(values.iter().flat_map(|&value| half::from_f32(value).to_le_bytes())),
            }
            return halve(
                width,
                height,
                values.as_chunks::<4>().0,
                |&texel| Vec4::from(texel),
                slices,
            )
            .await;
        }
        let start = data.len();
        image.append_rgba8(data, face, level);
        let texels = data[start..].as_chunks::<4>().0;
        let unit = |&[r, g, b, a]: &[u8; 4]| Vec4::new(r.into(), g.into(), b.into(), a.into());
        match self {
            Self::Srgb { weighted } => {
                let (srgb, weights) = (Srgb::tables(), weights());
                let color = |[r, g, b]: [u8; 3]| Vec3::new(srgb.linear(r), srgb.linear(g), srgb.linear(b));
                if weighted {
                    let read = |&[r, g, b, a]: &[u8; 4]| color([r, g, b]).extend(1.0) * weights[usize::from(a)];
                    halve(width, height, texels, read, slices).await
                } else {
                    let read = |&[r, g, b, a]: &[u8; 4]| color([r, g, b]).extend(f32::from(a) / 255.0);
                    halve(width, height, texels, read, slices).await
                }
            }
            Self::Direction { two_channels } => {
                let read = |texel: &[u8; 4]| {
                    let direction = unit(texel) / Vec4::new(127.5, 127.5, 127.5, 255.0) - Vec4::new(1.0, 1.0, 1.0, 0.0);
                    normalized(if two_channels { with_z(direction) } else { direction })
                };
                let halved = halve(width, height, texels, read, slices).await;
                if two_channels {
                    data[start..]
                        .as_chunks_mut::<4>()
                        .0
                        .iter_mut()
                        .for_each(|texel| texel[2] = u8::MAX);
                }
                halved
            }
            _ => halve(width, height, texels, |texel| unit(texel) / 255.0, slices).await,
        }
    }

    /// Writes texels of a smaller level; alpha of colours times `alpha_scale`.
    fn append(self, data: &mut Vec<u8>, texels: &[Texel], alpha_scale: f32) {
        match self {
            Self::Srgb { weighted } => {
                let srgb = Srgb::tables();
                append_bytes(data, texels, |texel| {
                    let (color, number) = if weighted {
                        let alpha = (texel - CLEAR_WEIGHT) / (1.0 - CLEAR_WEIGHT) * alpha_scale;
                        (texel / texel.w, alpha)
                    } else {
                        (texel, texel)
                    };
                    let [r, g, b] = srgb.bytes(color);
                    [r, g, b, nearest(number).w.to_bits() as u8]
                });
            }
            Self::Direction { two_channels } => append_bytes(data, texels, |texel: Texel| {
                let of_unit = if two_channels { normalized(texel) } else { texel };
                let encoded = of_unit * Vec4::new(0.5, 0.5, 0.5, 1.0) + Vec4::new(0.5, 0.5, 0.5, 0.0);
                let [x, y, z, alpha] = bytes(encoded);
                let length = || bytes(Vec4::splat(texel.truncate().length()))[0];
                [x, y, if two_channels { length() } else { z }, alpha]
            }),
            Self::Linear => append_bytes(data, texels, bytes),
            Self::Half => {
                let values = texels.iter().flat_map(|texel| texel.to_array());
                data.extend(values.flat_map(|value| half::from_f32(value).to_le_bytes()));
            }
            Self::Rgbe => data.extend(texels.iter().flat_map(|texel| rgbe::texel_of(Vec3A::from_vec4(*texel)))),
        }
    }
}

/// How large a part of a map is left where alpha cuts it.
#[derive(Clone, Copy, Debug)]
struct Coverage {
    /// 0…1.
    cutoff: f32,
    /// 0…1, of the largest level.
    part: f32,
}

impl Coverage {
    /// Of a level of RGBA with 8 bits a channel.
    fn of(level: &[u8], cutoff: f32) -> Self {
        let texels = level.as_chunks::<4>().0;
        let is_left = |texel: &&[u8; 4]| f32::from(texel[3]) >= cutoff * 255.0;
        Self {
            cutoff,
            part: texels.iter().filter(is_left).count() as f32 / texels.len() as f32,
        }
    }

    /// What alpha of a smaller level is multiplied by, so that as large a part of it is left (Castaño 2010, "Computing Alpha Mipmaps"). A mean
    /// would lose what is thin: leaves seen from afar would have holes.
    fn alpha_scale(self, texels: &[Texel]) -> f32 {
        let gone = ((1.0 - self.part) * texels.len() as f32).round() as usize;
        if gone == 0 || gone >= texels.len() {
            return 1.0;
        }
        let mut alphas: Vec<f32> = texels.iter().map(|&texel| alpha_of(texel)).collect();
        let (_, &mut least_left, _) = alphas.select_nth_unstable_by(gone, f32::total_cmp);
        // Many may have the same alpha: all of them are left, or none.
        let part = |is_left: &dyn Fn(f32) -> bool| {
            let left = alphas.iter().filter(|&&alpha| is_left(alpha)).count() as f32;
            (left / alphas.len() as f32 - self.part).abs()
        };
        let are_gone = part(&|alpha| alpha >= least_left) > part(&|alpha| alpha > least_left);
        let above = alphas
            .iter()
            .copied()
            .filter(|&alpha| alpha > least_left)
            .fold(f32::INFINITY, f32::min);
        let least_left = if are_gone { above } else { least_left };
        // A scale beyond these would make something of nothing.
        (self.cutoff / least_left.max(1e-3)).clamp(0.25, 4.0)
    }
}

/// The alpha of a colour that its weight stands for.
fn alpha_of(texel: Texel) -> f32 {
    (texel.w - CLEAR_WEIGHT) / (1.0 - CLEAR_WEIGHT)
}

/// The weight of a colour with each alpha.
fn weights() -> [f32; 256] {
    std::array::from_fn(|alpha| CLEAR_WEIGHT + alpha as f32 / 255.0 * (1.0 - CLEAR_WEIGHT))
}

/// The direction whose x and y are known.
fn with_z(direction: Texel) -> Texel {
    let [x, y, _, alpha] = direction.to_array();
    Vec4::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt(), alpha)
}

/// The direction normalised; straight out of the surface where opposite directions cancelled out. Alpha stays.
fn normalized(texel: Texel) -> Texel {
    let [x, y, z, alpha] = texel.to_array();
    let length = (x * x + y * y + z * z).sqrt();
    if length > 1e-3 {
        (texel / length).truncate().extend(alpha)
    } else {
        Vec4::new(0.0, 0.0, 1.0, alpha)
    }
}

/// The nearest bytes of numbers that are 0 … 1 and clamped to it.
fn bytes(numbers: Vec4) -> [u8; 4] {
    let nearest = nearest(numbers);
    let byte = |number: f32| number.to_bits() as u8;
    [byte(nearest.x), byte(nearest.y), byte(nearest.z), byte(nearest.w)]
}

/// Numbers whose lowest bits are those bytes; a half goes up.
#[inline(always)]
fn nearest(numbers: Vec4) -> Vec4 {
    let scaled = numbers.max(Vec4::ZERO).min(Vec4::ONE) * 255.0;
    // `f32::round` is a call for each number. This rounds a half to the even neighbour, which is mended.
    let nearest = scaled + WHOLE;
    let is_half_below = (scaled - (nearest - WHOLE)).cmpge(const { Vec4::splat(0.5) });
    nearest + Vec4::select(is_half_below, Vec4::ONE, Vec4::ZERO)
}

fn append_bytes(data: &mut Vec<u8>, texels: &[Texel], write: impl Fn(Texel) -> [u8; 4]) {
    // A few at a time: filling all their room before would cost as much again.
    let mut few = [[0; 4]; 128];
    for texels in texels.chunks(few.len()) {
        for (bytes, &texel) in few.iter_mut().zip(texels) {
            *bytes = write(texel);
        }
        data.extend_from_slice(few[..texels.len()].as_flattened());
    }
}

/// The next smaller level. Each of its texels is the mean of the area it covers: of two rows and columns where a side is
/// even, of parts of three where it is odd, of one where it is 1.
async fn halve<T>(width: u32, height: u32, texels: &[T], read: impl Fn(&T) -> Texel, slices: &Slices) -> Vec<Texel> {
    let (smaller_width, smaller_height) = level_size(width, height, 1);
    let rows_a_piece = (TEXELS_A_PIECE / width as usize).max(1);
    let mut smaller = Vec::with_capacity(smaller_width as usize * smaller_height as usize);
    if width.is_multiple_of(2) && height.is_multiple_of(2) {
        // As below, where all four weights are a quarter.
        for (index, rows) in texels.chunks_exact(2 * width as usize).enumerate() {
            if index.is_multiple_of(rows_a_piece) {
                slices.pause().await;
            }
            let (upper, lower) = rows.split_at(width as usize);
            let squares = upper.as_chunks::<2>().0.iter().zip(lower.as_chunks::<2>().0);
            // The sum with 0 makes 0 of −0.
            let mean = |[a, b]: &[T; 2], [c, d]: &[T; 2]| (read(a) + read(b) + read(c) + read(d)) * 0.25 + 0.0;
            smaller.extend(squares.map(|(upper, lower)| mean(upper, lower)));
        }
        return smaller;
    }
    for row in 0..smaller_height {
        if (row as usize).is_multiple_of(rows_a_piece) {
            slices.pause().await;
        }
        let rows = covered(height, row);
        for column in 0..smaller_width {
            let columns = covered(width, column);
            let mut mean = Vec4::ZERO;
            for &(y, row_weight) in rows.taps() {
                for &(x, column_weight) in columns.taps() {
                    let value = read(&texels[y as usize * width as usize + x as usize]);
                    mean += value * (row_weight * column_weight);
                }
            }
            smaller.push(mean);
        }
    }
    smaller
}

/// Texels of a side, and their weights in a texel of the next smaller level; the weights sum to 1.
struct Covered {
    taps: [(u32, f32); 3],
    tap_count: usize,
}

impl Covered {
    fn taps(&self) -> &[(u32, f32)] {
        &self.taps[..self.tap_count]
    }
}

/// What a texel of the next smaller level covers.
fn covered(side: u32, index: u32) -> Covered {
    let first = index * 2;
    let half = side / 2;
    let (weights, tap_count) = match side {
        1 => ([1.0, 0.0, 0.0], 1),
        // 2n + 1 texels for n: each covers 2 + 1/n of them.
        _ if side % 2 == 1 => ([half - index, half, index + 1].map(|part| part as f32 / side as f32), 3),
        _ => ([0.5, 0.5, 0.0], 2),
    };
    let [a, b, c] = weights;
    Covered {
        taps: [(first, a), (first + 1, b), (first + 2, c)],
        tap_count,
    }
}
