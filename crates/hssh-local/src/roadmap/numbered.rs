//! Some of the cells of a rectangle, numbered in their order: what is known of each takes no room for the others.

/// Bits in a word.
const WORD: usize = u64::BITS as usize;
/// The order of a cell's neighbors: row by row. Those across a side are these.
const BESIDE: [usize; 4] = [1, 3, 4, 6];
const ACROSS_CORNERS: [usize; 4] = [0, 2, 5, 7];

/// A set of cells with a number for each, counted from 0 row by row.
pub(super) struct Numbered {
    words: Vec<u64>,
    /// How many members there are before each word.
    before: Vec<u32>,
    /// The members by their numbers, as indices into the rectangle.
    members: Vec<u32>,
    neighbors: Vec<Neighbors>,
}

/// Which neighbors of a member are members.
#[derive(Clone, Copy)]
struct Neighbors {
    /// The first number that there can be in the row below.
    below: u32,
    /// The same in the row above.
    above: u32,
    /// A bit for each neighbor.
    are_members: u8,
}

impl Numbered {
    /// Of a rectangle with rows of `width` cells and `len` cells in all, those that `insert` hands to the function that it is given, in
    /// any order; none of them at the edge.
    pub(super) fn new(width: usize, len: usize, insert: impl FnOnce(&mut dyn FnMut(usize))) -> Self {
        let mut words = vec![0_u64; len.div_ceil(WORD)];
        insert(&mut |index| words[index / WORD] |= 1 << (index % WORD));
        let count = words.iter().map(|word| word.count_ones() as usize).sum();
        let mut members = Vec::with_capacity(count);
        let mut before = Vec::with_capacity(words.len());
        for (at, &word) in words.iter().enumerate() {
            before.push(members.len() as u32);
            let mut rest = word;
            while rest != 0 {
                members.push((at * WORD) as u32 + rest.trailing_zeros());
                rest &= rest - 1;
            }
        }
        let mut numbered = Numbered { words, before, members, neighbors: Vec::new() };
        numbered.neighbors = numbered.members().map(|index| numbered.neighbors_of(index, width)).collect();
        numbered
    }

    /// How many members there are.
    pub(super) fn len(&self) -> usize {
        self.members.len()
    }

    /// The index of the member with a number.
    pub(super) fn member(&self, number: usize) -> usize {
        self.members[number] as usize
    }

    /// The indices of all members in their order.
    pub(super) fn members(&self) -> impl Iterator<Item = usize> {
        self.members.iter().map(|&member| member as usize)
    }

    /// The number of an index, if it is a member.
    pub(super) fn number(&self, index: usize) -> Option<usize> {
        self.contains(index).then(|| self.count_before(index))
    }

    /// The members around one, row by row, by their numbers.
    pub(super) fn around(&self, number: usize) -> impl Iterator<Item = usize> + use<> {
        let (numbers, is_member) = self.candidates(number);
        (0..numbers.len()).filter(move |&at| is_member(at)).map(move |at| numbers[at])
    }

    /// The same, first those across a side, then, with 1, those across a corner.
    pub(super) fn beside(&self, number: usize) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (numbers, is_member) = self.candidates(number);
        let kinds = [BESIDE, ACROSS_CORNERS].into_iter().enumerate();
        let order = kinds.flat_map(|(kind, order)| order.map(|at| (at, kind)));
        order.filter(move |&(at, _)| is_member(at)).map(move |(at, kind)| (numbers[at], kind))
    }

    /// The number that each neighbor of a member has if it is one, and which are.
    fn candidates(&self, number: usize) -> ([usize; 8], impl Fn(usize) -> bool + Copy + use<>) {
        let Neighbors { below, above, are_members } = self.neighbors[number];
        let (below, above) = (below as usize, above as usize);
        let count = move |at: usize| usize::from(are_members >> at & 1);
        let numbers = [
            below,
            below + count(0),
            below + count(0) + count(1),
            number.wrapping_sub(1),
            number + 1,
            above,
            above + count(5),
            above + count(5) + count(6),
        ];
        (numbers, move |at: usize| are_members >> at & 1 == 1)
    }

    fn neighbors_of(&self, index: usize, width: usize) -> Neighbors {
        let (below, above) = (index - width, index + width);
        let around = [below - 1, below, below + 1, index - 1, index + 1, above - 1, above, above + 1];
        let bit = |(at, index): (usize, usize)| u8::from(self.contains(index)) << at;
        let are_members = around.into_iter().enumerate().map(bit).sum();
        let [below, above] = [below, above].map(|middle| self.count_before(middle - 1) as u32);
        Neighbors { below, above, are_members }
    }

    fn contains(&self, index: usize) -> bool {
        self.words[index / WORD] >> (index % WORD) & 1 == 1
    }

    fn count_before(&self, index: usize) -> usize {
        let (word, bit) = (index / WORD, index % WORD);
        let below = self.words[word] & ((1 << bit) - 1);
        self.before[word] as usize + below.count_ones() as usize
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Against a sorted list.
        #[test]
        fn members_and_their_neighbors_are_numbered_in_their_order(
            width in 3_usize..90, height in 3_usize..12, noise in prop::collection::vec(0_u32..10, 1100), density in 0_u32..11,
        ) {
            let is_inner = |index: usize| {
                (1..width - 1).contains(&(index % width)) && (1..height - 1).contains(&(index / width))
            };
            let members: Vec<usize> =
                (0..width * height).filter(|&index| is_inner(index) && noise[index] < density).collect();
            let insert = |insert: &mut dyn FnMut(usize)| members.iter().rev().for_each(|&member| insert(member));
            let numbered = Numbered::new(width, width * height, insert);
            prop_assert_eq!(numbered.members().collect::<Vec<_>>(), members.clone());
            let number = |index: usize| members.iter().position(|&member| member == index);
            for index in 0..width * height {
                prop_assert_eq!(numbered.number(index), number(index));
            }
            for (at, &index) in members.iter().enumerate() {
                prop_assert_eq!(numbered.member(at), index);
                let row = |middle: usize| [middle - 1, middle, middle + 1];
                let all = [row(index - width), row(index), row(index + width)].concat();
                let around: Vec<usize> =
                    all.iter().filter(|&&near| near != index).filter_map(|&near| number(near)).collect();
                prop_assert_eq!(numbered.around(at).collect::<Vec<_>>(), around.clone());
                let mut beside: Vec<(usize, usize)> = numbered.beside(at).collect();
                prop_assert!(beside.is_sorted_by_key(|&(_, kind)| kind));
                for &(near, kind) in &beside {
                    let apart = members[near].abs_diff(index);
                    prop_assert_eq!(kind == 0, apart == 1 || apart == width);
                }
                beside.sort_unstable();
                prop_assert_eq!(beside.into_iter().map(|(near, _)| near).collect::<Vec<_>>(), around);
            }
        }
    }
}
