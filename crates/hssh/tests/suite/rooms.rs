//! The rooms that a robot was in, by its log, against those of the floor that it was led through.

use std::collections::BTreeMap;
use std::sync::Arc;

use hssh::answer::{Answer, AnsweredPassage, Listing, MapPicture};
use hssh::local::{
    Cell, Lattice, Occupancy, OccupancyGrid, RegionMap, RegionOptions, Roadmap, RoadmapOptions,
};
use hssh::pipeline::{Input, MappingOptions, map};
use hssh::world::robot::{RobotOptions, Tour, round_trip};

/// A corridor with three rooms above and two below, as left, bottom, right, top in metres.
const ROOMS: [[f64; 4]; 6] = [
    [0.5, 5.0, 18.5, 7.0],
    [0.5, 7.3, 6.0, 12.0],
    [6.3, 7.3, 12.0, 11.0],
    [12.3, 7.3, 18.5, 12.0],
    [0.5, 0.5, 9.0, 4.7],
    [9.3, 0.5, 18.5, 4.7],
];

/// Doors of 1 m, four to the corridor and one between the two rooms to its right.
const DOORS: [[f64; 4]; 5] = [
    [2.0, 7.0, 3.0, 7.3],
    [8.0, 7.0, 9.0, 7.3],
    [12.0, 8.5, 12.3, 9.5],
    [4.0, 4.7, 5.0, 5.0],
    [14.0, 4.7, 15.0, 5.0],
];

fn is_in([left, bottom, right, top]: [f64; 4], [x, y]: [f64; 2]) -> bool {
    (left..right).contains(&x) && (bottom..top).contains(&y)
}

fn floor() -> OccupancyGrid {
    let lattice = Lattice::new(380, 250, 0.05, [0.0, 0.0]).unwrap();
    let is_free = |cell: Cell| {
        let point = lattice.center(cell);
        ROOMS.iter().chain(&DOORS).any(|&area| is_in(area, point))
    };
    let cells = lattice.cells().map(|cell| if is_free(cell) { Occupancy::Free } else { Occupancy::Occupied });
    OccupancyGrid::new(lattice, cells.collect()).unwrap()
}

/// The tour of the floor, and what is answered of its log.
fn toured() -> (Tour, Answer) {
    let grid = floor();
    let regions = RegionMap::new(&grid, &RegionOptions::default()).unwrap();
    let roadmap = Roadmap::new(&grid, &regions, &RoadmapOptions::default());
    let tour = Tour::along(&round_trip(&roadmap), &grid, &RobotOptions::default(), 5);
    let options = MappingOptions::default();
    let input = Input::from_log("tour", tour.to_carmen().as_bytes(), &options).unwrap();
    (tour, map(&input, &options, &Arc::default()).unwrap().answer)
}

#[test]
fn a_room_entered_is_a_room_of_the_map() {
    let (tour, answer) = toured();
    let building = answer.building.as_ref().unwrap();
    let room_at = |scan: u64| {
        let pose = tour.moments[scan as usize].pose;
        ROOMS.iter().position(|&room| is_in(room, [pose.x, pose.y]))
    };
    // Which room each stay is in, by where the robot truly was.
    let mut told: Vec<usize> = Vec::new();
    let mut region_of: BTreeMap<usize, u32> = BTreeMap::new();
    for stay in &building.stays {
        let mut counts = [0; ROOMS.len()];
        (stay.scans[0]..=stay.scans[1]).filter_map(room_at).for_each(|room| counts[room] += 1);
        let room = (0..ROOMS.len()).max_by_key(|&room| counts[room]).unwrap();
        assert!(counts[room] * 10 >= counts.iter().sum::<usize>() * 9, "{stay:?} is in one room: {counts:?}");
        assert_eq!(*region_of.entry(room).or_insert(stay.region), stay.region, "room {room} is one region");
        told.push(room);
    }
    assert_eq!(region_of.len(), ROOMS.len(), "every room was entered: {told:?}");
    let mut truth: Vec<usize> = (0..tour.moments.len() as u64).filter_map(room_at).collect();
    truth.dedup();
    assert_eq!(told, truth);
    for (&room, &region) in &region_of {
        let region = &building.regions[region as usize];
        assert_eq!(region.kind, if room == 0 { "corridor" } else { "room" });
        let [left, bottom, right, top] = ROOMS[room];
        let area = (right - left) * (top - bottom);
        assert!((region.area - area).abs() < 0.1 * area, "{region:?} has {area} m²");
        assert!(region.explored > 0.85, "{region:?}");
    }
    // Whoever goes from one room to the next goes through a door.
    for pair in building.stays.windows(2) {
        let rooms = [pair[0].region, pair[1].region];
        let leads = |passage: &&AnsweredPassage| rooms.iter().all(|room| passage.regions.contains(room));
        let passages: Vec<_> = building.passages.iter().filter(leads).collect();
        assert!(passages.iter().any(|passage| passage.kind == "door"), "{rooms:?}: {passages:?}");
    }
    let doors = building.passages.iter().filter(|passage| passage.kind == "door").count();
    visits_and_places_name_their_regions(&answer);
    let text = answer.to_text(Listing::default());
    let told = format!("The building: 5 rooms, 1 corridor, {doors} doors; the robot was in 6");
    assert!(text.contains(&told), "{text}");
    let svg = MapPicture::new(&answer.maps[0], None).unwrap().in_building(building).to_svg();
    assert_eq!(svg.matches("class=\"door\"").count(), doors);
}

fn visits_and_places_name_their_regions(answer: &Answer) {
    let building = answer.building.as_ref().unwrap();
    for visit in &answer.visits {
        let (region, scan) = (visit.region.unwrap(), visit.scan.unwrap());
        let stay =
            building.stays.iter().find(|stay| (stay.scans[0]..=stay.scans[1]).contains(&scan)).unwrap();
        assert_eq!(region, stay.region, "{visit:?}");
        assert_eq!(answer.maps[0].places[visit.place.unwrap() as usize].region, Some(region));
    }
    for (number, place) in (0..).zip(&answer.maps[0].places) {
        assert!(building.regions[place.region.unwrap() as usize].places.contains(&number));
    }
    assert_eq!(Answer::from_json(&answer.to_json()).unwrap(), *answer);
}
