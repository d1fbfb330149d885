//! What a process does that helps a search: it takes turns of hypotheses that it is asked for, and knows nothing of the search as a whole.

use std::sync::Arc;

use hssh_causal::Exploration;

use crate::builder::{MapperBuilder, MapperError};
use crate::checkpoint::Identity;
use crate::experience::Experience;
use crate::helpers::{Asked, read};
use crate::limits::{Limits, Monitor, Watch};
use crate::mapper::{Mapper, Searching};
use crate::paths::Prefixes;
use crate::{steps, turns};

/// Answers the requests of a search. Wherever it is made for the same exploration and options, it answers the same.
#[derive(Debug)]
pub struct Expander {
    mapper: Mapper,
    prefixes: Prefixes,
    identity: u64,
}

impl MapperBuilder {
    /// Tells the search of an exploration from others.
    #[must_use]
    pub fn identity(&self, exploration: &Exploration) -> u64 {
        Identity::of(self.strategy(), self, exploration).number()
    }
}

impl Expander {
    /// For the search that `options` ask for, whatever their limits.
    ///
    /// # Errors
    /// If the search could not begin either.
    pub fn new(options: MapperBuilder, exploration: &Exploration) -> Result<Self, MapperError> {
        let identity = options.identity(exploration);
        options.constraints.check(exploration.travels().len())?;
        let options = MapperBuilder {
            limits: Limits::default(),
            monitor: Arc::new(Monitor::default()),
            checkpoints: None,
            helpers: None,
            store: None,
            threads: 1,
            ..options
        };
        let mapper = Mapper::new(options, Experience::from(exploration), &Watch::without_limits())?;
        let prefixes = Prefixes::new(mapper.experience());
        Ok(Expander { mapper, prefixes, identity })
    }

    /// Tells its search from others.
    #[must_use]
    pub fn identity(&self) -> u64 {
        self.identity
    }

    /// Does what is asked. `None` if that is nothing that this search asks for.
    pub fn answer(&mut self, request: &[u8]) -> Option<Vec<u8>> {
        let (&asked, request) = request.split_first()?;
        let Expander { mapper, prefixes, .. } = self;
        let watch = Watch::without_limits();
        let (context, searching) = mapper.searching(&watch);
        match asked {
            asked if asked == Asked::Steps as u8 => steps::answer(&read(request)?, prefixes, context),
            asked if asked == Asked::Turns as u8 => match searching {
                Searching::Preference(appraiser) => turns::answer(request, appraiser, prefixes, context),
                Searching::Posterior(appraiser) => turns::answer(request, appraiser, prefixes, context),
            },
            _ => None,
        }
    }
}
