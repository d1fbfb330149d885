//! What the other commands find, as plain data: contents of explorations, places of maps and logs, surveys and tracks of logs, drives
//! of simulated robots, and optimized pose graphs.

mod contents;
mod drive;
mod names;
mod places;
mod pose_graph;
mod regions;
mod roadmap;
mod scale;
mod survey;
mod track;

pub use contents::{CausalContents, ContentsAccount, SchemaContents, StarTypeContents};
pub use drive::{DriveAccount, DrivePlace, DriveStop};
pub use names::{NamesError, PointName};
pub use places::{
    ConnectionAccount, ConstrictionAccount, GatewayAccount, GridSize, PlaceAccount, PlacesAccount,
    PlacesError, StarEndAccount,
};
pub use pose_graph::{JudgedEdge, LabeledPoint, LabeledPose, PoseGraphAccount, SkippedRecord};
pub use regions::{PassageAccount, RegionAccount};
pub use roadmap::{RoadNodeAccount, RoadmapAccount, WayAccount};
pub use survey::{SurveyAccount, SurveyedEnd, SurveyedTravel, SurveyedVisit};
pub use track::{TrackAccount, TrackedPose};
