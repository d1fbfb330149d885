//! Any bytes: reading a laser log does not panic, and all that is kept of it is finite.

#![no_main]

use hssh_local::LaserLog;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(log) = LaserLog::read(bytes) {
        assert!(log.trajectory.iter().all(|pose| pose.is_finite()));
        assert!(log.scans.iter().any(|scan| scan.scan.ranges.len() == log.beams()));
        assert!(log.scans.iter().all(|scan| log.trajectory[scan.moment] == scan.odometry));
    }
});
