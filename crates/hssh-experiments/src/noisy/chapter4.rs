//! `experiment chapter-4`: the 4×4 snake of section 4.7 at several levels of noise, by several methods, many times.

use std::error::Error;

use hssh_causal::Exploration;
use hssh_metrics::UniformPrior;
use hssh_search::{
    Goal, Limits, MapPrior, Mapper, MapperBuilder, Metrical, Order, PlacePrior, PosteriorModel,
};
use hssh_topology::{Axioms, Simplicity};
use hssh_world::{PolarNoise, grid, snake};
use serde::Serialize;

use super::plot::{Chart, Curve, draw};
use super::trial::{Course, Trial, median, on_threads};
use crate::flags;
use crate::table::{aligned, grouped};

/// Seeds if none are asked for.
const SEEDS: usize = 50;
/// With `--all`.
const FEW_SEEDS: usize = 5;
/// Nodes after which a search is given up.
const MOST_NODES: u64 = 100_000;
/// The side of a block: m.
const SPACING: f64 = 8.0;
/// Standard deviations a travel: of the distance in metres; of bearing and rotation a tenth of it in radians.
const NOISES: [f64; 5] = [0.1, 0.3, 0.6, 1.0, 2.0];

/// A way to select a map.
struct Method {
    name: &'static str,
    model: fn(&Exploration) -> Option<PosteriorModel>,
    order: Order,
    planar: bool,
    goal: Goal,
    /// In how many of the first five seeds it finds the true map, by noise: as measured, to notice a change.
    expected: [usize; NOISES.len()],
}

const F: MapPrior = MapPrior::Simplicity(Simplicity { c1: 0.0, c2: 2.0, c3: 1.0 });

fn likelihood(prior: MapPrior) -> PosteriorModel {
    PosteriorModel { metrical: Metrical::Likelihood, prior }
}

fn evidence(exploration: &Exploration, prior: MapPrior) -> Option<PosteriorModel> {
    Some(PosteriorModel { prior, ..PosteriorModel::evidence(exploration)? })
}

/// New places anywhere in the square that the grid covers.
fn uniform(_: &Exploration) -> Option<PosteriorModel> {
    let area = UniformPrior::over_area((4.0 * SPACING).powi(2)).ok()?;
    let metrical = Metrical::Evidence(PlacePrior::Uniform(area));
    Some(PosteriorModel { metrical, prior: MapPrior::Flat })
}

/// The thesis's own (section 4.7.2).
const INTEGRATED: Method = Method {
    name: "integrated",
    model: |_| Some(PosteriorModel::THESIS),
    order: Order::BestFirst,
    planar: true,
    goal: Goal::ClosedMap,
    expected: [5, 5, 5, 5, 5],
};

/// The program's default, under planarity.
const EVIDENCE: Method = Method {
    name: "evidence, corridors",
    model: |exploration| evidence(exploration, MapPrior::Flat),
    order: Order::Cyclic,
    planar: true,
    goal: Goal::AnyMap,
    expected: [5, 5, 3, 0, 0],
};

const METHODS: [Method; 12] = [
    Method {
        name: "likelihood only",
        model: |_| Some(likelihood(MapPrior::Flat)),
        goal: Goal::AnyMap,
        expected: [0, 0, 0, 0, 0],
        ..INTEGRATED
    },
    Method {
        name: "likelihood only, closed maps",
        model: |_| Some(likelihood(MapPrior::Flat)),
        expected: [5, 5, 5, 5, 5],
        ..INTEGRATED
    },
    Method { name: "integrated, not planar", planar: false, expected: [5, 5, 5, 5, 5], ..INTEGRATED },
    Method { name: "integrated", expected: [5, 5, 5, 5, 5], ..INTEGRATED },
    Method {
        name: "integrated, with proof",
        model: |_| Some(PosteriorModel::THESIS),
        goal: Goal::ClosedMap,
        expected: [5, 5, 5, 5, 5],
        ..EVIDENCE
    },
    Method {
        name: "integrated, any map, proof",
        model: |_| Some(PosteriorModel::THESIS),
        expected: [0, 0, 0, 0, 0],
        ..EVIDENCE
    },
    Method { name: "evidence, corridors", expected: [5, 5, 3, 0, 0], ..EVIDENCE },
    Method {
        name: "evidence, corridors, closed maps",
        goal: Goal::ClosedMap,
        expected: [5, 5, 5, 5, 5],
        ..EVIDENCE
    },
    Method { name: "evidence, corridors, not planar", planar: false, expected: [5, 5, 3, 0, 0], ..EVIDENCE },
    Method { name: "evidence, uniform area", model: uniform, expected: [5, 5, 5, 5, 1], ..EVIDENCE },
    Method {
        name: "evidence, corridors, F",
        model: |exploration| evidence(exploration, F),
        expected: [5, 5, 4, 0, 0],
        ..EVIDENCE
    },
    Method {
        name: "evidence, corridors, choices",
        model: |exploration| evidence(exploration, MapPrior::Choices),
        expected: [5, 5, 3, 0, 0],
        ..EVIDENCE
    },
];

/// What one method made of one level of noise.
#[derive(Serialize)]
struct Row {
    method: &'static str,
    noise: f64,
    trials: Vec<Trial>,
}

impl Method {
    fn search(&self, exploration: &Exploration) -> Option<MapperBuilder> {
        let axioms = Axioms { max_genus: self.planar.then_some(0), ..Axioms::default() };
        let limits = Limits { nodes: Some(MOST_NODES), ..Limits::default() };
        let search = Mapper::builder().posterior((self.model)(exploration)?).axioms(axioms).limits(limits);
        Some(search.order(self.order).goal(self.goal))
    }
}

