//! The neighborhood of the robot: the place it is in, or the passage.

use super::parts::{PlaceNumber, PlacedSection};
use super::place_graph::{PlaceGraph, PlaceGraphError};
use crate::grid::OccupancyGrid;
use crate::place::gateway::gateway_on;
use crate::place::{Gateway, LocalStar, PlaceKind, PlaceOptions};
use crate::skeleton::{AxisPoint, distance};

/// What is around the robot.
#[derive(Clone, Debug)]
pub struct Neighborhood {
    /// Which kind of place, or a passage.
    pub kind: PlaceKind,
    /// The place's center; in a passage, the point of the medial axis next to the robot. In metres.
    pub center: [f64; 2],
    /// How far obstacles are from the center, in metres.
    pub clearance: f64,
    /// The star of the place; in a passage, the two ways on.
    pub star: LocalStar,
    /// Which of the places of `graph` it is; none in a passage.
    pub place: Option<PlaceNumber>,
    /// All places of the grid, those further away included.
    pub graph: PlaceGraph,
}

/// Why there is nothing to say about the robot's neighborhood.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
pub enum NeighborhoodError {
    /// The grid has no places.
    #[error(transparent)]
    Grid(#[from] PlaceGraphError),
    /// The robot is not where the grid is.
    #[error("the point ({}, {}) is not on the grid", .0[0], .0[1])]
    OffGrid([f64; 2]),
    /// There is no way out at all.
    #[error("the free space around ({}, {}) has no way out and is too small to have a medial axis", .0[0], .0[1])]
    Enclosed([f64; 2]),
}

/// A point of the axis: the edge, and the position in its points.
#[derive(Clone, Copy)]
struct OnAxis {
    edge: usize,
    at: usize,
}

/// What is around a robot at `robot` (metres, in the frame of the grid).
///
/// The robot is in a place if it is in the free disc around the place's center, or if the point of the
/// medial axis nearest to it lies between the center and a gateway. Otherwise it is in a passage.
///
/// # Errors
/// If the grid has no places at all, or the robot is not on it or is shut in.
pub fn neighborhood(
    grid: &OccupancyGrid,
    robot: [f64; 2],
    options: &PlaceOptions,
) -> Result<Neighborhood, NeighborhoodError> {
    grid.lattice().cell_at(robot).ok_or(NeighborhoodError::OffGrid(robot))?;
    let graph = PlaceGraph::new(grid, options)?;
    let on_axis = nearest_on_axis(&graph, grid, robot).ok_or(NeighborhoodError::Enclosed(robot))?;
    if let Some(number) = place_around(&graph, on_axis, robot) {
        let place = graph.place(number).clone();
        return Ok(Neighborhood {
            kind: place.kind,
            center: place.center,
            clearance: place.clearance,
            star: place.star,
            place: Some(number),
            graph,
        });
    }
    let point = graph.skeleton.edges[on_axis.edge].points[on_axis.at];
    let star = passage(&graph, on_axis, options).ok_or(NeighborhoodError::Enclosed(robot))?;
    Ok(Neighborhood {
        kind: PlaceKind::Passage,
        center: point.point,
        clearance: point.clearance,
        star,
        place: None,
        graph,
    })
}

/// The nearest point of the axis that the robot sees; if it sees none, the nearest of all.
fn nearest_on_axis(graph: &PlaceGraph, grid: &OccupancyGrid, robot: [f64; 2]) -> Option<OnAxis> {
    let lattice = grid.lattice();
    let here = lattice.cell_at(robot)?;
    let is_clear = |cell| graph.free.field().squared_cells(cell) != Some(0);
    let mut points: Vec<(f64, OnAxis)> = Vec::new();
    for (edge, line) in graph.skeleton.edges.iter().enumerate() {
        let away = |(at, point): (usize, &AxisPoint)| (distance(point.point, robot), OnAxis { edge, at });
        points.extend(line.points.iter().enumerate().map(away));
    }
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let is_seen = |on_axis: &OnAxis| {
        let cell = graph.skeleton.edges[on_axis.edge].points[on_axis.at].cell;
        lattice.line(here, cell).all(is_clear)
    };
    let seen = points.iter().map(|&(_, on_axis)| on_axis).find(is_seen);
    seen.or_else(|| points.first().map(|&(_, on_axis)| on_axis))
}

/// The place that the robot is in, if it is in one.
fn place_around(graph: &PlaceGraph, on_axis: OnAxis, robot: [f64; 2]) -> Option<PlaceNumber> {
    if let Some(place) = graph.parts.inner[on_axis.edge] {
        return Some(place);
    }
    let section = section_of(graph, on_axis)?;
    let [before, after] = section.ends;
    if let Some((place, gateway)) = before
        && on_axis.at <= gateway
    {
        return Some(place);
    }
    if let Some((place, gateway)) = after
        && on_axis.at >= gateway
    {
        return Some(place);
    }
    let is_around =
        |place: PlaceNumber| distance(graph.place(place).center, robot) <= graph.place(place).clearance;
    [before, after].into_iter().flatten().map(|(place, _)| place).find(|&place| is_around(place))
}

fn section_of(graph: &PlaceGraph, on_axis: OnAxis) -> Option<&PlacedSection> {
    graph.parts.sections.iter().find(|section| {
        section.edge == on_axis.edge && (section.range[0]..=section.range[1]).contains(&on_axis.at)
    })
}

/// The star of a passage: the two ways along the axis from a point.
fn passage(graph: &PlaceGraph, on_axis: OnAxis, options: &PlaceOptions) -> Option<LocalStar> {
    let points = &graph.skeleton.edges[on_axis.edge].points;
    let onward = &points[on_axis.at..];
    let back: Vec<AxisPoint> = points[..=on_axis.at].iter().rev().copied().collect();
    let clearance = points[on_axis.at].clearance;
    let gateway = |way: &[AxisPoint]| {
        (way.len() > 1).then(|| gateway_on(way, clearance, clearance, graph.free.field(), &options.gateway).1)
    };
    match [gateway(onward), gateway(&back)] {
        [Some(onward), Some(back)] => LocalStar::passage([onward, back]),
        [Some(only), None] | [None, Some(only)] => {
            LocalStar::passage([only, turned(only, points[on_axis.at])])
        }
        [None, None] => None,
    }
}

/// A gateway like the one given, in the opposite direction from a point at which the axis stops.
fn turned(gateway: Gateway, at: AxisPoint) -> Gateway {
    let shift = [at.point[0] - gateway.position[0], at.point[1] - gateway.position[1]];
    let moved = |point: [f64; 2]| [point[0] + shift[0], point[1] + shift[1]];
    let [left, right] = gateway.line.map(moved);
    Gateway {
        position: at.point,
        bearing: hssh_metrics::wrap_angle(gateway.bearing + std::f64::consts::PI),
        line: [right, left],
        ..gateway
    }
}
