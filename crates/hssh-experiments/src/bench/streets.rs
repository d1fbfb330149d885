//! Walks through streets by topology alone: time and memory by number of travels, of the true map and of the search for a first one.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use hssh_causal::Exploration;
use hssh_search::{Experience, Limits, Mapper, Order, Proving};
use hssh_topology::{Axioms, Derivation, Hypothesis, Rules, Step};
use hssh_world::{PlaceId, Route, World, WorldOlp, cover, graphml, random_planar};
use serde::{Deserialize, Serialize};

use crate::bench::usage::Usage;
use crate::flags;
use crate::noisy::{Chart, Curve, draw};
use crate::table::{aligned, grouped};

/// Between crossings of the made network: m. Topology does not see it.
const SPACING: f64 = 100.0;
/// Crossings of the made network, and how many of the triangulation's other edges it has beside a spanning tree.
const CROSSINGS: u32 = 5_000;
const DENSITY: f64 = 0.5;

/// What is done with a walk.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Work {
    /// The recursive step for the true map alone, travel by travel: all derivations, of which the true one is followed.
    Follow,
    /// The same with boundary relations carried along.
    Bound,
    /// A search by preference until the first map, planar.
    Search,
}

/// What is measured: a name, the network, the work, and the numbers of travels.
const WALKS: [(&str, Network, Work, &[usize]); 5] = [
    ("New York, true map", Network::NewYork, Work::Follow, &[25, 50, 94]),
    ("New York, first map found", Network::NewYork, Work::Search, &[25, 50, 94]),
    ("made, true map", Network::Made, Work::Follow, &[300, 1_000, 3_000, 10_000]),
    ("made, true map with boundaries", Network::Made, Work::Bound, &[300, 1_000, 3_000, 10_000]),
    ("made, first map found", Network::Made, Work::Search, &[100, 300, 1_000]),
];

/// A network of streets.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Network {
    NewYork,
    /// Of [`CROSSINGS`] at random.
    Made,
}

/// What one process reports of itself.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Measurement {
    travels: usize,
    user_seconds: f64,
    peak_bytes: u64,
    expanded: u64,
    places: Option<u32>,
}

/// The crossings of New York that the data has; nothing if there is no data.
pub(super) fn new_york(data: Option<&Path>) -> Result<Option<World>, Box<dyn Error>> {
    let file = data.map(|data| data.join("streets/nyc_graph.graphml")).filter(|file| file.is_file());
    let Some(file) = file else { return Ok(None) };
    let network = graphml::read(&fs::read_to_string(&file)?);
    Ok(Some(network.map_err(|error| format!("{}: {error}", file.display()))?.to_world()?))
}

/// One walk by `cargo xtask measure`: its name is `streets`, the number of its row, its travels and its seconds, with slashes.
pub(crate) fn measure(flags: &flags::Measure, data: Option<&Path>) -> Result<(), Box<dyn Error>> {
    let words: Vec<&str> = flags.name.split('/').collect();
    let [_, walk, travels, seconds] = words[..] else {
        return Err(format!("`{}` is no walk: write streets/ROW/TRAVELS/SECONDS", flags.name).into());
    };
    let (_, network, work, _) = WALKS.get(walk.parse::<usize>()?).ok_or("there are five rows: 0 to 4")?;
    let world = match network {
        Network::NewYork => new_york(data)?.ok_or("set HSSH_DATA to the folder with streets/")?,
        Network::Made => random_planar(CROSSINGS, DENSITY, SPACING, 1)?,
    };
    let mut route = cover(&world, 1)?;
    route.exits.truncate(travels.parse()?);
    let exploration = world.explore(&route)?;
    let before = Usage::now()?.user_seconds;
    let axioms = Axioms { max_genus: Some(0), ..Axioms::default() };
    let (expanded, places) = match work {
        Work::Search => search(&exploration, axioms, Duration::from_secs(seconds.parse()?))?,
        _ => follow(&world, &route, &exploration, &axioms, *work == Work::Bound)?,
    };
    let Usage { user_seconds, peak_bytes } = Usage::now()?;
    let user_seconds = user_seconds - before;
    let travels = route.exits.len();
    println!(
        "{}",
        serde_json::to_string(&Measurement { travels, user_seconds, peak_bytes, expanded, places })?
    );
    Ok(())
}

/// Searches until there is a map; how many hypotheses were expanded, and how many places it has.
fn search(
    exploration: &Exploration,
    axioms: Axioms,
    limit: Duration,
) -> Result<(u64, Option<u32>), Box<dyn Error>> {
    let mapper = Mapper::builder()
        .order(Order::Cyclic)
        .proving(Proving { patience: Some(0), ..Proving::default() })
        .axioms(axioms)
        .limits(Limits { time: Some(limit), ..Limits::default() })
        .explain(exploration)?;
    let (report, maps) = mapper.answer(1);
    let whole = maps.first().filter(|_| report.explained == report.travels);
    Ok((report.expanded, whole.map(|map| map.measure.places)))
}

