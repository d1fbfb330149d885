//! Which of some starts is nearest to each cell of a window, on ways that keep to the middle (Dijkstra's algorithm).

use super::window::Window;

/// The cost of a step straight on and across a corner where there is comfortable room.
const STRAIGHT: u32 = 5;
const DIAGONAL: u32 = 7;
/// How many times that a step costs at most.
const DEAREST: u32 = 12;
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
    /// From some positions of a window; where obstacles are nearer than `comfort` metres, steps are dearer.
    pub(super) fn new(window: &Window, starts: &[usize], comfort: f64) -> Self {
        let mut reach = Reach {
            cost: vec![UNREACHED; window.len()],
            source: vec![UNREACHED; window.len()],
            before: vec![UNREACHED; window.len()],
        };
        // A ring of lists, one for each cost that can be waiting.
        let mut waiting: Vec<Vec<usize>> = vec![Vec::new(); (DIAGONAL * DEAREST + 1) as usize];
        for (number, &start) in starts.iter().enumerate() {
            if reach.cost[start] == UNREACHED {
                (reach.cost[start], reach.source[start]) = (0, number as u32);
                waiting[0].push(start);
            }
        }
        let (mut cost, mut empty) = (0, 0);
        while empty < waiting.len() {
            let slot = cost as usize % waiting.len();
            empty += 1;
            while let Some(position) = waiting[slot].pop() {
                if reach.cost[position] != cost {
                    continue;
                }
                empty = 0;
                for (near, is_diagonal) in window.around(position) {
                    let room = f64::from(window.clearance(near));
                    let dearness = (comfort / room).clamp(1.0, f64::from(DEAREST));
                    let step = if is_diagonal { DIAGONAL } else { STRAIGHT };
                    let next = cost + (f64::from(step) * dearness).round() as u32;
                    if next < reach.cost[near] {
                        reach.cost[near] = next;
                        reach.source[near] = reach.source[position];
                        reach.before[near] = position as u32;
                        waiting[next as usize % (DIAGONAL * DEAREST + 1) as usize].push(near);
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
