//! Equation (3.1): the branching factor with and without planarity, measured beside predicted.

use std::error::Error;

use hssh_search::{BranchingSample, Experience, Visitor, branching, depth_first};
use hssh_topology::{Axioms, Hypothesis, Observation, StarCatalog};
use serde::Serialize;

use crate::experiment::{Missing, RouteSource, WorldSource, case};
use crate::flags;
use crate::table::{aligned, grouped};

/// All expansions of one planar breadth-first search, in the order of the tree.
struct Series {
    name: String,
    samples: Vec<BranchingSample>,
    /// Expansions without any successor, where there is no ratio.
    barren: usize,
}

/// What the table says about a set of expansions.
#[derive(Clone, Copy, Debug, Serialize)]
struct Summary {
    expansions: usize,
    /// Mean b_p / b.
    measured: f64,
    /// Mean of the right-hand side of (3.1).
    predicted: f64,
    /// Mean of the same, with only those pending gateways counted that match the observation.
    from_matching: f64,
    /// Mean absolute difference between measured and predicted.
    off: f64,
    /// Mean absolute difference between measured and predicted from matching gateways.
    off_from_matching: f64,
    /// Pearson's correlation of measured with predicted; none if one of them is constant.
    correlation: Option<f64>,
    /// The same, predicted from matching gateways.
    correlation_from_matching: Option<f64>,
    /// Mean fraction of the pending gateways that match the observation.
    matching: f64,
    /// Mean fraction of the matching ones, the new place among them, that the axioms other than
    /// planarity admit.
    admitted: f64,
}

#[derive(Serialize)]
struct Account {
    name: String,
    barren: usize,
    all: Summary,
    /// By m, the number of matches made.
    by_matches: Vec<(u32, Summary)>,
}

/// `cargo xtask branching`.
pub(crate) fn run(flags: &flags::Branching) -> Result<(), Box<dyn Error>> {
    let accounts = accounts()?;
    if flags.json {
        println!("{}", serde_json::to_string_pretty(&accounts)?);
    } else {
        println!("{}\n{}", overview(&accounts), by_matches(&accounts));
    }
    Ok(())
}

fn accounts() -> Result<Vec<Account>, Box<dyn Error>> {
    let mut series = vec![worst_case()?];
    series.extend(grids()?);
    series.extend(random_worlds()?);
    Ok(series.iter().filter_map(account).collect())
}

/// Only "+" places and no axiom but planarity: every pending gateway is a possible arrival, as the
/// text assumes. A spiral in the interior of a large grid.
fn worst_case() -> Result<Series, Box<dyn Error>> {
    let world = WorldSource::Grid { rows: 7, columns: 7 };
    let spiral = RouteSource::Places(vec![24, 25, 32, 31, 30, 23, 16, 17, 18]);
    let axioms = Axioms { no_self_intersection: false, no_circular_path: false, ..planar(None) };
    measure("all \"+\", no axioms", &world, &spiral, &axioms)
}

/// The grids of Figure 3.3.
fn grids() -> Result<Vec<Series>, Box<dyn Error>> {
    let grids = [
        ("3×3", 3, 3, RouteSource::Snake, None),
        ("3×4", 3, 4, RouteSource::Thesis3x4, None),
        ("4×4, at most 16 places", 4, 4, RouteSource::Snake, Some(16)),
        ("4×4", 4, 4, RouteSource::Snake, None),
    ];
    let series = grids.iter().map(|(name, rows, columns, route, most)| {
        measure(name, &WorldSource::Grid { rows: *rows, columns: *columns }, route, &planar(*most))
    });
    series.collect()
}

/// Ten random planar worlds, every corridor travelled, all expansions together.
fn random_worlds() -> Result<Vec<Series>, Box<dyn Error>> {
    let series = (1..=10).map(|seed| {
        let world = WorldSource::RandomPlanar { places: 8, density: 0.4, seed };
        let cover = RouteSource::Cover { seed, travels: None };
        measure(&format!("random world {seed}"), &world, &cover, &planar(None))
    });
    let mut series: Vec<Series> = series.collect::<Result<_, _>>()?;
    let samples = series.iter().flat_map(|one| &one.samples).copied().collect();
    let barren = series.iter().map(|one| one.barren).sum();
    series.push(Series { name: "the ten together".to_owned(), samples, barren });
    Ok(series)
}

