//! Which gateway the robot takes: somebody with the whole map decides.

use std::collections::{BTreeSet, VecDeque};

use hssh_local::{PlaceGraph, PlaceNumber};
use hssh_topology::Olp;
use rand::seq::IndexedRandom;
use rand_chacha::ChaCha8Rng;

/// Which gateway the robot takes at each place.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Strategy {
    /// A way that was not travelled yet, else the fewest travels to one; it ends when all were travelled.
    Cover,
    /// Any way but back, unless there is no other.
    Wander,
    /// To these places in turn, each next to the one before.
    Visit(Vec<PlaceNumber>),
}

/// A gateway by which the robot should leave, and where it should come out.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Plan {
    pub(super) exit: Olp,
    pub(super) to: (PlaceNumber, Olp),
}

/// A strategy at work.
pub(super) struct Guide<'a> {
    graph: &'a PlaceGraph,
    strategy: Strategy,
    /// The connections that were travelled.
    travelled: BTreeSet<usize>,
    /// How many places of the list were visited.
    visited: usize,
}

impl<'a> Guide<'a> {
    pub(super) fn new(graph: &'a PlaceGraph, strategy: Strategy) -> Self {
        Guide { graph, strategy, travelled: BTreeSet::new(), visited: 0 }
    }

    /// The way on from a place that the robot entered by `entry`; none if it is done, or if no way leads on.
    pub(super) fn next(
        &mut self,
        here: PlaceNumber,
        entry: Option<Olp>,
        random: &mut ChaCha8Rng,
    ) -> Option<Plan> {
        let ways: Vec<(usize, Plan)> = self.ways(here).collect();
        let chosen = match &self.strategy {
            Strategy::Cover => {
                let new: Vec<_> =
                    ways.iter().filter(|(way, _)| !self.travelled.contains(way)).copied().collect();
                new.choose(random).copied().or_else(|| self.toward_new(here))
            }
            Strategy::Wander => {
                let onward: Vec<_> =
                    ways.iter().filter(|(_, plan)| Some(plan.exit) != entry).copied().collect();
                onward.choose(random).or(ways.first()).copied()
            }
            Strategy::Visit(list) => {
                if list.get(self.visited) == Some(&here) {
                    self.visited += 1;
                }
                let next = list.get(self.visited)?;
                ways.iter().find(|(_, plan)| plan.to.0 == *next).copied()
            }
        };
        let (way, plan) = chosen?;
        self.travelled.insert(way);
        Some(plan)
    }

    /// Whether the strategy has come to its end.
    pub(super) fn is_done(&self) -> bool {
        match &self.strategy {
            Strategy::Cover => true, // as far as ways lead
            Strategy::Wander => false,
            Strategy::Visit(list) => self.visited >= list.len(),
        }
    }

    /// The connections of a place with their numbers.
    fn ways(&self, here: PlaceNumber) -> impl Iterator<Item = (usize, Plan)> + '_ {
        self.graph.connections.iter().enumerate().flat_map(move |(way, connection)| {
            let [from, to] = connection.ends;
            let both = [(from, to), (to, from)].into_iter().filter(move |(from, _)| from.0 == here);
            both.map(move |(from, to)| (way, Plan { exit: from.1, to }))
        })
    }

    /// The first travel of the fewest to a place with an untravelled connection.
    fn toward_new(&self, here: PlaceNumber) -> Option<(usize, Plan)> {
        let mut reached = BTreeSet::from([here]);
        let mut waiting: VecDeque<(PlaceNumber, Option<(usize, Plan)>)> = VecDeque::from([(here, None)]);
        while let Some((place, first)) = waiting.pop_front() {
            for (way, plan) in self.ways(place) {
                let first = first.or(Some((way, plan)));
                if !self.travelled.contains(&way) {
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
