//! Ways out of a neighborhood: free space that leads on.

use nalgebra::{Vector2, vector};

use super::axis::{Axis, fit};
use super::geodesic::Geodesic;
use super::options::PlaceOptions;
use crate::gateway::Gateway;
use crate::grid::{Cell, Lattice};

/// Thickness of a front in metres: the cells about equally far away.
const FRONT: f64 = 0.3;
/// Where a way out stops to count as it: so many metres before its depth.
const SLACK: f64 = 0.5;
/// Fronts of this many metres from the gateway on say which way a corridor goes.
const AIM: f64 = 6.0;

/// A way out of a neighborhood: its gateway and its axis.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct WayOut {
    /// Where it begins, in the frame of the grid.
    pub gateway: Gateway,
    pub(super) axis: Axis,
}

/// A way out with the cells that it was found by.
pub(super) struct Way {
    pub(super) out: WayOut,
    pub(super) cells: Vec<Cell>,
}

/// The ways out of the neighborhood that ends `border` metres of travel from where distances are counted.
pub(super) fn ways_out(
    lattice: &Lattice,
    distances: &Geodesic,
    border: f64,
    options: &PlaceOptions,
) -> Vec<Way> {
    let end = border + options.depth;
    let leads_on = |group: &Vec<Cell>| {
        group.iter().any(|&cell| distances.distance(cell).is_some_and(|distance| distance > end - SLACK))
    };
    let groups = distances.groups(border..end);
    groups
        .into_iter()
        .filter(leads_on)
        .filter_map(|cells| {
            let out = way(lattice, distances, border, &cells, options.narrowest_way)?;
            Some(Way { out, cells })
        })
        .collect()
}

/// The way through a group of cells: fronts, their middles, and the axis through these. `narrowest` is the
/// width in metres that had to fit into the way.
fn way(
    lattice: &Lattice,
    distances: &Geodesic,
    border: f64,
    group: &[Cell],
    narrowest: f64,
) -> Option<WayOut> {
    let fronts = (AIM / FRONT) as usize;
    let mut sums = vec![(Vector2::zeros(), 0.0); fronts];
    for &cell in group {
        let beyond = distances.distance(cell)? - border;
        if let Some((sum, count)) = sums.get_mut((beyond / FRONT) as usize) {
            let [x, y] = lattice.center(cell);
            (*sum, *count) = (*sum + vector![x, y], *count + 1.0);
        }
    }
    let middles: Vec<Vector2<f64>> =
        sums.iter().filter(|(_, count)| *count > 0.0).map(|(sum, count)| sum / *count).collect();
    let axis = fit(&middles)?;
    // What the robot's own width took away on both sides belongs to the way.
    let width = sums[0].1 * lattice.resolution().powi(2) / FRONT + narrowest;
    Some(WayOut { gateway: gateway(middles[0], axis, width), axis })
}

/// The line across the axis at a point.
fn gateway(at: Vector2<f64>, axis: Axis, width: f64) -> Gateway {
    let left = vector![-axis.direction.y, axis.direction.x] * (width / 2.0);
    let bearing = axis.direction.y.atan2(axis.direction.x);
    let line = [at + left, at - left].map(|end| [end.x, end.y]);
    Gateway { position: [at.x, at.y], bearing, width, line }
}
