//! Which parts of the interface are open, and what it asks of the page around it.

use egui::{Rect, Ui};

use super::input::{Grip, Keyboard};
use super::timeline::state::TimelineState;
use crate::model::JointIndex;
use crate::modes::modes;
use crate::scene::{Insets, Theme};
use crate::session::{ExportOptions, Session};
use crate::ui::kit::Kept;
use crate::ui::kit::theme::Contrast;
use crate::ui::panels::cost::SteadyCost;
use crate::ui::panels::findings::state::FindingsState;
use crate::ui::panels::skeleton::state::{SidePage, SkeletonState};
use crate::ui::panels::thumbnails::Thumbnails;
use crate::ui::rim::announce::{Announcement, Announcer};
use crate::ui::window::drawer::DrawerHeight;
use crate::ui::window::focus::Focus;
use crate::ui::window::message::Messages;
use crate::ui::window::viewport::ViewHold;

/// Names of panels in links. Sheets of the timeline and pages of the drawer have theirs.
const SKELETON: &str = "skeleton";
const FINDINGS: &str = "findings";
const EXPLAINED: &str = "explained";

/// The longest side of a picture, in pixels.
pub const MAX_PICTURE_SIDE: u32 = 8192;

/// What only the page around the interface can do.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    PickFiles,
    /// Read the files opened last once more.
    ReadAgain,
    /// Let the person pick models whose clips join those of the open one.
    PickClips,
    /// Save the last picture once more, where the person chooses.
    SavePictureAs,
    /// Save the view as a picture; [`picture_name`](crate::ui::picture_name) says how the file is called.
    SavePicture {
        /// Width and height in pixels.
        size: [u32; 2],
        /// Without a background.
        transparent: bool,
        /// See [`FrameOptions::aperture`](crate::scene::FrameOptions::aperture).
        aperture: f32,
    },
    /// Save a contact sheet; [`contact_sheet_name`](crate::ui::contact_sheet_name) says how the file is called.
    SaveContactSheet(ContactSheetRequest),
    /// Save the report of all that was found in the open file; [`report_name`](crate::ui::report_name) says how the file is called.
    SaveReport,
    /// Show the page of codes at this one.
    ExplainCode(&'static str),
    /// Remember that the person does not want the greeting.
    CloseGreeting,
    /// Copy a link to what is seen; `embed`: as an element for other pages.
    CopyLink {
        embed: bool,
    },
    Announce(Announcement),
}

/// A contact sheet as it is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContactSheetRequest {
    /// Width and height of the whole sheet in pixels.
    pub size: [u32; 2],
    /// Columns and rows of pictures.
    pub cells: [u32; 2],
    /// From all sides, instead of at times of the clip. It is so in any case where there is no clip.
    pub turntable: bool,
    /// Without a background.
    pub transparent: bool,
}

modes! {
    /// What the drawer of a narrow window shows below the timeline.
    pub enum DrawerPage {
        /// The page of the panel that is on the left of a wide window: facts, or the tree of joints. Instead of all tabs the diagnostics while
        /// they are open.
        Model = "sheet-model", "Model";
        Selection = "sheet-selection", "Selection";
        ViewMode = "sheet-view", "View mode";
        Light = "sheet-light", "Light and background";
        /// Lines over the model.
        Overlays = "sheet-lines", "Lines over the model";
        ViewFrom = "sheet-from", "View from";
        /// A picture as a file.
        Picture = "sheet-picture", "Picture";
        /// The model as a file of another format.
        Export = "sheet-export", "Export";
        Timeline = "sheet-timeline", "Timeline";
    }
}

modes! {
    /// How much of the interface there is.
    #[derive(Default)]
    pub enum Chrome {
        /// The picture alone, with what tells that a file cannot be opened.
        None = "none", "None";
        /// The picture and the timeline.
        Transport = "transport", "Transport";
        #[default]
        Full = "full", "Full";
    }
}

