//! Networks that are drawn by hand, for tests.

use nalgebra::{Vector2, vector};
use proptest::prelude::*;

use super::network::{Network, Spot, Way, WayEnd};
use crate::grid::{Cell, Lattice, Occupancy, OccupancyGrid};

/// Metres between the points of a way.
const STEP: f64 = 0.1;

/// Which two spots a way joins, and the points that it passes between them.
pub(super) type Line = (usize, usize, Vec<[f64; 2]>);

/// A square of 40 m around the origin.
pub(super) fn lattice() -> Lattice {
    Lattice::new(400, 400, STEP, [-20.0, -20.0]).unwrap()
}

/// Points every 10 cm or a little less along a line through corners.
pub(super) fn along(corners: &[[f64; 2]]) -> Vec<Vector2<f64>> {
    let mut points = vec![Vector2::from(corners[0])];
    for pair in corners.windows(2) {
        let [from, to] = [Vector2::from(pair[0]), Vector2::from(pair[1])];
        let steps = ((to - from).norm() / STEP).ceil() as usize;
        points.extend((1..=steps).map(|step| from + (to - from) * (step as f64 / steps as f64)));
    }
    points
}

/// The network of spots at these points and of these ways.
pub(super) fn drawn(spots: &[[f64; 2]], lines: &[Line]) -> Network {
    let lattice = lattice();
    let cell = |point: &Vector2<f64>| lattice.cell_at([point.x, point.y]).unwrap();
    let ways = lines.iter().map(|(from, to, between)| {
        let corners: Vec<[f64; 2]> =
            [spots[*from]].into_iter().chain(between.iter().copied()).chain([spots[*to]]).collect();
        let points = along(&corners);
        let lengths = points.windows(2).map(|pair| (pair[1] - pair[0]).norm());
        let sums = lengths.scan(0.0, |sum, length| {
            *sum += length;
            Some(*sum)
        });
        Way {
            cells: points.iter().map(cell).collect(),
            along: [0.0].into_iter().chain(sums).collect(),
            points,
            spots: [*from, *to],
        }
    });
    let ends = |spot: usize| {
        let at = |(way, line): (usize, &Line)| {
            let first = (line.0 == spot).then_some(WayEnd { way, is_last: false });
            first.into_iter().chain((line.1 == spot).then_some(WayEnd { way, is_last: true }))
        };
        lines.iter().enumerate().flat_map(at).collect()
    };
    let spot = |(index, point): (usize, &[f64; 2])| {
        let center = vector![point[0], point[1]];
        Spot { center, arms: ends(index), core: vec![cell(&center)] }
    };
    Network { ways: ways.collect(), spots: spots.iter().enumerate().map(spot).collect() }
}

/// The cells within half a metre of ways, free, and all others, occupied.
pub(super) fn travelled(network: &Network) -> OccupancyGrid {
    let lattice = lattice();
    let mut grid = OccupancyGrid::filled(lattice, Occupancy::Occupied);
    for cell in network.ways.iter().flat_map(|way| &way.cells) {
        for (columns, rows) in (-5..=5).flat_map(|columns| (-5..=5).map(move |rows| (columns, rows))) {
            let near = Cell {
                column: cell.column.saturating_add_signed(columns),
                row: cell.row.saturating_add_signed(rows),
            };
            grid.set(near, Occupancy::Free);
        }
    }
    grid
}

/// Up to six spots and up to nine ways between them, straight or by way of another point.
pub(super) fn networks() -> impl Strategy<Value = Network> {
    let point = || (-15.0_f64..15.0, -15.0_f64..15.0).prop_map(|(x, y)| [x, y]);
    let line = (0_usize..6, 0_usize..6, prop::option::of(point()));
    (prop::collection::vec(point(), 1..7), prop::collection::vec(line, 0..10)).prop_map(|(spots, lines)| {
        let lines = lines.into_iter().map(|(from, to, between)| {
            let (from, to) = (from % spots.len(), to % spots.len());
            // What leads back to where it began has to go around something.
            let around = [[4.0, 0.0], [0.0, 4.0]].map(|[x, y]| [spots[from][0] + x, spots[from][1] + y]);
            let between = if from == to { around.to_vec() } else { between.into_iter().collect() };
            (from, to, between)
        });
        drawn(&spots, &lines.collect::<Vec<_>>())
    })
}
