//! What clingo makes of the theory beside what the mapper finds, for one exploration.

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;

use hssh_causal::Exploration;
use hssh_causal::schema::Trace;
use hssh_topology::{Axioms, Measure};

use super::basic;
use super::clingo::{Clingo, Reply, Wanted};
use super::facts;
use super::mapper::{Finals, finals, tractable};
use super::model::{Model, Moment, Side};
use super::switches::Switches;

/// More maps than that after any travel, and only the travels before it are compared.
pub(super) const MOST: usize = 500;

/// The blocks that every theory has.
const COMMON: [&str; 6] = ["individuals", "existence", "relations", "induction", "axioms", "models"];
/// The blocks for stars.
const STARS: [&str; 3] = ["stars", "paths", "boundaries"];

/// One theory, solved both ways.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Comparison {
    /// Which axioms.
    pub(super) switches: String,
    /// How many travels, or schemas where there are no stars, were explained.
    pub(super) explained: usize,
    /// How many there are.
    pub(super) whole: usize,
    /// Models by clingo and maps by hssh.
    pub(super) all: Count,
    /// Those that are optimal, where there is a preference.
    pub(super) optimal: Option<Count>,
    /// Seconds of clingo for all models.
    pub(super) clingo: f64,
    /// Seconds of hssh for all maps.
    pub(super) hssh: f64,
}

/// How many there are by either, and whether they are the same.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Count {
    pub(super) models: usize,
    pub(super) maps: usize,
    pub(super) equal: bool,
}

impl Comparison {
    /// Whether both found the same, all and optimal ones.
    pub(super) fn is_equal(&self) -> bool {
        self.all.equal && self.optimal.is_none_or(|optimal| optimal.equal)
    }
}

/// An exploration by stars, with some axioms.
pub(super) fn by_stars(
    clingo: Clingo,
    exploration: &Exploration,
    switches: &Switches,
) -> Result<Comparison, Box<dyn Error>> {
    let (axioms, whole) = (switches.axioms, exploration.travels().len());
    let explained = tractable(exploration, axioms, MOST as u64)?;
    let exploration = exploration.prefix(explained);
    let Finals { models, optimal, best, seconds, .. } = finals(&exploration, axioms)?;
    let all = solve(clingo, &exploration, &axioms, None, Wanted::All)?;
    let preferred = solve(clingo, &exploration, &axioms, Some("preference"), Wanted::Optimal)?;
    let optima = count(&read(&preferred)?, &models[..optimal]);
    let same_value = preferred.costs == best.map_or_else(Vec::new, value);
    Ok(Comparison {
        switches: switches.name.clone(),
        explained,
        whole,
        all: count(&read(&all)?, &models),
        optimal: Some(Count { equal: optima.equal && same_value, ..optima }),
        clingo: all.seconds,
        hssh: seconds,
    })
}

/// An exploration by stars, with all extensions of the default: those of one map share the boundary relations
/// that the mapper gives it.
pub(super) fn by_extensions(
    clingo: Clingo,
    exploration: &Exploration,
    switches: &Switches,
) -> Result<Comparison, Box<dyn Error>> {
    let (axioms, whole) = (switches.axioms, exploration.travels().len());
    let explained = tractable(exploration, axioms, MOST as u64 / 4)?;
    let exploration = exploration.prefix(explained);
    let Finals { models, contradictions, seconds, .. } = finals(&exploration, axioms)?;
    let reply = solve(clingo, &exploration, &axioms, Some("extensions"), Wanted::All)?;
    let extensions = read(&reply)?;
    let expected: usize = contradictions.iter().map(|&count| 1 << count).sum();
    let common = in_common(&extensions);
    Ok(Comparison {
        switches: format!("{}, all extensions", switches.name),
        explained,
        whole,
        all: Count {
            models: extensions.len(),
            maps: expected,
            equal: extensions.len() == expected && count(&common, &models).equal,
        },
        optimal: None,
        clingo: reply.seconds,
        hssh: seconds,
    })
}

/// A trace of schemas without stars.
pub(super) fn by_turns(clingo: Clingo, trace: &Trace) -> Result<Comparison, Box<dyn Error>> {
    let whole = trace.steps().len();
    let explained = basic::tractable(trace, MOST);
    let trace = basic::prefix(trace, explained);
    let (models, seconds) = basic::models(&trace, MOST).ok_or("it was tractable, and is not any more")?;
    let files = [&COMMON[..], &["turns"]].concat();
    let facts = facts::of_trace(&trace) + &facts::of_axioms(&Axioms::default());
    let reply = clingo.solve(&files, &facts, Wanted::All)?;
    Ok(Comparison {
        switches: "published".to_owned(),
        explained,
        whole,
        all: count(&read(&reply)?, &models),
        optimal: None,
        clingo: reply.seconds,
        hssh: seconds,
    })
}

/// The theory of an exploration by stars, with one more block or none.
fn solve(
    clingo: Clingo,
    exploration: &Exploration,
    axioms: &Axioms,
    more: Option<&str>,
    wanted: Wanted,
) -> Result<Reply, Box<dyn Error>> {
    let planarity = axioms.max_genus.map(|_| "planarity");
    let files: Vec<&str> = COMMON.into_iter().chain(STARS).chain(planarity).chain(more).collect();
    let facts = facts::of_exploration(exploration) + &facts::of_axioms(axioms);
    clingo.solve(&files, &facts, wanted)
}

/// The models of a reply. None is printed twice: the theory has no choice that its models do not show.
fn read(reply: &Reply) -> Result<Vec<Model>, String> {
    reply.models.iter().map(|atoms| Model::of_atoms(atoms.iter().map(String::as_str))).collect()
}

fn count(models: &[Model], maps: &[Model]) -> Count {
    let (one, other): (BTreeSet<&Model>, BTreeSet<&Model>) = (models.iter().collect(), maps.iter().collect());
    let equal = one == other && models.len() == maps.len();
    Count { models: models.len(), maps: maps.len(), equal }
}

/// (f1, f2, f3), as `#minimize` has them.
fn value(best: Measure) -> Vec<u64> {
    vec![best.undetermined_boundaries, u64::from(best.paths), u64::from(best.places)]
}

/// One model for each map: what all its extensions agree on.
fn in_common(extensions: &[Model]) -> Vec<Model> {
    let mut sides: BTreeMap<Model, BTreeSet<(Moment, Side, Moment)>> = BTreeMap::new();
    for extension in extensions {
        let map = Model { sides: BTreeSet::new(), ..extension.clone() };
        sides
            .entry(map)
            .and_modify(|common| common.retain(|side| extension.sides.contains(side)))
            .or_insert_with(|| extension.sides.clone());
    }
    sides.into_iter().map(|(map, sides)| Model { sides, ..map }).collect()
}
