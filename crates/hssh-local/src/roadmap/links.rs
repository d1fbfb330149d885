//! Links between the terminals of a region: ways through its cells, without those that others make needless.

use std::collections::BTreeMap;
use std::f64::consts::SQRT_2;

use super::reach::Reach;
use super::spread::spread;
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
pub(super) fn links(window: &Window<'_>, terminals: &[usize], detour: f64) -> Vec<Link> {
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
pub(super) fn length(window: &Window<'_>, path: &[usize]) -> f64 {
    let is_diagonal = |pair: &&[usize]| {
        let [a, b] = [window.cell(pair[0]), window.cell(pair[1])];
        a.column != b.column && a.row != b.row
    };
    let steps = path.windows(2).filter(|pair| pair[0] != pair[1]).count();
    let diagonal = path.windows(2).filter(is_diagonal).count();
    (steps - diagonal) as f64 + diagonal as f64 * SQRT_2
}

/// The links that are left if, the longest first, each goes that others replace.
fn needed(mut links: Vec<Link>, terminals: usize, detour: f64) -> Vec<Link> {
    links.sort_by(|a, b| b.length.total_cmp(&a.length).then(a.ends.cmp(&b.ends)));
    let mut at: Vec<Vec<usize>> = vec![Vec::new(); terminals];
    for (number, link) in links.iter().enumerate() {
        link.ends.iter().for_each(|&end| at[end].push(number));
    }
    let mut is_left = vec![true; links.len()];
    for number in 0..links.len() {
        is_left[number] = false;
        let limit = detour * links[number].length;
        let onward = |terminal: usize| {
            let left = at[terminal].iter().filter(|&&link| is_left[link]).map(|&link| &links[link]);
            left.map(move |&Link { ends: [a, b], length, .. }| (if a == terminal { b } else { a }, length))
        };
        let [from, to] = links[number].ends;
        let is_replaced = spread(from, limit, onward).any(|(terminal, _)| terminal == to);
        is_left[number] = !is_replaced;
    }
    let mut is_left = is_left.into_iter();
    links.retain(|_| is_left.next().unwrap_or_default());
    links.sort_by_key(|link| link.ends);
    links
}
