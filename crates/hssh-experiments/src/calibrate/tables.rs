//! The tables that a calibration prints.

use std::iter::once;

use hssh_local::PerceptionModel;

use super::RealRun;
use super::chain::Outcome;
use super::count::Count;
use super::drives::{Driven, NOISES};
use super::floors::names;
use super::judge::{Errors, KINDS};
use super::reliability::{bins, error};
use crate::table::aligned;

/// Errors of every log and variant.
pub(super) fn of_logs(runs: &[RealRun]) -> String {
    let header =
        once("log").chain(["variant"]).chain(KINDS).chain(["visits", "places", "map", "probability"]);
    let row = |run: &RealRun| {
        let mut row = vec![run.name.to_owned(), run.variant.name().to_owned()];
        row.extend(run.outcome.errors.kinds().map(|count| format!("{}/{}", count.wrong, count.all)));
        row.push(run.outcome.visits.to_string());
        row.extend(told(&run.outcome));
        row
    };
    let rows: Vec<Vec<String>> =
        once(header.map(str::to_owned).collect()).chain(runs.iter().map(row)).collect();
    format!("real logs; of each kind: wrong/all\n{}", aligned(&rows))
}

/// Places of a map, whether it is right, and its probability.
fn told(outcome: &Outcome) -> [String; 3] {
    let Some(map) = outcome.map else { return ["–", "none", "–"].map(str::to_owned) };
    let verdict = map.verdict;
    let told = if verdict.is_right() {
        "right".to_owned()
    } else {
        format!("{} merged, {} split", verdict.merged, verdict.split)
    };
    [map.places.to_string(), told, format!("{:.3}", map.stated)]
}

/// The rate of each kind of error beside the model's.
pub(super) fn of_rates(real: &[RealRun], drives: &[Driven]) -> String {
    let sum = |errors: &mut dyn Iterator<Item = Errors>| {
        let mut sum = Errors::default();
        errors.for_each(|errors| sum += errors);
        sum
    };
    let of_logs = sum(&mut real.iter().map(|run| run.outcome.errors));
    let of_drives = sum(&mut drives.iter().map(|drive| drive.outcome.errors));
    let mut both = of_logs;
    both += of_drives;
    let model = PerceptionModel::default();
    let defaults = [Some(model.wrong_return), Some(model.contradicted), Some(model.unconfirmed), None];
    let header = ["kind", "from", "all", "wrong", "rate", "95%", "default"].map(str::to_owned).to_vec();
    let mut rows = vec![header];
    for (kind, default) in defaults.iter().enumerate() {
        for (from, errors) in [("logs", of_logs), ("drives", of_drives), ("both", both)] {
            let count = errors.kinds()[kind];
            let mut row = vec![KINDS[kind].to_owned(), from.to_owned()];
            row.extend([count.all, count.wrong].map(|number| number.to_string()));
            row.extend([rate(count), interval(count)]);
            row.push(default.map_or_else(|| "–".to_owned(), |default| format!("{default}")));
            rows.push(row);
        }
    }
    format!("how often each kind is wrong: (wrong + 1)/(all + 2)\n{}", aligned(&rows))
}

/// The rates of the logs without one of them.
pub(super) fn of_rates_without(logs: &[RealRun]) -> String {
    let mut left_out: Vec<&str> = logs.iter().map(|run| run.name).collect();
    left_out.dedup();
    let header = once("without").chain(KINDS).map(str::to_owned).collect();
    let row = |name: &&str| {
        let mut errors = Errors::default();
        logs.iter().filter(|run| run.name != *name).for_each(|run| errors += run.outcome.errors);
        let cell = |count: Count| format!("{} ({}/{})", rate(count), count.wrong, count.all);
        once((*name).to_owned()).chain(errors.kinds().map(cell)).collect()
    };
    let rows: Vec<Vec<String>> = once(header).chain(left_out.iter().map(row)).collect();
    format!("the rates of the real logs, each in turn left out with all of its variants\n{}", aligned(&rows))
}

/// Stated probabilities against the share of right maps.
pub(super) fn of_reliability(drives: &[Driven]) -> String {
    let maps = drives.iter().filter_map(|drive| drive.outcome.map);
    let bins = bins(maps.map(|map| (map.stated, map.verdict.is_right())));
    let header = ["stated", "maps", "mean stated", "right", "95%"].map(str::to_owned).to_vec();
    let row = |(index, bin): (usize, &super::reliability::Bin)| {
        let range = format!("{:.1}–{:.1}", index as f64 / 10.0, (index + 1) as f64 / 10.0);
        if bin.maps == 0 {
            return vec![range, "0".to_owned(), "–".to_owned(), "–".to_owned(), "–".to_owned()];
        }
        let count = Count { all: bin.maps as u64, wrong: bin.right as u64 };
        let [stated, observed] = [bin.stated(), bin.observed()].map(|part| format!("{part:.3}"));
        vec![range, bin.maps.to_string(), stated, observed, interval(count)]
    };
    let rows: Vec<Vec<String>> = once(header).chain(bins.iter().enumerate().map(row)).collect();
    format!(
        "reliability of the best maps of simulated drives; right: no two visits with one place are truly more than 4 m \
         apart, no two with different places less than 1 m\n{}mean |stated − right|, by maps: {:.3}\n",
        aligned(&rows),
        error(&bins)
    )
}

/// Which part of the maps is right by floor and noise.
pub(super) fn of_floors(drives: &[Driven]) -> String {
    let share = |is_asked: &dyn Fn(&Driven) -> bool| {
        let (mut all, mut maps, mut right) = (0, 0, 0);
        for drive in drives.iter().filter(|drive| is_asked(drive)) {
            all += 1;
            maps += usize::from(drive.outcome.map.is_some());
            right += usize::from(drive.outcome.map.is_some_and(|map| map.verdict.is_right()));
        }
        if maps == all { format!("{right}/{maps}") } else { format!("{right}/{maps} of {all}") }
    };
    let visits = |is_asked: &dyn Fn(&Driven) -> bool| {
        let asked: Vec<&Driven> = drives.iter().filter(|drive| is_asked(drive)).collect();
        let visits: usize = asked.iter().map(|drive| drive.outcome.visits).sum();
        format!("{:.0}", visits as f64 / asked.len().max(1) as f64)
    };
    let noises = NOISES.map(|noise| format!("noise {noise}"));
    let header =
        once("floor".to_owned()).chain(noises).chain(["all", "mean visits"].map(str::to_owned)).collect();
    let row = |floor: String| {
        let cells =
            NOISES.map(|noise| share(&|drive| drive.task.floor == floor && drive.task.noise == noise));
        let all = share(&|drive| drive.task.floor == floor);
        let visits = visits(&|drive| drive.task.floor == floor);
        once(floor.clone()).chain(cells).chain([all, visits]).collect()
    };
    let cells = NOISES.map(|noise| share(&|drive| drive.task.noise == noise));
    let last = once("all".to_owned()).chain(cells).chain([share(&|_| true), visits(&|_| true)]).collect();
    let rows: Vec<Vec<String>> = once(header).chain(names().into_iter().map(row)).chain([last]).collect();
    format!("right maps/maps, of so many drives if some have none\n{}", aligned(&rows))
}

fn rate(count: Count) -> String {
    format!("{:.4}", count.rate())
}

fn interval(count: Count) -> String {
    let [low, high] = count.interval();
    format!("{low:.4}–{high:.4}")
}
