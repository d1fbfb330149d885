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

/// A `FLASER` message as it stands in the log.
#[derive(Clone, PartialEq, Debug)]
pub struct LaserMessage {
    /// Metres, beam by beam, as recorded.
    pub ranges: Vec<f64>,
    /// The pose after somebody's scan matching: for scoring only.
    pub corrected: Pose,
    /// The robot's raw odometry.
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
        match words.first().copied() {
            Some("FLASER") => Ok(Message::Laser(laser(&words)?)),
            Some("ODOM") => Ok(Message::Odometry(pose(&words, 1)?)),
            Some("PARAM") if words.len() >= 3 => {
                Ok(Message::Parameter { name: words[1].to_owned(), value: words[2].to_owned() })
            }
            Some(kind) if kind.starts_with('#') => Ok(Message::Other("#".to_owned())),
            Some(kind) => Ok(Message::Other(kind.chars().take(40).collect())),
            None => Ok(Message::Other(String::new())),
        }
    }
}

/// `FLASER n r… x y θ x y θ`, and three words about the time that old logs may lack.
fn laser(words: &[&str]) -> Result<LaserMessage, MessageProblem> {
    let count = words.get(1).copied().unwrap_or_default();
    let beams = count.parse().ok().filter(|beams| (1..=MOST_BEAMS).contains(beams));
    let beams: usize = beams.ok_or_else(|| MessageProblem::BeamCount { token: count.to_owned() })?;
    let poses = 2 + beams;
    if ![poses + 6, poses + 9].contains(&words.len()) {
        return Err(MessageProblem::Length { found: words.len(), beams, expected: poses + 9 });
    }
    let ranges = (2..poses).map(|word| range(words, word)).collect::<Result<_, _>>()?;
    let (corrected, odometry) = (pose(words, poses)?, pose(words, poses + 3)?);
    let time = number(words, poses + 6).ok();
    Ok(LaserMessage { ranges, corrected, odometry, time })
}

fn range(words: &[&str], word: usize) -> Result<f64, MessageProblem> {
    let metres = number(words, word)?;
    if metres < 0.0 {
        return Err(MessageProblem::NegativeRange { word: word + 1, token: words[word].to_owned() });
    }
    Ok(metres)
}

fn pose(words: &[&str], first: usize) -> Result<Pose, MessageProblem> {
    Ok(Pose::new(number(words, first)?, number(words, first + 1)?, number(words, first + 2)?))
}

fn number(words: &[&str], word: usize) -> Result<f64, MessageProblem> {
    let token = words.get(word).ok_or(MessageProblem::TooShort { found: words.len(), expected: word + 1 })?;
    let value = token.parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| MessageProblem::NotANumber { word: word + 1, token: abbreviated(token) })
}

/// A word short enough for a message.
fn abbreviated(token: &str) -> String {
    let short: String = token.chars().take(24).collect();
    if short.len() < token.len() { short + "…" } else { short }
}
