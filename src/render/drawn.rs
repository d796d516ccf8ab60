//! Which triangles a pass has drawn.

use std::collections::BTreeMap;
use std::ops::Range;

/// Ranges of indices that were drawn, so that none is drawn twice. Triangles of several submeshes show the first of them: the
/// others lie at the same depth.
#[derive(Clone, Debug, Default)]
pub(super) struct Drawn {
    /// Start and end of ranges that neither meet nor overlap.
    ends: BTreeMap<u32, u32>,
}

impl Drawn {
    /// The parts of a range that are not there, in order.
    pub(super) fn missing(&self, range: &Range<u32>) -> Vec<Range<u32>> {
        if range.is_empty() {
            return Vec::new();
        }
        let before = self.ends.range(..=range.start).next_back();
        let mut from = before.map_or(range.start, |(_, &end)| end.max(range.start));
        let mut parts = Vec::new();
        for (&start, &end) in self.ends.range(range.start + 1..=range.end) {
            parts.push(from..start);
            from = end;
        }
        parts.push(from..range.end);
        parts.retain(|part| !part.is_empty());
        parts
    }

    /// Takes in a range. The parts of it that were not there before, in order.
    pub(super) fn add(&mut self, range: &Range<u32>) -> Vec<Range<u32>> {
        let parts = self.missing(range);
        if range.is_empty() {
            return parts;
        }
        let mut whole = range.clone();
        let before = self.ends.range(..=range.start).next_back();
        if let Some((&start, &end)) = before.filter(|(_, end)| **end >= range.start) {
            whole = start..end.max(range.end);
        }
        while let Some((&start, &end)) = self.ends.range(whole.start + 1..=range.end).next() {
            self.ends.remove(&start);
            whole.end = whole.end.max(end);
        }
        self.ends.insert(whole.start, whole.end);
        parts
    }

    /// All that was taken in, in as few ranges as can be.
    pub(super) fn ranges(&self) -> impl Iterator<Item = Range<u32>> {
        self.ends.iter().map(|(&start, &end)| start..end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_index_is_drawn_once_in_as_few_ranges_as_can_be() {
        // A fixed sequence of ranges within 64 indices, empty ones too.
        let mut seed = 1_u32;
        let mut next = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            seed >> 26
        };
        for _ in 0..50 {
            let (mut drawn, mut is_drawn) = (Drawn::default(), [false; 128]);
            for _ in 0..12 {
                let start = next();
                let range = start..start + next() % 16;
                let missing = drawn.missing(&range);
                let parts = drawn.add(&range);
                assert_eq!(missing, parts);
                let fresh: Vec<u32> = range.clone().filter(|&index| !is_drawn[index as usize]).collect();
                assert_eq!(parts.iter().cloned().flatten().collect::<Vec<_>>(), fresh, "{range:?}");
                is_drawn[range.start as usize..range.end as usize].fill(true);
                let all: Vec<u32> = (0..128).filter(|&index| is_drawn[index as usize]).collect();
                assert_eq!(drawn.ranges().flatten().collect::<Vec<_>>(), all);
                let gaps = all.windows(2).filter(|pair| pair[1] - pair[0] > 1).count();
                assert_eq!(drawn.ranges().count(), if all.is_empty() { 0 } else { gaps + 1 });
            }
        }
    }

    #[test]
    fn the_same_range_thousands_of_times_is_drawn_once() {
        let mut drawn = Drawn::default();
        let parts = (0..20_000).flat_map(|_| drawn.add(&(3..9)));
        assert_eq!(parts.collect::<Vec<_>>(), std::slice::from_ref(&(3..9)));
    }
}
