//! Covariance and information matrices that cannot be wrong, and how they travel between frames (section 4.2).

use nalgebra::{Cholesky, Matrix3, SymmetricEigen, U3};

use crate::pose::{Pose, frame_rotation};

/// The largest condition number accepted: beyond it, neither inversion nor rotation keeps the matrix
/// positive definite in double precision.
const WORST_CONDITION: f64 = 1e14;

/// How far a matrix may be from symmetric, relative to its entries: text files round.
const SYMMETRY_TOLERANCE: f64 = 1e-9;

/// The covariance of a pose's (x, y, θ): finite, symmetric, positive definite; m², m·rad, rad².
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Covariance(Matrix3<f64>);

/// What is known of a measured (x, y, θ): the inverse of a covariance, but zero in directions that are not measured;
/// finite, symmetric, positive semidefinite.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Information(Matrix3<f64>);

/// Eigenvalues below this part of the largest are zero: text files round.
const NEGLIGIBLE: f64 = 1e-9;

/// Eigenvalues below this part of the largest are zero as well as double precision can have it.
const ROUNDING: f64 = 1e-14;

/// Why a matrix is no covariance and no information matrix.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
pub enum UncertaintyError {
    /// NaN or infinite.
    #[error("row {row}, column {column} is {value}, which is no finite number")]
    NotFinite {
        /// Row, from 1.
        row: usize,
        /// Column, from 1.
        column: usize,
        /// The entry.
        value: f64,
    },
    /// M ≠ Mᵀ.
    #[error(
        "not symmetric: row {row}, column {column} is {value}, but row {column}, column {row} is {mirrored}"
    )]
    NotSymmetric {
        /// Row, from 1.
        row: usize,
        /// Column, from 1.
        column: usize,
        /// The entry.
        value: f64,
        /// Its mirror image.
        mirrored: f64,
    },
    /// An eigenvalue is zero or negative.
    #[error(
        "not positive definite: the smallest eigenvalue is {0:e}, but every direction needs a positive one"
    )]
    NotPositiveDefinite(f64),
    /// Positive definite, but so nearly singular that its inverse would be noise.
    #[error(
        "too close to singular: the condition number is about {0:e}, and {WORST_CONDITION:e} is the most that \
         double precision bears; give the best known direction a larger variance"
    )]
    IllConditioned(f64),
}

/// Checks a matrix once and for all; the result is exactly symmetric.
fn checked(matrix: Matrix3<f64>) -> Result<Matrix3<f64>, UncertaintyError> {
    if is_clear(&matrix) {
        return Ok(matrix);
    }
    let matrix = checked_symmetric(matrix)?;
    let cholesky = matrix
        .cholesky()
        .ok_or_else(|| UncertaintyError::NotPositiveDefinite(matrix.symmetric_eigenvalues().min()))?;
    let condition = matrix.amax() * cholesky.inverse().amax();
    if condition <= WORST_CONDITION { Ok(matrix) } else { Err(UncertaintyError::IllConditioned(condition)) }
}

/// Whether a matrix is exactly symmetric, positive definite and well-conditioned beyond all rounding, as most are: by its leading minors
/// (Sylvester) and by the diagonal of its inverse, where the largest entry of a positive definite matrix stands. Tells nothing if not.
fn is_clear(matrix: &Matrix3<f64>) -> bool {
    /// A minor is positive beyond rounding if it is more than this part of the product of its diagonal.
    const ROOM: f64 = 1e-9;
    /// Below, products round to subnormal numbers.
    const LEAST: f64 = 1e-280;
    let [a, b, c] = [matrix[(0, 0)], matrix[(0, 1)], matrix[(0, 2)]];
    let [d, e, f] = [matrix[(1, 1)], matrix[(1, 2)], matrix[(2, 2)]];
    let minors = [d * f - e * e, a * f - c * c, a * d - b * b];
    let determinant = a * minors[0] - b * (b * f - c * e) + c * (b * e - c * d);
    let condition = a.max(d).max(f) * minors[0].max(minors[1]).max(minors[2]) / determinant;
    // No comparison holds of NaN, and no condition is infinite that holds.
    let is_symmetric = b == matrix[(1, 0)] && c == matrix[(2, 0)] && e == matrix[(2, 1)];
    is_symmetric
        && a > 0.0
        && minors[2] > ROOM * a * d
        && determinant > ROOM * a * d * f
        && determinant > LEAST
        && condition < 0.1 * WORST_CONDITION
}

