//! The numbers that routes go by.

/// How the robot's way becomes a network of ways between spots, each number beside its default; metres and radians.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RouteOptions {
    /// Two passages are one way if they are less than twice this apart.
    pub lane: f64,
    /// What lies between two lanes parts them if it is larger than this, in square metres, …
    pub island: f64,
    /// …and has so many square metres of walls.
    pub island_walls: f64,
    /// A way that leads less far than this out of another is none.
    pub shortest_branch: f64,
    /// Junctions joined by a way that is shorter are one spot…
    pub one_spot: f64,
    /// …or, where there is more room around them, by one that is no longer than so many times the room…
    pub roomy: f64,
    /// …but for ways longer than this.
    pub largest_spot: f64,
    /// A spot reaches so far along its ways.
    pub reach: f64,
    /// Along ways, the neighborhood is looked at every so many metres.
    pub look_distance: f64,
    /// Two sightings whose centers are this near are of one place.
    pub same_place: f64,
    /// A place must have been sighted so often.
    pub least_sightings: usize,
    /// The direction of a way is that of its first metres from the spot on, as many as this.
    pub aim: f64,
    /// A way out that was seen is the one that was travelled if they differ in direction by less than this.
    pub same_way: f64,
    /// The most cells along a side of the grid in which lanes are found: what is larger has larger cells.
    pub most_cells: f64,
}

impl Default for RouteOptions {
    fn default() -> Self {
        RouteOptions {
            lane: 0.6,
            island: 2.0,
            island_walls: 0.25,
            shortest_branch: 1.0,
            one_spot: 2.0,
            roomy: 1.25,
            largest_spot: 3.0,
            reach: 1.5,
            look_distance: 1.0,
            same_place: 3.0,
            least_sightings: 2,
            aim: 3.0,
            same_way: 45_f64.to_radians(),
            most_cells: 2000.0,
        }
    }
}
