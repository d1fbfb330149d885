//! The YAML file of a map: its image, where it lies, and how gray values are to be read.

use std::path::{Path, PathBuf};

use serde::Deserialize;

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
    /// 0: dark is occupied; 1: light is occupied.
    negate: u8,
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

impl Description {
    /// What `map_saver` writes and `map_server` takes for granted: dark is occupied.
    pub(super) fn of_floor_plan(image: &Path, resolution: f64) -> Self {
        Description {
            image: image.to_owned(),
            resolution,
            origin: [0.0; 3],
            negate: 0,
            occupied_thresh: 0.65,
            free_thresh: 0.196,
            mode: Mode::Trinary,
        }
    }

    pub(super) fn parse(file: &Path, text: &str) -> Result<Self, MapError> {
        let refuse = |problem: String| MapError::Description { file: file.to_owned(), problem };
        let description: Description = serde_saphyr::from_str(text)
            .map_err(|error| MapError::Yaml { file: file.to_owned(), problem: error.to_string() })?;
        let Description { origin: [.., yaw], negate, occupied_thresh, free_thresh, .. } = description;
        if yaw != 0.0 {
            return Err(refuse(format!(
                "`origin` turns the map by {yaw} rad; only 0 is supported: turn the image itself, or set the third number to 0 to work in the frame of the image"
            )));
        }
        if negate > 1 {
            return Err(refuse(format!("`negate` is {negate}, but must be 0 or 1")));
        }
        if !(0.0 <= free_thresh && free_thresh <= occupied_thresh && occupied_thresh <= 1.0) {
            return Err(refuse(format!(
                "`free_thresh` is {free_thresh} and `occupied_thresh` {occupied_thresh}: they must lie between 0 and 1, `free_thresh` below the other"
            )));
        }
        Ok(description)
    }

    /// What a gray value says; transparent pixels are unknown.
    pub(super) fn occupancy(&self, gray: u8, is_transparent: bool) -> Occupancy {
        let value = f64::from(gray);
        let occupied = match (self.mode, self.negate) {
            (Mode::Raw, _) => value / 100.0,
            (_, 0) => (255.0 - value) / 255.0,
            _ => value / 255.0,
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
