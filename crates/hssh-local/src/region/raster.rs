//! Obstacles of a lattice as they are asked at points in cells, with a few words of geometry.

use crate::grid::{Cell, Lattice};

/// A point or a vector in cells; the middle of a cell is a whole number.
pub(super) type Vector = [f64; 2];

/// A lattice of which the obstacles are asked by index.
pub(super) struct Raster<F> {
    pub(super) lattice: Lattice,
    pub(super) is_obstacle: F,
}

impl<F: Fn(usize) -> bool> Raster<F> {
    pub(super) fn cells(&self, metres: f64) -> f64 {
        metres / self.lattice.resolution()
    }

    /// The cell at a point, if it is on the lattice.
    pub(super) fn cell_at(&self, [column, row]: Vector) -> Option<Cell> {
        // The whole number nearest to what is not negative; rounding calls the library.
        let (column, row) = (column + 0.5, row + 0.5);
        let is_on = (0.0..f64::from(self.lattice.width())).contains(&column)
            && (0.0..f64::from(self.lattice.height())).contains(&row);
        is_on.then_some(Cell { column: column as u32, row: row as u32 })
    }

    /// Whether there is an obstacle at a point. There is beyond the map.
    pub(super) fn is_at(&self, point: Vector) -> bool {
        self.cell_at(point).is_none_or(|cell| (self.is_obstacle)(self.lattice.index(cell)))
    }

    /// A point in metres.
    pub(super) fn metres(&self, [column, row]: Vector) -> [f64; 2] {
        self.lattice.point([column + 0.5, row + 0.5])
    }
}

pub(super) fn point(cell: Cell) -> Vector {
    [f64::from(cell.column), f64::from(cell.row)]
}

pub(super) fn plus([x, y]: Vector, [dx, dy]: Vector, times: f64) -> Vector {
    [x + times * dx, y + times * dy]
}

pub(super) fn minus([ax, ay]: Vector, [bx, by]: Vector) -> Vector {
    [ax - bx, ay - by]
}

pub(super) fn length([x, y]: Vector) -> f64 {
    x.hypot(y)
}

pub(super) fn unit(vector: Vector) -> Vector {
    let length = length(vector).max(f64::MIN_POSITIVE);
    vector.map(|axis| axis / length)
}

/// The vector of length 1 at an angle.
pub(super) fn toward(angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    [cos, sin]
}
