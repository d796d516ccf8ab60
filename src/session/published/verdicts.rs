//! What the books' programs make of the open file.

use std::sync::OnceLock;

use crate::check::book::{self, Book, Known, Limit, MOST_MATERIALS, Verdict};
use crate::diagnostic::codes::{self, HAS_REPORTS};
use crate::edit::too_large_for_book;
use crate::model::Model;
use crate::session::open::maps::Maps;
use crate::session::open::open_model::OpenModel;
use crate::slices::{Slices, Stage, at_once};

/// The verdict of each book. Opening a model works them out, since each program reads the file anew.
#[derive(Clone, Debug, Default)]
pub(in crate::session) struct Verdicts {
    of_books: OnceLock<Vec<Verdict>>,
    converted: OnceLock<Vec<Limit>>,
}

impl Verdicts {
    /// Those of the open model with its maps, in the order of [`Book::ALL`]; none for other formats than the books'. They are worked out
    /// at the first call.
    pub(in crate::session) fn of(&self, open: &OpenModel, maps: &Maps) -> &[Verdict] {
        at_once(self.of_in(open, maps, &Slices::ENDLESS))
    }

    /// [`Verdicts::of`] in slices.
    pub(in crate::session) async fn of_in(&self, open: &OpenModel, maps: &Maps, slices: &Slices) -> &[Verdict] {
        if let Some(verdicts) = self.of_books.get() {
            return verdicts;
        }
        let verdicts = of_books(open, maps, slices).await;
        self.of_books.get_or_init(|| verdicts)
    }

    /// What the open model exceeds even converted for the books; `None` for their own format.
    pub(in crate::session) fn converted(&self, open: &OpenModel) -> Option<&[Limit]> {
        let limits = || limits_once_converted(&open.model, &Book::ALL);
        let is_other = open.format.dialect().is_none();
        is_other.then(|| &**self.converted.get_or_init(limits))
    }

    pub(in crate::session) fn forget(&mut self) {
        *self = Self::default();
    }
}

/// The missing maps that verdicts tell of. Without any picture nobody meant to bring maps.
pub(in crate::session) fn missing_maps(maps: &Maps) -> Option<&[String]> {
    (!maps.pictures().is_empty()).then(|| &*maps.checklist().missing)
}

async fn of_books(open: &OpenModel, maps: &Maps, slices: &Slices) -> Vec<Verdict> {
    if !HAS_REPORTS || open.format.dialect().is_none() {
        return Vec::new();
    }
    let bytes = &open.file.bytes;
    let count = Book::ALL.len();
    // Reading the file again takes about as long as the program of a book does.
    let parts = [(Some(Stage::Judging), 1), (Some(Stage::Judging), count)];
    let again = &slices.for_files(Stage::Reading..=Stage::Reading, Stage::Judging..=Stage::Judging, &parts)[0];
    let Some(parsed) = open.source.parsed_in(bytes, again).await else {
        return Vec::new();
    };
    let known = Known {
        document: Some(&parsed.document),
        quick: Some(&parsed.quick),
        handedness: Some(open.model.handedness),
        missing_maps: missing_maps(maps),
    };
    let mut verdicts = Vec::new();
    for (done, book) in (1..).zip(Book::ALL) {
        slices.pause_at(Stage::Judging, done, count + 1).await;
        verdicts.push(book::verdict_in(book, bytes, &known, slices).await);
    }
    verdicts
}

/// What a model of another format exceeds in the demos of these books even when it is converted for them: what the export for the book
/// refuses, and more materials than the demo has room for. Each submesh becomes a material there.
pub fn limits_once_converted(model: &Model, books: &[Book]) -> Vec<Limit> {
    let count = model.mesh.submeshes.len();
    let message = format!(
        "It has {count} materials, counting each for each part that it is on; the demo reaches the maps of {MOST_MATERIALS}."
    );
    let is_many = books.contains(&Book::D3d12) && count > MOST_MATERIALS;
    let of_materials = is_many.then_some((&codes::BOOK_MANY_MATERIALS, message));
    let all = too_large_for_book(model).into_iter().chain(of_materials);
    all.map(|(code, message)| Limit {
        code: code.name,
        message,
    })
    .collect()
}
