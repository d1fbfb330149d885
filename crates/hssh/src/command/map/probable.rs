//! The most probable maps, as a table or as JSON.

use std::fmt::Write;

use hssh_causal::Exploration;
use hssh_metrics::Pose;
use hssh_search::{
    Appearance, Cost, Distinction, LINEAR_TRUST, Posterior, PosteriorOrder, PosteriorReport, PosteriorSearch,
    Prediction, ProbableMap, StopReason, place_by_odometry,
};
use hssh_topology::{MapOlp, MapSketch, Measure, Position, StarCatalog};
use serde::Serialize;

use super::draw::{Pictures, draw};
use super::{Source, none_survives};
use crate::arguments::{MapOptions, SearchOptions};
use crate::failure::{Failure, Status};
use crate::output::{counted, print, print_json};
use crate::progress::watched;

/// What `--json` prints: the report's fields, and the maps.
#[derive(Serialize)]
struct Answer<'a> {
    #[serde(flatten)]
    report: &'a PosteriorReport,
    ranking: Vec<Entry>,
}

/// A map in the ranking.
#[derive(Serialize)]
struct Entry {
    rank: usize,
    /// At least, and at most.
    probability: [f64; 2],
    /// In nats.
    total_cost: f64,
    cost: Cost,
    #[serde(flatten)]
    measure: Measure,
    closed: bool,
    /// Where the robot is at the end.
    position: Position,
    poses: Vec<Pose>,
    map: MapSketch,
    /// For maps as probable as the first one.
    differs_from_first: Option<String>,
}

/// Searches by posterior and answers.
pub(crate) fn run(options: &MapOptions, order: PosteriorOrder, source: &Source) -> Result<Status, Failure> {
    let appearance = match &source.surveyed {
        Some(surveyed) if options.likeness != 0.0 => surveyed.appearance(options.likeness),
        _ => Appearance::default(),
    };
    let posterior = search(&options.search, order, &source.exploration, appearance)?;
    let report = posterior.report();
    let listed = if options.all { usize::MAX } else { options.top };
    let maps = &posterior.maps()[..posterior.maps().len().min(listed)];
    if options.json {
        print_json(&answer(&posterior, maps))?;
    } else {
        print(&text(options, &posterior, maps))?;
    }
    let ties = maps.len().min(report.ties as usize);
    let mut best = Vec::new();
    for map in &maps[..ties] {
        let placed = match posterior.pose_graph(map) {
            None => place_by_odometry(&source.exploration, &posterior.visits(map.node))?
                .map(|placed| placed.graph),
            found => found,
        };
        best.push((map.node, placed));
    }
    let kind = if report.proved { "most probable map" } else { "most probable map found" };
    let (tree, experience) = (posterior.tree(), posterior.experience());
    draw(options, &Pictures { source, tree, experience, best: &best, kind })?;
    Ok(status_of(&posterior))
}

/// Searches with a progress line; Ctrl-C leaves what is known so far.
pub(crate) fn search(
    options: &SearchOptions,
    order: PosteriorOrder,
    exploration: &Exploration,
    appearance: Appearance,
) -> Result<Posterior, Failure> {
    let travels = exploration.travels().len();
    watched(travels, |monitor| {
        let search = options.weighing(order, exploration, monitor)?;
        Ok(PosteriorSearch { appearance, ..search }.explain(exploration)?)
    })
}

pub(crate) fn status_of(posterior: &Posterior) -> Status {
    match (posterior.report().stop.is_complete(), posterior.maps().is_empty()) {
        (false, _) => Status::Stopped,
        (true, true) => Status::NothingConsistent,
        (true, false) => Status::Found,
    }
}

fn answer<'a>(posterior: &'a Posterior, maps: &[ProbableMap]) -> Answer<'a> {
    let entry = |(index, map): (usize, &ProbableMap)| {
        let hypothesis = posterior.hypothesis(map.node);
        let is_tied = index > 0 && (index as u64) < posterior.report().ties;
        Entry {
            rank: index + 1,
            probability: [map.least_probability, map.probability],
            total_cost: map.cost.total(),
            cost: map.cost,
            measure: map.measure,
            closed: map.closed,
            position: hypothesis.position,
            poses: map.poses.clone(),
            map: MapSketch::of(&hypothesis.map, &posterior.experience().catalog),
            differs_from_first: is_tied.then(|| difference(posterior, &maps[0], map)),
        }
    };
    Answer { report: posterior.report(), ranking: maps.iter().enumerate().map(entry).collect() }
}

