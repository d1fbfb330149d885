//! Odometry that drifts: noise that grows with distance and turning (measurements of section 4.1).

use hssh_causal::Odometry;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::geometry::{Point, wrap};
use crate::noise::{DriftError, OdometryNoise};

/// How odometry errs. Errors are random walks, so their variances grow in proportion to the
/// distance driven and to the angle turned; what the robot misjudges at the two places is added.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct DriftModel {
    /// Standard deviation of the distance measured, after one metre: m/√m.
    pub distance: f64,
    /// Standard deviation of the heading, after one metre: rad/√m.
    pub heading: f64,
    /// Standard deviation of the heading, after turning by one radian: rad/√rad.
    pub turn: f64,
    /// Standard deviation, along each axis, of where the robot takes a place's frame to be: m.
    /// Counts at departure and at arrival.
    pub position_fix: f64,
    /// Standard deviation of how the robot takes a place's frame to be turned: rad. Counts at
    /// departure and at arrival.
    pub heading_fix: f64,
}

/// An indoor robot: about 0.2 m and 0.05 rad a corridor of 8 m and a right-angled turn.
impl Default for DriftModel {
    fn default() -> Self {
        DriftModel { distance: 0.05, heading: 0.005, turn: 0.02, position_fix: 0.1, heading_fix: 0.02 }
    }
}

/// One independent cause of error: how x, y and θ move per standard deviation of it.
type Source = [f64; 3];

impl OdometryNoise for DriftModel {
    /// No field may be negative, and both fixes must be positive.
    fn check(&self) -> Result<(), DriftError> {
        let DriftModel { distance, heading, turn, position_fix, heading_fix } = *self;
        for (field, value) in [("distance", distance), ("heading", heading), ("turn", turn)] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(DriftError { field, value, range: "zero or positive" });
            }
        }
        for (field, value) in [("position_fix", position_fix), ("heading_fix", heading_fix)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(DriftError { field, value, range: "positive" });
            }
        }
        Ok(())
    }

    fn measure(&self, turn: f64, way: &[Point], random: &mut ChaCha8Rng) -> Odometry {
        let (start, end) = (way[0], way[way.len() - 1]);
        let mut pose = [end.x - start.x, end.y - start.y, 0.0];
        let mut covariance = [[0.0; 3]; 3];
        for source in self.sources(turn, way) {
            let strength: f64 = StandardNormal.sample(random);
            for row in 0..3 {
                pose[row] += strength * source[row];
                for column in 0..3 {
                    covariance[row][column] += source[row] * source[column];
                }
            }
        }
        Odometry { x: pose[0], y: pose[1], theta: wrap(pose[2]), covariance }
    }
}

