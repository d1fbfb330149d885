//! The building that a log shows where a map has its scans: its grid, its regions, and where in it the robot was.

use hssh_local::{
    LatticeError, OccupancyGrid, PlaceGraphError, RegionMap, RegionNumber, RegionOptions, Stay, UnknownSpace,
    building_map, stays,
};
use hssh_metrics::Pose;

use super::input::SurveyedLog;
use crate::answer::{
    Answer, AnswerWarning, AnsweredBuilding, AnsweredPassage, AnsweredRegion, AnsweredStay, WarningKind,
};

/// The building of one map.
pub(super) struct Building {
    grid: OccupancyGrid,
    regions: RegionMap,
    stays: Vec<Stay>,
    /// For each visit the region that its place is in.
    visits: Vec<Option<RegionNumber>>,
}

/// Why there is no building.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub(super) enum BuildingError {
    #[error("the building is too large to be drawn: {0}")]
    Lattice(#[from] LatticeError),
    #[error("the building has no rooms: {0}")]
    Regions(#[from] PlaceGraphError),
}

impl Building {
    /// The building that the scans of a log draw from these poses, in which no place has a region yet.
    pub(super) fn new(surveyed: &SurveyedLog, poses: &[Pose]) -> Result<Self, BuildingError> {
        let grid = building_map(&surveyed.log, poses)?;
        // Where no scan looked, there may be anything.
        let options = RegionOptions { unknown: UnknownSpace::Unexplored, ..RegionOptions::default() };
        let regions = RegionMap::new(&grid, &options)?;
        let stays = stays(&regions, poses);
        let track = &surveyed.survey.track.scans;
        let region_of = |visit: &hssh_local::Visit| {
            let scan = visit.reference;
            let center = poses[scan].compose(track[scan].pose.between(visit.frame));
            let stay = stays.iter().find(|stay| (stay.scans.0..=stay.scans.1).contains(&scan));
            regions.region_at([center.x, center.y]).or(stay.map(|stay| stay.region))
        };
        let visits = surveyed.survey.visits.iter().map(region_of).collect();
        Ok(Building { grid, regions, stays, visits })
    }

    /// The grid that all scans draw.
    pub(super) fn grid(&self) -> &OccupancyGrid {
        &self.grid
    }

    /// Tells an answer of the building, and where in it visits and places are.
    pub(super) fn tell(&self, surveyed: &SurveyedLog, answer: &mut Answer) {
        for (visit, region) in answer.visits.iter_mut().zip(&self.visits) {
            visit.region = region.map(|region| region.0);
        }
        for map in &mut answer.maps {
            for (visit, region) in map.visits.iter().zip(&self.visits) {
                let place = &mut map.places[visit.place as usize];
                place.region = place.region.or(region.map(|region| region.0));
            }
        }
        let mut building = self.account(surveyed);
        for (number, place) in (0..).zip(answer.maps.first().iter().flat_map(|map| &map.places)) {
            if let Some(region) = place.region {
                building.regions[region as usize].places.push(number);
            }
        }
        answer.building = Some(building);
    }

    fn account(&self, surveyed: &SurveyedLog) -> AnsweredBuilding {
        let region = |(number, outline): (u32, hssh_local::Outline)| {
            let number = RegionNumber(number);
            let region = self.regions.region(number);
            AnsweredRegion {
                kind: region.kind.name().to_owned(),
                area: region.area,
                width: region.width,
                explored: region.explored,
                stays: self.stays.iter().filter(|stay| stay.region == number).count() as u64,
                places: Vec::new(),
                passages: self.regions.passages_of(number).collect(),
                outline: outline.around,
                holes: outline.holes,
            }
        };
        let passage = |passage: &hssh_local::Passage| AnsweredPassage {
            kind: passage.kind().to_owned(),
            door_probability: passage.door_probability,
            regions: passage.regions.map(|region| region.0),
            width: passage.gateway.width,
            line: passage.gateway.line,
        };
        let stay = |stay: &Stay| AnsweredStay {
            region: stay.region.0,
            scans: [stay.scans.0, stay.scans.1].map(|scan| surveyed.scan_number(scan)),
        };
        AnsweredBuilding {
            regions: (0..).zip(self.regions.outlines()).map(region).collect(),
            passages: self.regions.passages.iter().map(passage).collect(),
            stays: self.stays.iter().map(stay).collect(),
        }
    }
}

/// Says in an answer why it tells of no building.
pub(super) fn warn(answer: &mut Answer, problem: &BuildingError) {
    answer.warnings.push(AnswerWarning::once(WarningKind::NoBuilding, problem.to_string()));
}
