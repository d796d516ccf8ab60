//! Long work in slices, so that a page goes on beside it.
//!
//! Work that may take long is an `async fn` with a [`Slices`]: between two pieces of it, each far shorter than a frame, it awaits
//! [`Slices::pause`]. Who has no one else to serve runs it with [`at_once`]; who has makes a [`Sliced`] of it and
//! calls that again and again. Nothing here needs an executor or a clock: the caller says when a slice is over.

use std::cell::Cell;
use std::fmt;
use std::ops::RangeInclusive;
use std::pin::{Pin, pin};
use std::rc::Rc;
use std::task::{Context, Poll, Waker};

/// Items of a short loop between two places at which it can stop: less than a millisecond of work.
const BLOCK: usize = 2048;

/// When work has to stop for a while, and how far it is.
#[derive(Clone, Default)]
pub struct Slices {
    shared: Option<Rc<Shared>>,
    part: Option<Part>,
}

/// What a work that is a part of another is of that.
#[derive(Clone, Copy)]
struct Part {
    /// What the other is at meanwhile; `None` is what the part is at.
    stage: Option<Stage>,
    /// Where the part begins and ends, in percent of a work of its own.
    own: [f32; 2],
    /// The same of the other.
    whole: [f32; 2],
}

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
    /// Clips of other files are read and join. It has a part of the time from reading to checking, by the sizes of the files.
    Joining,
    /// The space that the model needs is measured.
    Measuring,
    /// Pictures are decoded.
    Decoding,
    /// It is found out what the books' programs make of the file.
    Judging,
    /// A model is changed before it is written. With what follows, this is a work of its own.
    Editing = 11,
    /// Its pictures and its file are made.
    Writing,
    /// They are packed into an archive.
    Packing,
}

/// How far work is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StageProgress {
    /// What it is at.
    pub stage: Stage,
    /// How much of the stage is done, of `total`.
    pub done: usize,
    /// All of the stage, in whatever unit it counts.
    pub total: usize,
    /// How much of all stages is done, in percent.
    percent: f32,
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
            Self::Joining => "joining",
            Self::Measuring => "measuring",
            Self::Decoding => "decoding",
            Self::Judging => "judging",
            Self::Editing => "editing",
            Self::Writing => "writing",
            Self::Packing => "packing",
        }
    }

    /// The part of all work at which a stage begins, in percent, as the clock has it. In Chromium, of the books' soldier with its vertices and
    /// triangles fifty times over (168 MB, from a disk) twice: fetching took 26 and 29 %, reading 26 and 17, building 11 and 16, checking 8 and
    /// 12, measuring 20 and 16, judging 9. Natively its maps were decoded in 17 % of the soldier's opening. Others differ: a `.glb` of
    /// 1.4 million vertices is read in no time and checked in 57 to 65 %, small ones with large pictures take 90 % to decode. The page fetches
    /// what comes over a network before it opens it. After its end stands what writes a model, whose parts were not measured.
    const BEGINS: [f32; 15] = [
        0.0, 25.0, 27.0, 46.0, 58.0, 59.0, 69.0, 69.0, 85.0, 92.0, 100.0, 0.0, 30.0, 90.0, 100.0,
    ];

    /// Where some stages begin and end, in percent of all work.
    fn span(stages: RangeInclusive<Self>) -> [f32; 2] {
        [
            Self::BEGINS[*stages.start() as usize],
            Self::BEGINS[*stages.end() as usize + 1],
        ]
    }
}

impl StageProgress {
    /// How far work is that does nothing but this.
    pub fn new(stage: Stage, done: usize, total: usize) -> Self {
        let part = done.min(total) as f32 / total.max(1) as f32;
        Self {
            stage,
            done,
            total,
            percent: between(Stage::span(stage..=stage), part),
        }
    }

    /// How much of all stages is done, in percent, rounded down.
    pub fn percent(self) -> usize {
        self.percent as usize
    }
}

fn between([begin, end]: [f32; 2], part: f32) -> f32 {
    begin + (end - begin) * part
}

impl Part {
    /// How far the whole is when the part is so far.
    fn of_whole(self, progress: StageProgress) -> StageProgress {
        let [begin, end] = self.own;
        let part = (progress.percent - begin) / (end - begin);
        StageProgress {
            stage: self.stage.unwrap_or(progress.stage),
            percent: between(self.whole, part.clamp(0.0, 1.0)),
            ..progress
        }
    }
}

impl Slices {
    /// Slices that end where `is_over` says so. It is asked often, and should be quick.
    pub fn new(is_over: impl Fn() -> bool + 'static) -> Self {
        Self::told(is_over, |_| {})
    }

    /// The same. `entered` hears of each stage when it begins.
    pub fn told(is_over: impl Fn() -> bool + 'static, entered: impl Fn(Stage) + 'static) -> Self {
        let shared = Shared {
            is_over: Box::new(is_over),
            entered: Box::new(entered),
            progress: Cell::default(),
        };
        Self {
            shared: Some(Rc::new(shared)),
            part: None,
        }
    }

    /// One slice without an end.
    pub const ENDLESS: Self = Self {
        shared: None,
        part: None,
    };

    /// Whether nobody ever asks to stop.
    pub fn are_endless(&self) -> bool {
        self.shared.is_none()
    }

    /// The same slices for some files that are read one after the other. Each is given with its size and with the stage that is told
    /// meanwhile, if not its own; it goes through the stages `each`, and together they take as long as the stages `all` do.
    pub fn for_files(
        &self,
        each: RangeInclusive<Stage>,
        all: RangeInclusive<Stage>,
        files: &[(Option<Stage>, usize)],
    ) -> Vec<Self> {
        let total: usize = files.iter().map(|&(_, size)| size).sum();
        let at = |done: usize| between(Stage::span(all.clone()), done as f32 / total.max(1) as f32);
        let mut done = 0;
        let slices = files.iter().map(|&(stage, size)| {
            let begin = at(done);
            done += size;
            let part = Part {
                stage,
                own: Stage::span(each.clone()),
                whole: [begin, at(done)],
            };
            Self {
                shared: self.shared.clone(),
                part: Some(part),
            }
        });
        slices.collect()
    }

    /// Ends the slice here if it is over. Awaited between two pieces of work.
    pub fn pause(&self) -> Pause {
        Pause {
            is_due: self.shared.as_ref().is_some_and(|shared| (shared.is_over)()),
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

    /// A [`pause`](Self::pause) before each block of items, by the number of the next item: for loops that end early.
    pub fn pause_before(&self, item: usize) -> Pause {
        if item.is_multiple_of(BLOCK) {
            self.pause()
        } else {
            Pause { is_due: false }
        }
    }

    /// [`pause`](Self::pause), and tells how much of a stage is done.
    pub fn pause_at(&self, stage: Stage, done: usize, total: usize) -> Pause {
        if let Some(shared) = &self.shared {
            let progress = StageProgress::new(stage, done, total);
            let progress = self.part.map_or(progress, |part| part.of_whole(progress));
            if shared.progress.replace(progress).stage != progress.stage {
                (shared.entered)(progress.stage);
            }
        }
        self.pause()
    }

    /// How far the work is that was given these.
    pub fn progress(&self) -> StageProgress {
        let shared = self.shared.as_ref();
        shared.map_or_else(StageProgress::default, |shared| shared.progress.get())
    }
}

impl fmt::Debug for Slices {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Slices").field(&self.progress()).finish()
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
        if let Some(shared) = &slices.shared {
            // What came before it in these slices has ended.
            shared.progress.set(StageProgress::new(Stage::Fetching, 1, 1));
        }
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
