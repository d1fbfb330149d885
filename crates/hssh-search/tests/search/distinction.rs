//! Tests that tell maps apart, made in both maps.

use hssh_search::{Distinction, Mapper, Prediction, distinguish};
use hssh_topology::{Axioms, Derivation, Hypothesis, Observation, Outcome, Rules, Step};
use hssh_world::{grid, random_walk, snake};

/// What a hypothesis makes of an observation.
#[derive(PartialEq, Debug)]
enum Verdict {
    Predicted,
    Refuted,
    Open,
}

fn observe(hypothesis: &mut Hypothesis, seen: Observation, mapper: &Mapper) -> Verdict {
    let (axioms, mut step) = (Axioms::default(), Step::default());
    let rules = Rules { catalog: &mapper.experience().catalog, axioms: &axioms };
    hypothesis.step(seen, rules, &mut step);
    match step.outcome {
        Outcome::Predicted => {
            let _ = hypothesis.follow(seen, Derivation::Predicted, rules.catalog);
            Verdict::Predicted
        }
        Outcome::Refuted => Verdict::Refuted,
        Outcome::Open | Outcome::Expanded => Verdict::Open,
    }
}

#[test]
fn what_is_said_to_tell_two_maps_apart_does() {
    let (mut decisive, mut vague) = (0, 0);
    let in_grid = grid(3, 3, 8.0).unwrap();
    let through_grid = in_grid.explore(&in_grid.route_through(&snake(3, 3)).unwrap()).unwrap();
    let at_random = grid(3, 4, 8.0).unwrap();
    let walks = (0..6).map(|seed| at_random.explore(&random_walk(&at_random, 16, seed)).unwrap());
    for exploration in walks.chain([through_grid]) {
        let mapper = Mapper::builder().explain(&exploration).unwrap();
        let maps = mapper.maps(60);
        for one in &maps {
            for two in maps.iter().filter(|two| two.node != one.node) {
                let (mut first, mut second) = (mapper.hypothesis(one.node), mapper.hypothesis(two.node));
                let visits = [mapper.visits(one.node), mapper.visits(two.node)];
                let catalog = &mapper.experience().catalog;
                let Distinction { parting, test } =
                    distinguish(catalog, [&first, &second], [&visits[0], &visits[1]]);
                let parting = parting.expect("different maps part somewhere");
                let [a, b] = [0, 1].map(|map: usize| visits[map][parting.visit]);
                assert!(a != b && parting.positions == [a, b]);
                assert_eq!(visits[0][..parting.visit], visits[1][..parting.visit]);

                let Some(test) = test else { continue };
                // A robot in the first map makes the travels. It sees the places' stars as they stand there.
                let (last, way) = test.exits.split_last().unwrap();
                for &exit in way {
                    let arrival = first.map.linked(exit).unwrap();
                    let star = first.map.star(first.map.place(arrival));
                    let exit = first.position.phi.inverse().apply(first.map.local(exit));
                    let seen = Observation { exit, entry: first.map.local(arrival), star };
                    assert_eq!(observe(&mut second, seen, &mapper), Verdict::Predicted);
                    assert_eq!(observe(&mut first, seen, &mapper), Verdict::Predicted);
                }
                let exit = first.position.phi.inverse().apply(first.map.local(*last));
                match test.predictions {
                    [Prediction::Arrival { star, entry, .. }, Prediction::Arrival { .. }] => {
                        let seen = Observation { exit, entry, star };
                        assert_eq!(observe(&mut second, seen, &mapper), Verdict::Refuted);
                        assert_eq!(observe(&mut first, seen, &mapper), Verdict::Predicted);
                        decisive += 1;
                    }
                    [Prediction::Arrival { star, entry, .. }, Prediction::Unknown] => {
                        let seen = Observation { exit, entry, star };
                        assert_eq!(observe(&mut second, seen, &mapper), Verdict::Open);
                        vague += 1;
                    }
                    [Prediction::Unknown, Prediction::Arrival { .. }] => vague += 1,
                    [Prediction::Unknown, Prediction::Unknown] => panic!("a test without an outcome"),
                }
            }
        }
    }
    assert!(decisive > 0 && vague > 0, "{decisive} {vague}");
}
