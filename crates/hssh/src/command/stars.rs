//! `hssh stars`: the places of a grid map with their gateways and stars, and what connects them.

use std::path::Path;

use hssh::account::{PlaceAccount, PlacesAccount};
use hssh::pipeline::{MappingOptions, SurveyedLog};
use hssh_draw::{GridPicture, draw_grid};
use hssh_local::{
<<<<<<< HEAD
    DistanceField, DoorParameters, LocalMapOptions, Neighborhood, Occupancy, OccupancyGrid, PlaceGraph,
    PlaceKind, PlaceParameters, Visit, doors, global_map, neighborhood, read_floor_plan, read_map,
=======
    DistanceField, DoorOptions, Gateway, LocalMapOptions, LocalStar, Neighborhood, Occupancy, OccupancyGrid,
    PlaceGraph, PlaceKind, PlaceOptions, Visit, doors, global_map, hidden_area, neighborhood,
    read_floor_plan, read_map,
>>>>>>> local
};
use hssh_metrics::Pose;

use crate::arguments::StarsArguments;
use crate::failure::{Failure, Status};
use crate::input::{holds_log, surveyed};
use crate::output::{print, print_json, write_file};

/// How far the part of the map that is looked at around one point reaches, in metres, beyond the shallowest way out.
const MARGIN: f64 = 6.5;

pub(crate) fn run(options: &StarsArguments) -> Result<Status, Failure> {
    if holds_log(&options.map)? {
        return along(options);
    }
    let parameters = options.parameters();
    let grid = read(&options.map, options.resolution)?;
    match options.at {
        Some(point) => around(&grid, point, &parameters, options),
        None => everywhere(&grid, &parameters, options),
    }
}

fn read(file: &Path, resolution: Option<f64>) -> Result<OccupancyGrid, Failure> {
    let is_yaml = file.extension().is_some_and(|ending| ending == "yaml" || ending == "yml");
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
        None => Ok(read_map(file)?),
    }
}

/// All places of the map.
fn everywhere(
    grid: &OccupancyGrid,
<<<<<<< HEAD
    parameters: &PlaceParameters,
    options: &StarsArguments,
=======
    parameters: &PlaceOptions,
    options: &StarsOptions,
>>>>>>> local
) -> Result<Status, Failure> {
    let graph = PlaceGraph::new(grid, parameters).map_err(|error| failure(&options.map, error))?;
    if let Some(file) = &options.svg {
        let places = graph.places.iter().map(|place| (place.center, &place.star)).collect();
        let doors = doors(grid, &graph.constrictions, &DoorOptions::default());
        let skeleton = Some(&graph.skeleton);
        let picture = GridPicture { skeleton, places, constrictions: &doors, ..GridPicture::default() };
        write_file(file, &draw_grid(grid, &picture))?;
    }
    let report = PlacesAccount::of_map(&options.map.display().to_string(), &graph, grid);
    tell(&report, options)?;
    Ok(if report.places.is_empty() { Status::NothingConsistent } else { Status::Found })
}

/// The places that a robot visited, in the frame of its track.
fn along(options: &StarsArguments) -> Result<Status, Failure> {
    let usual = MappingOptions::default();
    let SurveyedLog { log, survey } =
        surveyed(&options.map, &MappingOptions { places: options.places.choice(), ..usual })?;
    if let Some(file) = &options.svg {
        let track: Vec<Pose> = survey.track.scans.iter().map(|scan| scan.pose).collect();
        let grid = global_map(&log, &track, &LocalMapOptions::default())
            .map_err(|error| failure(&options.map, error))?;
        let place = |visit: &Visit| [visit.frame.x, visit.frame.y];
        let places = survey.visits.iter().map(|visit| (place(visit), &visit.star)).collect();
        write_file(file, &draw_grid(&grid, &GridPicture { places, ..GridPicture::default() }))?;
    }
    let clearance = |visit: &Visit| {
        let lattice = *visit.grid.lattice();
        let field = DistanceField::new(lattice, |index| visit.grid.cells()[index] == Occupancy::Occupied);
        let cell = lattice.cell_at([visit.frame.x, visit.frame.y]);
        cell.map_or(0.0, |cell| field.clearance(cell))
    };
    let place = |visit: &Visit| {
<<<<<<< HEAD
        let kind = match visit.star.gateways().count() {
            1 => PlaceKind::DeadEnd,
            2 => PlaceKind::Corner,
            _ => PlaceKind::Junction,
        };
        PlaceAccount::new(kind, [visit.frame.x, visit.frame.y], clearance(visit), &visit.star)
=======
        PlaceReport::new(visit.star.kind(), [visit.frame.x, visit.frame.y], clearance(visit), &visit.star)
>>>>>>> local
    };
    let places: Vec<PlaceAccount> = survey.visits.iter().map(place).collect();
    tell(&PlacesAccount::along_log(&options.map.display().to_string(), places), options)?;
    Ok(Status::Found)
}

