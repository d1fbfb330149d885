//! Ways out of a neighborhood: free space that leads on.

use nalgebra::{Vector2, vector};

use super::axis::{Axis, fit};
use super::geodesic::Geodesic;
use crate::grid::{Cell, Lattice};
use crate::place::gateway::{gateway_at, gateway_position};
use crate::place::{Gateway, GatewayOptions, PlaceOptions};
use crate::skeleton::{AxisPoint, FreeSpace};

/// Thickness of a front in metres: the cells about equally far away.
const FRONT: f64 = 0.3;
/// Where a way out stops to count as it: so many metres before its depth.
const SLACK: f64 = 0.5;

/// A way out of a neighborhood: its gateway, its axis, and the cells that it was found by.
pub(super) struct WayOut {
    pub(super) gateway: Gateway,
    pub(super) axis: Axis,
    pub(super) cells: Vec<Cell>,
}

/// The ways out of the neighborhood that ends `border` metres of travel from where distances are counted.
pub(super) fn ways_out(
    free: &FreeSpace,
    distances: &Geodesic,
    border: f64,
    options: &PlaceOptions,
) -> Vec<WayOut> {
    let end = border + options.depth();
    let leads_on = |group: &Vec<Cell>| {
        group.iter().any(|&cell| distances.distance(cell).is_some_and(|distance| distance > end - SLACK))
    };
    let groups = distances.groups(border..end).into_iter().filter(leads_on);
    groups.filter_map(|cells| way_out(free, distances, border, cells, &options.gateway)).collect()
}

/// The way through a group of cells: fronts, their middles, the axis through these, and the gateway where the way
/// begins.
fn way_out(
    free: &FreeSpace,
    distances: &Geodesic,
    border: f64,
    cells: Vec<Cell>,
    options: &GatewayOptions,
) -> Option<WayOut> {
    let lattice = free.field().lattice();
    let middles = middles(lattice, distances, border, &cells, options.fitted)?;
    let axis = fit(&middles)?;
    let line: Vec<AxisPoint> = middles.iter().filter_map(|&middle| on_line(free, middle)).collect();
    line.first()?;
    let near = ((options.reach_beyond / FRONT) as usize).clamp(1, line.len());
    let at = gateway_position(&line, 0..near, options);
    let bearing = axis.direction.y.atan2(axis.direction.x);
    Some(WayOut { gateway: gateway_at(&line[at], bearing, free.field()), axis, cells })
}

/// The middles of the fronts in a group of cells, the innermost first.
fn middles(
    lattice: &Lattice,
    distances: &Geodesic,
    border: f64,
    group: &[Cell],
    reach: f64,
) -> Option<Vec<Vector2<f64>>> {
    let mut sums = vec![(Vector2::zeros(), 0.0); (reach / FRONT) as usize];
    for &cell in group {
        let beyond = distances.distance(cell)? - border;
        if let Some((sum, count)) = sums.get_mut((beyond / FRONT) as usize) {
            let [x, y] = lattice.center(cell);
            (*sum, *count) = (*sum + vector![x, y], *count + 1.0);
        }
    }
    Some(sums.iter().filter(|(_, count)| *count > 0.0).map(|(sum, count)| sum / *count).collect())
}

/// A point of the line along the middle of a way, with the room that is there.
fn on_line(free: &FreeSpace, middle: Vector2<f64>) -> Option<AxisPoint> {
    let point = [middle.x, middle.y];
    let cell = free.field().lattice().cell_at(point)?;
    Some(AxisPoint { cell, point, clearance: free.field().clearance(cell) })
}
