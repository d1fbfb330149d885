//! The words of one record, read field by field.

use nalgebra::{Matrix2, Matrix3, matrix};

use super::error::{ReadProblem, shown};
use crate::pose::Pose;

/// Nothing in the plane of a robot is farther away than this many metres: the earth is 4·10⁷ m around.
const FARTHEST: f64 = 1e9;
/// No robot has turned by more radians than this.
const MOST_TURNED: f64 = 1e6;
/// No measurement is better known than this, in squares of its unit.
const MOST_INFORMATION: f64 = 1e30;

/// The words of one line after its record type.
pub(super) struct Fields<'a> {
    pub(super) words: std::str::SplitWhitespace<'a>,
    /// What the record is, in words.
    pub(super) record: &'static str,
    /// How it is written.
    pub(super) form: &'static str,
}

impl Fields<'_> {
    fn parse<T: std::str::FromStr>(
        &mut self,
        field: &'static str,
        expected: &'static str,
        accept: impl Fn(&T) -> bool,
    ) -> Result<T, ReadProblem> {
        let Fields { record, form, .. } = *self;
        let token = self.words.next().ok_or(ReadProblem::Missing { record, field, form })?;
        let value = token.parse().ok().filter(accept);
        value.ok_or_else(|| ReadProblem::Malformed { record, token: shown(token), field, expected, form })
    }

    pub(super) fn label(&mut self, field: &'static str) -> Result<u64, ReadProblem> {
        self.parse(field, "a whole number from 0", |_| true)
    }

    pub(super) fn number(&mut self, field: &'static str) -> Result<f64, ReadProblem> {
        self.parse(field, "a finite number", |value: &f64| value.is_finite())
    }

    /// Metres, within what there is on earth.
    fn metres(&mut self, field: &'static str) -> Result<f64, ReadProblem> {
        const EXPECTED: &str = "a finite number, of metres between -1e9 and 1e9";
        self.parse(field, EXPECTED, |value: &f64| value.abs() <= FARTHEST)
    }

    pub(super) fn point(&mut self) -> Result<Pose, ReadProblem> {
        Ok(Pose::new(self.metres("x")?, self.metres("y")?, 0.0))
    }

    /// A pose, and its angle as it stands there.
    pub(super) fn pose(&mut self) -> Result<(Pose, f64), ReadProblem> {
        const EXPECTED: &str = "a finite number, of radians between -1e6 and 1e6";
        let Pose { x, y, .. } = self.point()?;
        let angle = self.parse("angle", EXPECTED, |value: &f64| value.abs() <= MOST_TURNED)?;
        Ok((Pose::new(x, y, angle), angle))
    }

    /// The entries of a matrix; `field` says how many there are.
    pub(super) fn entries<const N: usize>(&mut self, field: &'static str) -> Result<[f64; N], ReadProblem> {
        const EXPECTED: &str = "a finite number, between -1e30 and 1e30";
        let mut entries = [0.0; N];
        for entry in &mut entries {
            *entry = self.parse(field, EXPECTED, |value: &f64| value.abs() <= MOST_INFORMATION)?;
        }
        Ok(entries)
    }

    /// A part of one, which neither zero nor one is.
    pub(super) fn part(&mut self, field: &'static str) -> Result<f64, ReadProblem> {
        self.parse(field, "a number between 0 and 1", |value: &f64| *value > 0.0 && *value < 1.0)
    }

    /// A positive number.
    pub(super) fn positive(&mut self, field: &'static str) -> Result<f64, ReadProblem> {
        self.parse(field, "a positive number", |value: &f64| *value > 0.0 && value.is_finite())
    }

    /// The number one.
    pub(super) fn one(&mut self, field: &'static str) -> Result<f64, ReadProblem> {
        self.parse(field, "1, a constraint that holds", |value: &f64| *value == 1.0)
    }

    pub(super) fn end(mut self) -> Result<(), ReadProblem> {
        let Fields { record, form, .. } = self;
        match self.words.next() {
            None => Ok(()),
            Some(token) => Err(ReadProblem::Superfluous { record, token: shown(token), form }),
        }
    }
}

/// The upper triangle row by row, as g2o writes it.
pub(super) fn by_rows([m11, m12, m13, m22, m23, m33]: [f64; 6]) -> Matrix3<f64> {
    matrix![m11, m12, m13; m12, m22, m23; m13, m23, m33]
}

/// As TORO writes it: Ixx Ixy Iyy Itt Ixt Iyt.
pub(super) fn as_toro([ixx, ixy, iyy, itt, ixt, iyt]: [f64; 6]) -> Matrix3<f64> {
    matrix![ixx, ixy, ixt; ixy, iyy, iyt; ixt, iyt, itt]
}

/// Rᵀ R of an upper triangle row by row: what iSAM writes is the square root of the information.
pub(super) fn squared([r11, r12, r13, r22, r23, r33]: [f64; 6]) -> Matrix3<f64> {
    let root = matrix![r11, r12, r13; 0.0, r22, r23; 0.0, 0.0, r33];
    root.transpose() * root
}

/// The information of a point: that of a pose whose heading is not measured.
pub(super) fn of_point(information: Matrix2<f64>) -> Matrix3<f64> {
    information.fixed_resize(0.0)
}
