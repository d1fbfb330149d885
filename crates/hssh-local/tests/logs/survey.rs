//! Surveys: a simulated building comes out as it was built, and a real log as people know it.

use std::path::Path;

use hssh_local::{LaserLog, Survey, SurveyError, SurveyOptions, global_poses, resemblance, survey};
use hssh_metrics::Pose;
use hssh_topology::Isomorphism;

use crate::simulator::{around, drive, log};

fn surveyed(text: &str) -> Result<Survey, SurveyError> {
    let log = LaserLog::read(text.as_bytes()).unwrap();
    survey(log, &SurveyOptions::default(), |_, _| ()).map(|(_, survey)| survey)
}

/// Two storeys of a ladder: corridors along y = 0 and y = 24, rungs at x = 0 and x = 24, and corridors
/// that go on beyond the corners at the left.
fn ladder() -> Survey {
    let walls = around(&[
        [[-20.0, -1.0], [25.0, 1.0]],
        [[-20.0, 23.0], [25.0, 25.0]],
        [[-1.0, -1.0], [1.0, 25.0]],
        [[23.0, -1.0], [25.0, 25.0]],
    ]);
    let way = [[-14.0, 0.0], [24.0, 0.0], [24.0, 24.0], [0.0, 24.0], [0.0, 0.0], [12.0, 0.0]];
    let poses = drive(&way, 0.5);
    surveyed(&log(&walls, &poses, &poses)).unwrap()
}

#[test]
fn a_ladder_is_found_with_its_stars_and_the_ways_taken() {
    let survey = ladder();
    let ways: Vec<usize> = survey.visits.iter().map(|visit| visit.star.gateways().count()).collect();
    assert_eq!(ways, [3, 2, 2, 3, 3]);
    // T from the left, corner, corner, T from the right, and the first T again, from above.
    let exploration = survey.exploration().unwrap();
    assert_eq!(exploration.travels().len(), 4);
    for (visit, center) in
        survey.visits.iter().zip([[0.0, 0.0], [24.0, 0.0], [24.0, 24.0], [0.0, 24.0], [0.0, 0.0]])
    {
        // The track starts 14 m to the left of the first crossing.
        let off = [visit.frame.x - 14.0 - center[0], visit.frame.y - center[1]];
        assert!(off[0].hypot(off[1]) < 0.5, "{:?} is not near {center:?}", visit.frame);
    }
    for travel in exploration.travels() {
        let odometry = travel.odometry.unwrap();
        assert!((odometry.x.hypot(odometry.y) - 24.0).abs() < 0.7, "{odometry:?}");
    }
    let heading = |visit: usize, end: Option<hssh_topology::Olp>| {
        let degrees = survey.visits[visit].star.bearings[end.unwrap().index()].to_degrees();
        (degrees / 90.0).round().rem_euclid(4.0) as u32
    };
    let exits: Vec<u32> = (0..4).map(|visit| heading(visit, survey.visits[visit].exit)).collect();
    let entries: Vec<u32> = (1..5).map(|visit| heading(visit, survey.visits[visit].entry)).collect();
    assert_eq!((exits, entries), (vec![0, 1, 2, 3], vec![2, 3, 0, 1]));
}

/// Where every visit's frame is where the track has it, so is every scan.
#[test]
fn the_track_itself_is_a_global_frame() {
    let survey = ladder();
    let frames: Vec<Pose> = survey.visits.iter().map(|visit| visit.frame).collect();
    for (pose, tracked) in global_poses(&survey, &frames).iter().zip(&survey.track.scans) {
        let off = tracked.pose.between(*pose);
        assert!(off.translation().norm() < 1e-9 && off.theta.abs() < 1e-9);
    }
}

/// Every place looks like itself, and like itself when the robot comes back another way.
#[test]
fn local_maps_resemble_themselves() {
    let survey = ladder();
    for visit in &survey.visits {
        let star = &visit.star.star;
        let itself = resemblance(visit, visit, Isomorphism::identity(star)).unwrap();
        assert!(itself.log_likelihood_ratio > 5.0 && itself.agreement > 0.99, "{itself:?}");
        assert!(itself.placed.translation().norm() < 0.2 && itself.placed.theta.abs() < 0.03, "{itself:?}");
    }
    let [first, .., again] = &survey.visits[..] else { panic!("there are visits") };
    let phi = Isomorphism::all(&again.star.star, &first.star.star).next().unwrap();
    assert!(resemblance(first, again, phi).unwrap().log_likelihood_ratio > 5.0);
}

/// Nothing along it is a place, so that its two ends are all there is.
#[test]
fn a_corridor_is_one_way() {
    let walls = around(&[[[-30.0, -1.0], [40.0, 1.0]]]);
    let poses = drive(&[[0.0, 0.0], [10.0, 0.0]], 0.5);
    let survey = surveyed(&log(&walls, &poses, &poses)).unwrap();
    let ways: Vec<usize> = survey.visits.iter().map(|visit| visit.star.gateways().count()).collect();
    assert_eq!((survey.visits.len(), survey.travels.len()), (2, 1));
    assert!(ways.iter().all(|&ways| ways == 1), "{ways:?}");
    assert!(survey.exploration().is_ok());
}

#[test]
fn a_robot_that_stands_still_is_at_one_place() {
    let walls = around(&[[[-30.0, -1.0], [40.0, 1.0]]]);
    let poses = vec![Pose::IDENTITY; 3];
    let survey = surveyed(&log(&walls, &poses, &poses)).unwrap();
    assert_eq!((survey.visits.len(), survey.travels.len()), (1, 0));
}

/// A corridor with a spur of 13 m, into which the robot goes and comes back.
#[test]
fn a_dead_end_is_a_place_between_two_visits_to_its_crossing() {
    let walls = around(&[[[-20.0, -1.0], [25.0, 1.0]], [[-1.0, -1.0], [1.0, 13.0]]]);
    let poses = drive(&[[-14.0, 0.0], [0.0, 0.0], [0.0, 11.5], [0.0, 0.0], [14.0, 0.0]], 0.5);
    let survey = surveyed(&log(&walls, &poses, &poses)).unwrap();
    let ways: Vec<usize> = survey.visits.iter().map(|visit| visit.star.gateways().count()).collect();
    assert_eq!(ways, [3, 1, 3]);
    let dead_end = &survey.visits[1];
    assert!(dead_end.entry.is_some() && dead_end.entry == dead_end.exit);
    // Its spot is where the robot turned back.
    let off = [dead_end.frame.x - 14.0, dead_end.frame.y - 11.5];
    assert!(off[0].hypot(off[1]) < 0.3, "{:?}", dead_end.frame);
}

/// The ACES building: all fifteen visits, every star with the right number of ways out, nothing else.
#[test]
fn the_log_of_the_aces_building_gives_its_visits() {
    let Some(data) = std::env::var_os("HSSH_DATA") else {
        eprintln!("skipped: set HSSH_DATA to the folder with logs/");
        return;
    };
    let file = std::fs::File::open(Path::new(&data).join("logs/aces.log.gz")).unwrap();
    let log = LaserLog::read(file).unwrap();
    let (_, survey) = survey(log, &SurveyOptions::default(), |_, _| ()).unwrap();
    let ways: Vec<usize> = survey.visits.iter().map(|visit| visit.star.gateways().count()).collect();
    // N NE E SE S SW W NW N C S C W C E
    assert_eq!(ways, [3, 2, 3, 2, 3, 2, 3, 2, 3, 4, 3, 4, 3, 4, 3]);
    assert_eq!(survey.exploration().unwrap().travels().len(), 14);
}
