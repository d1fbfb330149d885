//! What can be wrong with a log: problems of one message, which are passed over, and of the whole.

use std::fmt;

use hssh_metrics::Pose;

use super::position::LogPosition;

/// Why one message cannot be used.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum MessageProblem {
    /// A word is no finite number.
    #[error("word {word}, `{token}`, is no finite number")]
    NotANumber {
        /// Its position in the line, counted from 1.
        word: usize,
        /// The word.
        token: String,
    },
    /// A coordinate out of all proportion.
    #[error("word {word}, `{token}`, is no place where a robot may be")]
    FarAway {
        /// Its position in the line, counted from 1.
        word: usize,
        /// The word.
        token: String,
    },
    /// The second word of a laser message does not say how many beams there are.
    #[error("word 2, `{token}`, is no number of beams between 1 and {most}", most = super::message::MOST_BEAMS)]
    BeamCount {
        /// The word.
        token: String,
    },
    /// The line ends before the message does, or has words left over.
    #[error("the message has {found} words, but {beams} beams take {expected}")]
    Length {
        /// How many words there are.
        found: usize,
        /// How many beams were announced.
        beams: usize,
        /// How many words that takes.
        expected: usize,
    },
    /// The line ends before the message does.
    #[error("the message ends after {found} words, {expected} are needed")]
    TooShort {
        /// How many words there are.
        found: usize,
        /// How many are needed.
        expected: usize,
    },
    /// The scan has another number of beams than most.
    #[error("the scan has {found} beams, but most scans have {expected}")]
    OtherBeamCount {
        /// How many beams it has.
        found: usize,
        /// How many most scans have.
        expected: usize,
    },
}

/// Something in a log that was passed over, or taken otherwise than it stands there.
#[derive(Clone, PartialEq, Debug)]
pub enum LogWarning {
    /// A message that was left out.
    Message {
        /// Where it stands.
        at: LogPosition,
        /// What kind it says it is.
        kind: String,
        /// Why it was left out.
        problem: MessageProblem,
    },
    /// The log breaks off inside a line or inside its compressed data; it was used up to there.
    BreaksOff {
        /// The last line that began.
        at: LogPosition,
        /// What happened there.
        reason: String,
    },
    /// Beams of which the word is no range: nothing came back along them.
    OddBeams {
        /// Where the first scan with one stands.
        at: LogPosition,
        /// Its word.
        word: String,
        /// How many beams there are.
        beams: u64,
        /// In how many scans.
        scans: u64,
    },
    /// The range limit of the laser was taken from the readings.
    RangeLimit {
        /// The limit: metres.
        limit: f64,
        /// How many readings there are at the limit.
        beams: u64,
        /// What the log says, if it does.
        said: Option<f64>,
    },
    /// The laser is not at the robot's axis; the robot's pose is taken to be the laser's.
    LaserPose {
        /// The laser in the frame of the robot.
        pose: Pose,
        /// Where that is known from.
        source: &'static str,
    },
    /// The scans do not turn as the odometry does: the laser looks wider or less wide than was taken for granted.
    View {
        /// The view that was taken: radians.
        view: f64,
        /// The view with which scans and odometry turn alike: radians.
        seen: f64,
        /// Whether the view was given, by the log or by the user.
        is_told: bool,
    },
    /// The scans move as if the laser looked elsewhere than was taken for granted.
    Facing {
        /// Where it seems to look, as seen from where it was taken to: radians, counterclockwise.
        seen: f64,
        /// Whether it is taken to look there.
        is_reckoned: bool,
    },
    /// The scans move farther, or less far, than the odometry does.
    OdometryScale {
        /// About so many times as far.
        seen: f64,
    },
    /// The scans turn where the odometry does not.
    TurnsApart {
        /// How many turns the odometry tells otherwise.
        off: u64,
        /// How many turns the scans show.
        turns: u64,
    },
    /// Scans that are the same to the last digit while the robot drives.
    ScansRepeat {
        /// Where the first of them stands.
        at: LogPosition,
        /// How many there are.
        scans: u64,
        /// How far the odometry went meanwhile: metres.
        metres: f64,
    },
    /// The odometry goes as fast as no robot does in a building.
    TooFast {
        /// The usual speed: metres per second.
        speed: f64,
    },
    /// The odometry between scans is not that of the scans, and was left out.
    StrayOdometry {
        /// The first line of it.
        at: LogPosition,
        /// How many lines there are.
        lines: u64,
    },
    /// A parameter that cannot mean what it says, and was not used.
    OddParameter {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it would have to be.
        expected: &'static str,
    },
    /// The scans turn with the robot instead of against it: their beams come in the other order.
    Mirrored {
        /// Whether they are taken to.
        is_reckoned: bool,
    },
    /// The odometry goes to the other side than its heading turns.
    OtherHanded,
    /// Ranges scatter as those of no laser do.
    Noisy {
        /// Their standard deviation: metres.
        sigma: f64,
    },
    /// Something about a recording that its reader has to say.
    Remark {
        /// What, in words.
        text: String,
        /// Whether a part of the recording is missing from what is made of it.
        is_loss: bool,
    },
    /// There is no odometry: scan matching alone says how the robot moved.
    ScansAlone,
    /// Many readings are beyond the limit that the log says.
    LimitDoubted {
        /// The limit: metres.
        said: f64,
        /// How many readings are longer.
        beyond: u64,
        /// How many there are.
        beams: u64,
        /// The longest: metres.
        longest: f64,
    },
    /// The odometry jumps as no robot moves; the step is bridged by the one before it and by the scans.
    Jump {
        /// Behind the jump; in recordings without lines, the next scan.
        at: LogPosition,
        /// How far it jumps: metres.
        metres: f64,
        /// How far it turns: radians.
        turn: f64,
    },
}

