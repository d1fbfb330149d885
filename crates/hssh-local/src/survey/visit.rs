//! Visits: places as the robot met them, and the ways between them.

use hssh_metrics::{Covariance, Pose, UncertainPose, UncertaintyError};
use hssh_topology::Olp;
use nalgebra::Vector2;

use super::error::{SurveyError, SurveyWarning};
use super::options::SurveyOptions;
use super::stay::Stay;
use crate::grid::OccupancyGrid;
use crate::matching::Track;
use crate::place::LocalStar;

/// One visit to a place.
#[derive(Clone, PartialEq, Debug)]
pub struct Visit {
    /// The first and the last scan from which the place was sighted.
    pub scans: (usize, usize),
    /// The scan taken nearest to the center.
    pub reference: usize,
    /// The place's frame in the frame of the track: its origin is where the axes of the gateways meet, and
    /// it is turned as the track is.
    pub frame: Pose,
    /// The star, with bearings in the place's frame; its gateways lie in the frame of the track.
    pub star: LocalStar,
    /// By which end the robot came in; `None` if it started here.
    pub entry: Option<Olp>,
    /// By which end the robot went out; `None` if it stayed.
    pub exit: Option<Olp>,
    /// The local perceptual map of the place, in the frame of the track.
    pub grid: OccupancyGrid,
}

/// What a log tells about places.
#[derive(Clone, PartialEq, Debug)]
pub struct Survey {
    /// The visits in order; at least one.
    pub visits: Vec<Visit>,
    /// From each visit's frame to that of the next.
    pub travels: Vec<UncertainPose>,
    /// The robot's way.
    pub track: Track,
    /// What was decided with little reason.
    pub warnings: Vec<SurveyWarning>,
}

impl Survey {
    pub(super) fn new(
        visits: Vec<Visit>,
        track: Track,
        options: &SurveyOptions,
        warnings: Vec<SurveyWarning>,
    ) -> Result<Self, SurveyError> {
        let travels = visits
            .windows(2)
            .enumerate()
            .map(|(index, pair)| {
                travel(&pair[0], &pair[1], &track, options)
                    .map_err(|problem| SurveyError::Motion { visit: index + 1, problem })
            })
            .collect::<Result<_, _>>()?;
        Ok(Survey { visits, travels, track, warnings })
    }
}

/// The relative pose of two frames: from the center of the one to the robot in it, on with the robot, and
/// to the center of the other.
fn travel(
    from: &Visit,
    to: &Visit,
    track: &Track,
    options: &SurveyOptions,
) -> Result<UncertainPose, UncertaintyError> {
    let (center, heading) = options.place_fix;
    let covariance = Covariance::from_standard_deviations(center, center, heading)?;
    let robot_in = |visit: &Visit| {
        let mean = visit.frame.between(track.scans[visit.reference].pose);
        UncertainPose { mean, covariance }
    };
    let departure = robot_in(from);
    let arrival = robot_in(to).inverse()?;
    match track.motion(from.reference, to.reference)? {
        Some(motion) => departure.compose(&motion)?.compose(&arrival),
        None => departure.compose(&arrival),
    }
}

/// Visits from stays: the star, and by which of its ends the robot came and went.
pub(super) fn visits(
    stays: Vec<Stay>,
    track: &Track,
    options: &SurveyOptions,
    warnings: &mut Vec<SurveyWarning>,
) -> Vec<Visit> {
    let last_scan = track.scans.len() - 1;
    let borders: Vec<(usize, usize)> = (0..stays.len())
        .map(|index| {
            let since = index.checked_sub(1).map_or(0, |before| stays[before].reference);
            let until = stays.get(index + 1).map_or(last_scan, |next| next.reference);
            (since, until)
        })
        .collect();
    let count = stays.len();
    let mut visits = Vec::new();
    for (index, (stay, (since, until))) in stays.into_iter().zip(borders).enumerate() {
        let center = stay.sighting.center;
        let Some(star) = stay.sighting.star(&options.place) else { continue };
        let mut end_toward = |at: Option<Vector2<f64>>, verb: &'static str| {
            let (end, offset) = nearest_end(&star, center, at?)?;
            let width = star.gateways[end.index()].map_or(0.0, |gateway| gateway.width);
            if offset > width.max(1.0) {
                warnings.push(SurveyWarning::OffGateways { visit: index + 1, verb, offset });
            }
            Some(end)
        };
        let came_from = (index > 0).then(|| stay.came_from(track, since)).flatten();
        let went_to = (index + 1 < count).then(|| stay.went_to(track, until)).flatten();
        let (entry, exit) = (end_toward(came_from, "came in"), end_toward(went_to, "went out"));
        visits.push(Visit {
            scans: (stay.first, stay.last),
            reference: stay.reference,
            frame: Pose::new(center.x, center.y, 0.0),
            star,
            entry,
            exit,
            grid: stay.grid,
        });
    }
    visits
}

/// The travelable end whose gateway one passes on the way from the center to a point, and how far the
/// point is off its axis.
fn nearest_end(star: &LocalStar, center: Vector2<f64>, at: Vector2<f64>) -> Option<(Olp, f64)> {
    let ends = star.star.gateways().filter_map(|olp| Some((olp, star.gateways[olp.index()]?)));
    let offsets = ends.map(|(olp, gateway)| {
        let from_gateway = at - Vector2::from(gateway.position);
        let outward = Vector2::new(gateway.bearing.cos(), gateway.bearing.sin());
        let along = from_gateway.dot(&outward);
        let across = (from_gateway - outward * along).norm();
        // A point on the inner side of a gateway is as far from it as it is from the gateway's middle.
        let is_beyond = along > 0.0 && (at - center).dot(&outward) > 0.0;
        (olp, if is_beyond { across } else { from_gateway.norm() })
    });
    offsets.min_by(|a, b| a.1.total_cmp(&b.1))
}
