//! The travels of a hypothesis as the edges of its pose graph, carried along from node to node of a tree.

use std::collections::BTreeMap;

use hssh_metrics::{Edge, Information, Pose, PoseGraph, PoseId, wrap_angle};
use nalgebra::{Vector3, vector};

use crate::frames::Trail;
use crate::measured::{Measured, PlacedTravel};

/// Travels between two places are one edge as long as their measured turns differ by no more than this, so that all of them mean the same
/// turn and none the one the other way round: rad.
const SAME_TURN: f64 = 0.5;

/// Travels from one place to another as one measurement: the sum of their informations, and the mean that it weighs.
#[derive(Clone, Copy, Debug)]
struct Leg {
    from: PoseId,
    to: PoseId,
    mean: Pose,
    /// Along the axes of `from`.
    information: Information,
}

/// What a travel changed.
#[derive(Clone, Copy, Debug)]
enum Change {
    /// It led from a place to itself.
    Loop,
    /// It is a leg of its own. Before it, that one was the leg between the two places.
    Own(Option<usize>),
    /// It was added to that leg, which was so before.
    Added(usize, Leg),
}

/// The first travels of a hypothesis, in as few legs as lead from one place to another. χ² of the legs at any layout is that of the travels but for
/// a constant.
#[derive(Clone, Debug, Default)]
pub(crate) struct Legs {
    legs: Vec<Leg>,
    /// By ends: the leg that was begun last.
    between: BTreeMap<(PoseId, PoseId), usize>,
    /// By travel: what it changed, and the constant before it.
    changes: Vec<(Change, f64)>,
    /// What no layout changes: χ² of travels from a place to itself, and of travels on one leg against their mean.
    constant: f64,
}

impl Legs {
    /// Adds the travels of a hypothesis that are not there yet. Those that are there are its first ones.
    pub(crate) fn follow(&mut self, trail: Trail<'_>, measured: &Measured) {
        for travel in self.changes.len()..trail.visits() - 1 {
            let constant = self.constant;
            let change = self.add(&measured.placed(trail, travel));
            self.changes.push((change, constant));
        }
    }

    fn add(&mut self, travel: &PlacedTravel) -> Change {
        if travel.from == travel.to {
            self.constant += travel.chi2_as_loop();
            return Change::Loop;
        }
        let ends = (travel.from, travel.to);
        let known = self.between.get(&ends).copied();
        let longer = known.and_then(|leg| Some((leg, self.legs[leg].with(travel)?)));
        if let Some((leg, (longer, off))) = longer {
            self.constant += off;
            return Change::Added(leg, std::mem::replace(&mut self.legs[leg], longer));
        }
        let information = travel.covariance.information();
        self.between.insert(ends, self.legs.len());
        self.legs.push(Leg { from: travel.from, to: travel.to, mean: travel.pose, information });
        Change::Own(known)
    }

    /// Takes back all travels but the first ones.
    pub(crate) fn keep(&mut self, travels: usize) {
        while self.changes.len() > travels
            && let Some((change, constant)) = self.changes.pop()
        {
            self.constant = constant;
            match change {
                Change::Loop => {}
                Change::Added(leg, before) => self.legs[leg] = before,
                Change::Own(before) => {
                    if let Some(Leg { from, to, .. }) = self.legs.pop() {
                        match before {
                            Some(before) => self.between.insert((from, to), before),
                            None => self.between.remove(&(from, to)),
                        };
                    }
                }
            }
        }
    }

    /// What no layout changes of χ².
    pub(crate) fn constant(&self) -> f64 {
        self.constant
    }

    /// The pose graph of the hypothesis (section 4.2): one pose per place, the first one anchored.
    pub(crate) fn graph(&self, poses: impl Iterator<Item = Pose>) -> PoseGraph {
        let mut graph = PoseGraph::new();
        for pose in poses {
            graph.add_pose(pose);
        }
        for &Leg { from, to, mean, information } in &self.legs {
            let edge = Edge { from, to, relative_pose: mean, information: information.rotated(-mean.theta) };
            graph.add_edge(edge).expect("a hypothesis has its places, and odometry is finite");
        }
        graph.anchor(PoseId(0)).expect("every hypothesis has its first place");
        graph
    }
}

