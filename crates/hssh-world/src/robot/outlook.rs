//! What the robot makes of the grid around it: the place-neighborhood that it is in (section 2.2.2).

use hssh_causal::control::{Exit, Vicinity};
use hssh_local::{Gateway, OccupancyGrid, neighborhood};
use hssh_metrics::{Pose, wrap_angle};
use nalgebra::vector;

use super::options::RobotOptions;

/// Two readings of a neighborhood have their centers so near to one another, in metres, or within the
/// clearance there.
const SAME_CENTER: f64 = 1.0;

/// The robot's local perceptual model: the neighborhood as it was read last.
pub(super) struct Outlook {
    here: Option<Here>,
    /// How many neighborhoods there were.
    count: u32,
}

struct Here {
    number: u32,
    center: [f64; 2],
    clearance: f64,
    gateways: Vec<Gateway>,
}

impl Outlook {
    pub(super) fn new() -> Self {
        Outlook { here: None, count: 0 }
    }

    /// Looks whether the robot is in a neighborhood, and in which. Gateways stay as they were read first.
    pub(super) fn look(&mut self, grid: &OccupancyGrid, at: [f64; 2], options: &RobotOptions) {
        let Some(found) = read(grid, at, options) else {
            self.here = None;
            return;
        };
        let is_same = |here: &Here| {
            let off = (here.center[0] - found.center[0]).hypot(here.center[1] - found.center[1]);
            off <= here.clearance.max(SAME_CENTER)
        };
        if !self.here.as_ref().is_some_and(is_same) {
            self.here = Some(Here { number: self.count, ..found });
            self.count += 1;
        }
    }

    /// Reads the gateways of the neighborhood again: they show best from its center.
    pub(super) fn read_again(&mut self, grid: &OccupancyGrid, at: [f64; 2], options: &RobotOptions) {
        if let (Some(here), Some(found)) = (&mut self.here, read(grid, at, options)) {
            *here = Here { number: here.number, ..found };
        }
    }

    /// The gateways of the neighborhood, in the frame of the grid.
    pub(super) fn gateways(&self) -> &[Gateway] {
        self.here.as_ref().map_or(&[], |here| &here.gateways)
    }

    /// The neighborhood as it looks from a pose.
    pub(super) fn vicinity(&self, from: Pose) -> Option<Vicinity> {
        let here = self.here.as_ref()?;
        let exit = |gateway: &Gateway| {
            let [x, y] = gateway.position;
            let seen = from.rotation().transpose() * (vector![x, y] - from.translation());
            let bearing = wrap_angle(gateway.bearing - from.theta);
            Exit { position: [seen.x, seen.y], bearing, width: gateway.width }
        };
        Some(Vicinity { number: here.number, gateways: here.gateways.iter().map(exit).collect() })
    }
}

/// The neighborhood around a point; none in a corridor, or where nothing can be told.
fn read(grid: &OccupancyGrid, at: [f64; 2], options: &RobotOptions) -> Option<Here> {
    let window = grid.window(at, options.window)?;
    let found = neighborhood(&window, at, &options.places).ok().filter(|found| found.place.is_some())?;
    let gateways = found.star.gateways().copied().collect();
    Some(Here { number: 0, center: found.center, clearance: found.clearance, gateways })
}
