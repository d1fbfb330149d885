//! What every search is given: what to explain, under which rules, and who helps.

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

    /// Why the search has to stop now, if it has to.
    pub(crate) fn stop(&self, tree: &Tree, more_bytes: u64) -> Option<StopReason> {
        let excess = || self.watch.excess(tree.len() as u64, tree.bytes() + more_bytes);
        self.watch.interruption().or_else(excess)
    }
}
