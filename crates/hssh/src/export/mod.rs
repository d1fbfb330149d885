//! The regions and ways of a grid map as the files that other programs read.

mod geojson;
mod nav2;
mod open_rmf;
mod osm_ag;
mod tmap;

use std::collections::BTreeSet;

use crate::account::{PlacesAccount, RoadmapAccount};

pub use geojson::regions_geojson;
pub use nav2::nav2_graph;
pub use open_rmf::open_rmf_graph;
pub use osm_ag::osm_ag;
pub use tmap::topological_map;

/// Why there is nothing to write.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum ExportError {
    /// No roadmap.
    #[error("all places of the axis have no ways that are checked for a robot: leave out --detail")]
    NoRoadmap,
    /// No way.
    #[error(
        "no way leads from anywhere to anywhere for a robot of this size: nothing can be driven by; a smaller --radius may help"
    )]
    NoWay,
}

/// The roadmap of an account, if there is a way on it.
fn roadmap(account: &PlacesAccount) -> Result<&RoadmapAccount, ExportError> {
    let roadmap = account.roadmap.as_ref().ok_or(ExportError::NoRoadmap)?;
    if roadmap.ways.is_empty() { Err(ExportError::NoWay) } else { Ok(roadmap) }
}

/// Names for the regions, no two alike.
fn region_names(account: &PlacesAccount) -> Vec<String> {
    unique((0..).zip(&account.regions).map(|(number, region)| region.title(number)))
}

/// Names for the nodes of the roadmap, no two alike: a place is called as its region.
fn node_names(account: &PlacesAccount, roadmap: &RoadmapAccount) -> Vec<String> {
    let regions = region_names(account);
    unique((0..roadmap.nodes.len()).map(|number| {
        let node = &roadmap.nodes[number];
        match (node.kind.as_str(), node.number) {
            ("place", _) => regions[node.region as usize].clone(),
            ("passage", Some(passage)) => format!("{} {passage}", account.passages[passage as usize].kind),
            _ => format!("branch {number}"),
        }
    }))
}

/// The same names, with a number behind those that were there before.
fn unique(names: impl Iterator<Item = String>) -> Vec<String> {
    let mut taken: BTreeSet<String> = BTreeSet::new();
    let free = |name: String| {
        let numbered = (2..).map(|number| format!("{name} ({number})"));
        let found = std::iter::once(name.clone()).chain(numbered).find(|name| !taken.contains(name));
        let found = found.unwrap_or(name);
        taken.insert(found.clone());
        found
    };
    names.map(free).collect()
}

/// A text in double quotes, as both YAML and JSON read it.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_told_apart() {
        let names = ["lab", "lab", "lab (2)", "lab"].map(str::to_owned);
        assert_eq!(unique(names.into_iter()), ["lab", "lab (2)", "lab (2) (2)", "lab (3)"]);
    }
}