impl DrawerPage {
    /// Whether it is one of those between which a switch goes.
    pub(super) fn is_tab(self) -> bool {
        matches!(self, Self::Model | Self::Selection)
    }
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
    /// What the page is for, and the table of keys.
    pub help_open: bool,
    pub chrome: Chrome,
    pub diagnostics_open: bool,
    /// What was just done, in a few words.
    pub messages: Messages,
    /// Since when something is being opened, in the seconds of the context.
    pub(in crate::ui) opening_since: Option<f64>,
    /// What the drawer of a narrow window shows. None while it is closed.
    pub drawer: Option<DrawerPage>,
    /// How much contrast the person asks for.
    pub contrast: Contrast,
    pub theme: Option<Theme>,
    /// A sentence above the timeline for somebody who has opened nothing yet, with a button that does.
    pub greeting: Option<String>,
    pub(super) drawer_height: DrawerHeight,
    pub(super) cost: SteadyCost,
    /// The camera was moved by hand, and the panels have changed since: a button offers to frame the model.
    pub(super) offers_frame: bool,
    pub(super) coarse_pointer: bool,
    pub(super) findings: FindingsState,
    pub(super) maps_open: bool,
    /// What was selected in this pass will be framed in the next.
    pub(super) frames_selection: bool,
    pub(super) shown_model: u64,
    pub(super) shown_file: Option<String>,
    pub(super) framed: Option<Framed>,
    pub(super) timeline: TimelineState,
    pub(super) picture: PictureChoice,
    /// The contact sheet that is being drawn.
    pub(super) drawn_sheet: Option<DrawnSheet>,
    pub(super) export: ExportChoice,
    pub(super) thumbnails: Thumbnails,
    pub(super) view_hold: ViewHold,
    pub(super) hovered_submesh: Option<usize>,
    /// How many vertices a submesh of a model has.
    pub(super) vertex_count: Kept<(u64, usize), usize>,
    pub(super) skeleton: SkeletonState,
    /// Width of the panel on the left, once it was dragged to another.
    pub(super) side_width: Option<f32>,
    pub(super) keyboard: Keyboard,
    pub(super) grip: Option<Grip>,
    /// What was selected in the pass before.
    pub(super) shown_selection: Selection,
    pub(super) focus: Focus,
    pub(super) requests: Vec<Request>,
    pub(super) announcer: Announcer,
}

impl UiState {
    /// Everything closed. `coarse_pointer`: the device says that its pointer is a finger.
    pub fn new(coarse_pointer: bool) -> Self {
        let mut state = Self {
            coarse_pointer,
            ..Self::default()
        };
        // A file of the books is for their demo until the person wants it otherwise.
        state.export.options.for_book = true;
        state
    }

    /// Every panel as at first, for the same person.
    pub fn start_over(&mut self) {
        *self = Self {
            contrast: self.contrast,
            chrome: self.chrome,
            ..Self::new(self.coarse_pointer)
        };
    }

    /// Goes on in another egui context: what is held, focused or on the GPU stays with the old one. `coarse_pointer` as in [`Self::new`].
    pub(crate) fn change_context(&mut self, coarse_pointer: bool) {
        self.coarse_pointer = coarse_pointer;
        (self.thumbnails, self.focus, self.keyboard) = Default::default();
        (self.view_hold, self.grip, self.framed) = Default::default();
    }

    /// Shows the tree of joints: in the panel on the left, and in the drawer of a narrow window.
    pub fn show_skeleton(&mut self, session: &Session) {
        self.skeleton.show_page(session, SidePage::Skeleton);
        self.diagnostics_open = false;
        self.drawer = Some(DrawerPage::Model);
    }

    /// The names of open panels, for links.
    pub fn open_panels(&self) -> Vec<String> {
        let skeleton = (self.skeleton.page == SidePage::Skeleton).then_some(SKELETON);
        let findings = self.diagnostics_open.then_some(FINDINGS);
        let explained = self.skeleton.explains.then_some(EXPLAINED);
        let drawer = self.drawer.map(DrawerPage::name);
        let names = [skeleton, findings, explained, self.timeline.open_sheet(), drawer];
        names.into_iter().flatten().map(str::to_owned).collect()
    }

    /// Opens the panels of these names, and no others. Returns the names that are none.
    pub fn open_these_panels(&mut self, session: &Session, names: &[String]) -> Vec<String> {
        // It may come before the first pass with its model.
        self.follow_model(session);
        let has = |name: &str| names.iter().any(|open| open == name);
        let page = if has(SKELETON) {
            SidePage::Skeleton
        } else {
            SidePage::Model
        };
        self.skeleton.show_linked_page(session, page);
        self.diagnostics_open = has(FINDINGS);
        self.skeleton.explains = has(EXPLAINED);
        self.timeline.open_this_sheet(names);
        self.drawer = names.iter().find_map(|name| DrawerPage::from_name(name));
        let is_known = |name: &str| {
            [SKELETON, FINDINGS, EXPLAINED].contains(&name)
                || TimelineState::has_sheet(name)
                || DrawerPage::from_name(name).is_some()
        };
        names.iter().filter(|name| !is_known(name)).cloned().collect()
    }

    /// Shows in the open drawer what was selected since the last pass; the page of before when nothing is any more.
    pub(super) fn follow_selection(&mut self, session: &Session) {
        let (joints, submesh) = (session.joints(), session.submeshes().selected());
        let vertex = joints.selected_vertex().map(|selected| selected.vertex);
        let selection = (joints.selected(), vertex, submesh);
        let is_new = std::mem::replace(&mut self.shown_selection, selection) != selection;
        if is_new && self.drawer.is_some_and(DrawerPage::is_tab) {
            let is_some = selection != Selection::default();
            self.drawer = Some(if is_some {
                DrawerPage::Selection
            } else {
                DrawerPage::Model
            });
        }
    }

