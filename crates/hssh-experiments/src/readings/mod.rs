//! Injected errors of perception: how often the true map is found, with readings and without.

mod trial;

use std::error::Error;
use std::path::Path;

use hssh_world::{cover, grid, momepy, random_planar, snake};
use rayon::prelude::*;

use crate::aces::topology;
use crate::flags;
use crate::noisy::{Chart, Curve, draw};
use crate::table::aligned;
use trial::{Ground, Means, Outcome};

/// At what rates perception errs.
const RATES: [f64; 6] = [0.0, 0.05, 0.1, 0.2, 0.3, 0.4];

/// `cargo xtask readings`.
pub(crate) fn run(flags: &flags::Readings) -> Result<(), Box<dyn Error>> {
    let means = Means { seconds: flags.seconds.unwrap_or(20.0), patience: flags.patience.unwrap_or(1_000) };
    let seeds = flags.seeds.unwrap_or(10);
    let grounds: Vec<Ground> = grounds(flags.data.as_deref())?
        .into_iter()
        .filter(|ground| flags.name.as_ref().is_none_or(|name| ground.name.starts_with(name)))
        .collect();
    if let Some(file) = &flags.out {
        let ground = grounds.first().ok_or("no world has that name")?;
        let told = ground.told(flags.rate.unwrap_or(0.1), 0)?;
        std::fs::write(file, told.exploration.to_ron())?;
        println!(
            "wrote {}: {:?} errors (ends missed, ghosts, places passed, false visits, turns)",
            file.display(),
            told.errors
        );
        return Ok(());
    }
    let mut rows = vec![header()];
    let (mut with, mut without) = (Vec::new(), Vec::new());
    for rate in RATES.into_iter().filter(|rate| flags.rate.is_none_or(|only| only == *rate)) {
        let mut all = Vec::new();
        for ground in &grounds {
            let outcomes: Vec<Outcome> = (0..seeds as u64)
                .into_par_iter()
                .map(|seed| ground.try_with(rate, seed, means).map_err(|error| error.to_string()))
                .collect::<Result<_, _>>()?;
            rows.push(row(&ground.name, rate, &outcomes));
            eprintln!("{}", rows[rows.len() - 1].join("  "));
            all.extend(outcomes);
        }
        with.push((rate, share(&all, |outcome| outcome.right)));
        without.push((rate, share(&all, |outcome| outcome.exact_right)));
    }
    println!("{}", aligned(&rows));
    if let Some(file) = &flags.svg {
        let curve = |name: &str, points| Curve { name: name.to_owned(), points };
        let chart = Chart {
            title: "Explorations with errors of perception".to_owned(),
            x: "rate of each kind of error".to_owned(),
            y: "share of true maps found".to_owned(),
            logarithmic: [false; 2],
            curves: vec![curve("with readings", with), curve("every star certain", without)],
        };
        draw(file, &chart)?;
    }
    Ok(())
}

/// Made worlds, and with the folder of data the hand-made map of a building and the streets of a quarter, every link taken.
fn grounds(data: Option<&Path>) -> Result<Vec<Ground>, Box<dyn Error>> {
    let mut grounds = Vec::new();
    for side in 3..=6 {
        let world = grid(side, side, 8.0)?;
        let route = world.route_through(&snake(side, side))?;
        grounds.push(Ground { name: format!("grid {side}x{side}"), world, route });
    }
    for places in [15, 30, 60] {
        let world = random_planar(places, 0.35, 10.0, u64::from(places))?;
        let route = cover(&world, 1)?;
        grounds.push(Ground { name: format!("planar {places}"), world, route });
    }
    if let Some(data) = data {
        let aces = topology::read(&read(&data.join("logs/aces-topology.txt"))?)?.network;
        let streets = momepy::read(&read(&data.join("streets/bubenec_streets.txt"))?)?;
        for (name, network) in [("ACES", aces), ("streets", streets)] {
            let world = network.to_world()?;
            let route = cover(&world, 1)?;
            grounds.push(Ground { name: name.to_owned(), world, route });
        }
    } else {
        eprintln!("no folder of data: ACES and streets are left out");
    }
    Ok(grounds)
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn header() -> Vec<String> {
    let columns = [
        "world",
        "rate",
        "errors",
        "true",
        "as probable",
        "proved",
        "found after",
        "expanded",
        "seconds",
        "exact: true",
        "exact: found after",
    ];
    columns.map(str::to_owned).to_vec()
}

fn row(name: &str, rate: f64, outcomes: &[Outcome]) -> Vec<String> {
    let mean = |of: &dyn Fn(&Outcome) -> f64| outcomes.iter().map(of).sum::<f64>() / outcomes.len() as f64;
    let percent = |of: &dyn Fn(&Outcome) -> bool| format!("{:.0} %", 100.0 * share(outcomes, of));
    vec![
        name.to_owned(),
        format!("{rate:.2}"),
        format!("{:.1}", mean(&|outcome| outcome.errors as f64)),
        percent(&|outcome| outcome.right),
        percent(&|outcome| outcome.probable),
        percent(&|outcome| outcome.proved),
        format!("{:.0}", mean(&|outcome| outcome.found_after as f64)),
        format!("{:.0}", mean(&|outcome| outcome.expanded as f64)),
        format!("{:.2}", mean(&|outcome| outcome.seconds)),
        percent(&|outcome| outcome.exact_right),
        format!("{:.0}", mean(&|outcome| outcome.exact_found_after as f64)),
    ]
}

fn share(outcomes: &[Outcome], of: impl Fn(&Outcome) -> bool) -> f64 {
    outcomes.iter().filter(|outcome| of(outcome)).count() as f64 / outcomes.len().max(1) as f64
}
