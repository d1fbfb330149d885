//! The YAML file of a map: its image, where it lies, and how gray values are to be read.

use std::fmt;
use std::path::{Path, PathBuf};

use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer};

use super::MapError;
use crate::grid::Occupancy;

/// The fields of the YAML file, by their names there.
#[derive(Debug, Deserialize)]
pub(super) struct Description {
    /// The image, relative to the YAML file.
    pub(super) image: PathBuf,
    /// Metres per pixel.
    pub(super) resolution: f64,
    /// The lower left corner of the image (metres) and the rotation of the image (radians).
    pub(super) origin: [f64; 3],
    /// Whether light is occupied, and not dark.
    #[serde(deserialize_with = "switch")]
    negate: bool,
    occupied_thresh: f64,
    free_thresh: f64,
    #[serde(default)]
    mode: Mode,
}

/// How gray values become occupancy.
#[derive(Clone, Copy, PartialEq, Debug, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Mode {
    /// By the thresholds.
    #[default]
    Trinary,
    /// Probabilities; since cells here are free, occupied or unknown, the thresholds decide again.
    Scale,
    /// The gray value is the probability in percent, over 100 is unknown.
    Raw,
}

/// No map needs to be turned by more, in radians: a full circle, with room for rounding.
const LARGEST_TURN: f64 = 6.3;

/// As what `map_saver` writes the unknown.
pub(super) const UNKNOWN_GRAY: u8 = 205;

/// Reads what is 0 or 1 for one program and false or true for another.
fn switch<'de, D: Deserializer<'de>>(source: D) -> Result<bool, D::Error> {
    struct Switch;
    impl Visitor<'_> for Switch {
        type Value = bool;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("0, 1, true or false")
        }

        fn visit_bool<E: Error>(self, value: bool) -> Result<bool, E> {
            Ok(value)
        }

        fn visit_i64<E: Error>(self, value: i64) -> Result<bool, E> {
            self.visit_str(&value.to_string())
        }

        fn visit_u64<E: Error>(self, value: u64) -> Result<bool, E> {
            self.visit_str(&value.to_string())
        }

        fn visit_f64<E: Error>(self, value: f64) -> Result<bool, E> {
            self.visit_str(&value.to_string())
        }

        fn visit_str<E: Error>(self, value: &str) -> Result<bool, E> {
            match value.to_ascii_lowercase().as_str() {
                "0" | "false" | "no" | "off" => Ok(false),
                "1" | "true" | "yes" | "on" => Ok(true),
                _ => Err(E::custom(format!(
                    "`negate` is {}, but must be 0, 1, true or false",
                    value.escape_debug()
                ))),
            }
        }
    }
    source.deserialize_any(Switch)
}

/// What the YAML library says, without its picture of the place and its advice to programmers.
fn in_plain_words(problem: &str) -> String {
    let first = problem.lines().next().unwrap_or_default();
    let first = first.strip_prefix("error: ").unwrap_or(first);
    if first.contains("uplicate") {
        let place = first.split(':').next().filter(|place| place.starts_with("line")).unwrap_or("the file");
        return format!("{place}: a key stands there for the second time; leave one of the two out");
    }
    const PLAIN: [(&str, &str); 7] = [
        ("invalid f64", "this is no number"),
        ("invalid floating point", "this is no number"),
        (
            "expected sequence start",
            "three numbers belong here, as in `origin: [0, 0, 0]`: metres, metres and radians",
        ),
        (
            "expected mapping start",
            "a map's description has lines such as `resolution: 0.05`, with a space behind the colon",
        ),
        (
            "expected an array of length 3",
            "but `origin` has three, as in [0, 0, 0]: metres, metres and radians",
        ),
        ("invalid length", "the number of numbers is"),
        ("unknown variant", "the `mode` is"),
    ];
    let plain = PLAIN.into_iter().fold(first.to_owned(), |text, (theirs, ours)| text.replace(theirs, ours));
    plain.split(", set ").next().unwrap_or_default().to_owned()
}

/// The text of a file, without its byte order mark, whichever of Unicode's forms it has.
fn text_of(bytes: &[u8]) -> Option<String> {
    let units = |unit: fn([u8; 2]) -> u16, bytes: &[u8]| {
        let (pairs, rest) = bytes.as_chunks();
        let text = String::from_utf16(&pairs.iter().copied().map(unit).collect::<Vec<u16>>()).ok();
        text.filter(|_| rest.is_empty())
    };
    match bytes {
        [0xFF, 0xFE, rest @ ..] => units(u16::from_le_bytes, rest),
        [0xFE, 0xFF, rest @ ..] => units(u16::from_be_bytes, rest),
        [0xEF, 0xBB, 0xBF, rest @ ..] => std::str::from_utf8(rest).ok().map(str::to_owned),
        _ => std::str::from_utf8(bytes).ok().map(str::to_owned),
    }
}

impl Description {
    /// What `map_saver` writes and `map_server` takes for granted: dark is occupied.
    pub(super) fn of_floor_plan(image: &Path, resolution: f64) -> Self {
        Description {
            image: image.to_owned(),
            resolution,
            origin: [0.0; 3],
            negate: false,
            occupied_thresh: 0.65,
            free_thresh: 0.196,
            mode: Mode::Trinary,
        }
    }

    pub(super) fn parse(file: &Path, bytes: &[u8]) -> Result<Self, MapError> {
        let refuse = |problem: String| MapError::Description { file: file.to_owned(), problem };
        let text = text_of(bytes).ok_or_else(|| {
            refuse("this is neither text in UTF-8 nor in UTF-16 with its mark; give the YAML file that names the image".to_owned())
        })?;
        let description: Description = serde_saphyr::from_str(&text).map_err(|error| MapError::Yaml {
            file: file.to_owned(),
            problem: in_plain_words(&error.to_string()),
        })?;
        let Description { origin: [.., yaw], occupied_thresh, free_thresh, .. } = description;
        if !(-LARGEST_TURN..=LARGEST_TURN).contains(&yaw) {
            return Err(refuse(format!(
                "`origin` turns the map by {yaw} rad, more than a full circle: the third number is an angle in radians"
            )));
        }
        if !(0.0 <= free_thresh && free_thresh <= occupied_thresh && occupied_thresh <= 1.0) {
            return Err(refuse(format!(
                "`free_thresh` is {free_thresh} and `occupied_thresh` {occupied_thresh}: they must lie between 0 and 1, `free_thresh` below the other"
            )));
        }
        Ok(description)
    }

    /// Whether `map_saver`'s mark for the unknown would be free by the letter of the thresholds.
    ///
    /// Navigation2 writes `free_thresh: 0.25` by default, and the unknown as the gray value that is occupied by 0.196.
    pub(super) fn frees_the_unknown(&self) -> bool {
        self.mode == Mode::Trinary && !self.negate && self.occupancy(UNKNOWN_GRAY, false) == Occupancy::Free
    }

    /// What a gray value says; transparent pixels are unknown.
    pub(super) fn occupancy(&self, gray: u8, is_transparent: bool) -> Occupancy {
        let value = f64::from(gray);
        let occupied = match (self.mode, self.negate) {
            (Mode::Raw, _) => value / 100.0,
            (_, false) => (255.0 - value) / 255.0,
            (_, true) => value / 255.0,
        };
        if is_transparent || (self.mode == Mode::Raw && occupied > 1.0) {
            Occupancy::Unknown
        } else if occupied > self.occupied_thresh {
            Occupancy::Occupied
        } else if occupied < self.free_thresh {
            Occupancy::Free
        } else {
            Occupancy::Unknown
        }
    }
}
