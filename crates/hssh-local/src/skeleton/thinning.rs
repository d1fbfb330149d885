//! Thins free space to its medial axis: cells leave in the order of their distance to obstacles, as
//! long as that changes no connection (distance-ordered homotopic thinning).

use std::collections::VecDeque;

use super::mask::Mask;

/// Takes simple cells out of a set, those with the least `rank` first, until none is left that
/// `may_go`; a cell that was not simple is asked again whenever a neighbor goes.
pub(super) fn thin(mask: &mut Mask, rank: impl Fn(usize) -> u32, may_go: impl Fn(&Mask, usize) -> bool) {
    let ranked = by_rank(mask, &rank);
    let mut again = VecDeque::new();
    for (at, &(position, current)) in ranked.iter().enumerate() {
        again.push_back(position as usize);
        if ranked.get(at + 1).is_some_and(|&(_, next)| next == current) {
            continue;
        }
        while let Some(position) = again.pop_front() {
            if !mask.contains(position) || !mask.is_simple(position) || !may_go(mask, position) {
                continue;
            }
            mask.remove(position);
            again.extend(mask.neighbors(position).filter(|&near| rank(near) <= current));
        }
    }
}

/// The members with their ranks, by rank and then in row-major order (a counting sort).
fn by_rank(mask: &Mask, rank: impl Fn(usize) -> u32) -> Vec<(u32, u32)> {
    let mut starts: Vec<usize> = Vec::new();
    let mut count = 0;
    for position in mask.members() {
        let rank = rank(position) as usize;
        if starts.len() < rank + 2 {
            starts.resize(rank + 2, 0);
        }
        starts[rank + 1] += 1;
        count += 1;
    }
    for rank in 1..starts.len() {
        starts[rank] += starts[rank - 1];
    }
    let mut ranked = vec![(0, 0); count];
    for position in mask.members() {
        let rank = rank(position);
        ranked[starts[rank as usize]] = (position as u32, rank);
        starts[rank as usize] += 1;
    }
    ranked
}
