//! The search by posterior against an exhaustive enumeration that scores every map by itself.

use hssh_causal::Exploration;
use hssh_metrics::{Marginals, UniformPrior};
use hssh_search::{
    Cursor, Experience, Goal, MapPrior, Mapper, MapperBuilder, Metrical, Order, PlacePrior, PosteriorModel,
    Proving, RankedMap, Score, place_by_odometry,
};
use hssh_topology::{Axioms, Simplicity};
use hssh_world::{DriftModel, cover, grid, random_planar, random_walk, snake};

const AREA: f64 = 600.0;

fn planar() -> Axioms {
    Axioms { max_genus: Some(0), ..Axioms::default() }
}

fn snake_in_grid(rows: u32, columns: u32, noise: f64, seed: u64) -> Exploration {
    let world = grid(rows, columns, 8.0).unwrap();
    let route = world.route_through(&snake(rows, columns)).unwrap();
    world.explore_with_odometry(&route, &DriftModel::default().scaled(noise), seed).unwrap()
}

/// With a proof of the most probable map.
fn proving(model: PosteriorModel) -> MapperBuilder {
    Mapper::builder().posterior(model).order(Order::Cyclic)
}

const ALL: Proving = Proving { best: usize::MAX, rest: 1.0, patience: None };

fn all_of(search: MapperBuilder) -> MapperBuilder {
    search.proving(ALL)
}

fn best(mapper: &Mapper) -> RankedMap {
    mapper.maps(1).remove(0)
}

fn cost(map: &RankedMap) -> f64 {
    map.nats().unwrap()
}

fn evidence(prior: MapPrior) -> PosteriorModel {
    let uniform = UniformPrior::over_area(AREA).unwrap();
    PosteriorModel { metrical: Metrical::Evidence(PlacePrior::Uniform(uniform)), prior }
}

