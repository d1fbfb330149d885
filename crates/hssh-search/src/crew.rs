//! The threads, and the other processes, that work on a frontier together.

use std::sync::{Arc, Mutex};

use rayon::prelude::*;

use crate::cursor::Cursor;
use crate::experience::Experience;
use crate::helpers::Helpers;

/// The operating system gave no threads.
#[derive(Debug, thiserror::Error)]
#[error("cannot start the threads of the search: {0}")]
pub struct ThreadsError(#[from] rayon::ThreadPoolBuildError);

/// More threads than this for each core are not started: they would only wait for one another.
const MOST_PER_CORE: usize = 4;

/// How many threads a request for so many comes to: one per core for 0, and never more than a few for each core. More would only
/// wait for one another.
#[must_use]
pub fn useful_threads(asked: usize) -> usize {
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    if asked == 0 { cores } else { asked.min(MOST_PER_CORE * cores) }
}

/// A pool of threads, and of cursors that wait where they were used last.
///
/// Work is cut into pieces that do not depend on the number of threads, and results come back in
/// the order of the pieces: so does everything made of them.
#[derive(Debug)]
pub(crate) struct Crew {
    /// None if there is but one thread.
    pool: Option<rayon::ThreadPool>,
    cursors: Mutex<Vec<Cursor>>,
    /// Other processes, if there are any.
    helpers: Option<Arc<dyn Helpers>>,
}

impl Crew {
    /// That many threads, as far as they are [useful](useful_threads).
    ///
    /// # Errors
    /// If the operating system gives no threads.
    pub(crate) fn new(threads: usize) -> Result<Self, ThreadsError> {
        let pool = match useful_threads(threads) {
            1 => None,
            threads => Some(rayon::ThreadPoolBuilder::new().num_threads(threads).build()?),
        };
        Ok(Crew { pool, cursors: Mutex::new(Vec::new()), helpers: None })
    }

    /// The same, with other processes.
    pub(crate) fn helped(self, helpers: Option<Arc<dyn Helpers>>) -> Self {
        Crew { helpers: helpers.filter(|helpers| helpers.count() > 0), ..self }
    }

    /// The other processes, if there are any.
    pub(crate) fn helpers(&self) -> Option<&dyn Helpers> {
        self.helpers.as_deref()
    }

    /// Applies `work` to each piece, each time with a cursor; the results in the order of the pieces.
    pub(crate) fn map<T: Sync, R: Send>(
        &self,
        pieces: &[T],
        experience: &Experience,
        work: impl Fn(&mut Cursor, &T) -> R + Sync + Send,
    ) -> Vec<R> {
        self.each(pieces.iter().collect(), |piece: &T| {
            let waiting = self.waiting().pop();
            let mut cursor = waiting.unwrap_or_else(|| Cursor::new(experience));
            let result = work(&mut cursor, piece);
            self.waiting().push(cursor);
            result
        })
    }

    /// Does each job; the results in the order of the jobs.
    pub(crate) fn each<J: Send, R: Send>(&self, jobs: Vec<J>, work: impl Fn(J) -> R + Sync + Send) -> Vec<R> {
        match &self.pool {
            Some(pool) if jobs.len() > 1 => pool.install(|| jobs.into_par_iter().map(work).collect()),
            _ => jobs.into_iter().map(work).collect(),
        }
    }

    fn waiting(&self) -> std::sync::MutexGuard<'_, Vec<Cursor>> {
        self.cursors.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    /// Forgets all cursors: nodes that they stand at are gone.
    pub(crate) fn recall(&self) {
        self.waiting().clear();
    }
}
