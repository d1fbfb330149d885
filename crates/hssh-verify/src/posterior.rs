//! The cost of maps in nats, and what no map below an open hypothesis falls below.
//!
//! Cost = bend + vagueness + places + choices + complexity + appearance. All but the complexity is carried along the branch;
//! a node's layout is solved from its parent's and from odometry alone.

use std::cell::OnceCell;

use crate::frames::{filled_bearings, new_place_prices, turn};
use crate::header::{Metrical, Prior, Rules};
use crate::layout::{Curvature, Factor, Layout, bend, curvature, lowest, vagueness};
use crate::outlook::Outlook;
use crate::pose::{Pose, rotation};
use crate::route::Route;
use crate::step::{Choice, Position, Stepper};

/// How far two costs may be apart and count as equal, relative to `1 + |cost|`.
pub(crate) const TOLERANCE: f64 = 1e-6;

/// Room for error around a cost.
pub(crate) fn slack(cost: f64) -> f64 {
    TOLERANCE * (1.0 + cost.abs())
}

/// How much farther apart two costs may be of something that is worse than the best, relative to by how much it is. Layouts that are
/// bent out of all measure are found less exactly, and nothing depends on by how much a hopeless map is worse.
const LEEWAY: f64 = 1e-5;

/// Room for error around the cost of a map, or a bound, claimed to be worse than the best.
pub(crate) fn leeway(cost: f64, best: f64) -> f64 {
    slack(cost) + LEEWAY * (cost - best).max(0.0)
}

/// A node on the branch that is walked.
struct Node {
    at: Position,
    /// The visit's frame in the place's.
    turn: f64,
    /// The best layout found.
    layout: Layout,
    /// Each place where the travel that found it leads.
    by_odometry: Vec<Pose>,
    curvature: OnceCell<Option<Curvature>>,
    vagueness: f64,
    places: f64,
    choices: f64,
    appearance: f64,
}

/// The costs along a branch.
pub(crate) struct Posterior<'a> {
    route: &'a Route,
    rules: &'a Rules,
    /// The bearings of all ends by star type.
    bearings: Vec<Vec<f64>>,
    /// By travel: what a new place costs there.
    prices: Vec<f64>,
    /// By visit: the greatest ratio with any earlier one, at least 0.
    most_alike: Vec<f64>,
    /// By travel: how many gateways of earlier visits its entry could be.
    alike: Vec<usize>,
    outlook: Outlook,
    branch: Vec<Node>,
    factors: Vec<Factor>,
    /// How many layouts were solved.
    pub(crate) solved: u64,
}

impl<'a> Posterior<'a> {
    /// The root's costs, and everything that does not depend on the hypothesis.
    pub(crate) fn new(route: &'a Route, rules: &'a Rules) -> Self {
        let bearings: Vec<Vec<f64>> = route.shapes.iter().map(filled_bearings).collect();
        let measured = rules.metrical != Metrical::Ignored;
        let mut most_alike = vec![0.0_f64; route.visits.len()];
        for (&(later, ..), &ratio) in &rules.appearance {
            most_alike[later] = most_alike[later].max(ratio);
        }
        let root = Node {
            at: Position { place: 0, rotation: 0 },
            turn: 0.0,
            layout: Layout { poses: vec![Pose::ORIGIN], bend: 0.0 },
            by_odometry: vec![Pose::ORIGIN],
            curvature: OnceCell::new(),
            vagueness: 0.0,
            places: 0.0,
            choices: 0.0,
            appearance: 0.0,
        };
        Posterior {
            outlook: Outlook::new(route, &bearings, measured),
            prices: match rules.metrical {
                Metrical::Evidence(prior) => new_place_prices(route, prior),
                _ => vec![0.0; route.travels()],
            },
            alike: (0..route.travels()).map(|travel| alike(route, travel)).collect(),
            route,
            rules,
            bearings,
            most_alike,
            branch: vec![root],
            factors: Vec::new(),
            solved: 0,
        }
    }