/// Checks that all entries are finite and mirrored; the result is so exactly.
fn checked_symmetric(matrix: Matrix3<f64>) -> Result<Matrix3<f64>, UncertaintyError> {
    for row in 0..3 {
        for column in 0..3 {
            let value = matrix[(row, column)];
            if !value.is_finite() {
                return Err(UncertaintyError::NotFinite { row: row + 1, column: column + 1, value });
            }
        }
    }
    for (row, column) in [(0, 1), (0, 2), (1, 2)] {
        let (value, mirrored) = (matrix[(row, column)], matrix[(column, row)]);
        if (value - mirrored).abs() > SYMMETRY_TOLERANCE * value.abs().max(mirrored.abs()) {
            return Err(UncertaintyError::NotSymmetric { row: row + 1, column: column + 1, value, mirrored });
        }
    }
    Ok(symmetrized(matrix))
}

fn symmetrized(matrix: Matrix3<f64>) -> Matrix3<f64> {
    0.5 * matrix + 0.5 * matrix.transpose()
}

/// The matrix with these eigenvectors whose eigenvalues are zero where they are negligible: not positive definite, whichever
/// way it rounds, so that it is the same again when it is read again.
fn cleared(eigen: &SymmetricEigen<f64, U3>) -> Matrix3<f64> {
    let largest = eigen.eigenvalues.max();
    let mut none = 0.0;
    loop {
        let clear = eigen.eigenvalues.map(|value| if value <= NEGLIGIBLE * largest { none } else { value });
        let rebuilt = eigen.eigenvectors * Matrix3::from_diagonal(&clear) * eigen.eigenvectors.transpose();
        let rebuilt = symmetrized(rebuilt);
        if rebuilt.cholesky().is_none() {
            return rebuilt;
        }
        none = 2.0 * none - f64::EPSILON * largest;
    }
}

fn cholesky(matrix: &Matrix3<f64>) -> Cholesky<f64, U3> {
    matrix.cholesky().expect("a checked matrix is positive definite with room to spare")
}

fn turned(matrix: &Matrix3<f64>, theta: f64) -> Matrix3<f64> {
    let rotation = frame_rotation(theta);
    symmetrized(rotation * matrix * rotation.transpose())
}

fn log_determinant(matrix: &Matrix3<f64>) -> f64 {
    2.0 * cholesky(matrix).l_dirty().diagonal().map(f64::ln).sum()
}

impl Covariance {
    /// A covariance from its matrix.
    ///
    /// # Errors
    /// If an entry is not finite, or the matrix not symmetric, not positive definite, or too close to singular.
    pub fn new(matrix: Matrix3<f64>) -> Result<Self, UncertaintyError> {
        checked(matrix).map(Covariance)
    }

    /// Independent standard deviations: metres, metres, radians.
    ///
    /// # Errors
    /// As [`Covariance::new`]: none of them may be zero.
    pub fn from_standard_deviations(x: f64, y: f64, theta: f64) -> Result<Self, UncertaintyError> {
        Covariance::new(Matrix3::from_diagonal(&[x * x, y * y, theta * theta].into()))
    }

    /// The matrix, rows and columns in the order x, y, θ.
    #[must_use]
    pub fn matrix(&self) -> &Matrix3<f64> {
        &self.0
    }

    /// C⁻¹.
    #[must_use]
    pub fn information(&self) -> Information {
        Information(symmetrized(cholesky(&self.0).inverse()))
    }

    /// R C Rᵀ with the rotation by `theta`: the same uncertainty, with x and y expressed in a frame in
    /// which the present one is turned by `theta` radians.
    #[must_use]
    pub fn rotated(&self, theta: f64) -> Self {
        Covariance(turned(&self.0, theta))
    }

    /// ln |C|.
    #[must_use]
    pub fn log_determinant(&self) -> f64 {
        log_determinant(&self.0)
    }
}

impl Information {
    /// An information matrix from its entries.
    ///
    /// # Errors
    /// If an entry is not finite, or the matrix not symmetric, not positive definite, or too close to singular.
    pub fn new(matrix: Matrix3<f64>) -> Result<Self, UncertaintyError> {
        checked(matrix).map(Information)
    }

