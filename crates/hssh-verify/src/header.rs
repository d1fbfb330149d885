//! The head of a certificate: for which exploration it speaks, under which rules, and what it claims.

use serde::Serialize;
use std::collections::BTreeMap;

use hssh_causal::Exploration;
use hssh_topology::Axioms;

use crate::lines::{Lines, Refusal, Statement, shortened};
use crate::rank::{GenusPlace, Rank};
use crate::route::Route;

/// What a certificate says before its tree.
pub(crate) struct Header {
    pub(crate) axioms: Axioms,
    /// Whether only maps without pending gateways count.
    pub(crate) closed_only: bool,
    /// Pairs of visits, each with whether they are said to be to one place.
    pub(crate) said: Vec<([usize; 2], bool)>,
    pub(crate) objective: Objective,
    pub(crate) best: Claimed<Best>,
    pub(crate) maps: Claimed<u64>,
    /// The probability of all maps not found, with a posterior only.
    pub(crate) rest: Option<Claimed<f64>>,
    /// What the search says it took on trust.
    pub(crate) trusted: Option<(String, u64)>,
}

/// What a line of the head claims; it is judged when the tree has been read.
#[derive(Clone)]
pub(crate) struct Claimed<T> {
    pub(crate) line: usize,
    pub(crate) value: T,
}

/// The value of the best map.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Best {
    /// No map explains everything.
    None,
    /// f1, f2, f3 and genus of the preferred map.
    Rank([u64; 4]),
    /// The cost of the most probable map, in nats.
    Cost(f64),
}

/// What makes a map better than another.
pub(crate) enum Objective {
    /// The order of preference.
    Preference(GenusPlace),
    /// Probability.
    Posterior(Rules),
}

/// How the cost of a map is made up.
pub(crate) struct Rules {
    pub(crate) metrical: Metrical,
    pub(crate) prior: Prior,
    /// Log-likelihood ratios by later visit, earlier visit and rotation.
    pub(crate) appearance: BTreeMap<(usize, usize, usize), f64>,
}

/// What odometry counts for.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Metrical {
    Ignored,
    /// The maximum over layouts.
    Likelihood,
    /// The integral over layouts, with a prior on where a new place is.
    Evidence(NewPlace),
}

/// Where a new place is, before it is seen.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum NewPlace {
    /// Anywhere in an area, in square metres.
    Uniform(f64),
    /// At the end of a corridor.
    Corridor { length: f64, spread: f64, deviation: f64, crooked: f64 },
}

/// How probable a map is before it is seen.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Prior {
    Flat,
    Choices,
    Simplicity { c1: f64, c2: f64, c3: f64 },
}

impl Header {
    /// Reads everything up to and including `tree`.
    pub(crate) fn read(
        lines: &mut Lines<'_>,
        exploration: &Exploration,
        route: &Route,
    ) -> Result<Header, Refusal> {
        let mut version = lines.expect("hssh-certificate")?;
        let number: u64 = version.count("the version of the format")?;
        if number != 1 {
            return Err(
                version.refuse(format!("this is version {number} of the format, the checker knows 1"))
            );
        }
        version.finish()?;
        check_exploration(lines.expect("exploration")?, exploration)?;
        let axioms = read_axioms(&lines.expect("axioms")?)?;
        let mut goal = lines.expect("goal")?;
        let closed_only = one_of(&mut goal, "a goal", &[("any", false), ("closed", true)])?;
        goal.finish()?;
        let said = read_said(lines, route)?;
        let objective = read_objective(lines, route)?;
        let posterior = matches!(objective, Objective::Posterior(_));
        let best = read_best(lines.expect("best")?, posterior)?;
        let mut maps = lines.expect("maps")?;
        let maps =
            Claimed { line: maps.line, value: finished(&mut maps, |it| it.count("a number of maps"))? };
        let rest = if posterior { Some(read_rest(lines.expect("rest")?)?) } else { None };
        let measured =
            matches!(&objective, Objective::Posterior(rules) if rules.metrical != Metrical::Ignored);
        let trusted = if measured { lines.next_if("trust").map(read_trust).transpose()? } else { None };
        lines.expect("tree")?.finish()?;
        Ok(Header { axioms, closed_only, said, objective, best, maps, rest, trusted })
    }
}

