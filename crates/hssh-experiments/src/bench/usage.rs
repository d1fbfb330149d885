//! What this process has used so far, as Linux tells under `/proc/self`.

use std::error::Error;
use std::fs;

/// Processor time and memory of this process.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Usage {
    /// Processor time of all threads in user mode, in seconds, to a hundredth.
    pub(crate) user_seconds: f64,
    /// The most memory that was resident at one time, in bytes.
    pub(crate) peak_bytes: u64,
}

/// Clock ticks per second in `/proc/self/stat`: the same on every Linux.
const TICKS: f64 = 100.0;

impl Usage {
    /// Reads it.
    pub(crate) fn now() -> Result<Self, Box<dyn Error>> {
        let stat = fs::read_to_string("/proc/self/stat")?;
        // The second field, the program's name in parentheses, may hold blanks; utime is the 14th.
        let utime = stat.rsplit(')').next().and_then(|rest| rest.split_whitespace().nth(11));
        let ticks: f64 = utime.ok_or("/proc/self/stat has no user time")?.parse()?;
        let status = fs::read_to_string("/proc/self/status")?;
        let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = peak.and_then(|line| line.split_whitespace().next());
        let kilobytes: u64 = kilobytes.ok_or("/proc/self/status has no peak memory")?.parse()?;
        Ok(Usage { user_seconds: ticks / TICKS, peak_bytes: kilobytes * 1024 })
    }
}