impl LogWarning {
    /// Where in the log that is which it is about; `None` if it is about the whole log.
    #[must_use]
    pub fn position(&self) -> Option<LogPosition> {
        match self {
            LogWarning::Message { at, .. }
            | LogWarning::BreaksOff { at, .. }
            | LogWarning::OddBeams { at, .. }
            | LogWarning::ScansRepeat { at, .. }
            | LogWarning::StrayOdometry { at, .. }
            | LogWarning::Jump { at, .. } => Some(*at),
            LogWarning::RangeLimit { .. }
            | LogWarning::LimitDoubted { .. }
            | LogWarning::LaserPose { .. }
            | LogWarning::Facing { .. }
            | LogWarning::OdometryScale { .. }
            | LogWarning::Mirrored { .. }
            | LogWarning::OtherHanded
            | LogWarning::Noisy { .. }
            | LogWarning::OddParameter { .. }
            | LogWarning::Remark { .. }
            | LogWarning::ScansAlone
            | LogWarning::TooFast { .. }
            | LogWarning::TurnsApart { .. }
            | LogWarning::View { .. } => None,
        }
    }

    /// Whether a part of the log is missing from what is made of it.
    #[must_use]
    pub fn is_loss(&self) -> bool {
        match self {
            LogWarning::Message { .. }
            | LogWarning::BreaksOff { .. }
            | LogWarning::Jump { .. }
            | LogWarning::OddParameter { .. }
            | LogWarning::StrayOdometry { .. } => true,
            LogWarning::Remark { is_loss, .. } => *is_loss,
            LogWarning::OddBeams { .. }
            | LogWarning::RangeLimit { .. }
            | LogWarning::LimitDoubted { .. }
            | LogWarning::LaserPose { .. }
            | LogWarning::Facing { .. }
            | LogWarning::OdometryScale { .. }
            | LogWarning::Mirrored { .. }
            | LogWarning::OtherHanded
            | LogWarning::Noisy { .. }
            | LogWarning::ScansAlone
            | LogWarning::ScansRepeat { .. }
            | LogWarning::TooFast { .. }
            | LogWarning::TurnsApart { .. }
            | LogWarning::View { .. } => false,
        }
    }
}

/// The unit of which a metre has so many, up to what wheels err.
pub(super) fn unit(a_metre: f64) -> Option<&'static str> {
    const UNITS: [(&str, f64); 5] = [
        ("millimetres", 1e3),
        ("centimetres", 1e2),
        ("decimetres", 10.0),
        ("inches", 39.37),
        ("feet", 3.281),
    ];
    let is_near = |size: f64| (a_metre / size - 1.0).abs() < 0.1;
    UNITS.into_iter().find(|&(_, size)| is_near(size)).map(|(name, _)| name)
}

