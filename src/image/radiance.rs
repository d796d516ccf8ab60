//! Radiance pictures (`.hdr`; Ward 1991, "Real Pixels"): a panorama of light, read as the cube map that shows the same.
//!
//! Rows are decoded one after another into a panorama of at most [`MAX_COLUMNS`] columns, from which the faces are gathered: the middle of the
//! panorama is +z, what is right of it +x, its upper edge +y.

use std::f32::consts::{FRAC_1_PI, TAU};

use glam::{Vec2, Vec3, Vec3A};

use super::cube_faces::cube_direction;
use super::file_kind::FileKind;
use super::format::{Channels, ImageFormat};
use super::picture::{Image, ImageKind};
use super::rgbe::{light_of, texel_of};
use crate::diagnostic::{Fault, codes};
use crate::slices::Slices;

/// The most texels in a row, and the most rows.
const MAX_SIZE: [u32; 2] = [8192, 4096];
/// Columns of a panorama that is kept. Of a wider one squares of texels are averaged.
const MAX_COLUMNS: u32 = 4096;
/// Texels a side of a face.
const SIDES: [u32; 2] = [16, 1024];
/// A run of equal bytes is longer than this by its length.
const RUN: u8 = 128;

/// Texels a side of the cube map that a file becomes, by its header alone; 0 where that is damaged. `None` for other files.
pub(super) fn cube_side(bytes: &[u8]) -> Option<u32> {
    (FileKind::of(bytes, "") == Some(FileKind::Radiance)).then(|| Header::read(bytes).map_or(0, |header| header.side()))
}

/// Checks the header.
pub(super) fn check(bytes: &[u8]) -> Result<(), Fault> {
    Header::read(bytes).map(drop)
}

/// Reads a picture as a cube map of one level.
pub(super) async fn decode(bytes: &[u8], slices: &Slices) -> Result<Image, Fault> {
    let header = Header::read(bytes)?;
    let panorama = header.panorama(slices).await?;
    let side = header.side();
    let mut data = Vec::with_capacity(6 * ImageFormat::Rgbe.level_len(side, side) as usize);
    for face in 0..6 {
        for y in 0..side {
            slices.pause().await;
            for x in 0..side {
                // Four points of each texel, since it may cover more than one of the panorama.
                let light = [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]].map(|[right, below]| {
                    let place = (Vec2::new(x as f32 + right, y as f32 + below) / side as f32) * 2.0 - 1.0;
                    panorama.towards(cube_direction(face, place.x, place.y).normalize())
                });
                let mean = light.into_iter().sum::<Vec3A>() * (0.25 / header.exposure);
                data.extend(texel_of(mean));
            }
        }
    }
    Ok(Image {
        width: side,
        height: side,
        level_count: 1,
        kind: ImageKind::Cube,
        format: ImageFormat::Rgbe,
        channels: Channels::Rgb,
        source: "Radiance".to_owned(),
        mips_generated: false,
        data,
    })
}

struct Header<'a> {
    width: u32,
    height: u32,
    /// What all texels were multiplied by.
    exposure: f32,
    /// The first row is the lowest.
    is_bottom_up: bool,
    /// The first column is the rightmost.
    is_mirrored: bool,
    rows: &'a [u8],
}

impl<'a> Header<'a> {
    fn read(bytes: &'a [u8]) -> Result<Self, Fault> {
        let mut rest = bytes;
        let mut line = || {
            let end = memchr::memchr(b'\n', rest);
            let line;
            (line, rest) = rest.split_at(end.map_or(rest.len(), |end| end + 1));
            end.map(|_| line.trim_ascii()).ok_or_else(|| cut("header"))
        };
        let mut exposure = 1.0;
        loop {
            let line = line()?;
            if line.is_empty() {
                break;
            }
            let (key, value) = line.split_at(line.iter().position(|&byte| byte == b'=').unwrap_or(line.len()));
            let value = String::from_utf8_lossy(value.get(1..).unwrap_or_default());
            match key {
                b"FORMAT" if value.trim() != "32-bit_rle_rgbe" => {
                    return Err(unreadable(&format!("holds pixels of the format {}", value.trim())));
                }
                b"EXPOSURE" => exposure *= value.trim().parse::<f32>().unwrap_or(1.0),
                _ => {}
            }
        }
        let size = String::from_utf8_lossy(line()?).into_owned();
        let words: Vec<&str> = size.split_ascii_whitespace().collect();
        let [down @ ("-Y" | "+Y"), height, right @ ("-X" | "+X"), width] = words[..] else {
            return Err(unreadable(&format!(
                "gives its size as \"{size:.40}\", not as \"-Y 1024 +X 2048\""
            )));
        };
        let (Ok(height), Ok(width)) = (height.parse::<u32>(), width.parse::<u32>()) else {
            return Err(unreadable(&format!(
                "gives its size as \"{size:.40}\", which are no two numbers"
            )));
        };
        let [most_width, most_height] = MAX_SIZE;
        if width == 0 || height == 0 || width > most_width || height > most_height {
            let message = format!(
                "a panorama of {width} × {height} cannot be shown; it may have at most {most_width} × {most_height}"
            );
            return Err(codes::IMAGE_SIZE.says(message).into());
        }
        if width.abs_diff(2 * height) > 2 {
            let message =
                format!("a panorama of the whole sky is twice as wide as high, and this one is {width} × {height}");
            return Err(codes::IMAGE_CUBE.says(message).into());
        }
        Ok(Self {
            width,
            height,
            exposure: if exposure.is_normal() && exposure > 0.0 {
                exposure
            } else {
                1.0
            },
            is_bottom_up: down == "+Y",
            is_mirrored: right == "-X",
            rows: rest,
        })
    }

