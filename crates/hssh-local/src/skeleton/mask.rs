//! Sets of cells with the eight neighbors of each, and which cells are simple: whether taking one out
//! changes how the set and its complement are connected.

use std::ops::Range;

use crate::grid::{Cell, Lattice};

/// A set of cells of a lattice, with an empty frame around it so that every cell has eight neighbors.
#[derive(Clone, Debug)]
pub(crate) struct Mask {
    stride: usize,
    is_member: Vec<bool>,
}

impl Mask {
    /// The cells, asked by their index in the lattice, for which `contains` holds.
    pub(crate) fn new(lattice: &Lattice, contains: impl Fn(usize) -> bool) -> Self {
        let stride = lattice.width() as usize + 2;
        let mut mask = Mask { stride, is_member: vec![false; stride * (lattice.height() as usize + 2)] };
        let mut index = 0;
        for row in 0..lattice.height() as usize {
            let first = (row + 1) * stride + 1;
            for member in &mut mask.is_member[first..first + lattice.width() as usize] {
                *member = contains(index);
                index += 1;
            }
        }
        mask
    }

    /// The cell's position in the framed set: positions below are of this kind.
    pub(crate) fn position(&self, cell: Cell) -> usize {
        (cell.row as usize + 1) * self.stride + cell.column as usize + 1
    }

    pub(crate) fn cell(&self, position: usize) -> Cell {
        Cell { column: (position % self.stride) as u32 - 1, row: (position / self.stride) as u32 - 1 }
    }

    /// The position of the cell with an index in the lattice.
    pub(crate) fn position_of(&self, index: usize) -> usize {
        let width = self.stride - 2;
        (index / width + 1) * self.stride + index % width + 1
    }

    /// The runs of members in each row of the lattice: the positions from the first to behind the last.
    pub(crate) fn runs(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        let end_of = |start: usize, is_member: bool| {
            let run = self.is_member[start..].iter().take_while(|&&member| member == is_member);
            start + run.count()
        };
        // The frame ends the runs of a row.
        let mut at = 0;
        std::iter::from_fn(move || {
            let start = end_of(at, false);
            at = end_of(start, true);
            (start < at).then_some(start..at)
        })
    }

    /// A set of the same cells without any members.
    pub(crate) fn without_members(&self) -> Self {
        Mask { stride: self.stride, is_member: vec![false; self.is_member.len()] }
    }

    /// How many columns and rows of cells there are.
    pub(crate) fn size(&self) -> [u32; 2] {
        [self.stride as u32 - 2, (self.is_member.len() / self.stride) as u32 - 2]
    }

    pub(crate) fn positions(&self) -> usize {
        self.is_member.len()
    }

    pub(crate) fn contains(&self, position: usize) -> bool {
        self.is_member[position]
    }

    pub(crate) fn remove(&mut self, position: usize) {
        self.is_member[position] = false;
    }

    /// The members, in row-major order.
    pub(crate) fn members(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.positions()).filter(|&position| self.is_member[position])
    }

    /// The eight neighbors' positions, counterclockwise from the right.
    pub(crate) fn around(&self, position: usize) -> [usize; 8] {
        let (up, down) = (position + self.stride, position - self.stride);
        [position + 1, up + 1, up, up - 1, position - 1, down - 1, down, down + 1]
    }

    /// The neighbors that are members, counterclockwise from the right.
    pub(crate) fn neighbors(&self, position: usize) -> impl Iterator<Item = usize> + '_ {
        self.around(position).into_iter().filter(|&near| self.is_member[near])
    }

    pub(crate) fn insert(&mut self, position: usize) {
        self.is_member[position] = true;
    }

    /// The members no farther than so many cells along both axes, row by row.
    pub(crate) fn within(&self, position: usize, reach: u32) -> impl Iterator<Item = usize> + '_ {
        let (reach, stride) = (reach as usize, self.stride);
        let (column, row) = (position % stride, position / stride);
        let columns = column.saturating_sub(reach)..(column + reach + 1).min(stride);
        let rows = row.saturating_sub(reach)..(row + reach + 1).min(self.is_member.len() / stride);
        let positions = rows.flat_map(move |row| columns.clone().map(move |column| row * stride + column));
        positions.filter(|&near| self.is_member[near])
    }

    /// Which neighbors are members, one bit each, counterclockwise from the right.
    fn pattern(&self, position: usize) -> u8 {
        let bit = |(bit, near): (usize, usize)| u8::from(self.is_member[near]) << bit;
        self.around(position).into_iter().enumerate().map(bit).sum()
    }

    /// Whether the member is the end of a line: it has one neighbor, or two that are side by side.
    pub(crate) fn is_end(&self, position: usize) -> bool {
        let pattern = self.pattern(position);
        match pattern.count_ones() {
            1 => true,
            2 => pattern & pattern.rotate_left(1) != 0,
            _ => false,
        }
    }

    /// Whether the set without this member, and its complement with it, are connected as before
    /// (members by sides and corners, the complement by sides only).
    pub(crate) fn is_simple(&self, position: usize) -> bool {
        IS_SIMPLE[self.pattern(position) as usize]
    }
}

/// For each pattern of neighbors whether the cell in the middle is simple: whether Yokoi's number is 1.
const IS_SIMPLE: [bool; 256] = {
    let mut table = [false; 256];
    let mut pattern = 0;
    while pattern < 256 {
        let mut number = 0;
        let mut side = 0;
        while side < 8 {
            let absent = pattern >> side & 1 == 0;
            let corner_absent = pattern >> ((side + 1) % 8) & 1 == 0;
            let next_absent = pattern >> ((side + 2) % 8) & 1 == 0;
            if absent && !(corner_absent && next_absent) {
                number += 1;
            }
            side += 2;
        }
        table[pattern] = number == 1;
        pattern += 1;
    }
    table
};
