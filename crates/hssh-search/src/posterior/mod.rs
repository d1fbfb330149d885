//! The most probable maps, given measured travels (chapter 4).

mod answer;
mod appearance;
mod cost;
mod frontier;
mod grower;
mod layout;
mod leaf;
mod model;
mod outlook;
mod search;

pub use answer::{Posterior, PosteriorReport, ProbableMap};
pub use appearance::Appearance;
pub use cost::Cost;
pub use model::{Corridor, MapPrior, Metrical, ModelError, PlacePrior, PosteriorModel};
pub use outlook::LINEAR_TRUST;
pub use search::{PosteriorError, PosteriorOrder, PosteriorSearch, Proving};