fn text(options: &MapOptions, posterior: &Posterior, maps: &[ProbableMap]) -> String {
    let report = posterior.report();
    let mut text = report.to_string();
    if options.levels {
        let _ = writeln!(text, "  {:>7}{:>14}{:>14}", "travels", "nodes", "maps");
        for (travels, level) in report.levels.iter().enumerate() {
            let _ = writeln!(text, "  {travels:>7}{:>14}{:>14}", level.nodes, level.maps);
        }
        let _ = writeln!(text, "  {} nodes expanded in {:.3} s", report.expanded, report.seconds);
    }
    text += &verdict(report, maps);
    if !maps.is_empty() {
        text += "\n  rank   probability       cost     χ²/2    f1   paths  places  genus  closed\n";
    }
    let ties = report.ties as usize;
    for (index, map) in maps.iter().enumerate() {
        let mark = if index < ties && report.proved { '*' } else { ' ' };
        let Measure { undetermined_boundaries, paths, places, genus } = map.measure;
        let closed = if map.closed { "yes" } else { "no" };
        let (rank, probability, cost, bend) = (index + 1, map.probability, map.cost.total(), map.cost.bend);
        let _ = writeln!(
            text,
            "{rank:>6} {mark}{probability:>13.3e}{cost:>11.3}{bend:>9.2}{undetermined_boundaries:>6}\
             {paths:>8}{places:>8}{genus:>7}  {closed}"
        );
    }
    let unlisted = report.found - maps.len() as u64;
    if unlisted > 0 {
        let _ = writeln!(text, "  … and {unlisted} more (--all lists them)");
    }
    for (index, map) in maps.iter().enumerate().take(ties).skip(1) {
        let _ =
            writeln!(text, "Map {} differs from map 1: {}", index + 1, difference(posterior, &maps[0], map));
    }
    text
}

/// The answer in a sentence or two.
fn verdict(report: &PosteriorReport, maps: &[ProbableMap]) -> String {
    let Some(best) = maps.first() else { return why_nothing(report) };
    let stopped = if report.stop.is_complete() { "" } else { "Stopped early. " };
    let which = match (report.proved, report.ties) {
        (true, 1) => "One map is the most probable; that no other is as probable is proved.".to_owned(),
        (true, ties) => {
            format!("{ties} maps are equally probable; that no other is as probable is proved.")
        }
        (false, _) if report.stop == StopReason::Found => {
            "This map explains the exploration; whether a more probable one exists was not searched."
                .to_owned()
        }
        (false, _) if report.unsolvable => {
            "Some layouts cannot be computed, so that nothing is proved: is an odometry out of all proportion?"
                .to_owned()
        }
        (false, _) if report.linear_factor < LINEAR_TRUST => {
            format!(
                "{} found. The bound relied on linear estimates that proved wrong by more than a factor of {:.0}, so \
                 that nothing is proved.",
                counted(report.found as usize, "map"),
                1.0 / LINEAR_TRUST
            )
        }
        (false, _) => {
            format!("{} found; others may be more probable.", counted(report.found as usize, "map"))
        }
    };
    let (least, most) = (best.least_probability, best.probability);
    format!("{stopped}{which}\nThe first one's probability is at least {least:.4} and at most {most:.4}.\n")
}

/// Why there is no map.
fn why_nothing(report: &PosteriorReport) -> String {
    match (report.stop.is_complete(), report.rejected) {
        (false, _) => "Stopped early: no map that explains everything was found yet.\n".to_owned(),
        (true, 0) => none_survives(&report.levels),
        (true, 1) => "No closed map explains the exploration; 1 hypothesis was left with pending gateways.\n"
            .to_owned(),
        (true, rejected) => format!(
            "No closed map explains the exploration; {rejected} hypotheses were left with pending gateways.\n"
        ),
    }
}

/// What tells a map from the first one.
fn difference(posterior: &Posterior, first: &ProbableMap, second: &ProbableMap) -> String {
    let Distinction { parting, test } = posterior.distinguish(first, second);
    let catalog = &posterior.experience().catalog;
    let Some(parting) = parting else { return "in nothing.".to_owned() };
    let (visit, [one, two]) = (parting.visit, parting.positions.map(|position| position.place));
    let mut text = if one == two {
        format!("visit {visit} sees place {one} from another side.")
    } else {
        format!("visit {visit} is at place {one} in map 1, at place {two} here.")
    };
    let Some(test) = test else {
        return text + " No travel through known links tells them apart.";
    };
    let map = posterior.hypothesis(first.node).map;
    let leave = |exit: &MapOlp| {
        let place = map.place(*exit);
        format!("leave place {place} by {}", catalog.star(map.star(place)).name(map.local(*exit)))
    };
    let way: Vec<String> = test.exits.iter().map(leave).collect();
    let [in_first, here] = test.predictions.map(|prediction| says(prediction, catalog));
    let _ = write!(text, " To find out: {}. Map 1 says: {in_first}; this one: {here}.", way.join(", "));
    text
}

fn says(prediction: Prediction, catalog: &StarCatalog) -> String {
    match prediction {
        Prediction::Unknown => "anything may follow".to_owned(),
        Prediction::Arrival { place, star, entry } => {
            let star = catalog.star(star);
            format!("place {place}, entered by {} of the star {star}", star.name(entry))
        }
    }
}
