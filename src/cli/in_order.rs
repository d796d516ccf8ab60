//! Work on many things at once, whose results come in order.

use std::collections::VecDeque;
use std::sync::{Mutex, PoisonError, mpsc};
use std::thread;

/// Runs `work` on each item, on as many threads as the machine has cores, and gives `take` their results in the order of the items,
/// each as soon as those before it are there. No more than twice as many items as cores are begun and not yet taken, so that
/// results do not pile up.
///
/// # Errors
/// The first that `take` gives: then no more work begins.
pub fn in_order<T: Sync, R: Send, E>(
    items: &[T],
    work: impl Fn(&T) -> R + Sync,
    mut take: impl FnMut(R) -> Result<(), E>,
) -> Result<(), E> {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let (begin, waiting) = mpsc::channel::<(&T, mpsc::Sender<R>)>();
    let waiting = Mutex::new(waiting);
    let next = || waiting.lock().unwrap_or_else(PoisonError::into_inner).recv();
    thread::scope(|scope| {
        for _ in 0..cores.min(items.len()) {
            scope.spawn(|| {
                while let Ok((item, done)) = next() {
                    // Nobody hears of it after an error.
                    let _ = done.send(work(item));
                }
            });
        }
        let mut items = items.iter();
        let mut due = VecDeque::new();
        let mut take_all = || loop {
            while due.len() < 2 * cores
                && let Some(item) = items.next()
            {
                let (done, result) = mpsc::channel();
                // Threads that wait for work are there until the end.
                let _ = begin.send((item, done));
                due.push_back(result);
            }
            // Where work panicked there is no result; the scope tells of it.
            match due.pop_front().map(|result| result.recv()) {
                Some(Ok(result)) => take(result)?,
                Some(Err(_)) | None => return Ok(()),
            }
        };
        let taken = take_all();
        drop(begin);
        // After an error, what was asked for and not begun is dropped.
        while next().is_ok() {}
        taken
    })
}
