//! The messages of a CARMEN log, one per line, and how a line is read.

use hssh_metrics::Pose;

use super::error::MessageProblem;

/// A scan with more beams than this is a mistake.
pub(super) const MOST_BEAMS: usize = 100_000;

/// A message that a mapper can use.
#[derive(Clone, PartialEq, Debug)]
pub enum Message {
    /// A laser scan.
    Laser(LaserMessage),
    /// Where raw odometry believes the robot is.
    Odometry(Pose),
    /// A parameter of the recording program: its name and the words behind it.
    Parameter {
        /// The name, such as `robot_front_laser_max`.
        name: String,
        /// The first word behind the name.
        value: String,
    },
    /// A comment, an empty line, or a message of another kind: its first word.
    Other(String),
}

/// Which message a scan is told by, the least useful first: a log may tell each scan by several.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum LaserKind {
    /// `ROBOTLASER2`: a second laser, which looks back, and how.
    RobotRear,
    /// `RLASER`: a laser that looks back.
    Rear,
    /// `RAWLASER1`: without a pose, which odometry before it tells.
    Raw,
    /// `ROBOTLASER1`: says how the laser looks.
    Robot,
    /// `FLASER`.
    Front,
}

impl LaserKind {
    /// All kinds, the most useful first.
    pub const ALL: [LaserKind; 5] =
        [LaserKind::Front, LaserKind::Robot, LaserKind::Raw, LaserKind::Rear, LaserKind::RobotRear];

    /// The name of its messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            LaserKind::RobotRear => "ROBOTLASER2",
            LaserKind::Rear => "RLASER",
            LaserKind::Raw => "RAWLASER1",
            LaserKind::Robot => "ROBOTLASER1",
            LaserKind::Front => "FLASER",
        }
    }

    /// The kind whose messages have a name, in capitals or not.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        LaserKind::ALL.into_iter().find(|kind| kind.name().eq_ignore_ascii_case(name))
    }

    /// Whether its laser looks back.
    #[must_use]
    pub fn is_rear(self) -> bool {
        matches!(self, LaserKind::Rear | LaserKind::RobotRear)
    }
}

/// How a message says that its laser looks.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LaserView {
    /// How wide: radians.
    pub view: f64,
    /// Where the middle of its view is: radians, counterclockwise from straight ahead.
    pub turn: f64,
}

/// A laser message as it stands in the log.
#[derive(Clone, PartialEq, Debug)]
pub struct LaserMessage {
    /// Which message it is.
    pub kind: LaserKind,
    /// How its laser looks, if the message says so.
    pub looks: Option<LaserView>,
    /// Metres, beam by beam, as recorded; infinite where the word is no range: `inf`, `nan`, negative, or no number.
    pub ranges: Vec<f64>,
    /// How many words are no ranges.
    pub odd_beams: usize,
    /// The first of them.
    pub odd_word: Option<String>,
    /// The laser's pose: after somebody's scan matching, or raw. The origin in messages without poses.
    pub corrected: Pose,
    /// The robot's raw odometry; the origin in messages without poses.
    pub odometry: Pose,
    /// When it was taken, in seconds of the recording program's clock, if the message says so.
    pub time: Option<f64>,
}

impl Message {
    /// Reads a line.
    ///
    /// # Errors
    /// If it says that it is a laser scan or an odometry reading but is none.
    pub fn parse(line: &str) -> Result<Message, MessageProblem> {
        let words: Vec<&str> = line.split_whitespace().collect();
        let kind = words.first().map(|kind| kind.to_ascii_uppercase());
        match kind.as_deref() {
            Some("FLASER") => Ok(Message::Laser(laser(&words, LaserKind::Front)?)),
            Some("RLASER") => Ok(Message::Laser(laser(&words, LaserKind::Rear)?)),
            Some("ROBOTLASER1") => Ok(Message::Laser(told_laser(&words, LaserKind::Robot)?)),
            Some("ROBOTLASER2") => Ok(Message::Laser(told_laser(&words, LaserKind::RobotRear)?)),
            Some("RAWLASER1") => Ok(Message::Laser(told_laser(&words, LaserKind::Raw)?)),
            Some("ODOM") => Ok(Message::Odometry(pose(&words, 1)?)),
            Some("PARAM") if words.len() >= 3 => {
                Ok(Message::Parameter { name: words[1].to_owned(), value: words[2].to_owned() })
            }
            Some(kind) if kind.starts_with('#') => Ok(Message::Other("#".to_owned())),
            Some(_) => Ok(Message::Other(words[0].chars().take(40).collect())),
            None => Ok(Message::Other(String::new())),
        }
    }
}

/// `FLASER n r… x y θ x y θ`, and three words about the time that old logs may lack.
fn laser(words: &[&str], kind: LaserKind) -> Result<LaserMessage, MessageProblem> {
    let count = words.get(1).copied().unwrap_or_default();
    let beams = count.parse().ok().filter(|beams| (1..=MOST_BEAMS).contains(beams));
    let beams: usize = beams.ok_or_else(|| MessageProblem::BeamCount { token: abbreviated(count) })?;
    let poses = 2 + beams;
    if ![poses + 6, poses + 9].contains(&words.len()) {
        return Err(MessageProblem::Length { found: words.len(), beams, expected: poses + 9 });
    }
    let Beams { ranges, odd_beams, odd_word } = read_beams(words, 2..poses)?;
    let (corrected, odometry) = (pose(words, poses)?, pose(words, poses + 3)?);
    let time = number(words, poses + 6).ok();
    let back = LaserView { view: std::f64::consts::PI, turn: std::f64::consts::PI };
    let looks = (kind == LaserKind::Rear).then_some(back);
    Ok(LaserMessage { kind, looks, ranges, odd_beams, odd_word, corrected, odometry, time })
}