fn planar(max_places: Option<u32>) -> Axioms {
    Axioms { max_genus: Some(0), max_places, ..Axioms::default() }
}

/// Looks at every expansion of a planar search.
fn measure(
    name: &str,
    world: &WorldSource,
    route: &RouteSource,
    axioms: &Axioms,
) -> Result<Series, Box<dyn Error>> {
    let case = case(world, Some(route), None).map_err(|missing| match missing {
        Missing::Data(file) => file.into(),
        Missing::Error(error) => error,
    })?;
    let experience = Experience::from(&case.exploration);
    let mut series = Series { name: name.to_owned(), samples: Vec::new(), barren: 0 };
    let mut root = Hypothesis::root(&experience.catalog, experience.start);
    let mut sampling = Sampling { catalog: &experience.catalog, axioms, series: &mut series };
    depth_first(&mut root, 0, &experience, axioms, &mut sampling);
    Ok(series)
}

struct Sampling<'a> {
    catalog: &'a StarCatalog,
    axioms: &'a Axioms,
    series: &'a mut Series,
}

impl Visitor for Sampling<'_> {
    fn step(&mut self, hypothesis: &Hypothesis, observation: Observation) {
        match branching(hypothesis, observation, self.catalog, self.axioms) {
            Some(sample) if sample.successors > 0 => self.series.samples.push(sample),
            Some(_) => self.series.barren += 1,
            None => {}
        }
    }
}

fn account(series: &Series) -> Option<Account> {
    let all = summary(&series.samples)?;
    let most = series.samples.iter().map(|sample| sample.matches).max()?;
    let with = |matches| -> Vec<BranchingSample> {
        series.samples.iter().copied().filter(|sample| sample.matches == matches).collect()
    };
    let by_matches = (0..=most).filter_map(|matches| Some((matches, summary(&with(matches))?))).collect();
    Some(Account { name: series.name.clone(), barren: series.barren, all, by_matches })
}

/// The means over some expansions; `None` if there are none.
fn summary(samples: &[BranchingSample]) -> Option<Summary> {
    let mean =
        |of: &dyn Fn(&BranchingSample) -> f64| samples.iter().map(of).sum::<f64>() / samples.len() as f64;
    let measured = BranchingSample::measured;
    let predicted = BranchingSample::predicted;
    let from_matching = BranchingSample::predicted_from_consistent;
    (!samples.is_empty()).then(|| Summary {
        expansions: samples.len(),
        measured: mean(&measured),
        predicted: mean(&predicted),
        from_matching: mean(&from_matching),
        off: mean(&|sample| (measured(sample) - predicted(sample)).abs()),
        off_from_matching: mean(&|sample| (measured(sample) - from_matching(sample)).abs()),
        correlation: correlation(samples, measured, predicted),
        correlation_from_matching: correlation(samples, measured, from_matching),
        matching: mean(&|sample| f64::from(sample.consistent) / f64::from(sample.pending)),
        admitted: mean(&|sample| f64::from(sample.successors) / f64::from(sample.consistent)),
    })
}

/// Pearson's correlation coefficient.
fn correlation(
    samples: &[BranchingSample],
    x: fn(&BranchingSample) -> f64,
    y: fn(&BranchingSample) -> f64,
) -> Option<f64> {
    let count = samples.len() as f64;
    let mean = |of: fn(&BranchingSample) -> f64| samples.iter().map(of).sum::<f64>() / count;
    let (mean_x, mean_y) = (mean(x), mean(y));
    let sum = |of: &dyn Fn(f64, f64) -> f64| {
        samples.iter().map(|sample| of(x(sample) - mean_x, y(sample) - mean_y)).sum::<f64>()
    };
    let (xx, xy, yy) = (sum(&|dx, _| dx * dx), sum(&|dx, dy| dx * dy), sum(&|_, dy| dy * dy));
    (xx > 1e-9 && yy > 1e-9).then(|| xy / (xx * yy).sqrt())
}

