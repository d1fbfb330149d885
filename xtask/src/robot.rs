//! Drives a simulated robot through six floors: its control level against the truth, and the maps that come of its logs.

use std::error::Error;
use std::time::{Duration, Instant};

use hssh_local::{LaserLog, OccupancyGrid, Survey, SurveyOptions, survey};
use hssh_search::{Limits, PosteriorModel, PosteriorSearch};
use hssh_topology::Axioms;
use hssh_world::robot::{Drive, Ending, RobotOptions, Strategy, drive, touches};
use hssh_world::{Floor, Point, floor_plan, floors};

use crate::flags;
use crate::noisy::on_threads;
use crate::table::aligned;

/// Metres per cell of the floor plans.
const RESOLUTION: f64 = 0.1;
/// How large the robot's errors are, in parts of their usual size.
const NOISE: [f64; 3] = [0.0, 1.0, 2.0];
/// Seeds of each row if none are asked for.
const SEEDS: usize = 3;
/// Seconds that a search may take.
const SECONDS: u64 = 60;
/// Farther than this from a place's center, in metres, the robot is not centered.
const CENTERED: f64 = 0.3;

/// What one drive came to.
struct Outcome {
    travels: usize,
    /// Travels that ended where they were meant to.
    reached: usize,
    /// From the centers of places, at all stops: mean and greatest distance in metres.
    off_center: (f64, f64),
    collisions: usize,
    is_done: bool,
    /// Visits that the survey found, of how many stops; whether they are the same places in the same order.
    visits: (usize, usize),
    is_surveyed: bool,
    /// Whether the most probable map takes two visits for one place if and only if they were.
    is_right: bool,
    seconds: f64,
}

pub(crate) fn run(flags: &flags::Robot) -> Result<(), Box<dyn Error>> {
    let seeds = if flags.check { 1 } else { flags.seeds.unwrap_or(SEEDS) };
    let noises = if flags.check { &NOISE[1..2] } else { &NOISE[..] };
    let kept = |floor: &Floor| !flags.check || floor.world.places().len() <= 9;
    let floors: Vec<Floor> = floors().into_iter().filter(kept).collect();
    let rows: Vec<(&Floor, f64)> =
        floors.iter().flat_map(|floor| noises.iter().map(move |&noise| (floor, noise))).collect();
    let outcomes = on_threads(flags.threads.unwrap_or(1), rows.len() * seeds, |task| {
        let (floor, noise) = rows[task / seeds];
        outcome(floor, noise, (task % seeds) as u64)
    })?;
    println!("{}", table(&rows, &outcomes, seeds));
    let failed = outcomes.iter().filter(|outcome| !outcome.is_as_expected()).count();
    if flags.check && failed > 0 {
        return Err(format!("{failed} of {} drives went wrong", outcomes.len()).into());
    }
    Ok(())
}

impl Outcome {
    /// The control level does what it should, and of a right survey comes the right map. How often the survey
    /// is right is for the table to say.
    fn is_as_expected(&self) -> bool {
        let is_driven = self.is_done && self.reached == self.travels && self.collisions == 0;
        is_driven && self.off_center.1 < CENTERED && (self.is_right || !self.is_surveyed)
    }
}

/// Drives along every corridor, surveys the log and looks for the most probable map.
fn outcome(floor: &Floor, noise: f64, seed: u64) -> Result<Outcome, Box<dyn Error>> {
    let started = Instant::now();
    let grid = floor_plan(&floor.world, floor.width, RESOLUTION)?;
    let options = RobotOptions { travels: 60, ..RobotOptions::default() }.with_noise(noise);
    let found = drive(&grid, None, Strategy::Cover, &options, seed)?;
    let log = LaserLog::read(found.to_carmen().as_bytes())?;
    let truth: Vec<Option<usize>> =
        found.stops.iter().map(|stop| place_at(floor, stop.pose.x, stop.pose.y)).collect();
    let surveyed = survey(&log, &SurveyOptions::default(), |_, _| ()).ok();
    let visits = surveyed.as_ref().map_or_else(Vec::new, |surveyed| visited(floor, &log, surveyed));
    let is_surveyed = visits == truth;
    let is_right = is_surveyed && surveyed.is_some_and(|surveyed| is_mapped(&surveyed, &truth));
    let meant = found.stops.iter().filter(|stop| stop.meant.is_some());
    let off: Vec<f64> = found.stops.iter().filter_map(|stop| stop.off_center).collect();
    Ok(Outcome {
        travels: meant.clone().count(),
        reached: meant.filter(|stop| stop.meant == stop.place).count(),
        off_center: (
            off.iter().sum::<f64>() / off.len().max(1) as f64,
            off.iter().copied().fold(0.0, f64::max),
        ),
        collisions: collisions(&grid, &found, options.handling.radius),
        is_done: found.ending == Ending::Done,
        visits: (visits.len(), truth.len()),
        is_surveyed,
        is_right,
        seconds: started.elapsed().as_secs_f64(),
    })
}

