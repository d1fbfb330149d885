//! The numbers that closing loops goes by.

/// The numbers that closing loops goes by, each beside its default; lengths in metres, angles in radians.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ClosingOptions {
    /// A keyframe is a pose of the graph: one at least every so many metres…
    pub keyframe_distance: f64,
    /// …and every so many radians.
    pub keyframe_turn: f64,
    /// A submap is what was seen over so many metres of travel before and after its middle…
    pub stretch: f64,
    /// …and the middles are so far apart.
    pub submap_distance: f64,
    /// What a submap shows of its surroundings: beams are cut at this length…
    pub reach: f64,
    /// …or at more where that shows little, up to this length.
    pub farthest_reach: f64,
    /// Where the robot was less than so many metres of travel ago it is not back.
    pub least_travel: f64,
    /// How far off the estimate a pass is looked for: metres, and metres more for each metre of way between.
    pub window: (f64, f64),
    /// The same for the heading: radians, and radians more for each metre of way between.
    pub heading_window: (f64, f64),
    /// However long the way between: metres, radians.
    pub largest_window: (f64, f64),
    /// The least mean likeness of a match, 1 being perfect.
    pub least_score: f64,
    /// Of the walls of each that the other has seen, so many at least have to be where the other has them.
    pub least_agreement: f64,
    /// So many metres of wall have to be seen by both.
    pub least_overlap: f64,
    /// Of the walls that both have, this part at least has to cross those that lead along the others: else one can be slid on
    /// the other.
    pub least_crossing: f64,
    /// A match is ambiguous if another one, elsewhere in the window, has this share of its score.
    pub ambiguity: f64,
    /// So many matches in a row have to tell the same; one less, if they are where they were expected or their mean
    /// likeness is at least `strong_score`.
    pub least_chain: usize,
    /// See `least_chain`.
    pub strong_score: f64,
    /// Where the robot is known up to this standard deviation, in metres, there is no room for another corridor that looks
    /// alike; with each two doublings of it one more match has to tell the same.
    pub well_known: f64,
    /// However good a match is, a closure is not known better than this: metres and radians, standard deviations.
    pub floor: (f64, f64),
    /// The same of a match of one keyframe.
    pub fine_floor: (f64, f64),
    /// So often all keyframes are matched with other passes: the better the poses, the better the walls of those.
    pub refinements: usize,
}

impl Default for ClosingOptions {
    fn default() -> Self {
        ClosingOptions {
            keyframe_distance: 0.5,
            keyframe_turn: 0.5,
            stretch: 5.0,
            submap_distance: 2.5,
            reach: 10.0,
            farthest_reach: 30.0,
            least_travel: 15.0,
            window: (0.6, 0.015),
            heading_window: (0.06, 0.002),
            largest_window: (12.0, 0.5),
            least_score: 0.4,
            least_agreement: 0.75,
            least_overlap: 6.0,
            least_crossing: 0.08,
            ambiguity: 0.85,
            least_chain: 3,
            strong_score: 0.6,
            well_known: 2.5,
            floor: (0.04, 0.006),
            fine_floor: (0.02, 0.004),
            refinements: 2,
        }
    }
}