/// `same <visit> <visit>` and `different <visit> <visit>`, any number of them.
fn read_said(lines: &mut Lines<'_>, route: &Route) -> Result<Vec<([usize; 2], bool)>, Refusal> {
    let mut said = Vec::new();
    for (word, is_same) in [("same", true), ("different", false)] {
        while let Some(mut statement) = lines.next_if(word) {
            let mut visit = || -> Result<usize, Refusal> {
                let visit: u64 = statement.count("a visit")?;
                let visits = route.visits.len();
                let known = usize::try_from(visit).ok().filter(|&visit| visit < visits);
                known.ok_or_else(|| {
                    statement.refuse(format!("there are {visits} visits, and none is {visit}"))
                })
            };
            let mut pair = [visit()?, visit()?];
            pair.sort_unstable();
            statement.finish()?;
            said.push((pair, is_same));
        }
    }
    Ok(said)
}

fn finished<'a, T>(
    statement: &mut Statement<'a>,
    read: impl FnOnce(&mut Statement<'a>) -> Result<T, Refusal>,
) -> Result<T, Refusal> {
    let value = read(statement)?;
    statement.clone().finish()?;
    Ok(value)
}

/// The next word, one of a few.
fn one_of<T: Copy>(statement: &mut Statement<'_>, what: &str, known: &[(&str, T)]) -> Result<T, Refusal> {
    let word = statement.word(what)?;
    known.iter().find(|(name, _)| *name == word).map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<String> = known.iter().map(|(name, _)| format!("`{name}`")).collect();
        statement.refuse(format!("expected {what}, {}, found `{}`", names.join(" or "), shortened(word)))
    })
}

/// FNV-1a with 64 bits.
fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// The statement by which a certificate names its exploration: travels, star types, and a hash of its text.
#[must_use]
pub fn exploration_line(exploration: &Exploration) -> String {
    let (travels, stars) = (exploration.travels().len(), exploration.star_types().len());
    format!("exploration {travels} {stars} {:016x}", fnv1a(exploration.to_ron().as_bytes()))
}

fn check_exploration(mut statement: Statement<'_>, exploration: &Exploration) -> Result<(), Refusal> {
    let travels: usize = statement.count("a number of travels")?;
    let stars: usize = statement.count("a number of star types")?;
    let hash = statement.word("the hash of the exploration")?;
    let own = exploration_line(exploration);
    if own != format!("exploration {travels} {stars} {hash}") {
        return Err(statement.refuse(format!(
            "the certificate is for another exploration: this one is `{own}`, the certificate says `{}`",
            shortened(statement.text)
        )));
    }
    statement.finish()
}

fn read_axioms(statement: &Statement<'_>) -> Result<Axioms, Refusal> {
    let axioms: Axioms = serde_json::from_str(statement.remainder())
        .map_err(|error| statement.refuse(format!("expected the axioms as JSON: {error}")))?;
    if axioms.perpendicular && !axioms.no_self_intersection {
        // Two paths that share two places may become one, so that what violates this axiom may lead to what does not.
        let reason = "no branch can be closed for not being perpendicular while paths may meet a place twice";
        return Err(statement.refuse(reason));
    }
    Ok(axioms)
}

fn read_objective(lines: &mut Lines<'_>, route: &Route) -> Result<Objective, Refusal> {
    let mut statement = lines.expect("objective")?;
    if one_of(&mut statement, "an objective", &[("preference", true), ("posterior", false)])? {
        let places =
            [("ignored", GenusPlace::Ignored), ("first", GenusPlace::First), ("last", GenusPlace::Last)];
        let genus = one_of(&mut statement, "where the genus stands", &places)?;
        statement.finish()?;
        return Ok(Objective::Preference(genus));
    }
    statement.finish()?;
    let metrical = read_metrical(lines.expect("metrical")?, route)?;
    let prior = read_prior(lines.expect("prior")?)?;
    let mut appearance = BTreeMap::new();
    while let Some(statement) = lines.next_if("appearance") {
        read_appearance(statement, route, &mut appearance)?;
    }
    Ok(Objective::Posterior(Rules { metrical, prior, appearance }))
}

fn positive(statement: &mut Statement<'_>, what: &str) -> Result<f64, Refusal> {
    statement.number_that(what, "positive", |number| number > 0.0)
}

