//! The regions, passages, places and ways of a grid map.

use clap::ValueEnum;
use hssh::account::{PlaceAccount, PlacesAccount, PointName};
use hssh::export::{ExportKind, Spacing, export_places};
use hssh::pipeline::PlaceChoice;
use hssh_draw::{GridPicture, RegionPicture, draw_grid};
use hssh_local::{
    PlaceGraph, PlaceOptions, RegionMap, RegionOptions, Roadmap, RoadmapOptions, UnknownSpace, neighborhood,
    without_rims,
};
use pyo3::prelude::*;

use crate::arrays::shaped;
use crate::errors::{Kind, argument, error};
use crate::grid::PyGrid;
use crate::watch::{calmly, finished};

/// How far the part of a map that is looked at around one point reaches, in metres, beyond the shallowest way out.
const MARGIN: f64 = 6.5;
/// The color of a way.
const WAY: &str = "#0072b2";

/// What was found in a grid map, behind the places that Python shows.
#[pyclass(name = "FoundPlaces", module = "hssh._hssh", frozen)]
pub(crate) struct PyPlaces {
    account: PlacesAccount,
    map: RegionMap,
}

/// What counts as a place, in the terms of the program's flags.
fn choice(narrowest: Option<f64>, shallowest: Option<f64>, clutter: Option<f64>) -> PyResult<PlaceChoice> {
    for (name, metres) in [("narrowest", narrowest), ("shallowest", shallowest), ("clutter", clutter)] {
        if let Some(metres) = metres.filter(|metres| !(metres.is_finite() && *metres >= 0.0)) {
            return Err(argument(format!("{name} is {metres}: write a number of metres, like 0.8")));
        }
    }
    Ok(PlaceChoice { narrowest, shallowest, clutter })
}

fn unknown(is_free: bool) -> UnknownSpace {
    if is_free { UnknownSpace::Free } else { UnknownSpace::Wall }
}

/// For which program a map is written.
pub(crate) fn export_kind(kind: &str) -> PyResult<ExportKind> {
    ExportKind::from_str(&kind.replace('_', "-"), false).map_err(|_| {
        let known: Vec<String> =
            ExportKind::value_variants().iter().map(|known| known.to_string().replace('-', "_")).collect();
        argument(format!("kind is \"{kind}\": write one of {}", known.join(", ")))
    })
}

/// How far neighboring points of a way may be apart.
pub(crate) fn spacing_of(metres: f64) -> PyResult<Spacing> {
    Spacing::new(metres).ok_or_else(|| {
        argument(format!(
            "spacing is {metres}: write the metres between points of a way, {} or more",
            Spacing::LEAST
        ))
    })
}

/// Finds the regions of a grid map, and the ways of a robot through them.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // hssh.places has them as keywords
pub(crate) fn find_places(
    py: Python<'_>,
    grid: &PyGrid,
    radius: f64,
    narrowest: Option<f64>,
    shallowest: Option<f64>,
    clutter: Option<f64>,
    unknown_is_free: bool,
    detail: bool,
    names: Vec<(f64, f64, String)>,
) -> PyResult<PyPlaces> {
    if !(radius > 0.0 && radius.is_finite()) {
        return Err(argument(format!(
            "radius is {radius}: write the metres of the robot's radius, like 0.25"
        )));
    }
    let choice = choice(narrowest, shallowest, clutter)?;
    let unknown = unknown(unknown_is_free);
    let usual = RegionOptions::default();
    let regions = RegionOptions {
        unknown,
        narrowest: narrowest.unwrap_or(usual.narrowest),
        furniture: clutter.unwrap_or(usual.furniture),
        ..usual
    };
    let ways = RoadmapOptions { unknown, radius, ..RoadmapOptions::default() };
    let parameters: PlaceOptions = choice.in_grids(unknown);
    let PyGrid { grid, name, .. } = grid;
    let found = finished(py, |_| {
        let map = RegionMap::new(grid, &regions)?;
        let roadmap = Roadmap::new(grid, &map, &ways);
        let account = if detail {
            let ground = without_rims(grid, regions.rim);
            PlacesAccount::of_axis(name, &map, &roadmap, &PlaceGraph::new(&ground, &parameters)?, &ground)
        } else {
            PlacesAccount::of_regions(name, &map, &roadmap, radius)
        };
        Ok((map, account))
    })?;
    let (map, mut account) = found
        .map_err(|problem: hssh_local::PlaceGraphError| error(Kind::Survey, format!("{name}: {problem}")))?;
    for PointName { point, name } in names.into_iter().map(|(x, y, name)| PointName { point: [x, y], name }) {
        let region = map.region_at(point).ok_or_else(|| {
            argument(format!("no region is at ({}, {}) to be called {name}", point[0], point[1]))
        })?;
        account.regions[region.index()].name = Some(name);
    }
    Ok(PyPlaces { account, map })
}

