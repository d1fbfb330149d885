//! Trajectories in TUM form, as `evo` and others read them.

use std::fmt::Write as _;

/// When scans were taken and where, from (time, x, y, θ): a line `time x y z qx qy qz qw` for each. `None` if there are none.
#[must_use]
pub fn tum_trajectory(poses: &[[f64; 4]]) -> Option<String> {
    let mut text = String::new();
    for [time, x, y, theta] in poses {
        let (sin, cos) = (theta / 2.0).sin_cos();
        let _ = writeln!(text, "{time} {x:.6} {y:.6} 0 0 0 {sin:.9} {cos:.9}");
    }
    (!poses.is_empty()).then_some(text)
}
