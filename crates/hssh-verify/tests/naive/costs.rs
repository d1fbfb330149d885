//! Costs in nats, with layouts by damped least squares on derivatives by finite differences.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use hssh_causal::{Exploration, NamedStar, StarType};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::map::{Hypothesis, matches, visit_star};

/// How the cost is made up, as the head of a certificate says it.
#[derive(Clone)]
pub(crate) struct Terms {
    pub(crate) metrical: &'static str,
    pub(crate) prior: &'static str,
    pub(crate) appearance: BTreeMap<(usize, usize, usize), f64>,
}

/// What a branch cost so far, and what was measured along it.
#[derive(Clone, Default)]
pub(crate) struct Costs {
    turn: f64,
    measured: Vec<(usize, usize, Vector3<f64>, Matrix3<f64>)>,
    poses: Vec<Vector3<f64>>,
    bend: f64,
    spent: f64,
}

fn wrap(angle: f64) -> f64 {
    angle - TAU * ((angle - PI) / TAU).ceil()
}

fn turned(angle: f64) -> Matrix3<f64> {
    Matrix3::new(angle.cos(), -angle.sin(), 0.0, angle.sin(), angle.cos(), 0.0, 0.0, 0.0, 1.0)
}

fn compose(a: Vector3<f64>, b: Vector3<f64>) -> Vector3<f64> {
    a + turned(a.z) * b
}

fn relative(a: Vector3<f64>, b: Vector3<f64>) -> Vector3<f64> {
    turned(-a.z) * (b - a)
}

fn mean(angles: &[f64]) -> f64 {
    let sum = |f: fn(f64) -> f64| angles.iter().map(|angle| f(*angle)).sum::<f64>();
    sum(f64::sin).atan2(sum(f64::cos))
}

fn bearings(named: &NamedStar) -> Vec<f64> {
    let n = named.bearings.len();
    let spread = |end: usize| -TAU * end as f64 / n as f64;
    let gaps: Vec<f64> = (0..n).filter_map(|end| named.bearings[end].map(|b| b - spread(end))).collect();
    let offset = if gaps.is_empty() { 0.0 } else { mean(&gaps) };
    (0..n).map(|end| named.bearings[end].unwrap_or(spread(end) + offset)).collect()
}

fn named(exploration: &Exploration, visit: usize) -> &NamedStar {
    let star: StarType = exploration.visits().nth(visit).unwrap();
    &exploration.star_types()[star.index()]
}

impl Costs {
    /// All whitened errors.
    fn errors(&self, poses: &DVector<f64>) -> DVector<f64> {
        let pose = |place: usize| match place {
            0 => Vector3::zeros(),
            _ => poses.fixed_rows::<3>(3 * (place - 1)).into_owned(),
        };
        let mut errors = DVector::zeros(3 * self.measured.len());
        for (index, (from, to, tau, covariance)) in self.measured.iter().enumerate() {
            let mut error = relative(pose(*from), pose(*to)) - tau;
            error.z = wrap(error.z);
            let whitened = covariance.cholesky().unwrap().l().solve_lower_triangular(&error).unwrap();
            errors.fixed_rows_mut::<3>(3 * index).copy_from(&whitened);
        }
        errors
    }

