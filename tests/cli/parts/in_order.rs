//! Work on many items at once.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use bindpose::cli::for_tests::in_order;

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
