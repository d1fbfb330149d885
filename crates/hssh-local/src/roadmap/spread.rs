//! What can be reached from a node of a graph within a length, the nearest first (Dijkstra's algorithm).

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rustc_hash::FxHashMap;

/// The nodes within a length of one, itself first, each with how far it is; `onward` tells where edges lead from a node and how
/// long they are. Takes no more steps than are asked for.
pub(super) fn spread<Edges: Iterator<Item = (usize, f64)>>(
    start: usize,
    limit: f64,
    onward: impl Fn(usize) -> Edges,
) -> impl Iterator<Item = (usize, f64)> {
    let mut least = FxHashMap::from_iter([(start, 0.0)]);
    // Lengths are not negative, so that their bits are in their order.
    let mut waiting = BinaryHeap::from([Reverse((0_f64.to_bits(), start))]);
    std::iter::from_fn(move || {
        loop {
            let Reverse((bits, node)) = waiting.pop()?;
            let here = f64::from_bits(bits);
            if least[&node] < here {
                continue;
            }
            for (near, length) in onward(node) {
                let there = here + length;
                if there <= limit && least.get(&near).is_none_or(|&known| there < known) {
                    least.insert(near, there);
                    waiting.push(Reverse((there.to_bits(), near)));
                }
            }
            return Some((node, here));
        }
    })
}
