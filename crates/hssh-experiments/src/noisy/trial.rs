//! One search about one noisy exploration, compared with the truth.

use std::error::Error;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use hssh_causal::Exploration;
use hssh_search::{MapperBuilder, Score};
use hssh_world::{PolarNoise, Route, World};
use serde::Serialize;

/// A world with a way through it.
pub(crate) struct Course {
    pub(crate) world: World,
    pub(crate) route: Route,
}

/// What became of one search.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Trial {
    /// Whether the best map takes every visit for what it was.
    pub(crate) right: bool,
    /// Whether the best map is proved.
    pub(crate) proved: bool,
    /// Whether a limit stopped the search.
    pub(crate) stopped: bool,
    pub(crate) expanded: u64,
    pub(crate) solved: u64,
    pub(crate) seconds: f64,
    /// Of the tree and the queue.
    pub(crate) bytes: u64,
    /// By how many nats the best map beats the bound on all others; negative as long as it is not proved.
    pub(crate) gap: f64,
    /// The least that the best map's probability can be.
    pub(crate) probability: f64,
    pub(crate) linear_factor: f64,
}

impl Course {
    /// The exploration as a robot measures it.
    pub(crate) fn explore(&self, noise: &PolarNoise, seed: u64) -> Result<Exploration, Box<dyn Error>> {
        Ok(self.world.explore_with_odometry(&self.route, noise, seed)?)
    }

    /// Searches, and looks whether the best map is the true one.
    pub(crate) fn try_out(
        &self,
        search: MapperBuilder,
        exploration: &Exploration,
    ) -> Result<Trial, Box<dyn Error>> {
        let mapper = search.explain(exploration)?;
        let (report, maps) = mapper.answer(1);
        let proof = report.proof.ok_or("a search by posterior has a bound")?;
        let right = match maps.first() {
            None => false,
            Some(best) => {
                let visits = mapper.visits(best.node);
                let truth = self.world.visits(&self.route)?;
                let same = |a: usize, b: usize| visits[a].place == visits[b].place;
                let truly_same = |a: usize, b: usize| truth[a] == truth[b];
                // A search that was stopped has a map of the first visits. Stars are written down from the same end on at every visit
                // of a place.
                visits.len() == truth.len()
                    && visits.iter().all(|visit| visit.phi.rotation() == 0)
                    && (0..truth.len()).all(|a| (0..a).all(|b| same(a, b) == truly_same(a, b)))
            }
        };
        let nats = |score: Option<Score>| match score {
            Some(Score::Nats(nats)) => nats,
            _ => f64::INFINITY,
        };
        let probable = maps.first().and_then(|best| best.probable.as_ref());
        Ok(Trial {
            right,
            proved: report.is_optimal,
            stopped: !report.stop.is_complete(),
            expanded: report.expanded,
            solved: report.solved,
            seconds: report.seconds,
            bytes: report.bytes,
            gap: nats(proof.open_bound) - nats(proof.best),
            probability: probable.map_or(0.0, |probable| probable.at_least),
            linear_factor: proof.linear_factor,
        })
    }
}

/// Does all tasks on that many threads; the results in the order of the tasks.
pub(crate) fn on_threads<T: Send>(
    threads: usize,
    tasks: usize,
    task: impl Fn(usize) -> Result<T, Box<dyn Error>> + Sync,
) -> Result<Vec<T>, Box<dyn Error>> {
    let threads = if threads == 0 { std::thread::available_parallelism()?.get() } else { threads };
    let (next, done) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= tasks {
                        return;
                    }
                    let result = task(index).map_err(|error| error.to_string());
                    done.lock().unwrap_or_else(std::sync::PoisonError::into_inner).push((index, result));
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, result)| Ok(result?)).collect()
}

/// The number in the middle, the upper one of two.
pub(crate) fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut numbers: Vec<f64> = numbers.collect();
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
}
