//! Where the robot came back to, as the laser shows.

use super::evidence::{BELIEVED, CONFIRMING, stretches};
use super::visit::{Survey, Visit};
use crate::closing::Closure;

impl Survey {
    /// The closures by which the laser shows that the robot was back: those of each return together, by the later scan.
    #[must_use]
    pub fn returns(&self) -> Vec<Vec<Closure>> {
        stretches(&self.track, self.closures.iter().filter(|closure| closure.weight >= BELIEVED))
    }

    /// Whether the laser shows that a visit was to the spot of an earlier one: for this visit and one of those before there is a
    /// closure nearby.
    #[must_use]
    pub fn shows_return(&self, later: usize) -> bool {
        let at = |scan: usize| self.track.scans[scan].travelled;
        let is_near = |visit: &Visit, scan: usize| (at(visit.reference) - at(scan)).abs() < CONFIRMING;
        let (before, [visit, ..]) = self.visits.split_at(later) else { return false };
        let earlier: Vec<&Visit> = before.iter().filter(|earlier| earlier.spot == visit.spot).collect();
        self.closures.iter().filter(|closure| closure.weight >= BELIEVED).any(|closure| {
            is_near(visit, closure.later) && earlier.iter().any(|earlier| is_near(earlier, closure.earlier))
        })
    }
}