pub(super) fn run(flags: &flags::Experiment) -> Result<(), Box<dyn Error>> {
    let seeds = flags.seeds.unwrap_or(if flags.all { FEW_SEEDS } else { SEEDS });
    let world = grid(4, 4, SPACING)?;
    let route = world.route_through(&snake(4, 4))?;
    let course = Course { world, route };
    let topology = by_preference(&course)?;

    let tasks = METHODS.len() * NOISES.len() * seeds;
    let trials = on_threads(flags.threads.unwrap_or(0), tasks, |task| {
        let (row, seed) = (task / seeds, task % seeds);
        let (method, noise) = (&METHODS[row / NOISES.len()], polar(NOISES[row % NOISES.len()]));
        let exploration = course.explore(&noise, seed as u64)?;
        let search = method.search(&exploration).ok_or("the exploration has no odometry")?;
        course.try_out(search, &exploration)
    })?;
    let rows: Vec<Row> = trials
        .chunks(seeds)
        .enumerate()
        .map(|(row, trials)| Row {
            method: METHODS[row / NOISES.len()].name,
            noise: NOISES[row % NOISES.len()],
            trials: trials.to_vec(),
        })
        .collect();

    if flags.json {
        println!("{}", serde_json::to_string_pretty(&rows)?);
    } else {
        println!("== chapter-4: {}", text(&rows, seeds, &topology));
    }
    if let Some(file) = &flags.svg {
        draw(file, &chart(&rows))?;
    }
    if flags.check { check(&rows) } else { Ok(()) }
}

fn polar(noise: f64) -> PolarNoise {
    PolarNoise { distance: noise, distance_share: 0.0, bearing: noise / 10.0, rotation: noise / 10.0 }
}

/// The map selected by topology alone: best-first by preference, back until closed.
fn by_preference(course: &Course) -> Result<String, Box<dyn Error>> {
    let axioms = Axioms { max_genus: Some(0), ..Axioms::default() };
    let mapper = Mapper::builder().axioms(axioms).order(Order::BestFirst).goal(Goal::ClosedMap);
    let (report, maps) = mapper.explain(&course.world.explore(&course.route)?)?.answer(1);
    let measure = maps.first().map_or("no map".to_owned(), |map| map.measure.to_string());
    Ok(format!(
        "Topology only (best-first by preference, back until closed): {measure}, not the true map's 16 places; {} expanded.",
        report.expanded
    ))
}

fn text(rows: &[Row], seeds: usize, topology: &str) -> String {
    let header = ["method", "noise", "true map", "proved", "given up", "expanded", "most", "ms", "linear"];
    let mut table = vec![header.map(str::to_owned).to_vec()];
    for Row { method, noise, trials } in rows {
        let count = |is: fn(&Trial) -> bool| trials.iter().filter(|trial| is(trial)).count();
        let expanded = median(trials.iter().map(|trial| trial.expanded as f64));
        let most = trials.iter().map(|trial| trial.expanded).max().unwrap_or(0);
        let factor = trials.iter().map(|trial| trial.linear_factor).fold(1.0, f64::min);
        table.push(vec![
            (*method).to_owned(),
            format!("{noise:.2}"),
            format!("{}/{seeds}", count(|trial| trial.right)),
            count(|trial| trial.proved).to_string(),
            count(|trial| trial.stopped).to_string(),
            grouped(expanded as u64),
            grouped(most),
            format!("{:.1}", 1e3 * median(trials.iter().map(|trial| trial.seconds))),
            format!("{factor:.2}"),
        ]);
    }
    format!(
        "4×4 snake, 30 travels of {SPACING} m, {seeds} seeds; noise: m of distance, a tenth of it in rad of bearing and of \
         rotation, a travel\n{}\nexpanded: median and most; ms: median; linear: the least share of a promised rise of χ²\n\
         {topology}\nPublished (section 4.7.2): integrated 2,934 expanded and right; not planar 2,098 and wrong.\n",
        aligned(&table)
    )
}

fn chart(rows: &[Row]) -> Chart {
    let success = |row: &Row| {
        let right = row.trials.iter().filter(|trial| trial.right).count();
        (row.noise, right as f64 / row.trials.len() as f64)
    };
    let curves = METHODS.iter().map(|method| Curve {
        name: method.name.to_owned(),
        points: rows.iter().filter(|row| row.method == method.name).map(success).collect(),
    });
    Chart {
        title: "4×4 snake: how often the true map is selected".to_owned(),
        x: "noise a travel: m, and a tenth of it in rad".to_owned(),
        y: "share of explorations".to_owned(),
        logarithmic: [false, false],
        curves: curves.collect(),
    }
}

/// The first five seeds give the same answers everywhere.
fn check(rows: &[Row]) -> Result<(), Box<dyn Error>> {
    for row in rows {
        let method = METHODS.iter().find(|method| method.name == row.method).ok_or("a method")?;
        let noise = NOISES.iter().position(|&noise| noise == row.noise).ok_or("a noise")?;
        let right = row.trials.iter().take(FEW_SEEDS).filter(|trial| trial.right).count();
        let expected = method.expected[noise];
        if row.trials.len() >= FEW_SEEDS && right != expected {
            let Row { method, noise, .. } = row;
            return Err(format!(
                "{method}, noise {noise}: the true map in {right} of the first five seeds, expected {expected}"
            )
            .into());
        }
    }
    Ok(())
}
