//! Whether two submaps show one place, and how they lie on one another.

use hssh_metrics::{Covariance, Pose, UncertainPose};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use super::keyframe::Keyframe;
use super::options::ClosingOptions;
use super::search::{Window, search};
use super::submap::{CELL, Submap};
use crate::matching::{Cloud, MatchOptions, SurfacePoint, align};

/// Two matches nearer than this to one another are one, in metres.
const APART: f64 = 1.0;
/// How far one submap can be slid on another along a corridor, in metres, standard deviation.
const SLIDE: f64 = 5.0;
/// A hit is on a wall if it is no farther off, in metres…
const ON_WALL: f64 = 0.2;
/// …and faces the same way, up to 25°.
const FACING: f64 = 0.9;
/// A window so small leaves no room for another match: metres.
const SMALL: f64 = 1.2;

/// One submap found in another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Match {
    /// The later submap…
    pub(super) query: usize,
    /// …and the earlier one.
    pub(super) reference: usize,
    /// The later one's middle in the frame of the earlier one's.
    pub(super) relative: UncertainPose,
    /// The direction in the earlier one's frame, of length 1, along which all walls lead, if there is one: how far the robot is
    /// along it the match does not tell.
    pub(super) slide: Option<Vector2<f64>>,
    pub(super) score: f64,
    pub(super) agreement: f64,
    pub(super) overlap: f64,
    /// Whether nothing else in the window fits nearly as well.
    pub(super) is_clear: bool,
    /// Whether the window was so small that there was nothing else to find.
    pub(super) is_expected: bool,
}

/// Looks for a submap in an earlier one. `None` if it does not lie in the window.
pub(super) fn find(
    submaps: &[Submap],
    keyframes: &[Keyframe],
    (query, reference): (usize, usize),
    window: &Window,
    options: &ClosingOptions,
) -> Option<Match> {
    let (one, other) = (&submaps[reference], &submaps[query]);
    // The more cells, the longer it takes; a few hundred tell as much as all.
    let step = (other.walls.len() / 300).max(1);
    let walls: Vec<Vector2<f64>> = other.walls.iter().step_by(step).copied().collect();
    let best = search(&one.field, &walls, window, options.least_score, None)?;
    let is_expected = window.across <= SMALL;
    let is_clear = is_expected
        || search(&one.field, &walls, window, options.ambiguity * best.score, Some((best.pose, APART)))
            .is_none();
    let prior = UncertainPose {
        mean: best.pose,
        covariance: Covariance::from_standard_deviations(5.0, 5.0, 0.5).expect("positive"),
    };
    let matching = MatchOptions { floor: (0.0, 0.0), hits_per_observation: 20.0, ..MatchOptions::default() };
    let (cloud, surfaces) = (one.cloud(keyframes), other.surfaces(keyframes));
    let fine = align(&cloud, &surfaces, best.pose, &prior, &matching);
    if (fine.mean.translation() - best.pose.translation()).norm() > 0.4 {
        return None;
    }
    let (agreement, overlap) = agreement(one, other, fine.mean);
    let slide = slide(&cloud, &surfaces, fine.mean, options.least_crossing);
    if slide.is_some() && !is_expected {
        return None;
    }
    let floor = Vector3::new(options.floor.0, options.floor.0, options.floor.1).map(|sigma| sigma * sigma);
    let along = slide.map_or(Matrix3::zeros(), |axis| {
        let axis = SLIDE * Vector3::new(axis.x, axis.y, 0.0);
        axis * axis.transpose()
    });
    let covariance =
        Covariance::new(fine.covariance.matrix() + Matrix3::from_diagonal(&floor) + along).ok()?;
    let relative = UncertainPose { mean: fine.mean, covariance };
    Some(Match {
        query,
        reference,
        relative,
        slide,
        score: best.score,
        agreement,
        overlap,
        is_clear,
        is_expected,
    })
}

/// The direction along which all walls that both submaps have lead, so that one can be slid on the other: less than the part
/// `least_crossing` of them crosses it.
fn slide(
    cloud: &Cloud,
    surfaces: &[SurfacePoint],
    placed: Pose,
    least_crossing: f64,
) -> Option<Vector2<f64>> {
    let (rotation, origin) = (placed.rotation(), placed.translation());
    let mut scatter = Matrix2::zeros();
    for surface in surfaces {
        let hit = origin + rotation * surface.position;
        let Some(own) = surface.normal.map(|normal| rotation * normal) else { continue };
        let nearest = cloud.nearest(hit, ON_WALL).and_then(|point| point.normal);
        if nearest.is_some_and(|normal| normal.dot(&own).abs() > FACING) {
            scatter += own * own.transpose();
        }
    }
    let eigen = scatter.symmetric_eigen();
    let (least, axis) = if eigen.eigenvalues.x < eigen.eigenvalues.y {
        (eigen.eigenvalues.x, 0)
    } else {
        (eigen.eigenvalues.y, 1)
    };
    (least < least_crossing * scatter.trace()).then(|| eigen.eigenvectors.column(axis).into_owned())
}

/// Of the walls of each submap that lie where the other one has seen something, which part the other one has
/// too; and how many metres of wall both have.
fn agreement(one: &Submap, other: &Submap, placed: Pose) -> (f64, f64) {
    let onto = |pose: Pose, walls: &[Vector2<f64>]| -> Vec<Vector2<f64>> {
        let rotation = pose.rotation();
        walls.iter().map(|wall| pose.translation() + rotation * wall).collect()
    };
    let there = one.field.meets(onto(placed, &other.walls).into_iter());
    let back = other.field.meets(onto(placed.inverse(), &one.walls).into_iter());
    let (seen, near) = (there.0 + back.0, there.1 + back.1);
    // Every second cell of a wall is kept.
    let overlap = there.1.min(back.1) as f64 * 2.0 * CELL;
    (near as f64 / seen.max(1) as f64, overlap)
}
