//! What the searches find explains the exploration, satisfies the axioms, and is all there is.

use std::collections::{BTreeMap, BTreeSet};

use hssh_causal::Exploration;
use hssh_search::{Cursor, Experience, Mapper, NodeId};
use hssh_topology::{
    Contradiction, Discovery, End, MapSketch, OlpName, Passability, PlaceId, Replay, Sign, Star, StarEnd,
    replay, violations,
};
use hssh_world::strategies;
use proptest::prelude::*;
use proptest::sample::Index;

use crate::cases::{
    FREE, axioms, breadth_first, case, exploration, last_nodes, planar, shortened, sketch, sketches,
};

fn told(sketch: &MapSketch, experience: &Experience) -> Result<Replay, Contradiction> {
    let stars: Vec<Star> = experience.catalog.stars().cloned().collect();
    replay(sketch, &stars, experience.start, &experience.observations)
}

/// The links, each with its smaller end first, in order.
fn ordered(links: impl IntoIterator<Item = (End, End)>) -> Vec<(End, End)> {
    let links: BTreeSet<_> = links.into_iter().map(|(a, b)| (a.min(b), a.max(b))).collect();
    links.into_iter().collect()
}

/// The same map as the mapper would write it: places in the order of their first visits, each with the
/// star that was seen on that visit.
fn as_found(sketch: &MapSketch, told: &Replay, experience: &Experience) -> MapSketch {
    let mut places = vec![experience.catalog.star(experience.start).clone()];
    let mut known = BTreeMap::from([(PlaceId::new(0), (PlaceId::new(0), 0))]);
    for (travel, observation) in told.travels.iter().zip(&experience.observations) {
        if travel.discovery == Discovery::NewPlace {
            known.insert(travel.to, (PlaceId::new(places.len() as u32), travel.rotation));
            places.push(experience.catalog.star(observation.star).clone());
        }
    }
    let end = |end: End| {
        let (place, rotation) = known[&end.place];
        let degree = places[place.index()].degree();
        End { place, olp: end.olp.turned(degree - rotation, degree) }
    };
    let links = ordered(sketch.links.iter().map(|&(a, b)| (end(a), end(b))));
    MapSketch { places, links }
}

/// Gateways without a link.
fn pending(sketch: &MapSketch) -> Vec<End> {
    let linked: BTreeSet<End> = sketch.links.iter().flat_map(|&(a, b)| [a, b]).collect();
    let gateways = sketch.places.iter().enumerate().flat_map(|(place, star)| {
        star.gateways().map(move |olp| End { place: PlaceId::new(place as u32), olp })
    });
    gateways.filter(|end| !linked.contains(end)).collect()
}

/// A place's star with one end labeled as no other is.
fn relabel(star: &Star, end: usize) -> Star {
    let mut ends = star.ends().to_vec();
    ends[end].label = Some("relabeled".to_owned());
    Star::new(ends).unwrap()
}

fn dead_end() -> Star {
    let end = |sign, passability| StarEnd { name: OlpName { local_path: 0, sign }, passability, label: None };
    Star::new([end(Sign::Plus, Passability::Travelable), end(Sign::Minus, Passability::Closed)]).unwrap()
}

