//! A window with the interface in it, its commands applied to a real session, without a GPU.

use std::cell::RefCell;
use std::rc::Rc;

use bindpose::app::{App, AppOptions};
use bindpose::session::{Command, ExportedFile, File, FileCommand, QualityCommand, Session};
use bindpose::ui::{self, DrawerPage, Mirror, MirrorAction, MirrorNode, Request, UiState};
use egui::accesskit::{Action, ActionData, ActionRequest, Role};
use egui::{Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, Rect, TouchPhase, Vec2};
use egui_kittest::kittest::{AccessKitNode, NodeT as _};
use egui_kittest::{Harness, Node};

/// Time of one pass.
pub(crate) const STEP_SECS: f32 = 1.0 / 60.0;

pub(crate) const WIDE: Vec2 = Vec2::new(1440.0, 900.0);
pub(crate) const PHONE: Vec2 = Vec2::new(390.0, 844.0);

/// Every page of the sheet.
pub(crate) const DRAWER_PAGES: [DrawerPage; 9] = [
    DrawerPage::Model,
    DrawerPage::Selection,
    DrawerPage::ViewMode,
    DrawerPage::Light,
    DrawerPage::Overlays,
    DrawerPage::ViewFrom,
    DrawerPage::Picture,
    DrawerPage::Export,
    DrawerPage::Timeline,
];

/// What is behind the window.
pub(crate) struct Page {
    pub(crate) session: Session,
    pub(crate) state: UiState,
    /// All that was asked of the page around.
    pub(crate) requests: Vec<Request>,
    /// Files that were written.
    pub(crate) exported: Vec<ExportedFile>,
    /// Nothing is done of what is exported.
    pub(crate) holds_export: bool,
    /// All that a screen reader was told.
    pub(crate) told: Vec<String>,
    was_moving: bool,
}

impl Page {
    /// One pass, in the order of the app: time, interface, commands.
    fn pass(&mut self, ui: &mut egui::Ui) {
        // All passes of a frame are at one time.
        if self.was_moving && ui.ctx().current_pass_index() == 0 {
            self.session.advance(STEP_SECS);
        }
        for command in ui::show(ui, &mut self.session, &mut self.state) {
            self.session.apply(command);
        }
        while !self.holds_export && self.session.step_export() {
            ui.ctx().request_repaint();
        }
        if let Some(file) = self.session.take_exported() {
            self.exported.push(file);
        }
        if !ui.ctx().will_discard() {
            self.state.announce(&self.session);
        }
        for request in self.state.take_requests() {
            match request {
                Request::Announce(announcement) => self.told.push(announcement.text),
                request => self.requests.push(request),
            }
        }
        self.was_moving = self.session.is_moving();
        if self.was_moving {
            ui.ctx().request_repaint();
        }
    }
}

/// A window of the interface.
pub(crate) struct Window {
    pub(crate) harness: Harness<'static, Page>,
}

/// A window for a mouse, with these files dropped into it; a clip waits on its first frame.
pub(crate) fn window(size: Vec2, files: Vec<File>) -> Window {
    Window::new(size, false, files)
}

/// A window for fingers.
pub(crate) fn touch_window(size: Vec2, files: Vec<File>) -> Window {
    Window::new(size, true, files)
}

/// A phone, with these files opened.
pub(crate) fn phone(files: Vec<File>) -> Window {
    Window::new(PHONE, true, files)
}

impl Window {
    fn new(size: Vec2, coarse_pointer: bool, files: Vec<File>) -> Self {
        let mut session = Session::new(true);
        if !files.is_empty() {
            session.apply(FileCommand::Add(files));
        }
        let page = Page {
            session,
            state: UiState::new(coarse_pointer),
            requests: Vec::new(),
            exported: Vec::new(),
            holds_export: false,
            told: Vec::new(),
            was_moving: false,
        };
        let mut harness = Harness::builder()
            .with_size(size)
            .with_step_dt(STEP_SECS)
            .with_max_steps(12)
            .with_context_setup(ui::install)
            .build_ui_state(|ui, page: &mut Page| page.pass(&mut whole_window(ui)), page);
        harness.run();
        Self { harness }
    }

    pub(crate) fn session(&self) -> &Session {
        &self.harness.state().session
    }

    pub(crate) fn time_secs(&self) -> f32 {
        self.session().playback().time_secs()
    }

    /// Applies a command as a program would, and lets the window settle unless something plays.
    pub(crate) fn apply(&mut self, command: impl Into<Command>) {
        self.harness.state_mut().session.apply(command);
        self.pass_on();
    }

    /// One frame in which all of these events fall.
    pub(crate) fn frame(&mut self, events: impl IntoIterator<Item = egui::Event>) {
        self.harness.input_mut().events.extend(events);
        self.harness.step();
    }

