//! `hssh simulate`: a robot drives through a grid map and keeps a laser log.

use std::fmt::Write as _;

use hssh_draw::{GridPicture, TOLD_WAY, TRUE_WAY, draw_grid};
use hssh_local::{OccupancyGrid, PlaceNumber, UnknownSpace, read_map};
use hssh_metrics::Pose;
use hssh_world::robot::{Drive, Ending, Moment, RobotOptions, Stop, Strategy, drive};
use hssh_world::{floor_plan, floors};
use serde::Serialize;

use crate::arguments::SimulateOptions;
use crate::failure::{Failure, Status};
use crate::output::{counted, print, write_file};

/// Metres per cell of the floors that come with the program.
const RESOLUTION: f64 = 0.1;

/// The truth about a drive, as JSON; metres and radians in the frame of the map.
#[derive(Serialize)]
struct Truth {
    ending: String,
    places: Vec<PlaceTruth>,
    connections: Vec<[EndTruth; 2]>,
    stops: Vec<StopTruth>,
}

#[derive(Serialize)]
struct PlaceTruth {
    center: [f64; 2],
    star: String,
}

#[derive(Serialize)]
struct EndTruth {
    place: u32,
    end: String,
}

#[derive(Serialize)]
struct StopTruth {
    /// Seconds since the start.
    time: f64,
    pose: Pose,
    place: Option<u32>,
    meant: Option<u32>,
    off_center: Option<f64>,
    exit: Option<String>,
}

pub(crate) fn run(options: &SimulateOptions) -> Result<Status, Failure> {
    let (name, grid) = map(options)?;
    let robot = robot(options).with_noise(options.noise);
    let strategy = match &options.visit[..] {
        [] if options.wander => Strategy::Wander,
        [] => Strategy::Cover,
        places => Strategy::Visit(places.iter().copied().map(PlaceNumber).collect()),
    };
    let drive = drive(&grid, options.start, strategy, &robot, options.seed)
        .map_err(|error| Failure::Usage(format!("{name}: {error}")))?;
    write_file(&options.output, &drive.to_carmen())?;
    if let Some(file) = &options.truth {
        let text = serde_json::to_string_pretty(&Truth::of(&drive)).map_err(std::io::Error::from)?;
        write_file(file, &(text + "\n"))?;
    }
    if let Some(file) = &options.svg {
        write_file(file, &picture(&grid, &drive))?;
    }
    print(&account(&name, &drive))?;
    Ok(if drive.ending == Ending::Done { Status::Found } else { Status::Stopped })
}

/// The robot, which takes the same for a place as the one who tells it where to go.
fn robot(options: &SimulateOptions) -> RobotOptions {
    let usual = RobotOptions::default();
    let mut outlook = options.places.along_logs();
    outlook.place.arrival = usual.outlook.place.arrival;
    // Noise makes passages look narrower; the robot goes where it fits.
    outlook.place.skeleton.narrowest_passage = usual.outlook.place.skeleton.narrowest_passage;
    RobotOptions {
        travels: options.travels,
        places: options.places.in_grids(UnknownSpace::Wall),
        outlook,
        ..usual
    }
}

/// The map to drive through, and what to call it.
fn map(options: &SimulateOptions) -> Result<(String, OccupancyGrid), Failure> {
    match (&options.map, &options.floor) {
        (Some(file), _) => Ok((file.display().to_string(), read_map(file)?)),
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

impl Truth {
    fn of(drive: &Drive) -> Self {
        let graph = &drive.graph;
        let end_name = |place: PlaceNumber, olp| graph.place(place).star.star.name(olp).to_string();
        let places = graph.places.iter();
        let ends = |(place, olp): (PlaceNumber, _)| EndTruth { place: place.0, end: end_name(place, olp) };
        let stop = |stop: &Stop| StopTruth {
            time: drive.moments.get(stop.moment).or(drive.moments.last()).map_or(0.0, |moment| moment.time),
            pose: stop.pose,
            place: stop.place.map(|place| place.0),
            meant: stop.meant.map(|place| place.0),
            off_center: stop.off_center,
            exit: stop.place.zip(stop.exit).map(|(place, exit)| end_name(place, exit)),
        };
        Truth {
            ending: drive.ending.to_string(),
            places: places
                .map(|place| PlaceTruth { center: place.center, star: place.star.star.to_string() })
                .collect(),
            connections: graph.connections.iter().map(|found| found.ends.map(ends)).collect(),
            stops: drive.stops.iter().map(stop).collect(),
        }
    }
}

/// What the robot did, in words.
fn account(name: &str, drive: &Drive) -> String {
    let way: f64 =
        drive.moments.windows(2).map(|pair| pair[0].pose.between(pair[1].pose).translation().norm()).sum();
    let scans = drive.moments.iter().filter(|moment| moment.scan.is_some()).count();
    let mut text = format!(
        "{name}: {}, {}, {way:.0} m, {}; {}\nplaces:",
        counted(drive.graph.places.len(), "place"),
        counted(drive.stops.len().saturating_sub(1), "travel"),
        counted(scans, "scan"),
        drive.ending
    );
    for stop in &drive.stops {
        let place = stop.place.map_or_else(|| "?".to_owned(), |place| place.0.to_string());
        let _ = write!(text, " {place}");
    }
    text + "\n"
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
