//! Frames of visits from frames of places.

use hssh_metrics::Pose;
use hssh_topology::Position;

use crate::place::LocalStar;
use crate::survey::{Visit, turn};

/// The frame of every visit in the frame that the `places` are given in: for each place of a map the frame
/// of the first visit to it. `positions` says for each visit which place it was to and how its star maps
/// onto that of the first visit.
#[must_use]
pub fn visit_frames(visits: &[Visit], positions: &[Position], places: &[Pose]) -> Vec<Pose> {
    let mut first: Vec<Option<&LocalStar>> = vec![None; places.len()];
    let mut frames = Vec::with_capacity(visits.len());
    for (visit, position) in visits.iter().zip(positions) {
        let place = position.place.index();
        let seen_first = *first[place].get_or_insert(&visit.star);
        frames.push(places[place].compose(Pose::new(0.0, 0.0, turn(&visit.star, seen_first, position.phi))));
    }
    frames
}
