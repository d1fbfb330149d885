//! Closing loops: a drifting track comes out as the robot went, and places that only look alike stay apart.

use hssh_local::{
    ClosedTrack, ClosingOptions, Closure, LaserLog, MatchOptions, MotionNoise, Track, TrackedScan,
    close_loops,
};
use hssh_metrics::{Options, Pose, solve, wrap_angle};

use crate::simulator::{around, drifting, drive, log};

/// A box of free space: its low and its high corner, in metres.
type Space = [[f64; 2]; 2];

/// Niches beside a corridor along the y axis with its middle at `x`, all on its right side: where along it they are,
/// and how wide.
fn niches(x: f64, at: &[(f64, f64)]) -> Vec<Space> {
    at.iter().map(|&(y, width)| [[x, y], [x + 1.75, y + width]]).collect()
}

/// The track of a robot that believes its odometry.
fn believing(odometry: &[Pose]) -> Track {
    let noise =
        MotionNoise { distance: 0.03, sideways: 0.02, heading: 0.004, turn: 0.004, floor: (0.003, 0.0005) };
    let mut travelled = 0.0;
    let scan = |index: usize| {
        let step = index.checked_sub(1).map(|before| noise.motion(&odometry[before..=index]));
        travelled += step.map_or(0.0, |step| step.mean.translation().norm());
        TrackedScan { pose: odometry[0].between(odometry[index]), step, travelled }
    };
    Track { scans: (0..odometry.len()).map(scan).collect(), lost: Vec::new() }
}

struct Closed {
    truth: Vec<Pose>,
    track: Track,
    closed: ClosedTrack,
}

impl Closed {
    /// `track` makes a track of a log; odometry bends by `bend` radians for each metre.
    fn new(spaces: &[Space], way: &[[f64; 2]], bend: f64, track: impl Fn(&LaserLog) -> Track) -> Self {
        let truth = drive(way, 0.4);
        let odometry = drifting(&truth, bend, 7);
        let log = LaserLog::read(log(&around(spaces), &truth, &odometry).as_bytes()).unwrap();
        let track = track(&log);
        let closed = close_loops(&log, &track, &ClosingOptions::default(), |_| ()).unwrap();
        Closed { truth, track, closed }
    }

    /// How far poses are off the truth at most, in metres, where they lie best on it.
    fn error(&self, poses: &[Pose]) -> f64 {
        let complex = |pose: &Pose| [pose.x, pose.y];
        let mean = |poses: &[Pose]| {
            let sum = poses.iter().map(complex).fold([0.0, 0.0], |sum, at| [sum[0] + at[0], sum[1] + at[1]]);
            sum.map(|sum| sum / poses.len() as f64)
        };
        let (middle, true_middle) = (mean(poses), mean(&self.truth));
        let from = |pose: &Pose, middle: [f64; 2]| [pose.x - middle[0], pose.y - middle[1]];
        let pairs: Vec<[[f64; 2]; 2]> = poses
            .iter()
            .zip(&self.truth)
            .map(|(pose, truth)| [from(pose, middle), from(truth, true_middle)])
            .collect();
        let sin: f64 = pairs.iter().map(|[a, b]| a[0] * b[1] - a[1] * b[0]).sum();
        let cos: f64 = pairs.iter().map(|[a, b]| a[0] * b[0] + a[1] * b[1]).sum();
        let (sin, cos) = (sin / sin.hypot(cos), cos / sin.hypot(cos));
        let off =
            |[a, b]: &[[f64; 2]; 2]| (cos * a[0] - sin * a[1] - b[0]).hypot(sin * a[0] + cos * a[1] - b[1]);
        pairs.iter().map(off).fold(0.0, f64::max)
    }

    /// How far what a closure tells is off the truth, in the frame of the later scan.
    fn off(&self, closure: &Closure) -> Pose {
        self.between(closure).between(closure.relative)
    }

    /// The same in standard deviations of the closure: along a corridor without features, nothing is known.
    fn sigmas(&self, closure: &Closure) -> f64 {
        let (truth, told) = (self.between(closure), closure.relative);
        let off = nalgebra::vector![told.x - truth.x, told.y - truth.y, wrap_angle(told.theta - truth.theta)];
        off.dot(&(closure.covariance.information().matrix() * off)).sqrt()
    }

    /// Where the later scan of a closure was taken in truth, in the frame of the earlier one.
    fn between(&self, closure: &Closure) -> Pose {
        self.truth[closure.earlier].between(self.truth[closure.later])
    }

    fn tracked(&self) -> Vec<Pose> {
        self.track.scans.iter().map(|scan| scan.pose).collect()
    }
}

fn matched(log: &LaserLog) -> Track {
    hssh_local::track(log, &MatchOptions::default(), |_| ())
}

fn believed(log: &LaserLog) -> Track {
    believing(&log.trajectory)
}

