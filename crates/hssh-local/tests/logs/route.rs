//! What holds of the visits of every survey, in buildings whose crossings are known.

use std::collections::BTreeMap;

use hssh_local::{LaserLog, Survey, SurveyOptions, Visit, survey};
use hssh_metrics::Pose;
use hssh_topology::Olp;

use crate::simulator::{around, drifting, drive, log};

/// A building: its corridors as boxes, and the robot's way.
struct World {
    name: &'static str,
    corridors: Vec<[[f64; 2]; 2]>,
    way: Vec<[f64; 2]>,
    /// What is visited: where in the building, and how many ways lead on there.
    visits: Vec<([f64; 2], usize)>,
}

/// A corridor of 2 m along a line parallel to an axis, as long as the line and a metre more at both ends.
fn corridor(from: [f64; 2], to: [f64; 2]) -> [[f64; 2]; 2] {
    [
        [from[0].min(to[0]) - 1.0, from[1].min(to[1]) - 1.0],
        [from[0].max(to[0]) + 1.0, from[1].max(to[1]) + 1.0],
    ]
}

fn worlds() -> Vec<World> {
    let (a, b, c, d) = ([0.0, 0.0], [24.0, 0.0], [24.0, 24.0], [0.0, 24.0]);
    let ring = [(a, b), (b, c), (c, d), (d, a)];
    let ring: Vec<_> = ring.iter().map(|&(from, to)| corridor(from, to)).collect();
    let with = |more: &[([f64; 2], [f64; 2])]| {
        ring.iter().copied().chain(more.iter().map(|&(from, to)| corridor(from, to))).collect::<Vec<_>>()
    };
    vec![
        World {
            name: "twice around a ring with ways out",
            corridors: with(&[([-18.0, 0.0], a), (c, [42.0, 24.0])]),
            way: vec![[-14.0, 0.0], b, c, d, a, b, c, [36.0, 24.0]],
            visits: vec![(a, 3), (b, 2), (c, 3), (d, 2), (a, 3), (b, 2), (c, 3)],
        },
        World {
            name: "around a ring and back",
            corridors: with(&[([-18.0, 0.0], a), (c, [42.0, 24.0])]),
            way: vec![[-14.0, 0.0], b, c, d, a, d, c, [36.0, 24.0]],
            visits: vec![(a, 3), (b, 2), (c, 3), (d, 2), (a, 3), (d, 2), (c, 3)],
        },
        World {
            name: "an eight",
            corridors: with(&[(b, [48.0, 0.0]), ([48.0, 0.0], [48.0, 24.0]), ([48.0, 24.0], c)]),
            way: vec![[8.0, 0.0], b, c, d, a, [48.0, 0.0], [48.0, 24.0], [12.0, 24.0]],
            visits: vec![(b, 3), (c, 3), (d, 2), (a, 2), (b, 3), ([48.0, 0.0], 2), ([48.0, 24.0], 2), (c, 3)],
        },
        World {
            name: "a comb, in and out of each tooth",
            corridors: vec![
                corridor([-18.0, 0.0], [54.0, 0.0]),
                corridor(a, [0.0, 16.0]),
                corridor([12.0, 0.0], [12.0, -16.0]),
                corridor([24.0, 0.0], [24.0, 16.0]),
            ],
            way: vec![
                [-14.0, 0.0],
                a,
                [0.0, 15.0],
                a,
                [12.0, 0.0],
                [12.0, -15.0],
                [12.0, 0.0],
                [24.0, 0.0],
                [24.0, 15.0],
                [24.0, 0.0],
                [44.0, 0.0],
            ],
            visits: vec![
                (a, 3),
                ([0.0, 15.0], 1),
                (a, 3),
                ([12.0, 0.0], 3),
                ([12.0, -15.0], 1),
                ([12.0, 0.0], 3),
                ([24.0, 0.0], 3),
                ([24.0, 15.0], 1),
                ([24.0, 0.0], 3),
            ],
        },
        World {
            name: "ways out that nobody goes",
            corridors: vec![
                corridor([-24.0, 0.0], [54.0, 0.0]),
                corridor(a, [0.0, 20.0]),
                corridor([16.0, 0.0], [16.0, -20.0]),
                corridor([32.0, -20.0], [32.0, 20.0]),
            ],
            way: vec![[-14.0, 0.0], [44.0, 0.0]],
            visits: vec![(a, 3), ([16.0, 0.0], 3), ([32.0, 0.0], 4)],
        },
        World {
            name: "a crossing in all directions",
            corridors: vec![corridor([-20.0, 0.0], [20.0, 0.0]), corridor([0.0, -20.0], [0.0, 20.0])],
            way: vec![[-14.0, 0.0], [18.5, 0.0], a, [0.0, 18.5], [0.0, -18.5], a, [-14.0, 0.0]],
            visits: vec![
                (a, 4),
                ([18.5, 0.0], 1),
                (a, 4),
                ([0.0, 18.5], 1),
                (a, 4),
                ([0.0, -18.5], 1),
                (a, 4),
            ],
        },
    ]
}

