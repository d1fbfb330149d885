//! For which program a map is written.

use std::fmt;

use clap::ValueEnum;

/// For which program a map is written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum ExportKind {
    /// nav2: the graph of its Route Server, GeoJSON.
    Nav2,
    /// Open-RMF: a navigation graph, YAML.
    OpenRmf,
    /// ROS topological_navigation: a map of version 2, YAML.
    Tmap,
    /// osmAG: areas and passages, OpenStreetMap XML.
    #[value(name = "osmag")]
    OsmAg,
    /// Places and ways with all that is known of them, for networkx, Gephi, yEd and others.
    #[value(name = "graphml")]
    GraphMl,
    /// Places and ways in the frame of the map, for whatever draws lines.
    #[value(name = "geojson")]
    GeoJson,
    /// Regions of a grid map as GeoJSON polygons.
    Regions,
    /// Regions of a grid map as PNG, a color for each.
    Labels,
    /// Of a log: when every scan was taken and where, TUM form.
    Tum,
    /// The pose graph: of a log all scans, of an exploration its places.
    G2o,
}

/// A file for another program.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Exported {
    /// What is in it.
    pub text: String,
    /// What somebody who uses it should know, and what the file says, too.
    pub warnings: Vec<String>,
}

impl ExportKind {
    /// Whether it is written of a topological map; the others are of grid maps only.
    #[must_use]
    pub fn is_of_maps(self) -> bool {
        !matches!(self, ExportKind::Regions | ExportKind::Labels)
    }

    /// Whether it is written of a grid map; the others are of what a robot drove or measured.
    #[must_use]
    pub fn is_of_grids(self) -> bool {
        !matches!(self, ExportKind::Tum | ExportKind::G2o)
    }

    /// Whether robots are sent by it, so that a map that may well be wrong does damage.
    #[must_use]
    pub fn is_driven_by(self) -> bool {
        match self {
            ExportKind::Nav2 | ExportKind::OpenRmf | ExportKind::Tmap | ExportKind::OsmAg => true,
            ExportKind::GraphMl
            | ExportKind::GeoJson
            | ExportKind::Regions
            | ExportKind::Labels
            | ExportKind::Tum
            | ExportKind::G2o => false,
        }
    }
}

/// As the command line has it.
impl fmt::Display for ExportKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.to_possible_value().expect("no kind is left out");
        f.write_str(value.get_name())
    }
}