/// The place around one point of a grid map, as JSON.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // Grid.place_at has them as keywords
pub(crate) fn place_around(
    py: Python<'_>,
    grid: &PyGrid,
    x: f64,
    y: f64,
    narrowest: Option<f64>,
    shallowest: Option<f64>,
    clutter: Option<f64>,
    unknown_is_free: bool,
) -> PyResult<String> {
    let parameters = choice(narrowest, shallowest, clutter)?.in_grids(unknown(unknown_is_free));
    let side = 2.0 * (parameters.skeleton.shallowest_branch + MARGIN);
    let outside = || argument(format!("the point ({x}, {y}) is not on the map"));
    let window = Some([x, y]).filter(|_| x.is_finite() && y.is_finite());
    let window = window.and_then(|point| grid.grid.window(point, side)).ok_or_else(outside)?;
    let rim = RegionOptions::default().rim;
    let found = finished(py, |_| neighborhood(&without_rims(&window, rim), [x, y], &parameters))?;
    let found = found.map_err(|problem| error(Kind::Survey, format!("{}: {problem}", grid.name)))?;
    let place = PlaceAccount::new(found.kind, found.center, found.clearance, &found.star);
    serde_json::to_string(&place).map_err(|problem| error(Kind::Internal, problem))
}

#[pymethods]
impl PyPlaces {
    fn to_json(&self) -> PyResult<String> {
        let text = serde_json::to_string_pretty(&self.account);
        Ok(text.map_err(|problem| error(Kind::Internal, problem))? + "\n")
    }

    fn to_text(&self) -> String {
        self.account.to_string()
    }

    /// The number of the region of each cell, or -1, shape (H, W), the bottom row first.
    fn labels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let lattice = self.map.lattice();
        let label = |cell| self.map.region_of(cell).map_or(-1, |region| region.0 as i32);
        let shape = [lattice.height() as usize, lattice.width() as usize];
        shaped(py, lattice.cells().map(label).collect(), shape)
    }

    /// The map for another program.
    fn export(&self, kind: &str, spacing: f64) -> PyResult<String> {
        let (kind, spacing) = (export_kind(kind)?, spacing_of(spacing)?);
        calmly(|| Ok(export_places(&self.account, kind, spacing).map_err(argument)?.text))
    }

    /// The map with its regions, doors and ways as SVG.
    fn to_svg(&self, py: Python<'_>, grid: &PyGrid) -> PyResult<String> {
        let account = &self.account;
        let region = |region: &hssh::account::RegionAccount| RegionPicture {
            rings: region.outline.iter().chain(&region.holes).cloned().collect(),
            color: region.color.clone(),
            name: region.name.clone().unwrap_or_default(),
        };
        finished(py, |_| {
            let ways = account.roadmap.iter().flat_map(|roadmap| &roadmap.ways);
            let doors: Vec<_> =
                self.map.passages.iter().filter(|door| door.is_door()).map(|door| door.gateway).collect();
            draw_grid(
                &grid.grid,
                &GridPicture {
                    regions: account.regions.iter().map(region).collect(),
                    dots: account.places.iter().map(|place| place.center).collect(),
                    constrictions: &doors,
                    ways: ways.map(|way| (way.line.clone(), WAY)).collect(),
                    ..GridPicture::default()
                },
            )
        })
    }
}
