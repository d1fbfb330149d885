//! Explorations to compare on: those of the thesis, small grids, random worlds, and traces without stars.

use std::error::Error;

use hssh_causal::Exploration;
use hssh_causal::schema::{Sight, Trace, Turning};

use crate::experiment::{Missing, RouteSource, WorldSource, case};

/// Seeds of random worlds of each size and density.
const SEEDS: u64 = 10;
/// Numbers of places of random worlds.
const PLACES: std::ops::RangeInclusive<u32> = 3..=8;
/// How many links random worlds have, from a tree to a triangulation.
const DENSITIES: [f64; 3] = [0.0, 0.4, 1.0];
/// How many travels a quick comparison looks at.
const FEW: usize = 6;

/// One exploration.
pub(super) struct Case {
    /// Which group it belongs to.
    pub(super) kind: &'static str,
    pub(super) name: String,
    pub(super) experience: Experience,
    /// Whether all combinations of axioms are compared, or each switch alone.
    pub(super) thorough: bool,
}

/// What is known of it.
pub(super) enum Experience {
    /// The stars of all places.
    Stars(Exploration),
    /// What was seen ahead, and which turns were made.
    Schemas(Trace),
}

/// All explorations, or a few short ones.
pub(super) fn cases(small: bool) -> Result<Vec<Case>, Box<dyn Error>> {
    let figure = fixture("figure-2-4.ron")?;
    let mut grids = Vec::new();
    for (rows, columns) in [(2, 2), (2, 3), (3, 2), (3, 3)] {
        let world = WorldSource::Grid { rows, columns };
        grids.push((format!("{rows}×{columns}"), exploration(&world, Some(&RouteSource::Snake))?));
    }
    let mut cases = vec![stars("figure", "Figure 2.4".to_owned(), figure.clone(), true)];
    for (name, grid) in &grids {
        cases.push(stars("snake", name.clone(), grid.clone(), name == "2×2"));
    }
    let aces = fixture("aces.ron")?;
    for travels in 1..=aces.travels().len() {
        let name = format!("ACES, {travels} travels");
        cases.push(stars("ACES", name, aces.prefix(travels), false));
    }
    cases.extend(random_worlds()?);
    cases.extend(traces(&grids, &figure));
    if small {
        cases.retain_mut(Case::shorten);
    }
    Ok(cases)
}

impl Case {
    /// Keeps what is quick to compare; says whether it is left at all.
    fn shorten(&mut self) -> bool {
        self.thorough = false;
        match &mut self.experience {
            Experience::Stars(exploration) => {
                *exploration = exploration.prefix(FEW);
                match self.kind {
                    "ACES" => self.name == format!("ACES, {FEW} travels"),
                    "random" => self.name.ends_with("density 1, seed 1"),
                    _ => true,
                }
            }
            Experience::Schemas(_) => self.name.starts_with("2×2, to the exit"),
        }
    }
}

fn stars(kind: &'static str, name: String, exploration: Exploration, thorough: bool) -> Case {
    Case { kind, name, experience: Experience::Stars(exploration), thorough }
}

/// Planar worlds by chance, every link of them travelled.
fn random_worlds() -> Result<Vec<Case>, Box<dyn Error>> {
    let mut cases = Vec::new();
    for places in PLACES {
        for density in DENSITIES {
            for seed in 1..=SEEDS {
                let world = WorldSource::RandomPlanar { places, density, seed };
                let route = RouteSource::Cover { seed, travels: None };
                let name = format!("{places} places, density {density}, seed {seed}");
                cases.push(stars("random", name, exploration(&world, Some(&route))?, false));
            }
        }
    }
    Ok(cases)
}

/// The traces of `cargo xtask causal`.
fn traces(grids: &[(String, Exploration)], figure: &Exploration) -> Vec<Case> {
    let turnings = [
        (Turning::Stepwise, "to the exit"),
        (Turning::AllRound, "all round"),
        (Turning::AllRoundAndAround, "and around"),
    ];
    let sights = [(Sight::Ahead, "what is ahead"), (Sight::Place, "whole place")];
    let mut cases = Vec::new();
    let worlds = grids.iter().map(|(name, grid)| (name.as_str(), grid)).chain([("Figure 2.4", figure)]);
    for (world, exploration) in worlds {
        for (turning, turns) in turnings {
            for (sight, sees) in sights {
                let trace = Trace::of(exploration, sight, turning);
                cases.extend(trace.map(|trace| Case {
                    kind: "trace",
                    name: format!("{world}, {turns}, {sees}"),
                    experience: Experience::Schemas(trace),
                    thorough: false,
                }));
            }
        }
    }
    cases
}

fn fixture(file: &str) -> Result<Exploration, Box<dyn Error>> {
    exploration(&WorldSource::Exploration { file: file.to_owned(), visits: None }, None)
}

fn exploration(world: &WorldSource, route: Option<&RouteSource>) -> Result<Exploration, Box<dyn Error>> {
    match case(world, route, None) {
        Ok(case) => Ok(case.exploration),
        Err(Missing::Data(file)) => Err(file.into()),
        Err(Missing::Error(error)) => Err(error),
    }
}
