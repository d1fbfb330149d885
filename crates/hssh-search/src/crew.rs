//! The threads that expand a frontier together, each with a cursor of its own.

use std::sync::Mutex;

use hssh_topology::{Derivation, Extension, Hypothesis, Removals};
use rayon::prelude::*;

use crate::context::Context;
use crate::experience::Experience;
use crate::tree::{Child, Cursor, NodeId, Outcome, Tree};

/// A pool of threads, and of cursors that wait where they were used last.
///
/// Work is cut into pieces that do not depend on the number of threads, and results come back in
/// the order of the pieces: so does everything made of them.
#[derive(Debug)]
pub(crate) struct Crew {
    pool: rayon::ThreadPool,
    cursors: Mutex<Vec<Cursor>>,
}

impl Crew {
    /// That many threads; 0 for one per core.
    ///
    /// # Errors
    /// If the operating system gives no threads.
    pub(crate) fn new(threads: usize) -> Result<Self, rayon::ThreadPoolBuildError> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        Ok(Crew { pool, cursors: Mutex::new(Vec::new()) })
    }

    /// Applies `work` to each piece, each time with a cursor; the results in the order of the pieces.
    pub(crate) fn map<T: Sync, R: Send>(
        &self,
        pieces: &[T],
        experience: &Experience,
        work: impl Fn(&mut Cursor, &T) -> R + Sync,
    ) -> Vec<R> {
        let on_one = |piece: &T| {
            let waiting = self.waiting().pop();
            let mut cursor = waiting.unwrap_or_else(|| Cursor::new(experience));
            let result = work(&mut cursor, piece);
            self.waiting().push(cursor);
            result
        };
        if let [piece] = pieces {
            return vec![on_one(piece)];
        }
        self.pool.install(|| pieces.par_iter().map(on_one).collect())
    }

    fn waiting(&self) -> std::sync::MutexGuard<'_, Vec<Cursor>> {
        self.cursors.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    /// Forgets all cursors: the tree they stand in is gone.
    pub(crate) fn recall(&self) {
        self.waiting().clear();
    }
}

/// What [`expand`] works with, kept from node to node.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    extensions: Vec<Extension>,
    /// What the axioms removed so far.
    pub(crate) removals: Removals,
}

/// What the recursive step made of a node, besides successors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    pub(crate) outcome: Outcome,
    pub(crate) removals: Removals,
}

/// Which map [`expand`] shows with a successor.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Look {
    /// The parent's.
    Outside,
    /// The successor's own.
    Inside,
}

/// Applies the recursive step to a node of the tree and hands each successor to `each`, together
/// with the hypothesis in its parent's or its own map.
pub(crate) fn expand(
    cursor: &mut Cursor,
    node: NodeId,
    tree: &Tree,
    context: Context<'_>,
    scratch: &mut Scratch,
    look: Look,
    mut each: impl FnMut(Child, &Hypothesis),
) -> Outcome {
    let Experience { catalog, observations, .. } = context.experience;
    let observation = observations[tree.depth(node)];
    let hypothesis = cursor.go_to(node, tree, context.experience);
    let Scratch { extensions, removals } = scratch;
    match hypothesis.step(observation, catalog, context.axioms, extensions, removals) {
        Derivation::PredictedConsistent(arrival) => {
            each(Child { parent: node, arrival, growth: None }, hypothesis);
            Outcome::Predicted
        }
        Derivation::PredictedInconsistent => Outcome::Refuted,
        Derivation::Expand(exit) => {
            let new_arrival = hypothesis.map.olp_of_next_place(observation.entry);
            for &extension in extensions.iter() {
                let arrival = match extension {
                    Extension::NewPlace => new_arrival,
                    Extension::Closure(gateway) => gateway,
                };
                let child = Child { parent: node, arrival, growth: Some((exit, extension)) };
                match look {
                    Look::Outside => each(child, hypothesis),
                    Look::Inside => {
                        hypothesis.extend(exit, extension, observation, catalog);
                        each(child, hypothesis);
                        hypothesis.retract(extension);
                    }
                }
            }
            Outcome::Expanded
        }
    }
}
