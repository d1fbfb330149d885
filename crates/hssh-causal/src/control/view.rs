//! The free space that is in sight, as a polygon: where in it there is how much room.

use super::Percept;

/// What is in sight, in the robot's frame.
pub(super) struct View {
    /// The corners of what is in sight, counterclockwise, each with the way to the next one. Beams that did
    /// not come back have no corner.
    border: Vec<([f64; 2], [f64; 2])>,
}

impl View {
    pub(super) fn new(percept: &Percept) -> Self {
        let corners: Vec<[f64; 2]> = percept.obstacles().collect();
        let next = corners.iter().cycle().skip(1);
        let border = corners.iter().zip(next).map(|(from, to)| (*from, [to[0] - from[0], to[1] - from[1]]));
        View { border: border.collect() }
    }

    /// How far a disc around a point reaches before it meets the border of what is in sight: an obstacle, or
    /// the line behind which an obstacle hides what is there. 0 for a point that is not in sight.
    pub(super) fn clearance_at(&self, point: [f64; 2]) -> f64 {
        let (mut squared, mut is_inside) = (f64::INFINITY, false);
        for &(from, along) in &self.border {
            let off = [point[0] - from[0], point[1] - from[1]];
            squared = squared.min(squared_distance(off, along));
            // A ray along x leaves a polygon as often as it crosses the border, less the times it comes in.
            let is_crossed = (off[1] < 0.0) != (off[1] < along[1]);
            is_inside ^= is_crossed && off[0] * along[1].abs() < off[1] * along[0] * along[1].signum();
        }
        if is_inside { squared.sqrt() } else { 0.0 }
    }
}

/// From a point to the piece of a line that leads `along` from the origin.
fn squared_distance(point: [f64; 2], along: [f64; 2]) -> f64 {
    let squared = along[0] * along[0] + along[1] * along[1];
    let part = ((point[0] * along[0] + point[1] * along[1]) / squared.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (point[0] - part * along[0]).powi(2) + (point[1] - part * along[1]).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is seen from a point of a square room of 4 m, with every seventh beam lost.
    #[test]
    fn the_room_in_a_square_is_the_distance_to_its_nearest_side() {
        let range = |index: u32| {
            let (sin, cos) = f64::from(index).to_radians().sin_cos();
            let to = |at: f64, part: f64| (2.0 * part.signum() - at) / part;
            if index % 7 == 3 { f64::INFINITY } else { to(0.5, cos).min(to(-0.25, sin)) }
        };
        let view = View::new(&Percept { ranges: (0..360).map(range).collect(), neighborhood: None });
        for column in -12..=12 {
            for row in -12..=12 {
                let [x, y] = [f64::from(column) * 0.23, f64::from(row) * 0.23];
                let expected = (2.0 - (x + 0.5).abs()).min(2.0 - (y - 0.25).abs()).max(0.0);
                let found = view.clearance_at([x, y]);
                assert!((found - expected).abs() < 0.03, "{found} is not {expected} at ({x}, {y})");
            }
        }
    }
}