    /// How many promises of the outlook were lowered to what their loops bend by.
    pub(crate) fn lowered_promises(&self) -> usize {
        self.outlook.lowered
    }

    /// Goes to a successor, one of `siblings`. The map has grown already.
    pub(crate) fn enter(&mut self, stepper: &Stepper<'_>, choice: Choice, to: Position, siblings: usize) {
        let travel = self.branch.len() - 1;
        let is_new = matches!(choice, Choice::New { .. });
        let parent = &self.branch[travel];
        let place = stepper.map.places[to.place];
        let turn =
            turn(&self.bearings[self.route.visits[travel + 1]], &self.bearings[place.shape], to.rotation);
        let mut node = Node {
            at: to,
            turn,
            layout: Layout { poses: Vec::new(), bend: parent.layout.bend },
            by_odometry: Vec::new(),
            curvature: OnceCell::new(),
            vagueness: parent.vagueness,
            places: parent.places + if is_new { self.prices[travel] } else { 0.0 },
            choices: parent.choices,
            appearance: parent.appearance + self.appearance(travel + 1, (!is_new).then_some(place.visit), to),
        };
        if self.rules.prior == Prior::Choices && choice.is_growth() {
            node.choices += (siblings as f64).ln();
        }
        if self.rules.metrical != Metrical::Ignored {
            self.factors.push(self.factor(travel, parent, &node));
            self.lay_out(&mut node, is_new);
        }
        self.branch.push(node);
    }

    /// Goes back to the parent.
    pub(crate) fn leave(&mut self) {
        self.branch.pop();
        self.factors.truncate(self.branch.len().saturating_sub(1));
    }

    fn factor(&self, travel: usize, parent: &Node, node: &Node) -> Factor {
        let motion = self.route.legs[travel].motion.as_ref();
        let motion = motion.expect("odometry is only made use of if every travel has it");
        let turned = rotation(parent.turn);
        let covariance = turned * motion.covariance * turned.transpose();
        let departure = Pose::new(0.0, 0.0, parent.turn);
        let arrival = Pose::new(0.0, 0.0, -node.turn);
        Factor {
            from: parent.at.place,
            to: node.at.place,
            tau: departure.compose(motion.pose).compose(arrival),
            covariance,
            information: covariance.try_inverse().expect("a covariance is positive definite"),
        }
    }

    /// Lays out the map with its last travel; that travel bends nothing if it leads to a new place.
    fn lay_out(&mut self, node: &mut Node, is_new: bool) {
        let travel = self.branch.len() - 1;
        let parent = &self.branch[travel];
        let factor = &self.factors[travel];
        let mut poses = parent.layout.poses.clone();
        node.by_odometry.clone_from(&parent.by_odometry);
        if is_new {
            poses.push(poses[factor.from].compose(factor.tau));
            node.by_odometry.push(node.by_odometry[factor.from].compose(factor.tau));
            node.layout.poses = poses;
            return;
        }
        if matches!(self.rules.metrical, Metrical::Evidence(_)) {
            let before = &self.factors[..travel];
            let curvature = parent.curvature.get_or_init(|| curvature(&parent.layout.poses, before));
            node.vagueness += vagueness(&parent.layout.poses, curvature.as_ref(), factor);
        }
        if factor.from == factor.to {
            node.layout.bend = bend(&poses, &self.factors);
            node.layout.poses = poses;
        } else {
            node.layout = lowest(vec![poses, node.by_odometry.clone()], &self.factors, parent.layout.bend);
            self.solved += 1;
        }
    }

    fn appearance(&self, visit: usize, taken_for: Option<usize>, to: Position) -> f64 {
        let ratio = |first| self.rules.appearance.get(&(visit, first, to.rotation)).copied().unwrap_or(0.0);
        self.most_alike[visit] - taken_for.map_or(0.0, ratio)
    }

