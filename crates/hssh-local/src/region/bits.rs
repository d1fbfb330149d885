//! Sets of cells, a bit each, and what is left of one where only squares of a size count that fit in.

/// Bits in a word.
const WORD: usize = u64::BITS as usize;

/// A set of cells in rows and columns; all that is beyond them belongs to it.
pub(super) struct Bits {
    size: [usize; 2],
    /// The squares have `2 reach + 1` cells a side; there are at least so many columns and rows beyond the cells, on each side.
    reach: usize,
    /// Words of a row before its first cell.
    margin: usize,
    /// Words of a row.
    stride: usize,
    words: Vec<u64>,
}

impl Bits {
    /// The cells, asked by column and row, for which `contains` holds, to be held against squares of `2 reach + 1` cells a side.
    pub(super) fn new(size: [usize; 2], reach: usize, contains: impl Fn(usize, usize) -> bool) -> Self {
        let [width, height] = size;
        let margin = reach.div_ceil(WORD);
        let stride = 2 * margin + width.div_ceil(WORD);
        let words = vec![u64::MAX; stride * (height + 2 * reach)];
        let mut bits = Bits { size, reach, margin, stride, words };
        for row in 0..height {
            for start in (0..width).step_by(WORD) {
                let bit = |column: usize| u64::from(!contains(column, row)) << (column - start);
                let absent: u64 = (start..width.min(start + WORD)).map(bit).sum();
                let word = bits.word(start, row);
                bits.words[word] = !absent;
            }
        }
        bits
    }

    pub(super) fn contains(&self, column: usize, row: usize) -> bool {
        self.words[self.word(column, row)] >> (column % WORD) & 1 == 1
    }

    /// The cells of the squares that lie wholly within the set, and have their middle on a cell.
    pub(super) fn opened(mut self) -> Self {
        for _ in 0..2 {
            self.erode();
            self.words.iter_mut().for_each(|word| *word = !*word);
            self.fill_beyond();
        }
        self
    }

    /// Where the bit of a cell is.
    fn word(&self, column: usize, row: usize) -> usize {
        (row + self.reach) * self.stride + self.margin + column / WORD
    }

    /// Makes members of all that is beyond the cells.
    fn fill_beyond(&mut self) {
        let [width, height] = self.size;
        let frame = self.reach * self.stride;
        self.words[..frame].fill(u64::MAX);
        self.words[frame + height * self.stride..].fill(u64::MAX);
        for row in self.words.chunks_exact_mut(self.stride) {
            row[..self.margin].fill(u64::MAX);
            row[self.margin + width.div_ceil(WORD)..].fill(u64::MAX);
            if !width.is_multiple_of(WORD) {
                row[self.margin + width / WORD] |= u64::MAX << (width % WORD);
            }
        }
    }

    /// Leaves the members with nothing but members in the square around them.
    fn erode(&mut self) {
        let (reach, doublings) = (self.reach, self.doublings());
        for row in self.words.chunks_exact_mut(self.stride) {
            doublings.clone().for_each(|by| meet_later(row, by));
            shift(row, reach);
        }
        for by in doublings {
            for at in 0..self.words.len() - by * self.stride {
                self.words[at] &= self.words[at + by * self.stride];
            }
        }
        let frame = self.reach * self.stride;
        let end = self.words.len() - frame;
        self.words.copy_within(..end, frame);
    }

    /// By how much a set has to be shifted, again and again, so that a cell has met a square's side of those behind it.
    fn doublings(&self) -> impl Iterator<Item = usize> + Clone + use<> {
        let side = 2 * self.reach + 1;
        let next = move |&(met, by): &(usize, usize)| {
            let met = met + by;
            (met < side).then_some((met, met.min(side - met)))
        };
        std::iter::successors(Some((1, 1)), next).map(|(_, by)| by)
    }
}

/// Leaves the bits of a row for which the bit `by` columns on is set as well.
fn meet_later(row: &mut [u64], by: usize) {
    let (words, bits) = (by / WORD, by % WORD);
    for at in 0..row.len() {
        let word = |at: usize| row.get(at).copied().unwrap_or(u64::MAX);
        let later = word(at + words) >> bits;
        row[at] &= if bits == 0 { later } else { later | word(at + words + 1) << (WORD - bits) };
    }
}

/// Moves the bits of a row to columns `by` further on.
fn shift(row: &mut [u64], by: usize) {
    let (words, bits) = (by / WORD, by % WORD);
    for at in (0..row.len()).rev() {
        let word = |back: usize| at.checked_sub(back).map_or(u64::MAX, |at| row[at]);
        let here = word(words) << bits;
        row[at] = if bits == 0 { here } else { here | word(words + 1) >> (WORD - bits) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        /// Against the definition: the union of all squares of which every cell that there is is a member.
        #[test]
        fn what_is_left_are_the_squares_that_fit_in(
            width in 1_usize..150, height in 1_usize..20, reach in 1_usize..70, holes in 0_usize..12,
            places in prop::collection::vec(0_usize..3000, 12),
        ) {
            let contains = |column: usize, row: usize| !places[..holes].contains(&(row * width + column));
            let around = |at: usize, count: usize| at.saturating_sub(reach)..(at + reach + 1).min(count);
            let cells = || (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
            let members: Vec<bool> = cells().map(|(column, row)| contains(column, row)).collect();
            let square = |(column, row): (usize, usize)| {
                around(row, height).all(|row| around(column, width).all(|column| members[row * width + column]))
            };
            let fits: Vec<bool> = cells().map(square).collect();
            let opened = Bits::new([width, height], reach, contains).opened();
            for row in 0..height {
                for column in 0..width {
                    let is_in =
                        around(row, height).any(|row| around(column, width).any(|column| fits[row * width + column]));
                    prop_assert_eq!(opened.contains(column, row), is_in, "{} {}", column, row);
                }
            }
        }
    }
}
