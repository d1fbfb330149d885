//! Passages: where one region leads to another, and how probably there is a door.

use std::f64::consts::FRAC_PI_2;

use super::border::Gap;
use super::flood::NO_PIECE;
use super::kind::RegionNumber;
use crate::distance::DistanceField;
use crate::place::{Gateway, gateway_at};
use crate::skeleton::AxisPoint;

/// How far from its middle, in widths of a gap, the region is looked for to which it leads.
const AHEAD: f64 = 1.0;

/// Where two regions meet.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Passage {
    /// The regions, the one with the lower number first.
    pub regions: [RegionNumber; 2],
    /// The line between the nearest obstacles on both sides, for somebody who goes from the first region to the second.
    pub gateway: Gateway,
    /// How probably there is a door.
    pub door_probability: f64,
}

impl Passage {
    /// Whether a door is more probable than none.
    #[must_use]
    pub fn is_door(&self) -> bool {
        self.door_probability >= 0.5
    }

    /// What it is in a word: a door, or an opening.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        if self.is_door() { "door" } else { "opening" }
    }
}

/// The line across a gap between two regions, for somebody who goes from the first to the second.
pub(super) fn gateway_of(gap: &Gap, regions: [u32; 2], labels: &[u32], field: &DistanceField) -> Gateway {
    let lattice = field.lattice();
    let cell = lattice.cell(gap.cell as usize);
    let at = AxisPoint { cell, point: lattice.center(cell), clearance: field.clearance(cell) };
    let along_wall = field.nearest(cell).map_or(0.0, |site| {
        let site = lattice.center(site);
        (site[1] - at.point[1]).atan2(site[0] - at.point[0])
    });
    let ahead = |bearing: f64| {
        let steps = (AHEAD * gap.width / lattice.resolution()).ceil().max(2.0) as u32;
        (1..=steps).find_map(|step| {
            let far = f64::from(step) * lattice.resolution();
            let point = [at.point[0] + far * bearing.cos(), at.point[1] + far * bearing.sin()];
            let label = labels[lattice.index(lattice.cell_at(point)?)];
            (label != NO_PIECE && label == regions[1]).then_some(step)
        })
    };
    let [left, right] = [along_wall + FRAC_PI_2, along_wall - FRAC_PI_2];
    let bearing = match (ahead(left), ahead(right)) {
        (Some(near), Some(far)) if far < near => right,
        (None, Some(_)) => right,
        _ => left,
    };
    let bearing = hssh_metrics::wrap_angle(bearing);
    gateway_at(&at, bearing, field)
}
