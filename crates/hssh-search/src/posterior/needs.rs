//! Which visits need new places, by how many travels a map explains.

use std::ops::Range;

/// Which visits need a new place if χ²/2 stays below a threshold, by the number of travels explained: greedily in order, each visit
/// that is near no explained one and near none that needs a place before it.
#[derive(Clone, Debug, Default)]
pub(super) struct Needs {
    /// By visit.
    needs: Vec<Need>,
    /// By number of travels explained: how many visits more need one than with one travel less.
    changes: Vec<i32>,
    /// By number of travels explained: how many visits need one.
    counts: Vec<u32>,
}

/// The numbers of travels explained with which a visit needs a place; while it is looked at, as far as the visits before are.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Need {
    /// No visit is near it: it needs one with whatever is explained.
    Always,
    /// In ascending intervals.
    With(Box<[Range<u32>]>),
    /// One bit for each number, where that is shorter: along a corridor every other visit may need one.
    Bits(Box<[u64]>),
}

impl Need {
    /// Whether nothing can be taken from it any more.
    pub(super) fn is_never(&self) -> bool {
        matches!(self, Need::With(intervals) if intervals.is_empty())
    }

    /// It does not need one, whatever is explained.
    pub(super) fn never() -> Self {
        Need::With(Box::default())
    }

    /// The intervals of that of a visit, ascending.
    fn for_each(&self, visit: usize, mut each: impl FnMut(Range<u32>)) {
        match self {
            Need::Always if visit == 0 => {}
            Need::Always => each(0..visit as u32),
            Need::With(intervals) => intervals.iter().cloned().for_each(each),
            Need::Bits(words) => {
                for (number, &word) in words.iter().enumerate() {
                    let (mut word, mut at) = (word, 64 * number as u32);
                    while word != 0 {
                        let skipped = word.trailing_zeros();
                        let ones = (word >> skipped).trailing_ones();
                        each(at + skipped..at + skipped + ones);
                        // In two steps, for a shift by all bits is none.
                        word = word >> skipped >> (ones - 1) >> 1;
                        at += skipped + ones;
                    }
                }
            }
        }
    }

    /// That of a visit, as bits.
    fn bits(&self, visit: usize) -> Vec<u64> {
        if let Need::Bits(words) = self {
            return words.to_vec();
        }
        let mut words = vec![0; visit.div_ceil(64)];
        self.for_each(visit, |interval| {
            for (number, word) in words.iter_mut().enumerate() {
                let start = 64 * number as u32;
                let [from, to] = [interval.start, interval.end].map(|at| at.clamp(start, start + 64) - start);
                let below = |bits: u32| if bits == 64 { u64::MAX } else { (1 << bits) - 1 };
                *word |= below(to) & !below(from);
            }
        });
        words
    }
}

impl Needs {
    /// What is left of the need of a visit if it is near that earlier one, too. Earlier visits come in ascending order.
    ///
    /// Where less is explained than the first near visit, only visits at new places can be near.
    pub(super) fn without(&self, need: &Need, visit: usize, earlier: usize) -> Need {
        let taken = &self.needs[earlier];
        let all = 0..earlier as u32;
        let first = std::slice::from_ref(&all);
        let intervals = match need {
            Need::Always if earlier == 0 => return Need::never(),
            Need::Always => first,
            Need::With(intervals) => intervals,
            Need::Bits(_) => &[],
        };
        match (need, taken) {
            (Need::Bits(_), _) | (_, Need::Bits(_)) => {
                let mut left = match need {
                    Need::Bits(words) => words.to_vec(),
                    _ => Need::With(intervals.into()).bits(visit),
                };
                left.iter_mut().zip(taken.bits(earlier)).for_each(|(left, taken)| *left &= !taken);
                if left.iter().all(|&word| word == 0) { Need::never() } else { Need::Bits(left.into()) }
            }
            (_, Need::Always) => Need::With(without(intervals, first).into()),
            (_, Need::With(taken)) => {
                let left = Need::With(without(intervals, taken).into());
                let is_long = matches!(&left, Need::With(left) if left.len() > 4 && 64 * left.len() > visit);
                if is_long { Need::Bits(left.bits(visit).into()) } else { left }
            }
        }
    }

