//! Logs of grounds that are hard to map, with exact truth: long rings of corridors all alike, halls wider than the laser
//! sees, lawns, people, wheels that slip. What of the answers is wrong, and is it said to be doubtful?

mod grounds;
mod motion;
mod surroundings;
mod trial;

use std::error::Error;

use rayon::prelude::*;

use crate::calibrate::{CONFIDENT, Outcome};
use crate::flags;
use crate::table::aligned;
use grounds::KINDS;
use trial::Trial;

/// Trials if no number is given.
const TRIALS: usize = 72;

/// What became of a trial.
struct Tried {
    trial: Trial,
    outcome: Outcome,
}

impl Tried {
    fn new(trial: Trial) -> Self {
        let outcome = match trial.log() {
            Ok(log) => Outcome::of(log),
            Err(error) => Outcome { problem: Some(error.to_string()), ..Outcome::default() },
        };
        let tried = Tried { trial, outcome };
        eprintln!("{}", row(&tried).join("  "));
        tried
    }

    /// A wrong map that is said to be right.
    fn is_false_certainty(&self) -> bool {
        self.outcome.map.is_some_and(|map| !map.verdict.is_right() && map.stated > CONFIDENT)
    }
}

/// `cargo xtask trials`.
///
/// # Errors
/// If the log of one trial cannot be made or written.
pub(crate) fn run(flags: &flags::Trials) -> Result<(), Box<dyn Error>> {
    if let Some(number) = flags.trial {
        let trial = Trial::new(number);
        if let Some(out) = &flags.out {
            std::fs::write(out, trial.to_carmen()).map_err(|error| format!("{}: {error}", out.display()))?;
        }
        Tried::new(trial);
        return Ok(());
    }
    let trials: Vec<Trial> = (0..flags.trials.unwrap_or(TRIALS))
        .map(Trial::new)
        .filter(|trial| flags.kind.as_deref().is_none_or(|kind| trial.name() == kind))
        .collect();
    let tried: Vec<Tried> = trials.into_par_iter().map(Tried::new).collect();
    println!("of returns, contradicted, unconfirmed and true returns: wrong/all; off: root mean square, m");
    let header = [
        "trial",
        "m",
        "raw, m",
        "closed, m",
        "returns",
        "contradicted",
        "unconfirmed",
        "true returns",
        "map",
        "probability",
        "s",
    ];
    let rows: Vec<Vec<String>> =
        std::iter::once(header.map(str::to_owned).to_vec()).chain(tried.iter().map(row)).collect();
    println!("{}", aligned(&rows));
    println!("{}", aligned(&sums(&tried)));
    Ok(())
}

fn row(tried: &Tried) -> Vec<String> {
    let outcome = &tried.outcome;
    let mut row = vec![tried.trial.describe()];
    row.push(format!("{:.0}", outcome.metres));
    row.extend(outcome.off.map(|off| format!("{off:.2}")));
    row.extend(outcome.errors.kinds().map(|count| format!("{}/{}", count.wrong, count.all)));
    row.extend(match (outcome.map, &outcome.problem) {
        (Some(map), _) if map.verdict.is_right() => ["right".to_owned(), format!("{:.3}", map.stated)],
        (Some(map), _) => {
            let told = format!("{} merged, {} split", map.verdict.merged, map.verdict.split);
            [told, format!("{:.3}", map.stated)]
        }
        (None, problem) => [problem.clone().unwrap_or_default().chars().take(60).collect(), "–".to_owned()],
    });
    row.push(format!("{:.1}", outcome.seconds));
    row
}

/// By kind: maps, right ones, and those that are wrong and said to be right.
fn sums(tried: &[Tried]) -> Vec<Vec<String>> {
    let certain = format!("wrong above {CONFIDENT}");
    let header = [
        "ground",
        "trials",
        "maps",
        "right",
        "mean stated",
        &certain,
        "wrong returns",
        "true returns missed",
    ];
    let mut rows = vec![header.map(str::to_owned).to_vec()];
    for kind in KINDS.iter().map(|kind| Some(kind.0)).chain([None]) {
        let of_kind: Vec<&Tried> =
            tried.iter().filter(|tried| kind.is_none_or(|kind| tried.trial.name() == kind)).collect();
        let maps: Vec<_> = of_kind.iter().filter_map(|tried| tried.outcome.map).collect();
        let stated = maps.iter().map(|map| map.stated).sum::<f64>() / maps.len().max(1) as f64;
        let sum = |which: usize| {
            let counts = of_kind.iter().map(|tried| tried.outcome.errors.kinds()[which]);
            let (wrong, all) =
                counts.fold((0, 0), |(wrong, all), count| (wrong + count.wrong, all + count.all));
            format!("{wrong}/{all}")
        };
        rows.push(vec![
            kind.unwrap_or("all").to_owned(),
            of_kind.len().to_string(),
            maps.len().to_string(),
            maps.iter().filter(|map| map.verdict.is_right()).count().to_string(),
            format!("{stated:.3}"),
            of_kind.iter().filter(|tried| tried.is_false_certainty()).count().to_string(),
            sum(0),
            sum(3),
        ]);
    }
    rows
}