/// The place around one point.
fn around(
    grid: &OccupancyGrid,
    point: [f64; 2],
<<<<<<< HEAD
    parameters: &PlaceParameters,
    options: &StarsArguments,
=======
    parameters: &PlaceOptions,
    options: &StarsOptions,
>>>>>>> local
) -> Result<Status, Failure> {
    let outside = || Failure::Usage(format!("the point ({}, {}) is not on the map", point[0], point[1]));
    let side = 2.0 * (parameters.skeleton.shallowest_branch + MARGIN);
    let window = grid.window(point, side).ok_or_else(outside)?;
    let found = neighborhood(&window, point, parameters).map_err(|error| failure(&options.map, error))?;
    if let Some(file) = &options.svg {
        let picture = GridPicture {
            skeleton: Some(&found.graph.skeleton),
            places: vec![(found.center, &found.star)],
            robot: Some(point),
            ..GridPicture::default()
        };
        write_file(file, &draw_grid(&window, &picture))?;
    }
    let Neighborhood { kind, center, clearance, star, .. } = &found;
    let place = PlaceAccount::new(*kind, *center, *clearance, star);
    if options.json {
        print_json(&place)?;
    } else {
        print(&place.to_text(0))?;
    }
    Ok(Status::Found)
}

fn failure(map: &Path, error: impl std::fmt::Display) -> Failure {
    Failure::Usage(format!("{}: {error}", map.display()))
}

<<<<<<< HEAD
fn tell(account: &PlacesAccount, options: &StarsArguments) -> Result<(), Failure> {
    if options.json { print_json(account) } else { print(&account.to_string()) }
=======
impl Report {
    fn of(graph: &PlaceGraph, grid: &OccupancyGrid) -> Self {
        let places = graph.places.iter();
        let end = |&(place, olp): &(hssh_local::PlaceNumber, hssh_topology::Olp)| EndReport {
            place: place.0,
            end: graph.place(place).star.star.name(olp).to_string(),
        };
        let criterion = DoorOptions::default();
        let constriction = |gateway: &Gateway| {
            let hidden_area = hidden_area(grid, gateway, &criterion);
            let is_door = criterion.accept(gateway, hidden_area);
            ConstrictionReport { gateway: GatewayReport::new(gateway), hidden_area, is_door }
        };
        Report {
            places: places
                .map(|place| PlaceReport::new(place.kind, place.center, place.clearance, &place.star))
                .collect(),
            connections: graph.connections.iter().map(|found| found.ends.each_ref().map(end)).collect(),
            constrictions: graph.constrictions.iter().map(constriction).collect(),
        }
    }

    fn text(&self, map: &Path, grid: &OccupancyGrid) -> String {
        let mut text = format!(
            "{}: {} × {} cells of {} m; {}, {}\n",
            map.display(),
            grid.lattice().width(),
            grid.lattice().height(),
            grid.lattice().resolution(),
            counted(self.places.len(), "place"),
            counted(self.connections.len(), "connection"),
        );
        for (number, place) in self.places.iter().enumerate() {
            text += &place.text(number);
        }
        for [from, to] in &self.connections {
            text += &format!("{} {} leads to {} {}\n", from.place, from.end, to.place, to.end);
        }
        for door in self.constrictions.iter().filter(|found| found.is_door) {
            let ([x, y], width) = (door.gateway.position, door.gateway.width);
            text += &format!("a door at ({x:.1}, {y:.1}), {width:.1} m wide\n");
        }
        text
    }
}

impl GatewayReport {
    fn new(gateway: &Gateway) -> Self {
        let Gateway { position, bearing, width, line } = *gateway;
        GatewayReport { position, bearing, width, line }
    }
}

impl PlaceReport {
    fn new(kind: PlaceKind, center: [f64; 2], clearance: f64, star: &LocalStar) -> Self {
        let ends = star.star.olps().map(|olp| StarEndReport {
            name: star.star.name(olp).to_string(),
            bearing: star.bearings[olp.index()],
            gateway: star.gateways[olp.index()].as_ref().map(GatewayReport::new),
        });
        let kind = match kind {
            PlaceKind::Passage => "passage",
            PlaceKind::DeadEnd => "dead end",
            PlaceKind::Corner => "corner",
            PlaceKind::Junction => "junction",
        };
        PlaceReport {
            kind: kind.to_owned(),
            center,
            clearance,
            star: star.star.to_string(),
            ends: ends.collect(),
        }
    }

    fn text(&self, number: usize) -> String {
        let [x, y] = self.center;
        let mut text = format!("{number}: {} at ({x:.1}, {y:.1}), {}\n", self.kind, self.star);
        for end in &self.ends {
            let Some(gateway) = &end.gateway else { continue };
            let [x, y] = gateway.position;
            text += &format!(
                "    {} at {:.0}° through ({x:.1}, {y:.1}), {:.1} m wide\n",
                end.name,
                end.bearing.to_degrees(),
                gateway.width
            );
        }
        text
    }
>>>>>>> local
}
