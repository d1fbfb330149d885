//! A map of the basic SSH: distinctive states, and what turns and travels say of them (section 2.3.3).

use hssh_causal::schema::Action;

/// A distinctive state of one hypothesis, numbered in the order of creation.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct StateId(u32);

/// A place of one hypothesis, numbered in the order of creation.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct PlaceId(u32);

/// What the robot sees in a distinctive state, and whether it can leave that way.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Glance {
    /// Which view.
    pub(super) view: u32,
    /// Whether what is ahead can be travelled.
    pub(super) travelable: bool,
}

/// A distinctive state, and where actions lead from it as far as the hypothesis says.
#[derive(Clone, Copy, PartialEq, Debug)]
struct State {
    place: PlaceId,
    glance: Glance,
    /// Turning one position clockwise.
    next: Option<StateId>,
    /// Whose `next` this is.
    previous: Option<StateId>,
    /// Turning around.
    opposite: Option<StateId>,
    /// Travelling.
    travel: Option<StateId>,
    /// Whose `travel` this is.
    origin: Option<StateId>,
}

/// A contradiction: the hypothesis is refuted.
#[derive(Debug)]
struct Refuted;

/// ⟨map, current distinctive state⟩ without stars: how many oriented local paths a place has is known only
/// once turning has come full circle, and which two make a local path only once the robot turned around.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Hypothesis {
    states: Vec<State>,
    /// For each place: whether its circle of states is complete.
    complete: Vec<bool>,
    here: StateId,
}

impl Hypothesis {
    /// One state at one place.
    pub(super) fn root(glance: Glance) -> Self {
        let mut hypothesis = Hypothesis { states: Vec::new(), complete: vec![false], here: StateId(0) };
        hypothesis.add(PlaceId(0), glance);
        hypothesis
    }

    /// Where the robot is: its distinctive state, and that one's place.
    pub(super) fn here(&self) -> (StateId, PlaceId) {
        (self.here, self.at(self.here).place)
    }

    /// All hypotheses that extend this one by an action and what the robot saw after it.
    ///
    /// A known outcome is confirmed or refuted. An unknown one may be any known state that looks the same, or a
    /// state not met before: after a turn one at this place, after a travel one at any place whose circle is not
    /// complete, or at a new place.
    pub(super) fn step(&self, action: Action, glance: Glance) -> Vec<Hypothesis> {
        let here = self.at(self.here);
        let known = match action {
            Action::Turn { .. } => here.next,
            Action::TurnAround => here.opposite,
            Action::Travel => here.travel,
        };
        if let Some(known) = known {
            let confirmed = self.at(known).glance == glance;
            return confirmed.then(|| Hypothesis { here: known, ..self.clone() }).into_iter().collect();
        }
        // Turns stay at the place, travels leave it.
        let may_be_at = |place: PlaceId| (place == here.place) != action.is_travel();
        let may_be = |state: &State| state.glance == glance && may_be_at(state.place);
        let alike = self.ids().filter(|&state| may_be(self.at(state)));
        let old = alike.filter_map(|state| self.clone().leading(action, state));
        let incomplete = (0..).zip(&self.complete).filter(|(_, complete)| !**complete);
        let open = incomplete.map(|(place, _)| PlaceId(place)).filter(|&place| may_be_at(place));
        let fresh = action.is_travel().then_some(PlaceId(self.complete.len() as u32));
        let new = open.chain(fresh).filter_map(|place| {
            let mut grown = self.clone();
            if fresh == Some(place) {
                grown.complete.push(false);
            }
            let state = grown.add(place, glance);
            grown.leading(action, state)
        });
        old.chain(new).collect()
    }

    /// The same hypothesis with the robot in `state`, where the action has led it; `None` if that cannot be.
    fn leading(mut self, action: Action, state: StateId) -> Option<Self> {
        let here = self.here;
        let linked = match action {
            Action::Turn { .. } => self.link_next(here, state),
            Action::TurnAround => self.link_opposite(here, state),
            Action::Travel => self.link_travel(here, state),
        };
        self.here = state;
        (linked.is_ok() && self.paths_meet_places_once()).then_some(self)
    }