/// Breadth-first finds every map; each is laid out from scratch and scored by (4.18).
fn best_by_enumeration<const N: usize>(
    exploration: &Exploration,
    axioms: &Axioms,
    weights: [Simplicity; N],
) -> [Vec<(f64, Vec<u32>)>; N] {
    let mapper = Mapper::builder().axioms(*axioms).explain(exploration).unwrap();
    let (experience, mut cursor) =
        (Experience::from(exploration), Cursor::new(&Experience::from(exploration)));
    let mut scored = weights.map(|_| Vec::new());
    for map in mapper.maps(usize::MAX) {
        let visits = mapper.visits(map.node);
        let chi2 = place_by_odometry(exploration, &visits).unwrap().unwrap().chi2;
        let places: Vec<u32> = visits.iter().map(|visit| visit.place.number()).collect();
        let map = &cursor.go_to(map.node, mapper.tree(), &experience).map;
        for (scored, weights) in scored.iter_mut().zip(weights) {
            scored.push((chi2 / 2.0 + weights.of(map).ln(), places.clone()));
        }
    }
    for scored in &mut scored {
        scored.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    scored
}

#[test]
fn the_proof_finds_what_an_enumeration_finds() {
    let world = random_planar(7, 0.7, 10.0, 7).unwrap();
    let route = cover(&world, 3).unwrap();
    let random = world.explore_with_odometry(&route, &DriftModel::default(), 5).unwrap();
    let cases = [
        (snake_in_grid(3, 3, 1.0, 1), planar()),
        (snake_in_grid(3, 3, 3.0, 2), Axioms::default()),
        (snake_in_grid(3, 4, 2.0, 3), planar()),
        (snake_in_grid(4, 4, 1.0, 4), Axioms { max_places: Some(16), ..planar() }),
        (random, planar()),
    ];
    for (exploration, axioms) in cases {
        let weights = [Simplicity::default(), Simplicity { c1: 3.0, c2: 2.0, c3: 1.0 }];
        let expected = best_by_enumeration(&exploration, &axioms, weights);
        for (weights, expected) in weights.into_iter().zip(expected) {
            let model =
                PosteriorModel { metrical: Metrical::Likelihood, prior: MapPrior::Simplicity(weights) };
            let search = proving(model).axioms(axioms);
            let posterior = search.clone().explain(&exploration).unwrap();
            let best = best(&posterior);
            let places: Vec<u32> =
                posterior.visits(best.node).iter().map(|visit| visit.place.number()).collect();
            assert!(posterior.report().is_optimal, "{}", posterior.report());
            assert!((cost(&best) - expected[0].0).abs() < 1e-5, "{best:?} {:?}", expected[0]);
            assert_eq!(places, expected[0].1);

            let all = all_of(search).explain(&exploration).unwrap();
            let all = all.maps(usize::MAX);
            assert_eq!(all.len(), expected.len());
            // Layouts that are bent out of all measure have local minima.
            let sound = expected.iter().take_while(|(cost, _)| *cost < expected[0].0 + 100.0);
            for (map, (expected, _)) in all.iter().zip(sound) {
                assert!((cost(map) - expected).abs() < 1e-4 * (1.0 + expected), "{map:?} {expected}");
            }
        }
    }
}

/// What was promised while a map was still growing is kept: no bound is above what comes of it, so that a
/// search that keeps everything finds nothing better than one that stops at the proof.
#[test]
fn no_map_is_better_than_the_proved_one() {
    for (seed, noise) in [(1, 0.3), (2, 1.0), (3, 2.0), (4, 4.0)] {
        let exploration = snake_in_grid(3, 3, noise, seed);
        for prior in [MapPrior::Flat, MapPrior::Choices, MapPrior::Simplicity(Simplicity::default())] {
            for goal in [Goal::AnyMap, Goal::ClosedMap] {
                let search = proving(evidence(prior)).goal(goal);
                let proved = search.clone().explain(&exploration).unwrap();
                let all = all_of(search).explain(&exploration).unwrap();
                let bound = |mapper: &Mapper| match mapper.report().proof.unwrap().open_bound {
                    Some(Score::Nats(nats)) => Some(nats),
                    _ => None,
                };
                assert_eq!(bound(&all), None);
                assert!(proved.report().expanded <= all.report().expanded);
                let (best, first) = (best(&proved), best(&all));
                assert!((cost(&best) - cost(&first)).abs() < 1e-6);
                assert!(bound(&proved).is_none_or(|bound| bound >= cost(&first) - 1e-6));
                // The probability that was promised at least is what the map has among all.
                let (best, first) = (best.probable.unwrap(), first.probable.unwrap());
                let range = best.at_least - 1e-9..=best.at_most + 1e-9;
                assert!(range.contains(&first.at_most), "{range:?} {}", first.at_most);
            }
        }
    }
}

/// The evidence that was summed up travel by travel is the integral (4.6) over the finished map's poses, but for
/// where it was linearized.
#[test]
fn the_evidence_is_that_of_the_whole_pose_graph() {
    for (noise, tolerance) in [(0.1, 0.01), (1.0, 0.3)] {
        let exploration = snake_in_grid(3, 3, noise, 4);
        let posterior = proving(evidence(MapPrior::Flat)).explain(&exploration).unwrap();
        let best = best(&posterior);
        let graph = posterior.pose_graph(&best).unwrap();
        let log_determinant = Marginals::new(&graph).unwrap().log_determinant();
        let free = graph.free_poses() as f64;
        let tau = std::f64::consts::TAU.ln();
        let travels = exploration.travels().len() as f64;
        let informations: f64 = graph.edges().iter().map(|edge| edge.information.log_determinant()).sum();
        // SPEC: V^{-(n-1)} (2π)^{3(n-1)/2} |A|^{-1/2} exp(−χ²/2) ∏ (2π)^{-3/2} |C_i|^{-1/2}
        let evidence = -free * (AREA * std::f64::consts::TAU).ln() + 1.5 * free * tau
            - 0.5 * log_determinant
            - 0.5 * graph.chi2()
            + 0.5 * informations
            - 1.5 * travels * tau;
        let peaks = 0.5 * informations - 1.5 * travels * tau;
        assert!((cost(&best) - (peaks - evidence)).abs() < tolerance, "{} {}", cost(&best), peaks - evidence);
    }
}

#[test]
fn with_exact_odometry_the_true_map_wins() {
    let exploration = snake_in_grid(4, 4, 0.05, 1);
    let model = PosteriorModel::evidence(&exploration).unwrap();
    let mapper = proving(model).explain(&exploration).unwrap();
    let best = best(&mapper);
    assert_eq!((best.measure.places, mapper.report().finals.optimal), (16, 1));
    let rest = mapper.report().proof.unwrap().rest.unwrap();
    assert!(best.probable.unwrap().at_least > 0.99 || rest > 0.01);
}

#[test]
fn the_thesiss_search_selects_the_true_map() {
    let exploration = snake_in_grid(4, 4, 0.5, 1);
    let search = proving(PosteriorModel::THESIS).axioms(planar());
    let mapper = search.order(Order::BestFirst).goal(Goal::ClosedMap).explain(&exploration).unwrap();
    assert_eq!(best(&mapper).measure.places, 16);
    assert!(best(&mapper).closed);
}

/// Where headings are unknown the linear model is worthless: layouts coil up as they please. What is proved
/// then must be true all the same.
#[test]
fn a_proof_does_not_rely_on_headings_that_nobody_knows() {
    let exploration =
        Exploration::from_ron(include_str!("../../../../fixtures/heading-unknown.ron")).unwrap();
    let search = proving(PosteriorModel::evidence(&exploration).unwrap());
    let proved = search.clone().explain(&exploration).unwrap();
    let all = all_of(search).explain(&exploration).unwrap();
    assert_eq!(all.report().proof.unwrap().open_bound, None);
    let (best, first) = (cost(&best(&proved)), cost(&best(&all)));
    assert!(!proved.report().is_optimal || best - first < 1e-4, "{} {first}", proved.report());
}

/// The true map, whatever the ends are called and however few of them have bearings.
#[test]
fn a_few_bearings_are_enough() {
    let whole = snake_in_grid(3, 3, 0.5, 3);
    let mut stars = whole.star_types().to_vec();
    for (number, named) in stars.iter_mut().enumerate() {
        let keep = number % named.bearings.len();
        let lone = named.bearings.iter().enumerate().map(|(end, &bearing)| bearing.filter(|_| end == keep));
        named.bearings = lone.collect();
    }
    let exploration = Exploration::new(stars, whole.start(), whole.travels().to_vec()).unwrap();
    let search = proving(PosteriorModel::evidence(&whole).unwrap()).axioms(planar());
    let [full, sparse] =
        [whole, exploration].map(|exploration| search.clone().explain(&exploration).unwrap());
    let [full, sparse] = [&full, &sparse].map(|mapper| mapper.visits(best(mapper).node));
    assert_eq!(full, sparse);
}

/// An absurd measurement ends no search in a loop, and nothing is called proved that could not be looked at.
#[test]
fn what_cannot_be_laid_out_is_left_out() {
    let sound = snake_in_grid(3, 3, 1.0, 1);
    for x in [1e5, 1e6] {
        let mut travels = sound.travels().to_vec();
        travels[4].odometry.as_mut().unwrap().x = x;
        let exploration = Exploration::new(sound.star_types().to_vec(), sound.start(), travels).unwrap();
        for order in [Order::BreadthFirst, Order::BestFirst, Order::Cyclic, Order::Proof] {
            let search = all_of(proving(PosteriorModel::THESIS)).axioms(planar()).order(order);
            match search.explain(&exploration) {
                Ok(found) => {
                    assert!(!(found.report().proof.unwrap().unsolvable && found.report().is_optimal))
                }
                Err(problem) => assert!(problem.to_string().contains("out of all proportion"), "{problem}"),
            }
        }
    }
}

#[test]
fn a_travel_without_odometry_is_named() {
    let world = grid(2, 2, 8.0).unwrap();
    let exploration = world.explore(&world.route_through(&snake(2, 2)).unwrap()).unwrap();
    let problem = proving(PosteriorModel::THESIS).explain(&exploration).unwrap_err();
    assert_eq!(problem.to_string(), "travel 1 has no odometry; the posterior needs it for every travel");
}

/// One input, one verdict: what is searched after the proof withdraws nothing, finds the same map, and has an end.
#[test]
fn what_comes_after_the_proof_withdraws_nothing_and_has_an_end() {
    let try_with = |(side, travels, seed): (u32, usize, u64)| {
        let world = grid(side, side, 8.0).unwrap();
        let route = random_walk(&world, travels, seed);
        let exploration = world.explore_with_odometry(&route, &DriftModel::default(), seed).unwrap();
        let model = PosteriorModel::evidence(&exploration).unwrap();
        let search = |rest: f64| {
            let builder = Mapper::builder().axioms(planar()).order(Order::Cyclic).posterior(model);
            builder.proving(Proving { best: 1, rest, patience: None }).explain(&exploration).unwrap()
        };
        let (short, long) = (search(1.0), search(1e-9));
        let (proved, kept) = (short.report(), long.report());
        assert!(proved.is_optimal && kept.is_optimal, "{side} {travels} {seed}");
        assert_eq!(short.branch(short.maps(1)[0].node), long.branch(long.maps(1)[0].node));
        assert!(kept.expanded <= 2 * proved.expanded + 6_100, "{} {}", proved.expanded, kept.expanded);
    };
    // The longest of all tests: its cases share the cores.
    std::thread::scope(|scope| {
        for case in [(4, 60, 1), (5, 40, 2)] {
            scope.spawn(move || try_with(case));
        }
    });
}
