//! Work on many things at once, whose results come in order.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Runs `work` on each item, on as many threads as the machine has cores, and gives `take` the results in the order of the items, each as
/// soon as those before it are there. A worker is at most some items ahead, so that results do not pile up.
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
    // A result waits in the channel until it is taken, and its worker with it.
    let (send, receive) = mpsc::sync_channel(cores);
    thread::scope(|scope| {
        for _ in 0..cores.min(items.len()) {
            let (next, work, send) = (&next, &work, send.clone());
            scope.spawn(move || {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(item) = items.get(index) else { return };
                    if send.send((index, work(item))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(send);
        let mut early = BTreeMap::new();
        let mut due = 0;
        for (index, result) in &receive {
            early.insert(index, result);
            while let Some(result) = early.remove(&due) {
                due += 1;
                if let Err(error) = take(result) {
                    // Workers end at their next result.
                    drop(receive);
                    return Err(error);
                }
            }
        }
        Ok(())
    })
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
}