    /// Works off what was queued, and some passes more.
    pub(crate) fn pass_on(&mut self) {
        self.harness.run_steps(4);
    }

    /// Lets some time go by.
    pub(crate) fn wait(&mut self, secs: f32) {
        self.harness.run_steps((secs / STEP_SECS).round() as usize);
    }

    /// Every widget with a name, and where it is; pictures of the view aside.
    pub(crate) fn widgets(&self) -> Vec<(String, Rect)> {
        let named = |node: Node<'_>| Some((name(&node)?, node.rect()));
        let is_widget = |node: &Node<'_>| !is_container(node.accesskit_node().role());
        self.harness
            .root()
            .children_recursive()
            .filter(is_widget)
            .filter_map(named)
            .filter(|(name, _)| name != "Model view")
            .collect()
    }

    /// The widgets whose names satisfy something.
    pub(crate) fn named(&self, wanted: impl Fn(&str) -> bool) -> Vec<(String, Rect)> {
        let mut widgets = self.widgets();
        widgets.retain(|(name, _)| wanted(name));
        widgets
    }

    pub(crate) fn shows(&self, wanted: &str) -> bool {
        !self.named(|name| name == wanted).is_empty()
    }

    /// Where the widget of this name is, or else the only one whose name begins so.
    #[track_caller]
    pub(crate) fn rect(&self, start: &str) -> Rect {
        if let [(_, rect)] = &self.named(|name| name == start)[..] {
            return *rect;
        }
        let found = self.named(|name| name.starts_with(start));
        match &found[..] {
            [(_, rect)] => *rect,
            [] => panic!(
                "no {start:?} among {:?}",
                self.widgets().into_iter().map(|(name, _)| name).collect::<Vec<_>>()
            ),
            _ => panic!("{start:?} is not one: {found:?}"),
        }
    }

    /// Asserts that it is shown.
    #[track_caller]
    pub(crate) fn assert_shows(&self, wanted: &str) {
        assert!(self.shows(wanted), "no {wanted:?} among {:?}", self.widgets());
    }

    /// Brings the pointer to a place.
    pub(crate) fn hover_at(&mut self, at: Pos2) {
        self.harness.hover_at(at);
        self.pass_on();
    }

    /// Presses there and lets go.
    pub(crate) fn click_at(&mut self, at: Pos2) {
        self.harness.hover_at(at);
        self.harness.drag_at(at);
        self.harness.drop_at(at);
        self.pass_on();
    }

    /// Presses there, moves, and lets go elsewhere.
    pub(crate) fn drag(&mut self, from: Pos2, to: Pos2) {
        self.harness.hover_at(from);
        self.harness.drag_at(from);
        for step in 1..=4_u8 {
            self.harness.hover_at(from.lerp(to, f32::from(step) / 4.0));
        }
        self.harness.drop_at(to);
        self.pass_on();
    }

    /// Presses a button of the pointer or lets go of it, as the next event.
    pub(crate) fn button(&mut self, pos: Pos2, button: PointerButton, pressed: bool, modifiers: Modifiers) {
        self.harness.event(button_event(pos, button, pressed, modifiers));
    }

    /// Types into what has the keyboard.
    pub(crate) fn type_text(&mut self, text: &str) {
        self.harness.event(Event::Text(text.to_owned()));
        self.pass_on();
    }

    /// Clicks the widget of [`Window::rect`], and takes the pointer away.
    #[track_caller]
    pub(crate) fn click(&mut self, start: &str) {
        self.click_at(self.rect(start).center());
    }

    /// Clicks it as a screen reader does, wherever the list that it is in has scrolled to.
    #[track_caller]
    pub(crate) fn click_anywhere(&mut self, start: &str) {
        let found = self.named(|name| name.starts_with(start));
        let [(name, _)] = &found[..] else {
            panic!("{start:?} is not one: {found:?}")
        };
        self.ask(&name.clone(), Action::Click, None);
    }

    /// Drags the handle of the open sheet, and holds it until it stands.
    #[track_caller]
    pub(crate) fn drag_sheet(&mut self, down: f32) {
        let from = self.rect("Close the sheet").center();
        let to = from + Vec2::new(0.0, down);
        self.harness.hover_at(from);
        self.harness.drag_at(from);
        for step in 1..=4_u8 {
            self.harness.hover_at(from.lerp(to, f32::from(step) / 4.0));
        }
        self.wait(0.2);
        self.harness.hover_at(to + Vec2::new(0.0, 0.1));
        self.wait(0.2);
        self.harness.drop_at(to);
        self.pass_on();
    }

    /// What a screen reader was told since the last call.
    pub(crate) fn take_told(&mut self) -> String {
        std::mem::take(&mut self.harness.state_mut().told).join(" ")
    }

