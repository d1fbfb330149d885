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

#[cfg(test)]
mod tests {
    use nalgebra::vector;
    use proptest::prelude::*;

    use super::super::drawn::{drawn, networks};
    use super::*;
    use crate::place::Gateway;

    /// The travelled ways out of each spot, and one that was only seen.
    fn ways_out(network: &Network) -> Vec<WaysOut> {
        let out = |spot: &super::super::network::Spot| {
            let gateway = |arm: &WayEnd| {
                let points = &network.ways[arm.way].points;
                let at = |index: usize| points[if arm.is_last { points.len() - 1 - index } else { index }];
                let (near, far) = (at((points.len() / 3).min(15)), at((points.len() / 2).min(40)));
                Gateway::across(
                    near.into(),
                    (far - near).try_normalize(1e-9).unwrap_or(vector![1.0, 0.0]),
                    1.5,
                )
            };
            let seen = Gateway::across((spot.center + vector![0.0, 1.5]).into(), vector![0.0, 1.0], 1.5);
            WaysOut {
                center: spot.center,
                gateways: spot.arms.iter().map(gateway).chain([seen]).collect(),
                travelled: spot.arms.clone(),
                is_sighted: false,
            }
        };
        network.spots.iter().map(out).collect()
    }

    /// By which end of which way a path goes on that comes to an end of a way.
    fn next(
        out: &[WaysOut],
        pairing: &Pairing,
        end: (usize, bool),
        network: &Network,
    ) -> Option<(usize, bool)> {
        let spot = network.ways[end.0].spots[usize::from(end.1)];
        let is_it = |arm: &&WayEnd| (arm.way, arm.is_last) == end;
        let number = out[spot].travelled.iter().enumerate().find(|(_, arm)| is_it(arm))?.0;
        let arm = out[spot].travelled.get(pairing[spot][number]?)?;
        Some((arm.way, arm.is_last))
    }

    /// The spots along the path that begins with a way in one direction; nothing if it never ends.
    fn spots_along(
        out: &[WaysOut],
        pairing: &Pairing,
        network: &Network,
        mut end: (usize, bool),
    ) -> Option<Vec<usize>> {
        let mut spots = vec![network.ways[end.0].spots[usize::from(!end.1)]];
        for _ in 0..=2 * network.ways.len() {
            spots.push(network.ways[end.0].spots[usize::from(end.1)]);
            match next(out, pairing, end, network) {
                Some((way, is_last)) => end = (way, !is_last),
                None => return Some(spots),
            }
        }
        None
    }

    /// Whether no path, followed from every way in both directions, meets a spot twice.
    fn is_proper(out: &[WaysOut], pairing: &Pairing, network: &Network) -> bool {
        (0..network.ways.len()).all(|way| {
            [false, true].into_iter().all(|is_last| {
                spots_along(out, pairing, network, (way, is_last)).is_some_and(|spots| {
                    spots.iter().enumerate().all(|(index, spot)| !spots[..index].contains(spot))
                })
            })
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]
        #[test]
        fn no_path_meets_a_spot_twice(network in networks(), straight in 0.5_f64..3.0) {
            let mut network = network;
            part_loops(&mut network);
            prop_assert!(network.ways.iter().all(|way| way.spots[0] != way.spots[1]));
            let options = PlaceOptions { straight, aligned: 4.0, ..PlaceOptions::corridors() };
            let out = ways_out(&network);
            let pairing = pair(&network, &out, &options);
            prop_assert!(is_proper(&out, &pairing, &network));
            let by_direction: Pairing =
                out.iter().map(|out| continuations(&out.gateways, &options)).collect();
            if is_proper(&out, &by_direction, &network) {
                prop_assert_eq!(&pairing, &by_direction, "nothing had to be parted");
            }
            for (pairs, believed) in pairing.iter().zip(&by_direction) {
                for (one, other) in pairs.iter().enumerate() {
                    prop_assert!(other.is_none() || *other == believed[one]);
                    prop_assert!(other.is_none_or(|other| pairs[other] == Some(one)));
                }
            }
        }
    }

    /// A straight corridor through three spots is one path; a ring that leaves one of them straight and comes back
    /// straight is parted where it is most crooked, not in the corridor.
    #[test]
    fn a_ring_is_parted_where_it_turns_most() {
        let corners = vec![[12.0, 0.0], [12.0, 10.0], [0.0, 10.0]];
        let network =
            drawn(&[[0.0, 0.0], [6.0, 0.0], [-6.0, 0.0]], &[(2, 0, vec![]), (0, 1, vec![]), (1, 0, corners)]);
        let out = ways_out(&network);
        let pairing = pair(&network, &out, &PlaceOptions::corridors());
        // At spot 1 the ring goes straight on from the corridor; at spot 0 it comes from above.
        assert_eq!(next(&out, &pairing, (0, true), &network), Some((1, false)));
        assert_eq!(next(&out, &pairing, (1, true), &network), None, "it would come back to spot 0");
        assert!(is_proper(&out, &pairing, &network));
    }
}
