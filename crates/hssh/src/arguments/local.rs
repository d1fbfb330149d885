//! The command line of what works on grid maps, floor plans and laser logs.

use std::path::PathBuf;

use clap::Args;
use hssh::file::TopicChoice;
use hssh::pipeline::{LaserChoice, PlaceChoice};
use hssh_local::{PlaceOptions, RegionOptions, RoadmapOptions, UnknownSpace};

use super::export::FilesArguments;
use super::page::PageArguments;

#[derive(Debug, Args)]
pub(crate) struct ExploreArguments {
    /// The log: CARMEN text with FLASER messages, a ROS bag (.bag, .mcap, .db3, folder) or a table of scans; `-` reads standard
    /// input.
    pub(crate) log: PathBuf,
    /// Where to write the exploration; without it, it is printed.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Refuse a log of which scans cannot be used or that breaks off, instead of warning.
    #[arg(long)]
    pub(crate) strict: bool,
    /// Print what was found as JSON: visits with their scans and stars, and travels with odometry.
    #[arg(long)]
    pub(crate) json: bool,
    /// Write pictures of every stage into this folder: the track, and the local map and the star of each visit.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) debug_dir: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) places: PlaceArguments,
    #[command(flatten)]
    pub(crate) laser: LaserArguments,
}

#[derive(Debug, Args)]
pub(crate) struct TrackArguments {
    /// The log: CARMEN text, plain or gzip, a ROS bag, or a table of scans; `-` reads standard input.
    pub(crate) log: PathBuf,
    /// Write where every scan was taken, in TUM form: time x y z qx qy qz qw, a line for each scan in the order of the
    /// log, in metres in the frame of the first.
    #[arg(long, value_name = "FILE")]
    pub(crate) trajectory: Option<PathBuf>,
    /// Write the grid map that the scans draw, as PNG, or, if the file ends in .yaml, for ROS map_server.
    #[arg(long, value_name = "FILE")]
    pub(crate) grid: Option<PathBuf>,
    /// Write a pose for each scan and an edge for each step with its information, as g2o.
    #[arg(long, value_name = "FILE")]
    pub(crate) g2o: Option<PathBuf>,
    /// Refuse a log of which scans cannot be used or that breaks off, instead of warning.
    #[arg(long)]
    pub(crate) strict: bool,
    /// Print one JSON object: the pose of every scan, and what the track is worth.
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) laser: LaserArguments,
}

#[derive(Debug, Args)]
pub(crate) struct SimulateArguments {
    /// The map: the YAML file of ROS `map_server`.
    pub(crate) map: Option<PathBuf>,
    /// Instead of a map, one of the floors that come with the program, such as `figure-eight`.
    #[arg(long, value_name = "NAME", conflicts_with = "map")]
    pub(crate) floor: Option<String>,
    /// Where to write the log, as CARMEN text; `hssh explore` reads it.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// Another seed is another drive.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,
    /// How many travels from place to place to make at most.
    #[arg(long, value_name = "N", default_value_t = 40)]
    pub(crate) travels: usize,
    /// All errors of laser and wheels, in parts of their usual size.
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = length)]
    pub(crate) noise: f64,
    /// Where to start, in metres in the frame of the map, such as `--start=-1.5,20`; in a place if not given.
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    pub(crate) start: Option<[f64; 2]>,
    /// Visit these places in turn, by the numbers that `hssh stars --detail` gives them, such as `--visit 0,4,1`; if not
    /// given, every corridor is travelled once.
    #[arg(long, value_name = "PLACES", value_delimiter = ',')]
    pub(crate) visit: Vec<u32>,
    /// Take any way at every place.
    #[arg(long, conflicts_with = "visit")]
    pub(crate) wander: bool,
    /// Write the truth as JSON: the map's places, and where the robot centered itself.
    #[arg(long, value_name = "FILE")]
    pub(crate) truth: Option<PathBuf>,
    /// Print one JSON object: the truth, and what the drive took.
    #[arg(long)]
    pub(crate) json: bool,
    /// Draw the map with the true way and the way that odometry tells.
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) places: PlaceArguments,
}

#[derive(Debug, Args)]
pub(crate) struct StarsArguments {
    /// The map: the YAML file of ROS `map_server`, or a floor plan as a PGM or PNG image; or a laser log in CARMEN
    /// form, of which the places visited are shown.
    pub(crate) map: PathBuf,
    /// Metres per pixel of a floor plan without a YAML file.
    #[arg(long, value_name = "METRES")]
    pub(crate) resolution: Option<f64>,
    /// Only the place around a point, in metres in the frame of the map, such as `--at=-1.5,20`.
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    pub(crate) at: Option<[f64; 2]>,
    #[command(flatten)]
    pub(crate) places: PlaceArguments,
    #[command(flatten)]
    pub(crate) laser: LaserArguments,
    /// Unknown cells are free, as in floor plans that only have walls.
    #[arg(long)]
    pub(crate) unknown_is_free: bool,
    /// All places of the medial axis instead of one for each region and each junction of a corridor.
    #[arg(long)]
    pub(crate) detail: bool,
    /// The radius of the robot that drives by the map, in metres.
    #[arg(long, value_name = "METRES", default_value_t = 0.25, value_parser = length)]
    pub(crate) radius: f64,
    /// Names of regions: a text file with a line `x,y,name` for a point in each, in metres.
    #[arg(long, value_name = "FILE")]
    pub(crate) names: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) files: FilesArguments,
    /// Print one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
    /// Draw the map with its medial axis, gateways and stars as SVG.
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) page: PageArguments,
}

