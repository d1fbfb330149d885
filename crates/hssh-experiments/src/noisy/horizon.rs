//! `experiment horizon`: along the best map of each world, what is still to be paid from each travel on, and what the bound knows of that.

use std::error::Error;
use std::time::Duration;

use hssh_search::{Horizon, Limits, Mapper, Order, PosteriorModel, Score};
use hssh_topology::Axioms;

use super::scale::{NOISE, course};
use super::trial::median;
use crate::flags;
use crate::table::aligned;

/// Worlds: the kind, and the side or the number of places.
const WORLDS: [(&str, u32); 8] = [
    ("snake", 6),
    ("snake", 7),
    ("snake", 8),
    ("snake", 10),
    ("snake", 12),
    ("random", 25),
    ("random", 50),
    ("random", 100),
];

/// Where to look: parts of the travels.
const PARTS: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

pub(super) fn run(flags: &flags::Experiment) -> Result<(), Box<dyn Error>> {
    let seconds = flags.seconds.unwrap_or(if flags.all { 2 } else { 60 });
    let worlds = if flags.all { &WORLDS[..1] } else { &WORLDS[..] };
    let heads = [
        "world",
        "travels",
        "explained",
        "to pay",
        "places",
        "vagueness",
        "bend",
        "bound",
        "gap",
        "places known",
        "vagueness, too",
        "next best",
    ];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for &(kind, size) in worlds {
        let course = course(kind, size, 0)?;
        let exploration = course.explore(&NOISE, 0)?;
        let model = PosteriorModel::evidence(&exploration).ok_or("no odometry")?;
        let mapper = Mapper::builder()
            .posterior(model)
            .order(Order::Cyclic)
            .axioms(Axioms { max_genus: Some(0), ..Axioms::default() })
            .limits(Limits { time: Some(Duration::from_secs(seconds)), ..Limits::default() })
            .explain(&exploration)?;
        let (report, maps) = mapper.answer(1);
        let is_whole = |report: &hssh_search::Report| report.explained == report.travels;
        let best = maps.first().filter(|_| is_whole(&report));
        let Some(horizons) = best.and_then(|best| mapper.horizons(best)) else {
            rows.push(vec![
                format!("{kind} {size}"),
                exploration.travels().len().to_string(),
                "no map found".to_owned(),
            ]);
            continue;
        };
        let proved = if report.is_optimal { ", proved" } else { "" };
        let name = format!("{kind} {size}{proved}");
        rows.extend(PARTS.map(|part| row(&name, &horizons, part)));
        if let Some(Score::Nats(open)) = report.proof.and_then(|proof| proof.open_bound) {
            eprintln!("{name}: {} expanded, open from {open:.1} nats", report.expanded);
        }
    }
    println!(
        "== horizon: the best map within {seconds} s, and what is left of it to pay from some travels on; nats\n{}",
        aligned(&rows)
    );
    Ok(())
}

/// What is to be paid after that part of the travels, and how much of it is known.
fn row(name: &str, horizons: &[Horizon], part: f64) -> Vec<String> {
    let whole = horizons[horizons.len() - 1].cost;
    let at = (part * (horizons.len() - 1) as f64) as usize;
    let Horizon { explained, cost, bound, .. } = horizons[at];
    let to_pay = whole.total() - cost.total();
    let [places, vagueness] = [whole.places - cost.places, whole.vagueness - cost.vagueness];
    let one = |number: f64| format!("{number:.1}");
    // By how much the best of the other ways is behind, from here on.
    let behind = |horizon: &Horizon| horizon.alternative.map(|alternative| alternative - horizon.bound);
    let within = |excess: &f64| *excess < to_pay;
    let next = median(horizons[at..].iter().filter_map(behind).filter(within));
    vec![
        name.to_owned(),
        (horizons.len() - 1).to_string(),
        explained.to_string(),
        one(to_pay),
        one(places),
        one(vagueness),
        one(whole.bend - cost.bend),
        one(bound - cost.total()),
        one(whole.total() - bound),
        one(to_pay - places),
        one(to_pay - places - vagueness),
        if next.is_nan() { "–".to_owned() } else { one(next) },
    ]
}