/// Moments at which the robot touched something, and the end if it would have run into something.
fn collisions(grid: &OccupancyGrid, found: &Drive, radius: f64) -> usize {
    let touching =
        found.moments.iter().filter(|moment| touches(grid, [moment.pose.x, moment.pose.y], radius));
    touching.count() + usize::from(found.ending == Ending::Collision)
}

/// The place of the world around a point: that within twice the width of a corridor.
fn place_at(floor: &Floor, x: f64, y: f64) -> Option<usize> {
    let here = Point::new(x, y);
    floor.world.places().iter().position(|place| place.position.distance_to(here) < 2.0 * floor.width)
}

/// The places of the visits that a survey found, by the true pose of the scan taken nearest to their centers.
fn visited(floor: &Floor, log: &LaserLog, survey: &Survey) -> Vec<Option<usize>> {
    let poses = survey.visits.iter().map(|visit| log.scans[visit.reference].corrected);
    poses.map(|pose| place_at(floor, pose.x, pose.y)).collect()
}

/// Whether the most probable map takes two visits for one place if and only if they were.
fn is_mapped(survey: &Survey, truth: &[Option<usize>]) -> bool {
    let Ok(exploration) = survey.exploration() else { return false };
    let Some(model) = PosteriorModel::evidence(&exploration) else { return false };
    let search = PosteriorSearch {
        axioms: Axioms { max_genus: Some(0), ..Axioms::default() },
        limits: Limits { time: Some(Duration::from_secs(SECONDS)), ..Limits::default() },
        ..PosteriorSearch::new(model)
    };
    let Ok(posterior) = search.explain(&exploration) else { return false };
    let Some(best) = posterior.maps().first() else { return false };
    let visits = posterior.visits(best.node);
    let is_same = |a: usize, b: usize| (visits[a].place == visits[b].place) == (truth[a] == truth[b]);
    (0..truth.len()).all(|a| (0..a).all(|b| is_same(a, b)))
}

fn table(rows: &[(&Floor, f64)], outcomes: &[Outcome], seeds: usize) -> String {
    let header = [
        "floor",
        "noise",
        "done",
        "reached",
        "off center, m",
        "worst",
        "collisions",
        "visits found",
        "survey right",
        "map right",
        "s",
    ];
    let mut lines = vec![header.map(str::to_owned).to_vec()];
    for ((floor, noise), outcomes) in rows.iter().zip(outcomes.chunks(seeds)) {
        let sum = |number: fn(&Outcome) -> usize| outcomes.iter().map(number).sum::<usize>();
        let count =
            |is: fn(&Outcome) -> bool| format!("{}/{seeds}", outcomes.iter().filter(|one| is(one)).count());
        let mean = |number: fn(&Outcome) -> f64| outcomes.iter().map(number).sum::<f64>() / seeds as f64;
        lines.push(vec![
            floor.name.to_owned(),
            format!("{noise:.0}"),
            count(|one| one.is_done),
            format!("{}/{}", sum(|one| one.reached), sum(|one| one.travels)),
            format!("{:.2}", mean(|one| one.off_center.0)),
            format!("{:.2}", outcomes.iter().map(|one| one.off_center.1).fold(0.0, f64::max)),
            sum(|one| one.collisions).to_string(),
            format!("{}/{}", sum(|one| one.visits.0), sum(|one| one.visits.1)),
            count(|one| one.is_surveyed),
            count(|one| one.is_right),
            format!("{:.1}", mean(|one| one.seconds)),
        ]);
    }
    format!("every corridor travelled once or more; drives of each row: {seeds}\n{}", aligned(&lines))
}
