//! What every search is given: what to explain, under which rules, and who helps.

use std::time::Duration;

use hssh_topology::Axioms;

use crate::crew::Crew;
use crate::experience::Experience;
use crate::limits::{StopReason, Watch};
use crate::tree::Tree;

/// The task of a search and its means.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Context<'a> {
    pub(crate) experience: &'a Experience,
    pub(crate) axioms: &'a Axioms,
    pub(crate) crew: &'a Crew,
    pub(crate) watch: &'a Watch,
}

impl Context<'_> {
    /// How many travels are to be explained.
    pub(crate) fn travels(&self) -> usize {
        self.experience.observations.len()
    }

    /// Does work on items in a row, and returns what came of them in that order: all of it here, or shared with the other processes, if there
    /// are any and enough items for each, one of which takes about so much time. `request` says what to do with those items, and `hear` what the answer means.
    ///
    /// What comes of the items does not depend on who does it. If a process is lost, its share is done here, and the search stops soon.
    pub(crate) fn share<T, R>(
        &self,
        items: &[T],
        time: Duration,
        request: impl Fn(&[T]) -> Vec<u8>,
        mut here: impl FnMut(&[T]) -> Vec<R>,
        hear: impl Fn(&[T], &[u8]) -> Option<Vec<R>>,
    ) -> Vec<R> {
        let Some(helpers) = self.crew.helpers().filter(|helpers| helpers.count() > 0) else {
            return here(items);
        };
        let least = (helpers.least_work().div_duration_f64(time).ceil() as usize).max(1);
        if items.len() < 2 * least {
            return here(items);
        }
        let share = items.len().div_ceil(helpers.count() + 1).max(least);
        let (own, given) = items.split_at(share);
        let shares: Vec<&[T]> = given.chunks(share).collect();
        let requests = shares.iter().map(|share| request(share)).collect();
        let mut own_done = None;
        let answers = helpers.ask(requests, &mut || own_done = Some(here(own)));
        let mut done = own_done.unwrap_or_else(|| here(own));
        let heard: Option<Vec<Vec<R>>> = answers.and_then(|answers| {
            shares.iter().zip(answers).map(|(share, answer)| hear(share, &answer)).collect()
        });
        match heard {
            Some(heard) => done.extend(heard.into_iter().flatten()),
            None => {
                self.watch.interrupt();
                done.extend(here(given));
            }
        }
        done
    }

    /// Why the search has to stop now, if it has to.
    pub(crate) fn stop(&self, tree: &Tree, more_bytes: u64) -> Option<StopReason> {
        let excess = || self.watch.excess(tree.len() as u64, tree.bytes() + more_bytes);
        self.watch.interruption().or_else(excess)
    }
}
