//! A file while a model is made of it.

use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet, HashMap};

use glam::DAffine3;

use super::objects::ObjectIndex;
use super::settings::Settings;
use crate::diagnostic::collect::Diagnostics;
use crate::diagnostic::{Code, Diagnostic, Fault, Subject};
use crate::fbx::{Budget, Document, Place};

/// A file while a model is made of it, and what is noted of it.
pub(super) struct File<'f, 'a> {
    pub(super) document: &'f Document<'a>,
    pub(super) budget: Budget,
    pub(super) settings: Settings,
    /// How often layers may still be asked how they move a property of a model: a curve can hang on many models, and be one that no keys follow.
    pub(super) evaluations_left: Cell<u64>,
    /// How many corners may still be looked at to cut polygons into triangles: outlines can be made in which each ear meets all others.
    pub(super) ear_tests_left: Cell<u64>,
    /// Of each bone: bone -> world in the file's axes, as the bind pose has it.
    pub(super) bind_pose: HashMap<ObjectIndex, DAffine3>,
    /// Bones that a skin bound elsewhere.
    pub(super) disagreeing: BTreeSet<ObjectIndex>,
    pub(super) noted: Vec<Diagnostic>,
    /// How often each kind of note was told that any number of objects can have.
    pub(super) told: BTreeMap<&'static str, (u32, &'static Code)>,
}

impl File<'_, '_> {
    pub(super) fn note(&mut self, code: &Code, message: String) {
        self.noted.push(code.says(message));
    }

    pub(super) fn note_of(&mut self, place: Place, code: &Code, message: String) {
        self.noted.push(place.says(code, message));
    }

    /// Notes what any number of objects can have: the first few of a kind apart. `kind` names such objects where the rest is told.
    pub(super) fn note_each(
        &mut self,
        place: Place,
        code: &'static Code,
        kind: &'static str,
        message: impl FnOnce() -> String,
    ) {
        let (told, _) = self.told.entry(kind).or_insert((0, code));
        *told += 1;
        if *told <= Diagnostics::MOST_APART {
            self.note_of(place, code, message());
        }
    }

    /// Notes how many of each kind were not told apart.
    pub(super) fn note_rest(&mut self) {
        for (kind, (told, code)) in std::mem::take(&mut self.told) {
            if let Some(rest @ 1..) = told.checked_sub(Diagnostics::MOST_APART) {
                self.note(code, format!("{kind}: {rest} more."));
            }
        }
    }

    pub(super) fn note_about(&mut self, subject: Subject, code: &Code, message: String) {
        self.noted.push(about(subject, code.says(message)));
    }

    pub(super) fn note_at(&mut self, place: Place, subject: Subject, code: &Code, message: String) {
        self.noted.push(about(subject, place.says(code, message)));
    }
}

/// A fault in an object, with the object's name.
pub(super) fn in_object(name: &str) -> impl Fn(Fault) -> Fault {
    move |mut fault| {
        fault.message = format!("In \"{name}\": {}", fault.message);
        fault
    }
}

fn about(subject: Subject, diagnostic: Diagnostic) -> Diagnostic {
    Diagnostic {
        subject: Some(subject),
        subjects: vec![subject],
        ..diagnostic
    }
}
