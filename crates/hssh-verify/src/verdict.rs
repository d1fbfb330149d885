//! The verdict on a certificate: the claim as a whole, and what it still rests on.

use hssh_causal::Exploration;
use serde::Serialize;

use crate::header::{Best, Header, Metrical, Objective};
use crate::lines::{Lines, Refusal};
use crate::rank::{GenusPlace, Rank};
use crate::route::Route;
use crate::step::Stepper;
use crate::walk::{Tally, Walk};

/// What a certificate proves, once every line of it was found to hold.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Verdict {
    /// What makes a map the best, in words.
    pub objective: String,
    /// Whether only maps without pending gateways count.
    pub closed_only: bool,
    /// The value of the best map: no other consistent map is better.
    pub best: Best,
    /// How many maps the certificate shows.
    pub maps: u64,
    /// How many nodes were expanded.
    pub expanded: u64,
    /// How many nodes were left open, each under a bound that was confirmed.
    pub open: u64,
    /// How many nodes were turned down because no closed map can come of them.
    pub turned_down: u64,
    /// How many nodes of the tree explain 0, 1, 2, … travels.
    pub levels: Vec<u64>,
    /// The probability of all maps not shown, at most; with a posterior only.
    pub rest: Option<f64>,
    /// What no checker can confirm by computing it again, one sentence each.
    pub on_trust: Vec<String>,
}

/// Checks a certificate for an exploration, line by line.
///
/// # Errors
/// The first line that does not hold, with the reason.
pub fn verify(certificate: &str, exploration: &Exploration) -> Result<Verdict, Refusal> {
    let route = Route::of(exploration);
    let mut lines = Lines::new(certificate);
    let header = Header::read(&mut lines, exploration, &route)?;
    let mut walk = Walk::new(&header, Stepper::new(&route, header.axioms));
    walk.through(&mut lines)?;
    check_best(&header, &walk.tally)?;
    check_maps(&header, &walk.tally)?;
    check_rest(&header, &walk.tally)?;
    let on_trust = on_trust(&header, walk.solved());
    let Tally { expanded, open, maps, turned_down, levels, .. } = walk.tally;
    Ok(Verdict {
        objective: objective(&header.objective),
        closed_only: header.closed_only,
        best: header.best.value,
        maps,
        expanded,
        open,
        turned_down,
        levels,
        rest: header.rest.map(|rest| rest.value),
        on_trust,
    })
}

/// That the best is the least of all maps; better ones were refused on the way.
fn check_best(header: &Header, tally: &Tally) -> Result<(), Refusal> {
    let (line, best) = (header.best.line, header.best.value);
    let least = match best {
        Best::None => return Ok(()),
        Best::Rank([f1, f2, f3, genus]) => {
            if tally.least.contains(&Rank { f1, f2, f3, genus }) {
                return Ok(());
            }
            tally.least.first().map(ToString::to_string)
        }
        Best::Cost(cost) => {
            if tally.least_cost == Some(cost) {
                return Ok(());
            }
            tally.least_cost.map(|least| format!("{least:?}"))
        }
    };
    let found = least.map_or("there is no map in the tree".to_owned(), |least| {
        format!("the best map in the tree has {least}")
    });
    Err(Refusal::new(line, format!("{found}, not what is claimed")))
}

fn check_maps(header: &Header, tally: &Tally) -> Result<(), Refusal> {
    if header.maps.value == tally.maps {
        return Ok(());
    }
    let reason = format!("{} maps are claimed, {} are in the tree", header.maps.value, tally.maps);
    Err(Refusal::new(header.maps.line, reason))
}

/// That the maps below all open nodes have no more probability than is claimed.
fn check_rest(header: &Header, tally: &Tally) -> Result<(), Refusal> {
    let Some(rest) = &header.rest else { return Ok(()) };
    if tally.open == 0 {
        return Ok(());
    }
    let own = 1.0 / (1.0 + (tally.found.ln() - tally.left.ln()).exp());
    if rest.value >= own * (1.0 - 1e-6) {
        return Ok(());
    }
    let reason = format!("the rest is claimed to be {} at most, only {own} can be shown", rest.value);
    Err(Refusal::new(rest.line, reason))
}

fn objective(objective: &Objective) -> String {
    match objective {
        Objective::Preference(genus) => match genus {
            GenusPlace::Ignored => "preference (f1, f2, f3)".to_owned(),
            GenusPlace::First => "preference, genus first, then (f1, f2, f3)".to_owned(),
            GenusPlace::Last => "preference (f1, f2, f3), then genus".to_owned(),
        },
        Objective::Posterior(rules) => {
            let metrical = match rules.metrical {
                Metrical::Ignored => "odometry ignored",
                Metrical::Likelihood => "likelihood of the best layout",
                Metrical::Evidence(_) => "evidence over all layouts",
            };
            format!("posterior probability, {metrical}, {}", rules.prior)
        }
    }
}

fn on_trust(header: &Header, (solved, lowered): (u64, usize)) -> Vec<String> {
    let Objective::Posterior(rules) = &header.objective else { return Vec::new() };
    let mut sentences = Vec::new();
    if rules.metrical != Metrical::Ignored {
        sentences.push(format!(
            "that the {solved} layouts solved here, and the loops between pairs of visits, are in their lowest minimum"
        ));
        if let Some((what, count)) = &header.trusted {
            sentences.push(format!("the search says the same of its own {count} layouts ({what})"));
        }
        if lowered > 0 {
            sentences.push(format!(
                "{lowered} pairs of visits bend by less than the search promises; less was counted"
            ));
        }
    }
    if !rules.appearance.is_empty() {
        sentences.push(format!(
            "the {} ratios of appearance, which the exploration does not contain",
            rules.appearance.len()
        ));
    }
    sentences
}

/// A verdict as a text for people.
#[must_use]
pub fn report(verdict: &Verdict) -> String {
    let goal = if verdict.closed_only { "closed maps only" } else { "all maps" };
    let mut text = format!("The certificate holds.\n\n  objective   {}; {goal}\n", verdict.objective);
    text += &match verdict.best {
        Best::None => "  best        none: no map explains everything\n".to_owned(),
        Best::Rank([f1, f2, f3, genus]) => {
            format!("  best        (f1, f2, f3) = ({f1}, {f2}, {f3}), genus {genus}\n")
        }
        Best::Cost(cost) => format!("  best        {cost:.6} nats\n"),
    };
    text += &format!("  maps shown  {}\n", verdict.maps);
    if let Some(rest) = verdict.rest {
        text += &format!("  all others  probability {rest:.3e} at most\n");
    }
    text += &format!(
        "  nodes       {} expanded, {} left open under a confirmed bound",
        verdict.expanded, verdict.open
    );
    if verdict.turned_down > 0 {
        text += &format!(", {} that cannot close", verdict.turned_down);
    }
    text += "\n";
    if verdict.on_trust.is_empty() {
        text += "\nNothing is taken on trust.\n";
    } else {
        text += "\nTaken on trust:\n";
        for sentence in &verdict.on_trust {
            text += &format!("  * {sentence}\n");
        }
    }
    text
}
