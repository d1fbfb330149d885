//! Accounts of explorations with errors: without errors they are maps; with errors the true map is found.

use hssh_causal::Exploration;
use hssh_oracle::{Rules, enumerate_readings};
use hssh_search::{Limits, Mapper, Order, PosteriorModel, ReadMap, Reader};
use hssh_topology::{Account, Anywhere, Axioms, ReadingModel, Sight};
use hssh_world::{DriftModel, ErrorRates, Misperceived, World, grid, random_planar, random_walk, snake};

fn planar() -> Axioms {
    Axioms { max_genus: Some(0), ..Axioms::default() }
}

fn reader(exploration: &Exploration) -> Reader {
    let model = PosteriorModel::evidence(exploration).unwrap();
    let limits =
        Limits { time: Some(std::time::Duration::from_secs(8)), bytes: Some(1 << 30), ..Limits::default() };
    Reader { axioms: planar(), limits, ..Reader::new(model) }
}

/// By visit, its place, places numbered as they are met.
fn partition<T: Copy + Ord>(visits: impl IntoIterator<Item = Option<T>>) -> Vec<Option<usize>> {
    let mut numbers = std::collections::BTreeMap::new();
    let visit = |place: Option<T>| {
        let next = numbers.len();
        place.map(|place| *numbers.entry(place).or_insert(next))
    };
    visits.into_iter().map(visit).collect()
}

#[test]
fn without_errors_accounts_are_maps() {
    for seed in 0..12 {
        let world = random_planar(8, 0.4, 10.0, seed).unwrap();
        let route = random_walk(&world, 16, seed);
        let exploration = world.explore_with_odometry(&route, &DriftModel::default(), seed).unwrap();
        let exact = Reader { best: 3, ..reader(&exploration).exact() };
        let answer = exact.read(&exploration).unwrap();
        let proving = hssh_search::Proving { best: 3, rest: 1.0, patience: None };
        let builder = Mapper::builder().posterior(exact.model).axioms(planar());
        let mapper = builder.order(Order::Cyclic).proving(proving).explain(&exploration).unwrap();
        let maps = mapper.maps(3);
        assert!(answer.maps.iter().all(ReadMap::is_exact));
        for (read, map) in answer.maps.iter().zip(&maps) {
            let (read, map) = (read.cost.total(), map.nats().unwrap());
            assert!((read - map).abs() < 1e-4 * (1.0 + map.abs()), "seed {seed}: {read} and {map}");
        }
        let visits = mapper.visits(maps[0].node).into_iter().map(|visit| Some(visit.place));
        assert_eq!(partition(answer.maps[0].visits()), partition(visits));
    }
}

fn told(world: &World, route: &hssh_world::Route, rates: ErrorRates, seed: u64) -> Misperceived {
    world.misperceive(route, &DriftModel::default(), rates, seed).unwrap()
}

#[test]
fn the_true_map_is_found_in_spite_of_errors() {
    let (mut found, mut exactly, mut all) = (0, 0, 0);
    for seed in 0..8 {
        let world = grid(3, 3, 8.0).unwrap();
        let route = world.route_through(&snake(3, 3)).unwrap();
        let told = told(&world, &route, ErrorRates::all(0.05), seed);
        let reader = Reader { patience: Some(300), ..reader(&told.exploration) };
        let answer = reader.read(&told.exploration).unwrap();
        let best = &answer.maps[0];
        all += 1;
        found += usize::from(told.is_told_apart_by(&best.visits()));
        exactly += usize::from(best.is_exact());

        // What it takes for misread is what was misread, or as much.
        let corrections = best.corrections(&told.exploration);
        assert_eq!(corrections.is_empty(), best.is_exact());
        // As it must have been, it has a map without readings.
        let corrected = best.corrected(&told.exploration).unwrap();
        assert_eq!(corrected.places.len(), corrected.exploration.travels().len() + 1);
        let builder = Mapper::builder().axioms(planar()).order(Order::Cyclic);
        let exact = builder.explain(&corrected.exploration).unwrap();
        assert!(!exact.maps(1).is_empty(), "seed {seed}: the corrected exploration has no map");
    }
    assert!(found >= all - 1, "{found} of {all} found");
    assert!(exactly < all, "there were errors");
}

