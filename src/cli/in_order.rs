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
pub(super) fn in_order<T: Sync, R: Send, E>(
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_the_order_of_the_items() {
        let items: Vec<u64> = (0..200).collect();
        let mut taken = Vec::new();
        let done: Result<(), ()> = in_order(
            &items,
            |&item| {
                // The first of every ten takes longest.
                thread::sleep(std::time::Duration::from_micros(if item % 10 == 0 { 500 } else { 10 }));
                item * 2
            },
            |result| {
                taken.push(result);
                Ok(())
            },
        );
        assert_eq!((done, taken), (Ok(()), items.iter().map(|item| item * 2).collect()));
    }

    #[test]
    fn the_first_error_ends_it() {
        let mut taken = 0;
        let done = in_order(
            &[0; 100],
            |_| (),
            |()| {
                taken += 1;
                if taken == 3 { Err("full") } else { Ok(()) }
            },
        );
        assert_eq!((done, taken), (Err("full"), 3));
    }

    #[test]
    fn no_work_begins_far_ahead_of_the_item_that_is_due() {
        let cores = thread::available_parallelism().map_or(1, usize::from);
        let items: Vec<usize> = (0..cores * 20).collect();
        let begun = AtomicUsize::new(0);
        let done: Result<(), ()> = in_order(
            &items,
            |&item| {
                begun.fetch_add(1, Ordering::Relaxed);
                if item == 0 {
                    // Time enough to begin all others.
                    thread::sleep(std::time::Duration::from_millis(100));
                    let begun = begun.load(Ordering::Relaxed);
                    assert!(begun <= 2 * cores, "{begun} were begun on {cores} cores");
                }
            },
            |()| Ok(()),
        );
        assert_eq!((done, begun.into_inner()), (Ok(()), items.len()));
    }
}