/// A ring of corridors with niches, 24 m long and wide.
fn ring() -> Vec<Space> {
    [
        vec![
            [[-1.0, -1.0], [25.0, 1.0]],
            [[-1.0, 23.0], [25.0, 25.0]],
            [[-1.0, -1.0], [1.0, 25.0]],
            [[23.0, -1.0], [25.0, 25.0]],
            [[5.0, -1.75], [6.0, 0.0]],
            [[11.0, -1.75], [13.0, 0.0]],
            [[7.0, 23.0], [8.5, 25.75]],
            [[16.0, 23.0], [18.0, 25.75]],
        ],
        niches(0.0, &[(5.0, 1.0), (9.0, 2.0), (16.0, 1.25)]),
        niches(24.0, &[(3.0, 2.0), (10.0, 1.0), (14.0, 1.25), (19.0, 1.0)]),
    ]
    .concat()
}

/// Around the ring, from near a corner.
const ONCE: [[f64; 2]; 5] = [[2.0, 0.0], [24.0, 0.0], [24.0, 24.0], [0.0, 24.0], [0.0, 0.0]];

/// The same once more, and half of the first side.
fn twice() -> Vec<[f64; 2]> {
    [&ONCE[..], &ONCE[1..], &[[12.0, 0.0]]].concat()
}

#[test]
fn a_track_that_drifts_by_metres_is_closed() {
    let closed = Closed::new(&ring(), &twice(), 0.002, believed);
    let (before, after) = (closed.error(&closed.tracked()), closed.error(closed.closed.poses()));
    assert!(before > 2.0 && after < 0.2, "{before} m, closed {after} m");
    assert!(closed.closed.closures.len() > 20, "{:?}", closed.closed.closures);
    all_scans_are_in_one_graph(&closed);
    for closure in &closed.closed.closures {
        let off = closed.off(closure);
        assert!(closed.sigmas(closure) < 5.0 && off.theta.abs() < 0.03, "{closure:?} is off by {off:?}");
        assert!(
            closed.between(closure).translation().norm() < 2.0 * ClosingOptions::default().stretch,
            "{closure:?} joins submaps that have nothing in common"
        );
        assert!(closure.weight > 0.5, "{closure:?}");
    }
}

#[test]
fn what_scan_matching_leaves_is_closed() {
    let closed = Closed::new(&ring(), &twice(), 0.02, matched);
    let (before, after) = (closed.error(&closed.tracked()), closed.error(closed.closed.poses()));
    assert!(before > 3.0 * after && after < 0.08, "{before} m, closed {after} m");
    assert!(closed.closed.closures.len() > 20, "{:?}", closed.closed.closures);
    for closure in &closed.closed.closures {
        let off = closed.off(closure);
        assert!(closed.sigmas(closure) < 5.0 && off.theta.abs() < 0.02, "{closure:?} is off by {off:?}");
    }
}

/// A pose for each scan, an edge for each step, more than the closures beside them, and nothing left to be gained.
fn all_scans_are_in_one_graph(closed: &Closed) {
    let ClosedTrack { graph, closures, .. } = &closed.closed;
    let scans = closed.track.scans.len();
    let steps = graph.edges().iter().filter(|edge| edge.to.0 == edge.from.0 + 1).count();
    assert_eq!((graph.poses().len(), steps), (scans, scans - 1));
    assert!(graph.edges().len() - steps > closures.len());
    let solved = solve(graph, &Options::default()).unwrap();
    assert!((solved.chi2 - graph.chi2()).abs() < 1e-6 * graph.chi2(), "{} {}", solved.chi2, graph.chi2());
}

/// Niches show only the one or the other side to those who pass, so that along a corridor little tells how far one
/// is; across it everything does.
#[test]
fn the_opposite_direction_closes_too() {
    let again = [[24.0, 0.0], [0.0, 0.0], [0.0, 24.0], [24.0, 24.0], [24.0, 2.0]];
    let closed = Closed::new(&ring(), &[&ONCE[..], &again].concat(), 0.01, matched);
    let (before, after) = (closed.error(&closed.tracked()), closed.error(closed.closed.poses()));
    assert!(before > 3.0 * after && after < 0.08, "{before} m, closed {after} m");
    let mut opposite = 0;
    for closure in &closed.closed.closures {
        let off = closed.off(closure);
        assert!(closed.sigmas(closure) < 5.0 && off.theta.abs() < 0.03, "{closure:?}: {off:?}");
        let between = closed.between(closure);
        assert!(between.translation().norm() < ClosingOptions::default().stretch, "{closure:?}");
        opposite += usize::from(between.theta.abs() > 3.0);
    }
    assert!(opposite > 10, "{opposite} of {:?}", closed.closed.closures);
}

