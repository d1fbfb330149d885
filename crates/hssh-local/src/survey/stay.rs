//! Sightings of one place in succession.

use nalgebra::Vector2;

use crate::grid::OccupancyGrid;
use crate::matching::Track;
use crate::place::Sighting;

/// The sightings of one place from the robot's arrival to its departure.
#[derive(Clone, Debug)]
pub(super) struct Stay {
    /// The first and the last scan with a sighting.
    pub(super) first: usize,
    pub(super) last: usize,
    /// How many sightings there are.
    pub(super) sightings: usize,
    /// The scan taken nearest to the center, which is seen best from there.
    pub(super) reference: usize,
    /// What was seen from there, in the frame of the track.
    pub(super) sighting: Sighting,
    /// The local map that it was seen in.
    pub(super) grid: OccupancyGrid,
    off_center: f64,
}

impl Stay {
    pub(super) fn new(scan: usize, at: Vector2<f64>, sighting: Sighting, grid: OccupancyGrid) -> Self {
        let off_center = (sighting.center - at).norm();
        Stay { first: scan, last: scan, sightings: 1, reference: scan, sighting, grid, off_center }
    }

    /// Whether a sighting may be of the same place.
    pub(super) fn is_at(&self, center: Vector2<f64>, same_place: f64) -> bool {
        (self.sighting.center - center).norm() <= same_place
    }

    /// Adds a later sighting.
    pub(super) fn add(&mut self, later: Stay) {
        self.last = later.last;
        self.sightings += later.sightings;
        if later.off_center < self.off_center {
            self.reference = later.reference;
            self.sighting = later.sighting;
            self.grid = later.grid;
            self.off_center = later.off_center;
        }
    }

    /// Where the robot came from: where it was outside of the place's border last before the first
    /// sighting, but after scan `since`; failing that, where it was farthest out.
    pub(super) fn came_from(&self, track: &Track, since: usize) -> Option<Vector2<f64>> {
        self.outermost((since..=self.first).rev().map(|scan| position(track, scan)))
    }

    /// Where the robot went: where it was outside first after the last sighting, but before scan `until`;
    /// failing that, where it was farthest out.
    pub(super) fn went_to(&self, track: &Track, until: usize) -> Option<Vector2<f64>> {
        self.outermost((self.last..=until).map(|scan| position(track, scan)))
    }

    /// The first of some positions that is outside, or else that farthest from the center.
    fn outermost(&self, way: impl Iterator<Item = Vector2<f64>> + Clone) -> Option<Vector2<f64>> {
        let off = |at: &Vector2<f64>| (at - self.sighting.center).norm();
        let farthest = way.clone().max_by(|a, b| off(a).total_cmp(&off(b)));
        let mut way = way;
        way.find(|&at| self.is_outside(at)).or(farthest)
    }

    /// Whether a point is beyond the gateways.
    fn is_outside(&self, at: Vector2<f64>) -> bool {
        /// How far beyond, in metres.
        const BEYOND: f64 = 0.5;
        let gateways = self.sighting.gateways.iter().map(|gateway| Vector2::from(gateway.position));
        let farthest = gateways.map(|gateway| (gateway - self.sighting.center).norm()).fold(0.0, f64::max);
        (at - self.sighting.center).norm() > farthest + BEYOND
    }
}

fn position(track: &Track, scan: usize) -> Vector2<f64> {
    track.scans[scan].pose.translation()
}
