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
    /// Metres, beam by beam, as recorded; infinite where the word is no range: `inf`, `nan`, negative, or no number.
    pub ranges: Vec<f64>,
    /// How many words are no ranges.
    pub odd_beams: usize,
    /// The first of them.
    pub odd_word: Option<String>,
    /// The laser's pose: after somebody's scan matching, or raw.
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
        let kind = words.first().map(|kind| kind.to_ascii_uppercase());
        match kind.as_deref() {
            Some("FLASER") => Ok(Message::Laser(laser(&words)?)),
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
fn laser(words: &[&str]) -> Result<LaserMessage, MessageProblem> {
    let count = words.get(1).copied().unwrap_or_default();
    let beams = count.parse().ok().filter(|beams| (1..=MOST_BEAMS).contains(beams));
    let beams: usize = beams.ok_or_else(|| MessageProblem::BeamCount { token: abbreviated(count) })?;
    let poses = 2 + beams;
    if ![poses + 6, poses + 9].contains(&words.len()) {
        return Err(MessageProblem::Length { found: words.len(), beams, expected: poses + 9 });
    }
    let odd = |&word: &usize| range(words[word]).is_none();
    let nonsense = (2..poses).filter(|&word| odd(&word) && !says_nothing(words[word]));
    if nonsense.clone().count() > beams / MOST_NONSENSE
        && let Some(word) = nonsense.clone().next()
    {
        return Err(MessageProblem::NotANumber { word: word + 1, token: abbreviated(words[word]) });
    }
    let odd_word = (2..poses).find(odd).map(|word| abbreviated(words[word]));
    let odd_beams = (2..poses).filter(odd).count();
    let ranges = words[2..poses].iter().map(|word| range(word).unwrap_or(f64::INFINITY)).collect();
    let (corrected, odometry) = (pose(words, poses)?, pose(words, poses + 3)?);
    let time = number(words, poses + 6).ok();
    Ok(LaserMessage { ranges, odd_beams, odd_word, corrected, odometry, time })
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
