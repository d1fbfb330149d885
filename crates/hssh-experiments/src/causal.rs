//! Section 2.3.3: how many hypotheses the basic SSH has to keep, without stars, beside the hybrid one.

mod histories;
mod hypothesis;
#[cfg(test)]
mod oracle;
#[cfg(test)]
mod tests;

use std::error::Error;

use histories::glances;
pub(crate) use histories::{History, histories};
use hssh_causal::Exploration;
use hssh_causal::schema::{Action, Sight, Trace, Turning};
use hssh_search::Mapper;
use hypothesis::{Glance, Hypothesis};
use serde::Serialize;

use crate::experiment::{Missing, RouteSource, WorldSource, case};
use crate::flags;
use crate::table::{aligned, grouped};

/// More hypotheses than that are not kept: the count ends.
const MOST: usize = 50_000;

/// What one mapper made of one exploration.
#[derive(Serialize)]
struct Account {
    world: String,
    mapper: &'static str,
    turning: &'static str,
    sight: &'static str,
    /// Schemas of the whole exploration.
    actions: usize,
    /// Hypotheses before every travel, all turns done, and at the end, as far as they were counted.
    levels: Vec<u64>,
    /// Travels of the whole exploration.
    travels: usize,
    growth_at_travels: Growth,
    growth_at_turns: Growth,
}

/// How many hypotheses went into some steps, and how many came out.
#[derive(Clone, Copy, Default, Serialize)]
struct Growth {
    before: u64,
    after: u64,
}

impl Growth {
    fn factor(self) -> Option<f64> {
        (self.before > 0).then(|| self.after as f64 / self.before as f64)
    }
}

/// `cargo xtask causal`.
pub(crate) fn run(flags: &flags::Causal) -> Result<(), Box<dyn Error>> {
    let mut accounts = Vec::new();
    for (name, exploration) in explorations()? {
        accounts.push(hybrid(&name, &exploration)?);
        for (turning, turning_name) in TURNINGS {
            for (sight, sight_name) in SIGHTS {
                let account =
                    Account { turning: turning_name, sight: sight_name, ..blank(&name, &exploration) };
                accounts.push(basic(account, &exploration, sight, turning)?);
            }
        }
    }
    if flags.json {
        println!("{}", serde_json::to_string_pretty(&accounts)?);
    } else {
        println!("{}", text(&accounts));
    }
    Ok(())
}

const TURNINGS: [(Turning, &str); 3] = [
    (Turning::Stepwise, "to the exit"),
    (Turning::AllRound, "all round"),
    (Turning::AllRoundAndAround, "all round, and around"),
];

const SIGHTS: [(Sight, &str); 2] = [(Sight::Ahead, "what is ahead"), (Sight::Place, "whole place")];

/// The small worlds.
fn explorations() -> Result<Vec<(String, Exploration)>, Box<dyn Error>> {
    let grids = [(2, 2), (2, 3), (3, 3)].map(|(rows, columns)| {
        (format!("{rows}×{columns}"), WorldSource::Grid { rows, columns }, Some(RouteSource::Snake))
    });
    let figure = WorldSource::Exploration { file: "figure-2-4.ron".to_owned(), visits: None };
    let worlds = grids.into_iter().chain([("Figure 2.4".to_owned(), figure, None)]);
    worlds
        .map(|(name, world, route)| match case(&world, route.as_ref(), None) {
            Ok(case) => Ok((name, case.exploration)),
            Err(Missing::Data(file)) => Err(file.into()),
            Err(Missing::Error(error)) => Err(error),
        })
        .collect()
}

fn blank(world: &str, exploration: &Exploration) -> Account {
    Account {
        world: world.to_owned(),
        mapper: "basic",
        turning: "",
        sight: "",
        actions: exploration.travels().len(),
        levels: Vec::new(),
        travels: exploration.travels().len(),
        growth_at_travels: Growth::default(),
        growth_at_turns: Growth::default(),
    }
}