    fn node(&self) -> &Node {
        self.branch.last().expect("the root is not left before the walk ends")
    }

    /// Everything that the branch cost so far, without bend and complexity.
    fn spent(&self) -> f64 {
        let node = self.node();
        node.vagueness + node.places + node.choices + node.appearance
    }

    /// The cost of the map of a node that explains everything.
    pub(crate) fn cost(&self, stepper: &mut Stepper<'_>) -> f64 {
        let complexity = match self.rules.prior {
            Prior::Simplicity { c1, c2, c3 } => simplicity(stepper, [c1, c2, c3], 0).ln(),
            _ => 0.0,
        };
        self.node().layout.bend + self.spent() + complexity
    }

    /// What no map below the node costs less than.
    pub(crate) fn bound(&mut self, stepper: &mut Stepper<'_>) -> f64 {
        let explained = self.branch.len() - 1;
        let ahead = &self.prices[explained..];
        let discount: f64 = ahead.iter().map(|price| price.min(0.0)).sum();
        // By number of new places: what they cost at least.
        let mut cheapest: Vec<f64> = ahead.iter().map(|price| price.max(0.0)).collect();
        cheapest.sort_by(f64::total_cmp);
        let paid = |new: usize| cheapest[..new].iter().sum::<f64>();
        let simple = match self.rules.prior {
            Prior::Simplicity { c1, c2, c3 } => {
                Some((simplicity(stepper, [c1, c2, c3], self.route.travels() - explained), c3))
            }
            _ => None,
        };
        let spent = self.spent();
        let bent = self.node().layout.bend;
        let intervals: Vec<(usize, f64, f64)> = self.outlook.intervals().collect();
        let future =
            intervals.into_iter().filter(|(.., threshold)| *threshold >= bent).map(|(k, before, _)| {
                let new = self.outlook.new_places(k, explained);
                let complexity = simple.map_or(0.0, |(least, c3)| (least + c3 * new as f64).ln());
                before.max(bent) + paid(new) + complexity
            });
        spent + discount + future.fold(f64::INFINITY, f64::min)
    }

    /// The logarithm of how many maps can come of the node, at most.
    pub(crate) fn branches(&self, pending: usize) -> f64 {
        if self.rules.prior == Prior::Choices {
            return 0.0;
        }
        let mut pending = pending;
        let mut sum = 0.0;
        for travel in self.branch.len() - 1..self.route.travels() {
            sum += (1.0 + self.alike[travel].min(pending.saturating_sub(1)) as f64).ln();
            pending += self.route.shape(travel + 1).gateways().saturating_sub(2);
        }
        sum
    }
}

/// F of a map, or what F does not fall below within so many travels more.
fn simplicity(stepper: &mut Stepper<'_>, [c1, c2, c3]: [f64; 3], travels: usize) -> f64 {
    let (map, paths) = (&stepper.map, &mut stepper.paths);
    paths.trace(map);
    let mut undetermined = 0;
    if c1 > 0.0 {
        paths.find_sides(map);
        undetermined = if travels == 0 { paths.undetermined() } else { paths.undetermined_for_good() };
    }
    let long = if travels == 0 { paths.long_count() } else { paths.long_bound(travels) };
    c1 * undetermined as f64 + c2 * long as f64 + c3 * map.places.len() as f64
}

/// How many gateways of the visits before its arrival the entry of a travel could be, by their stars.
fn alike(route: &Route, travel: usize) -> usize {
    let (arrival, entry) = (route.visits[travel + 1], route.legs[travel].entry);
    let of = |visit: usize| {
        let kind = route.visits[visit];
        let open = &route.shapes[kind].open;
        let fits = |end: usize| open[end] && route.anchored(arrival, entry, kind, end).is_some();
        (0..open.len()).filter(|&end| fits(end)).count()
    };
    (0..=travel).map(of).sum()
}
