//! The experiments as a regression suite: every expected value holds, and the tables are as they were.

use std::path::PathBuf;

use hssh_causal::Exploration;
use hssh_oracle::{Rules, enumerate};
use hssh_topology::{Axioms, GenusRank, Preference};

use super::outcome::{Outcome, outcome};
use super::schema::{Experiment, Search};
use super::truth::Verdict;
use super::world::case;
use super::{names, outcomes, read, text};

/// Runs an experiment, checks every expected value and keeps its table.
fn check(name: &str) {
    let experiment = read(name).unwrap();
    let outcomes = outcomes(&experiment, None, 2).unwrap();
    let table = text::table(&experiment, &outcomes);
    assert_eq!(outcomes.iter().map(Outcome::differences).sum::<usize>(), 0, "{table}");
    insta::assert_snapshot!(name, table);
}

#[test]
fn figure_3_3() {
    check("figure-3-3");
}

#[test]
fn figure_2_4() {
    check("figure-2-4");
}

#[test]
fn aces() {
    check("aces");
}

#[test]
fn proof() {
    check("proof");
}

#[test]
fn random_planar() {
    check("random-planar");
}

#[test]
fn streets() {
    let Some(data) = std::env::var_os("HSSH_DATA").map(PathBuf::from) else {
        println!("skipped: set HSSH_DATA to the folder with streets/");
        return;
    };
    let experiment = read("streets").unwrap();
    let outcomes = outcomes(&experiment, Some(&data), 2).unwrap();
    assert_eq!(outcomes.iter().map(Outcome::differences).sum::<usize>(), 0);
    insta::assert_snapshot!("streets", text::table(&experiment, &outcomes));
}

#[test]
fn streets_without_data_say_what_they_need() {
    let experiment = read("streets").unwrap();
    let outcomes = outcomes(&experiment, None, 1).unwrap();
    let table = text::table(&experiment, &outcomes);
    assert!(table.contains("skipped: needs DATA/streets/bubenec_streets.txt; pass --data DATA"), "{table}");
}

/// The naive mapper of `hssh-oracle` recomputes everything from the definitions.
fn oracle_agrees(exploration: &Exploration, axioms: &Axioms, outcome: &Outcome) {
    let rules = Rules {
        no_self_intersection: axioms.no_self_intersection,
        no_circular_path: axioms.no_circular_path,
        places_bound: axioms.max_places.map(|most| most as usize),
        genus_bound: axioms.max_genus.map(|most| most as usize),
        perpendicular: axioms.perpendicular,
        sides: axioms.consistent_boundaries,
    };
    let naive = enumerate(exploration, &rules);
    let report = outcome.report.as_ref().unwrap();
    let refuted: usize = naive.levels.iter().map(|level| level.refuted).sum();
    let counts = [report.nodes, report.maps, report.refuted, report.finals.final_maps];
    let independent = [naive.nodes(), naive.maps(), refuted, naive.final_maps.len()];
    assert_eq!(counts, independent.map(|count| count as u64), "{}", outcome.name);
    let kinds = [report.finals.closed, report.finals.nearly_closed, report.finals.perpendicular];
    let independent = [naive.closed(), naive.nearly_closed(), naive.closed_and_perpendicular()];
    assert_eq!(kinds, independent.map(|count| count as u64), "{}", outcome.name);
    let (best, optimal) = naive.optimum().unwrap();
    let measure = report.finals.best.unwrap();
    assert_eq!((measure.undetermined_boundaries, measure.paths, measure.places), {
        (best.unrelated as u64, best.paths as u32, best.places as u32)
    });
    assert_eq!(report.finals.optimal, optimal as u64, "{}", outcome.name);
}

#[test]
fn what_is_called_an_independent_count_is_one() {
    for name in ["figure-2-4", "aces", "random-planar", "figure-3-3"] {
        let experiment = read(name).unwrap();
        // The naive mapper takes seconds for more nodes than those of the 3×4 grid.
        let small =
            experiment.runs.iter().filter(|run| run.search.is_complete() && !run.name.contains("4×4"));
        for run in small.filter(|run| run.axioms.max_places.is_none()) {
            let case = case(&run.world, run.route.as_ref(), None).ok().unwrap();
            let outcome = outcome(run, None, 1).unwrap();
            oracle_agrees(&case.exploration, &run.axioms, &outcome);
        }
    }
}

#[test]
fn every_search_finds_the_same_optima() {
    let experiment = read("proof").unwrap();
    let small = experiment.runs.iter().filter(|run| run.name.starts_with(['3', '4']));
    for run in small {
        let proved = outcome(run, None, 1).unwrap().report.unwrap().finals;
        for search in [Search::BreadthFirst, Search::Exhaustive] {
            let complete = outcome(&super::schema::Run { search, ..run.clone() }, None, 2).unwrap();
            let complete = complete.report.unwrap().finals;
            let values = |finals: &hssh_search::FinalCounts| {
                let best = finals.best.unwrap();
                (best.undetermined_boundaries, best.paths, best.places, finals.optimal)
            };
            assert_eq!(values(&proved), values(&complete), "{}", run.name);
        }
    }
}

#[test]
fn an_axiom_that_the_world_breaks_loses_the_true_map() {
    let text = r#"(title: "t", runs: [
        (name: "too few places", world: grid(rows: 3, columns: 3), route: snake,
         axioms: (max_places: 8), search: exhaustive, preference: (genus: First)),
        (name: "first travels", world: grid(rows: 3, columns: 3), route: places([0, 1, 2]), search: exhaustive),
    ])"#;
    let experiment = Experiment::read(text).unwrap();
    assert_eq!(experiment.runs[0].preference, Preference { genus: GenusRank::First });
    let verdicts: Vec<_> =
        outcomes(&experiment, None, 1).unwrap().into_iter().map(|outcome| outcome.true_map).collect();
    assert_eq!(verdicts, [Some(Verdict::Lost), Some(Verdict::OnlyOptimum)]);
}

#[test]
fn a_wrong_value_is_marked() {
    let text = r#"(title: "t", runs: [(name: "3×3", world: grid(rows: 3, columns: 3), route: snake,
        search: exhaustive, expected: [(source: "a misprint", nodes: 318), (source: "a book", nodes: 317)])])"#;
    let experiment = Experiment::read(text).unwrap();
    let outcomes = outcomes(&experiment, None, 1).unwrap();
    assert_eq!(outcomes[0].differences(), 1);
    let table = text::table(&experiment, &outcomes);
    assert!(table.contains("317       318  DIFFERS [1][2]"), "{table}");
}

#[test]
fn mistakes_in_a_file_have_a_line_and_a_column() {
    let error = Experiment::read("(\n    title: \"t\",\n    runz: [],\n)").unwrap_err();
    assert_eq!((error.span.start.line, error.span.start.col), (3, 5), "{error}");
}

#[test]
fn every_experiment_can_be_read() {
    let names = names().unwrap();
    assert!(names.len() >= 8);
    names.iter().for_each(|name| drop(read(name).unwrap()));
}
