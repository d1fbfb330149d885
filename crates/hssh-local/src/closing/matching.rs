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
/// A hit is on a wall if it is no farther off, in metres…
const ON_WALL: f64 = 0.2;
/// …and faces the same way, up to 25°.
const FACING: f64 = 0.9;
/// A window so small leaves no room for another match: metres.
const SMALL: f64 = 1.2;

/// How far from where the search found it a submap is aligned, standard deviations: metres and radians.
const ALIGNED: (f64, f64) = (0.5, 0.1);
/// The same for what nothing shows, as how far along a corridor without features.
const UNKNOWN: (f64, f64) = (5.0, 0.5);

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
    /// How well it was known before where one is from the other: standard deviation in metres.
    pub(super) spread: f64,
    /// How far from where it was believed to be, in metres.
    pub(super) off: f64,
}

/// Looks for a submap in an earlier one, of which it is known where it is up to a standard deviation `spread`. `None` if it does
/// not lie in the window.
pub(super) fn find(
    submaps: &[Submap],
    keyframes: &[Keyframe],
    (query, reference): (usize, usize),
    window: &Window,
    spread: f64,
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
        covariance: Covariance::from_standard_deviations(ALIGNED.0, ALIGNED.0, ALIGNED.1).expect("positive"),
    };
    let matching = MatchOptions { floor: (0.0, 0.0), hits_per_observation: 20.0, ..MatchOptions::default() };
    let (cloud, surfaces) = (one.cloud(keyframes), other.surfaces(keyframes));
    let fine = align(&cloud, &surfaces, best.pose, &prior, 1.0, &matching);
    if (fine.mean.translation() - best.pose.translation()).norm() > 0.4 {
        return None;
    }
    let (agreement, overlap) = agreement(one, other, fine.mean);
    let slide = slide(&cloud, &surfaces, fine.mean, options.least_crossing);
    let covariance = as_shown(&fine.covariance, slide, options.floor)?;
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
        spread,
        off: (fine.mean.translation() - window.center.translation()).norm(),
    })
}

/// Where surfaces lie on a cloud, from a start that is good to some decimetres. `None` if too little of them does.
pub(super) fn refined(
    cloud: &Cloud,
    surfaces: &[SurfacePoint],
    start: Pose,
    options: &ClosingOptions,
) -> Option<UncertainPose> {
    /// So many of the surfaces at least lie on the cloud.
    const LEAST: usize = 30;
    let covariance = Covariance::from_standard_deviations(ALIGNED.0, ALIGNED.0, ALIGNED.1).expect("positive");
    let prior = UncertainPose { mean: start, covariance };
    let matching = MatchOptions { floor: (0.0, 0.0), hits_per_observation: 10.0, ..MatchOptions::default() };
    let fine = align(cloud, surfaces, start, &prior, 1.0, &matching);
    let slide = slide(cloud, surfaces, fine.mean, options.least_crossing);
    let rotation = fine.mean.rotation();
    let lies = |surface: &&SurfacePoint| {
        let facing = surface.normal.map(|normal| rotation * normal);
        cloud.nearest(fine.mean.translation() + rotation * surface.position, facing, ON_WALL).is_some()
    };
    let covariance = as_shown(&fine.covariance, slide, options.fine_floor)?;
    (surfaces.iter().filter(lies).count() >= LEAST).then_some(UncertainPose { mean: fine.mean, covariance })
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
        let nearest = cloud.nearest(hit, Some(own), ON_WALL).and_then(|point| point.normal);
        if nearest.is_some_and(|normal| normal.dot(&own) > FACING) {
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

/// How well the walls show a pose that was aligned: without what the alignment believed before, for where the search
/// began is no observation, and without what cannot be told along the direction in which all walls lead.
fn as_shown(aligned: &Covariance, slide: Option<Vector2<f64>>, floor: (f64, f64)) -> Option<Covariance> {
    let precision = |(across, around): (f64, f64)| {
        Matrix3::from_diagonal(&Vector3::new(across, across, around).map(|sigma| sigma.powi(-2)))
    };
    let information = aligned.information().matrix() - precision(ALIGNED) + precision(UNKNOWN);
    let floor = Vector3::new(floor.0, floor.0, floor.1).map(|sigma| sigma * sigma);
    let along = slide.map_or(Vector3::zeros(), |axis| UNKNOWN.0 * Vector3::new(axis.x, axis.y, 0.0));
    let covariance =
        information.cholesky()?.inverse() + Matrix3::from_diagonal(&floor) + along * along.transpose();
    Covariance::new(0.5 * (covariance + covariance.transpose())).ok()
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Walls along the x axis fix y and the heading to a centimetre and a hundredth of a radian, and x not at all.
    #[test]
    fn what_the_walls_do_not_show_is_not_known() {
        let aligned = Matrix3::from_diagonal(&Vector3::new(1.0 / 0.25, 1e4 + 1.0 / 0.25, 1e4 + 1.0 / 0.01));
        let aligned = Covariance::new(aligned.try_inverse().unwrap()).unwrap();
        let shown = as_shown(&aligned, None, (0.03, 0.0)).unwrap();
        let sigmas = shown.matrix().diagonal().map(f64::sqrt);
        assert!((sigmas.x - 5.0).abs() < 0.01, "{sigmas}");
        assert!((sigmas.y - 0.01_f64.hypot(0.03)).abs() < 1e-4 && (sigmas.z - 0.01).abs() < 1e-4, "{sigmas}");
    }
}
