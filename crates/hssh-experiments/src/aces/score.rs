//! Compares the exploration's odometry and headings with the poses corrected by scan matching.

use std::fmt::Write;

use hssh_causal::Odometry;
use hssh_local::LaserLog;
use hssh_metrics::{Pose, wrap_angle};
use nalgebra::{Matrix3, Vector3};

use super::topology::Topology;
use super::{Stay, turned};

/// How good the odometry is.
pub(super) struct Score {
    /// Travels and visits, line by line.
    pub(super) table: String,
    /// Mean over the travels of eᵀ C⁻¹ e; 3 is expected.
    pub(super) mean_chi_squared: f64,
    /// Mean error of the heading over a travel, radians.
    pub(super) mean_turn: f64,
    /// Root mean square of the headings' errors at the visits, radians.
    pub(super) heading_rms: f64,
    /// The largest of them.
    pub(super) heading_worst: f64,
}

/// Scores the odometry. The truth is the difference of the two places' centres, turned into the
/// building's axes: those of the log's corrected frame turned by the headings' mean difference.
pub(super) fn score(log: &LaserLog, topology: &Topology, stays: &[Stay], odometry: &[Odometry]) -> Score {
    let off: Vec<f64> =
        stays.iter().map(|stay| wrap_angle(log.scans[stay.scan].corrected.theta - stay.heading)).collect();
    let axes = mean(&off);
    let heading_errors: Vec<f64> = off.iter().map(|off| off - axes).collect();
    let crossings = &topology.network.crossings;
    let centre = |stay: &Stay| {
        let position = crossings[stay.place].position;
        turned(-axes).compose(Pose::new(position.x, position.y, 0.0)).translation()
    };

    let mut table = format!("building turned by {:.2}° in the corrected frame\n", axes.to_degrees());
    table += "travel        measured x, y, θ        true x, y        σ x, y, θ            χ²\n";
    let mut chi_squared = Vec::new();
    for (pair, odometry) in stays.windows(2).zip(odometry) {
        let truth = centre(&pair[1]) - centre(&pair[0]);
        let error = Vector3::new(odometry.x - truth.x, odometry.y - truth.y, odometry.theta);
        let covariance = Matrix3::from_fn(|row, column| odometry.covariance[row][column]);
        let inverse = covariance.try_inverse().expect("the covariance was made positive definite");
        chi_squared.push(error.dot(&(inverse * error)));
        let sigma = covariance.diagonal().map(f64::sqrt);
        writeln!(
            table,
            "{:>2} → {:<2} {:>9.2} {:>7.2} {:>7.3} {:>9.2} {:>7.2} {:>9.2} {:>5.2} {:>6.3} {:>8.1}",
            crossings[pair[0].place].name,
            crossings[pair[1].place].name,
            odometry.x,
            odometry.y,
            odometry.theta,
            truth.x,
            truth.y,
            sigma.x,
            sigma.y,
            sigma.z,
            chi_squared[chi_squared.len() - 1],
        )
        .expect("a string takes everything");
    }
    table += "heading errors at the visits:";
    for (stay, error) in stays.iter().zip(&heading_errors) {
        write!(table, " {} {:+.1}°", crossings[stay.place].name, error.to_degrees())
            .expect("a string takes everything");
    }
    let squares: Vec<f64> = heading_errors.iter().map(|error| error * error).collect();
    let turns: Vec<f64> = odometry.iter().map(|odometry| odometry.theta).collect();
    Score {
        table,
        mean_chi_squared: mean(&chi_squared),
        mean_turn: mean(&turns),
        heading_rms: mean(&squares).sqrt(),
        heading_worst: heading_errors.iter().fold(0.0, |worst, error| error.abs().max(worst)),
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}
