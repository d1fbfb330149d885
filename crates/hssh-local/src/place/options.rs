//! The numbers that place detection goes by.

/// The numbers that place detection goes by, each beside its default; lengths in metres, angles in radians.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PlaceOptions {
    /// Passages narrower than this are closed.
    pub narrowest_way: f64,
    /// Obstacles no longer and no wider than this are ignored, as are cells that no beam has met.
    pub clutter: f64,
    /// Cells that were not seen are free if they are this near to free ones: far away, beams are far apart.
    pub gap: f64,
    /// How far from the robot the middle of a neighborhood, its widest point, is looked for.
    pub climb: f64,
    /// A neighborhood reaches this far beyond the free disc around its middle.
    pub margin: f64,
    /// A way out leads at least this far on from the border of the neighborhood: rooms and lobbies, as
    /// far as they are seen through their doors, end before.
    pub depth: f64,
    /// Two ways out are one path if they point away from one another up to this much…
    pub straight: f64,
    /// …and if the line along one of them passes the other by no more than this part of their width.
    pub aligned: f64,
    /// The robot is at a place if the place's center is no farther away than this, beyond half its width.
    pub arrival: f64,
}

impl Default for PlaceOptions {
    fn default() -> Self {
        PlaceOptions {
            narrowest_way: 0.55,
            clutter: 0.3,
            gap: 0.1,
            climb: 1.5,
            margin: 1.5,
            depth: 8.0,
            straight: 40_f64.to_radians(),
            aligned: 1.5,
            arrival: 2.0,
        }
    }
}
