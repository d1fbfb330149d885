//! How often a place shows the same star from another pose and with noise.

use std::error::Error;
use std::path::Path;

use hssh_local::{
    Lattice, LocalStar, Occupancy, OccupancyGrid, PlaceGraph, PlaceOptions, neighborhood, read_floor_plan,
    read_map, sight,
};
use hssh_metrics::wrap_angle;
use hssh_topology::Isomorphism;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::aces::{WINDOW, corridors, known_places};

/// The side of the window around a place among rooms, in metres.
const SMALL_WINDOW: f64 = 14.0;

/// Poses per place.
const POSES: usize = 20;

/// Part of the free cells beside walls that become occupied; half as many of all cells become unknown.
const NOISE: f64 = 0.02;

/// Bearings of the same gateway may differ by this much, in radians.
const SAME_BEARING: f64 = 0.35;

pub(super) fn report(data: &Path) -> Result<String, Box<dyn Error>> {
    let maps = data.join("gridmap");
    let crossing = read_floor_plan(&maps.join("evg-thin").join("test1.pgm"), 0.05)?;
    let aces = read_map(&maps.join("aces.yaml"))?;
    let gdc = read_map(&maps.join("gdc3").join("3.yaml"))?;
    let mut text = format!(
        "stability: the same star and gateways in windows of {SMALL_WINDOW} m (ACES: {WINDOW} m), turned and moved at random and with {:.0}% noise\n",
        100.0 * NOISE
    );
    let known = known_places(data)?;
    let points = known.iter().map(|place| place.point).collect::<Vec<_>>();
    let everywhere = PlaceGraph::new(&gdc, &PlaceOptions::default())?;
    let wide = everywhere.places.iter().filter(|place| place.clearance > 0.8).map(|place| place.center);
    let by_axis = |parameters: PlaceOptions| -> Box<Reading> {
        Box::new(move |grid, at| {
            let found = neighborhood(grid, at, &parameters).ok()?;
            Some((found.star, found.center, found.clearance))
        })
    };
    let by_ways: Box<Reading> = Box::new(|grid, at| {
        let options = PlaceOptions::corridors();
        let found = sight(grid, at.into(), &options).filter(|found| found.is_place)?;
        Some((found.star(&options)?, found.center.into(), found.clearance))
    });
    for (name, grid, points, read, window) in [
        ("EVG-Thin", &crossing, vec![[11.1, 7.1]], by_axis(PlaceOptions::default()), SMALL_WINDOW),
        ("ACES, nine places", &aces, points.clone(), by_axis(corridors(8.0)), WINDOW),
        ("ACES, as along logs", &aces, points, by_ways, WINDOW),
        (
            "gdc3, places with 0.8 m around",
            &gdc,
            wide.collect(),
            by_axis(PlaceOptions::default()),
            SMALL_WINDOW,
        ),
    ] {
        let (mut same, mut all) = (0, 0);
        let mut least = POSES;
        for (index, &point) in points.iter().enumerate() {
            let Some(equal) = equal_stars(grid, point, &read, window, index as u64) else { continue };
            (same, all, least) = (same + equal, all + POSES, least.min(equal));
        }
        text += &format!(
            "  {name}: {same} of {all} ({:.0}%), the least stable place {least} of {POSES}\n",
            100.0 * f64::from(same as u32) / f64::from(all as u32)
        );
    }
    Ok(text)
}

/// How a star is read from a grid around a point: with the place's center and its clearance.
type Reading = dyn Fn(&OccupancyGrid, [f64; 2]) -> Option<(LocalStar, [f64; 2], f64)>;

/// In how many random views of the place at `point` its star is the one of the undisturbed view.
fn equal_stars(
    grid: &OccupancyGrid,
    point: [f64; 2],
    read: &Reading,
    window: f64,
    seed: u64,
) -> Option<usize> {
    let (still, center, clearance) = read(&grid.window(point, window)?, point)?;
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut equal = 0;
    for _ in 0..POSES {
        let turn = random.random_range(-3.1..3.1);
        let shift = [0, 1].map(|_| random.random_range(-0.5..0.5) * clearance.min(1.5));
        let robot = [center[0] + shift[0], center[1] + shift[1]];
        let view = view(grid, robot, turn, window, &mut random)?;
        equal += usize::from(read(&view, [0.0, 0.0]).is_some_and(|(seen, ..)| is_same(&still, &seen, turn)));
    }
    Some(equal)
}

/// The grid as a robot sees it that stands at `robot` and is turned by `turn`, with noise.
fn view(
    grid: &OccupancyGrid,
    robot: [f64; 2],
    turn: f64,
    window: f64,
    random: &mut ChaCha8Rng,
) -> Option<OccupancyGrid> {
    let resolution = grid.lattice().resolution();
    let side = (window / resolution) as u32;
    let lattice = Lattice::new(side, side, resolution, [-window / 2.0; 2]).ok()?;
    let (sin, cos) = turn.sin_cos();
    let cells = lattice.cells().map(|cell| {
        let [x, y] = lattice.center(cell);
        let point = [robot[0] + cos * x - sin * y, robot[1] + sin * x + cos * y];
        let here = grid.at(point);
        let draw: f64 = random.random();
        let is_beside_wall = || {
            [[1.5, 0.0], [-1.5, 0.0], [0.0, 1.5], [0.0, -1.5]].iter().any(|[dx, dy]| {
                grid.at([point[0] + dx * resolution, point[1] + dy * resolution]) == Occupancy::Occupied
            })
        };
        match here {
            _ if draw < NOISE / 2.0 => Occupancy::Unknown,
            Occupancy::Free if draw < NOISE && is_beside_wall() => Occupancy::Occupied,
            _ => here,
        }
    });
    OccupancyGrid::new(lattice, cells.collect()).ok()
}

/// Whether there is an isomorphism between the stars that takes every gateway to the one that is where
/// it should be for a robot turned by `turn`.
fn is_same(still: &LocalStar, seen: &LocalStar, turn: f64) -> bool {
    Isomorphism::all(&still.star, &seen.star).any(|isomorphism| {
        still.star.gateways().all(|olp| {
            let there = seen.bearings[isomorphism.apply(olp).index()];
            wrap_angle(still.bearings[olp.index()] - turn - there).abs() <= SAME_BEARING
        })
    })
}