impl fmt::Display for LogWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LogWarning::Message { at, kind, problem } => {
                write!(f, "{at}: {kind} left out: {problem}")
            }
            LogWarning::BreaksOff { at, reason } => {
                write!(f, "{at}: the log breaks off here ({reason}); it was used up to this line")
            }
            LogWarning::OddBeams { at, word, beams, scans } => write!(
                f,
                "{at}: `{word}` is no range; that beam and {} others in {scans} scans were taken to have brought \
                 nothing back",
                beams - 1
            ),
            LogWarning::RangeLimit { limit, beams, said } => {
                write!(
                    f,
                    "{beams} readings are {limit} m and hardly any is longer: that was taken for the laser's limit, "
                )?;
                match said {
                    Some(said) => write!(f, "although the log says {said} m"),
                    None => write!(f, "for the log does not say `robot_front_laser_max`"),
                }
            }
            LogWarning::LaserPose { pose: Pose { x, y, theta }, source } => write!(
                f,
                "the laser sits {x:.2} m ahead of the robot's axis, {y:.2} m to its left and turned by {:.1}°, says {source}; \
                 the robot's poses are those of its laser",
                theta.to_degrees()
            ),
            LogWarning::View { view, seen, is_told } => write!(
                f,
                "the walls do not turn as the odometry does with a laser that looks {:.0}° wide{}: they do with one of \
                 about {:.0}°; what is made of the log is wrong if the view is",
                view.to_degrees(),
                if *is_told { ", as it is said to" } else { ", as was taken for granted" },
                seen.to_degrees()
            ),
            LogWarning::Facing { seen, is_reckoned: true } => write!(
                f,
                "the walls move as if the laser were turned by about {:.0}° on the robot: that is reckoned with, and straight stretches show \
                 no more of it; --laser-pose says how it sits",
                seen.to_degrees()
            ),
            LogWarning::Facing { seen, is_reckoned: false } => write!(
                f,
                "the walls do not come toward the robot as it drives: they move as if the laser were turned by about {:.0}° \
                 from where it was taken to look; what is made of the log is wrong if it is (--laser-pose says so)",
                seen.to_degrees()
            ),
            LogWarning::OdometryScale { seen } => {
                let times = seen.max(1.0 / seen);
                let more = if *seen > 1.0 { "faster" } else { "more slowly" };
                write!(f, "the walls come toward the robot about {times:.1} times {more} than the odometry says")?;
                match (unit(*seen), unit(1.0 / seen)) {
                    (Some(unit), _) => write!(f, ", as if the ranges were {unit} and the odometry metres")?,
                    (_, Some(unit)) => write!(f, ", as if the odometry were {unit} and the ranges metres")?,
                    (None, None) => {}
                }
                f.write_str(
                    ": are both in metres, and are the wheels as large as they are said to be? what is made of the log is wrong if not",
                )
            }
            LogWarning::Mirrored { is_reckoned } => f.write_str(if *is_reckoned {
                "the walls turn with the robot and not against it: the beams seem to come from left to right, as of a laser mounted upside down, \
                 and were put in the usual order; if it is the odometry that turns the other way, what is made of the log is its mirror image"
            } else {
                "the walls turn with the robot and not against it: the beams seem to come from left to right, as of a laser \
                 mounted upside down, or the odometry turns the other way; what is made of the log is wrong if so"
            }),
            LogWarning::OtherHanded => f.write_str(
                "the odometry moves to the right where its heading turns to the left, and the other way round: y is mirrored, or headings count \
                 clockwise; what is made of the log is wrong if so",
            ),
            LogWarning::Noisy { sigma } => write!(
                f,
                "the ranges of neighboring beams scatter by {sigma:.2} m, as those of no laser do: walls and ways out are guesses; what is made \
                 of the log may be wrong"
            ),
            LogWarning::LimitDoubted { said, beyond, beams, longest } => write!(
                f,
                "the log says that nothing comes back from {said} m on (`robot_front_laser_max`), but {beyond} of {beams} \
                 readings are longer, up to {longest} m, and differ as walls do: they were taken to have brought nothing \
                 back; is the limit right?"
            ),
            LogWarning::TurnsApart { off, turns } => write!(
                f,
                "in {off} of {turns} turns that the scans show, the odometry does not turn alike at that time: is its heading missing, in \
                 another unit, or behind the scans? what is made of the log is wrong if so"
            ),
            LogWarning::ScansRepeat { at, scans, metres } => write!(
                f,
                "{at}: {scans} scans from here on are the same to the last digit, although the odometry goes on by {metres:.1} m: the laser \
                 stood still there, and what is made of the log is wrong if the robot did not"
            ),
            LogWarning::TooFast { speed } => write!(
                f,
                "the odometry goes at {speed:.0} m/s, as no robot does in a building: is it in metres, and are the times in seconds? what is \
                 made of the log is wrong if not"
            ),
            LogWarning::StrayOdometry { at, lines } => write!(
                f,
                "{at}: {lines} lines of odometry between the scans are far from where the scans' own odometry is, as if they counted in \
                 another unit or from another place: they were left out"
            ),
            LogWarning::OddParameter { name, value, expected } => {
                write!(f, "the parameter {name} is {value}, but would have to be {expected}: it was not used")
            }
            LogWarning::Remark { text, .. } => f.write_str(text),
            LogWarning::ScansAlone => write!(
                f,
                "there is no odometry: scan matching alone says how the robot moved, which errs along corridors that look \
                 the same everywhere, and where the robot moves or turns far between two scans"
            ),
            LogWarning::Jump { at, metres, turn } => write!(
                f,
                "{at}: the odometry jumps by {metres:.1} m and {:.0}°, as no robot moves; the step was bridged by \
                 scan matching",
                turn.to_degrees()
            ),
        }
    }
}

