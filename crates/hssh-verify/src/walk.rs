//! The walk through the tree of a certificate: every line is held against what the checker finds at that node.

use std::cmp::Ordering;

use crate::header::{Best, Header, Objective};
use crate::lines::{Lines, Refusal, Statement, shortened};
use crate::posterior::{Posterior, leeway, slack};
use crate::rank::{GenusPlace, Rank};
use crate::step::{Choice, Position, Stepper};

/// So many nats beyond the best one a map weighs nothing.
const HOPELESS: f64 = 30.0;

/// What the tree amounts to.
#[derive(Default)]
pub(crate) struct Tally {
    pub(crate) expanded: u64,
    pub(crate) open: u64,
    pub(crate) maps: u64,
    pub(crate) turned_down: u64,
    /// Maps by the number of travels that they explain.
    pub(crate) levels: Vec<u64>,
    /// The least values of all maps, with all genera that stand beside it.
    pub(crate) least: Vec<Rank>,
    pub(crate) least_cost: Option<f64>,
    /// Σ exp(−cost) over the maps found.
    pub(crate) found: LogSum,
    /// Σ exp(branches − bound) over the open nodes.
    pub(crate) left: LogSum,
}

/// The logarithm of a sum of exponentials.
pub(crate) struct LogSum {
    greatest: f64,
    scaled: f64,
}

impl Default for LogSum {
    fn default() -> Self {
        LogSum { greatest: f64::NEG_INFINITY, scaled: 0.0 }
    }
}

impl LogSum {
    fn add(&mut self, exponent: f64) {
        if exponent > self.greatest {
            self.scaled *= (self.greatest - exponent).exp();
            self.greatest = exponent;
        }
        self.scaled += (exponent - self.greatest).exp();
    }

    /// The logarithm; minus infinity if nothing was added.
    pub(crate) fn ln(&self) -> f64 {
        self.greatest + self.scaled.ln()
    }
}

/// A node on the branch that is walked.
struct Node {
    at: Position,
    /// How it came of its parent; nothing for the root.
    choice: Option<Choice>,
    /// Its successors not visited yet, and how many it has: `next..end` of [`Walk::choices`].
    next: usize,
    begin: usize,
    end: usize,
}

/// A walk in progress.
pub(crate) struct Walk<'a> {
    header: &'a Header,
    stepper: Stepper<'a>,
    posterior: Option<Posterior<'a>>,
    branch: Vec<Node>,
    choices: Vec<Choice>,
    pub(crate) tally: Tally,
}

impl<'a> Walk<'a> {
    /// A walk that stands at the root.
    pub(crate) fn new(header: &'a Header, stepper: Stepper<'a>) -> Self {
        let posterior = match &header.objective {
            Objective::Preference(_) => None,
            Objective::Posterior(rules) => Some(Posterior::new(stepper.route, rules)),
        };
        let root = Node { at: Position { place: 0, rotation: 0 }, choice: None, next: 0, begin: 0, end: 0 };
        let tally = Tally { levels: vec![0; stepper.route.visits.len()], ..Tally::default() };
        Walk { header, stepper, posterior, branch: vec![root], choices: Vec::new(), tally }
    }

    /// How many promises of the outlook were lowered, and how many layouts were solved.
    pub(crate) fn solved(&self) -> (u64, usize) {
        self.posterior.as_ref().map_or((0, 0), |it| (it.solved, it.lowered_promises()))
    }

    /// Reads the tree up to and including `end`, after which nothing may follow.
    pub(crate) fn through(&mut self, lines: &mut Lines<'_>) -> Result<(), Refusal> {
        self.tally.levels[0] += 1;
        let mut at_node = true;
        while at_node {
            let Some(statement) = lines.next_if_any() else {
                return Err(lines.ended(&format!("a line for {}", self.whereabouts())));
            };
            at_node = match statement.keyword {
                "e" => self.expanded(statement)?,
                "o" => self.open(statement)?,
                "f" => self.map(statement)?,
                "x" => self.turned_down(statement)?,
                "end" => {
                    return Err(statement.refuse(format!(
                        "`end`, but the tree is not complete: {} has no line",
                        self.whereabouts()
                    )));
                }
                _ => {
                    return Err(statement.refuse(format!(
                        "expected `e`, `o`, `f` or `x` for {}, found `{}`",
                        self.whereabouts(),
                        shortened(statement.text)
                    )));
                }
            };
        }
        let end = lines.next("`end`")?;
        if end.keyword != "end" {
            let found = shortened(end.text);
            return Err(end.refuse(format!("the tree is complete: expected `end`, found `{found}`")));
        }
        end.finish()?;
        match lines.next_if_any() {
            None => Ok(()),
            Some(more) => {
                Err(more.refuse(format!("nothing may follow `end`, found `{}`", shortened(more.text))))
            }
        }
    }

    fn explained(&self) -> usize {
        self.branch.len() - 1
    }

    fn left(&self) -> usize {
        self.stepper.route.travels() - self.explained()
    }

