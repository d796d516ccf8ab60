//! Long work in slices, so that a page goes on beside it.
//!
//! Work that may take long is an `async fn` with a [`Slices`]: between two pieces of it, each far shorter than a frame, it awaits
//! [`Slices::pause`]. Who has no one else to serve runs it with [`at_once`]; who has makes a [`Sliced`] of it and
//! calls that again and again. Nothing here needs an executor or a clock: the caller says when a slice is over.

use std::cell::Cell;
use std::fmt;
use std::pin::{Pin, pin};
use std::rc::Rc;
use std::task::{Context, Poll, Waker};

/// Items of a short loop between two places at which it can stop: less than a millisecond of work.
pub(crate) const BLOCK: usize = 2048;

/// When work has to stop for a while, and how far it is.
#[derive(Clone, Default)]
pub struct Slices(Option<Rc<Shared>>);

struct Shared {
    is_over: Box<dyn Fn() -> bool>,
    entered: Box<dyn Fn(Stage)>,
    progress: Cell<StageProgress>,
}

/// What work is at, in its order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Bytes come from a disk or a server.
    #[default]
    Fetching,
    /// Archives are unpacked.
    Unpacking,
    /// The file's text or its data are read.
    Reading,
    /// The model is made of them.
    Building,
    /// Clips are made ready for sampling.
    Compiling,
    /// All is looked at for what is wrong with it.
    Checking,
    /// The space that the model needs is measured.
    Measuring,
    /// Pictures are decoded.
    Decoding,
    /// It is found out what the books' programs make of the file.
    Judging,
}

/// How far work is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StageProgress {
    /// What it is at.
    pub stage: Stage,
    /// How much of the stage is done, of `total`.
    pub done: usize,
    /// All of the stage, in whatever unit it counts.
    pub total: usize,
}

impl Stage {
    /// Its name for programs.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Fetching => "fetching",
            Self::Unpacking => "unpacking",
            Self::Reading => "reading",
            Self::Building => "building",
            Self::Compiling => "compiling",
            Self::Checking => "checking",
            Self::Measuring => "measuring",
            Self::Decoding => "decoding",
            Self::Judging => "judging",
        }
    }

    /// The part of all work at which a stage begins, in percent: about as a text of many vertices has them.
    const BEGINS: [usize; 10] = [0, 5, 10, 45, 60, 65, 75, 80, 95, 100];
}

impl StageProgress {
    /// How much of all stages is done, in percent, rounded down.
    pub fn percent(self) -> usize {
        let stage = self.stage as usize;
        let (begin, end) = (Stage::BEGINS[stage], Stage::BEGINS[stage + 1]);
        // Where a number has 32 bits, 35 times as many bytes as a file has are none.
        let done = (end - begin) as u64 * self.done.min(self.total) as u64 / self.total.max(1) as u64;
        begin + done as usize
    }
}

impl Slices {
    /// Slices that end where `is_over` says so. It is asked often, and should be quick.
    pub fn new(is_over: impl Fn() -> bool + 'static) -> Self {
        Self::told(is_over, |_| {})
    }

    /// The same. `entered` hears of each stage when it begins.
    pub fn told(is_over: impl Fn() -> bool + 'static, entered: impl Fn(Stage) + 'static) -> Self {
        Self(Some(Rc::new(Shared {
            is_over: Box::new(is_over),
            entered: Box::new(entered),
            progress: Cell::default(),
        })))
    }

    /// One slice without an end.
    pub const ENDLESS: Self = Self(None);

    /// Whether nobody ever asks to stop.
    pub fn are_endless(&self) -> bool {
        self.0.is_none()
    }

    /// Ends the slice here if it is over. Awaited between two pieces of work.
    pub fn pause(&self) -> Pause {
        Pause {
            is_due: self.0.as_ref().is_some_and(|shared| (shared.is_over)()),
        }
    }

    /// Works on each item, with a [`pause`](Self::pause) before each block of them. What works on a block is a plain function, of which a
    /// compiler makes more than of a loop that can stop at each item.
    pub async fn for_each<T>(&self, items: impl IntoIterator<Item = T>, mut work: impl FnMut(T)) {
        let mut items = items.into_iter();
        while let Some(first) = items.next() {
            self.pause().await;
            work(first);
            items.by_ref().take(BLOCK - 1).for_each(&mut work);
        }
    }

    /// [`pause`](Self::pause), and tells how much of a stage is done.
    pub fn pause_at(&self, stage: Stage, done: usize, total: usize) -> Pause {
        if let Some(shared) = &self.0 {
            if shared.progress.get().stage != stage {
                (shared.entered)(stage);
            }
            shared.progress.set(StageProgress { stage, done, total });
        }
        self.pause()
    }

    /// How far the work is that was given these.
    pub fn progress(&self) -> StageProgress {
        self.0
            .as_ref()
            .map_or_else(StageProgress::default, |shared| shared.progress.get())
    }
}

impl fmt::Debug for Slices {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Slices")
            .field(&self.0.as_ref().map(|shared| shared.progress.get()))
            .finish()
    }
}

/// The end of a slice, to be awaited, or nothing at all.
#[derive(Debug)]
#[must_use = "it must be awaited"]
pub struct Pause {
    is_due: bool,
}

impl Future for Pause {
    type Output = ();

    #[inline]
    fn poll(mut self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<()> {
        if std::mem::take(&mut self.is_due) {
            Poll::Pending
        } else {
            Poll::Ready(())
        }
    }
}

/// Does all of some work now.
pub fn at_once<T>(work: impl Future<Output = T>) -> T {
    let mut work = pin!(work);
    loop {
        if let Poll::Ready(done) = work.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            return done;
        }
    }
}

/// Work that goes on slice by slice. To give it up, drop it.
pub struct Sliced<T> {
    slices: Slices,
    work: Pin<Box<dyn Future<Output = T>>>,
}

impl<T> Sliced<T> {
    /// Work at its beginning. It must await nothing but the pauses of these slices.
    pub fn new<W: Future<Output = T> + 'static>(slices: &Slices, work: impl FnOnce(Slices) -> W) -> Self {
        Self {
            work: Box::pin(work(slices.clone())),
            slices: slices.clone(),
        }
    }

    /// Works until the slice is over. What comes of it when all is done; after that it must not be called again.
    pub fn advance(&mut self) -> Option<T> {
        match self.work.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            Poll::Ready(done) => Some(done),
            Poll::Pending => None,
        }
    }

    /// Works to the end.
    pub fn run(self) -> T {
        at_once(self.work)
    }

    /// How far it is.
    pub fn progress(&self) -> StageProgress {
        self.slices.progress()
    }
}

impl<T> fmt::Debug for Sliced<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sliced")
            .field("slices", &self.slices)
            .finish_non_exhaustive()
    }
}
