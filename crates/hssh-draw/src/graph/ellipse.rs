//! Ellipses of equal probability of a Gaussian in the plane.

use std::f64::consts::TAU;

use nalgebra::{Matrix2, Vector2, vector};

/// χ² of two degrees of freedom that is exceeded with a probability of 5 %: −2 ln 0.05.
const CHI2_95: f64 = 5.991_464_547_107_982;

/// How many corners stand for the curve.
const CORNERS: u32 = 32;

/// Points around the mean on the ellipse that holds 95 % of the probability; `None` if the matrix is no covariance.
pub(crate) fn ellipse_95(covariance: &Matrix2<f64>) -> Option<Vec<Vector2<f64>>> {
    let (variance, spread) = (covariance[(0, 0)], covariance[(1, 1)]);
    let negligible = f64::EPSILON * variance.abs().max(spread.abs()).max(f64::MIN_POSITIVE);
    let root = (covariance + Matrix2::identity() * negligible).cholesky()?.l() * CHI2_95.sqrt();
    let corner = |index: u32| {
        let angle = TAU * f64::from(index) / f64::from(CORNERS);
        root * vector![angle.cos(), angle.sin()]
    };
    Some((0..CORNERS).map(corner).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::matrix;

    /// By hand: standard deviations of 2 and 1 along the axes, times √5.99.
    #[test]
    fn independent_axes_give_their_own_half_axes() {
        let corners = ellipse_95(&matrix![4.0, 0.0; 0.0, 1.0]).unwrap();
        let reach = |axis: usize| corners.iter().map(|corner| corner[axis]).fold(0.0, f64::max);
        assert!((reach(0) - 4.8955).abs() < 1e-4 && (reach(1) - 2.4477).abs() < 1e-4);
    }

    #[test]
    fn every_corner_is_equally_probable() {
        let covariance = matrix![3.0, -1.2; -1.2, 0.7];
        let inverse = covariance.try_inverse().unwrap();
        for corner in ellipse_95(&covariance).unwrap() {
            let chi2 = corner.dot(&(inverse * corner));
            assert!((chi2 - CHI2_95).abs() < 1e-9, "{chi2}");
        }
    }

    #[test]
    fn nothing_is_drawn_of_what_is_no_covariance() {
        assert!(ellipse_95(&matrix![-1.0, 0.0; 0.0, 1.0]).is_none());
        assert!(ellipse_95(&matrix![f64::NAN, 0.0; 0.0, 1.0]).is_none());
        assert!(ellipse_95(&Matrix2::zeros()).is_some(), "a known position is a point");
    }
}
