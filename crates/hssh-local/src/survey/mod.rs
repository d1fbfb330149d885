//! From a laser log to an exploration: where the robot was at places, what their stars are, by which ways
//! it came and went, and how far it was from one to the next (section 2.4).

mod error;
mod evidence;
mod explore;
mod follow;
mod graph;
mod lost;
mod options;
mod resemblance;
mod returns;
mod sight;
mod turn;
mod visit;

pub use error::{SurveyError, SurveyWarning};
pub use evidence::{Evidence, PerceptionModel};
pub use follow::{SurveyStage, survey, survey_tracked};
pub use lost::{doubts, turned_laser};
pub use options::SurveyOptions;
pub use resemblance::{Resemblance, resemblance};
pub(crate) use turn::turn;
pub use visit::{Survey, Visit};