impl StarsArguments {
    pub(crate) fn parameters(&self) -> PlaceOptions {
        self.places.choice().in_grids(self.unknown())
    }

    /// What parts the map into regions.
    pub(crate) fn region_options(&self) -> RegionOptions {
        let usual = RegionOptions::default();
        let narrowest = self.places.narrowest.unwrap_or(usual.narrowest);
        let furniture = self.places.clutter.unwrap_or(usual.furniture);
        RegionOptions { unknown: self.unknown(), narrowest, furniture, ..usual }
    }

    /// What the ways through the map are for.
    pub(crate) fn roadmap_options(&self) -> RoadmapOptions {
        RoadmapOptions { unknown: self.unknown(), radius: self.radius, ..RoadmapOptions::default() }
    }

    fn unknown(&self) -> UnknownSpace {
        if self.unknown_is_free { UnknownSpace::Free } else { UnknownSpace::Wall }
    }
}

/// What of a recording is used.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Bags")]
pub(crate) struct TopicArguments {
    /// The topic with the scans of a bag [default: of the laser that looks widest]; several with commas between them, such as
    /// `/front,/rear`, are merged to what one laser would see all around; of a CARMEN log the names of messages, such as `FLASER,RLASER`.
    #[arg(long, value_name = "TOPIC")]
    pub(crate) scan: Option<String>,
    /// The topic with the odometry of a bag, or the frame of /tf in which the robot moves; `none` for scan matching alone
    /// [default: what moves the laser].
    #[arg(long, value_name = "TOPIC")]
    pub(crate) odom: Option<String>,
    /// The frame of the robot that odometry moves [default: as the odometry says].
    #[arg(long, value_name = "FRAME")]
    pub(crate) base_frame: Option<String>,
}

impl TopicArguments {
    /// The choice that they make.
    pub(crate) fn choice(&self) -> TopicChoice {
        let TopicArguments { scan, odom, base_frame } = self.clone();
        TopicChoice { scan, odometry: odom, base_frame }
    }
}

/// How a log's laser looks and sits.
#[derive(Debug, Args)]
#[command(next_help_heading = "Laser")]
pub(crate) struct LaserArguments {
    /// How wide the laser of a log looks [default: as the log says, else 180].
    #[arg(long, value_name = "DEGREES", value_parser = view)]
    pub(crate) fov: Option<f64>,
    /// Where the laser sits: metres ahead of the robot's axis, metres to its left, degrees turned to the left
    /// [default: as the log says, else 0,0,0].
    #[arg(long, value_name = "X,Y,DEGREES", value_parser = mount, allow_hyphen_values = true)]
    pub(crate) laser_pose: Option<(f64, f64, f64)>,
    #[command(flatten)]
    pub(crate) topics: TopicArguments,
}

impl LaserArguments {
    /// The choice that they make.
    pub(crate) fn choice(&self) -> LaserChoice {
        LaserChoice { view: self.fov, pose: self.laser_pose }
    }

    /// What options become by them.
    pub(crate) fn apply(&self, laser: &mut LaserChoice) {
        laser.view = self.fov.or(laser.view);
        laser.pose = self.laser_pose.or(laser.pose);
    }
}

/// What counts as a place.
#[derive(Debug, Args)]
#[command(next_help_heading = "Places")]
pub(crate) struct PlaceArguments {
    /// Passages narrower than this many metres are closed [default: 0.6].
    #[arg(long, value_name = "METRES", value_parser = length)]
    pub(crate) narrowest: Option<f64>,
    /// Ways that lead on for less than this many metres are no ways out [default: 1 in grid maps, 8 along logs].
    #[arg(long, value_name = "METRES", value_parser = length)]
    pub(crate) shallowest: Option<f64>,
    /// Obstacles no larger than this many metres are clutter [default: 0.3; for regions, which furniture does not part, 0.9].
    #[arg(long, value_name = "METRES", value_parser = length)]
    pub(crate) clutter: Option<f64>,
}

impl PlaceArguments {
    /// The choice that they make.
    pub(crate) fn choice(&self) -> PlaceChoice {
        let PlaceArguments { narrowest, shallowest, clutter } = *self;
        PlaceChoice { narrowest, shallowest, clutter }
    }

    /// What options become by them.
    pub(crate) fn apply(&self, places: &mut PlaceChoice) {
        places.narrowest = self.narrowest.or(places.narrowest);
        places.shallowest = self.shallowest.or(places.shallowest);
        places.clutter = self.clutter.or(places.clutter);
    }
}

fn point(text: &str) -> Result<[f64; 2], String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    let coordinates = text.split_once(',').and_then(|(x, y)| number(x).zip(number(y)));
    coordinates.map(|(x, y)| [x, y]).ok_or_else(|| "write two numbers of metres, like 2.5,-1".to_owned())
}

fn view(text: &str) -> Result<f64, String> {
    let degrees = text.parse().ok().filter(|degrees| (1.0..=360.0).contains(degrees));
    degrees.ok_or_else(|| "write an angle between 1 and 360 degrees, like 240".to_owned())
}

fn mount(text: &str) -> Result<(f64, f64, f64), String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, turn]) if x.abs() <= 10.0 && y.abs() <= 10.0 && turn.abs() <= 360.0 => Ok((x, y, turn)),
        _ => {
            Err("write two numbers of metres, no more than 10, and one of degrees, like 0.35,0,0".to_owned())
        }
    }
}

fn length(text: &str) -> Result<f64, String> {
    let metres = text.parse().ok().filter(|metres: &f64| metres.is_finite() && *metres >= 0.0);
    metres.ok_or_else(|| "write a number of metres, like 0.8".to_owned())
}
