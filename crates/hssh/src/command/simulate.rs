//! `hssh simulate`: a robot drives through a grid map and keeps a laser log.

use std::path::{Path, PathBuf};

use hssh::account::DriveAccount;
use hssh_draw::{GridPicture, TOLD_WAY, TRUE_WAY, draw_grid};
use hssh_local::{OccupancyGrid, PlaceNumber, UnknownSpace};
use hssh_metrics::Pose;
use hssh_world::robot::{Drive, Ending, Moment, RobotOptions, Strategy, drive_until};
use hssh_world::{floor_plan, floors};

use crate::arguments::SimulateArguments;
use crate::failure::{Failure, Status};
use crate::input::read_grid;
use crate::output::{Written, check_outputs, print, to_json, write_file};
use crate::progress::{is_interrupted, keep_on_signals};

/// Metres per cell of the floors that come with the program.
const RESOLUTION: f64 = 0.1;

pub(crate) fn run(arguments: &SimulateArguments) -> Result<Status, Failure> {
    let SimulateArguments { output, truth, svg, .. } = arguments;
    let inputs: Vec<&Path> = arguments.map.iter().map(PathBuf::as_path).collect();
    check_outputs(&inputs, [Some(output), truth.as_ref(), svg.as_ref()])?;
    let (name, grid) = map(arguments)?;
    let robot = robot(arguments).with_noise(arguments.noise);
    let strategy = match &arguments.visit[..] {
        [] if arguments.wander => Strategy::Wander,
        [] => Strategy::Cover,
        places => Strategy::Visit(places.iter().copied().map(PlaceNumber).collect()),
    };
    keep_on_signals();
    let drive = drive_until(&grid, arguments.start, strategy, &robot, arguments.seed, &is_interrupted)
        .map_err(|error| Failure::Usage(format!("{name}: {error}")))?;
    let account = DriveAccount::new(&name, &drive);
    print(&if arguments.json { to_json(&account)? } else { account.to_string() })?;
    let mut written = Written::default();
    let log = write_file(output, &drive.to_carmen());
    if log.is_err() {
        print(&drive.to_carmen())?;
    }
    written.note(log);
    if let Some(file) = truth {
        written.note(to_json(&account).and_then(|text| write_file(file, &text)));
    }
    if let Some(file) = svg {
        written.note(write_file(file, &picture(&grid, &drive)));
    }
    written.done()?;
    Ok(if drive.ending == Ending::Done { Status::Found } else { Status::Stopped })
}

/// The robot, which takes the same for a place as the one who tells it where to go.
fn robot(arguments: &SimulateArguments) -> RobotOptions {
    let usual = RobotOptions::default();
    let mut outlook = arguments.places.choice().along_logs();
    outlook.place.arrival = usual.outlook.place.arrival;
    // Noise makes passages look narrower; the robot goes where it fits.
    outlook.place.skeleton.narrowest_passage = usual.outlook.place.skeleton.narrowest_passage;
    RobotOptions {
        travels: arguments.travels,
        places: arguments.places.choice().in_grids(UnknownSpace::Wall),
        outlook,
        ..usual
    }
}

/// The map to drive through, and what to call it.
fn map(arguments: &SimulateArguments) -> Result<(String, OccupancyGrid), Failure> {
    match (&arguments.map, &arguments.floor) {
        (Some(file), _) => Ok((file.display().to_string(), read_grid(file)?)),
        (None, Some(name)) => Ok((name.clone(), floor(name)?)),
        (None, None) => Err(Failure::Usage(format!(
            "there is nowhere to drive: give the YAML file of a map, or --floor with one of {}",
            floor_names()
        ))),
    }
}

/// One of the floors that come with the program.
fn floor(name: &str) -> Result<OccupancyGrid, Failure> {
    let found = floors().into_iter().find(|floor| floor.name == name);
    let unknown = || Failure::Usage(format!("there is no floor `{name}`: there are {}", floor_names()));
    let floor = found.ok_or_else(unknown)?;
    floor_plan(&floor.world, floor.width, RESOLUTION).map_err(|error| Failure::Usage(error.to_string()))
}

fn floor_names() -> String {
    let names: Vec<&str> = floors().iter().map(|floor| floor.name).collect();
    names.join(", ")
}

/// The map with its places; over it the true way in blue and the way that odometry tells in orange.
fn picture(grid: &OccupancyGrid, drive: &Drive) -> String {
    let places = drive.graph.places.iter().map(|place| (place.center, &place.star)).collect();
    let robot = drive.moments.last().map(|moment| [moment.pose.x, moment.pose.y]);
    let start = drive.moments.first().map(|moment| moment.pose).unwrap_or_default();
    let way = |pose: &dyn Fn(&Moment) -> Pose| {
        let poses = drive.moments.iter().step_by(3).map(pose);
        poses.map(|pose| [pose.x, pose.y]).collect()
    };
    let told = way(&|moment| start.compose(moment.odometry));
    let ways = vec![(told, TOLD_WAY), (way(&|moment| moment.pose), TRUE_WAY)];
    draw_grid(grid, &GridPicture { places, ways, robot, ..GridPicture::default() })
}
