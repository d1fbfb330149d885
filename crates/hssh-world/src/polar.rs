//! The noise of the thesis's experiments (section 4.7.1): independent errors of distance, bearing and rotation.

use hssh_causal::Odometry;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::geometry::{Point, wrap};
use crate::noise::{DriftError, OdometryNoise};

/// Gaussian errors of a travel's polar coordinates, each independent of the others and of every other travel, those
/// along the same corridor included.
///
/// The true relative pose of a travel is ⟨distance, bearing, rotation⟩: how far the arrival is, in which direction
/// from the departure, and how its frame is turned. The measurement τ° is the disturbed triple brought back to (x, y,
/// θ), and its covariance C° the triple's, by the derivative of the way back *at the measured values*, for a robot
/// knows no others.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PolarNoise {
    /// Standard deviation of the distance: m a travel, however long.
    pub distance: f64,
    /// Standard deviation of the distance in parts of the distance; both add up as variances do.
    pub distance_share: f64,
    /// Standard deviation of the bearing: rad.
    pub bearing: f64,
    /// Standard deviation of the rotation: rad.
    pub rotation: f64,
}

/// 0.3 m and 0.03 rad a travel.
impl Default for PolarNoise {
    fn default() -> Self {
        PolarNoise { distance: 0.3, distance_share: 0.0, bearing: 0.03, rotation: 0.03 }
    }
}

impl PolarNoise {
    fn distance_deviation(&self, distance: f64) -> f64 {
        self.distance.hypot(self.distance_share * distance)
    }

    /// J diag(σ²) Jᵀ, J being the derivative of (d cos β, d sin β, ρ) by (d, β, ρ).
    fn covariance(&self, distance: f64, bearing: f64) -> [[f64; 3]; 3] {
        let along = self.distance_deviation(distance);
        // A travel that seems to lead nowhere has no bearing to linearize at. Where an error of the distance could
        // undo the travel, that error stands in for the lever arm and keeps C° positive definite.
        let across = distance.abs().max(along) * self.bearing;
        let (sine, cosine) = bearing.sin_cos();
        let columns = [[cosine * along, sine * along], [-sine * across, cosine * across]];
        let position = |row: usize, column: usize| -> f64 {
            columns.iter().map(|direction| direction[row] * direction[column]).sum()
        };
        [
            [position(0, 0), position(0, 1), 0.0],
            [position(1, 0), position(1, 1), 0.0],
            [0.0, 0.0, self.rotation * self.rotation],
        ]
    }
}

