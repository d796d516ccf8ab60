//! What a file has: records with values, in trees.

use std::borrow::Cow;

use super::array::{Array, Budget};
use super::place::Place;
use crate::diagnostic::collect::quoted;
use crate::diagnostic::{Fault, codes};
use crate::slices::{Slices, at_once};

/// What no file of people has more of, one in the other.
const MOST_DEPTH: usize = 64;

/// A file as it was read. It borrows from its bytes.
#[derive(Clone, Debug)]
pub struct Document<'a> {
    /// Such as 6100, 7400 or 7700.
    pub version: u32,
    /// Whether it is binary.
    pub is_binary: bool,
    /// What stands at the top, in its order.
    pub records: Vec<Record<'a>>,
}

/// A name with values, and what is in it.
#[derive(Clone, Debug, Default)]
pub struct Record<'a> {
    /// `Objects`, `Vertices`, `P`, …
    pub name: Cow<'a, str>,
    /// In their order.
    pub values: Vec<Value<'a>>,
    /// In their order.
    pub records: Vec<Record<'a>>,
    /// Where it begins.
    pub place: Place,
}

/// A value of a record.
#[derive(Clone, Debug)]
pub enum Value<'a> {
    /// A whole number, or whether something is so.
    Integer(i64),
    /// Any other number.
    Number(f64),
    /// A text or a word, as the file has it.
    Text(Cow<'a, [u8]>),
    /// Numbers of one kind. Those of version 6.1 stand in the record itself and are collected.
    Array(Array<'a>),
}

impl<'a> Record<'a> {
    /// The first record of this name in it.
    pub fn find(&self, name: &str) -> Option<&Record<'a>> {
        self.records.iter().find(|record| record.name == name)
    }

    /// The records of this name in it.
    pub fn all<'s>(&'s self, name: &'s str) -> impl Iterator<Item = &'s Record<'a>> {
        self.records.iter().filter(move |record| record.name == name)
    }

    /// The value at this place, if it is a whole number.
    pub fn integer(&self, index: usize) -> Option<i64> {
        match self.values.get(index)? {
            Value::Integer(value) => Some(*value),
            Value::Number(value) if value.fract() == 0.0 && value.abs() < 2f64.powi(53) => Some(*value as i64),
            _ => None,
        }
    }

    /// The value at this place, if it is a number.
    pub fn number(&self, index: usize) -> Option<f64> {
        match self.values.get(index)? {
            Value::Integer(value) => Some(*value as f64),
            Value::Number(value) => Some(*value),
            _ => None,
        }
    }

    /// The value at this place, if it is a text. What is no UTF-8 is replaced.
    pub fn text(&self, index: usize) -> Option<Cow<'_, str>> {
        self.bytes(index).map(String::from_utf8_lossy)
    }

    /// The same as it stands in the file.
    pub fn bytes(&self, index: usize) -> Option<&[u8]> {
        match self.values.get(index)? {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The numbers that the record holds: its array, or its values where all are numbers.
    ///
    /// # Errors
    /// When the array is damaged, or `budget` has no room for it.
    pub fn numbers(&self, budget: &Budget) -> Result<Vec<f64>, Fault> {
        at_once(self.numbers_in(budget, &Slices::ENDLESS))
    }

    /// [`numbers`](Self::numbers) in slices.
    ///
    /// # Errors
    /// As [`numbers`](Self::numbers).
    pub async fn numbers_in(&self, budget: &Budget, slices: &Slices) -> Result<Vec<f64>, Fault> {
        match self.values.as_slice() {
            [Value::Array(array)] => {
                let numbers = array.numbers(budget, self.place, slices).await;
                numbers.map_err(|fault| self.named(fault))
            }
            values => Ok((0..values.len()).map_while(|index| self.number(index)).collect()),
        }
    }

    /// The same as whole numbers.
    ///
    /// # Errors
    /// As [`numbers`](Self::numbers).
    pub fn integers(&self, budget: &Budget) -> Result<Vec<i64>, Fault> {
        at_once(self.integers_in(budget, &Slices::ENDLESS))
    }

    /// [`integers`](Self::integers) in slices.
    ///
    /// # Errors
    /// As [`numbers`](Self::numbers).
    pub async fn integers_in(&self, budget: &Budget, slices: &Slices) -> Result<Vec<i64>, Fault> {
        match self.values.as_slice() {
            [Value::Array(array)] => {
                let integers = array.integers(budget, self.place, slices).await;
                integers.map_err(|fault| self.named(fault))
            }
            values => Ok((0..values.len()).map_while(|index| self.integer(index)).collect()),
        }
    }

    /// The numbers of the record of this name in it; none where there is no such.
    ///
    /// # Errors
    /// As [`numbers`](Self::numbers).
    pub fn numbers_of(&self, name: &str, budget: &Budget) -> Result<Vec<f64>, Fault> {
        self.find(name).map_or(Ok(Vec::new()), |found| found.numbers(budget))
    }

    /// The same as whole numbers.
    ///
    /// # Errors
    /// As [`numbers`](Self::numbers).
    pub fn integers_of(&self, name: &str, budget: &Budget) -> Result<Vec<i64>, Fault> {
        self.find(name).map_or(Ok(Vec::new()), |found| found.integers(budget))
    }

    /// A fault in the record, with its name.
    pub(super) fn named(&self, mut fault: Fault) -> Fault {
        // What is no file of people may have one of any length.
        let name = self.name.get(..40).unwrap_or(&self.name);
        fault.message = format!("{name}: {}", fault.message);
        fault
    }

    /// The name of an object, without its class, from its value at this place: `Cube`. Binary files part them by two bytes, and have the name first.
    pub fn name_of(&self, index: usize) -> Option<Cow<'_, str>> {
        let text = self.bytes(index)?;
        let name = match (memchr::memmem::find(text, b"\0\x01"), memchr::memmem::find(text, b"::")) {
            (Some(at), _) => &text[..at],
            (None, Some(at)) => &text[at + 2..],
            (None, None) => text,
        };
        Some(String::from_utf8_lossy(name))
    }
}

