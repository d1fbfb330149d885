//! What became of a drive: at the control level, in the survey of its log, and in the map.

use std::error::Error;
use std::time::{Duration, Instant};

use hssh_local::{LaserLog, Survey, SurveyOptions, building_map, survey};
use hssh_metrics::Pose;
use hssh_search::{Limits, Mapper, Order, PosteriorModel};
use hssh_topology::Axioms;
use hssh_world::robot::{Drive, Ending, RobotOptions, Strategy, drive, touches};

use super::course::Course;
use crate::score::{Revisits, Walls, best_fit};

/// Seconds that a search may take.
const SECONDS: u64 = 60;
/// Farther than this from a place's center, in metres, the robot is not centered.
const CENTERED: f64 = 0.5;

/// What one drive came to.
pub(super) struct Outcome {
    pub(super) travels: usize,
    /// Travels that ended where they were meant to.
    pub(super) reached: usize,
    /// From the centers of places, at all stops: mean and greatest distance in metres.
    pub(super) off_center: (f64, f64),
    pub(super) collisions: usize,
    pub(super) is_done: bool,
    /// Visits that the survey found, of how many stops; whether they are the same places in the same order.
    pub(super) visits: (usize, usize),
    pub(super) is_surveyed: bool,
    /// Whether the most probable map takes two visits for one place if and only if they were.
    pub(super) is_right: bool,
    /// Mean error of the relative poses of scans that are back, metres and radians.
    pub(super) back: Option<[f64; 2]>,
    /// The walls of the building's grid against the plan.
    pub(super) walls: Option<Walls>,
    pub(super) seconds: f64,
}

impl Outcome {
    /// Drives along every corridor, surveys the log and looks for the most probable map.
    pub(super) fn of(course: &Course, noise: f64, seed: u64) -> Result<Self, Box<dyn Error>> {
        let started = Instant::now();
        let options = RobotOptions { travels: 60, ..course.robot }.with_noise(noise);
        let found = drive(&course.grid, course.start, Strategy::Cover, &options, seed)?;
        let log = LaserLog::read(found.to_carmen().as_bytes())?;
        let mut truth: Vec<Option<usize>> =
            found.stops.iter().map(|stop| course.place_at(stop.pose.x, stop.pose.y)).collect();
        truth.dedup(); // a robot that came straight back to a place never left it for the map
        let surveyed =
            survey(log.clone(), &SurveyOptions::default(), |_, _| ()).ok().map(|(_, survey)| survey);
        let poses: Vec<Pose> =
            surveyed.iter().flat_map(|found| &found.track.scans).map(|scan| scan.pose).collect();
        let true_poses: Vec<Pose> = log.scans.iter().map(|scan| scan.corrected).collect();
        let visits = surveyed.as_ref().map_or_else(Vec::new, |surveyed| visited(course, &log, surveyed));
        let is_surveyed = visits == truth;
        let is_right = is_surveyed && surveyed.is_some_and(|surveyed| is_mapped(&surveyed, &truth));
        let meant = found.stops.iter().filter(|stop| stop.meant.is_some());
        let off: Vec<f64> = found
            .stops
            .iter()
            .filter_map(|stop| course.nearest(stop.pose.x, stop.pose.y).map(|(_, off)| off))
            .collect();
        Ok(Outcome {
            travels: meant.clone().count(),
            reached: meant.filter(|stop| stop.meant == stop.place).count(),
            off_center: (
                off.iter().sum::<f64>() / off.len().max(1) as f64,
                off.iter().copied().fold(0.0, f64::max),
            ),
            collisions: collisions(&found, course.robot.handling.radius),
            is_done: found.ending == Ending::Done,
            visits: (visits.len(), truth.len()),
            is_surveyed,
            is_right,
            back: if poses.len() == true_poses.len() {
                Revisits::new(&true_poses).close_error(&poses)
            } else {
                None
            },
            walls: building_map(&log, &poses)
                .ok()
                .and_then(|grid| Walls::of(&grid, &found.grid, best_fit(&poses, &true_poses))),
            seconds: started.elapsed().as_secs_f64(),
        })
    }

    /// Whether everything went as it should: the drive, the survey and the map.
    pub(super) fn is_as_expected(&self) -> bool {
        let is_driven = self.is_done && self.reached == self.travels && self.collisions == 0;
        is_driven && self.off_center.1 < CENTERED && self.is_surveyed && self.is_right
    }
}

/// Moments at which the robot touched something, and the end if it would have run into something.
fn collisions(found: &Drive, radius: f64) -> usize {
    let touching =
        found.moments.iter().filter(|moment| touches(&found.grid, [moment.pose.x, moment.pose.y], radius));
    touching.count() + usize::from(found.ending == Ending::Collision)
}

/// The places of the visits that a survey found, by the true pose of the scan taken nearest to their centers.
fn visited(course: &Course, log: &LaserLog, survey: &Survey) -> Vec<Option<usize>> {
    let poses = survey.visits.iter().map(|visit| log.scans[visit.reference].corrected);
    poses.map(|pose| course.place_at(pose.x, pose.y)).collect()
}

/// Whether the most probable map takes two visits for one place if and only if they were.
fn is_mapped(survey: &Survey, truth: &[Option<usize>]) -> bool {
    let Ok(exploration) = survey.exploration() else { return false };
    let Some(model) = PosteriorModel::evidence(&exploration) else { return false };
    let search = Mapper::builder()
        .posterior(model)
        .order(Order::Cyclic)
        .axioms(Axioms { max_genus: Some(0), ..Axioms::default() })
        .limits(Limits { time: Some(Duration::from_secs(SECONDS)), ..Limits::default() });
    let Ok(mapper) = search.explain(&exploration) else { return false };
    let maps = mapper.maps(1);
    let Some(best) = maps.first() else { return false };
    let visits = mapper.visits(best.node);
    let is_same = |a: usize, b: usize| (visits[a].place == visits[b].place) == (truth[a] == truth[b]);
    (0..truth.len()).all(|a| (0..a).all(|b| is_same(a, b)))
}
