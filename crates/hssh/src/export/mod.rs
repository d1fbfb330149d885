//! Maps as the files that other programs read: docs/exports.md says which, and what for.

mod areas;
mod drive_graph;
mod error;
mod geojson;
mod graphml;
mod kind;
mod names;
mod nav2;
mod open_rmf;
mod osm_ag;
mod provenance;
mod regions;
mod route_graph;
#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "in tests a failed unwrap is the failed assertion")]
mod tests;
mod tmap;
mod tum;
mod xml;
mod yaml;

pub use areas::{Area, AreaGraph, AreaPassage};
pub use drive_graph::{DriveGraph, DriveLeg, DrivePoint, Spacing};
pub use error::ExportError;
pub use geojson::route_geojson;
pub use graphml::graphml;
pub use kind::{ExportKind, Exported};
pub use nav2::nav2_graph;
pub use open_rmf::open_rmf_graph;
pub use osm_ag::osm_ag;
pub use provenance::Provenance;
pub use regions::regions_geojson;
pub use route_graph::{Door, RouteGraph, RouteNode, RouteWay, WayOrigin};
pub use tmap::topological_map;
pub use tum::tum_trajectory;

use crate::account::PlacesAccount;
use crate::answer::Answer;

/// A map of an answer as another program reads it: that of a rank, or the best one, if there is one and nothing makes it doubtful.
///
/// ```
/// use hssh::export::{ExportKind, Spacing, export_map};
/// use hssh::pipeline::{Input, MappingOptions, map};
///
/// let text = r#"(
///     stars: { "west": ["0+ @0", "0- @180 closed"], "east": ["0+ @0 closed", "0- @180"] },
///     start: "west",
///     travels: [(exit: "0+", entry: "0-", star: "east"), (exit: "0-", entry: "0+", star: "west")],
/// )"#;
/// let answer = map(&Input::from_ron("corridor", text)?, &MappingOptions::default(), &Default::default())?.answer;
/// let graph = export_map(&answer, None, ExportKind::GraphMl, Spacing::default())?;
/// assert!(graph.text.contains("<edge"));
/// // Nobody measured how long the corridor is.
/// assert!(export_map(&answer, None, ExportKind::Nav2, Spacing::default()).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If there is no such map, if it is one to drive by and may well be wrong, or if it lacks what the format needs.
pub fn export_map(
    answer: &Answer,
    rank: Option<usize>,
    kind: ExportKind,
    spacing: Spacing,
) -> Result<Exported, ExportError> {
    let chosen = rank.unwrap_or(1);
    let map = answer.map(chosen).ok_or_else(|| match answer.maps.first() {
        None => ExportError::NoMap { verdict: answer.verdict.sentence.clone() },
        Some(_) => ExportError::NoSuchRank { asked: chosen, found: answer.maps.len() },
    })?;
    let reservation = answer.reservation(chosen);
    if let (Some(why), None, true) = (&reservation, rank, kind.is_driven_by()) {
        return Err(ExportError::Doubtful { why: why.clone() });
    }
    let provenance = Provenance::of_map(answer, map, reservation);
    let warnings = provenance.doubt.iter().cloned().collect();
    // The building is drawn where the first map has the scans.
    let building = answer.building.as_ref().filter(|_| chosen == 1);
    let graph = RouteGraph::of_map(provenance, map, building)?;
    let text = match kind {
        ExportKind::Nav2 => nav2_graph(&DriveGraph::new(&graph, spacing)?),
        ExportKind::OpenRmf => open_rmf_graph(&DriveGraph::new(&graph, spacing)?),
        ExportKind::Tmap => topological_map(&DriveGraph::new(&graph, spacing)?),
        ExportKind::OsmAg => osm_ag(&AreaGraph::of_map(&graph, map)?),
        ExportKind::GraphMl => graphml(&graph),
        ExportKind::GeoJson => route_geojson(&graph)?,
        ExportKind::Tum => tum_trajectory(&map.trajectory)
            .ok_or_else(|| ExportError::NoTrajectory { input: answer.input.name.clone() })?,
        ExportKind::G2o => return Err(ExportError::NoPoseGraph { input: answer.input.name.clone() }),
        ExportKind::Regions | ExportKind::Labels => return Err(ExportError::OfGridMaps { kind }),
    };
    Ok(Exported { text, warnings })
}

/// The regions, places and ways of a grid map as another program reads them.
///
/// # Errors
/// If there are none that a robot could drive by, or the format is one of laser logs, or an image.
pub fn export_places(
    account: &PlacesAccount,
    kind: ExportKind,
    spacing: Spacing,
) -> Result<Exported, ExportError> {
    let roadmap = || RouteGraph::of_roadmap(account);
    let text = match kind {
        ExportKind::Nav2 => nav2_graph(&DriveGraph::new(&roadmap()?, spacing)?),
        ExportKind::OpenRmf => open_rmf_graph(&DriveGraph::new(&roadmap()?, spacing)?),
        ExportKind::Tmap => topological_map(&DriveGraph::new(&roadmap()?, spacing)?),
        ExportKind::OsmAg => osm_ag(&AreaGraph::of_regions(account)?),
        ExportKind::GraphMl => graphml(&RouteGraph::of_connections(account)?),
        ExportKind::GeoJson => route_geojson(&roadmap()?)?,
        ExportKind::Regions => regions_geojson(account)?,
        ExportKind::Labels => return Err(ExportError::NoGrid),
        ExportKind::Tum | ExportKind::G2o => return Err(ExportError::OfLogs { kind }),
    };
    Ok(Exported { text, warnings: Vec::new() })
}