    /// An information matrix that may be zero in some directions, which are not measured then.
    ///
    /// # Errors
    /// If an entry is not finite, or the matrix not symmetric, negative in some direction, or so much larger in one
    /// measured direction than in another that it is too close to singular.
    ///
    /// ```
    /// use hssh_metrics::Information;
    /// use nalgebra::matrix;
    ///
    /// let position = Information::semidefinite(matrix![4.0, 0.0, 0.0; 0.0, 4.0, 0.0; 0.0, 0.0, 0.0])?;
    /// assert_eq!(position.rank(), 2);
    /// assert!(position.covariance().is_none());
    /// # Ok::<(), hssh_metrics::UncertaintyError>(())
    /// ```
    pub fn semidefinite(matrix: Matrix3<f64>) -> Result<Self, UncertaintyError> {
        let refusal = match checked(matrix) {
            Ok(definite) => return Ok(Information(definite)),
            Err(refusal @ UncertaintyError::NotPositiveDefinite(_)) => refusal,
            Err(refusal) => return Err(refusal),
        };
        let symmetric = checked_symmetric(matrix)?;
        let eigen = symmetric.symmetric_eigen();
        let zero = NEGLIGIBLE * eigen.eigenvalues.max();
        if eigen.eigenvalues.min() < -zero {
            return Err(refusal);
        }
        let axes = [0, 1, 2].map(|axis| symmetric.column(axis).iter().all(|&entry| entry == 0.0));
        let (zeros, unmeasured) = (eigen.eigenvalues.iter().filter(|&&value| value <= zero), axes.iter());
        if zeros.count() == unmeasured.filter(|&&is_zero| is_zero).count() {
            return Ok(Information(symmetric)); // the zeros are exact as they stand
        }
        if eigen
            .eigenvalues
            .iter()
            .all(|&value| value > zero || value.abs() <= ROUNDING * eigen.eigenvalues.max())
        {
            return Ok(Information(symmetric)); // and so they are here, up to rounding
        }
        Ok(Information(cleared(&eigen)))
    }

    /// How many directions are measured: three, if the matrix is positive definite.
    #[must_use]
    pub fn rank(&self) -> usize {
        if self.0.cholesky().is_some() { 3 } else { self.measured().count() }
    }

    /// The eigenvalues that are not zero.
    fn measured(&self) -> impl Iterator<Item = f64> {
        let eigenvalues = self.0.symmetric_eigenvalues();
        let zero = NEGLIGIBLE * eigenvalues.max();
        [0, 1, 2].into_iter().map(move |index| eigenvalues[index]).filter(move |&value| value > zero)
    }

    /// The unit matrix.
    #[must_use]
    pub fn identity() -> Self {
        Information(Matrix3::identity())
    }

    /// The matrix, rows and columns in the order x, y, θ.
    #[must_use]
    pub fn matrix(&self) -> &Matrix3<f64> {
        &self.0
    }

    /// Ω⁻¹; `None` if there is a direction that is not measured.
    #[must_use]
    pub fn covariance(&self) -> Option<Covariance> {
        self.0.cholesky().map(|cholesky| Covariance(symmetrized(cholesky.inverse())))
    }

    /// R Ω Rᵀ with the rotation by `theta`, as [`Covariance::rotated`].
    #[must_use]
    pub fn rotated(&self, theta: f64) -> Self {
        Information(turned(&self.0, theta))
    }

    /// `factor` · Ω: the information of a measurement that counts `factor` times, which must be positive.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        Information(factor * self.0)
    }

    /// ln |Ω| of the directions that are measured.
    #[must_use]
    pub fn log_determinant(&self) -> f64 {
        match self.0.cholesky() {
            Some(cholesky) => 2.0 * cholesky.l_dirty().diagonal().map(f64::ln).sum(),
            None => self.measured().map(f64::ln).sum(),
        }
    }
}

/// A relative pose with the covariance of its three numbers: x and y in the frame the pose is given in.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct UncertainPose {
    /// The expected pose.
    pub mean: Pose,
    /// The covariance of (x, y, θ) of the pose.
    pub covariance: Covariance,
}

impl UncertainPose {
    /// `self ⊕ other` with its covariance to first order, the two errors being independent.
    ///
    /// # Errors
    /// If the lever arm is so long that the covariance comes too close to singular.
    pub fn compose(&self, other: &UncertainPose) -> Result<UncertainPose, UncertaintyError> {
        let (by_self, by_other) = self.mean.compose_jacobians(other.mean);
        let covariance = by_self * self.covariance.0 * by_self.transpose()
            + by_other * other.covariance.0 * by_other.transpose();
        Ok(UncertainPose {
            mean: self.mean.compose(other.mean),
            covariance: Covariance::new(symmetrized(covariance))?,
        })
    }

    /// `⊖ self` with its covariance to first order.
    ///
    /// # Errors
    /// As [`UncertainPose::compose`].
    pub fn inverse(&self) -> Result<UncertainPose, UncertaintyError> {
        let jacobian = self.mean.inverse_jacobian();
        let covariance = jacobian * self.covariance.0 * jacobian.transpose();
        Ok(UncertainPose { mean: self.mean.inverse(), covariance: Covariance::new(symmetrized(covariance))? })
    }

    /// The compound of a chain of relative poses, each given in the frame of the one before; `None` if
    /// the chain is empty, for then nothing is uncertain.
    ///
    /// # Errors
    /// As [`UncertainPose::compose`].
    pub fn compound<'a>(
        chain: impl IntoIterator<Item = &'a UncertainPose>,
    ) -> Result<Option<UncertainPose>, UncertaintyError> {
        let mut links = chain.into_iter();
        let Some(first) = links.next() else { return Ok(None) };
        links.try_fold(*first, |sofar, link| sofar.compose(link)).map(Some)
    }
}
