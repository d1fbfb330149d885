//! How the frames of visits are turned against the frames of places: φ in metrical terms.
//!
//! A place has the frame in which the bearings of its star were given on the first visit. A robot that
//! comes back may see the star turned by φ; then the frame of that visit is turned too, by the difference of
//! the bearings of ends that φ takes to one another.

use hssh_metrics::{Pose, PoseId};
use hssh_topology::{Olp, Position, Star, StarId};

use crate::experience::Experience;
use crate::visited::Visited;

/// The bearings of all stars, from which follows how the frames of visits are turned against those of places. It grows with the
/// experience.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frames {
    /// By star: the directions of all its ends, as unit vectors.
    directions: Vec<Vec<[f64; 2]>>,
    /// The star seen on each visit, the start first.
    seen: Vec<StarId>,
}

impl Frames {
    pub(crate) fn of(experience: &Experience) -> Self {
        let mut frames = Frames::default();
        frames.observe(experience);
        frames
    }

    /// Takes notice of the visits that are new.
    pub(crate) fn observe(&mut self, experience: &Experience) {
        for (number, star) in experience.catalog.stars().enumerate().skip(self.directions.len()) {
            let bearings = bearings(star, experience.bearings(StarId::new(number as u32)));
            let directions = bearings.into_iter().map(|bearing| [bearing.cos(), bearing.sin()]);
            self.directions.push(directions.collect());
        }
        self.seen.extend(experience.seen().skip(self.seen.len()));
    }

    /// By what angle the frame of a visit is turned against that of a place that was first seen on another one, if φ turns the one star to the
    /// other by `rotation`: the mean difference of the bearings of corresponding ends.
    pub(crate) fn turn_between(&self, visit: usize, first: usize, rotation: u32) -> f64 {
        let [seen, first] = [visit, first].map(|visit| &self.directions[self.seen[visit].index()]);
        let turned = first.iter().cycle().skip(rotation as usize);
        let (cosine, sine) = seen.iter().zip(turned).fold((0.0, 0.0), |(cosine, sine), ([c, s], [x, y])| {
            (cosine + (x * c + y * s), sine + (y * c - x * s))
        });
        f64::atan2(sine, cosine)
    }

    /// Where a hypothesis takes the robot to have been, with the frames of visits.
    pub(crate) fn trail<'a>(&'a self, visited: &'a Visited) -> Trail<'a> {
        Trail { frames: self, visited }
    }
}

/// Where a hypothesis takes the robot to have been.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trail<'a> {
    frames: &'a Frames,
    visited: &'a Visited,
}

impl Trail<'_> {
    /// How many visits there are.
    pub(crate) fn visits(self) -> usize {
        self.visited.positions().len()
    }

    /// How many places were visited.
    pub(crate) fn places(self) -> usize {
        self.visited.first_visits().len()
    }

    /// The place of a visit, as a pose of a graph, and the visit's frame in it.
    pub(crate) fn end(self, visit: usize) -> (PoseId, Pose) {
        self.end_at(visit, self.visited.positions()[visit])
    }

    /// The same if the visit is to a known place.
    pub(crate) fn end_at(self, visit: usize, position: Position) -> (PoseId, Pose) {
        let Position { place, phi } = position;
        let first = self.visited.first_visits()[place.index()];
        (PoseId(place.number()), Pose::new(0.0, 0.0, self.frames.turn_between(visit, first, phi.rotation())))
    }
}

/// The bearings of all ends of a star. Ends without bearings count as spread evenly around the place, clockwise, turned so
/// that they agree best with those measured.
pub(crate) fn bearings(star: &Star, measured: &[Option<f64>]) -> Vec<f64> {
    let degree = f64::from(star.degree());
    let spread = |olp: Olp| -std::f64::consts::TAU * olp.index() as f64 / degree;
    let known = || star.olps().filter_map(|olp| Some(measured[olp.index()]? - spread(olp)));
    let offset = if known().next().is_some() { circular_mean(known()) } else { 0.0 };
    star.olps().map(|olp| measured[olp.index()].unwrap_or(spread(olp) + offset)).collect()
}

pub(crate) fn circular_mean(angles: impl Iterator<Item = f64>) -> f64 {
    let (sine, cosine) = angles.fold((0.0, 0.0), |(s, c), angle| (s + angle.sin(), c + angle.cos()));
    sine.atan2(cosine)
}