    fn ids(&self) -> impl Iterator<Item = StateId> + use<> {
        (0..self.states.len() as u32).map(StateId)
    }

    fn at(&self, state: StateId) -> &State {
        &self.states[state.0 as usize]
    }

    fn at_mut(&mut self, state: StateId) -> &mut State {
        &mut self.states[state.0 as usize]
    }

    fn add(&mut self, place: PlaceId, glance: Glance) -> StateId {
        let (next, previous, opposite, travel, origin) = (None, None, None, None, None);
        self.states.push(State { place, glance, next, previous, opposite, travel, origin });
        StateId(self.states.len() as u32 - 1)
    }

    /// Turning clockwise from `from` the robot next faces `to`. A circle that closes holds all states of its
    /// place, and an even number of them, since every local path has two ends.
    fn link_next(&mut self, from: StateId, to: StateId) -> Result<(), Refuted> {
        let place = self.at(from).place;
        if self.at(to).place != place || self.at(to).previous.is_some() {
            return Err(Refuted);
        }
        self.at_mut(from).next = Some(to);
        self.at_mut(to).previous = Some(from);
        let mut around = to;
        let mut turns = 1;
        while let Some(next) = self.at(around).next {
            if around == from {
                let all = self.states.iter().filter(|state| state.place == place).count();
                self.complete[place.0 as usize] = true;
                return if turns == all && all % 2 == 0 { Ok(()) } else { Err(Refuted) };
            }
            around = next;
            turns += 1;
        }
        Ok(())
    }

    /// Two states look along one local path in opposite directions.
    fn link_opposite(&mut self, one: StateId, other: StateId) -> Result<(), Refuted> {
        if self.at(one).opposite == Some(other) {
            return Ok(());
        }
        let is_free = |state: StateId| self.at(state).opposite.is_none();
        if one == other || self.at(one).place != self.at(other).place || !is_free(one) || !is_free(other) {
            return Err(Refuted);
        }
        self.at_mut(one).opposite = Some(other);
        self.at_mut(other).opposite = Some(one);
        for state in [one, other] {
            if let Some(to) = self.at(state).travel {
                self.reverse(state, to)?;
            }
            if let Some(origin) = self.at(state).origin {
                self.reverse(origin, state)?;
            }
        }
        Ok(())
    }

    /// Travelling from `from` leads to `to`, at another place.
    fn link_travel(&mut self, from: StateId, to: StateId) -> Result<(), Refuted> {
        if self.at(from).travel == Some(to) {
            return Ok(());
        }
        let is_free = self.at(from).travel.is_none() && self.at(to).origin.is_none();
        if !is_free || self.at(from).place == self.at(to).place || !self.at(from).glance.travelable {
            return Err(Refuted);
        }
        self.at_mut(from).travel = Some(to);
        self.at_mut(to).origin = Some(from);
        self.reverse(from, to)
    }

    /// What a travel says of the way back: who turns around, travels and turns around is where it began.
    fn reverse(&mut self, from: StateId, to: StateId) -> Result<(), Refuted> {
        let (back_home, back_out) = (self.at(from).opposite, self.at(to).opposite);
        if back_out.is_some_and(|out| !self.at(out).glance.travelable) {
            return Err(Refuted);
        }
        match (back_out, back_home) {
            (Some(out), Some(home)) => self.link_travel(out, home),
            (Some(out), None) => self.at(out).travel.map_or(Ok(()), |home| self.link_opposite(from, home)),
            (None, Some(home)) => self.at(home).origin.map_or(Ok(()), |out| self.link_opposite(to, out)),
            (None, None) => Ok(()),
        }
    }

    /// Axioms 1 and 2: going straight on never comes back to a place.
    fn paths_meet_places_once(&self) -> bool {
        self.ids().all(|start| {
            let onward = std::iter::successors(self.at(start).travel, |&state| self.at(state).travel);
            let mut met = vec![self.at(start).place];
            for state in onward {
                let place = self.at(state).place;
                if met.contains(&place) {
                    return false;
                }
                met.push(place);
            }
            true
        })
    }
}