    fn derivatives(&self, poses: &DVector<f64>) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(3 * self.measured.len(), poses.len());
        for column in 0..poses.len() {
            let (mut more, mut less) = (poses.clone(), poses.clone());
            more[column] += 1e-5;
            less[column] -= 1e-5;
            matrix.set_column(column, &((self.errors(&more) - self.errors(&less)) / 2e-5));
        }
        matrix
    }

    fn stacked(&self) -> DVector<f64> {
        DVector::from_iterator(
            3 * (self.poses.len() - 1),
            self.poses[1..].iter().flat_map(|p| [p.x, p.y, p.z]),
        )
    }

    fn settle(&mut self) {
        let mut poses = self.stacked();
        let mut least = self.errors(&poses).norm_squared();
        let mut damping = 1e-3;
        for _ in 0..400 {
            let (derivatives, errors) = (self.derivatives(&poses), self.errors(&poses));
            let matrix = derivatives.transpose() * &derivatives;
            let damped = &matrix + DMatrix::from_diagonal(&(matrix.diagonal() * damping));
            let Some(cholesky) = damped.cholesky() else { break };
            let moved = &poses - cholesky.solve(&(derivatives.transpose() * errors));
            let now = self.errors(&moved).norm_squared();
            if now < least {
                let settled = least - now < 1e-14 * (1.0 + least);
                (poses, least, damping) = (moved, now, damping / 5.0);
                if settled {
                    break;
                }
            } else {
                damping *= 4.0;
                if damping > 1e8 {
                    break;
                }
            }
        }
        self.bend = least / 2.0;
        for (place, pose) in self.poses[1..].iter_mut().enumerate() {
            *pose = poses.fixed_rows::<3>(3 * place).into_owned();
        }
    }

    /// ½ ln(|C + H Σ Hᵀ| / |C|) by finite differences.
    fn vagueness(&self, (from, to, tau, covariance): &(usize, usize, Vector3<f64>, Matrix3<f64>)) -> f64 {
        if from == to || self.measured.is_empty() {
            return 0.0;
        }
        let poses = self.stacked();
        let before = self.derivatives(&poses);
        let sigma = (before.transpose() * before).try_inverse().unwrap();
        let one = Costs { measured: vec![(*from, *to, *tau, Matrix3::identity())], ..self.clone() };
        let h = one.derivatives(&poses);
        let more = covariance + (&h * sigma * h.transpose()).fixed_view::<3, 3>(0, 0);
        (0.5 * (more.determinant() / covariance.determinant()).ln()).max(0.0)
    }
}

impl Terms {
    pub(crate) fn new(metrical: &'static str, prior: &'static str) -> Self {
        Terms { metrical, prior, appearance: BTreeMap::new() }
    }

    pub(crate) fn head(&self) -> String {
        let mut text = format!("objective posterior\nmetrical {}\nprior {}\n", self.metrical, self.prior);
        for ((later, earlier, rotation), ratio) in &self.appearance {
            writeln!(text, "appearance {later} {earlier} {rotation} {ratio:?}").unwrap();
        }
        text
    }

    fn numbers(text: &str) -> Vec<f64> {
        text.split(' ').filter_map(|word| word.parse().ok()).collect()
    }

    fn price(&self, exploration: &Exploration, travel: usize) -> f64 {
        if !self.metrical.starts_with("evidence") {
            return 0.0;
        }
        let step = &exploration.travels()[travel];
        let odometry = step.odometry.as_ref().unwrap();
        let covariance = Matrix3::from_fn(|row, column| odometry.covariance[row][column]);
        let peak = -0.5 * (covariance.determinant().ln() + 3.0 * TAU.ln());
        let given = Self::numbers(self.metrical);
        let &[length, spread, deviation, crooked] = given.as_slice() else {
            return peak + (given[0] * TAU).ln();
        };
        let metres =
            odometry.x.hypot(odometry.y).max(((covariance[(0, 0)] + covariance[(1, 1)]) / 2.0).sqrt());
        let normal =
            |x: f64, deviation: f64| (-0.5 * (x / deviation).powi(2)).exp() / ((TAU).sqrt() * deviation);
        // Log-normal in the length, per square metre; so much in each direction.
        let along = normal((metres / length).ln(), spread) / metres;
        let direction = |angle: f64, bearing: Option<f64>| {
            bearing
                .map_or(1.0 / TAU, |b| (1.0 - crooked) * normal(wrap(angle - b), deviation) + crooked / TAU)
        };
        let way = odometry.y.atan2(odometry.x);
        let exit = named(exploration, travel).bearings[step.exit.index()];
        let entry = named(exploration, travel + 1).bearings[step.entry.index()];
        peak - (along / metres * direction(way, exit) * direction(way + PI - odometry.theta, entry)).ln()
    }

