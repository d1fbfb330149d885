//! The maps that are preferred, as a table or as JSON.

use hssh_causal::Exploration;
use hssh_search::{Levels, Mapper, RankedMap, Report, StopReason, Strategy, place_by_odometry};
use hssh_topology::{MapSketch, Measure, Position};
use serde::Serialize;

use super::draw::{Pictures, draw, is_asked};
use super::{Source, none_survives};
use crate::arguments::{MapOptions, SearchOptions};
use crate::failure::{Failure, Status};
use crate::output::{counted, print, print_json};
use crate::progress::watched;

/// What `--json` prints: the report's fields, and the maps.
#[derive(Serialize)]
struct Answer {
    #[serde(flatten)]
    report: Report,
    ranking: Vec<Entry>,
}

/// A map in the ranking.
#[derive(Serialize)]
struct Entry {
    rank: usize,
    #[serde(flatten)]
    measure: Measure,
    closed: bool,
    nearly_closed: bool,
    optimal: bool,
    /// Where the robot is at the end.
    position: Position,
    map: MapSketch,
}

/// Searches by preference and answers.
pub(crate) fn run(options: &MapOptions, strategy: Strategy, source: &Source) -> Result<Status, Failure> {
    let mapper = search(&options.search, strategy, &source.exploration)?;
    let (report, maps) = mapper.answer(if options.all { usize::MAX } else { options.top });
    print_answer(options, &mapper, &report, &maps)?;
    let mut best = Vec::new();
    for map in maps.iter().take(if is_asked(options) { best_of(&report, &maps) } else { 0 }) {
        let placement = place_by_odometry(&source.exploration, &mapper.visits(map.node))?;
        best.push((map.node, placement.map(|placement| placement.graph)));
    }
    let kind = if report.is_optimal { "optimal map" } else { "best map found" };
    let (tree, experience) = (mapper.tree(), mapper.experience());
    draw(options, &Pictures { source, tree, experience, best: &best, kind })?;
    Ok(status_of(&report))
}

/// Searches with a progress line; Ctrl-C leaves what is known so far.
pub(crate) fn search(
    options: &SearchOptions,
    strategy: Strategy,
    exploration: &Exploration,
) -> Result<Mapper, Failure> {
    let travels = exploration.travels().len();
    Ok(watched(travels, |monitor| options.builder(monitor).strategy(strategy).explain(exploration))?)
}

pub(crate) fn status_of(report: &Report) -> Status {
    match (report.stop.is_complete(), report.finals.final_maps) {
        (false, _) => Status::Stopped,
        (true, 0) => Status::NothingConsistent,
        (true, _) => Status::Found,
    }
}

/// Counts and answers.
pub(crate) fn run_count(options: &MapOptions, exploration: &Exploration) -> Result<Status, Failure> {
    let travels = exploration.travels().len();
    let report = watched(travels, |monitor| options.search.builder(monitor).count(exploration))?;
    if options.json {
        print_json(&report)?;
    } else {
        print(&account(options, &report))?;
    }
    Ok(status_of(&report))
}

/// The report, with its levels if they are asked for.
fn account(options: &MapOptions, report: &Report) -> String {
    let levels = if options.levels { Levels(report).to_string() } else { String::new() };
    format!("{report}{levels}")
}

fn print_answer(
    options: &MapOptions,
    mapper: &Mapper,
    report: &Report,
    maps: &[RankedMap],
) -> Result<(), Failure> {
    let optimal = optimal_of(report, maps);
    if options.json {
        let entry = |(index, map): (usize, &RankedMap)| {
            let hypothesis = mapper.hypothesis(map.node);
            Entry {
                rank: index + 1,
                measure: map.measure,
                closed: map.closed,
                nearly_closed: map.nearly_closed,
                optimal: index < optimal,
                position: hypothesis.position,
                map: MapSketch::of(&hypothesis.map, &mapper.experience().catalog),
            }
        };
        let ranking = maps.iter().enumerate().map(entry).collect();
        return print_json(&Answer { report: report.clone(), ranking });
    }
    let mut text = account(options, report);
    text += &verdict(report);
    if !maps.is_empty() {
        text += "\n  rank     f1   f2 paths  f3 places  genus  closed\n";
    }
    for (index, map) in maps.iter().enumerate() {
        let mark = if index < optimal { '*' } else { ' ' };
        let measure = map.measure;
        let closed = if map.closed { "yes" } else { "no" };
        text += &format!(
            "{:>6} {mark}{:>6}{:>11}{:>11}{:>7}  {closed}\n",
            index + 1,
            measure.undetermined_boundaries,
            measure.paths,
            measure.places,
            measure.genus
        );
    }
    let listed = maps.len() as u64;
    if report.finals.final_maps > listed {
        text += &format!("  … and {} more (--all lists them)\n", report.finals.final_maps - listed);
    }
    print(&text)
}

/// The answer in a sentence.
fn verdict(report: &Report) -> String {
    let finals = &report.finals;
    let maps = counted(finals.final_maps as usize, "map");
    let explains = if finals.final_maps == 1 { "explains" } else { "explain" };
    match (report.stop, finals.final_maps, finals.optimal) {
        (stop, 0, _) if !stop.is_complete() => {
            "Stopped early: no map that explains everything was found yet.\n".to_owned()
        }
        (_, 0, _) if report.rejected > 0 => {
            let hypotheses = match report.rejected {
                1 => "1 hypothesis was".to_owned(),
                many => format!("{many} hypotheses were"),
            };
            format!("No closed map explains the exploration; {hypotheses} left with pending gateways.\n")
        }
        (_, 0, _) => none_survives(&report.levels),
        (StopReason::Exhausted, _, 1) => format!("{maps} {explains} the exploration; one is optimal.\n"),
        (StopReason::Exhausted, _, best) => {
            format!("{maps} {explains} the exploration; {best} are optimal.\n")
        }
        (StopReason::Proved, _, 1) => "One map is optimal; that no other is as good is proved.\n".to_owned(),
        (StopReason::Proved, _, best) => {
            format!("{best} maps are optimal; that no other is as good is proved.\n")
        }
        (StopReason::Found, _, _) => {
            "This map explains the exploration; whether a better one exists was not searched.\n".to_owned()
        }
        _ if report.explained < report.travels => {
            let Report { explained, travels, .. } = report;
            format!("Stopped early: {maps} {explains} the first {explained} of {travels} travels.\n")
        }
        _ => format!("Stopped early: {maps} {explains} everything; others may be better.\n"),
    }
}

/// How many of the listed maps share the best rank.
fn best_of(report: &Report, maps: &[RankedMap]) -> usize {
    maps.len().min(report.finals.optimal as usize)
}

/// How many of the listed maps are known to be optimal.
fn optimal_of(report: &Report, maps: &[RankedMap]) -> usize {
    if report.is_optimal { best_of(report, maps) } else { 0 }
}
