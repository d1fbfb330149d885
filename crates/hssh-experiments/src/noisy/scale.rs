//! `experiment scale`: how far the search by posterior reaches as worlds grow, and what limits it.

use std::error::Error;
use std::time::Duration;

use hssh_search::{Limits, Mapper, Order, PosteriorModel};
use hssh_topology::Axioms;
use hssh_world::{PolarNoise, cover, grid, random_planar, snake};
use serde::Serialize;

use super::plot::{Chart, Curve, draw};
use super::trial::{Course, Trial, median, on_threads};
use crate::flags;
use crate::table::{aligned, grouped};

/// Seeds if none are asked for.
const SEEDS: usize = 5;
/// The side of a block, and the mean distance in a random world: m.
const SPACING: f64 = 8.0;
/// Standard deviations a travel: 0.1 m, 0.01 rad.
pub(super) const NOISE: PolarNoise =
    PolarNoise { distance: 0.1, distance_share: 0.0, bearing: 0.01, rotation: 0.01 };

/// What one size came to.
#[derive(Serialize)]
struct Row {
    world: &'static str,
    places: usize,
    travels: usize,
    trials: Vec<Trial>,
}

pub(super) fn run(flags: &flags::Experiment) -> Result<(), Box<dyn Error>> {
    let seeds = flags.seeds.unwrap_or(if flags.all { 1 } else { SEEDS });
    let seconds = flags.seconds.unwrap_or(if flags.all { 2 } else { 60 });
    let sizes = sizes(flags.all, flags.slow);

    let mut rows = Vec::new();
    for (kind, size) in sizes {
        let courses =
            (0..seeds as u64).map(|seed| course(kind, size, seed)).collect::<Result<Vec<_>, _>>()?;
        let trials = on_threads(flags.threads.unwrap_or(1), seeds, |seed| {
            let exploration = courses[seed].explore(&NOISE, seed as u64)?;
            let model = PosteriorModel::evidence(&exploration).ok_or("no odometry")?;
            let search = Mapper::builder()
                .posterior(model)
                .order(Order::Cyclic)
                .axioms(Axioms { max_genus: Some(0), ..Axioms::default() })
                .limits(Limits { time: Some(Duration::from_secs(seconds)), ..Limits::default() });
            courses[seed].try_out(search, &exploration)
        })?;
        let places = courses[0].world.places().len();
        let travels = courses[0].world.visits(&courses[0].route)?.len() - 1;
        rows.push(Row { world: kind, places, travels, trials });
        if !flags.json && !flags.all {
            eprintln!("{kind} of {places} places done");
        }
    }
    if flags.json {
        println!("{}", serde_json::to_string_pretty(&rows)?);
    } else {
        println!("== scale: {}", text(&rows, seeds, seconds));
    }
    if let Some(file) = &flags.svg {
        draw(file, &chart(&rows))?;
    }
    let small = rows.iter().filter(|row| row.world == "snake" && row.places <= 25);
    let wrong = small.flat_map(|row| &row.trials).filter(|trial| !(trial.right && trial.proved)).count();
    if flags.check && wrong > 0 {
        return Err(format!("{wrong} searches in 4×4 and 5×5 did not prove the true map").into());
    }
    Ok(())
}

/// The kinds of worlds, and how large they are: the smallest, those that are tried if nobody says otherwise, or the largest.
fn sizes(is_small: bool, is_large: bool) -> Vec<(&'static str, u32)> {
    if is_large && !is_small {
        return vec![("snake", 20), ("snake", 30), ("random", 500), ("random", 1000)];
    }
    let largest = if is_small { 6 } else { 12 };
    let snakes = (4..=largest).map(|size| ("snake", size));
    let random = [25, 50, 100, 150, 200].into_iter().filter(|&places| places <= largest * largest * 2);
    snakes.chain(random.map(|places| ("random", places))).collect()
}

/// A world of that kind and size, and the way through it.
pub(super) fn course(kind: &str, size: u32, seed: u64) -> Result<Course, Box<dyn Error>> {
    if kind == "snake" {
        let world = grid(size, size, SPACING)?;
        let route = world.route_through(&snake(size, size))?;
        return Ok(Course { world, route });
    }
    let world = random_planar(size, 0.5, SPACING, seed)?;
    let route = cover(&world, seed)?;
    Ok(Course { world, route })
}

fn text(rows: &[Row], seeds: usize, seconds: u64) -> String {
    let header = [
        "world",
        "places",
        "travels",
        "true map",
        "proved",
        "expanded",
        "solved",
        "s",
        "MB",
        "gap, nats",
        "linear",
    ];
    let mut table = vec![header.map(str::to_owned).to_vec()];
    for Row { world, places, travels, trials } in rows {
        let count = |is: fn(&Trial) -> bool| trials.iter().filter(|trial| is(trial)).count();
        let of = |number: fn(&Trial) -> f64| median(trials.iter().map(number));
        let factor = trials.iter().map(|trial| trial.linear_factor).fold(1.0, f64::min);
        table.push(vec![
            (*world).to_owned(),
            places.to_string(),
            travels.to_string(),
            format!("{}/{seeds}", count(|trial| trial.right)),
            count(|trial| trial.proved).to_string(),
            grouped(of(|trial| trial.expanded as f64) as u64),
            grouped(of(|trial| trial.solved as f64) as u64),
            format!("{:.2}", of(|trial| trial.seconds)),
            format!("{:.1}", of(|trial| trial.bytes as f64) / 1e6),
            format!("{:.1}", of(|trial| trial.gap)),
            format!("{factor:.2}"),
        ]);
    }
    format!(
        "evidence with proof, planar; 0.1 m and 0.01 rad a travel of {SPACING} m; {seeds} seeds, at most {seconds} s each, \
         medians\n{}",
        aligned(&table)
    )
}

fn chart(rows: &[Row]) -> Chart {
    let of_world = |world: &'static str| move |row: &&Row| row.world == world;
    let point = |row: &Row| (row.places as f64, median(row.trials.iter().map(|trial| trial.expanded as f64)));
    let curve = |name: &str, world: &'static str| Curve {
        name: name.to_owned(),
        points: rows.iter().filter(of_world(world)).map(point).collect(),
    };
    Chart {
        title: "What the search by posterior expands".to_owned(),
        x: "places of the world".to_owned(),
        y: "hypotheses expanded, median".to_owned(),
        logarithmic: [true, true],
        curves: vec![curve("N×N snakes", "snake"), curve("random planar networks", "random")],
    }
}