    /// Which node it is, in words.
    fn whereabouts(&self) -> String {
        let steps = self.branch.iter().skip(1).zip(&self.branch);
        let path: Vec<String> = steps
            .filter(|(_, parent)| parent.end - parent.begin > 1)
            .map(|(_, parent)| (parent.next - parent.begin - 1).to_string())
            .collect();
        let choices =
            if path.is_empty() { "no choice".to_owned() } else { format!("choices {}", path.join(" ")) };
        format!(
            "the node with {} of {} travels explained by {choices}",
            self.explained(),
            self.explained() + self.left()
        )
    }

    /// Goes to the next node in depth-first order, if there is one.
    fn advance(&mut self) -> bool {
        while let Some(node) = self.branch.last_mut() {
            if node.next < node.end {
                let (choice, siblings) = (self.choices[node.next], node.end - node.begin);
                node.next += 1;
                let travel = self.branch.len() - 1;
                let at = self.stepper.grow(choice, travel);
                if let Some(posterior) = &mut self.posterior {
                    posterior.enter(&self.stepper, choice, at, siblings);
                }
                let begin = self.choices.len();
                self.branch.push(Node { at, choice: Some(choice), next: begin, begin, end: begin });
                self.tally.levels[travel + 1] += 1;
                return true;
            }
            self.choices.truncate(node.begin);
            if let Some(choice) = node.choice {
                self.stepper.retract(choice);
                if let Some(posterior) = &mut self.posterior {
                    posterior.leave();
                }
            }
            self.branch.pop();
        }
        false
    }

    /// `e <n>`: the next nodes are expanded.
    fn expanded(&mut self, mut statement: Statement<'_>) -> Result<bool, Refusal> {
        let count: u64 = statement.count("how many nodes are expanded")?;
        if count == 0 {
            return Err(statement.refuse("`e 0` says nothing: at least one node is expanded"));
        }
        statement.clone().finish()?;
        for nth in 0..count {
            if self.branch.is_empty() {
                return Err(statement.refuse(format!(
                    "{count} nodes are to be expanded, but the tree ends after {nth} of them"
                )));
            }
            if self.left() == 0 {
                return Err(statement.refuse(format!(
                    "{count} nodes are to be expanded, but after {nth} of them comes {}, which cannot be",
                    self.whereabouts()
                )));
            }
            self.expand();
            self.tally.expanded += 1;
            self.advance();
        }
        Ok(!self.branch.is_empty())
    }

    fn expand(&mut self) {
        let travel = self.explained();
        let Some(node) = self.branch.last_mut() else { return };
        self.stepper.successors(node.at, travel, &mut self.choices);
        node.end = self.choices.len();
        self.keep_allowed();
    }

    /// Strikes the successors out that contradict what the head says of pairs of visits.
    fn keep_allowed(&mut self) {
        let visit = self.branch.len();
        let Some(node) = self.branch.last() else { return };
        let begin = node.begin;
        let earlier: Vec<(usize, bool)> = self
            .header
            .said
            .iter()
            .filter(|([_, later], _)| *later == visit)
            .map(|([earlier, _], is_same)| (self.branch[*earlier].at.place, *is_same))
            .collect();
        if earlier.is_empty() {
            return;
        }
        let is_allowed = |choice: &Choice| {
            let place = match choice {
                Choice::Moved(to) | Choice::Closure { to, .. } => Some(to.place),
                Choice::New { .. } => None,
            };
            earlier.iter().all(|&(other, is_same)| (place == Some(other)) == is_same)
        };
        let allowed: Vec<Choice> = self.choices.drain(begin..).filter(is_allowed).collect();
        self.choices.extend(allowed);
        if let Some(node) = self.branch.last_mut() {
            node.end = self.choices.len();
        }
    }

    /// `o <bound>`: the node is left open, no map below it is as good as the best.
    fn open(&mut self, mut statement: Statement<'_>) -> Result<bool, Refusal> {
        match &self.header.objective {
            Objective::Preference(genus) => self.open_rank(&mut statement, *genus)?,
            Objective::Posterior(_) => self.open_cost(&mut statement)?,
        }
        statement.finish()?;
        self.tally.open += 1;
        Ok(self.advance())
    }

    fn open_rank(&mut self, statement: &mut Statement<'_>, genus: GenusPlace) -> Result<(), Refusal> {
        let claimed = Rank::read(statement)?;
        if self.left() == 0 {
            return Err(statement.refuse(format!("{} cannot be left open", self.whereabouts())));
        }
        if genus == GenusPlace::Ignored && claimed.genus != 0 {
            return Err(statement.refuse(format!(
                "the genus does not count and is written 0 in a bound, found {}",
                claimed.genus
            )));
        }
        let travels = self.left();
        let own = Rank::bound(&mut self.stepper.map, &mut self.stepper.paths, travels);
        if genus.compare(&claimed, &own) == Ordering::Greater {
            return Err(statement.refuse(format!(
                "the bound {claimed} is too high: for {} only {own} can be shown",
                self.whereabouts()
            )));
        }
        match self.header.best.value {
            Best::Rank([f1, f2, f3, g]) => {
                let best = Rank { f1, f2, f3, genus: g };
                if genus.compare(&claimed, &best) != Ordering::Greater {
                    return Err(
                        statement.refuse(format!("the bound {claimed} is no worse than the best, {best}"))
                    );
                }
                Ok(())
            }
            _ => Err(self.open_without_best(statement)),
        }
    }

