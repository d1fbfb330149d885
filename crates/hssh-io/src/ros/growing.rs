//! Bags that are still being written: what has come so far is a log at any time.

use std::io::Read;
use std::path::Path;

use hssh_local::LaserLog;

use crate::ros::bag::read_stream;
use crate::ros::choice::{RecordingOptions, choose};
use crate::ros::error::RecordingError;
use crate::ros::gather::Gathered;
use crate::ros::recording::{ReadRecording, read, recording};

/// A bag that is still being written, as far as it has come.
#[derive(Clone, Debug, Default)]
pub struct GrowingBag {
    gathered: Gathered,
    options: RecordingOptions,
}

impl GrowingBag {
    /// Nothing yet.
    #[must_use]
    pub fn new(options: RecordingOptions) -> Self {
        GrowingBag { gathered: Gathered::default(), options }
    }

    /// How many scans have come, of all lasers.
    #[must_use]
    pub fn scans(&self) -> usize {
        self.gathered.lasers.iter().map(|laser| laser.sweeps.len()).sum()
    }

    /// The log of what has come so far and is settled: a scan is when odometry of a later time has come.
    ///
    /// # Errors
    /// If there is no laser yet of which scans can be used, or if options ask for what has not come.
    pub fn log(&self) -> Result<LaserLog, RecordingError> {
        let choice = choose(&self.gathered, &self.options)?;
        let mut recording = recording(&self.gathered, &choice)?;
        recording.drop_unsettled();
        Ok(LaserLog::from_recording(recording)?)
    }

    /// The log of all that has come, and what was used for it.
    ///
    /// # Errors
    /// As [`log`](Self::log).
    pub fn read(&self) -> Result<ReadRecording, RecordingError> {
        read(&self.gathered, &self.options)
    }
}

/// Reads an MCAP file as it comes through a pipe, message by message, under a name; `change` is given each message's change of
/// the bag.
///
/// # Errors
/// If it cannot be read or is no MCAP file. What came before is in the bag all the same.
pub fn follow_bag(
    name: &Path,
    source: impl Read,
    mut change: impl FnMut(&mut dyn FnMut(&mut GrowingBag)),
) -> Result<(), RecordingError> {
    let contents = read_stream(name, source, &mut |message| change(&mut |bag| bag.gathered.add(&message)))?;
    change(&mut |bag| bag.gathered.contents.clone_from(&contents));
    Ok(())
}
