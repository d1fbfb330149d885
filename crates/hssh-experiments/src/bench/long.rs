//! Long explorations: time and memory of the search's set-up, and of the whole search, by number of travels.

use std::error::Error;
use std::process::Command;
use std::time::{Duration, Instant};

use hssh_causal::Exploration;
use hssh_search::{Limits, Mapper, Order, PosteriorModel};
use hssh_topology::Axioms;
use hssh_world::{PlaceId, PolarNoise, grid};
use serde::{Deserialize, Serialize};

use crate::bench::usage::Usage;
use crate::flags;
use crate::table::{aligned, grouped};

/// Numbers of travels.
const TRAVELS: [u32; 3] = [1_000, 3_000, 10_000];
/// Between places: m.
const SPACING: f64 = 8.0;
/// Standard deviations a travel: 0.05 m, 0.005 rad.
const NOISE: PolarNoise = PolarNoise { distance: 0.05, distance_share: 0.0, bearing: 0.005, rotation: 0.005 };
/// The places of the ring that is gone round again and again.
const RING: u32 = 40;

/// A way, each with crossings of three arms whose third one nobody takes.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Way {
    /// Straight on.
    Corridor,
    /// Round a ring that the last travel closes.
    Ring,
    /// Laps of a ring of [`RING`] places.
    Laps,
}

const WAYS: [(&str, Way); 3] =
    [("corridor", Way::Corridor), ("ring", Way::Ring), ("laps of 40 places", Way::Laps)];

/// How far a search goes.
const PARTS: [&str; 2] = ["set-up", "whole"];

/// What one process reports of itself.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Measurement {
    seconds: f64,
    expanded: u64,
    peak_bytes: u64,
    stop: String,
    proved: bool,
}

impl Way {
    fn explore(self, travels: u32) -> Result<Exploration, Box<dyn Error>> {
        // A ring is two roads, one there and one back.
        let columns = match self {
            Way::Corridor => travels + 1,
            Way::Ring => travels / 2,
            Way::Laps => RING / 2,
        };
        let world = grid(2, columns, SPACING)?;
        let around: Vec<u32> = (0..columns).chain((columns..2 * columns).rev()).collect();
        let places = around.iter().cycle().take(travels as usize + 1).map(|&place| PlaceId(place));
        let route = world.route_through(&places.collect::<Vec<_>>())?;
        Ok(world.explore_with_odometry(&route, &NOISE, 1)?)
    }
}

/// One search by `cargo xtask measure`: its name is `long`, the number of its way, its travels, its part and its seconds, with slashes.
pub(crate) fn measure(flags: &flags::Measure) -> Result<(), Box<dyn Error>> {
    let words: Vec<&str> = flags.name.split('/').collect();
    let [_, way, travels, part, seconds] = words[..] else {
        return Err(format!("`{}` is no long search: write long/WAY/TRAVELS/PART/SECONDS", flags.name).into());
    };
    let (_, way) = WAYS.get(way.parse::<usize>()?).ok_or("there are three ways: 0, 1 and 2")?;
    let exploration = way.explore(travels.parse()?)?;
    let limits = match part {
        "set-up" => Limits { nodes: Some(0), ..Limits::default() },
        _ => Limits { time: Some(Duration::from_secs(seconds.parse()?)), ..Limits::default() },
    };
    let model = PosteriorModel::evidence(&exploration).ok_or("no distance was measured")?;
    let started = Instant::now();
    let mapper = Mapper::builder()
        .posterior(model)
        .order(Order::Cyclic)
        .axioms(Axioms { max_genus: Some(0), ..Axioms::default() })
        .threads(flags.threads)
        .limits(limits)
        .explain(&exploration)?;
    let (report, _) = mapper.answer(1);
    let measurement = Measurement {
        seconds: started.elapsed().as_secs_f64(),
        expanded: report.expanded,
        peak_bytes: Usage::now()?.peak_bytes,
        stop: report.stop.to_string(),
        proved: report.is_optimal,
    };
    println!("{}", serde_json::to_string(&measurement)?);
    Ok(())
}

/// `cargo xtask bench long`: every search in a process of its own.
pub(crate) fn run(limit: Duration) -> Result<(), Box<dyn Error>> {
    println!(
        "The most probable map of long explorations, planar, up to its proof, on one thread; 0.05 m and 0.005 rad a travel of {SPACING} m; \
         at most {} s. The peak is that of the whole process.\n",
        limit.as_secs()
    );
    let heads = [
        "", "travels", "set-up s", "slope", "MB", "slope", "whole s", "slope", "MB", "slope", "expanded", "",
    ];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for (number, (name, _)) in WAYS.iter().enumerate() {
        let mut before: Option<(u32, [Measurement; 2])> = None;
        for travels in TRAVELS {
            let [setup, whole] = PARTS.map(|part| process(number, travels, part, limit));
            let now = [setup?, whole?];
            let mut cells = vec![(*name).to_owned(), grouped(u64::from(travels))];
            for (part, measured) in now.iter().enumerate() {
                let slope = |of: fn(&Measurement) -> f64| {
                    let before = before.as_ref();
                    let (fewer, less) = before.map(|(fewer, before)| (*fewer, of(&before[part])))?;
                    let ratio = f64::from(travels) / f64::from(fewer);
                    Some(format!("{:.2}", (of(measured) / less).ln() / ratio.ln()))
                };
                let cell = |slope: Option<String>| slope.unwrap_or_else(|| "–".to_owned());
                cells.push(format!("{:.3}", measured.seconds));
                cells.push(cell(slope(|measured| measured.seconds.max(1e-6))));
                cells.push(format!("{:.1}", measured.peak_bytes as f64 / 1e6));
                cells.push(cell(slope(|measured| measured.peak_bytes as f64)));
            }
            cells.push(grouped(now[1].expanded));
            cells.push(now[1].stop.clone());
            rows.push(cells);
            before = Some((travels, now));
        }
    }
    println!("{}", aligned(&rows));
    Ok(())
}

fn process(way: usize, travels: u32, part: &str, limit: Duration) -> Result<Measurement, Box<dyn Error>> {
    let name = format!("long/{way}/{travels}/{part}/{}", limit.as_secs());
    let output = Command::new(std::env::current_exe()?).args(["measure", &name, "1"]).output()?;
    if !output.status.success() {
        return Err(format!("{name}: {}", String::from_utf8_lossy(&output.stderr)).into());
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}
