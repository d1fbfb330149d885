//! The logical theory of section 2.1.3, run by clingo (theory/), beside breadth-first's final maps.

mod basic;
mod clingo;
mod compare;
mod facts;
mod mapper;
mod model;
mod suite;
mod switches;

use std::error::Error;
use std::fs;
use std::path::Path;

use hssh_causal::{Exploration, ParseError};
use hssh_topology::Axioms;

use crate::flags;
use crate::noisy::on_threads;
use crate::table::{aligned, grouped};
use clingo::Clingo;
use compare::{Comparison, Count, MOST};
use mapper::finals;
use suite::{Case, Experience};

/// `cargo xtask theory`.
pub(crate) fn run(flags: &flags::Theory) -> Result<(), Box<dyn Error>> {
    let cases = match &flags.file {
        Some(file) if flags.facts => {
            print!("{}{}", facts::of_exploration(&read(file)?), facts::of_axioms(&Axioms::default()));
            return Ok(());
        }
        Some(file) => vec![of_file(file)?],
        None if flags.all || flags.small => suite::cases(flags.small)?,
        None => return Err("name the file of an exploration, or pass --all or --small".into()),
    };
    let Some(clingo) = Clingo::find() else {
        let absent = "there is no clingo: nothing was compared. Install it with `pip install clingo`, or the package gringo of Debian";
        if flags.optional {
            println!("theory: skipped, for {absent}");
            return Ok(());
        }
        return Err(absent.into());
    };
    let compared = on_threads(flags.threads.unwrap_or(1), cases.len(), |index| {
        let compared =
            compare(clingo, &cases[index]).map_err(|error| format!("{}: {error}", cases[index].name))?;
        eprintln!("{}: compared {} times", cases[index].name, compared.len());
        Ok(compared)
    })?;
    println!("{HEADING}\n");
    println!("{}", rows(&cases, &compared));
    println!("{}", summary(&cases, &compared));
    let different = compared.iter().flatten().filter(|one| !one.is_equal()).count();
    match different {
        0 => Ok(()),
        1 => Err("clingo and hssh differ once: look for DIFFER above".into()),
        many => Err(format!("clingo and hssh differ {many} times: look for DIFFER above").into()),
    }
}

const HEADING: &str = "\
The models of the theory (clingo) beside the final maps of breadth-first search (hssh), all of them and the optimal
ones, compared with their states, places, paths, orders and boundary relations. Switches: what differs from the published
axioms, −1 and −2 those on self-intersecting and circular paths. Explained: travels, or schemas where there are no stars;
of how many, if there were too many maps to go on. Seconds are those for all models and for all maps.";

fn of_file(file: &Path) -> Result<Case, Box<dyn Error>> {
    let name = file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned();
    Ok(Case { kind: "file", name, experience: Experience::Stars(read(file)?), thorough: true })
}

fn read(file: &Path) -> Result<Exploration, Box<dyn Error>> {
    let bytes = fs::read(file).map_err(|error| format!("{}: {error}", file.display()))?;
    let text = String::from_utf8_lossy(&bytes);
    let render = |error: ParseError| error.render(&file.display().to_string(), &text);
    let parsed = Exploration::from_ron_bytes(&bytes).map_err(render);
    // The one who reports says that it is an error.
    Ok(parsed.map_err(|rendered| rendered.trim_start_matches("error: ").to_owned())?)
}

/// All that is compared for one exploration.
fn compare(clingo: Clingo, case: &Case) -> Result<Vec<Comparison>, Box<dyn Error>> {
    let exploration = match &case.experience {
        Experience::Schemas(trace) => return Ok(vec![compare::by_turns(clingo, trace)?]),
        Experience::Stars(exploration) => exploration,
    };
    let explained = mapper::tractable(exploration, Axioms::default(), MOST as u64)?;
    let published = finals(&exploration.prefix(explained), Axioms::default())?;
    let places = published.fewest_places();
    let chosen = if case.thorough { switches::all(places) } else { switches::each(places) };
    let extended = chosen.iter().filter(|switches| ["published", "−1 −2"].contains(&switches.name.as_str()));
    let compared = chosen.iter().map(|switches| compare::by_stars(clingo, exploration, switches));
    compared.chain(extended.map(|switches| compare::by_extensions(clingo, exploration, switches))).collect()
}

fn rows(cases: &[Case], compared: &[Vec<Comparison>]) -> String {
    let heads =
        ["exploration", "switches", "explained", "clingo", "hssh", "equal", "optimal", "clingo s", "hssh s"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for (case, comparisons) in cases.iter().zip(compared) {
        rows.extend(comparisons.iter().map(|comparison| row(&case.name, comparison)));
    }
    aligned(&rows)
}

fn row(name: &str, comparison: &Comparison) -> Vec<String> {
    let Comparison { switches, explained, whole, all, optimal, clingo, hssh } = comparison;
    let verdict = |equal: bool| if equal { "yes" } else { "DIFFER" };
    let travels = if explained == whole { explained.to_string() } else { format!("{explained} of {whole}") };
    let optima = optimal.map_or("–".to_owned(), |Count { models, maps, equal }| {
        if equal { format!("{models}, yes") } else { format!("{models} and {maps}, DIFFER") }
    });
    vec![
        name.to_owned(),
        switches.clone(),
        travels,
        grouped(all.models as u64),
        grouped(all.maps as u64),
        verdict(all.equal).to_owned(),
        optima,
        format!("{clingo:.3}"),
        format!("{hssh:.5}"),
    ]
}

/// By kind of exploration: how many, what was compared, and how long it took.
fn summary(cases: &[Case], compared: &[Vec<Comparison>]) -> String {
    let heads = ["kind", "explorations", "compared", "equal", "models", "clingo s", "hssh s", "times"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    let mut kinds: Vec<&str> = cases.iter().map(|case| case.kind).collect();
    kinds.dedup();
    for kind in kinds.into_iter().map(Some).chain([None]) {
        let of_kind =
            cases.iter().zip(compared).filter(|(case, _)| kind.is_none_or(|kind| case.kind == kind));
        let explorations = of_kind.clone().count();
        let comparisons: Vec<&Comparison> = of_kind.flat_map(|(_, comparisons)| comparisons).collect();
        let equal = comparisons.iter().filter(|one| one.is_equal()).count();
        let models: usize = comparisons.iter().map(|one| one.all.models).sum();
        let clingo: f64 = comparisons.iter().map(|one| one.clingo).sum();
        let hssh: f64 = comparisons.iter().map(|one| one.hssh).sum();
        rows.push(vec![
            kind.unwrap_or("all").to_owned(),
            grouped(explorations as u64),
            grouped(comparisons.len() as u64),
            grouped(equal as u64),
            grouped(models as u64),
            format!("{clingo:.1}"),
            format!("{hssh:.2}"),
            format!("{:.0}", clingo / hssh),
        ]);
    }
    aligned(&rows)
}
