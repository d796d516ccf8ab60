//! What of the interface is open, and what it asks of the page around.

use egui::{Rect, Ui};

use super::diagnostics_panel::ShownFinding;
use super::inspector::VertexCount;
use super::keyboard::Keyboard;
use super::picture::PictureChoice;
use super::skeleton::SkeletonState;
use super::thumbnails::Thumbnails;
use super::timeline::TimelineState;
use super::viewport::ViewHold;
use crate::scene::{Insets, Theme};

/// What only the page around the interface can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request {
    /// Let the person pick files.
    PickFiles,
    /// Read the files that were opened last again.
    ReadAgain,
    /// Let the person pick models whose clips join those of the open one.
    PickClips,
    /// Take this theme, whatever the system says.
    UseTheme(Theme),
    /// Save the view as a picture; [`picture_name`](super::picture_name) says how the file is called.
    SavePicture {
        /// Width and height in pixels.
        size: [u32; 2],
        /// Without what is behind the model.
        transparent: bool,
    },
}

/// What the bottom sheet of a narrow window shows below the timeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SheetPage {
    /// Facts, subsets, textures; the selected subset, or the findings while they are open.
    Model,
    /// What of a surface is shown.
    ViewMode,
    /// Light, background, passes.
    Light,
    /// Lines over the model.
    Overlays,
    /// Named directions.
    ViewFrom,
    /// A picture as a file.
    Picture,
    /// Dope sheet and curves.
    Timeline,
}

/// What the model was framed in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Framed {
    pub(super) window: Rect,
    pub(super) model: u64,
    pub(super) insets: Insets,
}

/// Which panels are open. Nothing here changes the model or the picture of it.
#[derive(Debug, Default)]
pub struct UiState {
    /// The table of keys.
    pub help_open: bool,
    /// The list of findings.
    pub diagnostics_open: bool,
    /// In a narrow window: what the bottom sheet shows; shut if nothing.
    pub sheet: Option<SheetPage>,
    pub(super) coarse_pointer: bool,
    pub(super) shown_finding: Option<ShownFinding>,
    /// The names of missing maps are listed.
    pub(super) missing_maps_open: bool,
    /// What was selected in the pass before is to be framed.
    pub(super) frames_selection: bool,
    pub(super) shown_model: u64,
    pub(super) framed: Option<Framed>,
    pub(super) timeline: TimelineState,
    pub(super) picture: PictureChoice,
    pub(super) thumbnails: Thumbnails,
    pub(super) view_hold: ViewHold,
    pub(super) hovered_subset: Option<usize>,
    pub(super) vertex_count: VertexCount,
    pub(super) skeleton: SkeletonState,
    pub(super) keyboard: Keyboard,
    pub(super) requests: Vec<Request>,
}

impl UiState {
    /// Everything shut. `coarse_pointer`: the device says that fingers are its pointer.
    pub fn new(coarse_pointer: bool) -> Self {
        Self {
            coarse_pointer,
            ..Self::default()
        }
    }

    /// Whether fingers are the device's pointer.
    pub fn coarse_pointer(&self) -> bool {
        self.coarse_pointer
    }

    pub(super) fn read_again(&mut self) {
        self.requests.push(Request::ReadAgain);
    }

    /// What was asked of the page since the last call.
    pub fn take_requests(&mut self) -> Vec<Request> {
        std::mem::take(&mut self.requests)
    }

    /// Asks for a picture as it was chosen, or without ground in any case.
    pub(super) fn save_picture(&mut self, ui: &Ui, transparent: bool) {
        let size = self.picture.size_in_pixels(ui);
        self.requests.push(Request::SavePicture {
            size,
            transparent: transparent || self.picture.transparent,
        });
    }
}