    /// What is open of another model is closed.
    pub(super) fn follow_model(&mut self, session: &Session) {
        if self.shown_model != session.model_revision() {
            self.shown_model = session.model_revision();
            self.show_findings_of(session);
            self.maps_open = false;
        }
    }

    /// The model is another one. Findings of the same file stay open.
    pub(super) fn show_findings_of(&mut self, session: &Session) {
        let file = session.open_model().map(|open| open.file.base_name().to_owned());
        if self.shown_file == file {
            self.findings.find_again(session);
        } else {
            self.shown_file = file;
            self.findings = FindingsState::default();
            self.diagnostics_open = false;
        }
    }

    pub(super) fn read_again(&mut self) {
        self.requests.push(Request::ReadAgain);
    }

    /// The requests to the page since the last call.
    pub fn take_requests(&mut self) -> Vec<Request> {
        std::mem::take(&mut self.requests)
    }

    /// Asks the page to tell what the session shows now and did not before.
    pub fn announce(&mut self, session: &Session) {
        if let Some(words) = self.messages.take_spoken() {
            self.announcer.say(words);
        }
        let told = self.announcer.observe(session);
        self.requests.extend(told.into_iter().map(Request::Announce));
        if let Some((words, offer)) = self.announcer.unseen.take() {
            self.messages.show_spoken(&words, offer);
        }
    }

    /// Asks for a picture as chosen. `transparent`: in any case without a background.
    pub(super) fn save_picture(&mut self, ui: &Ui, transparent: bool) {
        let size = self.picture.size_in_pixels(ui);
        self.requests.push(Request::SavePicture {
            size,
            transparent: transparent || self.picture.transparent,
            aperture: self.picture.aperture,
        });
    }

    /// Asks for a contact sheet as chosen.
    pub(super) fn save_contact_sheet(&mut self, ui: &Ui) {
        let PictureChoice {
            sheet_transparent: transparent,
            cells,
            turntable,
            ..
        } = self.picture;
        let [columns, rows] = cells;
        self.drawn_sheet = Some(DrawnSheet {
            count: (columns * rows) as usize,
            ..DrawnSheet::default()
        });
        self.requests.push(Request::SaveContactSheet(ContactSheetRequest {
            size: self.picture.size_in_pixels(ui),
            cells,
            turntable,
            transparent,
        }));
    }

    /// Shows how many pictures of a contact sheet are drawn, of how many. False when the person cancelled it.
    pub fn show_sheet_progress(&mut self, [done, count]: [usize; 2]) -> bool {
        let Some(sheet) = &mut self.drawn_sheet else {
            return false;
        };
        (sheet.done, sheet.count) = (done, count);
        !sheet.cancelled
    }

    /// No contact sheet is being drawn any more.
    pub fn end_contact_sheet(&mut self) {
        self.drawn_sheet = None;
    }
}

pub(super) type Selection = (Option<JointIndex>, Option<u32>, Option<usize>);

/// A contact sheet that is being drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct DrawnSheet {
    pub(super) done: usize,
    pub(super) count: usize,
    /// The person does not want it any more.
    pub(super) cancelled: bool,
}

/// How to save a picture or a contact sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PictureChoice {
    /// Width and height in pixels. None: the window's.
    pub(super) size: Option<[u32; 2]>,
    /// A picture is without a background.
    pub(super) transparent: bool,
    pub(super) sheet_transparent: bool,
    /// Of a picture.
    pub(super) aperture: f32,
    /// Columns and rows of a contact sheet.
    pub(super) cells: [u32; 2],
    /// A contact sheet shows the model from all sides, not through the clip.
    pub(super) turntable: bool,
}

impl Default for PictureChoice {
    fn default() -> Self {
        Self {
            size: None,
            transparent: false,
            sheet_transparent: false,
            aperture: 0.0,
            cells: [4, 3],
            turntable: false,
        }
    }
}

impl PictureChoice {
    /// Width and height in pixels. If none was chosen, those of the window.
    pub(super) fn size_in_pixels(&self, ui: &Ui) -> [u32; 2] {
        let window = ui.ctx().content_rect().size() * ui.pixels_per_point();
        let pixels = |side: f32| (side.round() as u32).clamp(1, MAX_PICTURE_SIDE);
        self.size.unwrap_or([pixels(window.x), pixels(window.y)])
    }
}

/// How to export, for the model that is open.
#[derive(Debug, Default)]
pub(super) struct ExportChoice {
    pub(super) options: ExportOptions,
    pub(super) of_model: u64,
    /// The name of its file. Another file begins with nothing edited.
    pub(super) of_file: String,
    /// The lists of changes and losses that are shown whole.
    pub(super) unfolded: [bool; 2],
    /// A key asked for it.
    pub(super) asked: bool,
    pub(super) shown: bool,
    /// The greatest height of the lists of losses and changes since it was opened.
    pub(super) outcome_height: f32,
}