    /// The name of the control that has the keyboard.
    pub(crate) fn focused(&self) -> Option<String> {
        let mut widgets = self.harness.root().children_recursive();
        name(&widgets.find(Node::is_focused)?)
    }

    /// The accessible node of this name.
    #[track_caller]
    pub(crate) fn node(&self, wanted: &str) -> AccessKitNode<'_> {
        let mut nodes = self.harness.root().children_recursive();
        nodes
            .find(|node| name(node).as_deref() == Some(wanted))
            .unwrap_or_else(|| panic!("no {wanted:?}"))
            .accesskit_node()
    }

    /// The value of the widget of this name, in words.
    pub(crate) fn value_of(&self, name: &str) -> Option<String> {
        self.node(name).value()
    }

    /// Asks a widget for something as a screen reader does.
    pub(crate) fn ask(&mut self, name: &str, action: Action, data: Option<ActionData>) {
        let (target_node, target_tree) = self.node(name).locate();
        let request = ActionRequest {
            action,
            target_tree,
            target_node,
            data,
        };
        self.harness.event(egui::Event::AccessKitActionRequest(request));
        self.pass_on();
    }

    /// Tab, as the page has it.
    pub(crate) fn tab(&mut self, backward: bool) {
        let event = tab(&self.harness.ctx, backward);
        self.harness.event(event);
        self.pass_on();
    }

    pub(crate) fn press(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.pass_on();
    }
}

/// A button of the pointer that is pressed or let go.
pub(crate) fn button_event(pos: Pos2, button: PointerButton, pressed: bool, modifiers: Modifiers) -> Event {
    Event::PointerButton {
        pos,
        button,
        pressed,
        modifiers,
    }
}

/// A key by itself that is pressed or let go.
pub(crate) fn key_event(key: Key, pressed: bool) -> Event {
    Event::Key {
        key,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers: Modifiers::NONE,
    }
}

/// A turn of the mouse's wheel.
pub(crate) fn wheel_event(unit: MouseWheelUnit, delta: Vec2, modifiers: Modifiers) -> Event {
    Event::MouseWheel {
        unit,
        delta,
        phase: TouchPhase::Move,
        source: MouseWheelSource::Wheel,
        modifiers,
    }
}

/// The app over a session, with panels as at first and a clock that stands still. It draws with the CPU: pictures at rest are not refined.
pub(crate) fn new_app(
    ctx: &egui::Context,
    gpu: &egui_wgpu::RenderState,
    session: &Rc<RefCell<Session>>,
    coarse_pointer: bool,
) -> App {
    session.borrow_mut().apply(QualityCommand::SetSamples(Some(1)));
    App::new(ctx, gpu, Rc::clone(session), Rc::default(), app_options(coarse_pointer))
}

/// For an app whose clock stands still.
pub(crate) fn app_options(coarse_pointer: bool) -> AppOptions {
    AppOptions {
        coarse_pointer,
        now_secs: || 0.0,
    }
}

/// What Tab asks for on the page: the focus for the next of the elements that mirror the controls, after the focused one or what was
/// clicked last. The view comes before all of them, and after them.
pub(crate) fn tab(ctx: &egui::Context, backward: bool) -> egui::Event {
    let mirror = ctx.plugin::<Mirror>();
    let mirror = mirror.lock();
    let mut nodes = mirror.in_order();
    if backward {
        nodes.reverse();
    }
    let start = mirror.tab_start();
    let from = nodes.iter().position(|node| Some(node.id) == start);
    let after = from.map_or(0, |from| from + 1);
    nodes.rotate_left(after);
    let is_stop = |node: &&&MirrorNode| node.focusable && node.stop && !node.disabled;
    let next = nodes.iter().find(is_stop).expect("something takes the focus");
    MirrorAction::Focus.event(next.id)
}

/// The window without the margin that the harness keeps: the page has none.
pub(crate) fn whole_window(ui: &mut egui::Ui) -> egui::Ui {
    let window = ui.ctx().content_rect();
    let mut whole = ui.new_child(egui::UiBuilder::new().max_rect(window));
    whole.set_clip_rect(window);
    whole
}

/// Whether a role is of what holds widgets.
fn is_container(role: Role) -> bool {
    matches!(
        role,
        Role::Region | Role::Dialog | Role::AlertDialog | Role::Menu | Role::RadioGroup
    )
}

/// What a screen reader says. Of a choice also what is chosen.
fn name(node: &Node<'_>) -> Option<String> {
    let node = node.accesskit_node();
    let name = match (node.role(), node.label(), node.value()) {
        (Role::ComboBox, Some(label), Some(value)) => Some(format!("{label} {value}")),
        (_, label, value) => label.or(value),
    };
    name.filter(|name| !name.is_empty())
}
