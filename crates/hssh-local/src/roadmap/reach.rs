//! Which of some starts is nearest to each cell of a window, on ways that keep to the middle (Dijkstra's algorithm).

use super::window::Window;

/// More than a step costs at most, so that so many lists hold all that is waiting.
const LISTS: usize = 1 << 7;
const UNREACHED: u32 = u32::MAX;

/// What is known after all cells were reached that can be.
pub(super) struct Reach {
    cost: Vec<u32>,
    /// By position, the start it is reached from.
    source: Vec<u32>,
    /// By position, the position before it on the way.
    before: Vec<u32>,
}

impl Reach {
    /// From some positions of a window.
    pub(super) fn new(window: &Window<'_>, starts: &[usize]) -> Self {
        let mut reach = Reach {
            cost: vec![UNREACHED; window.len()],
            source: vec![UNREACHED; window.len()],
            before: vec![UNREACHED; window.len()],
        };
        // A ring of lists, one for each cost that can be waiting.
        let mut waiting: Vec<Vec<usize>> = vec![Vec::new(); LISTS];
        for (number, &start) in starts.iter().enumerate() {
            if reach.cost[start] == UNREACHED {
                (reach.cost[start], reach.source[start]) = (0, number as u32);
                waiting[0].push(start);
            }
        }
        let (mut cost, mut empty) = (0, 0);
        while empty < waiting.len() {
            let slot = cost as usize % LISTS;
            empty += 1;
            while let Some(position) = waiting[slot].pop() {
                if reach.cost[position] != cost {
                    continue;
                }
                empty = 0;
                for (near, step) in window.steps(position) {
                    let next = cost + step;
                    if next < reach.cost[near] {
                        reach.cost[near] = next;
                        reach.source[near] = reach.source[position];
                        reach.before[near] = position as u32;
                        waiting[next as usize % LISTS].push(near);
                    }
                }
            }
            cost += 1;
        }
        reach
    }

    /// The start that a position is reached from.
    pub(super) fn source(&self, position: usize) -> Option<usize> {
        let source = self.source[position];
        (source != UNREACHED).then_some(source as usize)
    }

    /// What the way to a position costs that was reached.
    pub(super) fn cost(&self, position: usize) -> u32 {
        self.cost[position]
    }

    /// The positions from one that was reached back to its start.
    pub(super) fn back(&self, position: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(position), |&at| {
            let before = self.before[at];
            (before != UNREACHED).then_some(before as usize)
        })
    }
}