/// Doorways as wide as one's shift of a corridor: coming back one sees their other jambs, which must not be taken for those seen before.
#[test]
fn the_jambs_seen_on_the_way_back_are_others() {
    let doors =
        [2.5, 6.0, 9.25, 13.0, 15.5, 19.0, 23.5, 27.0, 30.25, 34.0, 38.5, 42.0, 45.25, 49.0, 52.5, 55.0];
    let door = |(index, &x): (usize, &f64)| -> Space {
        let out = if index % 3 == 0 { -1.25 } else { 1.25 };
        [[x, f64::min(out, 0.0)], [x + 1.0, f64::max(out, 0.0)]]
    };
    let mut spaces = vec![[[-1.0, -1.0], [60.0, 1.0]], [[58.0, -1.0], [60.0, 8.0]]];
    spaces.extend(doors.iter().enumerate().map(door));
    let way = [[0.0, 0.0], [59.0, 0.0], [59.0, 6.0], [59.0, 0.0], [1.0, 0.0]];
    let closed = Closed::new(&spaces, &way, 0.002, matched);
    let opposite = closed.closed.closures.iter().filter(|one| closed.between(one).theta.abs() > 3.0).count();
    assert!(opposite > 5, "{opposite}");
    for closure in &closed.closed.closures {
        assert!(closed.sigmas(closure) < 5.0, "{closure:?} is off by {:?}", closed.off(closure));
    }
    let after = closed.error(closed.closed.poses());
    assert!(after < 0.4, "{after} m");
}

/// Where niches are along corridors that look alike, and how wide.
const ALIKE: [(f64, f64); 4] = [(4.0, 1.0), (7.0, 2.0), (11.0, 1.25), (15.0, 1.5)];

/// Closures that tell of scans that they are where they are not.
fn wrong(closed: &Closed) -> Vec<(&Closure, Pose)> {
    let off = closed.closed.closures.iter().map(|closure| (closure, closed.between(closure)));
    off.filter(|(closure, _)| closed.sigmas(closure) > 8.0).collect()
}

/// Two corridors that look alike lead from another one, and the robot goes into the one and into the other.
#[test]
fn corridors_that_look_alike_stay_apart() {
    let corridors = [[[-5.0, -1.0], [22.0, 1.0]], [[-1.0, -1.0], [1.0, 20.0]], [[6.0, -1.0], [8.0, 20.0]]];
    let spaces = [&corridors[..], &niches(0.0, &ALIKE), &niches(7.0, &ALIKE)].concat();
    let way =
        [[-4.0, 0.0], [0.0, 0.0], [0.0, 18.0], [0.0, 0.0], [7.0, 0.0], [7.0, 18.0], [7.0, 0.0], [20.0, 0.0]];
    for track in [believed, matched] {
        let closed = Closed::new(&spaces, &way, 0.001, track);
        assert_eq!(wrong(&closed), []);
        let after = closed.error(closed.closed.poses());
        assert!(after < 0.5, "{after} m");
    }
}

/// The robot goes up one corridor and down another one beside it.
#[test]
fn neighboring_corridors_that_look_alike_stay_apart() {
    for apart in [4.0, 6.0] {
        let corridors = [
            [[-1.0, -1.0], [1.0, 25.0]],
            [[apart - 1.0, -1.0], [apart + 1.0, 25.0]],
            [[-1.0, 23.0], [apart + 1.0, 25.0]],
        ];
        let spaces = [&corridors[..], &niches(0.0, &ALIKE), &niches(apart, &ALIKE)].concat();
        let way = [[0.0, 0.0], [0.0, 24.0], [apart, 24.0], [apart, 0.0]];
        let closed = Closed::new(&spaces, &way, 0.001, believed);
        assert_eq!(closed.closed.closures, []);
    }
}

/// The robot comes after so long a way that it might have drifted from one corridor to the other, for all that it
/// knows of itself.
#[test]
fn corridors_that_look_alike_stay_apart_after_a_long_way() {
    for (apart, detour) in [(4.0, 40.0), (6.0, 40.0), (8.0, 100.0)] {
        let corridors = [
            [[-1.0, -1.0], [1.0, 25.0]],
            [[apart - 1.0, -1.0], [apart + 1.0, 25.0]],
            [[-1.0, 23.0], [apart + detour + 1.0, 25.0]],
            [[apart + detour - 1.0, -1.0], [apart + detour + 1.0, 25.0]],
            [[apart - 1.0, -1.0], [apart + detour + 1.0, 1.0]],
        ];
        let spaces = [&corridors[..], &niches(0.0, &ALIKE), &niches(apart, &ALIKE)].concat();
        let far = apart + detour;
        let way = [[0.0, 0.0], [0.0, 24.0], [far, 24.0], [far, 0.0], [apart, 0.0], [apart, 22.0]];
        for track in [believed, matched] {
            let closed = Closed::new(&spaces, &way, 0.0003, track);
            let (before, after) = (closed.error(&closed.tracked()), closed.error(closed.closed.poses()));
            eprintln!(
                "{apart} m apart: {} wrong closures; {before} m off, closed {after} m",
                wrong(&closed).len()
            );
            assert_eq!(wrong(&closed), [], "{apart} m apart");
        }
    }
}
