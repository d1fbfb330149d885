//! Which gateway the robot takes: somebody with the whole map decides.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use hssh_local::{PlaceGraph, PlaceNumber};
use hssh_topology::Olp;
use rand::seq::IndexedRandom;
use rand_chacha::ChaCha8Rng;

/// Which gateway the robot takes at each place.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Strategy {
    /// A way that was not travelled yet, else the fewest travels to one; it ends when all were travelled but those
    /// that led elsewhere than the map says, twice. Where the robot does not see a way that the map has, twice, it does not
    /// come back for it, and all is done only if it was travelled from its other end.
    Cover,
    /// Any way but back, unless there is no other.
    Wander,
    /// To these places in turn, each next to the one before.
    Visit(Vec<PlaceNumber>),
}

/// A connection that led elsewhere so often is taken for none.
const MOST_MISSES: usize = 2;

/// A gateway by which the robot should leave, and where it should come out.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Plan {
    /// The connection, by its number in the map.
    pub(super) way: usize,
    pub(super) exit: Olp,
    pub(super) to: (PlaceNumber, Olp),
}

/// A strategy at work.
pub(super) struct Guide<'a> {
    graph: &'a PlaceGraph,
    strategy: Strategy,
    /// The connections that were travelled.
    travelled: BTreeSet<usize>,
    /// How often connections led elsewhere.
    missed: BTreeMap<usize, usize>,
    /// How often the robot was at an end of a connection and did not see it.
    unseen: BTreeMap<(PlaceNumber, Olp), usize>,
    /// How many places of the list were visited.
    visited: usize,
}

impl<'a> Guide<'a> {
    pub(super) fn new(graph: &'a PlaceGraph, strategy: Strategy) -> Self {
        Guide {
            graph,
            strategy,
            travelled: BTreeSet::new(),
            missed: BTreeMap::new(),
            unseen: BTreeMap::new(),
            visited: 0,
        }
    }

    /// The way on from a place that the robot entered by `entry`, of those whose exits it sees; none if it is
    /// done, or if no way leads on.
    pub(super) fn next(
        &mut self,
        here: PlaceNumber,
        entry: Option<Olp>,
        is_seen: impl Fn(Olp) -> bool,
        random: &mut ChaCha8Rng,
    ) -> Option<Plan> {
        let (ways, hidden): (Vec<Plan>, Vec<Plan>) = self.ways(here).partition(|plan| is_seen(plan.exit));
        for plan in hidden {
            *self.unseen.entry((here, plan.exit)).or_default() += 1;
        }
        let chosen = match &self.strategy {
            Strategy::Cover => {
                let new: Vec<Plan> =
                    ways.iter().filter(|plan| !self.travelled.contains(&plan.way)).copied().collect();
                new.choose(random).copied().or_else(|| self.toward_new(here, &ways))
            }
            Strategy::Wander => {
                let onward: Vec<Plan> =
                    ways.iter().filter(|plan| Some(plan.exit) != entry).copied().collect();
                onward.choose(random).or(ways.first()).copied()
            }
            Strategy::Visit(list) => {
                if list.get(self.visited) == Some(&here) {
                    self.visited += 1;
                }
                let next = list.get(self.visited)?;
                ways.iter().find(|plan| plan.to.0 == *next).copied()
            }
        };
        self.travelled.extend(chosen.map(|plan| plan.way));
        chosen
    }

    /// Takes note that the robot came to another place than it meant to.
    pub(super) fn miss(&mut self, plan: Plan) {
        *self.missed.entry(plan.way).or_default() += 1;
    }

    /// Whether the strategy has come to its end, the robot being here.
    pub(super) fn is_done(&self, here: PlaceNumber) -> bool {
        match &self.strategy {
            Strategy::Cover => {
                let ways: Vec<Plan> = self.ways(here).collect();
                self.toward_new(here, &ways).is_none() && !self.gave_up()
            }
            Strategy::Wander => false,
            Strategy::Visit(list) => self.visited >= list.len(),
        }
    }

    /// How many connections were not travelled yet, or places of the list not visited, the robot having come here last;
    /// none if no number of travels was asked for.
    pub(super) fn left(&self, here: Option<PlaceNumber>) -> usize {
        match &self.strategy {
            Strategy::Cover => self.graph.connections.len() - self.travelled.len(),
            Strategy::Wander => 0,
            Strategy::Visit(list) => {
                let is_next = here.is_some() && list.get(self.visited).copied() == here;
                list.len() - self.visited - usize::from(is_next)
            }
        }
    }

    /// Whether a connection was not travelled because the robot did not see it.
    fn gave_up(&self) -> bool {
        let is_given_up = |end: (PlaceNumber, Olp)| self.is_hidden(end);
        let connections = self.graph.connections.iter().enumerate();
        let mut untravelled = connections.filter(|(way, _)| !self.travelled.contains(way));
        untravelled.any(|(_, connection)| connection.ends.into_iter().any(is_given_up))
    }

    /// Whether the robot was at an end of a connection often enough without seeing it.
    fn is_hidden(&self, end: (PlaceNumber, Olp)) -> bool {
        self.unseen.get(&end).is_some_and(|&often| often >= MOST_MISSES)
    }

    /// The connections of a place, but for those that led elsewhere too often, or were not seen too often.
    fn ways(&self, here: PlaceNumber) -> impl Iterator<Item = Plan> + '_ {
        let is_there = |way: &usize| self.missed.get(way).is_none_or(|&missed| missed < MOST_MISSES);
        let connections = self.graph.connections.iter().enumerate().filter(move |(way, _)| is_there(way));
        connections.flat_map(move |(way, connection)| {
            let [from, to] = connection.ends;
            let both = [(from, to), (to, from)].into_iter().filter(move |(from, _)| from.0 == here);
            let seen = both.filter(move |(from, _)| !self.is_hidden(*from));
            seen.map(move |(from, to)| Plan { way, exit: from.1, to })
        })
    }

    /// Of some ways from here the first travel of the fewest to a place with an untravelled connection.
    fn toward_new(&self, here: PlaceNumber, ways: &[Plan]) -> Option<Plan> {
        let mut reached = BTreeSet::from([here]);
        let mut waiting: VecDeque<(PlaceNumber, Option<Plan>)> = VecDeque::from([(here, None)]);
        while let Some((place, first)) = waiting.pop_front() {
            let onward = if place == here { ways.to_vec() } else { self.ways(place).collect() };
            for plan in onward {
                let first = first.or(Some(plan));
                if !self.travelled.contains(&plan.way) {
                    return first;
                }
                if reached.insert(plan.to.0) {
                    waiting.push_back((plan.to.0, first));
                }
            }
        }
        None
    }
}
