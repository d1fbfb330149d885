//! `hssh stars`: the regions and places of a grid map with their gateways and stars, and what connects them.

use std::path::{Path, PathBuf};

use hssh::account::{PlaceAccount, PlacesAccount};
use hssh::kind::FileKind;
use hssh::pipeline::{MappingOptions, SurveyedLog};
use hssh_draw::{GridPicture, draw_grid};
use hssh_local::{
    DistanceField, LocalMapOptions, Neighborhood, Occupancy, OccupancyGrid, PlaceOptions, Visit, global_map,
    neighborhood, read_floor_plan, without_rims,
};
use hssh_metrics::Pose;

use super::export::refuse_unfit;
use super::floor;
use crate::arguments::StarsArguments;
use crate::failure::{Failure, Status};
use crate::input::{Source, read_grid, surveyed};
use crate::output::{check_outputs, print, print_json, write_file};
use crate::progress::is_interrupted;

/// How far the part of the map that is looked at around one point reaches, in metres, beyond the shallowest way out.
const MARGIN: f64 = 6.5;

pub(crate) fn run(options: &StarsArguments) -> Result<Status, Failure> {
    let inputs: Vec<&Path> =
        std::iter::once(&options.map).chain(&options.names).map(PathBuf::as_path).collect();
    refuse_unfit(&options.files, false)?;
    let exported = options.files.export.iter().map(|(_, file)| Some(file));
    check_outputs(&inputs, [options.svg.as_ref(), options.page.html.as_ref()].into_iter().chain(exported))?;
    let source = Source::open(&options.map)?;
    let is_yaml = options.map.extension().is_some_and(|ending| ending == "yaml" || ending == "yml");
    let grid = match source.kind() {
        FileKind::LaserLog(_) | FileKind::Recording(_) | FileKind::Table | FileKind::JsonLines => {
            refuse_region_options(options, "a laser log")?;
            return along(options, source);
        }
        FileKind::MapDescription => read(&options.map, true, options.resolution)?,
        FileKind::Text | FileKind::Empty if is_yaml => read(&options.map, true, options.resolution)?,
        FileKind::Image(_) => read(&options.map, false, options.resolution)?,
        _ => return Err(source.unfit("a grid map (YAML or image) or a laser log").into()),
    };
    let parameters = options.parameters();
    match options.at {
        Some(point) => {
            refuse_region_options(options, "--at, which looks around one point")?;
            around(&grid, point, &parameters, options)
        }
        None => floor::run(&grid, &parameters, options),
    }
}

fn read(file: &Path, is_yaml: bool, resolution: Option<f64>) -> Result<OccupancyGrid, Failure> {
    match resolution {
        None if !is_yaml => Err(Failure::Usage(format!(
            "{} has no YAML file to say how large its pixels are: add --resolution with the metres per pixel, such as 0.05",
            file.display()
        ))),
        Some(_) if is_yaml => Err(Failure::Usage(format!(
            "{} says itself how large its pixels are: leave out --resolution, or give the image instead",
            file.display()
        ))),
        Some(resolution) => Ok(read_floor_plan(file, resolution)?),
        None => read_grid(file),
    }
}

/// Refuses what only the regions of a whole map have.
fn refuse_region_options(options: &StarsArguments, given: &str) -> Result<(), Failure> {
    let useless = [
        (options.detail, "--detail"),
        (options.names.is_some(), "--names"),
        (!options.files.export.is_empty(), "--export"),
        (options.page.html.is_some(), "--html"),
    ];
    match useless.iter().find(|(is_given, _)| *is_given) {
        Some((_, option)) => Err(Failure::Usage(format!(
            "{option} is for the regions of a whole map and does not go with {given}"
        ))),
        None => Ok(()),
    }
}

/// The places that a robot visited, in the frame of its track.
fn along(options: &StarsArguments, source: Source) -> Result<Status, Failure> {
    let usual = MappingOptions::default();
    let SurveyedLog { log, survey } = surveyed(
        &options.map,
        source,
        &MappingOptions { laser: options.laser.choice(), places: options.places.choice(), ..usual },
        &options.laser.topics,
    )?;
    let clearance = |visit: &Visit| {
        let lattice = *visit.grid.lattice();
        let field = DistanceField::new(lattice, |index| visit.grid.cells()[index] == Occupancy::Occupied);
        let cell = lattice.cell_at([visit.frame.x, visit.frame.y]);
        cell.map_or(0.0, |cell| field.clearance(cell))
    };
    let place = |visit: &Visit| {
        PlaceAccount::new(visit.star.kind(), [visit.frame.x, visit.frame.y], clearance(visit), &visit.star)
    };
    let places: Vec<PlaceAccount> = survey.visits.iter().map(place).collect();
    tell(&PlacesAccount::along_log(&options.map.display().to_string(), places), options)?;
    if let Some(file) = &options.svg {
        let track: Vec<Pose> = survey.track.scans.iter().map(|scan| scan.pose).collect();
        let grid = global_map(&log, &track, &LocalMapOptions::default())
            .map_err(|error| failure(&options.map, error))?;
        let place = |visit: &Visit| [visit.frame.x, visit.frame.y];
        let places = survey.visits.iter().map(|visit| (place(visit), &visit.star)).collect();
        write_file(file, &draw_grid(&grid, &GridPicture { places, ..GridPicture::default() }))?;
    }
    Ok(if is_interrupted() { Status::Stopped } else { Status::Found })
}

/// The place around one point.
fn around(
    grid: &OccupancyGrid,
    point: [f64; 2],
    parameters: &PlaceOptions,
    options: &StarsArguments,
) -> Result<Status, Failure> {
    let outside = || Failure::Usage(format!("the point ({}, {}) is not on the map", point[0], point[1]));
    let side = 2.0 * (parameters.skeleton.shallowest_branch + MARGIN);
    let window = grid.window(point, side).ok_or_else(outside)?;
    let window = without_rims(&window, options.region_options().rim);
    let found = neighborhood(&window, point, parameters).map_err(|error| failure(&options.map, error))?;
    let Neighborhood { kind, center, clearance, star, .. } = &found;
    let place = PlaceAccount::new(*kind, *center, *clearance, star);
    if options.json {
        print_json(&place)?;
    } else {
        print(&place.to_text(0))?;
    }
    if let Some(file) = &options.svg {
        let picture = GridPicture {
            skeleton: Some(&found.graph.skeleton),
            places: vec![(found.center, &found.star)],
            robot: Some(point),
            ..GridPicture::default()
        };
        write_file(file, &draw_grid(&window, &picture))?;
    }
    Ok(Status::Found)
}

pub(super) fn failure(map: &Path, error: impl std::fmt::Display) -> Failure {
    Failure::Usage(format!("{}: {error}", map.display()))
}

pub(super) fn tell(account: &PlacesAccount, options: &StarsArguments) -> Result<(), Failure> {
    if options.json { print_json(account) } else { print(&account.to_string()) }
}
