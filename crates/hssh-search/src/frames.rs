//! How the frames of visits are turned against the frames of places: φ in metrical terms.
//!
//! A place has the frame in which the bearings of its star were given on the first visit. A robot that
//! comes back may see the star turned by φ; then the frame of that visit is turned too, by the difference of
//! the bearings of ends that φ takes to one another.

use hssh_metrics::{Pose, PoseId};
use hssh_topology::{Olp, Position, Star, StarId};

use crate::experience::Experience;

/// The angles between the frames of visits and of places, for every pair of stars and every φ. It grows with the
/// experience.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frames {
    /// By star seen, star of the first visit, and rotation of φ; radians.
    turns: Vec<Vec<Vec<f64>>>,
    /// By star: the bearings of all its ends.
    bearings: Vec<Vec<f64>>,
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
        let stars: Vec<&Star> = experience.catalog.stars().collect();
        for (number, star) in stars.iter().enumerate().skip(self.bearings.len()) {
            self.bearings.push(bearings(star, experience.bearings(StarId::new(number as u32))));
        }
        for seen in 0..stars.len() {
            let known = self.turns.get(seen).map_or(0, Vec::len);
            let missing: Vec<_> = (known..stars.len())
                .map(|first| turns(&self.bearings[seen], &self.bearings[first]))
                .collect();
            match self.turns.get_mut(seen) {
                Some(row) => row.extend(missing),
                None => self.turns.push(missing),
            }
        }
        self.seen.extend(experience.seen().skip(self.seen.len()));
    }

    /// By what angle the frame of a visit is turned against that of a place whose star was `first` on its
    /// first visit, if φ turns the one star to the other by `rotation`.
    pub(crate) fn turn(&self, visit: usize, first: StarId, rotation: u32) -> f64 {
        self.turns[self.seen[visit].index()][first.index()][rotation as usize]
    }

    /// The same if the place was first seen on the visit `first`.
    pub(crate) fn turn_between(&self, visit: usize, first: usize, rotation: u32) -> f64 {
        self.turn(visit, self.seen[first], rotation)
    }

    /// The frame of each visit in the frame of its place.
    pub(crate) fn trail(&self, visits: Vec<Position>) -> Trail {
        let mut trail = Trail { frames: Vec::with_capacity(visits.len()), first_seen: Vec::new(), visits };
        for (visit, position) in trail.visits.iter().enumerate() {
            if position.place.index() == trail.first_seen.len() {
                trail.first_seen.push(self.seen[visit]);
            }
            let first = trail.first_seen[position.place.index()];
            trail.frames.push(Pose::new(0.0, 0.0, self.turn(visit, first, position.phi.rotation())));
        }
        trail
    }
}

/// Where a hypothesis takes the robot to have been.
#[derive(Clone, Debug)]
pub(crate) struct Trail {
    /// The place of each visit, with φ. Places are numbered in the order they were found.
    pub(crate) visits: Vec<Position>,
    /// The frame of each visit in the frame of its place.
    pub(crate) frames: Vec<Pose>,
    /// By place: the star seen on its first visit, whose bearings give the place its frame.
    pub(crate) first_seen: Vec<StarId>,
}

impl Trail {
    /// The place of a visit, as a pose of a graph, and the visit's frame in it.
    pub(crate) fn end(&self, visit: usize) -> (PoseId, Pose) {
        (PoseId(self.visits[visit].place.number()), self.frames[visit])
    }
}

/// By rotation of φ: the mean difference of the bearings of corresponding ends. None if there is no φ, for want of
/// as many ends.
fn turns(seen: &[f64], first: &[f64]) -> Vec<f64> {
    let degree = seen.len();
    let rotations = if degree == first.len() { 0..degree } else { 0..0 };
    let turn = |rotation| circular_mean((0..degree).map(|end| first[(end + rotation) % degree] - seen[end]));
    rotations.map(turn).collect()
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
