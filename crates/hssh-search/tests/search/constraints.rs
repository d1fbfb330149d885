//! What is known of which visits are to one place: the maps that say otherwise are gone, no others, and proofs hold.

use std::collections::BTreeSet;

use hssh_causal::Exploration;
use hssh_search::{
    ConstraintError, Limits, Mapper, MapperBuilder, MapperError, Order, PosteriorModel, Reader,
    VisitConstraints,
};
use hssh_verify::verify;
use hssh_world::{DriftModel, ErrorRates, grid, snake};
use proptest::prelude::*;

use crate::cases::case;

/// Where the robot was by each map, and what the map is worth.
fn maps(search: MapperBuilder, exploration: &Exploration) -> BTreeSet<Vec<usize>> {
    let mapper = search.explain(exploration).unwrap();
    let visits = |node| mapper.visits(node).iter().map(|position| position.place.index()).collect();
    mapper.maps(usize::MAX).iter().map(|map| visits(map.node)).collect()
}

/// A few pairs of visits, none of them of one visit.
fn pairs(visits: usize, seeds: &[(usize, usize)]) -> Vec<[usize; 2]> {
    let pair = |&(one, other): &(usize, usize)| [one % visits, other % visits];
    seeds.iter().map(pair).filter(|[one, other]| one != other).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn maps_are_those_that_agree(
        (exploration, axioms) in case(400),
        same in prop::collection::vec((0_usize..40, 0_usize..40), 0..3),
        different in prop::collection::vec((0_usize..40, 0_usize..40), 0..3),
    ) {
        let visits = exploration.travels().len() + 1;
        let (same, different) = (pairs(visits, &same), pairs(visits, &different));
        let Ok(constraints) = VisitConstraints::new(&same, &different) else { return Ok(()) };
        let search = Mapper::builder().axioms(axioms);
        let agrees = |places: &Vec<usize>| {
            let is_one = |&[one, other]: &[usize; 2]| places[one] == places[other];
            same.iter().all(is_one) && !different.iter().any(is_one)
        };
        let all = maps(search.clone(), &exploration);
        let agreeing: BTreeSet<Vec<usize>> = all.into_iter().filter(agrees).collect();
        prop_assert_eq!(&maps(search.clone().constraints(constraints.clone()), &exploration), &agreeing);
        for order in [Order::Cyclic, Order::Proof] {
            let mapper = search.clone().order(order).constraints(constraints.clone()).explain(&exploration).unwrap();
            let certificate = mapper.certificate(&exploration).unwrap();
            prop_assert!(verify(&certificate, &exploration).is_ok());
            prop_assert_eq!(mapper.maps(1).is_empty(), agreeing.is_empty());
        }
    }
}

#[test]
fn the_most_probable_map_of_those_that_agree_is_proved() {
    let world = grid(3, 3, 8.0).unwrap();
    let route = world.route_through(&snake(3, 3)).unwrap();
    let exploration = world.explore_with_odometry(&route, &DriftModel::default(), 1).unwrap();
    let model = PosteriorModel::evidence(&exploration).unwrap();
    let search = Mapper::builder()
        .posterior(model)
        .order(Order::Cyclic)
        .limits(Limits { nodes: Some(200_000), ..Limits::default() });
    let free = search.clone().explain(&exploration).unwrap();
    let best = &free.maps(1)[0];
    let places: Vec<usize> = free.visits(best.node).iter().map(|position| position.place.index()).collect();
    let later = (1..places.len()).find(|&later| places[..later].contains(&places[later])).unwrap();
    let earlier = places.iter().position(|&place| place == places[later]).unwrap();

    let told = VisitConstraints::new(&[[earlier, later]], &[]).unwrap();
    let agreed = search.clone().constraints(told).explain(&exploration).unwrap();
    assert_eq!(agreed.maps(1)[0].measure, best.measure, "what is true anyway changes nothing");

    let told = VisitConstraints::new(&[], &[[later, earlier]]).unwrap();
    let denied = search.constraints(told).explain(&exploration).unwrap();
    assert!(denied.report().is_optimal);
    let visits = denied.visits(denied.maps(1)[0].node);
    assert_ne!(visits[earlier].place, visits[later].place);
    verify(&denied.certificate(&exploration).unwrap(), &exploration).unwrap();
}

/// With readings, too: where perception errs, other accounts are found that say what is known.
#[test]
fn accounts_agree_with_what_is_known() {
    let world = grid(3, 3, 8.0).unwrap();
    let route = world.route_through(&snake(3, 3)).unwrap();
    let told = world.misperceive(&route, &DriftModel::default(), ErrorRates::all(0.05), 1).unwrap();
    let model = PosteriorModel::evidence(&told.exploration).unwrap();
    let limits = Limits { nodes: Some(100_000), ..Limits::default() };
    let reader = Reader { limits, patience: Some(200), ..Reader::new(model) };
    let visits = |constraints: VisitConstraints| {
        let reader = Reader { constraints, ..reader.clone() };
        reader.read(&told.exploration).unwrap().maps[0].visits()
    };
    let free = visits(VisitConstraints::default());
    let earlier_of =
        |later: usize| free[..later].iter().position(|place| place.is_some() && *place == free[later]);
    let (earlier, later) = (1..free.len())
        .find_map(|later| Some((earlier_of(later)?, later)))
        .expect("the robot was back somewhere");
    let denied = visits(VisitConstraints::new(&[], &[[earlier, later]]).unwrap());
    assert!(denied[later].is_none() || denied[earlier] != denied[later], "{denied:?}");
    let agreed = visits(VisitConstraints::new(&[[later, earlier]], &[]).unwrap());
    assert!(agreed[later].is_some() && agreed[earlier] == agreed[later], "{agreed:?}");
}

#[test]
fn visits_that_do_not_exist_are_refused() {
    let world = grid(2, 2, 8.0).unwrap();
    let exploration = world.explore(&world.route_through(&snake(2, 2)).unwrap()).unwrap();
    let last = exploration.travels().len();
    let told = VisitConstraints::new(&[[0, last + 1]], &[]).unwrap();
    let error = Mapper::builder().constraints(told).explain(&exploration).unwrap_err();
    assert!(
        matches!(error, MapperError::Constraints(ConstraintError::Visit { visit, .. }) if visit == last + 1)
    );
}
