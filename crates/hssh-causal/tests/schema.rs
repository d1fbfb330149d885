//! The causal level: laws of views, traces and stays; the automaton against all partitions there are.
#![allow(clippy::unwrap_used, reason = "in tests a failed unwrap is the failed assertion")]

use std::f64::consts::{FRAC_PI_2, TAU};

use hssh_causal::schema::{
    Action, Automaton, Change, Refutation, Sight, Step, Trace, Turning, View, exploration, stays,
    view_graph_dot,
};
use hssh_causal::{Exploration, NamedStar, StarType, Travel};
use hssh_topology::{Isomorphism, Olp, Star};
use proptest::prelude::*;

const STARS: [&str; 9] = [
    "0+ 1+ 0- 1-",
    "0+ (1+) 0- 1-",
    "(3-) 0- 3+ 0+",
    "0+ 1+ (0-) (1-)",
    "0+ 0-",
    "0+ (0-)",
    "0+ 1+ 0- 1-:door",
    "0+ 0- 1+ 1-",
    "0+ 1+ 2+ 0- 1- 2-",
];

fn star(text: &str) -> Star {
    text.parse().unwrap()
}

fn figure_2_4() -> Exploration {
    Exploration::from_ron(include_str!("../../../fixtures/figure-2-4.ron")).unwrap()
}

fn schemas(trace: &Trace) -> String {
    let line = |schema: hssh_causal::schema::Schema<'_>| {
        format!("⟨{}, {}, {}⟩ {}\n", schema.from, schema.action, schema.to, schema.change)
    };
    trace.schemas().map(line).map(|line| line.replace(" \n", "\n")).collect()
}

/// Definition 2.2 in other words: "S and S' appear identical when observed respectively from olp and olp'".
#[test]
fn equal_views_are_isomorphisms() {
    for (one, other) in STARS.iter().flat_map(|one| STARS.iter().map(move |other| (star(one), star(other)))) {
        for (olp, image) in one.olps().flat_map(|olp| other.olps().map(move |image| (olp, image))) {
            let look_alike = View::of(&one, olp, Sight::Place) == View::of(&other, image, Sight::Place);
            assert_eq!(look_alike, Isomorphism::anchored(&one, olp, &other, image).is_some());
        }
    }
}

#[test]
fn figure_2_4_at_the_causal_level() {
    let trace = |sight, turning| Trace::of(&figure_2_4().prefix(3), sight, turning).unwrap();
    insta::assert_snapshot!("figure_2_4_place", schemas(&trace(Sight::Place, Turning::Direct)));
    insta::assert_snapshot!("figure_2_4_ahead", schemas(&trace(Sight::Ahead, Turning::Stepwise)));
    let whole = Trace::of(&figure_2_4(), Sight::Place, Turning::Direct).unwrap();
    insta::assert_snapshot!("figure_2_4_dot", view_graph_dot(&whole));
}

/// From a door east to a corner 8 m ahead and 6 m left, whose frame is turned by 30°, entered by its
/// gateway at 180° and left by that at −90°.
#[test]
fn schemas_carry_distances_and_angles() {
    let text = r#"(
        stars: { "door": ["0+ @0", "0- @180"], "corner": ["0+ @180", "1+ closed", "0- closed", "1- @-90"] },
        start: "door",
        travels: [
            (exit: "0+", entry: "0+", star: "corner",
             odometry: (x: 8, y: 6, theta: 0.5235987755982988, covariance: [[0.04, 0, 0.01], [0, 0.09, 0], [0.01, 0, 0.01]])),
            (exit: "1-", entry: "0-", star: "door"),
        ],
    )"#;
    let exploration = Exploration::from_ron(text).unwrap();
    let trace = Trace::of(&exploration, Sight::Ahead, Turning::Direct).unwrap();
    let changes: Vec<Change> = trace.schemas().map(|schema| schema.change).collect();
    // The robot looked east and looks east again in the corner's frame: it turned as the frame did.
    assert!((changes[0].distance.unwrap() - 10.0).abs() < 1e-12);
    assert!((changes[0].rotation.unwrap().to_degrees() - 30.0).abs() < 1e-9);
    // The variance along (0.8, 0.6): 0.64 · 0.04 + 0.36 · 0.09; with the angle: 0.8 · 0.01.
    let [[distance, both], [mirrored, angle]] = changes[0].covariance.unwrap();
    assert!((distance - 0.058).abs() < 1e-12 && (both - 0.008).abs() < 1e-12);
    assert_eq!((both, angle), (mirrored, 0.01));
    // From east to south is a quarter turn clockwise; nothing was measured after it.
    assert!((changes[1].rotation.unwrap() + FRAC_PI_2).abs() < 1e-9);
    assert_eq!(changes[2], Change::default());
    insta::assert_snapshot!(schemas(&trace));
}

