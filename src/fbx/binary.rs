//! Binary files.

use std::borrow::Cow;

use super::array::{Array, Content, Element};
use super::document::{Document, Growing, Record, Value, check_version};
use super::place::Place;
use crate::diagnostic::Fault;
use crate::diagnostic::collect::counted;
use crate::slices::Slices;

pub(super) const MAGIC: &[u8] = b"Kaydara FBX Binary  \0";
/// Behind the magic: 1A 00.
const VERSION_AT: usize = 23;
/// From this version on sizes have 64 bits.
const WIDE_SINCE: u32 = 7500;

struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    is_wide: bool,
}

/// What stands before a record's values.
struct Head {
    end: usize,
    value_count: u64,
    values_len: usize,
}

pub(super) async fn parse<'a>(bytes: &'a [u8], slices: &Slices) -> Result<Document<'a>, Fault> {
    let mut reader = Reader {
        bytes,
        at: VERSION_AT,
        is_wide: false,
    };
    let version = u32::from_le_bytes(reader.array()?);
    check_version(version, Place::Offset(VERSION_AT as u64))?;
    reader.is_wide = version >= WIDE_SINCE;
    let mut growing = Growing::default();
    // Of the records that are open.
    let mut ends: Vec<usize> = Vec::new();
    for count in 0.. {
        slices.pause_before(count).await;
        while ends.last() == Some(&reader.at) {
            ends.pop();
            growing.close();
        }
        // Some writers end there.
        if reader.at == bytes.len() {
            break;
        }
        let place = reader.place();
        let limit = ends.last().copied().unwrap_or(bytes.len());
        let Some(head) = reader.head(limit)? else {
            if let Some(end) = ends.pop() {
                if reader.at != end {
                    return Err(place.damaged(format!("A record ends here; it says that it ends at byte {end}.")));
                }
                growing.close();
                continue;
            }
            break;
        };
        let record = reader.record(&head, place)?;
        if reader.at < head.end {
            growing.open(record)?;
            ends.push(head.end);
        } else {
            growing.add(record);
        }
    }
    Ok(Document {
        version,
        is_binary: true,
        records: growing.done,
    })
}

impl<'a> Reader<'a> {
    fn place(&self) -> Place {
        Place::Offset(self.at as u64)
    }

    fn take(&mut self, len: usize) -> Result<&'a [u8], Fault> {
        let taken = self.bytes.get(self.at..).and_then(|rest| rest.get(..len));
        let taken = taken.ok_or_else(|| {
            let left = self.bytes.len().saturating_sub(self.at);
            self.place().damaged(format!(
                "The file ends here: {} needed, and {left} left.",
                counted(len, "byte is", "bytes are")
            ))
        })?;
        self.at += len;
        Ok(taken)
    }

    fn array<const LEN: usize>(&mut self) -> Result<[u8; LEN], Fault> {
        let mut array = [0; LEN];
        array.copy_from_slice(self.take(LEN)?);
        Ok(array)
    }

    fn u32(&mut self) -> Result<u32, Fault> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    fn size(&mut self) -> Result<u64, Fault> {
        if self.is_wide {
            return Ok(u64::from_le_bytes(self.array()?));
        }
        self.u32().map(u64::from)
    }

    /// What stands before a record, which ends at `limit` at the latest; `None` where a list of records ends.
    fn head(&mut self, limit: usize) -> Result<Option<Head>, Fault> {
        let place = self.place();
        let [mut end, value_count, values_len] = [self.size()?, self.size()?, self.size()?];
        if end == 0 {
            let name_len = u64::from(self.take(1)?[0]);
            if name_len == 0 {
                return Ok(None);
            }
            // Maya has some that say no end; nothing is in them.
            end = (self.at as u64).saturating_add(name_len).saturating_add(values_len);
            self.at -= 1;
        }
        let is_within = |end: u64| end > self.at as u64 && end <= limit as u64;
        if end > limit as u64 && limit == self.bytes.len() {
            return Err(place.damaged(format!(
                "The file ends at byte {limit}, within a record that goes on to byte {end}. It may have been cut off on its way here."
            )));
        }
        if !is_within(end) || values_len > end - self.at as u64 {
            return Err(place.damaged(format!(
                "A record says that it ends at byte {end} with {} of values; what it lies in ends at byte {limit}.",
                counted(values_len as usize, "byte", "bytes")
            )));
        }
        Ok(Some(Head {
            end: end as usize,
            value_count,
            values_len: values_len as usize,
        }))
    }

    /// Name and values of a record.
    fn record(&mut self, head: &Head, place: Place) -> Result<Record<'a>, Fault> {
        let [name_len] = self.array()?;
        let name = String::from_utf8_lossy(self.take(usize::from(name_len))?);
        let values_end = self.at + head.values_len;
        let mut values = Vec::new();
        for _ in 0..head.value_count {
            values.push(self.value()?);
        }
        if self.at != values_end || values_end > head.end {
            return Err(place.damaged(format!(
                "The values of {name} take {} more or fewer than the record says.",
                counted(self.at.abs_diff(values_end), "byte", "bytes")
            )));
        }
        Ok(Record {
            name,
            values,
            records: Vec::new(),
            place,
        })
    }

    fn value(&mut self) -> Result<Value<'a>, Fault> {
        let place = self.place();
        let [kind] = self.array()?;
        let element = match kind {
            b'B' | b'C' | b'Z' => return Ok(Value::Integer(i64::from(u8::from_le_bytes(self.array()?)))),
            b'Y' => return Ok(Value::Integer(i64::from(i16::from_le_bytes(self.array()?)))),
            b'I' => return Ok(Value::Integer(i64::from(i32::from_le_bytes(self.array()?)))),
            b'L' => return Ok(Value::Integer(i64::from_le_bytes(self.array()?))),
            b'F' => return Ok(Value::Number(f64::from(f32::from_le_bytes(self.array()?)))),
            b'D' => return Ok(Value::Number(f64::from_le_bytes(self.array()?))),
            b'S' | b'R' => {
                let len = self.u32()? as usize;
                return Ok(Value::Text(Cow::Borrowed(self.take(len)?)));
            }
            b'b' | b'c' => Element::U8,
            b'i' => Element::I32,
            b'l' => Element::I64,
            b'f' => Element::F32,
            b'd' => Element::F64,
            _ => {
                let found = char::from(kind).escape_default();
                return Err(place.damaged(format!("A value is of the kind \"{found}\", which is none of FBX.")));
            }
        };
        let [count, encoding, len] = [self.u32()?, self.u32()?, self.u32()?];
        if encoding > 1 {
            return Err(place.damaged(format!("An array is packed by method {encoding}; 0 and 1 are known.")));
        }
        let offset = self.at as u64;
        Ok(Value::Array(Array(Content::Packed {
            count,
            element,
            is_deflated: encoding == 1,
            bytes: self.take(len as usize)?,
            offset,
        })))
    }
}
