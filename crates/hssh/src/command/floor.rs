//! The regions of a grid map, its places and ways, and the files that are made of them.

use std::path::Path;

use hssh::account::{PlacesAccount, PointName};
use hssh::page::PlanData;
use hssh_draw::{GridPicture, RegionPicture, draw_grid};
use hssh_local::{
    DoorOptions, OccupancyGrid, PlaceGraph, PlaceOptions, RegionMap, Roadmap, doors, without_rims,
};

use super::export::write_places;
use super::stars::{failure, tell};
use crate::arguments::StarsArguments;
use crate::failure::{Failure, Status};
use crate::output::write_file;
use crate::terminal::say;

/// The color of a way.
const WAY: &str = "#0072b2";

pub(super) fn run(
    grid: &OccupancyGrid,
    parameters: &PlaceOptions,
    options: &StarsArguments,
) -> Result<Status, Failure> {
    let map =
        RegionMap::new(grid, &options.region_options()).map_err(|error| failure(&options.map, error))?;
    let roadmap = Roadmap::new(grid, &map, &options.roadmap_options());
    // For the axis, too, a gray rim is the edge of a wall and no frontier.
    let ground = options.detail.then(|| without_rims(grid, options.region_options().rim));
    let graph = match &ground {
        Some(ground) => {
            Some(PlaceGraph::new(ground, parameters).map_err(|error| failure(&options.map, error))?)
        }
        None => None,
    };
    let name = options.map.display().to_string();
    let mut account = match graph.as_ref().zip(ground.as_ref()) {
        Some((graph, ground)) => PlacesAccount::of_axis(&name, &map, &roadmap, graph, ground),
        None => PlacesAccount::of_regions(&name, &map, &roadmap, options.radius),
    };
    if let Some(file) = &options.names {
        name_regions(&mut account, &map, file)?;
    }
    tell(&account, options)?;
    if let Some(file) = &options.svg {
        write_file(file, &picture(grid, &map, &roadmap, graph.as_ref(), &account))?;
    }
    if let Some(file) = &options.page.html {
        write_file(file, &PlanData::new(&account, grid).to_html())?;
    }
    write_places(&options.files, &map, &account)?;
    Ok(if account.places.is_empty() { Status::NothingConsistent } else { Status::Found })
}

/// Gives the regions the names that stand in a file; a point that is in none is told on standard error.
fn name_regions(account: &mut PlacesAccount, map: &RegionMap, file: &Path) -> Result<(), Failure> {
    let text =
        std::fs::read_to_string(file).map_err(|error| Failure::Read { file: file.to_owned(), error })?;
    let names =
        PointName::read_all(&text).map_err(|error| Failure::Usage(format!("{}: {error}", file.display())))?;
    for PointName { point: [x, y], name } in names {
        match map.region_at([x, y]) {
            Some(region) => account.regions[region.index()].name = Some(name),
            None => {
                say(&format!("warning: {}: no region is at ({x}, {y}) to be called {name}", file.display()))
            }
        }
    }
    Ok(())
}

fn picture(
    grid: &OccupancyGrid,
    map: &RegionMap,
    roadmap: &Roadmap,
    graph: Option<&PlaceGraph>,
    account: &PlacesAccount,
) -> String {
    let regions = account
        .regions
        .iter()
        .map(|region| RegionPicture {
            rings: region.outline.iter().chain(&region.holes).cloned().collect(),
            color: region.color.clone(),
            name: region.name.clone().unwrap_or_default(),
        })
        .collect();
    let picture = GridPicture { regions, ..GridPicture::default() };
    match graph {
        Some(graph) => {
            let places = graph.places.iter().map(|place| (place.center, &place.star)).collect();
            let doors = doors(grid, &graph.constrictions, &DoorOptions::default());
            let skeleton = Some(&graph.skeleton);
            draw_grid(grid, &GridPicture { skeleton, places, constrictions: &doors, ..picture })
        }
        None => {
            let dots = roadmap.places.iter().map(|place| place.center).collect();
            let doors: Vec<_> = map
                .passages
                .iter()
                .filter(|passage| passage.is_door())
                .map(|passage| passage.gateway)
                .collect();
            let ways = roadmap.ways.iter().map(|way| (way.line.clone(), WAY)).collect();
            draw_grid(grid, &GridPicture { dots, constrictions: &doors, ways, ..picture })
        }
    }
}
