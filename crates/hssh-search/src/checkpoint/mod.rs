//! Checkpoints: what a long search knows, written down from time to time, so that it can go on after whatever ended it.
//!
//! A search that goes on from a checkpoint comes to the same answer, to the last bit, as one that was never interrupted: what is
//! written is its whole state, at a moment at which it would also stop for a limit.

mod error;
mod identity;
mod seal;
mod state;

use std::fmt::Debug;
use std::io::{self, Write};
use std::sync::Arc;
use std::time::{Duration, Instant};

pub use error::CheckpointError;
pub(crate) use identity::Identity;
pub use seal::Source;
pub(crate) use seal::{Pen, Unsealed};
pub(crate) use state::{State, write_state};

/// Keeps the checkpoints of a search: this crate neither reads nor writes files.
pub trait Keeper: Debug + Send + Sync {
    /// Keeps a checkpoint in the place of the one before. `write` writes it; the search goes on whether or not it could be
    /// kept.
    fn keep(&self, write: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>);

    /// The last checkpoint that was kept, to go on from, if there is one.
    ///
    /// # Errors
    /// If there is one that cannot be read.
    fn kept(&self) -> io::Result<Option<Box<dyn Source>>>;

    /// The search goes on from that, with so many hypotheses made.
    fn goes_on(&self, hypotheses: u64) {
        let _ = hypotheses;
    }
}

/// How a search is kept.
#[derive(Clone, Debug)]
pub struct Checkpoints {
    /// Who keeps it.
    pub keeper: Arc<dyn Keeper>,
    /// How much time is between two checkpoints, at least; there is always one when a limit or an interruption stops the search.
    pub every: Duration,
}

/// When writing takes long, so many times as much is between two checkpoints at least.
const SHARE: u32 = 10;

/// The checkpoints of one running search.
#[derive(Debug, Default)]
pub(crate) struct Keeping {
    /// How it is kept, and which search it is; nothing if it is not kept.
    kept: Option<(Checkpoints, Identity)>,
    /// When the next one is due.
    pub(crate) due: Option<Instant>,
}

impl Keeping {
    /// A search that begins now; `identity` is asked for only if it is kept.
    pub(crate) fn new(checkpoints: Option<Checkpoints>, identity: impl FnOnce() -> Identity) -> Self {
        let kept = checkpoints.map(|checkpoints| (checkpoints, identity()));
        let mut keeping = Keeping { kept, due: None };
        keeping.wait(Duration::ZERO);
        keeping
    }

    /// The next checkpoint is due at a time from now on that suits one that took that long.
    fn wait(&mut self, took: Duration) {
        let every = self.kept.as_ref().map(|(checkpoints, _)| checkpoints.every.max(took * SHARE));
        self.due = every.and_then(|every| Instant::now().checked_add(every));
    }

    /// What a checkpoint says that the search is to go on from, if there is one; `read` tells also how many hypotheses that are.
    ///
    /// # Errors
    /// If there is one that is of another search, or damaged, or cannot be read.
    pub(crate) fn begin<T>(
        &self,
        read: impl FnOnce(&mut Unsealed<'_>) -> Result<(u64, T), CheckpointError>,
    ) -> Result<Option<T>, CheckpointError> {
        let Some((checkpoints, identity)) = &self.kept else { return Ok(None) };
        let Some(mut source) = checkpoints.keeper.kept()? else { return Ok(None) };
        let mut unsealed = Unsealed::open(&mut *source)?;
        identity.check(unsealed.take()?)?;
        let (hypotheses, read) = read(&mut unsealed)?;
        checkpoints.keeper.goes_on(hypotheses);
        Ok(Some(read))
    }

    /// Keeps a checkpoint, if that was asked for.
    pub(crate) fn keep(&mut self, write: impl Fn(&mut Pen<'_>) -> io::Result<()>) {
        let Some((checkpoints, identity)) = &self.kept else { return };
        let started = Instant::now();
        checkpoints.keeper.keep(&mut |out| {
            let mut pen = Pen::new(out)?;
            pen.put(identity)?;
            write(&mut pen)?;
            pen.seal()
        });
        self.wait(started.elapsed());
    }
}
