//! How long the mapper takes for one travel more: observe, search on, answer.

use std::error::Error;
use std::fs::File;
use std::path::Path;
use std::time::Instant;

use hssh_causal::Exploration;
use hssh_local::{LaserLog, SurveyOptions, survey};
use hssh_search::{Mapper, MapperBuilder, Order, PosteriorModel, Proving, Visit};
use hssh_topology::Axioms;
use hssh_world::{PolarNoise, grid, snake};

use crate::table::aligned;

/// Expansions for which the best map has to stay the best.
const PATIENCE: [u64; 3] = [1, 30, 300];

/// Standard deviations a travel, as in `experiment scale`.
const NOISE: PolarNoise = PolarNoise { distance: 0.1, distance_share: 0.0, bearing: 0.01, rotation: 0.01 };

/// The logs of the data folder, of which the one with the most travels that has maps counts.
const LOGS: [&str; 6] = ["aces", "intel", "freiburg-079", "belgioioso", "freiburg-101", "fhw"];

/// The snake through 12×12 places, and the longest log.
pub(super) fn run(data: Option<&Path>) -> Result<(), Box<dyn Error>> {
    println!(
        "Milliseconds for one travel more, one thread, planar; patience: expansions for which the best map stays the best.\n"
    );
    let heads = ["", "travels", "patience", "p50", "p99", "largest", "same as at the end"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    let world = grid(12, 12, 8.0)?;
    let route = world.route_through(&snake(12, 12))?;
    let exploration = world.explore_with_odometry(&route, &NOISE, 1)?;
    for patience in PATIENCE {
        rows.push(row("12×12", &exploration, Some(patience))?);
    }
    match data {
        Some(data) => {
            for (name, exploration) in longest(data)? {
                rows.push(row(&name, &exploration, Some(30))?);
                rows.push(row(&name, &exploration, None)?);
            }
        }
        None => println!("no data folder: the log is skipped; give one, or set HSSH_DATA\n"),
    }
    println!("{}", aligned(&rows));
    Ok(())
}

/// ACES, and the log with the most travels.
fn longest(data: &Path) -> Result<Vec<(String, Exploration)>, Box<dyn Error>> {
    let mut all = Vec::new();
    for name in LOGS {
        let Ok(file) = File::open(data.join(format!("logs/{name}.log.gz"))) else { continue };
        let log = LaserLog::read(file)?;
        let Ok((_, found)) = survey(log, &SurveyOptions::default(), |_, _| ()) else { continue };
        all.push((name.to_owned(), found.exploration()?));
    }
    all.sort_by_key(|(name, exploration)| (name != "aces", std::cmp::Reverse(exploration.travels().len())));
    all.truncate(2);
    Ok(all)
}

fn row(name: &str, exploration: &Exploration, patience: Option<u64>) -> Result<Vec<String>, Box<dyn Error>> {
    let search = || -> MapperBuilder {
        let axioms = Axioms { max_genus: Some(0), ..Axioms::default() };
        let proving = Proving { patience, ..Proving::default() };
        Mapper::builder()
            .posterior(PosteriorModel::ONLINE)
            .order(Order::Cyclic)
            .axioms(axioms)
            .proving(proving)
    };
    let start = &exploration.star_types()[exploration.start().index()];
    let mut mapper = search().start_with(&start.star, &start.bearings)?;
    let mut times = Vec::new();
    let mut explained = 0;
    for travel in 0..exploration.travels().len() {
        let visit = Visit::of(exploration, travel);
        let started = Instant::now();
        mapper.observe(visit)?;
        mapper.advance();
        let maps = mapper.maps(1);
        times.push(started.elapsed().as_secs_f64() * 1e3);
        if maps.is_empty() {
            break; // what nothing explains now nothing will
        }
        explained = travel + 1;
    }
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times[((times.len() - 1) as f64 * share).round() as usize];
    let cost = |mapper: &Mapper| mapper.maps(1).first().and_then(|map| map.nats());
    let whole = search().explain(&exploration.prefix(explained))?;
    let same = match (cost(&mapper), cost(&whole)) {
        (Some(one), Some(other)) => {
            if (one - other).abs() < 1e-6 * (1.0 + other) {
                "yes"
            } else {
                "no"
            }
        }
        _ => "no map",
    };
    Ok(vec![
        name.to_owned(),
        format!("{explained} of {}", exploration.travels().len()),
        patience.map_or("proved".to_owned(), |patience| patience.to_string()),
        format!("{:.2}", at(0.5)),
        format!("{:.2}", at(0.99)),
        format!("{:.2}", at(1.0)),
        same.to_owned(),
    ])
}
