//! Accessors: ranges of buffers as numbers, proved before they are read.

use std::cell::Cell;
use std::fmt;

use super::buffers::{Buffers, out_of_range};
use super::component::{Component, Fit, Wanted, number_count};
use super::json::{Accessor, Index, Root};
use super::{Fault, fault};
use crate::diagnostic::codes;

/// So many elements may be read for each byte that there is, and beyond.
const ELEMENTS_PER_BYTE: u64 = 2;
const MORE_ELEMENTS: u64 = 4_000_000;

/// So many bytes of a model may be kept for each byte that there is, since streams that the file lacks are computed; and beyond, so that a
/// fence of one mesh on hundreds of nodes fits.
const BYTES_KEPT_PER_BYTE: u64 = 16;
const MORE_BYTES_KEPT: u64 = 512 << 20;

/// Reads accessors. It keeps account of how many elements were read and how many bytes the model takes: a small file that uses one
/// accessor a million times ends in an error, not in all memory.
#[derive(Debug)]
pub struct Reader<'a> {
    root: &'a Root,
    buffers: &'a Buffers<'a>,
    byte_count: u64,
    spent: Cell<Effort>,
}

/// What reading took, by the reader's own account.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// Elements of accessors that were read, and steps of like cost.
    pub elements: u64,
    /// Bytes of vertices, triangles and pictures that are kept.
    pub bytes_kept: u64,
}

/// The elements of an accessor or of a part of a sparse one.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    count: usize,
    component: Component,
}

impl<'a> Reader<'a> {
    /// A reader of a document of this many bytes.
    pub fn new(root: &'a Root, buffers: &'a Buffers<'a>, byte_count: u64) -> Self {
        Self {
            root,
            buffers,
            byte_count: byte_count.saturating_add(buffers.byte_count()),
            spent: Cell::default(),
        }
    }

    /// What was read and kept until now.
    pub fn effort(&self) -> Effort {
        self.spent.get()
    }

    /// The buffers that it reads from.
    pub fn buffers(&self) -> &'a Buffers<'a> {
        self.buffers
    }

