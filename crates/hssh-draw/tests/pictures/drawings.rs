//! Laws of drawings: a grid is drawn as a grid, and what contradicts itself is refused.

use std::f64::consts::{FRAC_PI_2, PI};

use hssh_draw::{Bearings, Drawing, DrawingError};
use hssh_metrics::Pose;
use hssh_topology::{PlaceId, StarCatalog, StarId, TopologicalMap};

use crate::common::{Grid, link, random_planar};

fn distance(drawing: &Drawing, a: PlaceId, b: PlaceId) -> f64 {
    let (a, b) = (drawing.pose(a), drawing.pose(b));
    (a.x - b.x).hypot(a.y - b.y)
}

#[test]
fn a_grid_is_drawn_as_the_grid_up_to_a_rigid_motion() {
    for grid in [Grid { rows: 3, columns: 3 }, Grid { rows: 2, columns: 5 }, Grid { rows: 1, columns: 2 }] {
        let map = grid.map(&mut StarCatalog::new());
        let drawing = Drawing::schematic(&map, &Bearings::none()).unwrap();
        let at = |place: PlaceId| {
            let (row, column) = (place.number() as i32 / grid.columns, place.number() as i32 % grid.columns);
            (f64::from(row), f64::from(column))
        };
        for a in map.places() {
            for b in map.places() {
                let expected = (at(a).0 - at(b).0).hypot(at(a).1 - at(b).1);
                assert!((distance(&drawing, a, b) - expected).abs() < 1e-6, "{a:?} {b:?}");
            }
        }
        // Not its mirror image: clockwise from north, so that the second end points east.
        let turn = drawing.direction(map.olps_of(PlaceId::new(0)).next().unwrap()) - FRAC_PI_2;
        let right = drawing.pose(PlaceId::new(1));
        let (x, y) =
            (right.x * turn.cos() + right.y * turn.sin(), right.y * turn.cos() - right.x * turn.sin());
        assert!((x - 1.0).abs() < 1e-6 && y.abs() < 1e-6);
    }
}

#[test]
fn places_of_contradictory_maps_stay_apart() {
    for seed in 0..12 {
        let (map, _) = random_planar(14, 8, seed);
        let drawing = Drawing::schematic(&map, &Bearings::none()).unwrap();
        for a in map.places() {
            for b in map.places().filter(|&b| b < a) {
                assert!(distance(&drawing, a, b) > 0.4, "seed {seed}: {a:?} and {b:?} lie on each other");
            }
        }
    }
}

#[test]
fn bearings_turn_the_ends() {
    let mut catalog = StarCatalog::new();
    let star = "0+ 0-".parse().unwrap();
    let id = catalog.intern(&star);
    let mut map = TopologicalMap::new();
    let places = [0; 2].map(|_| map.add_place(id, &star));
    let olps: Vec<_> = places.iter().map(|&place| map.olps_of(place).collect::<Vec<_>>()).collect();
    link(&mut map, (places[0], 0), (places[1], 1));
    // A path that bends by a right angle at each place: out to the east, in from the north.
    let bearings = Bearings(vec![vec![Some(0.0), Some(FRAC_PI_2)]]);
    let drawing = Drawing::schematic(&map, &bearings).unwrap();
    let (near, far) = (drawing.pose(places[0]), drawing.pose(places[1]));
    assert!((far.x - near.x - 1.0).abs() < 1e-6 && (far.y - near.y).abs() < 1e-6);
    let facing = drawing.direction(olps[1][1]) - PI;
    assert!(facing.sin().abs() < 1e-6 && facing.cos() > 0.0);
}

#[test]
fn what_is_no_drawing_is_refused() {
    let map = Grid { rows: 1, columns: 2 }.map(&mut StarCatalog::new());
    let measured = |poses, bearings: &Bearings| Drawing::measured(&map, poses, bearings);
    let poses = vec![Pose::IDENTITY, Pose::new(1.0, 0.0, 0.0)];
    assert!(measured(poses.clone(), &Bearings::none()).is_ok());
    assert_eq!(
        measured(vec![Pose::IDENTITY], &Bearings::none()),
        Err(DrawingError::PoseCount { given: 1, places: 2 })
    );
    let infinite = vec![Pose::IDENTITY, Pose { x: f64::INFINITY, ..Pose::IDENTITY }];
    assert!(matches!(
        measured(infinite, &Bearings::none()),
        Err(DrawingError::NotFinite { place, .. }) if place == PlaceId::new(1)
    ));
    let short = Bearings(vec![vec![Some(0.0)]]);
    let expected = DrawingError::BearingCount { star: StarId::new(0), ends: 4, given: 1 };
    assert_eq!(measured(poses.clone(), &short), Err(expected));
    let counterclockwise = Bearings(vec![[0.0, 1.0, 2.0, 3.0].map(Some).to_vec()]);
    assert!(matches!(measured(poses, &counterclockwise), Err(DrawingError::NotClockwise { .. })));
}
