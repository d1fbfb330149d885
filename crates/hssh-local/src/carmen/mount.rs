//! Where the laser sits on the robot, and how wide it looks.

use hssh_metrics::Pose;

use super::error::LogWarning;
use super::raw::{RawLog, RawScan};

/// The parameters that say it: metres ahead, metres to the left, radians.
const PARAMETERS: [&str; 3] =
    ["robot_frontlaser_offset", "robot_frontlaser_side_offset", "robot_frontlaser_angular_offset"];
/// Of a laser that looks back: metres along its own middle beam, whatever the sign.
const REAR: &str = "robot_rearlaser_offset";
/// No laser sits farther from the axis of its robot, in metres.
const FARTHEST: f64 = 3.0;
/// Two poses that differ by less are equal: logs round to millimetres.
const ROUNDING: f64 = 0.003;
/// So much is no offset worth a word, in metres and radians.
const NEGLIGIBLE: f64 = 0.1;

/// The parameter that says how wide the laser looks: degrees.
const VIEW: &str = "laser_front_laser_fov";

/// What is known of the laser beside the log: it counts more than what the log says.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct LaserMount {
    /// How wide the laser looks: radians.
    pub view: Option<f64>,
    /// The laser in the frame of the robot.
    pub pose: Option<Pose>,
}

impl RawLog {
    /// How each scan looks: how wide, and where the middle of its view is, in radians; and whether anybody says how wide.
    pub(super) fn geometry(&self, known: &LaserMount) -> (Vec<(f64, f64)>, bool) {
        let said = self.parameter(VIEW).filter(|degrees| *degrees > 0.0 && *degrees <= 360.0);
        let told =
            |scan: &RawScan| known.view.or(scan.looks.map(|looks| looks.view)).or(said.map(f64::to_radians));
        let of_scan = |scan: &RawScan| {
            // A turn this small is what is lost of an angle in a text.
            let turn = scan.looks.map(|looks| looks.turn).filter(|turn| turn.abs() > 1e-3);
            (told(scan).unwrap_or(std::f64::consts::PI), turn.unwrap_or(0.0))
        };
        (self.scans.iter().map(of_scan).collect(), self.scans.first().and_then(told).is_some())
    }

    /// Makes the trajectory that of the laser, from which all ranges are measured, and says where it sits on the robot.
    pub(super) fn move_to_laser(&mut self, known: &LaserMount, warnings: &mut Vec<LogWarning>) -> Pose {
        let is_rear = self.scans.first().is_some_and(|scan| scan.kind.is_rear());
        let by_parameters = match (known.pose, is_rear) {
            (Some(_), _) => None,
            (None, true) => self.rear_told_by_parameter(warnings),
            (None, false) => self.told_by_parameters(warnings),
        };
        let (mut pose, source) = match (known.pose, self.told_by_poses(), by_parameters) {
            (Some(pose), ..) => (pose, "who gave it"),
            (None, Some(pose), _) => (pose, "the difference of the two poses in each laser message"),
            (None, None, Some(pose)) => (
                pose,
                if is_rear {
                    "the log's parameter robot_rearlaser_offset"
                } else {
                    "the log's parameter robot_frontlaser_offset"
                },
            ),
            (None, None, None) => return Pose::IDENTITY,
        };
        // That a rear laser looks back is said by its scans.
        if is_rear && pose.theta.abs() > std::f64::consts::FRAC_PI_2 {
            pose = Pose::new(pose.x, pose.y, pose.theta - std::f64::consts::PI);
        }
        for moment in &mut self.trajectory {
            moment.pose = moment.pose.compose(pose);
        }
        if pose.translation().norm() > NEGLIGIBLE || pose.theta.abs() > NEGLIGIBLE {
            warnings.push(LogWarning::LaserPose { pose, source });
        }
        pose
    }

    fn rear_told_by_parameter(&self, warnings: &mut Vec<LogWarning>) -> Option<Pose> {
        let value = self.parameter(REAR).filter(|value| *value != 0.0)?;
        if value.abs() > FARTHEST {
            let expected = "in metres, and within 3 m of the robot's axis";
            warnings.push(LogWarning::OddParameter { name: REAR, value, expected });
            return None;
        }
        Some(Pose::new(-value.abs(), 0.0, 0.0))
    }

    fn told_by_parameters(&self, warnings: &mut Vec<LogWarning>) -> Option<Pose> {
        const LIMITS: [(f64, &str); 3] = [
            (FARTHEST, "in metres, and within 3 m of the robot's axis"),
            (FARTHEST, "in metres, and within 3 m of the robot's axis"),
            (std::f64::consts::TAU, "in radians, and no more than a full turn"),
        ];
        let mut told = [0.0; 3];
        for ((name, (most, expected)), told) in PARAMETERS.into_iter().zip(LIMITS).zip(&mut told) {
            let value = self.parameter(name).unwrap_or(0.0);
            if value.abs() <= most {
                *told = value;
            } else {
                warnings.push(LogWarning::OddParameter { name, value, expected });
            }
        }
        let pose = Pose::new(told[0], told[1], told[2]);
        (pose != Pose::IDENTITY).then_some(pose)
    }

    /// In a log that nobody corrected, the first pose of a scan is the laser's and the second the robot's, and one is
    /// always the same seen from the other.
    fn told_by_poses(&self) -> Option<Pose> {
        let seen = |scan: &RawScan| self.trajectory[scan.moment].pose.between(scan.corrected);
        let first = self.scans.first().map(seen)?;
        let is_same = |pose: Pose| {
            let off = first.between(pose);
            off.translation().norm() <= ROUNDING && off.theta.abs() <= ROUNDING
        };
        let is_offset = first.translation().norm() > ROUNDING || first.theta.abs() > ROUNDING;
        let is_told = is_offset && first.translation().norm() <= FARTHEST && self.scans.len() > 1;
        (is_told && self.scans.iter().all(|scan| is_same(seen(scan)))).then_some(first)
    }
}
