//! Opening files: reading those that the person gave, and making them ready in slices, between which the page goes on.

use std::rc::Rc;

use js_sys::{Array, Promise, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::Blob;

use super::shared::Shared;
use super::viewer::Viewer;
use super::{abort_error, field, next_task, now_secs, promise, reduced_motion};
use crate::session::{Changes, File, FileCommand, FileKind, Session};
use crate::{format, import};

/// Why an opening failed that was followed by another one, was given up, or ended with its viewer.
const OVERTAKEN: &str = "another opening came after this one, or it was given up";

/// How long an opening may take before it is told how far it is, and how often that is drawn then.
const TOLD_EVERY_SECS: f64 = 0.1;

/// So many bytes are read from a disk at once.
const PIECE_LEN: usize = 4 << 20;

/// So many bytes may be read for one opening: a model with all its textures has fewer, and what is made of them fits the memory that a program
/// can have in a browser.
const MOST_BYTES: usize = 1 << 29;

/// So many bytes decide whether a file is of another format.
const HEAD_LEN: usize = 64 << 10;

#[wasm_bindgen]
impl Viewer {
    /// Opens files: an array of `{name, bytes}` with relative paths as names and bytes as `Uint8Array` or `Blob`. The largest model opens, in
    /// slices between which the page goes on; what was open stays until then. Resolves with the state, which has a failure in its `error`.
    /// Rejects when something else was opened meanwhile, the person gave it up, a file could not be read, or the viewer was freed.
    pub fn open(&self, files: Array) -> Promise {
        let joins = |record: &Record| matches!(record.kind(), Some(FileKind::Picture | FileKind::Unread));
        let only_joins = records_of(&files).is_ok_and(|records| records.iter().all(joins));
        self.shared.opened(files, !only_joins, |session, files| {
            session.apply(FileCommand::Add(files));
        })
    }

    /// Adds the clips of models with the same bones to the open one, as [`Viewer::open`] opens them. Without an open model it opens them.
    #[wasm_bindgen(js_name = addClips)]
    pub fn add_clips(&self, files: Array) -> Promise {
        self.shared.opened(files, false, |session, files| {
            session.apply(FileCommand::AddClips(files));
        })
    }

    /// Opens one of the state's `models` again, by its path. Returns whether it is listed.
    ///
    /// # Errors
    /// When the path is no text.
    #[wasm_bindgen(js_name = openModel)]
    pub fn open_model(&self, path: &JsValue) -> Result<bool, JsValue> {
        self.shared.apply_to_listed("openModel", path, FileCommand::Open)
    }

    /// Closes one of the state's `models`, by its path, unless it is the only one. Returns whether it is listed.
    ///
    /// # Errors
    /// When the path is no text.
    #[wasm_bindgen(js_name = closeModel)]
    pub fn close_model(&self, path: &JsValue) -> Result<bool, JsValue> {
        self.shared.apply_to_listed("closeModel", path, FileCommand::Close)
    }

    /// Learns that the page fetches files that it will open in place of what is open, this one first. Returns the number by which the viewer knows
    /// it.
    #[wasm_bindgen(js_name = beginFetching)]
    pub fn begin_fetching(&self, name: String) -> f64 {
        let mine = self.shared.session.borrow_mut().begin_fetching(name, 0, true);
        self.shared.request_repaint();
        mine as f64
    }

    /// Learns that so many bytes more have come, and that a server has promised so many. Returns whether they are still waited for.
    #[wasm_bindgen(js_name = noteFetched)]
    pub fn note_fetched(&self, fetching: f64, bytes: f64, promised: f64) -> bool {
        let is_wanted = self.shared.session.borrow().openings() as f64 == fetching;
        if is_wanted {
            let mut session = self.shared.session.borrow_mut();
            session.note_fetched(bytes as usize, promised as usize);
            drop(session);
            self.shared.request_repaint();
        }
        is_wanted
    }

    /// Learns that all has come, or will never.
    #[wasm_bindgen(js_name = endFetching)]
    pub fn end_fetching(&self, fetching: f64) {
        if self.shared.session.borrow().openings() as f64 == fetching {
            self.shared.session.borrow_mut().end_fetching();
            self.shared.request_repaint();
        }
    }

    /// Begins anew, as a new viewer does, once these files are ready, which are opened as by [`Viewer::open`]: every choice is forgotten. What
    /// the GPU has compiled stays. Without files it begins anew at once.
    #[wasm_bindgen(js_name = startOver)]
    pub fn start_over(&self, files: Array) -> Promise {
        if files.length() == 0 {
            self.shared.session.borrow_mut().start_over(reduced_motion());
            self.shared.follow_new_beginning();
            self.shared.tell_of_changes();
        }
        self.shared.opened(files, true, |session, files| {
            if !files.is_empty() {
                session.begin_anew(reduced_motion(), files);
            }
        })
    }
}

impl Shared {
    /// Applies a command with the path of a listed model.
    fn apply_to_listed(
        self: &Rc<Self>,
        call: &str,
        path: &JsValue,
        command: fn(String) -> FileCommand,
    ) -> Result<bool, JsValue> {
        let is_listed = |path: &str| self.session.borrow().models().iter().any(|file| file.path == path);
        let is_listed = self.apply_named(call, path, |path| is_listed(path).then(|| path.to_owned()), command)?;
        self.go_on_opening();
        Ok(is_listed)
    }

    /// Reads files, has them opened, and waits until they are. Those that `replaces` can bring another model.
    fn opened(
        self: &Rc<Self>,
        files: Array,
        replaces: bool,
        open: impl FnOnce(&mut Session, Vec<File>) + 'static,
    ) -> Promise {
        let shared = Rc::clone(self);
        promise(async move {
            let records = records_of(&files)?;
            shared.timings.begin();
            let files = shared.read(records, replaces).await?;
            open(&mut shared.session.borrow_mut(), files);
            let mine = shared.session.borrow().openings();
            shared.tell_of_changes();
            shared.go_on_opening();
            while shared.session.borrow().is_opening() {
                next_task().await;
                shared.check_not_overtaken(mine)?;
            }
            shared.check_not_overtaken(mine)?;
            Ok::<_, JsValue>(shared.state())
        })
    }

    fn check_not_overtaken(&self, openings: u64) -> Result<(), JsValue> {
        if self.is_silenced() || self.session.borrow().openings() != openings {
            return Err(abort_error(OVERTAKEN));
        }
        Ok(())
    }

    /// Goes on with what is being opened, slice by slice, each in a task of its own, until there is nothing.
    pub(super) fn go_on_opening(self: &Rc<Self>) {
        if !self.session.borrow().is_opening() || self.is_opening.replace(true) {
            return;
        }
        let shared = Rc::clone(self);
        wasm_bindgen_futures::spawn_local(async move {
            let mut told_secs = now_secs();
            while !shared.is_silenced() && shared.session.borrow().is_opening() {
                next_task().await;
                shared.timings.begin_slice();
                let (changes, began_anew) = {
                    let session = &mut *shared.session.borrow_mut();
                    let beginnings = session.beginnings();
                    (session.advance_opening(), session.beginnings() != beginnings)
                };
                if !shared.session.borrow().is_opening() {
                    shared.timings.draw();
                }
                if began_anew {
                    shared.follow_new_beginning();
                }
                if changes != Changes::default() || !shared.session.borrow().is_opening() {
                    shared.tell_of_changes();
                } else {
                    shared.tell_progress(&mut told_secs);
                }
            }
            shared.is_opening.set(false);
        });
    }

    /// Draws how far it is, once the last time is long enough ago.
    fn tell_progress(&self, told_secs: &mut f64) {
        if now_secs() - *told_secs > TOLD_EVERY_SECS {
            *told_secs = now_secs();
            self.request_repaint();
        }
    }

    /// The session began anew: so does the window.
    fn follow_new_beginning(&self) {
        if let Some(running) = &*self.running.borrow()
            && let Some(app) = running.app.borrow_mut().as_mut()
        {
            app.start_over();
        }
    }

    /// The bytes of some files, read in pieces, without texts that are notes beside a model. The session tells how far that is. Those that can bring
    /// a model overtake what is being opened.
    async fn read(&self, records: Vec<Record>, replaces: bool) -> Result<Vec<File>, JsValue> {
        let is_model = |record: &Record| matches!(record.kind(), Some(FileKind::Model | FileKind::Archive));
        let has_model = records.iter().any(is_model);
        let may_be_note = |record: &Record| has_model && record.kind() == Some(FileKind::Text);
        let sure = || records.iter().filter(|record| !may_be_note(record));
        let total = sure().map(Record::size).fold(0, usize::saturating_add);
        check_size(total)?;
        let largest = sure().max_by_key(|record| record.size());
        let name = largest.map_or("", |record| record.base_name()).to_owned();
        let mine = self.session.borrow_mut().begin_fetching(name, total, replaces);
        let read = self.read_unless_overtaken(records, may_be_note, total, mine).await;
        if self.session.borrow().openings() == mine {
            self.session.borrow_mut().end_fetching();
        }
        read
    }

    async fn read_unless_overtaken(
        &self,
        records: Vec<Record>,
        may_be_note: impl Fn(&Record) -> bool,
        mut total: usize,
        openings: u64,
    ) -> Result<Vec<File>, JsValue> {
        let (mut files, mut told_secs) = (Vec::new(), now_secs());
        for record in records {
            if may_be_note(&record) {
                let is_model = record.begins_like_model().await;
                self.check_not_overtaken(openings)?;
                if !is_model {
                    continue;
                }
                total = total.saturating_add(record.size());
                check_size(total)?;
                self.session.borrow_mut().note_fetched(0, record.size());
            }
            let mut bytes = Vec::with_capacity(record.size());
            while bytes.len() < record.size() && !record.is_refused_by(&bytes) {
                let piece = record.piece(bytes.len()).await?;
                append(&mut bytes, &piece);
                self.check_not_overtaken(openings)?;
                self.session.borrow_mut().note_fetched(piece.length() as usize, 0);
                self.tell_progress(&mut told_secs);
            }
            files.push(File::new(&record.name, bytes));
        }
        Ok(files)
    }
}

/// Refuses more bytes than can be opened at once.
fn check_size(total: usize) -> Result<(), JsValue> {
    if total <= MOST_BYTES {
        return Ok(());
    }
    let [total, most] = [total, MOST_BYTES].map(|bytes| bytes.div_ceil(1 << 20));
    let message = format!("These files have {total} MiB together; up to {most} MiB can be opened at once.");
    Err(js_sys::Error::new(&message).into())
}

/// A file before it is read.
struct Record {
    name: String,
    content: Content,
}

enum Content {
    Bytes(Uint8Array),
    Blob(Blob),
}

impl Record {
    fn base_name(&self) -> &str {
        self.name.rsplit('/').next().unwrap_or(&self.name)
    }

    fn kind(&self) -> Option<FileKind> {
        File::new(&self.name, []).kind()
    }

    fn size(&self) -> usize {
        match &self.content {
            Content::Bytes(bytes) => bytes.length() as usize,
            Content::Blob(blob) => blob.size() as usize,
        }
    }

    /// Whether a file that begins so is refused, whatever follows: it is of another format. The beginning says all that is told of it.
    fn is_refused_by(&self, beginning: &[u8]) -> bool {
        beginning.len() == HEAD_LEN
            && matches!(self.kind(), None | Some(FileKind::Model | FileKind::Text))
            && !import::is_of_others(beginning)
            && format::begins_like_another(beginning)
    }

    /// Whether the file begins like a model; not where it cannot be read.
    async fn begins_like_model(&self) -> bool {
        let Ok(piece) = self.piece(0).await else { return false };
        let mut beginning = Vec::new();
        append(&mut beginning, &piece);
        import::begins_like_model(&beginning)
    }

    /// The bytes from an offset on, as many as are read at once.
    async fn piece(&self, from: usize) -> Result<Uint8Array, JsValue> {
        let length = if from == 0 { HEAD_LEN } else { PIECE_LEN };
        let until = self.size().min(from + length);
        let blob = match &self.content {
            Content::Bytes(bytes) => return Ok(bytes.subarray(from as u32, until as u32)),
            Content::Blob(blob) => blob,
        };
        let read = async {
            let piece = blob.slice_with_f64_and_f64(from as f64, until as f64)?;
            JsFuture::from(piece.array_buffer()).await
        };
        let buffer = read.await.map_err(|error| {
            let reason = field(&error, "message").as_string().unwrap_or_default();
            JsValue::from(js_sys::Error::new(&format!(
                "{} could not be read: {reason}",
                self.name
            )))
        })?;
        Ok(Uint8Array::new(&buffer))
    }
}

/// Copies bytes of the page behind those that are there.
fn append(bytes: &mut Vec<u8>, piece: &Uint8Array) {
    let start = bytes.len();
    bytes.resize(start + piece.length() as usize, 0);
    piece.copy_to(&mut bytes[start..]);
}

/// `{name, bytes}` records.
fn records_of(files: &Array) -> Result<Vec<Record>, JsValue> {
    let record = |record: JsValue| {
        let name = field(&record, "name")
            .as_string()
            .ok_or_else(|| js_sys::Error::new("a file needs a name"))?;
        let bytes = field(&record, "bytes");
        // A blob of another window is none of this one's.
        let content = match bytes.dyn_into::<Uint8Array>() {
            Ok(bytes) => Content::Bytes(bytes),
            Err(other) if field(&other, "arrayBuffer").is_function() => Content::Blob(other.unchecked_into()),
            Err(_) => {
                let message = format!("{name} needs its bytes as Uint8Array or Blob");
                return Err(js_sys::Error::new(&message));
            }
        };
        Ok(Record { name, content })
    };
    Ok(files.iter().map(record).collect::<Result<_, js_sys::Error>>()?)
}