/// Follows the true map; how many steps there were, and how many places it has.
fn follow(
    world: &World,
    route: &Route,
    exploration: &Exploration,
    axioms: &Axioms,
    boundaries: bool,
) -> Result<(u64, Option<u32>), Box<dyn Error>> {
    let experience = Experience::from(exploration);
    let rules = Rules { catalog: &experience.catalog, axioms };
    let root = if boundaries { Hypothesis::root } else { Hypothesis::root_without_boundaries };
    let mut hypothesis = root(&experience.catalog, experience.start);
    let mut numbers: Vec<Option<hssh_topology::PlaceId>> = vec![None; world.places().len()];
    numbers[route.start.index()] = Some(hypothesis.position.place);
    let (mut here, mut step): (PlaceId, Step) = (route.start, Step::default());
    for (&exit, &observation) in route.exits.iter().zip(&experience.observations) {
        let entry = world.neighbor(WorldOlp { place: here, olp: exit }).ok_or("a route leads along links")?;
        here = entry.place;
        hypothesis.step(observation, rules, &mut step);
        let is_known = hypothesis.map.linked(hypothesis.exit(observation)).is_some();
        let truth = match numbers[here.index()] {
            _ if is_known => Derivation::Predicted,
            Some(place) => Derivation::Closure(hypothesis.map.olp(place, entry.olp)),
            None => Derivation::NewPlace,
        };
        if !step.derivations.contains(&truth) {
            return Err("the true map follows from no step: the world is not planar".into());
        }
        let _ = hypothesis.follow(observation, truth, &experience.catalog);
        numbers[here.index()] = Some(hypothesis.position.place);
    }
    Ok((route.exits.len() as u64, Some(hypothesis.map.place_count())))
}

/// `cargo xtask bench streets`: every walk in a process of its own.
pub(crate) fn run(data: Option<&Path>, limit: Duration, svg: Option<&Path>) -> Result<(), Box<dyn Error>> {
    println!(
        "Walks that take every street, by topology alone, planar, on one thread: New York, 46 crossings, and a made network of {} crossings. Processor \
         time, and the peak of the whole process, of which 10 MB are there before; at most {} s a search.\n",
        grouped(u64::from(CROSSINGS)),
        limit.as_secs()
    );
    let heads = ["", "travels", "places", "expanded", "s", "slope", "MB"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    let mut curves = Vec::new();
    for (number, &(name, network, _, travels)) in WALKS.iter().enumerate() {
        if network == Network::NewYork && new_york(data)?.is_none() {
            println!("{name}: skipped: set HSSH_DATA to the folder with streets/");
            continue;
        }
        let mut points: Vec<(f64, f64)> = Vec::new();
        let mut memory = Vec::new();
        for &travels in travels {
            let measured = process(number, travels, limit)?;
            let now = (measured.travels as f64, measured.user_seconds.max(0.01));
            let slope = points.last().map(|&(x, y)| (now.1 / y).ln() / (now.0 / x).ln());
            points.push(now);
            memory.push((now.0, measured.peak_bytes as f64 / 1e6));
            rows.push(vec![
                name.to_owned(),
                grouped(measured.travels as u64),
                measured.places.map_or_else(|| "none found".to_owned(), |places| grouped(u64::from(places))),
                grouped(measured.expanded),
                format!("{:.2}", measured.user_seconds),
                slope.map_or_else(|| "–".to_owned(), |slope| format!("{slope:.2}")),
                format!("{:.1}", measured.peak_bytes as f64 / 1e6),
            ]);
        }
        curves.push(Curve { name: format!("{name}: s"), points });
        if network == Network::Made {
            curves.push(Curve { name: format!("{name}: MB"), points: memory });
        }
    }
    println!("{}", aligned(&rows));
    let chart = || Chart {
        title: "Walks through streets by topology alone".to_owned(),
        x: "travels".to_owned(),
        y: "processor seconds; MB of the process".to_owned(),
        logarithmic: [true, true],
        curves,
    };
    svg.map_or(Ok(()), |file| draw(file, &chart()))
}

fn process(walk: usize, travels: usize, limit: Duration) -> Result<Measurement, Box<dyn Error>> {
    let name = format!("streets/{walk}/{travels}/{}", limit.as_secs());
    let output = Command::new(std::env::current_exe()?).args(["measure", &name, "1"]).output()?;
    if !output.status.success() {
        return Err(format!("{name}: {}", String::from_utf8_lossy(&output.stderr)).into());
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}