    /// An accessor; `pointer` is where it is named.
    ///
    /// # Errors
    /// When it is not there.
    pub fn accessor(&self, accessor: Index, pointer: &str) -> Result<&'a Accessor, Fault> {
        let accessors = self.root.accessors();
        let found = usize::try_from(accessor.0).ok().and_then(|index| accessors.get(index));
        found.ok_or_else(|| out_of_range(pointer, "accessor", accessor.0, accessors.len()))
    }

    /// How many numbers an element has: 3 for `VEC3`. `None` for kinds that are read nowhere.
    ///
    /// # Errors
    /// When there is no such accessor.
    pub fn width(&self, accessor: Index, pointer: &str) -> Result<Option<usize>, Fault> {
        Ok(number_count(&self.accessor(accessor, pointer)?.kind))
    }

    /// Counts `count` more elements as read, also for copies of what was read.
    ///
    /// # Errors
    /// When they are more than a sound file of this size asks for.
    pub fn spend(&self, count: u64, pointer: impl fmt::Display) -> Result<(), Fault> {
        self.charge([count, 0], pointer)
    }

    /// Counts `count` more bytes as kept in the model. To be asked before they are.
    ///
    /// # Errors
    /// When they are more than a model of a file of this size may take.
    pub fn keep(&self, count: u64, pointer: impl fmt::Display) -> Result<(), Fault> {
        self.charge([0, count], pointer)
    }

    fn charge(&self, [elements, bytes]: [u64; 2], pointer: impl fmt::Display) -> Result<(), Fault> {
        let most = |per_byte, more| self.byte_count.saturating_mul(per_byte).saturating_add(more);
        let mut effort = self.spent.get();
        effort.elements = effort.elements.saturating_add(elements);
        effort.bytes_kept = effort.bytes_kept.saturating_add(bytes);
        self.spent.set(effort);
        let wants = if effort.elements > most(ELEMENTS_PER_BYTE, MORE_ELEMENTS) {
            "The file asks for far more numbers than it holds".to_owned()
        } else if effort.bytes_kept > most(BYTES_KEPT_PER_BYTE, MORE_BYTES_KEPT) {
            let (kept, held) = (effort.bytes_kept >> 20, self.byte_count);
            format!("The model would take {kept} MB or more, and the file holds {held} bytes")
        } else {
            return Ok(());
        };
        let message = format!("{wants}: the same data are used again and again.");
        Err(fault(&codes::GLTF_TOO_LARGE, pointer.to_string(), message))
    }

    /// Elements of `N` numbers. Whole numbers come as they are, or as 0…1 or −1…1 where the accessor is normalised or has to be.
    ///
    /// # Errors
    /// When the accessor has elements of another kind or numbers that are not wanted, or reaches beyond its data.
    pub fn floats<const N: usize>(&self, index: Index, wanted: Wanted, pointer: &str) -> Result<Vec<[f32; N]>, Fault> {
        let accessor = self.accessor(index, pointer)?;
        let fit = wanted.fit(accessor);
        if let (Fit::No, Some(component)) = (fit, Component::of(accessor.component_type.0)) {
            let (has, wanted) = (component.words(), wanted.words());
            let message = format!("Accessor {} has {has}, where {wanted} belong.", index.0);
            return Err(fault(&codes::GLTF_ACCESSOR_FORMAT, pointer, message));
        }
        let normalized = accessor.normalized || fit == Fit::NotNormalized;
        self.rows(index, accessor, pointer, |elements| decoded(elements, normalized))
    }

    /// Elements of `N` whole numbers of 0 or more.
    ///
    /// # Errors
    /// As [`Reader::floats`], and when its numbers are not whole.
    pub fn whole<const N: usize>(&self, index: Index, pointer: &str) -> Result<Vec<[u32; N]>, Fault> {
        let accessor = self.accessor(index, pointer)?;
        let is_whole = matches!(
            Component::of(accessor.component_type.0),
            Some(Component::U8 | Component::U16 | Component::U32)
        );
        if !is_whole {
            let message = format!(
                "Accessor {} has no whole numbers of 0 or more, which are needed here.",
                index.0
            );
            return Err(fault(&codes::GLTF_ACCESSOR_FORMAT, pointer, message));
        }
        self.rows(index, accessor, pointer, decoded_whole)
    }

    /// All elements, those of a sparse accessor in their places.
    fn rows<T: Copy + Default, const N: usize>(
        &self,
        index: Index,
        accessor: &Accessor,
        pointer: &str,
        decode: impl Fn(&Elements<'_>) -> Vec<[T; N]>,
    ) -> Result<Vec<[T; N]>, Fault> {
        let mut rows = match self.elements(index, accessor, N, pointer)? {
            Some(elements) => decode(&elements),
            None => vec![[T::default(); N]; count_of(accessor)?],
        };
        if let Some((places, values)) = self.sparse(index, accessor, N)? {
            for (place, value) in places.into_iter().zip(decode(&values)) {
                rows[place] = value;
            }
        }
        Ok(rows)
    }

    /// The elements in a buffer; `None` for an accessor of zeros. Their count is proved and paid for.
    fn elements(
        &self,
        index: Index,
        accessor: &Accessor,
        numbers: usize,
        pointer: &str,
    ) -> Result<Option<Elements<'a>>, Fault> {
        // Written out only where there is a fault to tell, as each pointer here: a file has hundreds of accessors.
        let at = format_args!("/accessors/{}", index.0);
        let Some(component) = Component::of(accessor.component_type.0) else {
            let message = format!("There is no component type {}.", accessor.component_type.0);
            return Err(fault(
                &codes::GLTF_ACCESSOR_FORMAT,
                format!("{at}/componentType"),
                message,
            ));
        };
        if number_count(&accessor.kind) != Some(numbers) {
            let message = format!(
                "Accessor {} is of {}, but elements of {numbers} {} are needed here.",
                index.0,
                accessor.kind,
                if numbers == 1 { "number" } else { "numbers" }
            );
            return Err(fault(&codes::GLTF_ACCESSOR_FORMAT, pointer, message));
        }
        self.spend(accessor.count.0, at)?;
        let Some(view) = accessor.buffer_view else {
            return Ok(None);
        };
        let offset = accessor.byte_offset.unwrap_or_default().0;
        self.range(view, offset, accessor.count.0, component, numbers, at, "/bufferView")
            .map(Some)
    }

    /// The places and values of a sparse accessor that are others than in its buffer.
    fn sparse(
        &self,
        index: Index,
        accessor: &Accessor,
        numbers: usize,
    ) -> Result<Option<(Vec<usize>, Elements<'a>)>, Fault> {
        let Some(sparse) = &accessor.sparse else {
            return Ok(None);
        };
        let at = format_args!("/accessors/{}/sparse", index.0);
        if sparse.count.0 > accessor.count.0 {
            let message = format!(
                "The sparse accessor replaces {} elements, but has {}.",
                sparse.count.0, accessor.count.0
            );
            return Err(fault(
                &codes::GLTF_ACCESSOR_OUT_OF_RANGE,
                format!("{at}/count"),
                message,
            ));
        }
        self.spend(sparse.count.0, at)?;
        let indices = &sparse.indices;
        let Some(component @ (Component::U8 | Component::U16 | Component::U32)) =
            Component::of(indices.component_type.0)
        else {
            let message = format!("Indices are not of component type {}.", indices.component_type.0);
            return Err(fault(
                &codes::GLTF_ACCESSOR_FORMAT,
                format!("{at}/indices/componentType"),
                message,
            ));
        };
        let offset = indices.byte_offset.unwrap_or_default().0;
        let places = self.range(
            indices.buffer_view,
            offset,
            sparse.count.0,
            component,
            1,
            at,
            "/indices/bufferView",
        )?;
        let places: Vec<usize> = decoded_whole(&places)
            .into_iter()
            .map(|[place]| place as usize)
            .collect();
        if let Some(&place) = places.iter().find(|&&place| place as u64 >= accessor.count.0) {
            let message = format!(
                "Sparse index {place} is out of range; the accessor has {} elements.",
                accessor.count.0
            );
            return Err(fault(
                &codes::GLTF_ACCESSOR_OUT_OF_RANGE,
                format!("{at}/indices"),
                message,
            ));
        }
        let Some(component) = Component::of(accessor.component_type.0) else {
            return Ok(None);
        };
        let offset = sparse.values.byte_offset.unwrap_or_default().0;
        let view = sparse.values.buffer_view;
        let values = self.range(
            view,
            offset,
            sparse.count.0,
            component,
            numbers,
            at,
            "/values/bufferView",
        )?;
        Ok(Some((places, values)))
    }

    #[expect(clippy::too_many_arguments, reason = "a range is all of them")]
    fn range(
        &self,
        view: Index,
        offset: u64,
        count: u64,
        component: Component,
        numbers: usize,
        at: fmt::Arguments<'_>,
        key: &str,
    ) -> Result<Elements<'a>, Fault> {
        let (bytes, stride) = self.buffers.view(view, format_args!("{at}{key}"))?;
        let element = component.byte_count() * numbers;
        let stride = stride.unwrap_or(element as u64);
        if stride < element as u64 {
            let message = format!("Elements of {element} bytes do not fit a step of {stride} bytes.");
            return Err(fault(&codes::GLTF_ACCESSOR_OUT_OF_RANGE, at.to_string(), message));
        }
        let last = count.checked_sub(1).map(|steps| steps.checked_mul(stride));
        let end = match last {
            // No element at all.
            None => Some(offset),
            Some(length) => length
                .and_then(|length| length.checked_add(element as u64))
                .and_then(|length| length.checked_add(offset)),
        };
        let range = end
            .filter(|&end| end <= bytes.len() as u64)
            .and_then(|end| bytes.get(usize::try_from(offset).ok()?..usize::try_from(end).ok()?));
        let Some(range) = range else {
            let message = format!(
                "{count} elements of {element} bytes, {stride} apart from byte {offset} on, do not fit the {} bytes of buffer view {}.",
                bytes.len(),
                view.0
            );
            return Err(fault(&codes::GLTF_ACCESSOR_OUT_OF_RANGE, at.to_string(), message));
        };
        Ok(Elements {
            bytes: range,
            // All of it lies inside the buffer, so both fit a usize.
            stride: usize::try_from(stride).unwrap_or(usize::MAX),
            count: usize::try_from(count).unwrap_or(usize::MAX),
            component,
        })
    }
}