    /// Adds a visit.
    pub(super) fn push(&mut self, need: Need) {
        let visit = self.needs.len();
        self.changes.resize(visit + 2, 0);
        need.for_each(visit, |interval| {
            self.changes[interval.start as usize] += 1;
            self.changes[interval.end as usize] -= 1;
        });
        self.needs.push(need);
    }

    /// Counts the visits added.
    pub(super) fn count(&mut self) {
        let sums = self.changes.iter().scan(0, |sum, change| {
            *sum += change;
            Some(*sum)
        });
        self.counts = sums.take(self.needs.len()).map(|sum| sum as u32).collect();
    }

    /// How many of the visits counted need a place if so many travels are explained.
    pub(super) fn counted(&self, explained: usize) -> u32 {
        self.counts[explained]
    }
}

/// Ascending intervals without what is in others.
fn without(intervals: &[Range<u32>], taken: &[Range<u32>]) -> Vec<Range<u32>> {
    let mut left = Vec::with_capacity(intervals.len());
    let mut taken = taken.iter().peekable();
    for interval in intervals {
        let mut from = interval.start;
        while let Some(next) = taken.peek().filter(|next| next.start < interval.end) {
            if from < next.start {
                left.push(from..next.start);
            }
            from = from.max(next.end);
            if next.end > interval.end {
                break; // it may take from the following interval, too
            }
            taken.next();
        }
        if from < interval.end {
            left.push(from..interval.end);
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same by the definition, number by number.
    #[test]
    fn intervals_are_taken_away() {
        let ranges = |bits: u32| -> Vec<Range<u32>> {
            let is_in = |at: u32| at < 12 && bits >> at & 1 == 1;
            let starts = (0..12).filter(|&at| is_in(at) && (at == 0 || !is_in(at - 1)));
            starts.map(|start| start..(start..13).find(|&at| !is_in(at)).unwrap_or(12)).collect()
        };
        for (a, b) in (0..4096).step_by(7).flat_map(|a| (0..4096).step_by(61).map(move |b| (a, b))) {
            let mut left = without(&ranges(a), &ranges(b));
            let mut joined: Vec<Range<u32>> = Vec::new();
            for part in left.drain(..) {
                match joined.last_mut() {
                    Some(last) if last.end == part.start => last.end = part.end,
                    _ => joined.push(part),
                }
            }
            assert_eq!(joined, ranges(a & !b), "{a:b} without {b:b}");
        }
    }

    /// Whatever is near whatever, the counts are those of the definition: visit by visit, a place for each that is near no
    /// explained one and none that has one already.
    #[test]
    fn counts_are_those_of_the_definition() {
        let visits = 150;
        for seed in 0..20_usize {
            // Along a corridor only the one before is near.
            let is_near = |later: usize, earlier: usize| match seed {
                0 => later == earlier + 1,
                1 => later <= earlier + 2,
                2 => later == earlier + 1 || (later > 80 && earlier == later - 80),
                _ => (later * 31 + earlier * 17 + seed * 7).is_multiple_of(seed + 3),
            };
            let mut needs = Needs::default();
            for visit in 0..visits {
                let near = (0..visit).filter(|&earlier| is_near(visit, earlier));
                let need = near.fold(Need::Always, |need, earlier| needs.without(&need, visit, earlier));
                needs.push(need);
            }
            needs.count();
            for explained in 0..visits {
                let mut known: Vec<usize> = (0..=explained).collect();
                for visit in explained + 1..visits {
                    if !known.iter().any(|&earlier| is_near(visit, earlier)) {
                        known.push(visit);
                    }
                }
                let expected = known.len() - explained - 1;
                assert_eq!(needs.counted(explained) as usize, expected, "{explained} travels, {seed}");
            }
        }
    }
}
