//! Which ways go on across which spots, so that every path meets a place at most once (the axioms of section 2.1.3).

use std::collections::BTreeSet;

use super::network::{Network, WayEnd};
use super::places::WaysOut;
use crate::place::{PlaceOptions, continuations, crookedness};

/// For each spot which gateway goes on by which other.
pub(super) type Pairing = Vec<Vec<Option<usize>>>;

/// Puts a spot in the middle of each way that leads back to where it began: its path would meet a place twice.
pub(super) fn part_loops(network: &mut Network) {
    for way in 0..network.ways.len() {
        let [from, to] = network.ways[way].spots;
        if from == to && network.ways[way].points.len() > 4 {
            let middle = network.ways[way].length() / 2.0;
            network.split(way, &[middle]);
        }
    }
}

/// The pairing by direction, without the pairs that make a path meet a place twice, the most crooked first.
pub(super) fn pair(network: &Network, ways_out: &[WaysOut], options: &PlaceOptions) -> Pairing {
    let mut pairing: Pairing = ways_out.iter().map(|out| continuations(&out.gateways, options)).collect();
    // What goes around a loop in two halves turns somewhere.
    while let Some(path) = improper(network, ways_out, &pairing) {
        let cost = |&(spot, one, other): &(usize, usize, usize)| {
            let gateways = &ways_out[spot].gateways;
            crookedness(&gateways[one], &gateways[other], options).unwrap_or(f64::INFINITY)
        };
        let Some(&(spot, one, other)) = path.iter().max_by(|a, b| cost(a).total_cmp(&cost(b))) else { break };
        pairing[spot][one] = None;
        pairing[spot][other] = None;
    }
    pairing
}

/// The pairs along a path that meets a spot twice, if there is one.
fn improper(
    network: &Network,
    ways_out: &[WaysOut],
    pairing: &Pairing,
) -> Option<Vec<(usize, usize, usize)>> {
    let mut is_done: BTreeSet<usize> = BTreeSet::new();
    for way in 0..network.ways.len() {
        if !is_done.insert(way) {
            continue;
        }
        let mut pairs = Vec::new();
        let mut spots = BTreeSet::from(network.ways[way].spots);
        for is_last in [false, true] {
            let mut end = WayEnd { way, is_last };
            while let Some((spot, one, other)) = goes_on(network, ways_out, pairing, end) {
                pairs.push((spot, one, other));
                let next = ways_out[spot].travelled[other];
                is_done.insert(next.way);
                end = next.opposite();
                if !spots.insert(network.spot_at(end)) {
                    return Some(pairs);
                }
            }
        }
    }
    None
}

/// The spot at the end of a way, and by which pair of its gateways the path goes on there on another travelled way.
fn goes_on(
    network: &Network,
    ways_out: &[WaysOut],
    pairing: &Pairing,
    end: WayEnd,
) -> Option<(usize, usize, usize)> {
    let spot = network.spot_at(end);
    let one = ways_out[spot].travelled.iter().position(|&arm| arm == end)?;
    let other = pairing[spot][one]?;
    (other < ways_out[spot].travelled.len()).then_some((spot, one, other))
}
