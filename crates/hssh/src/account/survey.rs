//! What a survey found along a log: visits with their scans and stars, and travels with their odometry.

use std::fmt;

use hssh_local::Visit;
use hssh_metrics::Pose;
use hssh_topology::Olp;
use serde::{Deserialize, Serialize};

use crate::answer::{AnswerWarning, counted};
use crate::pipeline::SurveyedLog;

/// What was found along a log. Metres and radians in the frame of the first scan; scans, visits and ends are counted from
/// 0, scans among all laser messages of the log.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct SurveyAccount {
    /// `hssh-survey`.
    pub format: String,
    /// 1.
    pub version: u32,
    /// The log, as it was given.
    pub name: String,
    /// Laser scans in the log.
    pub scans: u64,
    /// How many of them could be used.
    pub scans_used: u64,
    /// Beams of a scan.
    pub beams: u64,
    /// How far the robot travelled: metres.
    pub metres: f64,
    /// The visits in order.
    pub visits: Vec<SurveyedVisit>,
    /// From each visit to the next.
    pub travels: Vec<SurveyedTravel>,
    /// What was left out, or decided with little reason.
    pub warnings: Vec<AnswerWarning>,
}

/// A visit to a place.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct SurveyedVisit {
    /// The scan taken nearest to the center.
    pub scan: u64,
    /// The first and the last scan from which the place was sighted.
    pub scans: [u64; 2],
    /// When these two were taken, in seconds of the recording program's clock; absent if the log does not say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub times: Option<[f64; 2]>,
    /// The place's frame, which is turned as the first scan's.
    pub frame: Pose,
    /// The star, as the thesis writes it.
    pub star: String,
    /// Its ends, clockwise.
    pub ends: Vec<SurveyedEnd>,
    /// The end that the robot came in by; absent if it started here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub entry: Option<String>,
    /// The end that it went out by; absent if it stayed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exit: Option<String>,
}

/// An end of a star that was seen.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct SurveyedEnd {
    /// Its name in the star.
    pub name: String,
    /// Whether the robot can travel there.
    pub open: bool,
    /// Where it points, in the place's frame.
    pub bearing: f64,
    /// How wide its gateway is: metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
}

/// The way from one visit to the next.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct SurveyedTravel {
    /// The frame of the next visit in the frame of the visit before.
    pub pose: Pose,
    /// Of (x, y, θ), row by row, along the axes of the visit before: m², m·rad, rad².
    pub covariance: [[f64; 3]; 3],
}

impl SurveyAccount {
    /// The account of a surveyed log.
    #[must_use]
    pub fn new(name: &str, surveyed: &SurveyedLog) -> Self {
        let SurveyedLog { log, survey } = surveyed;
        let visit = |visit: &Visit| {
            let star = &visit.star.star;
            let name = |olp: Olp| star.name(olp).to_string();
            let end = |olp: Olp| SurveyedEnd {
                name: name(olp),
                open: star.is_travelable(olp),
                bearing: visit.star.bearings[olp.index()],
                width: visit.star.gateways[olp.index()].map(|gateway| gateway.width),
            };
            let (first, last) = visit.scans;
            let time = |scan: usize| log.scans[scan].time;
            SurveyedVisit {
                scan: surveyed.scan_number(visit.reference),
                scans: [first, last].map(|scan| surveyed.scan_number(scan)),
                times: time(first).zip(time(last)).map(|(first, last)| [first, last]),
                frame: visit.frame,
                star: star.to_string(),
                ends: star.olps().map(end).collect(),
                entry: visit.entry.map(name),
                exit: visit.exit.map(name),
            }
        };
        let travel = |motion: &hssh_metrics::UncertainPose| {
            let covariance = motion.covariance.matrix();
            let row = |row| [0, 1, 2].map(|column| covariance[(row, column)]);
            SurveyedTravel { pose: motion.mean, covariance: [0, 1, 2].map(row) }
        };
        SurveyAccount {
            format: "hssh-survey".to_owned(),
            version: 1,
            name: name.to_owned(),
            scans: surveyed.scans(),
            scans_used: log.scans.len() as u64,
            beams: log.beams() as u64,
            metres: survey.track.scans.last().map_or(0.0, |scan| scan.travelled),
            visits: survey.visits.iter().map(visit).collect(),
            travels: survey.travels.iter().map(travel).collect(),
            warnings: surveyed.warnings(),
        }
    }
}

/// What was found, in words; scans and visits are counted as people do.
impl fmt::Display for SurveyAccount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{}: {} of {} beams, {:.0} m; {}",
            self.name,
            counted(self.scans_used as usize, "scan"),
            self.beams,
            self.metres,
            counted(self.visits.len(), "visit")
        )?;
        for (number, visit) in self.visits.iter().enumerate() {
            let [first, last] = visit.scans.map(|scan| scan + 1);
            write!(f, "{:>4}. scans {first} to {last}: {}", number + 1, visit.star)?;
            for (end, verb) in [(&visit.entry, "in"), (&visit.exit, "out")] {
                if let Some(end) = end {
                    write!(f, ", {verb} by {end}")?;
                }
            }
            match self.travels.get(number) {
                Some(travel) => writeln!(f, ", {:.1} m to the next", travel.pose.translation().norm())?,
                None => writeln!(f)?,
            }
        }
        Ok(())
    }
}
