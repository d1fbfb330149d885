//! Sums of aligned runs of a growing sequence, so that the sum of any run is that of a few of them.

/// A growing sequence with the sums of its runs of 1, 2, 4, … members, each beginning at a multiple of its length. The sum is any
/// associative one; of n members there are 2n sums at most.
#[derive(Clone, Debug)]
pub(super) struct Runs<T> {
    /// By length: 1, 2, 4, …
    levels: Vec<Vec<T>>,
}

impl<T: Copy> Runs<T> {
    /// Nothing yet.
    pub(super) fn new() -> Self {
        Runs { levels: vec![Vec::new()] }
    }

    /// How many members there are.
    pub(super) fn len(&self) -> usize {
        self.levels[0].len()
    }

    /// Adds a member.
    pub(super) fn push(&mut self, member: T, join: impl Fn(T, T) -> T) {
        let mut sum = member;
        for level in 0.. {
            if level == self.levels.len() {
                self.levels.push(Vec::new());
            }
            let sums = &mut self.levels[level];
            sums.push(sum);
            if sums.len() % 2 == 1 {
                return;
            }
            sum = join(sums[sums.len() - 2], sum);
        }
    }

    /// The sum of the 2^`level` members from `first` on, which is a multiple of that, if there are so many.
    pub(super) fn sum(&self, first: usize, level: u32) -> Option<T> {
        self.levels.get(level as usize)?.get(first >> level).copied()
    }

    /// The sum of the members from `first` on, before `end`; nothing if that is no member.
    pub(super) fn total(&self, first: usize, end: usize, join: impl Fn(T, T) -> T) -> Option<T> {
        let (mut at, mut total) = (first, None);
        while at < end {
            let level = aligned(at).min((end - at).ilog2());
            let sum = self.sum(at, level)?;
            total = Some(total.map_or(sum, |total| join(total, sum)));
            at += 1 << level;
        }
        total
    }

    /// The first member from `first` on that is in no run that `is_out`, which is asked for the first member of a run and its
    /// sum, and says so of a run only if it would of every member.
    pub(super) fn next(&self, first: usize, is_out: impl Fn(usize, T) -> bool) -> Option<usize> {
        let mut at = first;
        'runs: while at < self.len() {
            let longest = aligned(at).min((self.len() - at).ilog2());
            for level in (0..=longest).rev() {
                if self.sum(at, level).is_some_and(|sum| is_out(at, sum)) {
                    at += 1 << level;
                    continue 'runs;
                }
            }
            return Some(at);
        }
        None
    }
}

/// The greatest level of which a run can begin there.
fn aligned(first: usize) -> u32 {
    if first == 0 { usize::BITS - 1 } else { first.trailing_zeros() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs of numbers, with the first and the last of each for a sum.
    #[test]
    fn runs_are_whole_and_in_order() {
        let join = |(first, middle): (usize, usize), (next, last): (usize, usize)| {
            assert_eq!(middle + 1, next);
            (first, last)
        };
        let mut runs = Runs::new();
        for member in 0..100 {
            runs.push((member, member), join);
            for first in 0..=member {
                let total = runs.total(first, member + 1, join);
                assert_eq!(total, Some((first, member)));
            }
        }
        assert_eq!(runs.total(7, 7, join), None);
        assert_eq!(runs.total(7, 101, join), None);
    }

    #[test]
    fn what_is_out_is_passed_over() {
        let mut runs = Runs::new();
        (0..1000_usize).for_each(|member| runs.push((member, member), |(first, _), (_, last)| (first, last)));
        let kept = |member: usize| member % 97 == 3 || (500..530).contains(&member);
        let expected: Vec<usize> = (0..1000).filter(|&member| kept(member)).collect();
        let asked = std::cell::Cell::new(0);
        let next = |from| {
            runs.next(from, |first, (start, end)| {
                assert_eq!(first, start);
                asked.set(asked.get() + 1);
                !(start..=end).any(kept)
            })
        };
        let found = std::iter::successors(next(0), |&last| next(last + 1));
        assert_eq!(found.collect::<Vec<_>>(), expected);
        assert!(asked.get() < 500, "{}", asked.get());
    }
}