impl<'a> Document<'a> {
    /// The first record of this name at the top.
    pub fn find(&self, name: &str) -> Option<&Record<'a>> {
        self.records.iter().find(|record| record.name == name)
    }
}

/// Whether a version is one that is read.
pub(super) fn check_version(version: u32, place: Place) -> Result<(), Fault> {
    if (6000..8000).contains(&version) {
        return Ok(());
    }
    let message = format!(
        "The file is of FBX version {}.{}; 6.1 and 7.0 to 7.7 are read.",
        version / 1000,
        version / 100 % 10
    );
    Err(Box::new(place.says(&codes::FBX_VERSION, message)))
}

/// Records that are open, the outermost first, and those that are done.
#[derive(Debug, Default)]
pub(super) struct Growing<'a> {
    pub(super) open: Vec<Record<'a>>,
    pub(super) done: Vec<Record<'a>>,
}

impl<'a> Growing<'a> {
    pub(super) fn open(&mut self, record: Record<'a>) -> Result<(), Fault> {
        if self.open.len() == MOST_DEPTH {
            return Err(record
                .place
                .damaged(format!("More than {MOST_DEPTH} records lie one in the other.")));
        }
        self.open.push(record);
        Ok(())
    }

    pub(super) fn add(&mut self, record: Record<'a>) {
        match self.open.last_mut() {
            Some(parent) => parent.records.push(record),
            None => self.done.push(record),
        }
    }

    /// A fault in the innermost one, with the name of the object that it is of: the first text of the record, behind its number.
    pub(super) fn named(&self, mut fault: Fault) -> Fault {
        let name = |record: &Record<'a>| {
            record
                .name_of(usize::from(record.bytes(0).is_none()))
                .map(Cow::into_owned)
        };
        let name = self.open.iter().rev().find_map(name).filter(|name| !name.is_empty());
        if let Some(name) = name {
            fault.message = format!("In {}: {}", quoted(&name), fault.message);
        }
        fault
    }

    /// Ends the innermost one. Whether there was one.
    pub(super) fn close(&mut self) -> bool {
        let Some(record) = self.open.pop() else { return false };
        self.add(record);
        true
    }
}
