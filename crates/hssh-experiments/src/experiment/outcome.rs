//! One run of an experiment: the search, and what it measured beside what was expected.

use std::error::Error;
use std::path::Path;

use hssh_search::{Experience, Mapper, Report, StopReason};
use hssh_topology::{Hypothesis, Measure};
use serde::Serialize;

use crate::experiment::schema::{Expected, Run};
use crate::experiment::truth::{Verdict, is_same, true_hypothesis};
use crate::experiment::world::{Missing, case};
use crate::table::grouped;

/// What a run gave.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Outcome {
    /// The column's head.
    pub(crate) name: String,
    /// The file of the data folder that is missing; nothing was measured then.
    pub(crate) missing: Option<String>,
    /// The account of the search.
    pub(crate) report: Option<Report>,
    /// What became of the true map, if it is known and the search came to its end.
    pub(crate) true_map: Option<Verdict>,
    /// The rows of the table.
    pub(crate) cells: Vec<Cell>,
}

/// One measured value, and what it should be.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub(crate) struct Cell {
    /// The row's name.
    pub(crate) quantity: &'static str,
    /// As text, numbers in groups of three digits.
    pub(crate) measured: String,
    /// What it should be, from every source that says so.
    pub(crate) expected: Vec<Claim>,
}

/// What one source says about a value.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub(crate) struct Claim {
    /// As text, like the measured value.
    pub(crate) value: String,
    /// Who says so.
    pub(crate) source: String,
    /// Whether it was measured.
    pub(crate) holds: bool,
}

/// The row that is printed below the table: one number per level.
pub(crate) const LEVELS: &str = "nodes per level";

const TRUE_MAP: &str = "true map";

impl Cell {
    /// Whether every source agrees with what was measured.
    pub(crate) fn agrees(&self) -> bool {
        self.expected.iter().all(|claim| claim.holds)
    }
}

impl Outcome {
    /// How many values differ from an expected one.
    pub(crate) fn differences(&self) -> usize {
        self.cells.iter().filter(|cell| !cell.agrees()).count()
    }
}

/// Searches, and compares.
pub(crate) fn outcome(run: &Run, data: Option<&Path>, threads: usize) -> Result<Outcome, Box<dyn Error>> {
    let name = run.name.clone();
    let case = match case(&run.world, run.route.as_ref(), data) {
        Ok(case) => case,
        Err(Missing::Data(file)) => {
            let missing = Some(file);
            return Ok(Outcome { name, missing, report: None, true_map: None, cells: Vec::new() });
        }
        Err(Missing::Error(error)) => return Err(format!("{name}: {error}").into()),
    };
    let builder = Mapper::builder().axioms(run.axioms).preference(run.preference).threads(threads);
    let builder = builder.limits(run.limits.into());
    let (report, mapper) = match run.search.order_and_goal() {
        None => (builder.count(&case.exploration)?, None),
        Some((order, goal)) => {
            let mapper = builder.order(order).goal(goal).explain(&case.exploration)?;
            (mapper.report(), Some(mapper))
        }
    };
    let truth =
        case.visits.map(|visits| true_hypothesis(&Experience::from(&case.exploration), &visits, &run.axioms));
    let true_map = truth
        .filter(|_| report.stop.is_complete())
        .map(|truth| verdict(run, truth.as_ref(), &report, mapper.as_ref()));
    let cells = cells(run, &report, true_map);
    Ok(Outcome { name, missing: None, report: Some(report), true_map, cells })
}

/// What became of the true map in a search that came to its end.
fn verdict(run: &Run, truth: Option<&Hypothesis>, report: &Report, mapper: Option<&Mapper>) -> Verdict {
    let (Some(truth), Some(best)) = (truth, report.finals.best) else { return Verdict::Lost };
    let rank = |measure| run.preference.rank(measure);
    let is_found = |mapper: &Mapper| {
        let found = mapper.maps(report.finals.optimal as usize);
        found.iter().any(|map| is_same(&mapper.hypothesis(map.node), truth))
    };
    let ranks_best = rank(Measure::of(&truth.map)) == rank(best);
    // A count of all hypotheses keeps none, but has the true map among its optima if it ranks with them.
    match ranks_best && mapper.is_none_or(is_found) {
        true if report.finals.optimal == 1 => Verdict::OnlyOptimum,
        true => Verdict::AmongOptima,
        false => Verdict::Survives,
    }
}

