//! Links between the terminals of a region: ways through its cells, without those that others make needless.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use super::reach::Reach;
use super::window::Window;

/// A way between two terminals.
pub(super) struct Link {
    /// The terminals by their numbers, the lower one first.
    pub(super) ends: [usize; 2],
    /// The positions in the window from the one to the other.
    pub(super) path: Vec<usize>,
    /// How long it is, in cells.
    length: f64,
}

/// Links all terminals whose parts of the window touch, and leaves out those that are no shorter, by the factor
/// `detour`, than what is left.
pub(super) fn links(window: &Window, terminals: &[usize], detour: f64) -> Vec<Link> {
    let reach = Reach::new(window, terminals);
    let mut meetings: BTreeMap<[usize; 2], (u64, [usize; 2])> = BTreeMap::new();
    for position in 0..window.len() {
        let Some(here) = reach.source(position) else { continue };
        for near in window.around(position) {
            let Some(there) = reach.source(near).filter(|&there| here < there) else { continue };
            let cost = u64::from(reach.cost(position)) + u64::from(reach.cost(near));
            let meeting = meetings.entry([here, there]).or_insert((u64::MAX, [position, near]));
            *meeting = (*meeting).min((cost, [position, near]));
        }
    }
    let link = |(ends, (_, [a, b])): ([usize; 2], (u64, [usize; 2]))| {
        let mut path: Vec<usize> = reach.back(a).collect();
        path.reverse();
        path.extend(reach.back(b));
        Link { ends, length: length(window, &path), path }
    };
    needed(meetings.into_iter().map(link).collect(), terminals.len(), detour)
}

/// The length of a path in cells.
pub(super) fn length(window: &Window, path: &[usize]) -> f64 {
    let step = |pair: &[usize]| {
        let [a, b] = [window.cell(pair[0]), window.cell(pair[1])];
        f64::from(a.column.abs_diff(b.column)).hypot(f64::from(a.row.abs_diff(b.row)))
    };
    path.windows(2).map(step).sum()
}

/// The links that are left if, the longest first, each goes that others replace.
fn needed(mut links: Vec<Link>, terminals: usize, detour: f64) -> Vec<Link> {
    links.sort_by(|a, b| b.length.total_cmp(&a.length).then(a.ends.cmp(&b.ends)));
    let mut is_left = vec![true; links.len()];
    for at in 0..links.len() {
        is_left[at] = false;
        let others = links.iter().zip(&is_left).filter(|&(_, &is_left)| is_left).map(|(link, _)| link);
        let limit = detour * links[at].length;
        is_left[at] = !is_within(others, links[at].ends, limit, terminals);
    }
    let mut is_left = is_left.into_iter();
    links.retain(|_| is_left.next().unwrap_or_default());
    links.sort_by_key(|link| link.ends);
    links
}

/// Whether links lead from one terminal to another within a length.
fn is_within<'a>(
    links: impl Iterator<Item = &'a Link>,
    [from, to]: [usize; 2],
    limit: f64,
    terminals: usize,
) -> bool {
    let mut neighbors = vec![Vec::new(); terminals];
    for Link { ends: [a, b], length, .. } in links {
        neighbors[*a].push((*b, *length));
        neighbors[*b].push((*a, *length));
    }
    let mut least = vec![f64::INFINITY; terminals];
    least[from] = 0.0;
    // Lengths are not negative, so that their bits are in their order.
    let mut waiting = BinaryHeap::from([Reverse((0_f64.to_bits(), from))]);
    while let Some(Reverse((bits, terminal))) = waiting.pop() {
        let here = f64::from_bits(bits);
        if terminal == to {
            return true;
        }
        for &(near, length) in &neighbors[terminal] {
            let there = here + length;
            if there <= limit && there < least[near] {
                least[near] = there;
                waiting.push(Reverse((there.to_bits(), near)));
            }
        }
    }
    false
}
