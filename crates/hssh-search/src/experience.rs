//! The robot's experience in the mapper's terms: a first star and a list of observations.

use hssh_causal::Exploration;
use hssh_topology::{Observation, StarCatalog, StarId};

/// What a search explains.
#[derive(Clone, Debug)]
pub struct Experience {
    /// All stars that occur.
    pub catalog: StarCatalog,
    /// The star seen first.
    pub start: StarId,
    /// One observation per travel.
    pub observations: Vec<Observation>,
}

impl From<&Exploration> for Experience {
    fn from(exploration: &Exploration) -> Self {
        let mut catalog = StarCatalog::new();
        let start = catalog.intern(exploration.star(exploration.start()));
        let mut observe = |travel: &hssh_causal::Travel| Observation {
            exit: travel.exit,
            entry: travel.entry,
            star: catalog.intern(exploration.star(travel.star)),
        };
        let observations = exploration.travels().iter().map(&mut observe).collect();
        Experience { catalog, start, observations }
    }
}
