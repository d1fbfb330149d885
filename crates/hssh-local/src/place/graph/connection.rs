//! What is at the other side of gateways: the places that the medial axis leads to.

use hssh_topology::Olp;

use super::parts::PlaceNumber;
use super::section::{Section, Way};
use crate::skeleton::{AxisPoint, Skeleton, Tip};

/// Two gateways that one way along the medial axis connects.
#[derive(Clone, PartialEq, Debug)]
pub struct PlaceConnection {
    /// The places with the ends of their stars, in the order of the line.
    pub ends: [(PlaceNumber, Olp); 2],
    /// The axis from one place's center to the other's.
    pub line: Vec<AxisPoint>,
}

/// A gateway that leads to where the grid shows no more.
#[derive(Clone, PartialEq, Debug)]
pub struct OpenEnd {
    /// The place.
    pub place: PlaceNumber,
    /// The end of its star.
    pub olp: Olp,
    /// What is there: unknown space, or the border of the grid.
    pub tip: Tip,
    /// The axis from the place's center on.
    pub line: Vec<AxisPoint>,
}

/// A candidate that turned out to be a place, or not.
pub(super) struct Resolved {
    pub(super) place: Option<PlaceNumber>,
    pub(super) ways: Vec<Way>,
    /// The end of the star for each way; empty if it is no place.
    pub(super) olps: Vec<Olp>,
}

/// Follows every gateway of every place, across what is no place.
pub(super) fn connect(
    skeleton: &Skeleton,
    sections: &[Section],
    resolved: &[Resolved],
) -> (Vec<PlaceConnection>, Vec<OpenEnd>) {
    let (mut connections, mut open_ends) = (Vec::new(), Vec::new());
    for candidate in resolved {
        let Some(place) = candidate.place else { continue };
        for (&way, &olp) in candidate.ways.iter().zip(&candidate.olps) {
            let (last, line) = follow(way, skeleton, sections, resolved);
            match last.destination(sections) {
                Some(other) => {
                    let back = resolved[other].ways.iter().position(|&way| way == last.reversed());
                    let far = resolved[other].place.zip(back.and_then(|way| resolved[other].olps.get(way)));
                    if let Some((far, &far_olp)) = far
                        && (place, olp) < (far, far_olp)
                    {
                        connections.push(PlaceConnection { ends: [(place, olp), (far, far_olp)], line });
                    }
                }
                None => {
                    let edge = skeleton.edge(sections[last.section].edge);
                    let node = edge.nodes[usize::from(!last.is_backward)];
                    if let Some(tip) = skeleton.node(node).tip {
                        open_ends.push(OpenEnd { place, olp, tip, line });
                    }
                }
            }
        }
    }
    (connections, open_ends)
}

/// The last section of the way to the next place or open tip, and the line there.
fn follow(
    mut way: Way,
    skeleton: &Skeleton,
    sections: &[Section],
    resolved: &[Resolved],
) -> (Way, Vec<AxisPoint>) {
    let mut line = way.points(sections, skeleton);
    for _ in 0..sections.len() {
        let passed = way.destination(sections).map(|candidate| &resolved[candidate]);
        let Some(passed) = passed.filter(|candidate| candidate.place.is_none()) else { break };
        let Some(&onward) = passed.ways.iter().find(|&&onward| onward != way.reversed()) else { break };
        line.extend(onward.points(sections, skeleton).into_iter().skip(1));
        way = onward;
    }
    (way, line)
}
