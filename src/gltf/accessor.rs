//! Accessors: ranges of buffers as numbers, proved before they are read.

use std::cell::Cell;
use std::fmt;

use super::buffers::{Buffers, out_of_range};
use super::json::{Accessor, Index, Root};
use super::{Fault, fault};
use crate::diagnostic::codes;

/// Numbers may be read this often beyond one for each byte that there is.
const MORE_ELEMENTS: u64 = 4_000_000;

/// Reads accessors. It keeps account of how many elements were read: a small file that names one accessor a million times ends in
/// an error, not in all memory.
#[derive(Debug)]
pub struct Reader<'a> {
    root: &'a Root,
    buffers: &'a Buffers<'a>,
    elements_left: Cell<u64>,
}

/// What the numbers of an accessor are stored as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of(number: u64) -> Option<Self> {
        Some(match number {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    fn byte_count(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }
}

/// The elements of an accessor or of a part of a sparse one.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    count: usize,
    component: Component,
    normalized: bool,
}

/// How many numbers an element of a kind has.
fn number_count(kind: &str) -> Option<usize> {
    Some(match kind {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" => 4,
        "MAT4" => 16,
        _ => return None,
    })
}

impl<'a> Reader<'a> {
    /// A reader of a document of this many bytes.
    pub fn new(root: &'a Root, buffers: &'a Buffers<'a>, byte_count: u64) -> Self {
        let byte_count = byte_count.saturating_add(buffers.byte_count());
        Self {
            root,
            buffers,
            elements_left: Cell::new(byte_count.saturating_mul(2).saturating_add(MORE_ELEMENTS)),
        }
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

    /// Takes `count` from what may be read, also for copies of what was read.
    ///
    /// # Errors
    /// When it is more than is left.
    pub fn spend(&self, count: u64, pointer: impl fmt::Display) -> Result<(), Fault> {
        let left = self.elements_left.get().checked_sub(count).ok_or_else(|| {
            let message = "The file asks for far more numbers than it holds: the same data are used again and again.";
            fault(&codes::GLTF_TOO_LARGE, pointer.to_string(), message)
        })?;
        self.elements_left.set(left);
        Ok(())
    }

    /// Elements of `N` numbers. Whole numbers come as they are, or as 0…1 or −1…1 where the accessor is normalised.
    ///
    /// # Errors
    /// When the accessor has elements of another kind, or reaches beyond its data.
    pub fn floats<const N: usize>(&self, index: Index, pointer: &str) -> Result<Vec<[f32; N]>, Fault> {
        let accessor = self.accessor(index, pointer)?;
        let mut floats = match self.elements(index, accessor, N, pointer)? {
            Some(elements) => decoded(&elements),
            None => vec![[0.0; N]; count_of(accessor)?],
        };
        if let Some((places, values)) = self.sparse(index, accessor, N)? {
            for (place, value) in places.into_iter().zip(decoded(&values)) {
                floats[place] = value;
            }
        }
        Ok(floats)
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
        let mut numbers = match self.elements(index, accessor, N, pointer)? {
            Some(elements) => decoded_whole(&elements),
            None => vec![[0; N]; count_of(accessor)?],
        };
        if let Some((places, values)) = self.sparse(index, accessor, N)? {
            for (place, value) in places.into_iter().zip(decoded_whole(&values)) {
                numbers[place] = value;
            }
        }
        Ok(numbers)
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
        let range = self.range(view, offset, accessor.count.0, component, numbers, at, "/bufferView")?;
        Ok(Some(Elements {
            normalized: accessor.normalized,
            ..range
        }))
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
            let message = format!("{} elements of {} are to be others.", sparse.count.0, accessor.count.0);
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
            let message = format!("Element {place} is to be another, but there are {}.", accessor.count.0);
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
        let values = Elements {
            normalized: accessor.normalized,
            ..values
        };
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
            normalized: false,
        })
    }
}

fn count_of(accessor: &Accessor) -> Result<usize, Fault> {
    usize::try_from(accessor.count.0)
        .map_err(|_| fault(&codes::GLTF_TOO_LARGE, "", "An accessor has more elements than memory."))
}

fn decoded<const N: usize>(elements: &Elements<'_>) -> Vec<[f32; N]> {
    let normalized = elements.normalized;
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
