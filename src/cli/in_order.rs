//! Work on many things at once, whose results come in order.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, PoisonError, mpsc};
use std::thread;

/// Runs `work` on each item, on as many threads as the machine has cores, and gives `take` their results in the order of the items,
/// each as soon as those before it are there. No work begins twice as many items as cores ahead of the one that is due, so that
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
    let next = AtomicUsize::new(0);
    let due = Due::default();
    let (send, receive) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..cores.min(items.len()) {
            let (next, due, work, send) = (&next, &due, &work, send.clone());
            scope.spawn(move || {
                let _guard = EndOnPanic(due);
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(item) = items.get(index) else { return };
                    if !due.may_begin(index, 2 * cores) || send.send((index, work(item))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(send);
        let _guard = EndOnPanic(&due);
        let mut early = BTreeMap::new();
        let mut taken = 0;
        for (index, result) in &receive {
            early.insert(index, result);
            while let Some(result) = early.remove(&taken) {
                if let Err(error) = take(result) {
                    due.set(None);
                    return Err(error);
                }
                taken += 1;
                due.set(Some(taken));
            }
        }
        Ok(())
    })
}

/// The index of the item whose result is taken next; `None` once no more work shall begin.
struct Due {
    index: Mutex<Option<usize>>,
    changed: Condvar,
}

impl Default for Due {
    fn default() -> Self {
        Self {
            index: Mutex::new(Some(0)),
            changed: Condvar::new(),
        }
    }
}

impl Due {
    /// Waits until an item is less than `ahead` items after the one that is due. Whether work on it shall begin.
    fn may_begin(&self, index: usize, ahead: usize) -> bool {
        let due = self.index.lock().unwrap_or_else(PoisonError::into_inner);
        let is_far = |due: &mut Option<usize>| due.is_some_and(|due| index >= due + ahead);
        let due = self.changed.wait_while(due, is_far);
        due.unwrap_or_else(PoisonError::into_inner).is_some()
    }

    fn set(&self, index: Option<usize>) {
        *self.index.lock().unwrap_or_else(PoisonError::into_inner) = index;
        self.changed.notify_all();
    }
}

/// Lets nobody wait for a result that does not come since its thread panicked.
struct EndOnPanic<'a>(&'a Due);

impl Drop for EndOnPanic<'_> {
    fn drop(&mut self) {
        if thread::panicking() {
            self.0.set(None);
        }
    }
}
