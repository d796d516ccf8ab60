//! The objects of a file, what they hang on, and their properties.
//!
//! Files from 7.0 on number their objects; those of 6.1 go by name and class. A property that an object does not have it has from the template of its
//! class in `Definitions`.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use glam::DVec3;

use crate::fbx::{Document, Place, Record};
use crate::sorting;

/// An object by its number among all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct ObjectIndex(pub(super) u32);

impl ObjectIndex {
    pub(super) fn index(self) -> usize {
        self.0 as usize
    }
}

/// An object.
#[derive(Clone, Debug)]
pub(super) struct Object<'f, 'a> {
    pub(super) record: &'f Record<'a>,
    pub(super) name: Cow<'f, str>,
    /// `Mesh`, `LimbNode`, `Skin`, `Cluster`, …
    pub(super) kind: Cow<'f, str>,
    /// Those of its own.
    properties: Properties<'f, 'a>,
    /// Those of its class.
    template: Option<Rc<Template<'f, 'a>>>,
    /// What hangs on it, by class; of each class in the file's order.
    pub(super) children: Vec<Connection<'f>>,
    /// What it hangs on.
    pub(super) parents: Vec<Connection<'f>>,
}

/// Properties of an object's own: few are looked through, many are found by name, as others may ask for them often.
#[derive(Clone, Debug)]
enum Properties<'f, 'a> {
    Few(Option<&'f Record<'a>>),
    Many(Rc<Template<'f, 'a>>),
}

/// That an object hangs on another one.
#[derive(Clone, Debug)]
pub(super) struct Connection<'f> {
    /// The other one.
    pub(super) to: ObjectIndex,
    /// The property on which it hangs; empty for the object itself.
    pub(super) property: Cow<'f, str>,
}

/// All objects of a file.
#[derive(Debug, Default)]
pub(super) struct Objects<'f, 'a> {
    pub(super) all: Vec<Object<'f, 'a>>,
    /// Where ids come a second time.
    pub(super) doubled: Vec<Place>,
    /// Where connections name what is not there.
    pub(super) missing: Vec<Place>,
    by_key: HashMap<Key<'f>, ObjectIndex>,
}

/// What names an object: its number, or in 6.1 its name as the file has it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Key<'f> {
    Number(i64),
    Name(&'f [u8]),
}

fn key<'f>(record: &'f Record<'_>, index: usize) -> Option<Key<'f>> {
    let number = record.integer(index).map(Key::Number);
    number.or_else(|| record.bytes(index).map(Key::Name))
}

impl Key<'_> {
    fn is_scene(&self) -> bool {
        match self {
            Self::Number(number) => *number == 0,
            Self::Name(name) => matches!(*name, b"Model::Scene" | b"Scene\0\x01Model"),
        }
    }
}

impl<'f, 'a> Objects<'f, 'a> {
    pub(super) fn of(document: &'f Document<'a>) -> Self {
        let mut objects = Self::default();
        let mut by_key = HashMap::new();
        let templates = templates(document);
        for record in document
            .find("Objects")
            .into_iter()
            .flat_map(|objects| &objects.records)
        {
            let Some(key) = key(record, 0) else { continue };
            // Those of 6.1 have no number before the name.
            let at_name = usize::from(matches!(key, Key::Number(_)));
            let name = shortened(record.name_of(at_name).unwrap_or_default());
            let properties = record.find("Properties70").or_else(|| record.find("Properties60"));
            let properties = match properties.filter(|properties| properties.records.len() > MOST_LOOKED_THROUGH) {
                Some(many) => Properties::Many(Rc::new(by_name(many))),
                None => Properties::Few(properties),
            };
            if by_key.contains_key(&key) {
                objects.doubled.push(record.place);
                continue;
            }
            by_key.insert(key, ObjectIndex(objects.all.len() as u32));
            objects.all.push(Object {
                record,
                name,
                kind: record.text(at_name + 1).unwrap_or_default(),
                properties,
                template: templates.get(&*record.name).cloned(),
                children: Vec::new(),
                parents: Vec::new(),
            });
        }
        let mut known = HashSet::new();
        let connections = document.find("Connections").into_iter().flat_map(|all| &all.records);
        for record in connections.filter(|record| matches!(&*record.name, "C" | "Connect")) {
            let (Some(child), Some(parent)) = (key(record, 1), key(record, 2)) else {
                continue;
            };
            let [of_child, of_parent] = [&child, &parent].map(|key| by_key.get(key).copied());
            match (of_child, of_parent) {
                (Some(child), Some(parent)) => {
                    let property = shortened(record.text(3).unwrap_or_default());
                    // Some stand there twice.
                    if !known.insert((child, parent, property.clone())) {
                        continue;
                    }
                    let connection = |to| Connection {
                        to,
                        property: property.clone(),
                    };
                    objects.all[parent.index()].children.push(connection(child));
                    objects.all[child.index()].parents.push(connection(parent));
                }
                (Some(_), None) if parent.is_scene() => (),
                _ => objects.missing.push(record.place),
            }
        }
        let classes: Vec<&str> = objects.all.iter().map(|object| &*object.record.name).collect();
        for object in &mut objects.all {
            sorting::sort_by_key(&mut object.children, |child| classes[child.to.index()]);
        }
        objects.by_key = by_key;
        objects
    }

