//! Lists of what is there: numbers that leave and rejoin in constant time, the last to leave first.

/// Some of the numbers 0, 1, 2, …, in ascending order.
///
/// A doubly linked list through a vector. Who leaves keeps his neighbors, and finds them as they were
/// if everything since has been taken back.
#[derive(Clone, Debug)]
pub(crate) struct LiveList {
    /// The neighbors of number n are at n + 1; those at 0 are the last and the first of the list.
    neighbors: Vec<Neighbors>,
}

/// Positions in the vector.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Neighbors {
    before: u32,
    after: u32,
}

impl Default for LiveList {
    fn default() -> Self {
        LiveList { neighbors: vec![Neighbors { before: 0, after: 0 }] }
    }
}

impl LiveList {
    /// Adds the next number, at the end of the list.
    pub(crate) fn push(&mut self) {
        let (position, last) = (self.neighbors.len() as u32, self.neighbors[0].before);
        self.neighbors.push(Neighbors { before: last, after: 0 });
        self.tie(position);
    }

    /// Forgets the highest number, which is in the list.
    pub(crate) fn pop(&mut self) {
        if let Some(highest) = self.neighbors.len().checked_sub(2) {
            self.leave(highest as u32);
            self.neighbors.pop();
        }
    }

    /// Takes a number out of the list.
    pub(crate) fn leave(&mut self, number: u32) {
        let Neighbors { before, after } = self.neighbors[number as usize + 1];
        self.neighbors[before as usize].after = after;
        self.neighbors[after as usize].before = before;
    }

    /// Takes back the last [`leave`](Self::leave) that was not taken back yet.
    pub(crate) fn rejoin(&mut self, number: u32) {
        self.tie(number + 1);
    }

    fn tie(&mut self, position: u32) {
        let Neighbors { before, after } = self.neighbors[position as usize];
        self.neighbors[before as usize].after = position;
        self.neighbors[after as usize].before = position;
    }

    /// The numbers in the list, ascending.
    pub(crate) fn iter(&self) -> impl Iterator<Item = u32> + '_ {
        let mut position = 0;
        std::iter::from_fn(move || {
            position = self.neighbors[position as usize].after;
            position.checked_sub(1)
        })
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use proptest::prelude::*;

    use super::*;

    #[derive(Clone, Copy)]
    enum Change {
        Pushed,
        Left(u32),
    }

    proptest! {
        /// Who leaves is gone, who is pushed is last, and whatever is taken back is as it was.
        #[test]
        fn a_list_is_a_set_in_order(choices in prop::collection::vec(0..40_usize, 0..60)) {
            let (mut list, mut set, mut count) = (LiveList::default(), BTreeSet::new(), 0);
            let mut past = Vec::new();
            for choice in choices {
                let before = format!("{list:?}");
                let change = set.iter().copied().nth(choice).map_or(Change::Pushed, Change::Left);
                if let Change::Left(number) = change {
                    list.leave(number);
                    set.remove(&number);
                } else {
                    list.push();
                    set.insert(count);
                    count += 1;
                }
                past.push((change, before));
                prop_assert!(list.iter().eq(set.iter().copied()));
            }
            for (change, before) in past.into_iter().rev() {
                match change {
                    Change::Pushed => list.pop(),
                    Change::Left(number) => list.rejoin(number),
                }
                prop_assert_eq!(format!("{list:?}"), before);
            }
            prop_assert_eq!(list.iter().count(), 0);
        }
    }
}
