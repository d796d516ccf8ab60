//! Arrays: numbers of one kind, as they are or deflated.

use std::cell::Cell;

use super::place::Place;
use crate::diagnostic::Fault;
use crate::diagnostic::collect::counted;

/// What deflate makes of a byte at most: <https://zlib.net/zlib_tech.html>.
const MOST_GROWTH: u64 = 1032;

/// The kind of an array's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Element {
    U8,
    I32,
    I64,
    F32,
    F64,
}

impl Element {
    fn size(self) -> usize {
        match self {
            Self::U8 => 1,
            Self::I32 | Self::F32 => 4,
            Self::I64 | Self::F64 => 8,
        }
    }
}

/// An array as it lies in the file. Its numbers are made when they are asked for.
#[derive(Clone, Debug)]
pub struct Array<'a>(pub(super) Content<'a>);

#[derive(Clone, Debug)]
pub(super) enum Content<'a> {
    Packed {
        count: u32,
        element: Element,
        is_deflated: bool,
        bytes: &'a [u8],
        offset: u64,
    },
    Integers(Vec<i64>),
    Numbers(Vec<f64>),
}

impl Content<'_> {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Packed { count, .. } => *count as usize,
            Self::Integers(integers) => integers.len(),
            Self::Numbers(numbers) => numbers.len(),
        }
    }
}

/// How many bytes the arrays of a file may still become, and what is made of them.
#[derive(Debug)]
pub struct Budget {
    arrays: Cell<u64>,
    made: Cell<u64>,
}

impl Budget {
    /// For a file of so many bytes: each of both is 64 MiB, and twenty times the file.
    pub fn of_file(len: usize) -> Self {
        const LEAST: u64 = 64 << 20;
        const GROWTH: u64 = 20;
        let most = || Cell::new(LEAST + GROWTH * len as u64);
        Self {
            arrays: most(),
            made: most(),
        }
    }

    /// Takes bytes of what is made of the arrays.
    ///
    /// # Errors
    /// When there is no room left.
    pub fn keep(&self, bytes: u64, place: Place) -> Result<(), Fault> {
        take(&self.made, bytes, place)
    }

    /// Takes bytes that arrays become.
    ///
    /// # Errors
    /// As [`keep`](Self::keep).
    pub(super) fn unpack(&self, bytes: u64, place: Place) -> Result<(), Fault> {
        take(&self.arrays, bytes, place)
    }
}

fn take(from: &Cell<u64>, bytes: u64, place: Place) -> Result<(), Fault> {
    let left = from.get().checked_sub(bytes);
    from.set(left.ok_or_else(|| place.damaged("What is in the file would become many times as large as the file."))?);
    Ok(())
}

impl Array<'_> {
    /// How many numbers it says to have.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Its numbers; `place` is that of its record.
    pub(super) fn numbers(&self, budget: &Budget, place: Place) -> Result<Vec<f64>, Fault> {
        match &self.0 {
            Content::Numbers(numbers) => {
                budget.unpack(8 * numbers.len() as u64, place)?;
                Ok(numbers.clone())
            }
            Content::Integers(integers) => {
                budget.unpack(8 * integers.len() as u64, place)?;
                Ok(integers.iter().map(|&integer| integer as f64).collect())
            }
            Content::Packed { element, .. } => {
                let bytes = self.unpacked(budget, place)?;
                Ok(match element {
                    Element::U8 => bytes.iter().map(|&byte| f64::from(byte)).collect(),
                    Element::I32 => each(&bytes, |bytes| f64::from(i32::from_le_bytes(bytes))),
                    Element::I64 => each(&bytes, |bytes| i64::from_le_bytes(bytes) as f64),
                    Element::F32 => each(&bytes, |bytes| f64::from(f32::from_le_bytes(bytes))),
                    Element::F64 => each(&bytes, f64::from_le_bytes),
                })
            }
        }
    }

    /// Its numbers as whole ones; what follows the point is cut off.
    pub(super) fn integers(&self, budget: &Budget, place: Place) -> Result<Vec<i64>, Fault> {
        match &self.0 {
            Content::Integers(integers) => {
                budget.unpack(8 * integers.len() as u64, place)?;
                Ok(integers.clone())
            }
            Content::Packed {
                element: element @ (Element::U8 | Element::I32 | Element::I64),
                ..
            } => {
                let bytes = self.unpacked(budget, place)?;
                Ok(match element {
                    Element::I32 => each(&bytes, |bytes| i64::from(i32::from_le_bytes(bytes))),
                    Element::I64 => each(&bytes, i64::from_le_bytes),
                    _ => bytes.iter().map(|&byte| i64::from(byte)).collect(),
                })
            }
            _ => {
                let numbers = self.numbers(budget, place)?;
                Ok(numbers.into_iter().map(|number| number as i64).collect())
            }
        }
    }

    fn unpacked(&self, budget: &Budget, place: Place) -> Result<std::borrow::Cow<'_, [u8]>, Fault> {
        let Content::Packed {
            count,
            element,
            is_deflated,
            bytes,
            offset,
        } = &self.0
        else {
            return Ok((&[][..]).into());
        };
        let len = u64::from(*count) * element.size() as u64;
        let at = Place::Offset(*offset);
        let wrong = |found: String| {
            let numbers = counted(*count as usize, "number", "numbers");
            at.damaged(format!("An array of {numbers} takes {len} bytes; {found}."))
        };
        // What is made of it has eight bytes for each number.
        budget.unpack(8 * u64::from(*count), place)?;
        if !is_deflated {
            if bytes.len() as u64 != len {
                return Err(wrong(format!("it has {}", bytes.len())));
            }
            return Ok((*bytes).into());
        }
        if len > MOST_GROWTH * bytes.len() as u64 {
            return Err(wrong(format!("{} deflated ones cannot become so many", bytes.len())));
        }
        let unpacked = miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(bytes, len as usize);
        let unpacked = unpacked.map_err(|error| wrong(format!("what is deflated is damaged ({:?})", error.status)))?;
        if unpacked.len() as u64 != len {
            return Err(wrong(format!("{} come out", unpacked.len())));
        }
        Ok(unpacked.into())
    }
}

fn each<const SIZE: usize, T>(bytes: &[u8], of: impl Fn([u8; SIZE]) -> T) -> Vec<T> {
    let (chunks, _) = bytes.as_chunks::<SIZE>();
    chunks.iter().map(|&chunk| of(chunk)).collect()
}