    pub(crate) fn step(
        &self,
        exploration: &Exploration,
        parent: &Hypothesis,
        child: &Hypothesis,
        costs: &Costs,
        siblings: usize,
    ) -> Costs {
        let mut next = costs.clone();
        let visit = child.explained;
        let first = child.places[child.place].1;
        if self.prior == "choices" && child.grown {
            next.spent += (siblings as f64).ln();
        }
        let of_visit = self.appearance.iter().filter(|((later, ..), _)| *later == visit);
        next.spent += of_visit.map(|(_, ratio)| *ratio).fold(0.0, f64::max);
        if !child.is_new {
            next.spent -= self.appearance.get(&(visit, first, child.rotation)).copied().unwrap_or(0.0);
        }
        if self.metrical == "ignored" {
            return next;
        }
        if next.poses.is_empty() {
            next.poses.push(Vector3::zeros());
        }
        let (seen, kept) = (bearings(named(exploration, visit)), bearings(named(exploration, first)));
        let gaps: Vec<f64> =
            (0..seen.len()).map(|end| kept[(end + child.rotation) % kept.len()] - seen[end]).collect();
        next.turn = mean(&gaps);
        let odometry = exploration.travels()[visit - 1].odometry.as_ref().unwrap();
        let covariance = Matrix3::from_fn(|row, column| odometry.covariance[row][column]);
        let covariance = turned(costs.turn) * covariance * turned(costs.turn).transpose();
        let measured = Vector3::new(odometry.x, odometry.y, odometry.theta);
        let departure = compose(Vector3::new(0.0, 0.0, costs.turn), measured);
        let tau = compose(departure, Vector3::new(0.0, 0.0, -next.turn));
        let travel = (parent.place, child.place, tau, covariance);
        if child.is_new {
            next.poses.push(compose(next.poses[parent.place], tau));
            next.spent += self.price(exploration, visit - 1);
        } else if self.metrical.starts_with("evidence") {
            next.spent += costs.vagueness(&travel);
        }
        next.measured.push(travel);
        next.settle();
        next
    }

    pub(crate) fn total(&self, node: &Hypothesis, costs: &Costs) -> f64 {
        let complexity = match Self::numbers(self.prior).as_slice() {
            [c1, c2, c3] => {
                let is_long =
                    |path: &super::map::Path| path.passages.iter().any(|end| end.0 != path.passages[0].0);
                let long = node.paths().iter().filter(|path| is_long(path)).count();
                (c1 * node.f1() as f64 + c2 * long as f64 + c3 * node.places.len() as f64).ln()
            }
            _ => 0.0,
        };
        costs.bend + costs.spent + complexity
    }

    /// No map below the node costs less: its bend and what it spent, and no more for what is to come than prices below 0.
    pub(crate) fn bound(&self, exploration: &Exploration, node: &Hypothesis, costs: &Costs) -> f64 {
        let ahead = node.explained..exploration.travels().len();
        let discount: f64 = ahead.map(|travel| self.price(exploration, travel).min(0.0)).sum();
        let complexity = match Self::numbers(self.prior).as_slice() {
            [_, _, c3] => (c3 * node.places.len() as f64).ln(),
            _ => 0.0,
        };
        costs.bend + costs.spent + discount + complexity
    }

    /// The logarithm of how many maps can come of a node.
    pub(crate) fn branches(&self, exploration: &Exploration, node: &Hypothesis) -> f64 {
        if self.prior == "choices" {
            return 0.0;
        }
        let mut pending = node.pending().len();
        let mut sum = 0.0;
        for travel in node.explained..exploration.travels().len() {
            let arrival = visit_star(exploration, travel + 1);
            let entry = exploration.travels()[travel].entry.index();
            let mut alike = 0;
            for visit in 0..=travel {
                let star = visit_star(exploration, visit);
                let n = star.ends().len();
                let fits = |end: usize| matches(arrival, star, (end + n * arrival.ends().len() - entry) % n);
                alike += star.gateways().filter(|end| fits(end.index())).count();
            }
            sum += (1.0 + alike.min(pending.max(1) - 1) as f64).ln();
            pending += arrival.gateways().count().max(2) - 2;
        }
        sum
    }
}