impl Leg {
    /// The same with one travel more, and what that adds to χ² whatever the layout; `None` if the travel turns otherwise, or if double
    /// precision does not bear the sum.
    ///
    /// For two measurements a and b of x with informations A and B,
    /// (x − a)ᵀA(x − a) + (x − b)ᵀB(x − b) = (x − m)ᵀ(A + B)(x − m) + (b − a)ᵀB(b − m), where m = a + (A + B)⁻¹B(b − a).
    fn with(&self, travel: &PlacedTravel) -> Option<(Leg, f64)> {
        let Pose { x, y, theta } = travel.pose;
        let off: Vector3<f64> =
            vector![x - self.mean.x, y - self.mean.y, wrap_angle(theta - self.mean.theta)];
        if off.z.abs() > SAME_TURN {
            return None;
        }
        let added = travel.covariance.information();
        let information = Information::new(self.information.matrix() + added.matrix()).ok()?;
        let weighted = added.matrix() * off;
        let moved = information.covariance()?.matrix() * weighted;
        let Pose { x, y, theta } = self.mean;
        let mean = Pose::new(x + moved.x, y + moved.y, theta + moved.z);
        Some((Leg { mean, information, ..*self }, weighted.dot(&(off - moved)).max(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use hssh_metrics::Covariance;
    use nalgebra::{Matrix3, matrix};

    use super::*;

    /// Six travels there and back between two places, one of them turned round, and one from a place to itself.
    fn travels() -> Vec<PlacedTravel> {
        (0..8)
            .map(|index| {
                let at = f64::from(index);
                let root: Matrix3<f64> =
                    matrix![0.1 + 0.02 * at, 0.0, 0.0; 0.03, 0.2, 0.0; 0.01, 0.02 * at, 0.1];
                let (from, to) = [(0, 1), (1, 0), (0, 1), (0, 0)][index as usize % 4];
                let turn = if index == 6 { 3.0 } else { 3.1 + 0.05 * at };
                PlacedTravel {
                    from: PoseId(from),
                    to: PoseId(to),
                    pose: Pose::new(8.0 + 0.1 * at.sin(), 0.2 * at.cos(), turn),
                    covariance: Covariance::new(root * root.transpose()).unwrap(),
                }
            })
            .collect()
    }

    /// χ² as the travels tell it, at any layout.
    #[test]
    fn legs_are_worth_what_their_travels_are() {
        let mut legs = Legs::default();
        let poses = |at: f64| [Pose::IDENTITY, Pose::new(7.9 + 0.2 * at, 0.3 * at, 3.0 + 0.2 * at)];
        let mut sums = Vec::new();
        for (index, travel) in travels().into_iter().enumerate() {
            let constant = legs.constant;
            let change = legs.add(&travel);
            legs.changes.push((change, constant));
            for at in [-1.0, 0.0, 0.5, 2.0] {
                let chi2 = |travel: &PlacedTravel| {
                    if travel.from == travel.to {
                        return travel.chi2_as_loop();
                    }
                    let [from, to] = [travel.from, travel.to].map(|place| poses(at)[place.index()]);
                    travel.edge().chi2(from, to)
                };
                let expected: f64 = travels()[..=index].iter().map(chi2).sum();
                let chi2 = legs.constant() + legs.graph(poses(at).into_iter()).chi2();
                assert!((chi2 - expected).abs() < 1e-9 * expected, "{chi2}, not {expected}");
            }
            sums.push((legs.legs.len(), legs.constant()));
        }
        assert_eq!(sums[7].0, 2, "{sums:?}");
        for travels in (1..=8).rev() {
            legs.keep(travels);
            assert_eq!((legs.legs.len(), legs.constant()), sums[travels - 1]);
        }
        legs.keep(0);
        assert!(legs.legs.is_empty() && legs.between.is_empty());
    }

    /// Of travels that turn one way and the other, half a turn lies between.
    #[test]
    fn other_turns_are_other_legs() {
        let mut legs = Legs::default();
        for turn in [0.0, 3.0, 0.1] {
            let covariance = Covariance::from_standard_deviations(0.1, 0.1, 0.1).unwrap();
            let (from, to) = (PoseId(0), PoseId(1));
            let travel = PlacedTravel { from, to, pose: Pose::new(5.0, 0.0, turn), covariance };
            let change = legs.add(&travel);
            legs.changes.push((change, 0.0));
        }
        assert_eq!(legs.legs.len(), 3);
        legs.keep(2);
        assert_eq!(legs.between[&(PoseId(0), PoseId(1))], 1);
    }
}
