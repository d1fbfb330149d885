//! How the frames of visits are turned against the frames of places: φ in metrical terms.
//!
//! A place has the frame in which the bearings of its star were given on the first visit. A robot that
//! comes back may see the star turned by φ; then the frame of that visit is turned too, by the difference of
//! the bearings of ends that φ takes to one another.

use hssh_causal::{Exploration, NamedStar, StarType};
use hssh_metrics::{Pose, PoseId};
use hssh_topology::{Olp, Position};

/// The angles between the frames of visits and of places, for every pair of star types and every φ.
#[derive(Clone, Debug)]
pub(crate) struct Frames {
    /// By star type seen, star type of the first visit, and rotation of φ; radians.
    turns: Vec<Vec<Vec<f64>>>,
    /// The star type seen on each visit, the start first.
    seen: Vec<StarType>,
}

impl Frames {
    pub(crate) fn of(exploration: &Exploration) -> Self {
        let types = || (0..exploration.star_types().len() as u32).map(StarType);
        let degree = |star: StarType| exploration.star_types()[star.index()].star.degree();
        let turns_between = |seen: StarType, first: StarType| {
            let rotations = if degree(seen) == degree(first) { 0..degree(seen) } else { 0..0 };
            rotations.map(|rotation| turn(exploration, seen, first, rotation)).collect()
        };
        let turns = types().map(|seen| types().map(|first| turns_between(seen, first)).collect()).collect();
        Frames { turns, seen: exploration.visits().collect() }
    }

    /// By what angle the frame of a visit is turned against that of a place whose star was `first` on its
    /// first visit, if φ turns the one star to the other by `rotation`.
    pub(crate) fn turn(&self, visit: usize, first: StarType, rotation: u32) -> f64 {
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
    /// By place: the star type seen on its first visit, whose bearings give the place its frame.
    pub(crate) first_seen: Vec<StarType>,
}

impl Trail {
    /// The place of a visit, as a pose of a graph, and the visit's frame in it.
    pub(crate) fn end(&self, visit: usize) -> (PoseId, Pose) {
        (PoseId(self.visits[visit].place.number()), self.frames[visit])
    }
}

/// The mean difference of the bearings of corresponding ends.
fn turn(exploration: &Exploration, seen: StarType, first: StarType, rotation: u32) -> f64 {
    let (seen, first) = (&exploration.star_types()[seen.index()], &exploration.star_types()[first.index()]);
    let degree = seen.star.degree();
    let image = |olp: Olp| olp.turned(rotation, degree);
    let (of_seen, of_first) = (bearings(seen), bearings(first));
    circular_mean(seen.star.olps().map(|olp| of_first[image(olp).index()] - of_seen[olp.index()]))
}

/// The bearings of all ends of a star. Ends without bearings count as spread evenly around the place, clockwise, turned so
/// that they agree best with those measured.
fn bearings(named: &NamedStar) -> Vec<f64> {
    let degree = f64::from(named.star.degree());
    let spread = |olp: Olp| -std::f64::consts::TAU * f64::from(olp.number()) / degree;
    let measured = || named.star.olps().filter_map(|olp| Some(named.bearings[olp.index()]? - spread(olp)));
    let offset = if measured().next().is_some() { circular_mean(measured()) } else { 0.0 };
    named.star.olps().map(|olp| named.bearings[olp.index()].unwrap_or(spread(olp) + offset)).collect()
}

fn circular_mean(angles: impl Iterator<Item = f64>) -> f64 {
    let (sine, cosine) = angles.fold((0.0, 0.0), |(s, c), angle| (s + angle.sin(), c + angle.cos()));
    sine.atan2(cosine)
}
