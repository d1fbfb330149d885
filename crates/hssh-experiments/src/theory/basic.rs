//! The hypotheses of the basic SSH, which knows no stars, as models of the theory.

use std::time::Instant;

use hssh_causal::schema::{Action, Trace};

use super::model::{Model, Moment, firsts};
use crate::causal::{History, histories};

/// All hypotheses that explain a trace, and the seconds that it took to find them; `None` if there are more than `most`
/// on the way.
pub(super) fn models(trace: &Trace, most: usize) -> Option<(Vec<Model>, f64)> {
    let started = Instant::now();
    let histories = histories(trace, most)?;
    let seconds = started.elapsed().as_secs_f64();
    let actions: Vec<Action> = trace.steps().iter().map(|step| step.action).collect();
    Some((histories.iter().map(|history| model(history, &actions)).collect(), seconds))
}

/// How many schemas of a trace are explained before there are more than so many hypotheses.
pub(super) fn tractable(trace: &Trace, most: usize) -> usize {
    let fits = |schemas: &usize| histories(&prefix(trace, *schemas), most).is_some();
    (1..=trace.steps().len()).take_while(fits).last().unwrap_or(0)
}

/// The first schemas of a trace.
pub(super) fn prefix(trace: &Trace, schemas: usize) -> Trace {
    Trace::new(trace.view(0).clone(), trace.steps()[..schemas].to_vec())
}

fn model(history: &History, actions: &[Action]) -> Model {
    let (states, places): (Vec<_>, Vec<_>) = history.iter().copied().unzip();
    let arrivals = (1..).zip(actions).filter(|(_, action)| action.is_travel()).map(|(moment, _)| moment);
    let opens: Vec<Moment> = std::iter::once(0).chain(arrivals).collect();
    let first_at = firsts(&places);
    Model {
        states: (0..).zip(firsts(&states)).collect(),
        places: opens.into_iter().map(|moment| (moment, first_at[moment as usize])).collect(),
        ..Model::default()
    }
}