/// "There is no way to figure out whether the intersection has more than just two intersecting paths."
#[test]
fn without_angles_a_star_is_known_up_to_a_modulo() {
    let stay = |text: &str, sight, bearings: Vec<Option<f64>>| {
        let star_types = vec![NamedStar { name: "S".to_owned(), star: star(text), bearings }];
        let travel = Travel { exit: Olp::new(0), entry: Olp::new(2), star: StarType(0), odometry: None };
        let exploration = Exploration::new(star_types, StarType(0), vec![travel]).unwrap();
        stays(&Trace::of(&exploration, sight, Turning::AllRoundAndAround).unwrap()).remove(0)
    };
    let quarters = || [0.0, -1.0, 2.0, 1.0].map(|quarter| Some(quarter * FRAC_PI_2)).to_vec();
    let plus = stay("0+ 1+ 0- 1-", Sight::Ahead, vec![None; 4]);
    assert_eq!(plus.degrees(10), [2, 4, 6, 8, 10]);
    assert_eq!(plus.stars(6), None, "the sixth end was never faced: the circle was thought to be over");
    assert_eq!(plus.stars(4).unwrap().len(), 3, "any end may be the opposite");
    let tee = stay("0+ 1+ 0- (1-)", Sight::Ahead, vec![None; 4]);
    assert_eq!(tee.degrees(10), [4, 6, 8, 10]);
    assert_eq!(tee.stars(4).unwrap(), [star("0+ 1+ 0- (1-)")], "the closed end is seen behind one only");
    assert_eq!(
        stay("0+ 1+ 0- 1-", Sight::Ahead, quarters()).degrees(10),
        [4],
        "four measured turns are a circle"
    );
    assert_eq!(stay("0+ 1+ 0- 1-", Sight::Place, vec![None; 4]).degrees(10), [4], "a place seen at once");
}

#[test]
fn full_turns_add_up() {
    let bearings = [10.0, -70.0, 200.0, 100.0_f64].map(|degrees| Some(degrees.to_radians())).to_vec();
    let named = NamedStar { name: "+".to_owned(), star: star("0+ 1+ 0- 1-"), bearings };
    let travel = Travel { exit: Olp::new(0), entry: Olp::new(2), star: StarType(0), odometry: None };
    let exploration = Exploration::new(vec![named], StarType(0), vec![travel]).unwrap();
    let trace = Trace::of(&exploration, Sight::Ahead, Turning::AllRound).unwrap();
    let turned: f64 = trace.schemas().filter_map(|schema| schema.change.rotation).sum();
    assert!((turned + TAU).abs() < 1e-9);
}

#[test]
fn a_trace_that_is_none_of_stars_is_refused() {
    let place = |text: &str| View::of(&star(text), Olp::new(0), Sight::Place);
    let turn = |view| Step { action: Action::Turn { clockwise: 1 }, change: Change::default(), view };
    let contradiction = Trace::new(place("0+ (1+) 0- 1-"), vec![turn(place("0+ 1+ 0- 1-"))]);
    insta::assert_snapshot!(exploration(&contradiction).unwrap_err(), @"schema 1: after `turn 1` the place looks like `0+ 1+ 0- 1-`, but by the star seen on arrival it should be `(0+) 1+ 0- 1-`");
    let ahead = Trace::of(&figure_2_4(), Sight::Ahead, Turning::Direct).unwrap();
    assert!(exploration(&ahead).is_err());
    let silent = Exploration::new(figure_2_4().star_types().to_vec(), StarType(0), vec![]).unwrap();
    assert_eq!(Trace::of(&silent, Sight::Place, Turning::Direct), None);
}

/// Random stars and travels between random gateways of theirs.
fn explorations() -> impl Strategy<Value = Exploration> {
    prop::collection::vec((0..STARS.len(), any::<u32>(), any::<u32>()), 2..10).prop_map(|choices| {
        let named = |text: &&str| {
            let star = star(text);
            NamedStar { name: (*text).to_owned(), bearings: vec![None; star.ends().len()], star }
        };
        let star_types: Vec<NamedStar> = STARS.iter().map(named).collect();
        let gateway = |star_type: usize, choice: u32| {
            let gateways: Vec<Olp> = star_types[star_type].star.gateways().collect();
            gateways[choice as usize % gateways.len()]
        };
        let travels = choices.windows(2).map(|pair| Travel {
            exit: gateway(pair[0].0, pair[0].1),
            entry: gateway(pair[1].0, pair[1].2),
            star: StarType(pair[1].0 as u32),
            odometry: None,
        });
        let (travels, start) = (travels.collect(), StarType(choices[0].0 as u32));
        Exploration::new(star_types, start, travels).unwrap()
    })
}

fn turnings() -> impl Strategy<Value = Turning> {
    prop::sample::select(vec![
        Turning::Direct,
        Turning::Stepwise,
        Turning::AllRound,
        Turning::AllRoundAndAround,
    ])
}

/// Traces over few views and actions, so that much looks alike.
fn traces() -> impl Strategy<Value = Trace> {
    let views = || prop::sample::select(vec!["0+ 0-", "0+ (0-)"]);
    let actions =
        prop::sample::select(vec![Action::Travel, Action::Turn { clockwise: 1 }, Action::TurnAround]);
    (views(), prop::collection::vec((actions, views()), 0..7)).prop_map(|(first, steps)| {
        let view = |text: &str| View::of(&star(text), Olp::new(0), Sight::Place);
        let step = |(action, text)| Step { action, change: Change::default(), view: view(text) };
        Trace::new(view(first), steps.into_iter().map(step).collect())
    })
}