impl OdometryNoise for PolarNoise {
    fn check(&self) -> Result<(), DriftError> {
        let PolarNoise { distance, distance_share, bearing, rotation } = *self;
        for (field, value) in [("distance", distance), ("bearing", bearing), ("rotation", rotation)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(DriftError { field, value, range: "positive" });
            }
        }
        if distance_share >= 0.0 && distance_share.is_finite() {
            Ok(())
        } else {
            Err(DriftError { field: "distance_share", value: distance_share, range: "zero or positive" })
        }
    }

    fn measure(&self, _turn: f64, way: &[Point], random: &mut ChaCha8Rng) -> Odometry {
        let (start, end) = (way[0], way[way.len() - 1]);
        let true_distance = start.distance_to(end);
        let mut error = |deviation: f64| -> f64 {
            let strength: f64 = StandardNormal.sample(random);
            deviation * strength
        };
        let distance = true_distance + error(self.distance_deviation(true_distance));
        let bearing = start.bearing_to(end) + error(self.bearing);
        let rotation = error(self.rotation); // all frames are aligned: the true one is 0
        Odometry {
            x: distance * bearing.cos(),
            y: distance * bearing.sin(),
            theta: wrap(rotation),
            covariance: self.covariance(distance, bearing),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix3, Vector3};
    use rand::SeedableRng;

    const SAMPLES: u32 = 20_000;

    fn matrix(rows: [[f64; 3]; 3]) -> Matrix3<f64> {
        Matrix3::from_fn(|row, column| rows[row][column])
    }

    fn way(length: f64, bearing: f64) -> [Point; 3] {
        let from = Point::new(3.0, -2.0);
        let end = Point::new(from.x + length * bearing.cos(), from.y + length * bearing.sin());
        [from, Point::new(9.0, 9.0), end] // the way bends, but only its ends count
    }

    /// Errors (x, y, θ) and the covariances that came with them.
    fn samples(noise: &PolarNoise, length: f64, bearing: f64) -> Vec<(Vector3<f64>, Matrix3<f64>)> {
        let mut random = ChaCha8Rng::seed_from_u64(11);
        let way = way(length, bearing);
        let sample = |_| {
            let measured = noise.measure(0.7, &way, &mut random);
            measured.check().unwrap();
            let truth = Vector3::new(way[2].x - way[0].x, way[2].y - way[0].y, 0.0);
            (Vector3::new(measured.x, measured.y, measured.theta) - truth, matrix(measured.covariance))
        };
        (0..SAMPLES).map(sample).collect()
    }

    /// The way back from polar coordinates, differentiated numerically.
    #[test]
    fn the_covariance_is_linearized_at_the_measured_values() {
        let noise = PolarNoise { distance: 0.2, distance_share: 0.05, bearing: 0.04, rotation: 0.02 };
        let back =
            |polar: Vector3<f64>| Vector3::new(polar.x * polar.y.cos(), polar.x * polar.y.sin(), polar.z);
        for (distance, bearing) in [(8.0, 0.3), (2.0, -3.1), (-1.5, 1.2), (30.0, 3.1)] {
            let at = Vector3::new(distance, bearing, 0.1);
            let step = 1e-6;
            let jacobian = Matrix3::from_columns(&[0, 1, 2].map(|axis| {
                let mut offset = Vector3::zeros();
                offset[axis] = step;
                (back(at + offset) - back(at - offset)) / (2.0 * step)
            }));
            let sigma = Vector3::new(0.2f64.hypot(0.05 * distance), 0.04, 0.02);
            let expected =
                jacobian * Matrix3::from_diagonal(&sigma.component_mul(&sigma)) * jacobian.transpose();
            let difference = (matrix(noise.covariance(distance, bearing)) - expected).amax();
            assert!(difference < 1e-8 * expected.amax(), "{difference}");
        }
    }

    #[test]
    fn samples_spread_as_the_covariance_says_to_first_order() {
        let noise = PolarNoise { distance: 0.1, distance_share: 0.02, bearing: 0.02, rotation: 0.03 };
        for (length, bearing) in [(8.0, 0.0), (8.0, 2.2), (3.0, -1.1), (20.0, -3.0)] {
            let samples = samples(&noise, length, bearing);
            let spread = samples.iter().map(|(error, _)| error * error.transpose()).sum::<Matrix3<f64>>()
                / f64::from(SAMPLES);
            let expected = matrix(noise.covariance(length, bearing));
            for row in 0..3 {
                for column in 0..3 {
                    let scale = (expected[(row, row)] * expected[(column, column)]).sqrt();
                    let difference = (spread[(row, column)] - expected[(row, column)]).abs();
                    assert!(difference < 0.04 * scale, "{row} {column}: {spread}{expected}");
                }
            }
        }
    }

    /// eᵀ C°⁻¹ e is χ² with three degrees of freedom: mean 3, variance 6.
    #[test]
    fn errors_weigh_three_a_travel() {
        for (length, bearing) in [(8.0, 0.4), (12.0, -2.0)] {
            let samples = samples(&PolarNoise::default(), length, bearing);
            let weigh = |(error, covariance): &(Vector3<f64>, Matrix3<f64>)| {
                error.dot(&(covariance.try_inverse().unwrap() * error))
            };
            let weights: Vec<f64> = samples.iter().map(weigh).collect();
            let mean = weights.iter().sum::<f64>() / f64::from(SAMPLES);
            let variance =
                weights.iter().map(|weight| (weight - mean).powi(2)).sum::<f64>() / f64::from(SAMPLES);
            assert!((mean - 3.0).abs() < 0.06, "{mean}");
            assert!((variance - 6.0).abs() < 0.5, "{variance}");
        }
    }

    /// A travel that comes back to where it started has no bearing, but a covariance all the same.
    #[test]
    fn a_travel_that_leads_nowhere_has_a_covariance() {
        assert!(
            samples(&PolarNoise::default(), 0.0, 0.0)
                .iter()
                .all(|(_, covariance)| covariance.cholesky().is_some())
        );
    }

    #[test]
    fn travels_err_independently_on_the_same_corridor_too() {
        let world = crate::grid(1, 2, 8.0).unwrap();
        let there_and_back = [crate::PlaceId(0), crate::PlaceId(1)].into_iter().cycle().take(8001);
        let route = world.route_through(&there_and_back.collect::<Vec<_>>()).unwrap();
        let noise = PolarNoise::default();
        let exploration = world.explore_with_odometry(&route, &noise, 5).unwrap();
        let rotations: Vec<f64> = exploration
            .travels()
            .iter()
            .filter_map(|travel| travel.odometry.as_ref())
            .map(|o| o.theta)
            .collect();
        let correlation = |lag: usize| {
            let products = rotations.windows(lag + 1).map(|window| window[0] * window[lag]);
            products.sum::<f64>() / rotations.len() as f64 / noise.rotation.powi(2)
        };
        assert!((correlation(0) - 1.0).abs() < 0.06);
        assert!((1..4).all(|lag| correlation(lag).abs() < 0.04));
        assert_eq!(world.explore_with_odometry(&route, &noise, 5), Ok(exploration), "the seed decides");
    }

    #[test]
    fn refuses_what_is_no_noise() {
        let error = |noise: PolarNoise| noise.check().unwrap_err().to_string();
        assert_eq!(
            error(PolarNoise { bearing: 0.0, ..PolarNoise::default() }),
            "the noise model's `bearing` is 0, it must be positive and finite"
        );
        assert!(error(PolarNoise { distance: f64::NAN, ..PolarNoise::default() }).contains("`distance`"));
        assert!(
            error(PolarNoise { distance_share: -0.1, ..PolarNoise::default() }).contains("zero or positive")
        );
        assert!(PolarNoise::default().check().is_ok());
    }
}