    /// So many texels a side become one.
    fn reduction(&self) -> u32 {
        self.width.div_ceil(MAX_COLUMNS)
    }

    /// A quarter of the equator on each of four faces.
    fn side(&self) -> u32 {
        let [least, most] = SIDES;
        (self.width / self.reduction() / 4)
            .next_power_of_two()
            .clamp(least, most)
    }

    async fn panorama(&self, slices: &Slices) -> Result<Panorama, Fault> {
        let reduction = self.reduction() as usize;
        let columns = (self.width as usize / reduction).max(1);
        let mut rest = self.rows;
        let mut row = vec![[0; 4]; self.width as usize];
        let mut sums = vec![Vec3A::ZERO; columns];
        // It grows with what the file really holds.
        let mut texels: Vec<[u8; 4]> = Vec::new();
        for index in 0..self.height as usize {
            slices.pause().await;
            read_row(&mut rest, &mut row).ok_or_else(|| cut(&format!("row {index} of {}", self.height)))?;
            if reduction == 1 {
                texels.extend_from_slice(&row);
                continue;
            }
            for (sum, texels) in sums.iter_mut().zip(row.chunks_exact(reduction)) {
                *sum += texels.iter().map(|&texel| light_of(texel)).sum::<Vec3A>();
            }
            if (index + 1).is_multiple_of(reduction) {
                let parts = (reduction * reduction) as f32;
                texels.extend(sums.iter().map(|&sum| texel_of(sum / parts)));
                sums.fill(Vec3A::ZERO);
            }
        }
        if self.is_bottom_up {
            texels = texels.chunks_exact(columns).rev().flatten().copied().collect();
        }
        if self.is_mirrored {
            texels.chunks_exact_mut(columns).for_each(<[_]>::reverse);
        }
        Ok(Panorama { columns, texels })
    }
}

struct Panorama {
    columns: usize,
    /// Rows from the top.
    texels: Vec<[u8; 4]>,
}

impl Panorama {
    /// Light from a direction of unit length, bilinear.
    fn towards(&self, direction: Vec3A) -> Vec3A {
        let Vec3 { x, y, z } = direction.into();
        let (columns, rows) = (self.columns as f32, (self.texels.len() / self.columns) as f32);
        let across = (x.atan2(z) / TAU + 0.5) * columns - 0.5;
        let down = ((y.clamp(-1.0, 1.0).acos() * FRAC_1_PI) * rows - 0.5).clamp(0.0, rows - 1.0);
        let column = across.rem_euclid(columns) as usize % self.columns;
        let row = down as usize;
        let right = (column + 1) % self.columns;
        let first = row * self.columns;
        let second = (first + self.columns) % self.texels.len().max(1);
        let texel = |index: usize| light_of(self.texels[index]);
        let upper = texel(first + column).lerp(texel(first + right), across - across.floor());
        if down == rows - 1.0 {
            return upper;
        }
        let lower = texel(second + column).lerp(texel(second + right), across - across.floor());
        upper.lerp(lower, down - row as f32)
    }
}

/// Decodes a row; `None` where the file ends within it, or says more of a row than it can have.
fn read_row(rest: &mut &[u8], row: &mut [[u8; 4]]) -> Option<()> {
    let width = row.len();
    let begins = rest.first_chunk::<4>()?;
    if *begins != [2, 2, (width >> 8) as u8, width as u8] || !(8..0x8000).contains(&width) {
        return read_plain_row(rest, row);
    }
    *rest = &rest[4..];
    // Each channel by itself, in runs.
    for channel in 0..4 {
        let mut done = 0;
        while done < width {
            let (&count, after) = rest.split_first()?;
            let (count, is_run) = if count > RUN {
                (count - RUN, true)
            } else {
                (count, false)
            };
            let texels = row
                .get_mut(done..done + usize::from(count))
                .filter(|texels| !texels.is_empty())?;
            let (values, after) = after.split_at_checked(if is_run { 1 } else { texels.len() })?;
            for (texel, value) in texels.iter_mut().zip(values.iter().cycle()) {
                texel[channel] = *value;
            }
            done += texels.len();
            *rest = after;
        }
    }
    Some(())
}

/// Decodes a row of whole texels. One whose mantissas are all 1 repeats the one before, as often as its exponent says; such ones after one
/// another are the digits of a number to the base 256, the lowest first.
fn read_plain_row(rest: &mut &[u8], row: &mut [[u8; 4]]) -> Option<()> {
    let (mut done, mut shift) = (0, 0);
    while done < row.len() {
        let (&texel, after) = rest.split_first_chunk::<4>()?;
        *rest = after;
        let [1, 1, 1, count] = texel else {
            (row[done], shift) = (texel, 0);
            done += 1;
            continue;
        };
        let last = *row.get(done.checked_sub(1)?)?;
        let count = usize::from(count).checked_shl(shift)?;
        row.get_mut(done..done.checked_add(count)?)?.fill(last);
        done += count;
        shift += 8;
    }
    Some(())
}

fn cut(place: &str) -> Fault {
    let message = format!("the Radiance file ends or is damaged in its {place}");
    codes::IMAGE_CUT.says(message).into()
}

fn unreadable(what: &str) -> Fault {
    codes::IMAGE_UNDECODABLE
        .says(format!("the Radiance file {what}, which is not read"))
        .into()
}
