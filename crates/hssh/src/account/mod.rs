//! What the other commands find, as plain data: surveys of logs and drives of simulated robots.

mod drive;
mod survey;

pub use drive::{DriveAccount, DrivePlace, DriveStop};
pub use survey::{SurveyAccount, SurveyedEnd, SurveyedTravel, SurveyedVisit};
