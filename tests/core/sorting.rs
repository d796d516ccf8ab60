//! The sort of short lists beside the standard library's.

use bindpose::sorting;
use proptest::prelude::*;

use crate::properties::cases;

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn lists_are_sorted_as_the_standard_library_sorts_them(keys in prop::collection::vec(0_u8..20, 0..80)) {
        // The second number tells equal keys apart: they keep their order.
        let list: Vec<(u8, usize)> = keys.into_iter().zip(0..).collect();
        let mut expected = list.clone();
        expected.sort_by_key(|entry| entry.0);
        let mut sorted = list.clone();
        sorting::sort_by_key(&mut sorted, |entry| entry.0);
        prop_assert_eq!(&sorted, &expected);
        sorted.clone_from(&list);
        sorting::sort_by(&mut sorted, |a, b| a.0.cmp(&b.0));
        prop_assert_eq!(&sorted, &expected);
        sorted = list.into_iter().rev().collect();
        sorting::sort(&mut sorted);
        prop_assert_eq!(sorted, expected);
    }
}
