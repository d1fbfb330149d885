//! What open accounts carry along, as plain data: states and the steps that led to them, which accounts share, are written once.

use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

use hssh_topology::{Axioms, TopologicalMap, Way};
use serde::ser::SerializeTuple;
use serde::{Deserialize, Serialize, Serializer};

use crate::pack::Pack;
use crate::posterior::{Cost, Nats};
use crate::reading::by_reading::{Burden, ByReading, Stage};
use crate::reading::state::{Passage, State, Trace};

/// A step, and the number of the one before it.
type Traced<P> = (Option<u32>, P);

/// The states of accounts, and the steps that led to them.
pub(crate) struct States<'a> {
    /// Each after the one before it.
    traces: Vec<Traced<&'a Passage>>,
    states: Vec<(&'a State, Option<u32>)>,
    /// Numbers, by where something is in memory.
    number_of_trace: HashMap<*const Trace, u32>,
    number_of_state: HashMap<*const State, u32>,
}

impl<'a> States<'a> {
    /// Takes in a state that was not seen before.
    fn add(&mut self, state: &'a Arc<State>) {
        let next = self.states.len() as u32;
        if *self.number_of_state.entry(Arc::as_ptr(state)).or_insert(next) == next {
            let trace = self.add_trace(state.trace.as_ref());
            self.states.push((state, trace));
        }
    }

    /// The number of a step; those before it that were not seen before are taken in with it.
    fn add_trace(&mut self, last: Option<&'a Arc<Trace>>) -> Option<u32> {
        let mut new = Vec::new();
        let mut trace = last;
        let mut before = None;
        while let Some(known) = trace {
            before = self.number_of_trace.get(&Arc::as_ptr(known)).copied();
            if before.is_some() {
                break;
            }
            new.push(known);
            trace = known.before.as_ref();
        }
        for trace in new.into_iter().rev() {
            let number = self.traces.len() as u32;
            self.traces.push((before, &trace.step));
            self.number_of_trace.insert(Arc::as_ptr(trace), number);
            before = Some(number);
        }
        before
    }
}

/// All steps, then all states.
impl Serialize for States<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut both = serializer.serialize_tuple(2)?;
        both.serialize_element(&self.traces)?;
        both.serialize_element(&self.states)?;
        both.end()
    }
}

/// A state that was read, and the map that its chart makes, once somebody asks.
struct ReadState {
    state: Arc<State>,
    map: OnceLock<Option<Arc<TopologicalMap>>>,
}

/// The states as they are read; nothing for one that refers to what is not there.
#[derive(Deserialize)]
#[serde(from = "(Vec<Traced<Passage>>, Vec<(State, Option<u32>)>)")]
pub(crate) struct ReadStates(Vec<Option<ReadState>>);

impl From<(Vec<Traced<Passage>>, Vec<(State, Option<u32>)>)> for ReadStates {
    fn from((steps, states): (Vec<Traced<Passage>>, Vec<(State, Option<u32>)>)) -> Self {
        let mut traces: Vec<Arc<Trace>> = Vec::with_capacity(steps.len());
        let find = |traces: &[Arc<Trace>], number: Option<u32>| match number {
            Some(number) => traces.get(number as usize).cloned().map(Some),
            None => Some(None),
        };
        for (before, step) in steps {
            let Some(before) = find(&traces, before) else { return ReadStates(Vec::new()) };
            traces.push(Arc::new(Trace { before, step }));
        }
        let state = |(mut state, trace): (State, Option<u32>)| {
            state.trace = find(&traces, trace)?;
            let travels = std::iter::successors(state.trace.as_ref(), |trace| trace.before.as_ref()).count();
            state.is_sound(travels).then(|| ReadState { state: Arc::new(state), map: OnceLock::new() })
        };
        ReadStates(states.into_iter().map(state).collect())
    }
}

impl ReadStates {
    fn get(&self, number: u32) -> Option<&ReadState> {
        self.0.get(number as usize)?.as_ref()
    }
}

/// What an account carries, its state by number.
#[derive(Serialize, Deserialize)]
pub(crate) struct PackedBurden {
    cost: Cost,
    bound: Nats,
    promised: f64,
    spelled: Nats,
    stage: PackedStage,
}

#[derive(Serialize, Deserialize)]
enum PackedStage {
    Done(u32),
    Sketched(u32, Way),
    Impossible,
}

impl Pack for ByReading {
    type Shared<'a> = States<'a>;
    type Read = ReadStates;
    type Packed = PackedBurden;

    fn share<'a>(loads: impl Iterator<Item = &'a Burden>) -> States<'a> {
        let mut states = States {
            traces: Vec::new(),
            states: Vec::new(),
            number_of_trace: HashMap::new(),
            number_of_state: HashMap::new(),
        };
        for burden in loads {
            match &burden.stage {
                Stage::Done(state, _) | Stage::Sketched(state, _) => states.add(state),
                Stage::Impossible => {}
            }
        }
        states
    }

    fn pack(burden: &Burden, states: &States<'_>) -> PackedBurden {
        let Burden { cost, bound, promised, spelled, ref stage } = *burden;
        let number = |state: &Arc<State>| states.number_of_state[&Arc::as_ptr(state)];
        let stage = match stage {
            Stage::Done(state, _) => PackedStage::Done(number(state)),
            Stage::Sketched(state, way) => PackedStage::Sketched(number(state), Way::clone(way)),
            Stage::Impossible => PackedStage::Impossible,
        };
        PackedBurden { cost, bound, promised, spelled, stage }
    }

    fn unpack(packed: PackedBurden, read: &ReadStates, axioms: &Axioms) -> Option<Burden> {
        let PackedBurden { cost, bound, promised, spelled, stage } = packed;
        let stage = match stage {
            PackedStage::Done(number) => {
                let ReadState { state, map } = read.get(number)?;
                let map = map.get_or_init(|| state.account.chart.map(axioms).map(Arc::new)).clone()?;
                Stage::Done(Arc::clone(state), map)
            }
            PackedStage::Sketched(number, way) => {
                Stage::Sketched(Arc::clone(&read.get(number)?.state), Arc::new(way))
            }
            PackedStage::Impossible => Stage::Impossible,
        };
        Some(Burden { cost, bound, promised, spelled, stage })
    }
}