    /// The object that the value of a record names.
    pub(super) fn by_key(&self, record: &Record<'_>, index: usize) -> Option<ObjectIndex> {
        self.by_key.get(&key(record, index)?).copied()
    }

    /// The object of this name with its class, as files of 6.1 have it.
    pub(super) fn named(&self, name: &[u8]) -> Option<ObjectIndex> {
        self.by_key.get(&Key::Name(name)).copied()
    }

    pub(super) fn get(&self, index: ObjectIndex) -> &Object<'f, 'a> {
        &self.all[index.index()]
    }

    /// The objects of a class, such as `Model`.
    pub(super) fn of_class<'s>(&'s self, class: &'s str) -> impl Iterator<Item = (ObjectIndex, &'s Object<'f, 'a>)> {
        let all = (0u32..).map(ObjectIndex).zip(&self.all);
        all.filter(move |(_, object)| object.record.name == class)
    }

    /// What hangs on an object and is of a class, in the file's order.
    pub(super) fn hanging<'s>(&self, on: &'s Object<'f, 'a>, class: &str) -> &'s [Connection<'f>] {
        let class_of = |child: &Connection<'_>| &*self.get(child.to).record.name;
        let from = &on.children[on.children.partition_point(|child| class_of(child) < class)..];
        &from[..from.partition_point(|child| class_of(child) == class)]
    }

    /// The children of an object that are of a class, in the file's order.
    pub(super) fn children<'s>(
        &'s self,
        of: &'s Object<'f, 'a>,
        class: &str,
    ) -> impl Iterator<Item = (ObjectIndex, &'s Object<'f, 'a>)> {
        let children = self.hanging(of, class).iter();
        children.map(|child| (child.to, self.get(child.to)))
    }
}

/// Names and properties are told and kept for each use of an object.
fn shortened(name: Cow<'_, str>) -> Cow<'_, str> {
    const MOST_BYTES: usize = 1024;
    if name.len() <= MOST_BYTES {
        return name;
    }
    let end = (0..=MOST_BYTES)
        .rev()
        .find(|&end| name.is_char_boundary(end))
        .unwrap_or(0);
    Cow::Owned(name[..end].to_owned())
}

/// The properties that objects of each class have, by its name.
fn templates<'f, 'a>(document: &'f Document<'a>) -> HashMap<Cow<'f, str>, Rc<Template<'f, 'a>>> {
    let types = document
        .find("Definitions")
        .into_iter()
        .flat_map(|all| all.all("ObjectType"));
    let of_type = |record: &'f Record<'a>| {
        let properties = record.find("PropertyTemplate")?.find("Properties70")?;
        Some((record.text(0)?, Rc::new(by_name(properties))))
    };
    types.filter_map(of_type).collect()
}

/// More properties than these are found by name.
const MOST_LOOKED_THROUGH: usize = 64;

/// Properties by their names: each has a record, and the index of its first value in it.
type Template<'f, 'a> = HashMap<&'f [u8], (&'f Record<'a>, usize)>;

fn by_name<'f, 'a>(properties: &'f Record<'a>) -> Template<'f, 'a> {
    let named = properties.records.iter();
    let named = named.filter_map(|record| Some((record.bytes(0)?, (record, values_at(record)))));
    named.collect()
}

/// The record of a property, and the index of its first value. Of two of one name the last one counts.
pub(super) fn property<'s, 'a>(properties: &'s Record<'a>, name: &str) -> Option<(&'s Record<'a>, usize)> {
    let mut named = properties.records.iter();
    let record = named.rfind(|record| record.bytes(0) == Some(name.as_bytes()))?;
    Some((record, values_at(record)))
}

/// `P: name, type, label, flags, values`; `Property: name, type, flags, values`.
fn values_at(record: &Record<'_>) -> usize {
    if record.name == "P" { 4 } else { 3 }
}

impl<'f, 'a> Object<'f, 'a> {
    fn property(&self, name: &str) -> Option<(&'f Record<'a>, usize)> {
        let own = match &self.properties {
            Properties::Few(few) => few.and_then(|few| property(few, name)),
            Properties::Many(many) => many.get(name.as_bytes()).copied(),
        };
        own.or_else(|| self.template.as_ref()?.get(name.as_bytes()).copied())
    }

    /// A property of the object's own or of its class.
    pub(super) fn number(&self, name: &str) -> Option<f64> {
        let (record, at) = self.property(name)?;
        record.number(at)
    }

    /// A property with three numbers.
    pub(super) fn vector(&self, name: &str) -> Option<DVec3> {
        let (record, at) = self.property(name)?;
        Some(DVec3::new(
            record.number(at)?,
            record.number(at + 1)?,
            record.number(at + 2)?,
        ))
    }

    pub(super) fn integer(&self, name: &str) -> Option<i64> {
        let (record, at) = self.property(name)?;
        record.integer(at)
    }
}
