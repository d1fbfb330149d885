//! How large things are that gaps lie between: what stands free in a room parts it less than the walls of the building do.

use rustc_hash::FxHashMap;

use super::ground::Ground;
use super::options::RegionOptions;
use crate::distance::DistanceField;
use crate::grid::{Cell, Lattice};

/// The obstacles that were asked about, as far as they were looked at.
pub(super) struct Islands<'a> {
    ground: &'a Ground,
    /// Obstacles no more than so many cells from one another, along both axes, are one thing.
    apart: i32,
    /// As large as this, in metres, a thing is wall.
    wall: f64,
    /// For each cell that was looked at its thing.
    thing_of: FxHashMap<usize, usize>,
    /// How large each thing is, in metres; that of walls is infinite.
    sizes: Vec<f64>,
}

impl<'a> Islands<'a> {
    pub(super) fn new(ground: &'a Ground, options: &RegionOptions) -> Self {
        let apart = (options.apart / ground.field().lattice().resolution()).round().max(1.0) as i32;
        Islands { ground, apart, wall: options.island, thing_of: FxHashMap::default(), sizes: Vec::new() }
    }

    /// How large the smaller of the things is at the two ends of a line, beside what is as good as the walls of the building; 1
    /// if both are.
    pub(super) fn smaller(&mut self, ends: [[f64; 2]; 2]) -> f64 {
        ends.into_iter().map(|end| self.size_at(end) / self.wall).fold(1.0, f64::min)
    }

    /// How long or wide the thing at a point is, the larger of both, in metres; infinite if it is wall, or leads beyond the map.
    fn size_at(&mut self, point: [f64; 2]) -> f64 {
        let field: &DistanceField = self.ground.field();
        let lattice = *field.lattice();
        let Some(start) = lattice.cell_at(point).and_then(|cell| field.nearest(cell)) else {
            return f64::INFINITY;
        };
        if let Some(&thing) = self.thing_of.get(&lattice.index(start)) {
            return self.sizes[thing];
        }
        // Until all of it is seen it may be wall.
        let thing = self.sizes.len();
        self.sizes.push(f64::INFINITY);
        self.thing_of.insert(lattice.index(start), thing);
        let mut waiting = vec![start];
        let (mut low, mut high) = (start, start);
        while let Some(here) = waiting.pop() {
            for near in self.around(here, &lattice) {
                let Some(near) = near else { return f64::INFINITY };
                let index = lattice.index(near);
                if !self.ground.is_obstacle(index) {
                    continue;
                }
                match self.thing_of.get(&index) {
                    Some(&other) if other == thing => {}
                    // What hangs together with something and was not found from there belongs to a wall.
                    Some(_) => return f64::INFINITY,
                    None => {
                        self.thing_of.insert(index, thing);
                        waiting.push(near);
                        low = Cell { column: low.column.min(near.column), row: low.row.min(near.row) };
                        high = Cell { column: high.column.max(near.column), row: high.row.max(near.row) };
                    }
                }
            }
            if size(low, high, &lattice) >= self.wall {
                return f64::INFINITY;
            }
        }
        self.sizes[thing] = size(low, high, &lattice);
        self.sizes[thing]
    }

    /// The cells around one that may belong to the same thing; none for those beyond the map. In the midst of a thing there is
    /// no gap to look across.
    fn around(&self, here: Cell, lattice: &Lattice) -> impl Iterator<Item = Option<Cell>> + use<> {
        let lattice = *lattice;
        let is_obstacle = |(columns, rows)| {
            let near = lattice.step(here, columns, rows);
            near.is_none_or(|near| self.ground.is_obstacle(lattice.index(near)))
        };
        let is_inner = square(1).all(is_obstacle);
        let reach = if is_inner { 1 } else { self.apart };
        square(reach).map(move |(columns, rows)| lattice.step(here, columns, rows))
    }
}

/// The longer side of the rectangle between two cells, in metres.
fn size(low: Cell, high: Cell, lattice: &Lattice) -> f64 {
    f64::from((high.column - low.column).max(high.row - low.row) + 1) * lattice.resolution()
}

/// The steps along both axes to all cells of a square.
fn square(reach: i32) -> impl Iterator<Item = (i32, i32)> {
    (-reach..=reach).flat_map(move |rows| (-reach..=reach).map(move |columns| (columns, rows)))
}
