//! What of the building a log shows, and in how much of it the robot was.

use hssh::answer::Answer;

use crate::table::aligned;

/// The building of a log in numbers.
pub(super) struct Building {
    name: &'static str,
    /// Regions of each of [`KINDS`].
    kinds: [usize; KINDS.len()],
    doors: usize,
    openings: usize,
    /// Regions that the robot was in, and how many times it was in any.
    entered: usize,
    stays: usize,
    /// Visits and places that are in a region, and all.
    visits: [usize; 2],
    places: [usize; 2],
    /// The mean part of the rim that was seen, of the regions that the robot was in.
    explored: f64,
}

const KINDS: [&str; 5] = ["room", "corridor", "hall", "doorway", "unexplored"];

impl Building {
    /// Of an answer with a building.
    pub(super) fn of(name: &'static str, answer: &Answer) -> Option<Self> {
        let building = answer.building.as_ref()?;
        let passages = |kind: &str| building.passages.iter().filter(|passage| passage.kind == kind).count();
        let entered: Vec<f64> =
            building.regions.iter().filter(|region| region.stays > 0).map(|region| region.explored).collect();
        let places = || answer.maps.iter().take(1).flat_map(|map| &map.places);
        Some(Building {
            name,
            kinds: KINDS.map(|kind| building.regions.iter().filter(|region| region.kind == kind).count()),
            doors: passages("door"),
            openings: passages("opening"),
            entered: entered.len(),
            stays: building.stays.len(),
            visits: [
                answer.visits.iter().filter(|visit| visit.region.is_some()).count(),
                answer.visits.len(),
            ],
            places: [places().filter(|place| place.region.is_some()).count(), places().count()],
            explored: entered.iter().sum::<f64>() / entered.len().max(1) as f64,
        })
    }
}

/// The table of all buildings.
pub(super) fn table(all: &[Building]) -> String {
    let mut header = vec!["log".to_owned()];
    header.extend(KINDS.map(|kind| format!("{kind}s")));
    header.extend(
        ["doors", "openings", "entered", "stays", "visits in one", "places in one", "rim seen"]
            .map(str::to_owned),
    );
    let of = |[part, all]: [usize; 2]| format!("{part} of {all}");
    let row = |one: &Building| {
        let mut row = vec![one.name.to_owned()];
        row.extend(
            one.kinds
                .iter()
                .chain([&one.doors, &one.openings, &one.entered, &one.stays])
                .map(usize::to_string),
        );
        row.extend([of(one.visits), of(one.places), format!("{:.2}", one.explored)]);
        row
    };
    let rows: Vec<Vec<String>> = std::iter::once(header).chain(all.iter().map(row)).collect();
    format!(
        "buildings: regions and passages of the grid of each log; entered: regions that the robot was in, stays: how many \
         times it came into one; visits and places that are in a region; rim seen: the part of the rims of the regions \
         entered that is wall\n{}",
        aligned(&rows)
    )
}
