//! Random worlds and real street networks are planar: by Euler's formula and by crossing tests.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use hssh_world::{
    OfficePlan, Point, World, WorldOlp, cover, graphml, momepy, offices, random_planar, strategies,
};
use proptest::prelude::*;
use robust::{Coord, orient2d};

/// Places − links + faces of a connected world; 2 if its stars embed it in the plane.
fn euler_characteristic(world: &World) -> i64 {
    let next_open = |gateway: WorldOlp| {
        let star = &world.place(gateway.place).star;
        let mut olp = star.next(gateway.olp);
        while !star.is_travelable(olp) {
            olp = star.next(olp);
        }
        WorldOlp { olp, ..gateway }
    };
    let mut walked = BTreeSet::new();
    let mut faces = 0;
    for gateway in world.gateways() {
        let mut dart = gateway;
        faces += i64::from(!walked.contains(&dart));
        while walked.insert(dart) {
            dart = next_open(world.neighbor(dart).expect("every gateway of a world has a link"));
        }
    }
    world.places().len() as i64 - world.links().len() as i64 + faces
}

/// Whether two straight segments have a point in common other than a shared end.
fn cross(a: [Point; 2], b: [Point; 2]) -> bool {
    let coord = |point: Point| Coord { x: point.x, y: point.y };
    let side = |p: Point, q: Point, r: Point| {
        let area = orient2d(coord(p), coord(q), coord(r));
        i32::from(area > 0.0) - i32::from(area < 0.0)
    };
    let shared = a.iter().filter(|&point| b.contains(point)).count();
    let separates = |s: [Point; 2], t: [Point; 2]| side(s[0], s[1], t[0]) * side(s[0], s[1], t[1]);
    // On one line they meet only if their extents do.
    let extents_meet = |axis: fn(Point) -> f64| {
        let [low, high] = [f64::min, f64::max].map(|pick| [a, b].map(|s| pick(axis(s[0]), axis(s[1]))));
        low[0].max(low[1]) <= high[0].min(high[1])
    };
    let extents = extents_meet(|point| point.x) && extents_meet(|point| point.y);
    shared == 0 && extents && separates(a, b) <= 0 && separates(b, a) <= 0
}

fn segments(world: &World) -> Vec<[Point; 2]> {
    let ways = world.links().iter().map(|link| world.way(link.ends[0]).expect("a link has a way"));
    ways.flat_map(|way| way.windows(2).map(|piece| [piece[0], piece[1]]).collect::<Vec<_>>()).collect()
}

fn crossings(world: &World) -> usize {
    let segments = segments(world);
    let pairs = (0..segments.len()).flat_map(|second| (0..second).map(move |first| (first, second)));
    pairs.filter(|&(first, second)| cross(segments[first], segments[second])).count()
}

proptest! {
    #[test]
    fn random_worlds_are_planar_and_connected(places in 2u32..60, density in 0.0..=1.0, seed: u64) {
        let world = random_planar(places, density, 8.0, seed).unwrap();
        prop_assert_eq!(world.places().len(), places as usize);
        prop_assert_eq!(euler_characteristic(&world), 2);
        prop_assert_eq!(crossings(&world), 0);
        prop_assert!(cover(&world, seed).is_ok());
        prop_assert_eq!(random_planar(places, density, 8.0, seed), Ok(world));
    }

    #[test]
    fn density_decides_the_number_of_links(places in 2u32..40, seed: u64) {
        let links = |density| random_planar(places, density, 8.0, seed).unwrap().links().len();
        prop_assert_eq!(links(0.0), places as usize - 1);
        prop_assert!(links(0.0) <= links(0.5) && links(0.5) <= links(1.0));
        // A triangulation has at most 3n − 6 edges, at least 2n − 3 if not all points are in line.
        if places >= 3 {
            prop_assert!((2 * places as usize - 3..=3 * places as usize - 6 + usize::from(places == 3)).contains(&links(1.0)));
        }
    }

    #[test]
    fn office_floors_are_planar_and_connected(rows in 1u32..6, columns in 2u32..6, loops in 0.0..=1.0, doors in 0u32..5, seed: u64) {
        let plan = OfficePlan { rows, columns, loops, doors, spacing: 16.0 };
        let world = offices(&plan, seed).unwrap();
        prop_assert_eq!(euler_characteristic(&world), 2);
        prop_assert_eq!(crossings(&world), 0);
        prop_assert!(cover(&world, seed).is_ok());
        prop_assert_eq!(offices(&plan, seed), Ok(world));
    }

    #[test]
    fn worlds_for_tests_are_planar_and_have_simple_paths(seed: u64) {
        let world = strategies::random_simple_world(seed);
        prop_assert_eq!(euler_characteristic(&world), 2);
        prop_assert!(world.has_simple_paths());
        let (route_world, route) = strategies::random_route(seed);
        prop_assert_eq!(&route_world, &world);
        prop_assert_eq!(strategies::random_exploration(seed).travels().len(), route.exits.len());
    }

    #[test]
    fn every_local_path_lies_on_one_path(seed: u64) {
        let world = strategies::random_world(seed);
        let local_paths: usize = world.places().iter().map(|place| place.star.ends().len() / 2).sum();
        let on_paths: usize = world.paths().iter().map(|path| path.places.len()).sum();
        prop_assert_eq!(on_paths, local_paths);
    }

    #[test]
    fn bearings_are_clockwise_and_point_along_the_ways(seed: u64) {
        let world = strategies::random_world(seed);
        for place in world.places() {
            let turn: f64 = (0..place.bearings.len())
                .map(|end| place.bearings[end] - place.bearings[(end + 1) % place.bearings.len()])
                .map(|turn| turn.rem_euclid(std::f64::consts::TAU))
                .sum();
            prop_assert!((turn - std::f64::consts::TAU).abs() < 1e-9);
        }
        for gateway in world.gateways() {
            let way = world.way(gateway).unwrap();
            let bearing = world.place(gateway.place).bearings[gateway.olp.index()];
            prop_assert!((way[0].bearing_to(way[1]) - bearing).abs() < 1e-12);
        }
    }
}

#[test]
#[allow(clippy::print_stderr)] // says why nothing was tested
fn real_street_networks_are_planar_worlds() {
    let Some(data) = std::env::var_os("HSSH_DATA").map(PathBuf::from) else {
        eprintln!("skipped: set HSSH_DATA to the folder with streets/");
        return;
    };
    let text = |name: &str| fs::read_to_string(data.join("streets").join(name)).unwrap();
    let new_york = graphml::read(&text("nyc_graph.graphml")).unwrap().to_world().unwrap();
    assert_eq!((new_york.places().len(), new_york.links().len()), (46, 73));
    let bubenec = momepy::read(&text("bubenec_streets.txt")).unwrap().to_world().unwrap();
    assert_eq!((bubenec.places().len(), bubenec.links().len()), (29, 35));
    for world in [new_york, bubenec] {
        assert_eq!(euler_characteristic(&world), 2);
        assert_eq!(crossings(&world), 0);
        let route = cover(&world, 1).unwrap();
        assert_eq!(world.explore(&route).unwrap().travels().len(), route.exits.len());
    }
}