/// The rows that make sense for this search.
fn cells(run: &Run, report: &Report, true_map: Option<Verdict>) -> Vec<Cell> {
    let finals = &report.finals;
    let mut measured = vec![("nodes", grouped(report.nodes))];
    if run.search.is_complete() {
        measured.extend([
            ("maps", grouped(report.maps)),
            ("refuted", grouped(report.refuted)),
            ("final maps", grouped(finals.final_maps)),
            ("nearly closed", grouped(finals.nearly_closed)),
            ("closed", grouped(finals.closed)),
            ("closed, perpendicular", grouped(finals.perpendicular)),
        ]);
    } else {
        measured.push(("expanded", grouped(report.expanded)));
    }
    measured.push(("optimal", grouped(finals.optimal)));
    measured.extend(
        finals
            .best
            .map(|best| ("best (f1, f2, f3)", triple(best.undetermined_boundaries, best.paths, best.places))),
    );
    measured.extend(true_map.map(|verdict| (TRUE_MAP, verdict.to_string())));
    measured.push(("search", ending(report.stop).to_owned()));
    let levels: Vec<u64> = report.levels.iter().map(|level| level.nodes).collect();
    measured.push((LEVELS, spaced(&levels)));

    let cell = |(quantity, measured)| Cell { quantity, measured, expected: Vec::new() };
    let mut cells: Vec<Cell> = measured.into_iter().map(cell).collect();
    for expected in &run.expected {
        for (quantity, value) in values(expected) {
            let place = cells.iter().position(|cell| cell.quantity == quantity).unwrap_or_else(|| {
                cells.push(Cell { quantity, measured: "–".to_owned(), expected: Vec::new() });
                cells.len() - 1
            });
            // More than asked for is right, too: a map that is the only optimum survives.
            let is_enough = quantity == TRUE_MAP && true_map >= expected.true_map;
            let holds = is_enough || cells[place].measured == value;
            cells[place].expected.push(Claim { value, source: expected.source.clone(), holds });
        }
    }
    cells.retain(|cell| cell.quantity != LEVELS || !cell.expected.is_empty());
    cells
}

/// What one source says, by row.
fn values(expected: &Expected) -> Vec<(&'static str, String)> {
    let counts = [
        ("nodes", expected.nodes),
        ("maps", expected.maps),
        ("refuted", expected.refuted),
        ("final maps", expected.final_maps),
        ("nearly closed", expected.nearly_closed),
        ("closed", expected.closed),
        ("closed, perpendicular", expected.perpendicular),
        ("optimal", expected.optimal),
    ];
    let counts = counts.into_iter().filter_map(|(name, count)| Some((name, grouped(count?))));
    let texts = [
        (
            "best (f1, f2, f3)",
            expected.best.map(|(boundaries, paths, places)| triple(boundaries, paths, places)),
        ),
        (TRUE_MAP, expected.true_map.map(|verdict| verdict.to_string())),
        ("search", expected.stop.map(|stop| ending(stop).to_owned())),
        (LEVELS, expected.levels.as_deref().map(spaced)),
    ];
    let texts = texts.into_iter().filter_map(|(name, text)| Some((name, text?)));
    counts.chain(texts).collect()
}

/// How a search ended, in the width of a number.
fn ending(stop: StopReason) -> &'static str {
    match stop {
        StopReason::NotSearched => "not searched",
        StopReason::Exhausted => "complete",
        StopReason::Found => "found",
        StopReason::Proved => "proved",
        StopReason::NodeLimit => "node limit",
        StopReason::TimeLimit => "time limit",
        StopReason::MemoryLimit => "memory limit",
        StopReason::Interrupted => "interrupted",
    }
}

fn triple(undetermined_boundaries: u64, paths: u32, places: u32) -> String {
    format!("({undetermined_boundaries}, {paths}, {places})")
}

fn spaced(levels: &[u64]) -> String {
    levels.iter().map(u64::to_string).collect::<Vec<_>>().join(" ")
}