/// What a hypothesis comes to, as the enumeration has it: its cost, where each visit was first reported, places, links, pending ends.
type Finding<Cost = f64> = (Cost, Vec<Option<usize>>, usize, usize, usize);

/// All accounts of an exploration, way by way.
fn accounts(exploration: &Exploration, axioms: &Axioms, model: &ReadingModel) -> Vec<Finding> {
    let first = Account::begin(exploration.star(exploration.start()));
    let mut open = vec![(first, 0.0, vec![Some(hssh_topology::PlaceId::new(0))])];
    for travel in exploration.travels() {
        let sight = Sight { star: exploration.star(travel.star), entry: travel.entry };
        let mut next = Vec::new();
        for (account, cost, visits) in &open {
            for way in account.ways(travel.exit, sight, model, &Anywhere) {
                let account = account.follow(travel.exit, sight, &way);
                if account.chart.map(axioms).is_some() {
                    let place = account.underway.is_none().then_some(account.place);
                    let visits = visits.iter().copied().chain([place]).collect();
                    next.push((account, cost + way.price, visits));
                }
            }
        }
        open = next;
    }
    let finding = |(account, cost, visits): (Account, f64, Vec<Option<_>>)| {
        let first = |place: &Option<_>| visits.iter().position(|other| other == place);
        let visits_by_first = visits.iter().map(|place| place.and_then(|_| first(place))).collect();
        let chart = &account.chart;
        let places = chart.place_count() as usize;
        (cost, visits_by_first, places, chart.links().len(), chart.pending_ends().count())
    };
    open.into_iter().map(finding).collect()
}

/// The same by an enumeration that shares no code with it.
fn enumerated(exploration: &Exploration, axioms: &Axioms, model: &ReadingModel) -> Vec<Finding> {
    let rules = Rules {
        no_self_intersection: axioms.no_self_intersection,
        no_circular_path: axioms.no_circular_path,
        genus_bound: axioms.max_genus.map(|genus| genus as usize),
        ..Rules::default()
    };
    let ReadingModel {
        missed,
        ghost,
        repeat,
        unreported,
        hidden,
        false_visit,
        turned_back,
        limit,
        most_passed,
    } = *model;
    let model = hssh_oracle::ReadingModel {
        missed,
        ghost,
        repeat,
        unreported,
        hidden,
        false_visit,
        turned_back,
        limit,
        most_passed,
    };
    let all = enumerate_readings(exploration, &rules, &model);
    all.into_iter()
        .map(|found| (found.cost, found.visits, found.places, found.links, found.pending))
        .collect()
}

/// Sorted, costs to the ten millionth of a nat.
fn sorted(findings: Vec<Finding>) -> Vec<Finding<i64>> {
    let rounded = |(cost, visits, places, links, pending): Finding| {
        ((cost * 1e7).round() as i64, visits, places, links, pending)
    };
    let mut all: Vec<_> = findings.into_iter().map(rounded).collect();
    all.sort();
    all
}

#[test]
fn accounts_are_those_of_an_enumeration() {
    let (mut cases, mut hypotheses) = (0, 0);
    for seed in 0..260 {
        let world = random_planar(4 + seed as u32 % 4, 0.4, 10.0, seed).unwrap();
        let travels = 2 + seed as usize % 3;
        let route = random_walk(&world, travels, seed);
        let told = told(&world, &route, ErrorRates::all(0.25), seed);
        let exploration = told.exploration.prefix(travels);
        let limit = [9.0, 6.5, 4.9][travels - 2];
        let model = ReadingModel { limit, most_passed: 1 + seed as u32 % 2, ..ReadingModel::default() };
        let axioms = if seed % 2 == 0 { planar() } else { Axioms::default() };
        let ours = sorted(accounts(&exploration, &axioms, &model));
        let theirs = sorted(enumerated(&exploration, &axioms, &model));
        for (number, (one, other)) in ours.iter().zip(&theirs).enumerate() {
            assert_eq!(one, other, "seed {seed}, hypothesis {number} of {} and {}", ours.len(), theirs.len());
        }
        assert_eq!(ours.len(), theirs.len(), "seed {seed}");
        cases += 1;
        hypotheses += ours.len();
    }
    assert!(cases >= 200 && hypotheses > 10_000, "{cases} cases, {hypotheses} hypotheses");
}