const HEADS: [&str; 10] = [
    "expansions",
    "b_p/b",
    "(3.1)",
    "|diff|",
    "corr",
    "(3.1) match",
    "|diff|",
    "corr",
    "matching",
    "admitted",
];

fn cells(summary: &Summary) -> Vec<String> {
    let number = |value: f64| format!("{value:.3}");
    let optional = |value: Option<f64>| value.map_or("–".to_owned(), number);
    vec![
        grouped(summary.expansions as u64),
        number(summary.measured),
        number(summary.predicted),
        number(summary.off),
        optional(summary.correlation),
        number(summary.from_matching),
        number(summary.off_from_matching),
        optional(summary.correlation_from_matching),
        number(summary.matching),
        number(summary.admitted),
    ]
}

fn heads(first: &str) -> Vec<String> {
    std::iter::once(first).chain(HEADS).map(str::to_owned).collect()
}

fn overview(accounts: &[Account]) -> String {
    let row = |account: &Account| [vec![account.name.clone()], cells(&account.all)].concat();
    let barren: usize = accounts.iter().map(|account| account.barren).sum();
    let rows: Vec<_> = std::iter::once(heads("planar search")).chain(accounts.iter().map(row)).collect();
    format!(
        "Equation (3.1) at every expansion: b_p/b measured and predicted, means.\n\
         \"(3.1) match\" counts only pending gateways that match the observation; \"matching\" is their share\n\
         of all pending ones; \"admitted\" is b over the matching, so what the other axioms leave.\n\
         Expansions without any successor, left out: {}.\n\n{}",
        grouped(barren as u64),
        aligned(&rows)
    )
}

fn by_matches(accounts: &[Account]) -> String {
    let shown = accounts.iter().filter(|account| !account.name.starts_with("random world"));
    let tables = shown.map(|account| {
        let row =
            |(matches, summary): &(u32, Summary)| [vec![format!("  m = {matches}")], cells(summary)].concat();
        let rows: Vec<_> =
            std::iter::once(heads(&account.name)).chain(account.by_matches.iter().map(row)).collect();
        aligned(&rows)
    });
    tables.collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn in_the_worst_case_of_the_text_the_equation_is_exact() {
        let series = worst_case().unwrap();
        assert!(series.samples.len() > 500 && series.barren == 0);
        for sample in &series.samples {
            assert_eq!(sample.successors, sample.pending);
            assert_eq!(sample.planar_successors, sample.pending_in_face);
            assert_eq!(sample.faces, sample.matches + 1);
            assert!((sample.measured() - sample.predicted()).abs() < 1e-12);
        }
    }

    #[test]
    fn without_other_axioms_only_matching_gateways_count() {
        // Section 3.3 ends with this: p and p_i restricted to the consistent gateways.
        let world = WorldSource::Grid { rows: 3, columns: 3 };
        let axioms = Axioms { no_self_intersection: false, no_circular_path: false, ..planar(None) };
        let series = measure("3×3", &world, &RouteSource::Snake, &axioms).unwrap();
        assert!(series.samples.iter().any(|sample| sample.matches > 0));
        for sample in &series.samples {
            assert!((sample.measured() - sample.predicted_from_consistent()).abs() < 1e-12);
        }
    }

    #[test]
    fn the_tables_are_as_they_were_and_as_the_documentation_quotes_them() {
        let accounts = accounts().unwrap();
        let printed = format!("{}\n{}", overview(&accounts), by_matches(&accounts));
        insta::assert_snapshot!(printed);
        let page = std::fs::read_to_string(crate::root::root().join("docs/branching.md")).unwrap();
        let quoted = page.split("```").skip(1).step_by(2).flat_map(|block| block.lines().skip(1));
        let quoted: Vec<&str> = quoted.filter(|line| !line.is_empty()).collect();
        assert!(quoted.len() > 10);
        for line in quoted {
            assert!(printed.lines().any(|other| other == line), "docs/branching.md quotes: {line}");
        }
    }
}