    fn open_cost(&mut self, statement: &mut Statement<'_>) -> Result<(), Refusal> {
        let claimed = statement.number("a bound in nats")?;
        let Best::Cost(best) = self.header.best.value else {
            return Err(self.open_without_best(statement));
        };
        if claimed <= best + slack(best) {
            return Err(statement.refuse(format!("the bound {claimed} is no worse than the best, {best}")));
        }
        let pending = self.stepper.map.pending();
        let Some(posterior) = &mut self.posterior else { return Ok(()) };
        let (own, branches) = (posterior.bound(&mut self.stepper), posterior.branches(pending));
        let is_hopeless = own > best + HOPELESS && claimed - own <= 0.5 * (own - best);
        if !(claimed - own <= leeway(claimed, best) || is_hopeless) {
            return Err(statement.refuse(format!(
                "the bound {claimed} is too high: for {} only {own} can be shown",
                self.whereabouts()
            )));
        }
        self.tally.left.add(branches - claimed.min(own));
        Ok(())
    }

    fn open_without_best(&self, statement: &Statement<'_>) -> Refusal {
        statement.refuse(format!("{} is left open, but with `best none` nothing may be", self.whereabouts()))
    }

    /// `f <value>`: a map that explains everything.
    fn map(&mut self, mut statement: Statement<'_>) -> Result<bool, Refusal> {
        if self.left() > 0 {
            return Err(statement.refuse(format!("{} is no complete map", self.whereabouts())));
        }
        let pending = self.stepper.map.pending();
        if self.header.closed_only && pending > 0 {
            return Err(statement.refuse(format!(
                "only closed maps count, and in {} {pending} gateways are pending",
                self.whereabouts()
            )));
        }
        match &self.header.objective {
            Objective::Preference(genus) => self.map_rank(&mut statement, *genus)?,
            Objective::Posterior(_) => self.map_cost(&mut statement)?,
        }
        statement.finish()?;
        self.tally.maps += 1;
        Ok(self.advance())
    }

    fn map_rank(&mut self, statement: &mut Statement<'_>, genus: GenusPlace) -> Result<(), Refusal> {
        let claimed = Rank::read(statement)?;
        let own = Rank::of(&mut self.stepper.map, &mut self.stepper.paths);
        if claimed != own {
            return Err(statement.refuse(format!(
                "{} has (f1, f2, f3) and genus {own}, the certificate says {claimed}",
                self.whereabouts()
            )));
        }
        if let Best::Rank([f1, f2, f3, g]) = self.header.best.value {
            let best = Rank { f1, f2, f3, genus: g };
            if genus.compare(&own, &best) == Ordering::Less {
                return Err(statement.refuse(format!("this map, {own}, is better than the best, {best}")));
            }
        } else {
            return Err(statement.refuse("here is a map, but the best is said to be none"));
        }
        let least = &mut self.tally.least;
        match least.first().map_or(Ordering::Less, |known| genus.compare(&own, known)) {
            Ordering::Less => *least = vec![own],
            Ordering::Equal if !least.contains(&own) => least.push(own),
            _ => {}
        }
        Ok(())
    }

    fn map_cost(&mut self, statement: &mut Statement<'_>) -> Result<(), Refusal> {
        let claimed = statement.number("a cost in nats")?;
        let Some(posterior) = &self.posterior else { return Ok(()) };
        let own = posterior.cost(&mut self.stepper);
        let best = if let Best::Cost(best) = self.header.best.value { best } else { claimed };
        // Of layouts bent out of all measure one or the other may find the lower minimum; both are hopeless.
        let is_hopeless = claimed.min(own) > best + HOPELESS;
        if !((claimed - own).abs() <= leeway(claimed, best) || is_hopeless) {
            return Err(statement
                .refuse(format!("{} costs {own} nats, the certificate says {claimed}", self.whereabouts())));
        }
        match self.header.best.value {
            Best::Cost(best) if claimed < best => {
                return Err(statement.refuse(format!("this map, {claimed}, is better than the best, {best}")));
            }
            Best::Cost(_) => {}
            _ => return Err(statement.refuse("here is a map, but the best is said to be none")),
        }
        let least = &mut self.tally.least_cost;
        *least = Some(least.map_or(claimed, |known| known.min(claimed)));
        self.tally.found.add(-claimed);
        Ok(())
    }

    /// `x`: no closed map can come of the node.
    fn turned_down(&mut self, statement: Statement<'_>) -> Result<bool, Refusal> {
        if !self.header.closed_only {
            return Err(statement.refuse("nodes are turned down only with `goal closed`"));
        }
        let (pending, travels) = (self.stepper.map.pending(), self.left());
        if pending <= 2 * travels {
            return Err(statement.refuse(format!(
                "{} can still be closed: {pending} gateways are pending, {travels} travels are left",
                self.whereabouts()
            )));
        }
        statement.finish()?;
        self.tally.turned_down += 1;
        Ok(self.advance())
    }
}
