//! What was decided with little reason, or left out on the way to an answer.

use std::fmt;

use serde::{Deserialize, Serialize};

/// What a warning is about.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum WarningKind {
    /// Messages of a log that could not be used.
    MessageLeftOut,
    /// The log breaks off.
    BreaksOff,
    /// Beams of which the word is no range, and which were taken to have brought nothing back.
    BeamsWithoutRange,
    /// The odometry jumps as no robot moves.
    OdometryJump,
    /// The limit of the laser was taken from its readings.
    RangeLimit,
    /// Many readings are longer than the limit that the log says.
    RangeLimitDoubted,
    /// The laser is not at the robot's axis.
    LaserPose,
    /// The scans do not move as the odometry does: the laser looks wider, elsewhere or the other way round than was
    /// taken for granted.
    LaserView,
    /// Odometry or scans that are possible and hardly meant, such as degrees for radians or scans that repeat themselves.
    Questionable,
    /// Scans that look like earlier ones where the rest of the log contradicts that.
    ContradictedReturn,
    /// The robot seems to be back, and what the laser shows does not confirm it.
    UnconfirmedReturn,
    /// Scans that lie on nothing that was seen before.
    Lost,
    /// Odometry that stands still while the scans move, all along or for a while, or none.
    NoOdometry,
    /// What of a recording is not used, or used otherwise than it says.
    Recording,
    /// The survey was stopped before its end.
    SurveyInterrupted,
    /// The best map bends a measured travel by more than its covariance can explain.
    ImprobableTravel,
    /// The places of a map have no poses although travels were measured.
    NoPoses,
    /// The building that the log shows cannot be drawn, or has nowhere to be.
    NoBuilding,
    /// More threads were asked for than are of use.
    FewerThreads,
}

/// Where something is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Spot {
    /// A line of the input, counted from 1 as editors do.
    Line(u64),
    /// A scan.
    Scan(u64),
    /// A visit, the start being 0.
    Visit(u64),
    /// A map, by its rank.
    Map(u64),
}

/// One thing to know, however often it occurred.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct AnswerWarning {
    /// What it is about.
    pub kind: WarningKind,
    /// How often it occurred.
    pub count: u64,
    /// The first of them in words.
    pub sentence: String,
    /// Where the first of them are, [`AnswerWarning::MOST_SPOTS`] at most.
    #[serde(rename = "where")]
    pub spots: Vec<Spot>,
}

impl AnswerWarning {
    /// How many spots are listed at most.
    pub const MOST_SPOTS: usize = 10;

    /// Whether what comes out may well be wrong for it.
    #[must_use]
    pub fn is_serious(&self) -> bool {
        matches!(
            self.kind,
            WarningKind::ImprobableTravel
                | WarningKind::Lost
                | WarningKind::NoOdometry
                | WarningKind::LaserView
                | WarningKind::RangeLimitDoubted
                | WarningKind::Questionable
                | WarningKind::SurveyInterrupted
        )
    }

    /// A warning that occurred once, nowhere in particular.
    pub(crate) fn once(kind: WarningKind, sentence: String) -> Self {
        AnswerWarning { kind, count: 1, sentence, spots: Vec::new() }
    }

    /// Adds one that occurred to those that did, each kind in the order in which it occurred first.
    pub(crate) fn record(
        warnings: &mut Vec<AnswerWarning>,
        kind: WarningKind,
        spot: Spot,
        sentence: impl FnOnce() -> String,
    ) {
        let known = warnings.iter().position(|warning| warning.kind == kind);
        let index = known.unwrap_or_else(|| {
            warnings.push(AnswerWarning { kind, count: 0, sentence: sentence(), spots: Vec::new() });
            warnings.len() - 1
        });
        let warning = &mut warnings[index];
        warning.count += 1;
        if warning.spots.len() < Self::MOST_SPOTS {
            warning.spots.push(spot);
        }
    }
}

/// For people, who count lines, scans and maps from 1, and visits from 0, the start.
impl fmt::Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Spot::Line(line) => write!(f, "line {line}"),
            Spot::Scan(scan) => write!(f, "scan {}", scan + 1),
            Spot::Visit(visit) => write!(f, "visit {visit}"),
            Spot::Map(rank) => write!(f, "map {rank}"),
        }
    }
}

impl fmt::Display for AnswerWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.sentence)?;
        if self.count < 2 {
            return Ok(());
        }
        let others: Vec<String> = self.spots.iter().skip(1).map(Spot::to_string).collect();
        let rest = if self.count > self.spots.len() as u64 { ", …" } else { "" };
        write!(f, "; {} more like it: {}{rest}", self.count - 1, others.join(", "))
    }
}