impl DriftModel {
    /// The model with every standard deviation so many times as large.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let DriftModel { distance, heading, turn, position_fix, heading_fix } = *self;
        DriftModel {
            distance: factor * distance,
            heading: factor * heading,
            turn: factor * turn,
            position_fix: factor * position_fix,
            heading_fix: factor * heading_fix,
        }
    }

    /// All causes of error, to first order, as they show in the arrival pose.
    fn sources(&self, turn: f64, way: &[Point]) -> Vec<Source> {
        let end = way[way.len() - 1];
        // A heading wrong by `angle` from `pivot` on swings the arrival about the pivot.
        let swing = |angle: f64, pivot: Point| [-angle * (end.y - pivot.y), angle * (end.x - pivot.x), angle];
        let fix = self.position_fix * std::f64::consts::SQRT_2; // at departure and at arrival
        let mut sources = vec![
            [fix, 0.0, 0.0],
            [0.0, fix, 0.0],
            swing(self.heading_fix, way[0]),
            swing(self.heading_fix, end),
            swing(self.turn * turn.sqrt(), way[0]),
        ];
        let mut heading = way[0].bearing_to(way[1]);
        for (from, to) in way.windows(2).map(|piece| (piece[0], piece[1])) {
            let length = from.distance_to(to);
            if length == 0.0 {
                continue;
            }
            let bearing = from.bearing_to(to);
            sources.push(swing(self.turn * wrap(bearing - heading).abs().sqrt(), from));
            heading = bearing;
            let along = self.distance * length.sqrt();
            sources.push([along * bearing.cos(), along * bearing.sin(), 0.0]);
            // The heading drifts all along the piece. Its covariance is the integral of swing · swingᵀ,
            // which is quadratic in the distance driven, so Simpson's rule is exact.
            let middle = Point::new((from.x + to.x) / 2.0, (from.y + to.y) / 2.0);
            for (pivot, weight) in [(from, 1.0), (middle, 4.0), (to, 1.0)] {
                sources.push(swing(self.heading * (length * weight / 6.0_f64).sqrt(), pivot));
            }
        }
        sources
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;

    fn normal(random: &mut ChaCha8Rng, deviation: f64) -> f64 {
        let strength: f64 = StandardNormal.sample(random);
        deviation * strength
    }

    /// Drives the way in steps of a few centimetres, each with its own noise, and returns where
    /// the robot believes to be.
    fn drive(model: &DriftModel, turn: f64, way: &[Point], random: &mut ChaCha8Rng) -> [f64; 3] {
        let mut error = normal(random, model.heading_fix) + normal(random, model.turn * turn.sqrt());
        let (mut x, mut y) = (normal(random, model.position_fix), normal(random, model.position_fix));
        let mut heading = way[0].bearing_to(way[1]);
        for piece in way.windows(2) {
            let bearing = piece[0].bearing_to(piece[1]);
            error += normal(random, model.turn * wrap(bearing - heading).abs().sqrt());
            heading = bearing;
            let steps = 200;
            let step = piece[0].distance_to(piece[1]) / f64::from(steps);
            for _ in 0..steps {
                let advance = step + normal(random, model.distance * step.sqrt());
                error += normal(random, model.heading * step.sqrt());
                x += advance * (heading + error).cos();
                y += advance * (heading + error).sin();
            }
        }
        x += normal(random, model.position_fix);
        y += normal(random, model.position_fix);
        [x, y, error + normal(random, model.heading_fix)]
    }

    #[test]
    fn covariances_are_those_of_a_simulated_drive() {
        let way = [(0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (14.0, 9.0)].map(|(x, y)| Point::new(x, y));
        let model =
            DriftModel { distance: 0.04, heading: 0.008, turn: 0.03, position_fix: 0.1, heading_fix: 0.02 };
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let runs = 4000;
        let errors: Vec<[f64; 3]> = (0..runs)
            .map(|_| {
                let [x, y, theta] = drive(&model, 1.0, &way, &mut random);
                [x - 14.0, y - 9.0, theta]
            })
            .collect();
        let covariance = model.measure(1.0, &way, &mut random).covariance;
        for row in 0..3 {
            for column in 0..3 {
                let moment = errors.iter().map(|e| e[row] * e[column]).sum::<f64>() / f64::from(runs);
                let scale = (covariance[row][row] * covariance[column][column]).sqrt();
                assert!((moment - covariance[row][column]).abs() < 0.06 * scale, "{row} {column}");
            }
        }
    }

    #[test]
    fn measurements_err_as_their_covariance_says() {
        let way = [(0.0, 0.0), (3.0, 4.0), (3.0, 9.0)].map(|(x, y)| Point::new(x, y));
        let mut random = ChaCha8Rng::seed_from_u64(2);
        let runs = 4000;
        let mut moments = [[0.0; 3]; 3];
        let mut covariance = moments;
        for _ in 0..runs {
            let odometry = DriftModel::default().measure(0.5, &way, &mut random);
            odometry.check().unwrap();
            covariance = odometry.covariance;
            let error = [odometry.x - 3.0, odometry.y - 9.0, odometry.theta];
            for row in 0..3 {
                for column in 0..3 {
                    moments[row][column] += error[row] * error[column] / f64::from(runs);
                }
            }
        }
        for row in 0..3 {
            for column in 0..3 {
                let scale = (covariance[row][row] * covariance[column][column]).sqrt();
                assert!((moments[row][column] - covariance[row][column]).abs() < 0.06 * scale);
            }
        }
    }

    #[test]
    fn refuses_what_is_no_model() {
        let wrong = DriftModel { position_fix: 0.0, ..DriftModel::default() };
        assert_eq!(
            wrong.check().unwrap_err().to_string(),
            "the noise model's `position_fix` is 0, it must be positive and finite"
        );
        assert!(DriftModel { turn: f64::NAN, ..DriftModel::default() }.check().is_err());
        assert!(DriftModel { heading: -0.1, ..DriftModel::default() }.check().is_err());
    }
}