/// All partitions of so many moments, each as the number of the part of every moment.
fn partitions(moments: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for _ in 0..moments {
        let grown = |parts: &Vec<usize>| {
            let next = parts.iter().max().map_or(0, |most| most + 1);
            (0..=next).map(|part| [parts.clone(), vec![part]].concat()).collect::<Vec<_>>()
        };
        all = all.iter().flat_map(grown).collect();
    }
    all
}

/// Whether a partition is that of a deterministic automaton: equal parts have equal views, and by equal
/// actions lead to equal parts.
fn is_deterministic(trace: &Trace, parts: &[usize]) -> bool {
    let schemas = trace.steps();
    (0..parts.len()).all(|one| {
        (0..parts.len()).filter(|&other| parts[one] == parts[other]).all(|other| {
            let act_alike =
                one < schemas.len() && other < schemas.len() && schemas[one].action == schemas[other].action;
            trace.view(one) == trace.view(other) && (!act_alike || parts[one + 1] == parts[other + 1])
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Explorations and traces of whole places say the same; a recovered star is the observed one from
    /// where the robot looked on arrival.
    #[test]
    fn an_exploration_comes_back(exploration in explorations(), turning in turnings()) {
        let trace = Trace::of(&exploration, Sight::Place, turning).unwrap();
        let recovered = hssh_causal::schema::exploration(&trace).unwrap();
        prop_assert_eq!(recovered.travels().len(), exploration.travels().len());
        for (travel, back) in exploration.travels().iter().zip(recovered.travels()) {
            let (star, image) = (exploration.star(travel.star), recovered.star(back.star));
            prop_assert!(Isomorphism::anchored(star, travel.entry, image, back.entry).is_some());
        }
        prop_assert_eq!(Trace::of(&recovered, Sight::Place, turning).unwrap(), trace);
    }

    /// The true star is among those that a stay admits, whatever was turned and seen.
    #[test]
    fn a_stay_admits_the_true_star(exploration in explorations(), turning in turnings()) {
        let trace = Trace::of(&exploration, Sight::Ahead, turning).unwrap();
        let stays = stays(&trace);
        prop_assert_eq!(stays.len(), exploration.travels().len() + 1);
        for (stay, travel) in stays[1..].iter().zip(exploration.travels()) {
            let star = exploration.star(travel.star);
            let facing = star.opposite(travel.entry);
            prop_assert!(stay.degrees(6).contains(&star.degree()));
            let is_it = |other: &Star| Isomorphism::anchored(star, facing, other, Olp::new(0)).is_some();
            prop_assert!(stay.stars(star.degree()).is_none_or(|stars| stars.iter().any(is_it)));
        }
    }

    /// Merging accepts an assumption if and only if some deterministic automaton has it, and then it is the
    /// one with the most states.
    #[test]
    fn the_automaton_against_all_partitions(trace in traces(), one in 0_usize..8, other in 0_usize..8) {
        let moments = trace.views().len();
        let (one, other) = (one % moments, other % moments);
        let consistent: Vec<Vec<usize>> = partitions(moments)
            .into_iter()
            .filter(|parts| parts[one] == parts[other] && is_deterministic(&trace, parts))
            .collect();
        match Automaton::assuming(&trace, &[(one, other)]) {
            Ok(automaton) => {
                let parts: Vec<usize> = (0..moments).map(|moment| automaton.state(moment).index()).collect();
                prop_assert!(consistent.contains(&parts));
                let most = consistent.iter().filter_map(|parts| parts.iter().max()).max();
                prop_assert_eq!(most.map(|most| most + 1), Some(automaton.views().len()));
                for (moment, step) in trace.steps().iter().enumerate() {
                    let next = automaton.predict(automaton.state(moment), step.action);
                    prop_assert_eq!(next, Some(automaton.state(moment + 1)));
                }
            }
            Err(refutation) => {
                prop_assert!(consistent.is_empty());
                let (view, steps) = (|moment: usize| trace.view(moment), trace.steps());
                match refutation {
                    Refutation::Views(one, other) => prop_assert_ne!(view(one), view(other)),
                    Refutation::Schemas(one, other) => {
                        prop_assert!(one < other);
                        prop_assert_eq!(view(one), view(other));
                        prop_assert_eq!(steps[one].action, steps[other].action);
                        prop_assert_ne!(view(one + 1), view(other + 1));
                    }
                }
            }
        }
    }

    /// A partition is accepted as it is if and only if it is deterministic.
    #[test]
    fn a_partition_against_its_definition(trace in traces(), choice in any::<prop::sample::Index>()) {
        let all = partitions(trace.views().len());
        let parts = choice.get(&all);
        let kept = Automaton::from_partition(&trace, |moment| parts[moment]).is_ok_and(|automaton| {
            (0..parts.len()).all(|moment| automaton.state(moment).index() == parts[moment])
        });
        prop_assert_eq!(kept, is_deterministic(&trace, parts));
    }
}