/// `ROBOTLASER1 type start view step longest accuracy remissions n r… m i… x y θ x y θ v ω … t host t`, of which
/// `RAWLASER1` has no poses and no speeds.
fn told_laser(words: &[&str], kind: LaserKind) -> Result<LaserMessage, MessageProblem> {
    /// The words before the ranges, and those about speeds and safety behind the poses.
    const BEFORE: usize = 9;
    const SPEEDS: usize = 5;
    let (first, view) = (number(words, 2)?, number(words, 3)?);
    let (step, longest) = (number(words, 4)?, number(words, 5)?);
    let count = words.get(8).copied().unwrap_or_default();
    let beams = count.parse().ok().filter(|beams| (1..=MOST_BEAMS).contains(beams));
    let beams: usize = beams.ok_or_else(|| MessageProblem::BeamCount { token: abbreviated(count) })?;
    let behind = BEFORE + beams;
    let remissions = words.get(behind).and_then(|count| count.parse::<usize>().ok());
    let remissions = remissions.filter(|&remissions| remissions <= MOST_BEAMS);
    let expected = behind + 1;
    let remissions = remissions.ok_or(MessageProblem::Length { found: words.len(), beams, expected })?;
    let poses = behind + 1 + remissions;
    let Beams { mut ranges, odd_beams, odd_word } = read_beams(words, BEFORE..behind)?;
    if longest > 0.0 {
        ranges.iter_mut().filter(|range| **range >= longest).for_each(|range| *range = f64::INFINITY);
    }
    let steps = (beams - beams % 2) as f64;
    let view = if step > 0.0 { step * steps } else { view };
    let is_view = view > 0.0 && view <= std::f64::consts::TAU + 0.1 && first.abs() <= std::f64::consts::TAU;
    let back = if kind.is_rear() { std::f64::consts::PI } else { 0.0 };
    let looks = is_view.then_some(LaserView { view, turn: first + view / 2.0 + back });
    let (corrected, odometry, times) = match kind {
        LaserKind::Raw => (Pose::IDENTITY, Pose::IDENTITY, poses),
        _ => (pose(words, poses)?, pose(words, poses + 3)?, poses + 6 + SPEEDS),
    };
    let time = number(words, times).ok();
    Ok(LaserMessage { kind, looks, ranges, odd_beams, odd_word, corrected, odometry, time })
}

/// The ranges in some words.
struct Beams {
    ranges: Vec<f64>,
    odd_beams: usize,
    odd_word: Option<String>,
}

fn read_beams(words: &[&str], at: std::ops::Range<usize>) -> Result<Beams, MessageProblem> {
    if at.end > words.len() {
        return Err(MessageProblem::TooShort { found: words.len(), expected: at.end });
    }
    let beams = at.len();
    let odd = |&word: &usize| range(words[word]).is_none();
    let nonsense = at.clone().filter(|&word| odd(&word) && !says_nothing(words[word]));
    if nonsense.clone().count() > beams / MOST_NONSENSE
        && let Some(word) = nonsense.clone().next()
    {
        return Err(MessageProblem::NotANumber { word: word + 1, token: abbreviated(words[word]) });
    }
    let odd_word = at.clone().find(odd).map(|word| abbreviated(words[word]));
    let odd_beams = at.clone().filter(odd).count();
    let ranges = words[at].iter().map(|word| range(word).unwrap_or(f64::INFINITY)).collect();
    Ok(Beams { ranges, odd_beams, odd_word })
}

/// One beam in so many may be no number at all; with more of them, something else is wrong with the message.
const MOST_NONSENSE: usize = 10;

/// The range in a word, if it is one.
fn range(word: &str) -> Option<f64> {
    word.parse().ok().filter(|metres: &f64| metres.is_finite() && *metres >= 0.0)
}

/// Whether a word is how some program says that a beam brought nothing: a number that is no range, or no number.
fn says_nothing(word: &str) -> bool {
    const NOTHING: [&str; 8] = ["1.#inf", "1.#qnan", "-1.#ind", "1.#ind", "null", "none", "na", "n/a"];
    word.parse::<f64>().is_ok() || NOTHING.contains(&word.to_ascii_lowercase().as_str())
}

/// No robot is farther from where it started than this many metres, and none has turned by more radians.
const FARTHEST: (f64, f64) = (1e8, 1e6);

fn pose(words: &[&str], first: usize) -> Result<Pose, MessageProblem> {
    let numbers = [number(words, first)?, number(words, first + 1)?, number(words, first + 2)?];
    for (offset, most) in [FARTHEST.0, FARTHEST.0, FARTHEST.1].into_iter().enumerate() {
        if numbers[offset].abs() > most {
            let word = first + offset;
            return Err(MessageProblem::FarAway { word: word + 1, token: abbreviated(words[word]) });
        }
    }
    Ok(Pose::new(numbers[0], numbers[1], numbers[2]))
}

fn number(words: &[&str], word: usize) -> Result<f64, MessageProblem> {
    let token = words.get(word).ok_or(MessageProblem::TooShort { found: words.len(), expected: word + 1 })?;
    let value = token.parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| MessageProblem::NotANumber { word: word + 1, token: abbreviated(token) })
}

/// A word short enough for a message.
fn abbreviated(token: &str) -> String {
    let short: String = token.chars().take(24).flat_map(char::escape_debug).collect();
    if token.chars().nth(24).is_some() { short + "…" } else { short }
}
