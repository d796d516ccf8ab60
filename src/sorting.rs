//! Sorting where lists are short or sorted once: one copy of the machine code for all kinds of elements.
//!
//! The standard library's sort is compiled anew for each kind of element and each comparison, at five kilobytes a copy, which a page
//! downloads. Long lists, and what is sorted for each vertex, frame or pick, keep that one, since this one allocates a list of indices.

use std::cmp::Ordering;

/// Sorts `items` by `compare`; equal ones keep their order. Takes n · log n comparisons.
pub fn sort_by<T>(items: &mut [T], mut compare: impl FnMut(&T, &T) -> Ordering) {
    let order = order_of(items.len(), &mut |a, b| compare(&items[a], &items[b]));
    permute(items, order);
}

/// Sorts `items` by a key, which is made once for each; equal ones keep their order.
pub fn sort_by_key<T, K: Ord>(items: &mut [T], key: impl FnMut(&T) -> K) {
    let keys: Vec<K> = items.iter().map(key).collect();
    let order = order_of(items.len(), &mut |a, b| keys[a].cmp(&keys[b]));
    permute(items, order);
}

/// Sorts `items`; equal ones keep their order.
pub fn sort<T: Ord>(items: &mut [T]) {
    sort_by(items, T::cmp);
}

/// The indices of `count` elements in their order.
fn order_of(count: usize, compare: &mut dyn FnMut(usize, usize) -> Ordering) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&a, &b| compare(a, b));
    order
}

/// Brings `items` into an order, where `from` has for each place the index of the one that belongs there.
fn permute<T>(items: &mut [T], mut from: Vec<usize>) {
    // Each cycle of the permutation is gone round once: what belongs here is swapped in, and its old place is next.
    for start in 0..from.len() {
        let mut to = start;
        while from[to] != start {
            let next = std::mem::replace(&mut from[to], to);
            items.swap(to, next);
            to = next;
        }
        from[to] = to;
    }
}
