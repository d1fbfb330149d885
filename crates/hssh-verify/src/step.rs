//! The recursive step: how a travel follows from a hypothesis, and which growths the axioms admit.

use hssh_topology::Axioms;

use crate::map::{Map, NONE};
use crate::paths::Paths;
use crate::route::Route;

/// Where the robot is: at a place, end `i` of the star it sees being end `i + rotation` of the place's star.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Position {
    pub(crate) place: usize,
    pub(crate) rotation: usize,
}

/// A successor of a hypothesis.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Choice {
    /// The exit was linked and the arrival is as predicted.
    Moved(Position),
    /// The arrival is a new place; its entry is linked to this end.
    New {
        /// The gateway by which the robot left.
        exit: usize,
    },
    /// The arrival is a known place.
    Closure {
        /// The gateway by which the robot left.
        exit: usize,
        /// The gateway by which it came in.
        gateway: usize,
        /// Where it then is.
        to: Position,
    },
}

impl Choice {
    /// Whether it was one of several possible growths.
    pub(crate) fn is_growth(self) -> bool {
        !matches!(self, Choice::Moved(_))
    }
}

/// The step, with the room it works in.
pub(crate) struct Stepper<'a> {
    pub(crate) route: &'a Route,
    pub(crate) axioms: Axioms,
    pub(crate) map: Map,
    pub(crate) paths: Paths,
    met: Vec<bool>,
}

impl<'a> Stepper<'a> {
    /// The map of the root: the first place alone.
    pub(crate) fn new(route: &'a Route, axioms: Axioms) -> Self {
        let mut map = Map::default();
        map.add_place(route.visits[0], route.shape(0), 0);
        Stepper { route, axioms, map, paths: Paths::default(), met: Vec::new() }
    }

    /// Appends the successors by travel `travel`, in order of choice.
    pub(crate) fn successors(&mut self, at: Position, travel: usize, into: &mut Vec<Choice>) {
        let (leg, arrival) = (&self.route.legs[travel], self.route.visits[travel + 1]);
        let place = self.map.places[at.place];
        let exit = place.first_end + (leg.exit + at.rotation) % self.route.shapes[place.shape].degree();
        let position_at = |map: &Map, end: usize| {
            let place = map.ends[end].place;
            let there = map.places[place];
            let rotation = self.route.anchored(arrival, leg.entry, there.shape, end - there.first_end);
            rotation.map(|rotation| Position { place, rotation })
        };
        let far = self.map.ends[exit].link;
        if far != NONE {
            into.extend(position_at(&self.map, far).map(Choice::Moved));
            return;
        }
        let new = Choice::New { exit };
        if self.admits(new, travel) {
            into.push(new);
        }
        for gateway in 0..self.map.ends.len() {
            if gateway == exit || !self.map.ends[gateway].is_pending() {
                continue;
            }
            if let Some(to) = position_at(&self.map, gateway) {
                let closure = Choice::Closure { exit, gateway, to };
                if self.admits(closure, travel) {
                    into.push(closure);
                }
            }
        }
    }

    /// Grows the map by a choice and says where the robot then is.
    pub(crate) fn grow(&mut self, choice: Choice, travel: usize) -> Position {
        match choice {
            Choice::Moved(to) => to,
            Choice::New { exit } => {
                let (place, first_end) = (self.map.places.len(), self.map.ends.len());
                self.map.add_place(self.route.visits[travel + 1], self.route.shape(travel + 1), travel + 1);
                self.map.link(exit, first_end + self.route.legs[travel].entry);
                Position { place, rotation: 0 }
            }
            Choice::Closure { exit, gateway, to } => {
                self.map.link(exit, gateway);
                to
            }
        }
    }

    /// Takes back the growth by a choice, which is the last one that was not taken back.
    pub(crate) fn retract(&mut self, choice: Choice) {
        match choice {
            Choice::Moved(_) => {}
            Choice::New { exit } => {
                self.map.unlink(exit, self.map.ends[exit].link);
                self.map.remove_last_place();
            }
            Choice::Closure { exit, gateway, .. } => self.map.unlink(exit, gateway),
        }
    }

    /// Whether the map grown by a choice satisfies the axioms, as the one before it does.
    fn admits(&mut self, choice: Choice, travel: usize) -> bool {
        self.grow(choice, travel);
        let admitted = match choice {
            Choice::Closure { gateway, .. } => self.admits_link(gateway),
            _ => self.axioms.max_places.is_none_or(|most| self.map.places.len() <= most as usize),
        } && self.admits_as_a_whole();
        self.retract(choice);
        admitted
    }

    /// The axioms that a link can break on the path that it lies on, and the genus.
    fn admits_link(&mut self, end: usize) -> bool {
        if self.axioms.no_circular_path || self.axioms.no_self_intersection {
            let (circular, met_twice) = self.walk_path_through(end);
            if (circular && self.axioms.no_circular_path) || (met_twice && self.axioms.no_self_intersection) {
                return false;
            }
        }
        self.axioms.max_genus.is_none_or(|most| self.map.genus() <= most as usize)
    }

    /// Whether the path through a linked end is circular, and whether it meets a place twice.
    fn walk_path_through(&mut self, end: usize) -> (bool, bool) {
        self.met.clear();
        self.met.resize(self.map.places.len(), false);
        let mut met_twice = false;
        for start in [end, self.map.ends[end].link] {
            let mut back = start;
            while back != NONE {
                let here = &self.map.ends[back];
                met_twice |= std::mem::replace(&mut self.met[here.place], true);
                back = self.map.ends[here.opposite].link;
                if back == start {
                    return (true, met_twice);
                }
            }
        }
        (false, met_twice)
    }

    /// The axioms that are looked at from scratch: those on how paths lie to one another.
    fn admits_as_a_whole(&mut self) -> bool {
        if !self.axioms.perpendicular && !self.axioms.consistent_boundaries {
            return true;
        }
        self.paths.trace(&self.map);
        if self.axioms.perpendicular && !self.paths.are_perpendicular() {
            return false;
        }
        if self.axioms.consistent_boundaries {
            self.paths.find_sides(&self.map);
            return self.paths.have_consistent_sides();
        }
        true
    }
}