/// What a mapper says about a travel is what the checker says.
fn compare_visits(mapper: &Mapper, node: hssh_search::NodeId, told: &Replay) {
    let visits = mapper.visits(node);
    assert_eq!(visits.len(), told.travels.len() + 1);
    for (pair, travel) in visits.windows(2).zip(&told.travels) {
        assert_eq!((pair[0].place, pair[1].place), (travel.from, travel.to));
        assert_eq!(pair[1].phi.rotation(), travel.rotation);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn what_is_found_explains_the_exploration((exploration, axioms) in case(1500)) {
        let mapper = breadth_first(&exploration, axioms);
        for node in last_nodes(&mapper) {
            let sketch = sketch(&mapper, node);
            let told = told(&sketch, mapper.experience());
            prop_assert!(told.is_ok(), "{:?}", told);
            let told = told.unwrap();
            compare_visits(&mapper, node, &told);
            prop_assert_eq!(&as_found(&sketch, &told, mapper.experience()), &sketch);
            prop_assert_eq!(violations(&sketch, &axioms), Ok(Vec::new()));
        }
    }

    #[test]
    fn what_was_tampered_with_does_not(
        ((exploration, axioms), choice) in (case(800), any::<(Index, Index)>())
    ) {
        let mapper = breadth_first(&exploration, axioms);
        let experience = mapper.experience();
        for found in sketches(&mapper) {
            for link in 0..found.links.len() {
                let mut dropped = found.clone();
                dropped.links.remove(link);
                let is_missed = matches!(told(&dropped, experience), Err(Contradiction::NotLinked { .. }));
                prop_assert!(is_missed);
            }
            let place = choice.0.index(found.places.len());
            let mut relabeled = found.clone();
            let end = choice.1.index(relabeled.places[place].ends().len());
            relabeled.places[place] = relabel(&relabeled.places[place], end);
            prop_assert!(told(&relabeled, experience).is_err());

            let mut larger = found.clone();
            larger.places.push(dead_end());
            let nowhere = PlaceId::new(found.places.len() as u32);
            prop_assert_eq!(told(&larger, experience), Err(Contradiction::UnvisitedPlace(nowhere)));

            if let [a, .., b] = pending(&found)[..] {
                let mut longer = found.clone();
                longer.links.push((a, b));
                prop_assert_eq!(told(&longer, experience), Err(Contradiction::UnusedLink(a, b)));
            }
        }
    }

    /// Two links exchange their ends, or one gets another end: where the checker still agrees, it is
    /// another map that was found as well.
    #[test]
    fn what_the_checker_accepts_was_found((exploration, axioms) in case(800)) {
        let exploration = shortened(&exploration, axioms, 800);
        let mapper = breadth_first(&exploration, axioms);
        let experience = mapper.experience();
        let found = sketches(&mapper);
        let texts: BTreeSet<String> = found.iter().map(|sketch| format!("{sketch:?}")).collect();
        let was_found = |sketch: &MapSketch| {
            let Ok(told) = told(sketch, experience) else { return true };
            violations(sketch, &axioms) != Ok(Vec::new())
                || texts.contains(&format!("{:?}", as_found(sketch, &told, experience)))
        };
        for map in found.iter().take(40) {
            for one in 0..map.links.len() {
                for other in 0..one {
                    let ((a, b), (c, d)) = (map.links[one], map.links[other]);
                    for (first, second) in [((a, d), (c, b)), ((a, c), (b, d))] {
                        let mut exchanged = map.clone();
                        (exchanged.links[one], exchanged.links[other]) = (first, second);
                        prop_assert!(was_found(&exchanged), "{:?}", exchanged);
                    }
                }
                for end in pending(map) {
                    let mut moved = map.clone();
                    moved.links[one].1 = end;
                    prop_assert!(was_found(&moved), "{:?}", moved);
                }
            }
        }
    }

    /// To search with axioms finds what a search without them finds, less what violates them.
    #[test]
    fn axioms_only_filter(
        (exploration, axioms) in (exploration(), axioms()).prop_map(|(exploration, axioms)| {
            (shortened(&exploration, FREE, 1500), axioms)
        })
    ) {
        let unfiltered = breadth_first(&exploration, FREE);
        let free = last_nodes(&unfiltered).into_iter().map(|node| sketch(&unfiltered, node));
        let filtered: Vec<MapSketch> =
            free.filter(|sketch| violations(sketch, &axioms) == Ok(Vec::new())).collect();
        let mapper = breadth_first(&exploration, axioms);
        let found: Vec<MapSketch> =
            last_nodes(&mapper).into_iter().map(|node| sketch(&mapper, node)).collect();
        prop_assert_eq!(found, filtered);
    }

    /// A planar world whose paths are simple is one of the maps that explain a walk in it.
    #[test]
    fn the_truth_is_found(seed: u64) {
        let (world, route) = strategies::random_route(seed);
        let exploration = shortened(&world.explore(&route).unwrap(), planar(), 20_000);
        let mapper = breadth_first(&exploration, planar());
        let truth = true_map(&exploration, &world, &route);
        prop_assert!(last_nodes(&mapper).into_iter().any(|node| sketch(&mapper, node) == truth));
    }
}

/// The part of the world that the robot saw.
fn true_map(exploration: &Exploration, world: &hssh_world::World, route: &hssh_world::Route) -> MapSketch {
    let visits = world.visits(route).unwrap();
    let visits = &visits[..=exploration.travels().len()];
    let mut order: Vec<hssh_world::PlaceId> = Vec::new();
    visits.iter().for_each(|place| {
        if !order.contains(place) {
            order.push(*place);
        }
    });
    let end = |place, olp| {
        let number = order.iter().position(|other| *other == place).unwrap();
        End { place: PlaceId::new(number as u32), olp }
    };
    let crossed = exploration.travels().iter().zip(visits.windows(2));
    MapSketch {
        links: ordered(crossed.map(|(travel, pair)| (end(pair[0], travel.exit), end(pair[1], travel.entry)))),
        places: order.iter().map(|&place| world.place(place).star.clone()).collect(),
    }
}

/// A cursor that goes from node to node has the visits of each as one has that comes from the root.
#[test]
fn visits_are_carried_along() {
    let world = hssh_world::grid(3, 3, 8.0).unwrap();
    let exploration = world.explore(&world.route_through(&hssh_world::snake(3, 3)).unwrap()).unwrap();
    let mapper = breadth_first(&exploration, planar());
    let (tree, experience) = (mapper.tree(), mapper.experience());
    let mut going = Cursor::new(experience);
    for step in 0..tree.len().min(500) {
        let node = NodeId::new((step * 7919 % tree.len()) as u32);
        let fresh = Cursor::new(experience).visits(node, tree, experience);
        assert_eq!(going.visits(node, tree, experience), fresh);
        assert_eq!(fresh.len(), tree.depth(node) + 1);
    }
}
