//! `hssh explain`: how a map explains an exploration, travel by travel, in words.

use hssh_causal::Exploration;
use hssh_search::{Appearance, Experience, NodeId};
use hssh_topology::{
    Discovery, Hypothesis, MapSketch, Measure, Olp, Replay, ReplayedTravel, Star, violations,
};
use serde::Serialize;

use crate::arguments::{ExplainOptions, Task};
use crate::command::map::{preferred, probable};
use crate::failure::{Failure, Status};
use crate::input::read_exploration;
use crate::output::{print, print_json};

/// What `--json` prints.
#[derive(Serialize)]
struct Explanation {
    rank: u32,
    #[serde(flatten)]
    measure: Measure,
    closed: bool,
    map: MapSketch,
    replay: Replay,
}

pub(crate) fn run(options: &ExplainOptions) -> Result<Status, Failure> {
    let exploration = read_exploration(&options.file)?;
    let exploration = exploration.prefix(options.search.travels.unwrap_or(usize::MAX));
    match options.search.task(&exploration)? {
        Task::Count => {
            Err(Failure::Usage("counting keeps no maps to explain: choose another --search".to_owned()))
        }
        Task::Prefer(strategy) => {
            let mapper = preferred::search(&options.search, strategy, &exploration)?;
            let (report, maps) = mapper.answer(options.rank as usize);
            let nodes: Vec<NodeId> = maps.iter().map(|map| map.node).collect();
            let of = |node| mapper.hypothesis(node);
            let explained = exploration.prefix(mapper.explained());
            explain(options, &explained, mapper.experience(), of, &nodes, &report)?;
            Ok(preferred::status_of(&report))
        }
        Task::Weigh(order) => {
            let posterior = probable::search(&options.search, order, &exploration, Appearance::default())?;
            let nodes: Vec<NodeId> = posterior.maps().iter().map(|map| map.node).collect();
            let of = |node| posterior.hypothesis(node);
            explain(options, &exploration, posterior.experience(), of, &nodes, posterior.report())?;
            Ok(probable::status_of(&posterior))
        }
    }
}

/// Explains the map that was asked for, of those found. `exploration` is what they explain.
fn explain(
    options: &ExplainOptions,
    exploration: &Exploration,
    experience: &Experience,
    hypothesis: impl Fn(NodeId) -> Hypothesis,
    nodes: &[NodeId],
    report: &impl Serialize,
) -> Result<(), Failure> {
    if nodes.is_empty() {
        return if options.json { print_json(report) } else { print("No map explains the exploration.\n") };
    }
    let Some(&node) = nodes.get(options.rank as usize - 1) else {
        return Err(Failure::NoSuchRank { asked: options.rank, found: nodes.len() });
    };
    let map = hypothesis(node).map;
    let (sketch, measure, closed) =
        (MapSketch::of(&map, &experience.catalog), Measure::of(&map), map.is_closed());
    let replay = checked_replay(&sketch, experience, exploration, options)?;
    if options.json {
        return print_json(&Explanation { rank: options.rank, measure, closed, map: sketch, replay });
    }
    let mut text = format!("Map {} of the ranking: {measure}.\n", options.rank);
    let start = &exploration.star_types()[exploration.start().index()].name;
    text += &format!("      start at place 0, a {start}.\n");
    for (index, step) in replay.travels.iter().enumerate() {
        text += &format!("{:>4}. {}\n", index + 1, sentence(index, step, exploration, &sketch));
    }
    let missing = experience.observations.len() - exploration.travels().len();
    text += &ending(missing, &sketch, closed);
    print(&text)
}

/// Replays the exploration in the map by the independent checker, and has it look for violated axioms.
fn checked_replay(
    sketch: &MapSketch,
    experience: &Experience,
    exploration: &Exploration,
    options: &ExplainOptions,
) -> Result<Replay, Failure> {
    let stars: Vec<Star> = experience.catalog.stars().cloned().collect();
    let observations = &experience.observations[..exploration.travels().len()];
    let replay = hssh_topology::replay(sketch, &stars, experience.start, observations)
        .map_err(|error| Failure::Disagreement(error.to_string()))?;
    match violations(sketch, &options.search.axioms()) {
        Ok(violations) if violations.is_empty() => Ok(replay),
        Ok(violations) => Err(Failure::Disagreement(violations[0].to_string())),
        Err(error) => Err(Failure::Disagreement(error.to_string())),
    }
}

/// One travel in words.
fn sentence(index: usize, step: &ReplayedTravel, exploration: &Exploration, map: &MapSketch) -> String {
    let travel = &exploration.travels()[index];
    let name = &exploration.star_types()[travel.star.index()].name;
    let end = |place: hssh_topology::PlaceId, olp: Olp| map.places[place.index()].name(olp);
    let (exit, entry) = (end(step.from, step.exit), end(step.to, step.entry));
    let (from, to) = (step.from, step.to);
    let left = format!("leave place {from} by {exit}, see a {name}");
    let turned = match step.rotation {
        0 => String::new(),
        1 => ", seen turned by 1 end".to_owned(),
        ends => format!(", seen turned by {ends} ends"),
    };
    match step.discovery {
        Discovery::NewPlace => format!("{left}: a new place {to}, entered by {entry}."),
        Discovery::LoopClosure => {
            format!("{left}: back at place {to}, by its pending gateway {entry}{turned}.")
        }
        Discovery::KnownLink => format!("{left}, as predicted: place {to}, entered by {entry}{turned}."),
    }
}

fn ending(missing: usize, map: &MapSketch, closed: bool) -> String {
    let places = map.places.len();
    let links = map.links.len();
    let rest = if closed { "no gateway is pending" } else { "some gateways are pending" };
    let checked = "An independent replay agrees: every star matches, every place and link is needed, no axiom is violated.";
    let short = match missing {
        0 => String::new(),
        _ => format!(" A limit stopped the search {missing} travels before the end."),
    };
    format!("      {places} places, {links} links; {rest}.{short}\n{checked}\n")
}
