//! What the other commands find, as plain data: contents of explorations, places of maps and logs, surveys of logs, drives
//! of simulated robots, and optimized pose graphs.

mod contents;
mod drive;
mod places;
mod pose_graph;
mod survey;

pub use contents::{CausalContents, ContentsAccount, SchemaContents, StarTypeContents};
pub use drive::{DriveAccount, DrivePlace, DriveStop};
pub use places::{
    ConstrictionAccount, GatewayAccount, GridSize, PlaceAccount, PlacesAccount, StarEndAccount,
};
pub use pose_graph::{JudgedEdge, LabeledPoint, LabeledPose, PoseGraphAccount, SkippedRecord};
pub use survey::{SurveyAccount, SurveyedEnd, SurveyedTravel, SurveyedVisit};