fn read_metrical(mut statement: Statement<'_>, route: &Route) -> Result<Metrical, Refusal> {
    let kinds = [("ignored", 0), ("likelihood", 1), ("evidence", 2)];
    let metrical = match one_of(&mut statement, "what odometry counts for", &kinds)? {
        0 => Metrical::Ignored,
        1 => Metrical::Likelihood,
        _ if one_of(&mut statement, "a prior of new places", &[("uniform", true), ("corridor", false)])? => {
            Metrical::Evidence(NewPlace::Uniform(positive(&mut statement, "the area")?))
        }
        _ => Metrical::Evidence(NewPlace::Corridor {
            length: positive(&mut statement, "the length of corridors")?,
            spread: positive(&mut statement, "the spread of lengths")?,
            deviation: positive(&mut statement, "the deviation of bearings")?,
            crooked: statement.number_that(
                "the share of crooked corridors",
                "above 0 and at most 1",
                |share| share > 0.0 && share <= 1.0,
            )?,
        }),
    };
    if metrical != Metrical::Ignored
        && let Some(travel) = route.legs.iter().position(|leg| leg.motion.is_none())
    {
        return Err(statement.refuse(format!("odometry is to count, but travel {travel} has none")));
    }
    statement.finish()?;
    Ok(metrical)
}

fn read_prior(mut statement: Statement<'_>) -> Result<Prior, Refusal> {
    let kinds = [("flat", 0), ("choices", 1), ("simplicity", 2)];
    let prior = match one_of(&mut statement, "a prior", &kinds)? {
        0 => Prior::Flat,
        1 => Prior::Choices,
        _ => {
            let mut weight = |what| statement.number_that(what, "0 or more", |number| number >= 0.0);
            let (c1, c2) = (weight("the weight c1")?, weight("the weight c2")?);
            Prior::Simplicity { c1, c2, c3: positive(&mut statement, "the weight c3")? }
        }
    };
    statement.finish()?;
    Ok(prior)
}

fn read_appearance(
    mut statement: Statement<'_>,
    route: &Route,
    ratios: &mut BTreeMap<(usize, usize, usize), f64>,
) -> Result<(), Refusal> {
    let later: usize = statement.count("the later visit")?;
    let earlier: usize = statement.count("the earlier visit")?;
    let rotation: usize = statement.count("a rotation")?;
    if later >= route.visits.len() || earlier >= later {
        let last = route.visits.len() - 1;
        return Err(statement.refuse(format!(
            "visits {later} and {earlier} are no later and earlier one: the last visit is {last}"
        )));
    }
    let degree = route.shape(later).degree();
    if rotation >= degree {
        return Err(statement.refuse(format!("rotation {rotation} of a star with {degree} ends")));
    }
    let ratio = statement.number("a log-likelihood ratio")?;
    if ratios.insert((later, earlier, rotation), ratio).is_some() {
        return Err(statement.refuse(format!(
            "the ratio of visits {later} and {earlier} by rotation {rotation} is given a second time"
        )));
    }
    statement.finish()
}

fn read_best(mut statement: Statement<'_>, posterior: bool) -> Result<Claimed<Best>, Refusal> {
    let line = statement.line;
    let mut ahead = statement.clone();
    let value = if ahead.word_if_any() == Some("none") {
        statement = ahead;
        Best::None
    } else if posterior {
        Best::Cost(statement.number("the cost of the best map")?)
    } else {
        Best::Rank(Rank::read(&mut statement)?.numbers())
    };
    statement.finish()?;
    Ok(Claimed { line, value })
}

fn read_rest(mut statement: Statement<'_>) -> Result<Claimed<f64>, Refusal> {
    let line = statement.line;
    let is_probability = |number: f64| (0.0..=1.0).contains(&number);
    let value = statement.number_that("the rest of the probability", "from 0 to 1", is_probability)?;
    statement.finish()?;
    Ok(Claimed { line, value })
}

fn read_trust(mut statement: Statement<'_>) -> Result<(String, u64), Refusal> {
    one_of(&mut statement, "what is taken on trust", &[("lowest-minimum", ())])?;
    let count = statement.count("how many layouts were solved")?;
    statement.finish()?;
    Ok(("lowest-minimum".to_owned(), count))
}

impl std::fmt::Display for Prior {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Prior::Flat => write!(f, "all maps equally probable before"),
            Prior::Choices => write!(f, "all choices equally probable before"),
            Prior::Simplicity { c1, c2, c3 } => write!(f, "simplicity {c1}·f1 + {c2}·f2' + {c3}·f3"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::fnv1a;

    /// Test vectors that the authors of the hash published.
    #[test]
    fn the_hash_is_fnv_1a() {
        assert_eq!(fnv1a(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv1a(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