fn count_of(accessor: &Accessor) -> Result<usize, Fault> {
    usize::try_from(accessor.count.0)
        .map_err(|_| fault(&codes::GLTF_TOO_LARGE, "", "An accessor has more elements than memory."))
}

fn decoded<const N: usize>(elements: &Elements<'_>, normalized: bool) -> Vec<[f32; N]> {
    let scaled = move |number: f32, greatest: f32| {
        if normalized {
            (number / greatest).max(-1.0)
        } else {
            number
        }
    };
    match elements.component {
        Component::I8 => each(elements, |[byte]: [u8; 1]| scaled(f32::from(byte as i8), 127.0)),
        Component::U8 => each(elements, |[byte]: [u8; 1]| scaled(f32::from(byte), 255.0)),
        Component::I16 => each(elements, |bytes| scaled(f32::from(i16::from_le_bytes(bytes)), 32767.0)),
        Component::U16 => each(elements, |bytes| scaled(f32::from(u16::from_le_bytes(bytes)), 65535.0)),
        Component::U32 => each(elements, |bytes| u32::from_le_bytes(bytes) as f32),
        Component::F32 => each(elements, f32::from_le_bytes),
    }
}

fn decoded_whole<const N: usize>(elements: &Elements<'_>) -> Vec<[u32; N]> {
    match elements.component {
        Component::I8 | Component::U8 => each(elements, |[byte]: [u8; 1]| u32::from(byte)),
        Component::I16 | Component::U16 => each(elements, |bytes| u32::from(u16::from_le_bytes(bytes))),
        Component::U32 | Component::F32 => each(elements, u32::from_le_bytes),
    }
}

/// Reads `N` numbers of `B` bytes from each element.
fn each<T: Copy + Default, const B: usize, const N: usize>(
    elements: &Elements<'_>,
    number: impl Fn([u8; B]) -> T,
) -> Vec<[T; N]> {
    if elements.stride == B * N {
        // Without gaps.
        let (numbers, _) = elements.bytes.as_chunks::<B>();
        let (rows, _) = numbers.as_chunks::<N>();
        return rows.iter().map(|row| row.map(&number)).collect();
    }
    let of_element = |element: &[u8]| {
        let mut numbers = [T::default(); N];
        for (read, bytes) in numbers.iter_mut().zip(element.as_chunks().0) {
            *read = number(*bytes);
        }
        numbers
    };
    let elements = elements.bytes.chunks(elements.stride.max(1)).take(elements.count);
    elements.map(of_element).collect()
}