/// The survey of a building by a robot that begins turned by `turn` radians; its odometry bends by `bend` radians for
/// each metre, with noise.
fn surveyed(world: &World, turn: f64, bend: f64) -> Survey {
    let mut poses = drive(&world.way, 0.6);
    let steps = (turn.abs() / 0.2).ceil() as u32;
    let turned = (1..=steps).rev().map(|step| {
        let theta = poses[0].theta + turn * f64::from(step) / f64::from(steps);
        Pose { theta, ..poses[0] }
    });
    poses = turned.chain(poses.iter().copied()).collect();
    let odometry = if bend > 0.0 { drifting(&poses, bend, 3) } else { poses.clone() };
    let text = log(&around(&world.corridors), &poses, &odometry);
    survey(LaserLog::read(text.as_bytes()).unwrap(), &SurveyOptions::default(), |_, _| ()).unwrap().1
}

/// Where a visit's place is in the building. The track's frame is that of the robot's first pose; all ways begin
/// eastward.
fn place(world: &World, visit: &Visit, turn: f64) -> [f64; 2] {
    let (sin, cos) = turn.sin_cos();
    let (x, y) = (visit.frame.x, visit.frame.y);
    [world.way[0][0] + cos * x - sin * y, world.way[0][1] + sin * x + cos * y]
}

fn visits_are_true(world: &World, turn: f64, off: f64, survey: &Survey) {
    let found: Vec<([f64; 2], usize)> = survey
        .visits
        .iter()
        .map(|visit| (place(world, visit, turn).map(f64::round), visit.star.gateways().count()))
        .collect();
    let name = world.name;
    assert_eq!(found.len(), world.visits.len(), "{name}: {found:?}");
    for (visit, (at, ways)) in survey.visits.iter().zip(&world.visits) {
        let [x, y] = place(world, visit, turn);
        assert!((x - at[0]).hypot(y - at[1]) < off, "{name}: {x} {y} is not {at:?} of {found:?}");
        assert_eq!(visit.star.gateways().count(), *ways, "{name}: at {at:?}");
    }
    for (one, other) in pairs(&survey.visits) {
        let ([x, y], at) = (place(world, one, turn), place(world, other, turn));
        let is_same = (x - at[0]).hypot(y - at[1]) < 3.0;
        assert_eq!(one.spot == other.spot, is_same, "{name}: {x} {y} and {at:?}");
    }
}

fn pairs(visits: &[Visit]) -> impl Iterator<Item = (&Visit, &Visit)> {
    visits.iter().enumerate().flat_map(|(index, one)| visits[..index].iter().map(move |other| (one, other)))
}

fn visits_to_one_spot_show_one_star(name: &str, survey: &Survey) {
    for (one, other) in pairs(&survey.visits).filter(|(one, other)| one.spot == other.spot) {
        assert_eq!(one.star, other.star, "{name}: spot {}", one.spot);
        assert_eq!(one.frame, other.frame, "{name}: spot {}", one.spot);
    }
}

fn ends_are_travelable_and_known(name: &str, survey: &Survey) {
    let last = survey.visits.len() - 1;
    for (index, visit) in survey.visits.iter().enumerate() {
        assert_eq!(visit.entry.is_some(), index > 0, "{name}: entry of visit {index}");
        assert_eq!(visit.exit.is_some(), index < last, "{name}: exit of visit {index}");
        for end in [visit.entry, visit.exit].into_iter().flatten() {
            assert!(visit.star.star.is_travelable(end), "{name}: {end:?} of visit {index}");
        }
        assert!(
            visit.scans.0 <= visit.reference && visit.reference <= visit.scans.1,
            "{name}: visit {index}"
        );
    }
    for pair in survey.visits.windows(2) {
        assert!(pair[0].scans.1 < pair[1].scans.0, "{name}: {:?} {:?}", pair[0].scans, pair[1].scans);
    }
}

