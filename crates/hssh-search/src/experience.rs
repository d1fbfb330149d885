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

/// The star types of the exploration keep their numbers: `StarType(i)` becomes `StarId::new(i)`.
impl From<&Exploration> for Experience {
    fn from(exploration: &Exploration) -> Self {
        let mut catalog = StarCatalog::new();
        for named in exploration.star_types() {
            catalog.add(&named.star);
        }
        let observe = |travel: &hssh_causal::Travel| Observation {
            exit: travel.exit,
            entry: travel.entry,
            star: StarId::new(travel.star.0),
        };
        let observations = exploration.travels().iter().map(observe).collect();
        Experience { catalog, start: StarId::new(exploration.start().0), observations }
    }
}
