//! The most probable maps, given measured travels (chapter 4).

mod appearance;
mod by_posterior;
mod cost;
mod course;
mod horizon;
mod layout;
mod model;
mod needs;
mod noose;
mod outlook;
mod packed;
mod poses;
mod prices;
mod runs;
mod tariff;
mod vicinity;
mod way;

pub use appearance::Appearance;
pub(crate) use by_posterior::{ByPosterior, NEGLIGIBLE, Nats, TIE};
pub use cost::Cost;
pub use horizon::Horizon;
pub(crate) use horizon::horizons;
pub(crate) use layout::{Layout, Strain};
pub use model::{Corridor, MapPrior, Metrical, ModelError, PlacePrior, PosteriorModel};
pub use outlook::LINEAR_TRUST;
pub(crate) use outlook::Sameness;
pub(crate) use tariff::Tariff;