/// A way has two ends: who leaves by the one comes in by the other, in both directions.
fn ways_have_two_ends(name: &str, survey: &Survey) {
    let mut other_end: BTreeMap<(usize, Olp), (usize, Olp)> = BTreeMap::new();
    for pair in survey.visits.windows(2) {
        let exit = (pair[0].spot, pair[0].exit.unwrap());
        let entry = (pair[1].spot, pair[1].entry.unwrap());
        for (one, other) in [(exit, entry), (entry, exit)] {
            let before = *other_end.entry(one).or_insert(other);
            assert_eq!(before, other, "{name}: from {one:?}");
        }
    }
}

/// `off` is how many metres places may be off by in the frame of the first pose.
fn check(world: &World, turn: f64, bend: f64, off: f64) {
    let survey = surveyed(world, turn, bend);
    visits_are_true(world, turn, off, &survey);
    visits_to_one_spot_show_one_star(world.name, &survey);
    ends_are_travelable_and_known(world.name, &survey);
    ways_have_two_ends(world.name, &survey);
    assert_eq!(survey.evidence.contradicted, 0, "{}", world.name);
    survey.exploration().unwrap();
}

#[test]
fn buildings_come_out_as_they_were_built() {
    worlds().iter().for_each(|world| check(world, 0.0, 0.0, 0.6));
}

#[test]
fn buildings_come_out_however_they_are_turned() {
    worlds().iter().for_each(|world| check(world, 0.5, 0.0, 0.6));
}

/// Where corridors tell nothing, odometry that drifts displaces what follows: not what there is, but where. Crossings
/// are at least 12 m apart.
#[test]
fn buildings_come_out_although_odometry_drifts() {
    worlds().iter().for_each(|world| check(world, -2.0, 0.01, 3.0));
}

/// Where the robot turned back at the beginning or at the end of a log, and came to no other place before or after.
#[test]
fn dead_ends_at_both_ends_of_a_log_are_visited() {
    let (a, b, c) = ([0.0, 0.0], [16.0, 0.0], [16.0, 16.0]);
    let world = World {
        name: "a corner between dead ends",
        corridors: vec![corridor(a, b), corridor(b, c)],
        way: vec![[7.0, 0.0], b, c, b, a, b, [16.0, 8.0]],
        visits: vec![(b, 2), (c, 1), (b, 2), (a, 1), (b, 2)],
    };
    check(&world, 0.0, 0.0, 0.6);
    let way = vec![[9.0, 0.0], a, b, c, [16.0, 7.0]];
    // All ways begin eastward: this one begins in the west.
    let mirrored = |[x, y]: [f64; 2]| [-x, y];
    let world = World {
        name: "from dead end to dead end",
        corridors: vec![corridor(a, mirrored(b)), corridor(mirrored(b), mirrored(c))],
        way: way.into_iter().map(mirrored).collect(),
        visits: vec![(a, 1), (mirrored(b), 2), (mirrored(c), 1)],
    };
    check(&world, 0.0, 0.0, 0.6);
}

/// Corridors without anything that tells how far along them one is, gone through again and again: where a match
/// happens to lie along them is no observation.
#[test]
fn closures_in_bare_corridors_displace_nothing() {
    let at = |column: u32, row: u32| [16.0 * f64::from(column), 16.0 * f64::from(row)];
    let (corner, crossing, stub, end) = (at(0, 0), at(1, 0), at(1, 1), at(0, 2));
    let world = World {
        name: "bare corridors",
        corridors: vec![
            corridor(corner, at(2, 0)),
            corridor(corner, end),
            corridor(crossing, stub),
            corridor(at(2, 0), at(2, 2)),
            corridor(end, at(2, 2)),
        ],
        way: vec![
            [8.0, 0.0],
            crossing,
            stub,
            crossing,
            corner,
            end,
            at(1, 2),
            end,
            corner,
            crossing,
            stub,
            crossing,
            corner,
            [0.0, 24.0],
        ],
        visits: [(crossing, 3), (stub, 1), (crossing, 3), (corner, 2), (end, 2), (corner, 2)]
            .into_iter()
            .chain([(crossing, 3), (stub, 1), (crossing, 3), (corner, 2)])
            .collect(),
    };
    check(&world, 0.0, 0.0, 0.6);
}