/// Why a log cannot be used at all.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The file cannot be read.
    #[error("{}: {error}", if *line == 0 { "cannot read it".to_owned() } else { format!("cannot read on at line {line}") })]
    Read {
        /// The last line that began, counted from 1; 0 if none did.
        line: u64,
        /// Why not.
        error: std::io::Error,
    },
    /// A line that no log has: the file is something else.
    #[error("line {line} is longer than {most} bytes: this is no CARMEN log")]
    EndlessLine {
        /// The line, counted from 1.
        line: u64,
        /// How long a line may be.
        most: usize,
    },
    /// A laser is asked for that the log does not have.
    #[error("the log has no {asked} messages; it has {has}")]
    NoSuchLaser {
        /// The kind of messages.
        asked: &'static str,
        /// The kinds that it has.
        has: String,
    },
    /// Nothing in it.
    #[error("the log is empty")]
    Empty,
    /// Hardly a beam of any scan came back.
    #[error(
        "hardly anything came back to the laser: {returned} of {beams} beams are shorter than its limit of {limit} m{}",
        match unit {
            Some(unit) => format!("; are the ranges {unit}? A log has metres: convert them"),
            None => "; is the limit (`PARAM robot_front_laser_max`) right, and did the laser look at anything?".to_owned(),
        }
    )]
    NothingCameBack {
        /// How many beams came back.
        returned: u64,
        /// How many there are.
        beams: u64,
        /// The limit.
        limit: f64,
        /// The unit in which the ranges would make sense.
        unit: Option<&'static str>,
    },
    /// Scans in no order.
    #[error(
        "the scans are in no order: from one to the next the odometry goes {next:.1} m, and from any to any {any:.1} m; sort the log by time, \
         and give each drive in a log of its own"
    )]
    OutOfOrder {
        /// The middle one of all ways from a scan to the next: metres.
        next: f64,
        /// The middle one of the ways between scans that do not follow one another: metres.
        any: f64,
    },
    /// A recording without a usable scan.
    #[error("the recording has no usable laser scan")]
    NothingRecorded,
    /// No usable scan.
    #[error(
        "the log has no usable laser scan: {lines} lines, among them {messages}{first}; a log needs FLASER, RAWLASER or ROBOTLASER messages",
        first = first_warning.as_ref().map_or_else(String::new, |warning| format!("; {warning}"))
    )]
    NoScans {
        /// How many lines there are.
        lines: u64,
        /// What they are.
        messages: String,
        /// The first problem met, if there was any.
        first_warning: Option<LogWarning>,
    },
}
