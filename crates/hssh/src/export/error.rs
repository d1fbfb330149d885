//! Why there is nothing to write for another program, and what to do.

use super::kind::ExportKind;

/// Why there is nothing to write.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum ExportError {
    /// The answer has no map.
    #[error("there is no map: {verdict}")]
    NoMap {
        /// What the answer says.
        verdict: String,
    },
    /// The answer does not list so many maps.
    #[error("there is no map number {asked}: the answer lists {found}")]
    NoSuchRank {
        /// The rank asked for.
        asked: usize,
        /// How many maps there are.
        found: usize,
    },
    /// The map may well be wrong, and robots are sent by such files.
    #[error(
        "no robot should be sent by a map that may well be wrong: {why}\nhelp: --rank 1 writes the first map all the same, and the file says so; \
         graphml and geojson are written in any case"
    )]
    Doubtful {
        /// Why it may be wrong.
        why: String,
    },
    /// A place is nowhere.
    #[error(
        "place {place} has no position, for the travels were not measured: only graphml needs none\nhelp: explorations with odometry and laser \
         logs give positions"
    )]
    NotPlaced {
        /// The number of the place.
        place: usize,
    },
    /// No roadmap.
    #[error("all places of the axis have no ways that are checked for a robot: leave out --detail")]
    NoRoadmap,
    /// No regions.
    #[error("there are no regions: only a whole grid map has them")]
    NoRegions,
    /// No way.
    #[error(
        "no way leads from anywhere to anywhere for a robot of this size: nothing can be driven by; a smaller --radius may help"
    )]
    NoWay,
    /// A map with a single place.
    #[error("the map has no way from place to place: nothing can be driven by")]
    NoLink,
    /// A way leads back to its place, and how is not known.
    #[error(
        "way {way} leads from place {place} back to it, and how it goes is not known: only a laser log tells\nhelp: graphml needs no line"
    )]
    UnknownLoop {
        /// The number of the way.
        way: usize,
        /// The place.
        place: usize,
    },
    /// Too many nodes.
    #[error("the ways would have more than {most} nodes\nhelp: a larger --spacing makes fewer")]
    TooMany {
        /// So many are written.
        most: usize,
    },
    /// An answer that contradicts itself.
    #[error("the answer is damaged: {what} leads to place {place}, and there are {places} places")]
    NoSuchPlace {
        /// What leads there.
        what: String,
        /// The place that is not there.
        place: u32,
        /// How many places there are.
        places: usize,
    },
    /// Nothing is known of how large places are.
    #[error(
        "osmag needs gateways, and none is known of place {place}: only laser logs and grid maps tell how wide places are"
    )]
    NoOutline {
        /// The number of the place.
        place: usize,
    },
    /// The answer does not carry the trajectory.
    #[error(
        "the answer carries no trajectory\nhelp: `hssh map {input} --trajectory FILE` writes it; `hssh map {input} --json --with-trajectory` puts it \
         into the answer. Explorations have none"
    )]
    NoTrajectory {
        /// The input of the answer.
        input: String,
    },
    /// An answer does not carry the pose graph.
    #[error("an answer carries no pose graph\nhelp: `hssh map {input} --g2o FILE` writes it")]
    NoPoseGraph {
        /// The input of the answer.
        input: String,
    },
    /// Asked for of a topological map.
    #[error(
        "{kind} is of the regions of a grid map\nhelp: `hssh map LOG --grid building.yaml` writes the grid of a log's building, and `hssh stars \
         building.yaml --export {kind}=FILE` its regions"
    )]
    OfGridMaps {
        /// What was asked for.
        kind: ExportKind,
    },
    /// The image is made of the grid itself.
    #[error(
        "labels are an image of the grid map, which this file does not hold\nhelp: `hssh stars MAP --export labels=FILE` writes it"
    )]
    NoGrid,
    /// Asked for of a grid map.
    #[error(
        "{kind} is of laser logs: a grid map has no robot that moves\nhelp: `hssh map LOG --export {kind}=FILE`"
    )]
    OfLogs {
        /// What was asked for.
        kind: ExportKind,
    },
}