/// Breadth-first search over stars.
fn hybrid(world: &str, exploration: &Exploration) -> Result<Account, Box<dyn Error>> {
    let report = Mapper::builder().explain(exploration)?.report();
    let nodes: Vec<u64> = report.levels.iter().map(|level| level.nodes).collect();
    let growth = Growth { before: nodes[..nodes.len() - 1].iter().sum(), after: nodes[1..].iter().sum() };
    Ok(Account { mapper: "hybrid", levels: nodes, growth_at_travels: growth, ..blank(world, exploration) })
}

/// Breadth-first search over distinctive states.
fn basic(
    mut account: Account,
    exploration: &Exploration,
    sight: Sight,
    turning: Turning,
) -> Result<Account, Box<dyn Error>> {
    let trace = Trace::of(exploration, sight, turning).ok_or("the exploration has no travels")?;
    let glances = glances(&trace);
    account.actions = trace.steps().len();
    let mut hypotheses = vec![Hypothesis::root(glances[0])];
    for (step, &glance) in trace.steps().iter().zip(&glances[1..]) {
        let is_travel = step.action.is_travel();
        if is_travel {
            account.levels.push(hypotheses.len() as u64);
        }
        let before = hypotheses.len() as u64;
        let Some(grown) = grown(&hypotheses, step.action, glance) else { return Ok(account) };
        hypotheses = grown;
        let growth = if is_travel { &mut account.growth_at_travels } else { &mut account.growth_at_turns };
        growth.before += before;
        growth.after += hypotheses.len() as u64;
    }
    account.levels.push(hypotheses.len() as u64);
    Ok(account)
}

/// All successors, unless there are more than [`MOST`].
fn grown(hypotheses: &[Hypothesis], action: Action, glance: Glance) -> Option<Vec<Hypothesis>> {
    let mut grown = Vec::new();
    for hypothesis in hypotheses {
        grown.extend(hypothesis.step(action, glance));
        if grown.len() > MOST {
            return None;
        }
    }
    Some(grown)
}

fn text(accounts: &[Account]) -> String {
    let heads =
        ["world", "mapper", "turns", "sees", "actions", "travel ×", "turn ×", "travels", "hypotheses"];
    let rows: Vec<Vec<String>> =
        std::iter::once(heads.map(str::to_owned).to_vec()).chain(accounts.iter().map(row)).collect();
    let longest = accounts.iter().map(|account| account.travels).max().unwrap_or(0);
    format!(
        "The basic SSH, whose views are matched one distinctive state at a time, beside the hybrid one (2.3.3).\n\
         \"travel ×\", \"turn ×\": hypotheses after all such actions over hypotheses before them. \"travels\": how many\n\
         were explained before there were more than {} hypotheses; \"hypotheses\": how many there were then.\n\n{}\n\
         Hypotheses before each travel, all turns done, and at the end:\n\n{}",
        grouped(MOST as u64),
        aligned(&rows),
        aligned(&levels(accounts, longest)),
    )
}

fn row(account: &Account) -> Vec<String> {
    let factor = |growth: Growth| growth.factor().map_or("–".to_owned(), |factor| format!("{factor:.2}"));
    let explained = account.levels.len().saturating_sub(1);
    vec![
        account.world.clone(),
        account.mapper.to_owned(),
        account.turning.to_owned(),
        account.sight.to_owned(),
        account.actions.to_string(),
        factor(account.growth_at_travels),
        factor(account.growth_at_turns),
        format!("{explained} of {}", account.travels),
        account.levels.last().map_or("–".to_owned(), |&last| grouped(last)),
    ]
}

/// One row per account: the counts, and a sign for those that were too many.
fn levels(accounts: &[Account], longest: usize) -> Vec<Vec<String>> {
    let heads = ["world", "mapper"].map(str::to_owned).into_iter();
    let heads = heads.chain((0..=longest).map(|travel| travel.to_string())).collect();
    let line = |account: &Account| {
        let robot = [account.mapper, account.turning, account.sight].map(str::to_owned);
        let robot = robot.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ");
        let counts = account.levels.iter().map(|&count| grouped(count));
        let more = (account.levels.len() <= account.travels).then(|| "more".to_owned());
        [account.world.clone(), robot].into_iter().chain(counts).chain(more).collect()
    };
    std::iter::once(heads).chain(accounts.iter().map(line)).collect()
}
