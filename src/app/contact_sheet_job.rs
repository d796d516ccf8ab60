//! A contact sheet that is drawn one picture at a time, so that the window goes on meanwhile.

use crate::contact_sheet::{ContactSheet, ContactSheetError};
use crate::image::EncodeError;
use crate::render::{PictureError, PictureTarget};
use crate::scene::{Background, Frames, RenderFrame, Shot};
use crate::session::{LookCommand, Series, Session};
use crate::ui::ContactSheetRequest;

/// Why a contact sheet is not drawn to its end.
#[derive(Debug, thiserror::Error)]
pub enum ContactSheetFailure {
    /// It cannot be made in this size.
    #[error(transparent)]
    Layout(#[from] ContactSheetError),
    /// The GPU draws no such picture.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// It cannot be encoded.
    #[error(transparent)]
    Encode(#[from] EncodeError),
    /// The GPU has another model or other maps now.
    #[error("the model changed before all pictures of the contact sheet were drawn")]
    Changed,
}

/// A contact sheet that is being drawn.
pub struct ContactSheetJob {
    series: Series,
    sheet: ContactSheet,
    target: PictureTarget,
    placed: usize,
}

impl ContactSheetJob {
    /// A sheet of what a session shows now: of the clip or the range that plays, or all round. Each picture is the mean of so many.
    ///
    /// # Errors
    /// When there is no room for so many pictures.
    pub fn new(session: &Session, wanted: &ContactSheetRequest, samples: u32) -> Result<Self, ContactSheetFailure> {
        let mut session = session.clone();
        if wanted.transparent {
            session.apply(LookCommand::SetBackground(Background::None));
        }
        let transparent = session.look().background == Background::None;
        let sheet = ContactSheet::new(wanted.size, wanted.cells, session.theme(), transparent)?;
        let [columns, rows] = wanted.cells;
        let count = columns * rows;
        let shots = if wanted.turntable || session.clip().is_none() {
            Shot::series(&[], count)
        } else {
            Shot::series(&Frames::Count(count).times_secs(session.playback().played_secs()), 0)
        };
        let [width, height] = sheet.cell_size().map(|side| side as f32);
        Ok(Self {
            series: Series::new(session, width / height, shots),
            target: PictureTarget::new(sheet.cell_size()).with_mean_of(samples),
            sheet,
            placed: 0,
        })
    }

    /// How many pictures are on the sheet, and how many there will be.
    pub fn progress(&self) -> [usize; 2] {
        [self.placed, self.series.count()]
    }

    pub(super) fn session(&self) -> &Session {
        self.series.session()
    }

    /// The next picture, and what it is drawn into.
    pub(super) fn next(&mut self) -> (RenderFrame<'_>, &mut PictureTarget) {
        (self.series.frame(self.placed), &mut self.target)
    }

    /// Sets the pixels of the next picture into its place.
    pub fn place(&mut self, pixels: &[u8]) {
        self.sheet.place(self.placed, pixels, self.series.caption(self.placed));
        self.placed += 1;
    }

    /// The bytes of a PNG file.
    ///
    /// # Errors
    /// When it cannot be encoded.
    pub fn into_png(self) -> Result<Vec<u8>, ContactSheetFailure> {
        Ok(self.sheet.into_png()?)
    }
}
