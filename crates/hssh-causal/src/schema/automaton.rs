//! The view graph as a deterministic automaton: which moments may be one distinctive state (section 2.1.2).

use std::collections::BTreeMap;

use super::{Action, Trace, View};

/// A distinctive state of an [`Automaton`], numbered in the order of first visits.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct StateId(pub u32);

impl StateId {
    /// The state as an index.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Distinctive states with their views, and where actions lead: at most one state for each action.
#[derive(Clone, PartialEq, Debug)]
pub struct Automaton {
    views: Vec<View>,
    state_of: Vec<StateId>,
    transitions: BTreeMap<(StateId, Action), StateId>,
}

/// Why moments cannot be the same distinctive state. Numbers count from 0, the text counts from 1.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Refutation {
    /// Two moments that were assumed to be the same state have different views. The moments, in order.
    #[error("moments {} and {} have different views", .0 + 1, .1 + 1)]
    Views(usize, usize),
    /// Two schemas do the same action in what would be the same state, but what they lead to differs. The
    /// schemas, in order.
    #[error(
        "schemas {} and {} do the same in what would be one state, but lead to different views", .0 + 1, .1 + 1
    )]
    Schemas(usize, usize),
}

impl Automaton {
    /// The automaton in which moments with equal keys are the same state, unless the trace refutes that.
    ///
    /// Being back in an earlier state predicts what the same actions lead to: moments that follow by the same
    /// action are joined as well, so that the automaton may have fewer states than there are keys.
    ///
    /// # Errors
    /// The first contradiction met: states joined in order, their consequences after each.
    pub fn from_partition<K: Ord>(trace: &Trace, key: impl Fn(usize) -> K) -> Result<Self, Refutation> {
        let mut first: BTreeMap<K, usize> = BTreeMap::new();
        let mut same = Vec::new();
        for moment in 0..trace.views().len() {
            let &mut earlier = first.entry(key(moment)).or_insert(moment);
            if earlier < moment {
                same.push((earlier, moment));
            }
        }
        Automaton::assuming(trace, &same)
    }

    /// The automaton with as many states as possible in which the given pairs of moments are the same state,
    /// unless the trace refutes that. No assumption is never refuted: then every moment is a state.
    ///
    /// # Errors
    /// The first contradiction met: pairs joined in order, their consequences after each.
    ///
    /// # Panics
    /// If there is no such moment.
    pub fn assuming(trace: &Trace, same: &[(usize, usize)]) -> Result<Self, Refutation> {
        let mut merging = Merging::new(trace);
        for &(one, other) in same {
            merging.join(one, other)?;
        }
        Ok(merging.automaton())
    }

    /// The views of the states, in the order of their numbers.
    #[must_use]
    pub fn views(&self) -> &[View] {
        &self.views
    }

    /// The state of a moment of the trace.
    ///
    /// # Panics
    /// If the trace is over by then.
    #[must_use]
    pub fn state(&self, moment: usize) -> StateId {
        self.state_of[moment]
    }

    /// All transitions that the trace has made: state, action, and the state it leads to.
    pub fn transitions(&self) -> impl ExactSizeIterator<Item = (StateId, Action, StateId)> + '_ {
        self.transitions.iter().map(|(&(from, action), &to)| (from, action, to))
    }

    /// Where an action leads, if it has been done in that state.
    #[must_use]
    pub fn predict(&self, state: StateId, action: Action) -> Option<StateId> {
        self.transitions.get(&(state, action)).copied()
    }
}

/// Moments being joined to states: a disjoint-set forest closed under actions.
struct Merging<'a> {
    trace: &'a Trace,
    parent: Vec<usize>,
    /// For the root of each state: a schema for each action done in it.
    done: Vec<BTreeMap<Action, usize>>,
}

impl<'a> Merging<'a> {
    fn new(trace: &'a Trace) -> Self {
        let mut done: Vec<BTreeMap<Action, usize>> = trace
            .steps()
            .iter()
            .enumerate()
            .map(|(schema, step)| BTreeMap::from([(step.action, schema)]))
            .collect();
        done.push(BTreeMap::new());
        Merging { trace, parent: (0..done.len()).collect(), done }
    }

    fn root(&mut self, moment: usize) -> usize {
        let mut root = moment;
        while self.parent[root] != root {
            self.parent[root] = self.parent[self.parent[root]];
            root = self.parent[root];
        }
        root
    }

    /// Takes two moments for the same state, and with them all that follow by the same actions.
    fn join(&mut self, one: usize, other: usize) -> Result<(), Refutation> {
        let mut pending = vec![(one, other, Refutation::Views(one.min(other), one.max(other)))];
        while let Some((one, other, reason)) = pending.pop() {
            let (one, other) = (self.root(one), self.root(other));
            if one == other {
                continue;
            }
            if self.trace.view(one) != self.trace.view(other) {
                return Err(reason);
            }
            let (kept, gone) =
                if self.done[one].len() < self.done[other].len() { (other, one) } else { (one, other) };
            self.parent[gone] = kept;
            for (action, schema) in std::mem::take(&mut self.done[gone]) {
                let known = *self.done[kept].entry(action).or_insert(schema);
                if known != schema {
                    let reason = Refutation::Schemas(known.min(schema), known.max(schema));
                    pending.push((known + 1, schema + 1, reason));
                }
            }
        }
        Ok(())
    }

    fn automaton(mut self) -> Automaton {
        let moments = self.parent.len();
        let mut number: BTreeMap<usize, StateId> = BTreeMap::new();
        let mut views = Vec::new();
        let mut state_of = Vec::with_capacity(moments);
        for moment in 0..moments {
            let next = StateId(number.len() as u32);
            let state = *number.entry(self.root(moment)).or_insert_with(|| {
                views.push(self.trace.view(moment).clone());
                next
            });
            state_of.push(state);
        }
        let steps = self.trace.steps().iter().enumerate();
        let transitions =
            steps.map(|(from, step)| ((state_of[from], step.action), state_of[from + 1])).collect();
        Automaton { views, state_of, transitions }
    }
}
