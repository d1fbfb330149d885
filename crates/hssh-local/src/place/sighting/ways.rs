//! Ways out of a neighborhood: free space that leads on.

use nalgebra::{Vector2, vector};

use super::axis::{Axis, fit};
use crate::geodesic::Geodesic;
use crate::grid::{Cell, Lattice};
use crate::place::{Gateway, PlaceOptions};
use crate::skeleton::FreeSpace;

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
    groups.filter_map(|cells| way_out(free, distances, border, cells, options)).collect()
}

/// The way through a group of cells: fronts, their middles, the axis through these, and the gateway where the way
/// begins: at the middle of the first front, as wide as that is.
///
/// The narrowest point of the first metre, as along a medial axis, lets a robot that drives by gateways stop up to 0.6 m off
/// center where it was 0.2 m: clutter moves it from one look to the next.
fn way_out(
    free: &FreeSpace,
    distances: &Geodesic,
    border: f64,
    cells: Vec<Cell>,
    options: &PlaceOptions,
) -> Option<WayOut> {
    let lattice = free.field().lattice();
    let fronts = fronts(lattice, distances, border, &cells, options.gateway.fitted)?;
    let middles: Vec<Vector2<f64>> =
        fronts.iter().filter(|(_, count)| *count > 0.0).map(|(sum, count)| sum / *count).collect();
    let axis = fit(&middles)?;
    // What the robot's own width took away on both sides belongs to the way.
    let width = fronts[0].1 * lattice.resolution().powi(2) / FRONT + options.skeleton.narrowest_passage;
    let gateway = Gateway::across([middles[0].x, middles[0].y], axis.direction, width);
    Some(WayOut { gateway, axis, cells })
}

/// The fronts of a group of cells, the innermost first: the sum of the centers of their cells, and how many these are.
fn fronts(
    lattice: &Lattice,
    distances: &Geodesic,
    border: f64,
    group: &[Cell],
    reach: f64,
) -> Option<Vec<(Vector2<f64>, f64)>> {
    let mut sums = vec![(Vector2::zeros(), 0.0); (reach / FRONT) as usize];
    for &cell in group {
        let beyond = distances.distance(cell)? - border;
        if let Some((sum, count)) = sums.get_mut((beyond / FRONT) as usize) {
            let [x, y] = lattice.center(cell);
            (*sum, *count) = (*sum + vector![x, y], *count + 1.0);
        }
    }
    Some(sums)
}
