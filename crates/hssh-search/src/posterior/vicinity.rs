//! Boxes around visits that follow one another, by which many are passed over at once that are too far away.

use hssh_metrics::Pose;

use crate::posterior::course::Course;
use crate::posterior::runs::Runs;
use crate::posterior::way::{LEAST_DETERMINANT, MARGIN};

/// A box around the positions of some visits in the frame of the first visit of all: metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    least: [f64; 2],
    most: [f64; 2],
}

impl Bounds {
    fn around(pose: Pose) -> Self {
        Bounds { least: [pose.x, pose.y], most: [pose.x, pose.y] }
    }

    fn and(self, other: Bounds) -> Self {
        let of = |choose: fn(f64, f64) -> f64, one: [f64; 2], two: [f64; 2]| {
            [choose(one[0], two[0]), choose(one[1], two[1])]
        };
        Bounds { least: of(f64::min, self.least, other.least), most: of(f64::max, self.most, other.most) }
    }

    /// Whether χ²/2 is certainly more than this of any position in the box being that one, if the offset between the two has no larger
    /// covariance than this one: xx, xy, yy.
    fn is_beyond(&self, there: Pose, [xx, xy, yy]: [f64; 3], half_chi2: f64) -> bool {
        let determinant = xx * yy - xy * xy;
        let largest = xx.max(yy);
        if determinant.is_nan() || determinant <= LEAST_DETERMINANT * largest * largest {
            return false;
        }
        let middle = [0, 1].map(|axis| 0.5 * self.least[axis] + 0.5 * self.most[axis]);
        let half_sides = [0, 1].map(|axis| 0.5 * (self.most[axis] - self.least[axis]));
        let [x, y] = [there.x - middle[0], there.y - middle[1]];
        // For any vector u, dᵀ C⁻¹ d ≥ (u·d)² / uᵀ C u; here u = C⁻¹ d with the d of the middle.
        let u = [(yy * x - xy * y) / determinant, (xx * y - xy * x) / determinant];
        let chi2 = u[0] * x + u[1] * y;
        let least = chi2 - u[0].abs() * half_sides[0] - u[1].abs() * half_sides[1];
        least > 0.0 && 0.5 * least * least > MARGIN * half_chi2 * chi2
    }
}

/// Some visits in order, those that follow one another boxed in.
#[derive(Clone, Debug)]
pub(super) struct Vicinity {
    visits: Vec<usize>,
    bounds: Runs<Bounds>,
}

impl Vicinity {
    /// No visits yet.
    pub(super) fn new() -> Self {
        Vicinity { visits: Vec::new(), bounds: Runs::new() }
    }

    /// One visit more, after those before.
    pub(super) fn push(&mut self, visit: usize, course: &Course) {
        self.visits.push(visit);
        self.bounds.push(Bounds::around(course.pose(visit)), Bounds::and);
    }

    /// The first of the visits, from that number among them on, that can be at the place of a later one with χ²/2 at most so
    /// much; its number among them, and the visit.
    ///
    /// In the frame of the first visit of all, the covariance of the way to the later visit only grows with its length. That from the first
    /// visit of a box on therefore bounds those from all others in the box.
    pub(super) fn next(
        &self,
        number: usize,
        later: usize,
        half_chi2: f64,
        course: &Course,
    ) -> Option<(usize, usize)> {
        let there = course.pose(later);
        let is_out = |number: usize, bounds: Bounds| {
            let spread = course.about(self.visits[number], later).position();
            bounds.is_beyond(there, spread, half_chi2)
        };
        let number = self.bounds.next(number, is_out)?;
        Some((number, self.visits[number]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever point of a box is taken, it is no nearer than the box was said to be.
    #[test]
    fn boxes_are_no_nearer_than_their_points() {
        let spread = [4.0, 1.5, 1.0];
        let determinant = spread[0] * spread[2] - spread[1] * spread[1];
        let half_chi2 = |x: f64, y: f64| {
            0.5 * (spread[2] * x * x - 2.0 * spread[1] * x * y + spread[0] * y * y) / determinant
        };
        let mut beyond = 0;
        for (column, row) in (-8..8).flat_map(|column| (-8..8).map(move |row| (column, row))) {
            let least = [f64::from(column), f64::from(row)];
            let bounds = Bounds { least, most: [least[0] + 2.0, least[1] + 0.5] };
            let there = Pose::new(0.3, -0.2, 1.0);
            if bounds.is_beyond(there, spread, 5.0) {
                beyond += 1;
                for (part, other) in (0..=4).flat_map(|part| (0..=4).map(move |other| (part, other))) {
                    let at = [least[0] + 0.5 * f64::from(part), least[1] + 0.125 * f64::from(other)];
                    assert!(half_chi2(there.x - at[0], there.y - at[1]) > 5.0, "{bounds:?} at {at:?}");
                }
            }
        }
        assert!(beyond > 100, "{beyond} of 256");
        assert!(!Bounds::around(Pose::new(9.0, 9.0, 0.0)).is_beyond(Pose::IDENTITY, [1e12, 0.0, 1e-9], 1.0));
    }
}
