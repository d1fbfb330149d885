//! Which search a checkpoint is of.

use std::fmt::Debug;

use hssh_causal::Exploration;
use serde::{Deserialize, Serialize};

use super::error::CheckpointError;
use crate::builder::MapperBuilder;
use crate::fingerprint::fingerprint;

/// What tells one search from another. Limits and threads do not: they may be others when it goes on.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub(crate) struct Identity {
    version: String,
    exploration: u64,
    /// How the tree is searched, and for what, in words.
    strategy: String,
    options: u64,
}

impl Identity {
    /// That of a search through the maps of an exploration; `strategy` is what the options call it.
    pub(crate) fn of(strategy: String, options: &MapperBuilder, exploration: &Exploration) -> Self {
        let MapperBuilder { axioms, objective, order, goal, proving, appearance, constraints, .. } = options;
        let matters: [&dyn Debug; 7] = [axioms, objective, order, goal, proving, appearance, constraints];
        Identity::told(strategy, &matters, exploration)
    }

    /// That of a search for which those options matter.
    pub(crate) fn told(strategy: String, matters: &[&dyn Debug], exploration: &Exploration) -> Self {
        Identity {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            exploration: fingerprint(exploration.to_ron().as_bytes()),
            strategy,
            options: fingerprint(format!("{matters:?}").as_bytes()),
        }
    }

    /// A number that tells it from others.
    pub(crate) fn number(&self) -> u64 {
        fingerprint(format!("{self:?}").as_bytes())
    }

    /// Whether a checkpoint of that search is one of this.
    ///
    /// # Errors
    /// If it is not, and why.
    pub(crate) fn check(&self, there: Identity) -> Result<(), CheckpointError> {
        if there.version != self.version {
            return Err(CheckpointError::Version { there: there.version, here: self.version.clone() });
        }
        if there.exploration != self.exploration {
            return Err(CheckpointError::Exploration);
        }
        if there.strategy != self.strategy {
            return Err(CheckpointError::Search { there: there.strategy, here: self.strategy.clone() });
        }
        if there.options == self.options { Ok(()) } else { Err(CheckpointError::Options) }
    }
}
