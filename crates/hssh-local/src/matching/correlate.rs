//! The coarse search: where a scan lies best on the surfaces seen before, tried at every pose around
//! the one that odometry predicts.

use hssh_metrics::{Pose, UncertainPose};
use nalgebra::{Vector2, Vector3, vector};

use super::cloud::{Cloud, SurfacePoint};

/// Side of a cell of the likelihood field, in metres.
const CELL: f64 = 0.1;
/// How far a hit may be from a surface and still speak for a pose, in metres, standard deviation.
const BLUR: f64 = 0.15;
/// How much a hit off all surfaces speaks against a pose: it may be something that was not seen before.
const OUTLIER: f64 = 0.05;
/// Steps of the search: metres, which are a cell, and radians.
const STEP: (f64, f64) = (CELL, 0.02);
/// Metres up to which a field has cells of that size, and is searched in such steps.
pub(super) const USUAL_REACH: f64 = 20.0;
/// The most steps to each side, and around so many times as many as steps are smaller.
const MOST_STEPS: f64 = 12.0;
/// After so many hits it is seen whether a pose can still be the best.
const AT_ONCE: usize = 16;

/// How well hits fit, as a grid of log-likelihoods around the surfaces seen before.
pub(super) struct LikelihoodField {
    origin: Vector2<f64>,
    /// How many times larger than usual cells and blur are, and smaller the turns that the search tries: far hits move much with a turn.
    scale: f64,
    width: usize,
    height: usize,
    cells: Vec<f32>,
}

impl LikelihoodField {
    /// The field of a cloud within `reach` metres of `center`, the coarser the farther it reaches.
    pub(super) fn new(cloud: &Cloud, center: Vector2<f64>, reach: f64) -> Self {
        let scale = (reach / USUAL_REACH).max(1.0);
        let cell = scale * CELL;
        let side = (2.0 * reach / cell).ceil() as usize;
        let origin = center - vector![reach, reach];
        let off_all = OUTLIER.ln() as f32;
        let mut field =
            LikelihoodField { origin, scale, width: side, height: side, cells: vec![off_all; side * side] };
        // The nearest point of each cell is the one that speaks for it: squared distances in cells.
        let mut squared = vec![f64::INFINITY; side * side];
        let radius = (3.0 * BLUR / CELL).ceil() as i64;
        for point in cloud.points() {
            let at = (point.position - origin) / cell;
            let (column, row) = (at.x.floor() as i64, at.y.floor() as i64);
            let within = |at: i64, side: usize| {
                (at - radius).clamp(0, side as i64) as usize..(at + radius + 1).clamp(0, side as i64) as usize
            };
            let columns = within(column, field.width);
            for row in within(row, field.height) {
                let down = (row as f64 + 0.5 - at.y).powi(2);
                let cells = &mut squared[row * field.width..][columns.clone()];
                for (cell, column) in cells.iter_mut().zip(columns.clone()) {
                    *cell = cell.min((column as f64 + 0.5 - at.x).powi(2) + down);
                }
            }
        }
        for (cell, squared) in field.cells.iter_mut().zip(squared).filter(|(_, squared)| squared.is_finite())
        {
            let likelihood = (-0.5 * squared * (CELL / BLUR).powi(2)).exp();
            *cell = (OUTLIER + (1.0 - OUTLIER) * likelihood).ln() as f32;
        }
        field
    }

    fn index(&self, column: i64, row: i64) -> Option<usize> {
        let is_inside = column >= 0 && row >= 0 && column < self.width as i64 && row < self.height as i64;
        is_inside.then(|| row as usize * self.width + column as usize)
    }

    /// The mean of the hits' log-likelihoods, seen from a pose.
    pub(super) fn fit(&self, surfaces: &[SurfacePoint], pose: Pose) -> f64 {
        let rotation = pose.rotation();
        let hits = surfaces.iter().map(|surface| self.at(pose.translation() + rotation * surface.position));
        hits.sum::<f64>() / surfaces.len().max(1) as f64
    }

    fn at(&self, position: Vector2<f64>) -> f64 {
        self.at_cell(self.cell(position), (0, 0))
    }

    /// The column and the row of the cell that a position is in.
    fn cell(&self, position: Vector2<f64>) -> (i64, i64) {
        let at = (position - self.origin) / (self.scale * CELL);
        (at.x.floor() as i64, at.y.floor() as i64)
    }

    /// The log-likelihood so many columns and rows beside a cell.
    fn at_cell(&self, (column, row): (i64, i64), (columns, rows): (i64, i64)) -> f64 {
        let cell = self.index(column + columns, row + rows);
        cell.map_or(OUTLIER.ln(), |index| f64::from(self.cells[index]))
    }
}

/// The pose around the predicted one, within `sigmas` of its standard deviations, from which the scan
/// fits best, what odometry believes being part of the fit. Hits count `weight` each.
pub(super) fn search(
    field: &LikelihoodField,
    surfaces: &[SurfacePoint],
    predicted: &UncertainPose,
    sigmas: f64,
    weight: f64,
) -> Pose {
    let information = predicted.covariance.information();
    let spread = predicted.covariance.matrix().diagonal().map(f64::sqrt) * sigmas;
    let (cell, turn) = (STEP.0 * field.scale, STEP.1 / field.scale);
    let across = (spread.x.max(spread.y) / cell).ceil().min(MOST_STEPS) as i32;
    let around = (spread.z / turn).ceil().min(MOST_STEPS * field.scale) as i32;
    let mut best = (f64::NEG_INFINITY, predicted.mean);
    for turned_by in (-around..=around).map(|step| f64::from(step) * turn) {
        let turned = Pose { theta: predicted.mean.theta + turned_by, ..predicted.mean };
        let rotation = turned.rotation();
        let hit = |surface: &SurfacePoint| field.cell(turned.translation() + rotation * surface.position);
        let hits: Vec<(i64, i64)> = surfaces.iter().map(hit).collect();
        for row in -across..=across {
            for column in -across..=across {
                let shift = vector![f64::from(column), f64::from(row)] * cell;
                let off = Vector3::new(shift.x, shift.y, turned_by);
                let prior = -0.5 * off.dot(&(information.matrix() * off));
                let cells = (i64::from(column), i64::from(row));
                // Every hit speaks against a pose or not at all, so that the sum only falls.
                let mut score = prior;
                for hits in hits.chunks(AT_ONCE) {
                    score += weight * hits.iter().map(|&hit| field.at_cell(hit, cells)).sum::<f64>();
                    if score <= best.0 {
                        break;
                    }
                }
                if score > best.0 {
                    best = (score, Pose::new(turned.x + shift.x, turned.y + shift.y, turned.theta));
                }
            }
        }
    }
    best.1
}
